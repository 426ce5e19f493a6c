"""Recordings as CSV files of named columns.

    time_s or time_ms                                      evenly ascending, except for missing samples
    force_n, force_kn                                      between hammer and stop
    acceleration_m_s2, acceleration_g                      of the hammer
    displacement_m, displacement_mm                        of the hammer in the cart

At least one of these signals, in any order. A cell may be empty.
"""

from pathlib import Path

import numpy as np

from ..files.csv_table import read_csv_table
from ..files.opened import STANDARD_GRAVITY
from .recording import Recording, even_places

TIMES = {"time_s": 1.0, "time_ms": 1e-3}
SIGNALS = {
    "force_n": ("force", 1.0),
    "force_kn": ("force", 1e3),
    "acceleration_m_s2": ("acceleration", 1.0),
    "acceleration_g": ("acceleration", STANDARD_GRAVITY),
    "displacement_m": ("displacement", 1.0),
    "displacement_mm": ("displacement", 1e-3),
}
LARGEST_BYTES = 2**28


def read_recording(path: Path, begin: float | None, end: float | None) -> Recording:
    """The Recording of a file between the times begin and end [s] (None: unbounded). Raises PeterkaFileError for an unusable file."""
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
    if np.isnan(time).any():
        line, _ = table.rows[int(np.argmax(np.isnan(time)))]
        raise table.refusal(f"has no {clocks[0]}; every sample needs one", line)
    try:
        first, step, places = even_places(time)
    except ValueError:
        raise table.refusal("has times that don't ascend evenly; record at one sample rate") from None
    signals = {}
    for name in names:
        quantity, factor = SIGNALS[name]
        signals[quantity] = np.full(int(places[-1]) + 1, np.nan)
        signals[quantity][places] = factor * columns[name]
    return Recording(path, first, step, signals).cut(begin, end)


def _column(table, name):
    return np.array([np.nan if (number := table.number(line, cells, name)) is None else number for line, cells in table.rows])
