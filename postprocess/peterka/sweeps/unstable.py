"""Unstable orbits between the folds, period doublings and grazings of a sweep, which close its hysteresis loops.

A file of curves has them at the gaps of its curves.gap_ratio. Those are drawn that begin or end at a border met by the
sweep, and those that continue them.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..maps.curves_file import SAME_GAP, CurvesFile, UnstableBranch
from .borders import Border
from .sweep_file import SweepFile

NO_UNSTABLE: Sequence[UnstableBranch] = ()
LOOK = {"color": "#666666", "linewidth": 0.6, "linestyle": "-"}
SAME_PLACE = 1e-9  # of the frequency: borders and ends of branches are computed roots


def read_unstable(path: Path, sweep: SweepFile, borders: Sequence[Border]) -> list[UnstableBranch]:
    """The branches of a file of curves that lie at the sweep's gaps and are connected to one of its borders."""
    with CurvesFile(path) as file:
        branches = file.unstable_branches
    found = []
    for gap in sweep.gaps:
        if gap is not None:
            waiting = [each for each in branches if abs(each.gap_ratio - gap) < SAME_GAP]
            found += _connected(waiting, [border.frequency_ratio for border in borders if border.gap == gap])
    return found


def at_gap(branches: Sequence[UnstableBranch], gap: float | None) -> list[UnstableBranch]:
    """The branches at one of the sweep's gaps."""
    return [each for each in branches if gap is not None and abs(each.gap_ratio - gap) < SAME_GAP]


def handles(branches: Sequence[UnstableBranch]) -> list[Line2D]:
    """Entries of the legend."""
    return [Line2D([], [], label="unstable", **LOOK)] if branches else []


def draw_unstable(ax: Axes, branches: Sequence[UnstableBranch], name: str) -> None:
    """Thin lines in a panel, which do not affect its limits. `name` selects the
    heights: force, or a displacement with a line for each of an orbit's samples."""
    for branch in branches:
        heights = getattr(branch, name)
        lines = heights[:, None] if heights.ndim == 1 else np.sort(heights, axis=1)
        for line in lines.T:
            if np.isfinite(line).any():
                ax.add_artist(Line2D(branch.frequency_ratio, line, zorder=1.4, **LOOK))


def _connected(branches: Sequence[UnstableBranch], places: Sequence[float]) -> list[UnstableBranch]:
    """The branches that reach one of the places, directly or through other branches."""
    found: list[UnstableBranch] = []
    waiting = list(branches)
    while True:
        reached = [each for each in waiting if any(
            abs(end - place) < SAME_PLACE * place for end in each.frequency_ratio[[0, -1]] for place in places)]
        if not reached:
            return found
        found += reached
        waiting = [each for each in waiting if not any(each is other for other in reached)]
        places = [*places, *(end for each in reached for end in each.frequency_ratio[[0, -1]])]
