"""Marks of measured points over pictures: one per series, distinguishable without colour, with bars for standard errors.
Over a map of forces a mark has the colour of the measured force. Over a map marks of one place stand side by side, around it; bars are at
the place itself."""

from collections.abc import Sequence, Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.transforms import ScaledTranslation, Transform

from ..plotting import axes
from ..plotting.drawn import Plane
from ..plotting.notes import write_at
from ..plotting.seen import SEEN
from .points import AXES, Point

SHAPES, FACES = "Dos^vP<>", ("white", "black", "#AAAAAA")  # 24 pairs
EDGE = {"markersize": 5, "markeredgecolor": "black", "markeredgewidth": 0.9, "linestyle": "none"}
BARS = {"ecolor": "black", "elinewidth": 0.9, "capsize": 2, "fmt": "none"}
NAMELESS = "measured"
ONE_PLACE = 0.01  # of the picture: marks that are nearer would hide one another
ASIDE = 6.0  # pt, from mark to mark of one place


def handles(points: Sequence[Point]) -> list[Line2D]:
    """Legend entries: one per series."""
    return [Line2D([], [], label=name or NAMELESS, **look) for name, look in looks(points).items()]


def looks(points: Sequence[Point]) -> dict[str, dict[str, Any]]:
    """{series: properties of its mark}, in order of occurrence."""
    names = list(dict.fromkeys(point.series for point in points))
    return {name: EDGE | {"marker": SHAPES[number % len(SHAPES)], "markerfacecolor": FACES[number // len(SHAPES)]}
            for number, name in enumerate(names)}


def draw(ax: Axes, points: Sequence[Point], quantities: Sequence[str], everyone: Sequence[Point] | None = None,
         zorder: float = 6.0, aside: float = 0.0) -> None:
    """Marks of `points` at two of their quantities, horizontal and vertical, or `aside` of there [pt]; `everyone`: all points that
    determine the marks' looks."""
    for name, look in looks(everyone or points).items():
        own = [point for point in points if point.series == name]
        if not own:  # matplotlib cannot lay out an empty line
            continue
        x, y = ([getattr(point, quantity) for point in own] for quantity in quantities)
        errors = [[point.errors.get(quantity, 0.0) for point in own] for quantity in quantities]
        if np.any(errors):
            ax.errorbar(x, y, xerr=errors[0] if any(errors[0]) else None, yerr=errors[1] if any(errors[1]) else None,
                        zorder=zorder - 0.1, **BARS)
        ax.plot(x, y, zorder=zorder, clip_on=False, gid=SEEN, transform=_moved(ax, aside), **look)


def draw_over_map(ax: Axes, file: Plane, points: Sequence[Point], colour_of: Callable[[float], Any] | None = None) -> None:
    """Marks over the plane of a map; `colour_of` gives the colour for a force [F/(m g)]."""
    quantities = _quantities(file)
    limits = ax.get_xlim(), ax.get_ylim()
    shapes, moved = looks(points), _side_by_side(ax, points, quantities)
    for aside in sorted(set(moved)):
        draw(ax, [point for point, own in zip(points, moved) if own == aside], quantities, points, aside=aside)
    for point, aside in zip(points, moved):
        place = [getattr(point, quantity) for quantity in quantities]
        if colour_of is not None and point.force is not None:
            ax.plot(*place, zorder=6.2, clip_on=False, transform=_moved(ax, aside),
                    **shapes[point.series] | {"markerfacecolor": colour_of(point.force)})
    ax.set(xlim=limits[0], ylim=limits[1])


def _side_by_side(ax: Axes, points: Sequence[Point], quantities: Sequence[str]) -> list[float]:
    """How far each mark is moved to the right [pt], so that those of one place stand side by side, in the order of the points."""
    places = (ax.transScale + ax.transLimits).transform([[getattr(point, quantity) for quantity in quantities] for point in points])
    groups: list[list[int]] = []
    for number, place in enumerate(places):
        near = [group for group in groups if np.hypot(*(places[group[0]] - place)) < ONE_PLACE]
        if near:
            near[0].append(number)
        else:
            groups.append([number])
    moved = np.zeros(len(points))
    for group in groups:
        moved[group] = ASIDE * (np.arange(len(group)) - (len(group) - 1) / 2)
    return [float(aside) for aside in moved]


def _moved(ax: Axes, aside: float) -> Transform:
    """From data to the place so far to the right [pt]."""
    return ax.transData + ScaledTranslation(aside / 72, 0, ax.get_figure().dpi_scale_trans) if aside else ax.transData


def name_over_map(ax: Axes, file: Plane, points: Sequence[Point]) -> None:
    """Labels at these marks, where space permits; call after everything else is drawn."""
    if points:
        quantities = _quantities(file)
        name(ax, points, quantities, moved=_side_by_side(ax, points, quantities))


def name(ax: Axes, points: Sequence[Point], quantities: Sequence[str], size: float = 8, moved: Sequence[float] = ()) -> None:
    """Labels [pt] at marks made by draw(), where space permits; `moved`: how far each is moved to the right [pt]."""
    for point, aside in zip(points, moved or [0.0] * len(points)):
        if point.label:
            place = _moved(ax, aside).transform([getattr(point, quantity) for quantity in quantities])
            x, y = ax.transData.inverted().transform(place)
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
