"""A recording of impacts: evenly sampled signals, NaN where a sample is missing.

Signals are force [N] between hammer and stop, acceleration [m/s^2] of the hammer, displacement [m] of the hammer in the cart,
and cart_displacement [m] and cart_acceleration [m/s^2]. Each may have an offset and either sign.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Integers, Reals
from ..errors import PeterkaFileError

FEWEST_SAMPLES = 50
UNEVEN = 0.3  # of a step: tolerance for a time stamp, as rounding to a few printed digits causes
AT_ONCE = 1_000_000  # samples looked at together
ROUNDS = 10
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

    def gaps(self) -> tuple[int, float, float]:
        """(number of stretches without a sample, length [s] of the longest, time [s] of its begin); NaN if there are none."""
        count, longest, begin = 0, 0, 0
        since: int | None = None
        for first in range(0, self.count, AT_ONCE):
            absent = np.logical_or.reduce([np.isnan(signal[first:first + AT_ONCE]) for signal in self.signals.values()])
            edges = np.flatnonzero(np.diff(np.concatenate([[since is not None], absent]).astype(np.int8)))
            for at in (edges + first).tolist():
                if since is None:
                    count, since = count + 1, at
                else:
                    longest, begin = max((longest, begin), (at - since, since), key=lambda one: int(one[0]))
                    since = None
        if since is not None:
            longest, begin = max((longest, begin), (self.count - since, since), key=lambda one: one[0])
        return count, self.step * longest if count else np.nan, self.begin + self.step * begin if count else np.nan

    def cut(self, begin: float | None, end: float | None) -> "Recording":
        """The part between these times [s]; None: unbounded."""
        first = 0 if begin is None else int(np.clip(np.ceil((begin - self.begin) / self.step - 1e-6), 0, self.count))
        last = self.count if end is None else int(np.clip(np.floor((end - self.begin) / self.step + 1e-6) + 1, first, self.count))
        if last - first < FEWEST_SAMPLES:
            raise PeterkaFileError(f"{self.path} has {last - first} samples" + " between --from and --to" * (last - first < self.count)
                              + f"; {FEWEST_SAMPLES} are needed at least")
        return Recording(self.path, self.begin + first * self.step, self.step,
                         {name: signal[first:last] for name, signal in self.signals.items()})


class UnevenTimes(ValueError):
    """Where times don't ascend evenly, in words, which may be empty."""


@dataclass(frozen=True)
class EvenTimes:
    """Sample n of `count`, including missing ones, is taken at `begin` + n `step` [s]; `rough` [s]: the step by which times are counted."""

    begin: float
    step: float
    count: int
    rough: float

    def places(self, time: Reals) -> Iterator[tuple[int, Integers]]:
        """(index of the first time, index in whole steps of each of the next times) of one block after another."""
        return _places(time, self.rough)


def even_times(time: Reals) -> EvenTimes:
    """The EvenTimes of a recording, looked at block by block. Raises UnevenTimes if they do not ascend evenly apart from missing samples."""
    if len(time) < 2:
        raise UnevenTimes
    _refuse_descending(time)
    first, last = float(time[0]), float(time[-1])
    step, places = _step_without_gaps(time[:AT_ONCE]), 0
    for _ in range(ROUNDS):  # where times have few digits, a long gap may be counted wrongly at first
        before = places
        for _, inside in _places(time, step):
            places = int(inside[-1])
        if not 0 < places <= LONGEST_MISSING * len(time):
            raise UnevenTimes
        rough, step = step, (last - first) / places
        if places == before:
            break
    # What is left of a straight line from the first time to the last, as a line over places counted from the middle one.
    sums = np.zeros(4)
    for at, inside in _places(time, rough):
        place, left = inside - 0.5 * places, time[at:at + len(inside)] - first - step * inside
        sums += [place.sum(), left.sum(), (place**2).sum(), (place * left).sum()]
    mean, level = sums[0] / len(time), sums[1] / len(time)
    slope = (sums[3] - len(time) * mean * level) / (sums[2] - len(time) * mean**2)
    begin = level - slope * (mean + 0.5 * places)
    for at, inside in _places(time, rough):
        off = np.abs(time[at:at + len(inside)] - first - begin - (step + slope) * inside)
        if off.max() > UNEVEN * step:
            raise UnevenTimes(f" (at {time[at + int(np.argmax(off))]:.9g} s, say)")
    return EvenTimes(first + begin, step + slope, places + 1, rough)


def _step_without_gaps(time: Reals) -> float:
    """The mean step in the longest stretch without missing samples."""
    steps = np.diff(time)
    median = float(np.median(steps))
    gaps = np.concatenate([[-1], np.flatnonzero(np.rint(steps / median) != 1), [len(steps)]])
    longest = int(np.argmax(np.diff(gaps)))
    begin, end = gaps[longest] + 1, gaps[longest + 1]
    return float((time[end] - time[begin]) / (end - begin)) if end > begin else median


def _refuse_descending(time: Reals) -> None:
    for first in range(0, len(time), AT_ONCE):
        steps = np.diff(time[first:first + AT_ONCE + 1])
        if len(steps) and not steps.min() > 0:
            at = first + int(np.argmin(steps))
            kind = "two samples have one time" if time[at + 1] == time[at] else "it goes back, as where a new recording begins"
            raise UnevenTimes(f" (after {time[at]:.9g} s: {kind})")


def _places(time: Reals, step: float) -> Iterator[tuple[int, Integers]]:
    place = 0
    for first in range(0, len(time), AT_ONCE):
        steps = np.diff(time[max(0, first - 1):first + AT_ONCE])
        inside = place + np.cumsum(np.append(np.zeros(int(first == 0)), np.rint(steps / step))).astype(np.int64)
        place = int(inside[-1])
        yield first, inside
