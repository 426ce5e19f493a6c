"""Marks of measured points over pictures: one per series, distinguishable without colour, with bars for standard errors.
Over a map of forces a mark has the colour of the measured force."""

from collections.abc import Sequence, Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..plotting import axes
from ..plotting.drawn import Plane
from ..plotting.notes import write_at
from ..plotting.seen import SEEN
from .points import AXES, Point

SHAPES, FACES = "Dos^vP<>", ("white", "black", "#AAAAAA")  # 24 pairs
EDGE = {"markersize": 5, "markeredgecolor": "black", "markeredgewidth": 0.9, "linestyle": "none"}
BARS = {"ecolor": "black", "elinewidth": 0.9, "capsize": 2, "fmt": "none"}
NAMELESS = "measured"


def handles(points: Sequence[Point]) -> list[Line2D]:
    """Legend entries: one per series."""
    return [Line2D([], [], label=name or NAMELESS, **look) for name, look in looks(points).items()]


def looks(points: Sequence[Point]) -> dict[str, dict[str, Any]]:
    """{series: properties of its mark}, in order of occurrence."""
    names = list(dict.fromkeys(point.series for point in points))
    return {name: EDGE | {"marker": SHAPES[number % len(SHAPES)], "markerfacecolor": FACES[number // len(SHAPES)]}
            for number, name in enumerate(names)}


def draw(ax: Axes, points: Sequence[Point], quantities: Sequence[str], everyone: Sequence[Point] | None = None,
         zorder: float = 6.0) -> None:
    """Marks of `points` at two of their quantities, horizontal and vertical; `everyone`: all points that determine the marks' looks."""
    for name, look in looks(everyone or points).items():
        own = [point for point in points if point.series == name]
        if not own:  # matplotlib cannot lay out an empty line
            continue
        x, y = ([getattr(point, quantity) for point in own] for quantity in quantities)
        errors = [[point.errors.get(quantity, 0.0) for point in own] for quantity in quantities]
        if np.any(errors):
            ax.errorbar(x, y, xerr=errors[0] if any(errors[0]) else None, yerr=errors[1] if any(errors[1]) else None,
                        zorder=zorder - 0.1, **BARS)
        ax.plot(x, y, zorder=zorder, clip_on=False, gid=SEEN, **look)


def draw_over_map(ax: Axes, file: Plane, points: Sequence[Point], colour_of: Callable[[float], Any] | None = None) -> None:
    """Marks over the plane of a map; `colour_of` gives the colour for a force [F/(m g)]."""
    quantities = _quantities(file)
    limits = ax.get_xlim(), ax.get_ylim()
    draw(ax, points, quantities)
    shapes = looks(points)
    for point in points:
        place = [getattr(point, quantity) for quantity in quantities]
        if colour_of is not None and point.force is not None:
            ax.plot(*place, zorder=6.2, clip_on=False, **shapes[point.series] | {"markerfacecolor": colour_of(point.force)})
    ax.set(xlim=limits[0], ylim=limits[1])


def name_over_map(ax: Axes, file: Plane, points: Sequence[Point]) -> None:
    """Labels at these marks, where space permits; call after everything else is drawn."""
    if points:
        name(ax, points, _quantities(file))


def name(ax: Axes, points: Sequence[Point], quantities: Sequence[str], size: float = 8) -> None:
    """Labels [pt] at marks made by draw(), where space permits."""
    for point in points:
        if point.label:
            x, y = (getattr(point, quantity) for quantity in quantities)
            write_at(ax, x, y, point.label, size)


def _quantities(file: Plane) -> list[str]:
    return [AXES[axis.name] for axis in (file.columns, file.rows)]


def vertical_marks(ax: Axes, points: Sequence[Point]) -> None:
    """Marks of points that have only a frequency."""
    places = np.array([(point.frequency, np.nan) for point in points]).reshape(-1, 2)
    ax.add_line(Line2D(places[:, [0, 0, 1]].ravel(), np.tile([0, 1, np.nan], len(points)), color="#555555", linewidth=0.7,
                       linestyle=(0, (1, 2)), transform=ax.get_xaxis_transform(), zorder=1))
    for point in points:
        if point.label:
            ax.annotate(point.label, (point.frequency, 0.03), xycoords=("data", "axes fraction"), rotation=90,
                        xytext=(-1, 0), textcoords="offset points", ha="right", va="bottom", fontsize=6.5,
                        path_effects=axes.outline(2), zorder=7)
