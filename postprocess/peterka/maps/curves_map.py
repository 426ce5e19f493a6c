"""Boundaries of regimes: the curves of a window, alone, over the coarse map in which they were searched, or over another map.

Folds are solid, period doublings dashed, grazings dotted; letters mark the special points, once for coinciding ones. The
longest curves are labelled with z = p/q of the orbit on the stable side.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..plotting import axes
from ..plotting.classes import CLASSES, INDEX
from ..plotting.picture import picture
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
           "inflection": ("I", "grazing without acceleration")}
COLOURS = {"fold": "#B2182B", "period_doubling": "#2166AC", "grazing": "#1A1A1A"}
MOST_NAMES = 24
APART = 0.06  # of the picture, between two names or letters
SAME_DOT = 0.012  # of the picture: dots closer than this would overlap
TOGETHER = 0.05  # of the picture: special points that share their letters
ASIDE = 0.028  # of the picture, between a point and its letters
FARTHER = (1.0, 1.6, 2.4, 3.6)  # times that, where others are in the way
AROUND = ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1))


@picture(CurvesFile)
def draw(file: CurvesFile, ax: Axes | None = None) -> Axes | None:
    """The curves alone; None without any."""
    return _draw(file, file.lines, ax) if file.curves else None


@picture(CurvesFile)
def draw_over_map(file: CurvesFile, ax: Axes | None = None) -> Axes | None:
    """The curves over the coarse map."""
    return _draw(file, file.lines, ax, over="coarse ") if file.curves else None


@picture(PeterkaFile)
def draw_over_map_of(file: PeterkaFile, ax: Axes | None = None, *, curves: Lines) -> Axes | None:
    """The curves of another file over a map; None where none lies within it."""
    lines = Lines(*within(curves, file.columns, file.rows))
    return _draw(file, lines, ax, over="") if lines.curves else None


def _draw(file, lines, ax, over=None):
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
    taken = _write_names(ax, lines)
    _write_letters(ax, lines, taken)
    axes.write_title(figure, file, "where regimes end", ax=ax)
    return ax


def _look(kind, over_map):
    effects = {"path_effects": axes.outline(1.8)} if over_map else {}
    return LOOKS[kind] | {"color": COLOURS[kind]} | effects


def _in_picture(ax, x, y):
    """Axes coordinates (..., 2), 0 to 1, of data values."""
    return ax.transAxes.inverted().transform(ax.transData.transform(np.stack([x, y], axis=-1)))


def _has_room(place, taken):
    inside = np.all((place > 0.02) & (place < 0.98))
    return inside and not _is_near(place, taken, APART)


def _write_names(ax, lines):
    """Writes z = p/q at the middle of the longest curves, where space permits; returns the occupied positions."""
    taken = []
    ways = [_in_picture(ax, curve.columns, curve.rows) for curve in lines.curves]
    lengths = [float(np.sum(np.hypot(*np.diff(way, axis=0).T))) for way in ways]
    for number in np.argsort(lengths, kind="stable")[::-1][:MOST_NAMES]:
        curve, inside = lines.curves[number], ways[number][np.all((ways[number] > 0) & (ways[number] < 1), axis=1)]
        if not len(inside):
            continue
        place = inside[len(inside) // 2]
        if not _has_room(place, taken):
            continue
        taken.append(place)
        ax.text(*place, f"{curve.impacts}/{curve.period}", transform=ax.transAxes, fontsize=6, ha="center",
                va="center", color=COLOURS[curve.kind], path_effects=axes.outline(1.6))
    return taken


def _write_letters(ax, lines, taken):
    """Draws a dot at each special point, with letters once per group of close points: on the side with the fewest lines, farther
    away where none is free, and in any case somewhere, since the legend tells what they mean."""
    ways = np.concatenate([_in_picture(ax, curve.columns, curve.rows) for curve in lines.curves])
    places = [_in_picture(ax, special.column, special.row) for special in lines.specials]
    dots, groups = [], []  # a group: its position, and the kinds of its points
    for special, place in zip(lines.specials, places):
        if not _is_near(place, dots, SAME_DOT):
            dots.append(place)
            ax.plot(*place, marker=".", markersize=3, color="black", markeredgecolor="white", markeredgewidth=0.3,
                    linestyle="none", transform=ax.transAxes)
        group = next((kinds for middle, kinds in groups if np.hypot(*(place - middle)) < TOGETHER), None)
        if group is None:
            groups.append((place, {special.kind}))
        else:
            group.add(special.kind)
    for place, kinds in groups:
        word = "".join(letter for kind, (letter, _) in LETTERS.items() if kind in kinds)
        at = _place_of_letters(place, word, ways, taken)
        taken.append(at)
        ax.text(*at, word, transform=ax.transAxes, fontsize=6, weight="bold", ha="center", va="center",
                path_effects=axes.outline(1.6))


def _place_of_letters(place, word, ways, taken):
    """Where the letters of a special point stand, in the picture."""
    rings = [[place + away * ASIDE * np.array(side) * [1 + 0.3 * len(word), 1] for side in AROUND] for away in FARTHER]
    for ring in rings:
        free = [at for at in ring if _has_room(at, taken)]
        if free:
            return max(free, key=lambda at: np.min(np.hypot(*(ways - at).T)))
    inside = [np.clip(at, 0.03, 0.97) for ring in rings for at in ring]
    return max(inside, key=lambda at: min(np.hypot(*(at - other)) for other in taken))


def _is_near(place, others, distance):
    return any(np.hypot(*(place - other)) < distance for other in others)
