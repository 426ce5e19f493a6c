"""The fixed look of each integration method: colour (Okabe and Ito), marker, and name in words.

Markers differ too, so that pictures are readable in grey. Methods without a setting are a single point, not a line.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes

from ..arrays import Reals

LINE = 1.1  # pt


@dataclass(frozen=True)
class Look:
    """Of a method: its name in words, its colour '#RRGGBB', its marker."""

    name: str
    colour: str
    marker: str


_LOOKS = {
    "exact": Look("closed form (exact)", "#000000", "*"),
    "batched": Look("closed form, batched", "#F0E442", "P"),
    "split": Look("closed form with kicks (split)", "#009E73", "D"),
    "cvode_adams": Look("CVODE Adams", "#0072B2", "o"),
    "cvode_bdf": Look("CVODE BDF", "#56B4E9", "s"),
    "arkode_explicit": Look("ARKODE explicit", "#D55E00", "^"),
    "arkode_implicit": Look("ARKODE implicit", "#E69F00", "v"),
    "rk4_with_events": Look("RK4 with events", "#CC79A7", "X"),
    "rk4_without_events": Look("RK4 without events", "#767676", "h"),
    "cvode": Look("CVODE", "#0072B2", "o"),
    "arkode": Look("ARKODE", "#D55E00", "^"),
}


def look(method: str) -> Look:
    """The Look of a method; an unknown one has its own name and a grey marker."""
    return _LOOKS.get(method, Look(method.replace("_", " "), "#767676", "<"))


def methods_in_order(method: Iterable[str]) -> list[str]:
    """Names of the methods in an array of words, known ones first, in legend order."""
    order = list(_LOOKS)
    known = {name for name in method if name}
    return sorted(known, key=lambda name: (order.index(name) if name in order else len(order), name))


def draw_points(ax: Axes, x: Reals, y: Reals, method: str, low: Reals | None = None, high: Reals | None = None,
                hollow: Sequence[bool] | None = None) -> None:
    """A method's points in order, joined by a line if there are several, with a band from low to high; `hollow` marks points
    that represent only part of the work."""
    appearance = look(method)
    if low is not None and len(x) > 1:
        ax.fill_between(x, low, high, color=appearance.colour, alpha=0.13, linewidth=0)
    elif low is not None:
        ax.vlines(x, low, high, color=appearance.colour, linewidth=LINE)
    ax.plot(x, y, color=appearance.colour, linewidth=LINE, marker="none", zorder=3)
    for index in range(len(x)):
        open_marker = hollow is not None and hollow[index]
        ax.plot(x[index], y[index], zorder=4, **marker_look(method, open_marker))


def marker_look(method: str, hollow: bool = False) -> dict[str, Any]:
    """Keywords of plot() for one marker of a method."""
    appearance = look(method)
    return {
        "marker": appearance.marker, "linestyle": "none",
        "markersize": {"*": 9, "P": 7, "X": 5.5, "D": 4.2}.get(appearance.marker, 4.8),
        "markerfacecolor": "white" if hollow else appearance.colour,
        "markeredgecolor": appearance.colour if hollow else "black",
        "markeredgewidth": 1.2 if hollow else 0.5,
    }
