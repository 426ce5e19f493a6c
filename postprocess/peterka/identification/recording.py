"""A recording of impacts over a cart at rest, from a CSV file.

    time_s or time_ms                                      evenly spaced, ascending
    force_n                                                between hammer and stop
    acceleration_m_s2, acceleration_g                      of the hammer
    displacement_m, displacement_mm                        of the hammer

One of these signals at least, in any order. Each may have an offset and either sign.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.opened import STANDARD_GRAVITY
from ..files.csv_table import read_csv_table

TIMES = {"time_s": 1.0, "time_ms": 1e-3}
SIGNALS = {
    "force_n": ("force", 1.0),
    "acceleration_m_s2": ("acceleration", 1.0),
    "acceleration_g": ("acceleration", STANDARD_GRAVITY),
    "displacement_m": ("displacement", 1.0),
    "displacement_mm": ("displacement", 1e-3),
}
LARGEST_BYTES = 2**28
FEWEST_SAMPLES = 50
UNEVEN = 0.05  # of a step, by which a time may be off its place


@dataclass(frozen=True)
class Recording:
    """`time` [s] from the file's own zero; `signals` {force [N], acceleration [m/s^2], displacement [m]: values as recorded}."""

    path: Path
    time: np.ndarray
    signals: dict[str, np.ndarray]

    @property
    def step(self) -> float:
        """Between samples [s]."""
        return (self.time[-1] - self.time[0]) / (len(self.time) - 1)


def read_recording(path: Path, begin: float | None, end: float | None) -> Recording:
    """The Recording of a file, of the times from begin to end [s] alone (None: as far as it goes)."""
    table = read_csv_table(path, (*TIMES, *SIGNALS), "samples", LARGEST_BYTES)
    clocks, names = [name for name in table.names if name in TIMES], [name for name in table.names if name in SIGNALS]
    if len(clocks) != 1:
        raise table.refusal(f"has {' and '.join(clocks) or 'no time'}; it needs one column of {' or '.join(TIMES)}")
    quantities = [SIGNALS[name][0] for name in names]
    if not names or len(set(quantities)) < len(quantities):
        raise table.refusal(f"has {' and '.join(names) or 'no signal'}; it needs one column of each kind at most, of "
                            f"{', '.join(SIGNALS)}")
    columns = {name: _column(table, name) for name in (*clocks, *names)}
    time = columns[clocks[0]] * TIMES[clocks[0]]
    inside = (time >= (-np.inf if begin is None else begin)) & (time <= (np.inf if end is None else end))
    if inside.sum() < FEWEST_SAMPLES:
        raise table.refusal(f"has {inside.sum()} samples" + (" between --from and --to" if inside.sum() < len(time) else "")
                            + f"; {FEWEST_SAMPLES} are needed at least")
    _check_even(table, time)
    return Recording(path, time[inside], {SIGNALS[name][0]: columns[name][inside] * SIGNALS[name][1] for name in names})


def _column(table, name):
    values = np.array([np.nan if (number := table.number(line, cells, name)) is None else number
                       for line, cells in table.rows])
    if np.isnan(values).any():
        line, _ = table.rows[int(np.argmax(np.isnan(values)))]
        raise table.refusal(f"has no {name}; every sample needs one", line)
    return values


def _check_even(table, time):
    steps = np.diff(time)
    step = (time[-1] - time[0]) / (len(time) - 1)
    away = np.abs(time - np.linspace(time[0], time[-1], len(time)))
    if not step > 0 or steps.min() <= 0 or away.max() > max(UNEVEN * step, _last_digit(time)):
        line, _ = table.rows[int(np.argmax(away))]
        raise table.refusal("has times that don't ascend evenly; record at one sample rate, without gaps", line)


def _last_digit(time):
    """What rounding to the digits that a file prints may move a time by: some print six."""
    return 1e-6 * abs(time).max()
