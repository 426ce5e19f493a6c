"""Every attractor at each point of a sweep with [starts], whichever its branches follow: thin dots below the branches."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Reals
from .sweep_file import Branch, SweepFile

COLOUR = "#777777"
DOTS = {"marker": "o", "markeredgewidth": 0, "linestyle": "none", "color": COLOUR}
SIZE = 1.0  # pt


def handles(file: SweepFile) -> list[Line2D]:
    """Legend entries: one if the sweep has [starts]."""
    return [Line2D([], [], label="attractors that are known", **DOTS | {"markersize": 3 * SIZE})] if file.slots else []


def forces(file: SweepFile, gap: float | None) -> tuple[Reals, Reals]:
    """(values of the axis, forces) of all attractors with a force at a gap, two arrays of one length."""
    if not file.slots:
        return np.zeros(0), np.zeros(0)
    force = file.attractor_forces(_first(file, gap))
    slots, points = np.nonzero(np.isfinite(force))
    return file.values[points], force[slots, points]


def draw(ax: Axes, x: Reals, y: Reals, size: float = SIZE) -> None:
    """Draws dots below all branches, at these positions of a panel, (n,) each."""
    if len(x):
        ax.plot(x, y, **DOTS, markersize=size, zorder=1.3, rasterized=len(x) > 5000)


def draw_samples(ax: Axes, file: SweepFile, gap: float | None, name: str, size: float) -> None:
    """The same for samples; `name` as for the branches' own."""
    if file.slots:
        points, values = file.attractor_samples(name, _first(file, gap))
        draw(ax, file.values[points], values, size)


def _first(file: SweepFile, gap: float | None) -> Branch:
    """A branch of the gap; branches of one gap share their attractors."""
    return file.at_gap(gap)[0]
