"""Boundaries of regimes: the curves of a window, alone, over the coarse map in which they were searched, or over another map.

Folds are solid, period doublings dashed, grazings dotted; letters mark the special points, once for coinciding ones. The
longest curves are labelled with z = p/q of the orbit on the stable side, or no impact, where no other curve lies beneath the name.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Reals
from ..files.regimes import NAMES, NO_IMPACT
from ..plotting import axes
from ..plotting.classes import CLASSES, INDEX
from ..plotting.notes import write_at_group, write_on
from ..plotting.picture import picture
from ..plotting.seen import SEEN
from .curves_file import CurvesFile, Lines, within
from .map_file import PeterkaFile
from .peterka_map import WIDTH, legend_entries
from .reduce import orbit_picture

LOOKS = {
    "fold": {"linestyle": "-", "linewidth": 1.0},
    "period_doubling": {"linestyle": (0, (4, 1.6)), "linewidth": 0.9},
    "grazing": {"linestyle": (0, (1, 1.1)), "linewidth": 0.9},
}
WORDS = {"fold": "fold: the orbit is born or ends", "period_doubling": "period doubling",
         "grazing": "grazing: an impact is gained or lost"}
LETTERS = {"fold_grazing": ("F", "fold with grazing"), "flip_grazing": ("P", "period doubling with grazing"),
           "double_grazing": ("G", "two grazings"), "cusp": ("C", "cusp: two folds meet"),
           "inflection": ("I", "grazing without acceleration"), "generalized_flip": ("D", "generalized period doubling")}
COLOURS = {"fold": "#B2182B", "period_doubling": "#2166AC", "grazing": "#1A1A1A"}
MOST_NAMES, NAME_SIZES = 24, (6, 5)  # pt
PLATE = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "boxstyle": "square,pad=0.1"}  # behind a name over a map
STEP = 4.0  # pixels
SAME_DOT = 0.012  # of the picture: dots closer than this would overlap
TOGETHER = 0.05  # of the picture: special points that share their letters


@picture(CurvesFile)
def draw(file: CurvesFile, ax: Axes | None = None) -> Axes | None:
    """The curves alone; None without any."""
    return _draw(file, file.lines, ax) if file.curves else None


@picture(CurvesFile)
def draw_over_map(file: CurvesFile, ax: Axes | None = None) -> Axes:
    """The curves, if any were found, over the coarse map."""
    return _draw(file, file.lines, ax, over="coarse ")


@picture(PeterkaFile)
def draw_over_map_of(file: PeterkaFile, ax: Axes | None = None, *, curves: Lines) -> Axes | None:
    """The curves of another file over a map; None where none lies within it."""
    lines = Lines(*within(curves, file.columns, file.rows))
    return _draw(file, lines, ax, over="") if lines.curves else None


def _draw(file: PeterkaFile, lines: Lines, ax: Axes | None, over: str | None = None) -> Axes:
    """`over`: what the map is beneath the curves, before its name; None for curves alone."""
    over_map = over is not None
    reduced, counts = orbit_picture(file, ["regime", "impacts", "period"])
    kinds = [kind for kind in WORDS if any(curve.kind == kind for curve in lines.curves)]
    curves = [Line2D([], [], label=WORDS[kind], **_look(kind, over_map)) for kind in kinds]
    specials = [kind for kind in LETTERS if any(special.kind == kind for special in lines.specials)]
    letters = [Line2D([], [], linestyle="none", marker=rf"$\mathbf{{{LETTERS[kind][0]}}}$", markersize=5, color="black",
                      markeredgewidth=0, label=LETTERS[kind][1]) for kind in specials]
    legends = [(curves, 1, None), (letters, 2, "special points (several letters: several together)")]
    if over_map:
        orbits, regimes = legend_entries(counts, file.observed_chaos)
        legends = [(orbits, 3, f"$z = p/q$ (share of the {over}{file.whole})"), (regimes, 2, None), *legends]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, legends, ax=ax)
    if over_map:
        axes.show_classes(ax, reduced, [entry.colour for entry in CLASSES], INDEX["not computed yet"])
    axes.label_axes(ax, file)
    for curve in lines.curves:
        ax.plot(curve.columns, curve.rows, **_look(curve.kind, over_map))
    axes.write_title(figure, file, "where regimes end" if lines.curves else "where regimes end: no curve was found", ax=ax)
    groups, ways = _draw_dots(ax, lines), [_pixels(ax, curve.columns, curve.rows) for curve in lines.curves]
    _write_names(ax, lines, ways, over_map)
    _write_letters(ax, groups, ways)
    return ax


def _look(kind: str, over_map: bool) -> dict[str, Any]:
    effects = {"path_effects": axes.outline(1.5)} if over_map else {}
    return LOOKS[kind] | {"color": COLOURS[kind]} | effects


def _pixels(ax: Axes, x: Reals | float, y: Reals | float) -> Reals:
    """Pixels (..., 2) of data values."""
    values: Reals = ax.transData.transform(np.stack([x, y], axis=-1))
    return values


def _draw_dots(ax: Axes, lines: Lines) -> list[tuple[Reals, set[str]]]:
    """A dot at each special point; those that would overlap share one. Returns the groups of points that share their letters:
    (points (n, 2) in pixels, kinds) each."""
    size = np.array([ax.bbox.width, ax.bbox.height])
    dots: list[Reals] = []
    groups: list[tuple[list[Reals], set[str]]] = []
    for special in lines.specials:
        place = _pixels(ax, special.column, special.row)
        if not any(_is_near(place, dot, SAME_DOT * size) for dot in dots):
            dots.append(place)
            ax.plot(special.column, special.row, marker=".", markersize=3, color="black", markeredgecolor="white", markeredgewidth=0.3,
                    linestyle="none", gid=SEEN)
        near = next((group for group in groups if _is_near(place, group[0][0], TOGETHER * size)), None)
        if near is None:
            near = [], set()
            groups.append(near)
        near[0].append(place)
        near[1].add(special.kind)
    return [(np.array(points), kinds) for points, kinds in groups]


def _is_near(place: Reals, other: Reals, distance: Reals) -> bool:
    return float(np.hypot(*((place - other) / distance))) < 1


def _write_names(ax: Axes, lines: Lines, ways: Sequence[Reals], over_map: bool) -> None:
    """Writes the motion's name on each of the longest curves, as near to its middle as it has room; `ways`: those of the curves. Over the
    colours of a map it is black on white."""
    lengths = [float(np.sum(np.hypot(*np.diff(way, axis=0).T))) for way in ways]
    dense = [_dense(way) for way in ways]
    for number in np.argsort(lengths, kind="stable")[::-1][:MOST_NAMES]:
        curve = lines.curves[number]
        look: dict[str, Any] = {"bbox": PLATE} if over_map else {"color": COLOURS[curve.kind], "path_effects": axes.outline(1.6)}
        others = np.concatenate([np.zeros((0, 2)), *(way for other, way in enumerate(dense) if other != number)])
        write_on(ax, dense[number], name_of(curve.impacts, curve.period), NAME_SIZES, others, look)


def _dense(way: Reals) -> Reals:
    """A line through points, (n, 2) [pixels], with points STEP apart at most."""
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(way, axis=0).T)))
    fine = np.union1d(along, np.arange(0.0, along[-1], STEP))
    return np.column_stack([np.interp(fine, along, one) for one in way.T])


def _write_letters(ax: Axes, groups: Sequence[tuple[Reals, set[str]]], ways: Sequence[Reals]) -> None:
    """Writes letters once per group of close points: beside it on the side with the fewest lines, or farther away with a line to it."""
    for points, kinds in groups:
        write_at_group(ax, points, "".join(letter for kind, (letter, _) in LETTERS.items() if kind in kinds), 6, np.concatenate(ways))


def name_of(impacts: int, period: int) -> str:
    """An orbit of a curve in words: p/q, or no impact."""
    return f"{impacts}/{period}" if impacts else NAMES[NO_IMPACT]
