"""Other numbers of a sweep's motions over its axis, a panel per gap: the fields of a map, if the sweep has them.

Periodic motions are lines, which end where the file tells a jump; those of other motions, over the observation window, are single marks.
"""

import textwrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Reals
from ..errors import PeterkaFileError
from ..files.checked_hdf5 import INTEGER, REAL
from ..maps import elasticity_map
from ..maps.field_map import Scale
from ..maps.map_file import QUANTITIES
from ..maps.number_map import NUMBERS
from ..maps.number_map import scale_of as scale_of_number
from ..maps.quantity_map import FAR_FROM_ZERO, TITLES
from ..maps.quantity_map import scale_of as scale_of_quantity
from ..plotting import style, units
from ..plotting.limits import requested
from ..plotting.picture import picture
from . import sweep_panels
from .sweep_file import Branch, SweepFile

CYCLES, LIFE = "last_impact", "life"
ELASTICITIES = {f"elasticity_{number}": [f"{result}_elasticity_{number}" for result in elasticity_map.RESULTS]
                for number in elasticity_map.NUMBERS}
# Of each picture, the datasets of which a file may have one; orbits are in the bifurcation diagrams.
PICTURES = {name: [name] for name in (*TITLES, *NUMBERS, CYCLES) if not name.startswith("orbit")} | {LIFE: ["mean_life_s"]} | ELASTICITIES
FROM_ZERO = {*TITLES, CYCLES, *(name for name, number in NUMBERS.items() if number.from_zero)} - set(FAR_FROM_ZERO)
MARGIN = 0.05  # of a panel's height, above and below the values
LEAST, LIFE_ERROR = "mean_life_least_s", "mean_life_error_s"
BOUND: dict[str, Any] = {"marker": "^", "markersize": 3, "markerfacecolor": "none", "markeredgewidth": 0.6}
LETTERS = 30  # in a line of the name of a scale


def has(file: SweepFile, name: str) -> bool:
    """Whether a sweep has one of the fields of PICTURES."""
    return _dataset(file, name) is not None


@picture(SweepFile)
def draw(file: SweepFile, ax: Axes | None = None, *, name: str) -> list[Axes] | None:
    """One of PICTURES as a list of Axes, one per gap; None if no motion has a value."""
    dataset = _dataset(file, name)
    assert dataset is not None
    values = {branch.row: _values(file, dataset, branch) for branch in file.branches}
    bounds = {row: np.where(np.isfinite(values[row]), np.nan, least) for row, least in _rows_of(file, LEAST, name == LIFE).items()}
    errors = _rows_of(file, LIFE_ERROR, name == LIFE)
    every = np.concatenate([*values.values(), *bounds.values()])
    every = every[np.isfinite(every)]
    if not np.any(every != 0):
        return None
    scale = _scale(file, name, dataset, float(np.abs(every).max()))
    limits = requested(file, every, scale.in_si, scale.ratio)
    log = (style.scale_option("log") or name == LIFE) and every.min() > 0  # lives differ by powers of ten
    second = scale.second and (_in_lines(scale.second[0]), scale.second[1])
    handles = sweep_panels.direction_handles(file, lambda branch: values[branch.row])
    if any(np.isfinite(least).any() for least in bounds.values()):
        handles.append(Line2D([], [], label="lasts at least, roughly", color="black", linestyle="none", **BOUND))
    panels = sweep_panels.panels(file, handles, _in_lines(scale.label), second, ax, log=log)
    if limits and log:
        limits = limits[0] if limits[0] > 0 else 0.9 * float(every.min()), limits[1]
    for gap, panel in panels.items():
        for branch in file.at_gap(gap):
            sweep_panels.draw_branch(panel, file, branch, scale.factor * values[branch.row])
            look = sweep_panels.LOOKS[branch.direction]
            if branch.row in errors:
                told = np.isfinite(values[branch.row]) & np.isfinite(errors[branch.row])
                panel.errorbar(file.values[told], scale.factor * values[branch.row][told], scale.factor * errors[branch.row][told], linestyle="none",
                               ecolor=look.colour, elinewidth=0.4, zorder=look.zorder)
            if branch.row in bounds:
                panel.plot(file.values, scale.factor * bounds[branch.row], color=look.colour, linestyle="none", zorder=look.zorder, **BOUND)
        own = np.concatenate([each[branch.row] for branch in file.at_gap(gap) for each in (values, bounds) if branch.row in each])
        panel.set_ylim(*(scale.factor * end for end in limits or _ends(own[np.isfinite(own)], every, name in FROM_ZERO, log)))
    return list(panels.values())


def _dataset(file: SweepFile, name: str) -> str | None:
    shape = (len(file.branches), len(file.values))
    for dataset in PICTURES[name]:
        try:
            file.data.dataset(dataset, shape, INTEGER + REAL)
        except PeterkaFileError:
            continue
        return dataset
    return None


def _values(file: SweepFile, dataset: str, branch: Branch) -> Reals:
    """Of a branch, (points,); NaN where there is none, which of whole numbers is below 0."""
    stored = file.data.values(dataset, branch.row)
    return np.where(stored < 0, np.nan, stored) if stored.dtype.kind in INTEGER else np.asarray(stored, dtype=float)


def _rows_of(file: SweepFile, dataset: str, wanted: bool) -> dict[int, Reals]:
    """{row: (points,)} of a dataset that is wanted and in the file; else empty."""
    return {branch.row: _values(file, dataset, branch) for branch in file.branches if wanted and file.data.has(dataset)}


def _ends(own: Reals, every: Reals, from_zero: bool, log: bool) -> tuple[float, float]:
    """(bottom, top) of a panel whose values are `own`, those of all panels `every`."""
    low, high = (own.min(), own.max()) if len(own) else (every.min(), every.max())
    if log:
        return 0.9 * low, 1.1 * high
    bottom = min(low, 0.0) if from_zero else low
    room = MARGIN * ((high - bottom) or abs(high) or 1.0)
    return (bottom if from_zero and bottom == 0 else bottom - room), high + room


def _scale(file: SweepFile, name: str, dataset: str, largest: float) -> Scale:
    if name in TITLES:
        return scale_of_quantity(TITLES[name], QUANTITIES[name][0], largest)
    if name in NUMBERS:
        return scale_of_number(file, NUMBERS[name], largest)
    words = {CYCLES: "forcing cycles to the last impact", LIFE: "mean life under [noise] (s)"}.get(name) or f"{elasticity_map.words(dataset)} (% per %)"
    return Scale(words, 1, units.number)


def _in_lines(label: str) -> str:
    return textwrap.fill(label, LETTERS, break_long_words=False)
