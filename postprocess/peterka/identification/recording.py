"""A recording of impacts: evenly sampled signals, NaN where a sample is missing.

Signals are force [N] between hammer and stop, acceleration [m/s^2] of the hammer, displacement [m] of the hammer in the cart,
and cart_displacement [m] and cart_acceleration [m/s^2]. Each may have an offset and either sign.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Reals
from ..errors import PeterkaFileError

FEWEST_SAMPLES = 50
UNEVEN = 0.3  # of a step: tolerance for a time stamp, as rounding to a few printed digits causes
LONGEST_MISSING = 100  # ratio of missing to present samples beyond which the times must be wrong


@dataclass(frozen=True)
class Recording:
    """Sample n is taken at `begin` + n `step` [s]; `signals` {name: values as recorded, (count,)}."""

    path: Path
    begin: float
    step: float
    signals: dict[str, Reals]

    @property
    def count(self) -> int:
        """Number of samples, including missing ones."""
        return len(next(iter(self.signals.values())))

    @property
    def missing(self) -> int:
        """Number of samples that lack any signal."""
        return sum(int(np.logical_or.reduce([np.isnan(signal[first:first + 10**6]) for signal in self.signals.values()]).sum())
                   for first in range(0, self.count, 10**6))

    def cut(self, begin: float | None, end: float | None) -> "Recording":
        """The part between these times [s]; None: unbounded."""
        first = 0 if begin is None else int(np.clip(np.ceil((begin - self.begin) / self.step - 1e-6), 0, self.count))
        last = self.count if end is None else int(np.clip(np.floor((end - self.begin) / self.step + 1e-6) + 1, first, self.count))
        if last - first < FEWEST_SAMPLES:
            raise PeterkaFileError(f"{self.path} has {last - first} samples" + " between --from and --to" * (last - first < self.count)
                              + f"; {FEWEST_SAMPLES} are needed at least")
        return Recording(self.path, self.begin + first * self.step, self.step,
                         {name: signal[first:last] for name, signal in self.signals.items()})


def even_places(time: Reals) -> tuple[float, float, np.ndarray]:
    """(begin [s], step [s], index of each time in whole steps). Raises
    ValueError if the times do not ascend evenly apart from missing samples."""
    steps = np.diff(time)
    if not len(steps) or not steps.min() > 0:
        raise ValueError
    step = float(np.median(steps))
    for _ in range(3):  # the median of rounded steps is slightly off
        places = np.rint(np.cumsum(np.append(0, np.rint(steps / step)))).astype(np.int64)
        step = float((time[-1] - time[0]) / places[-1])
    if places[-1] > LONGEST_MISSING * len(time):
        raise ValueError
    slope, begin = np.polyfit(places.astype(float), time - time[0], 1)
    if np.abs(time - time[0] - begin - slope * places).max() > UNEVEN * slope:
        raise ValueError
    return float(time[0] + begin), float(slope), places
