"""The Peterka map: the class of z = p/q over Omega/omega and gap/A0 (the paper's Fig. 22), or over any other axes.

On the dashed line the hammer's free swing grazes the stop in steady state, gap/A0 = P, where P is the amplitude of the free
hammer relative to the cart, P = r^2 / sqrt((1 - r^2)^2 + (2 zeta r)^2), r = Omega/omega. Below it every orbit has impacts;
above it impacting orbits may persist. It needs the root attribute damping_ratio, over other axes the job.

White dots mark cells with chatter: on a rigid stop, an infinite sequence of ever smaller impacts that ends in sticking and
counts as one impact. Dots are used because lines across a class look like stripes of another class.
"""

import numpy as np
from contourpy import contour_generator
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import Bbox

from ..arrays import Integers, Reals
from ..files.job_numbers import UnreadableJob, edge_of_no_impact, swing_of, tables_of
from ..plotting import axes, style
from ..plotting.classes import CLASSES, INDEX
from ..plotting.fills import fill
from ..plotting.notes import write_near_box
from ..plotting.picture import picture
from ..measurements import marks
from ..measurements.points import NOTHING_MEASURED, Measurements
from .map_file import Axis, PeterkaFile
from .reduce import Reduced, class_picture, orbit_picture

WIDTH = 3.7  # in
SMALL, MOST_SMALL, AWAY = 0.012, 8, 14  # smallest window of the picture in which a small area is named, how many are, and how far away [pt]
LINE_POINTS = 2000
CONTOUR_POINTS = 600  # along each axis
DOTS = 48  # along a side
CHATTER_LOOK = {"marker": "o", "markersize": 1.7, "color": "white", "markeredgecolor": "black", "markeredgewidth": 0.3,
                "linestyle": "none", "clip_on": False}
EDGE_LOOK = {"color": "black", "linewidth": 0.8, "linestyle": (0, (4, 2)), "path_effects": axes.outline(1.4)}


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None, *, measured: Measurements = NOTHING_MEASURED) -> Axes:
    """The map of a map file, as Axes, with the share of each class in its legend, and measured points."""
    reduced, counts = orbit_picture(file, ["regime", "impacts", "period"])
    orbits, regimes = legend_entries(counts, file.observed_chaos)
    chatter, chatter_entry = _chatter(file)
    edge = _edge_of_no_impact(file)
    grazing = [Line2D([], [], label="free swing grazes the stop", **EDGE_LOOK)] if edge else []
    others = regimes + chatter_entry + grazing + marks.handles(measured.points)
    legends = [(orbits, 3, f"$z = p/q$ (share of the {file.whole})"), (others, 2, None)]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, legends, ax=ax)
    axes.show_classes(ax, reduced, [entry.colour for entry in CLASSES], INDEX["not computed yet"])
    axes.label_axes(ax, file)
    if chatter:
        ax.plot(*_dots(chatter), **CHATTER_LOOK)
    for line in edge:
        ax.plot(*line.T, **EDGE_LOOK)
    if measured.points:
        marks.draw_over_map(ax, file, measured.points)
    axes.name_areas(ax, reduced, _names_to_write(counts))
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, axes.operating_point(file), ax=ax)
    marks.name_over_map(ax, file, measured.points)
    if style.is_grey():
        _name_small_areas(ax, reduced, counts)
    return ax


def _name_small_areas(ax: Axes, reduced: Reduced, counts: Integers) -> None:
    """Names the areas of hatched classes that are too small for a name within, where no hatching would be legible: beside them, with a
    line to each, the commonest first."""
    written = {text.get_text() for text in ax.texts}
    waiting = [n for n in np.argsort(-counts, kind="stable") if counts[n] and CLASSES[n].orbit and fill(CLASSES[n].colour).hatch
               and CLASSES[n].label not in written]
    for n in waiting[:MOST_SMALL]:
        window = axes.largest_window(reduced.image == n, np.zeros(reduced.image.shape, dtype=bool), SMALL, 0.9)
        if window is None:
            continue
        (left, right), (low, high) = window
        middle = ax.transData.transform([(reduced.column_edges[left] + reduced.column_edges[right]) / 2,
                                         (reduced.row_edges[low] + reduced.row_edges[high]) / 2])
        write_near_box(ax, Bbox([middle - 1, middle + 1]), CLASSES[n].label, (6.5, 5), AWAY)


def _names_to_write(counts: Integers) -> dict[int, tuple[str, str]]:
    named = {n: (entry.label, entry.colour) for n, entry in enumerate(CLASSES) if counts[n] and entry.orbit}
    if counts[INDEX["no impact"]]:
        named[INDEX["no impact"]] = ("no impact", CLASSES[INDEX["no impact"]].colour)
    return named


def legend_entries(counts: Integers, observed_chaos: tuple[int, int] | None) -> tuple[list[Patch], list[Patch]]:
    """Legend entries of the classes that occur: orbits p/q, and the others. `counts`: cells of each class; the entry for
    chaos states the observed cycles, (fewest, most) or None."""
    orbits: list[Patch] = []
    regimes: list[Patch] = []
    for n in np.flatnonzero(counts):
        entry, share = CLASSES[n], axes.percent(counts[n] / counts.sum())
        label = entry.label
        if n == INDEX["chaotic"] and observed_chaos:
            cycles = "–".join(f"{count:,}" for count in sorted(set(observed_chaos)))
            label = f"chaotic for {cycles} cycles"
        key = axes.legend_patch(f"{label} ({share})", entry.colour, n == INDEX["not computed yet"])
        (orbits if entry.orbit or n == INDEX["other p/q"] else regimes).append(key)
    return orbits, regimes


def _chatter(file: PeterkaFile) -> tuple[Reduced | None, list[Artist]]:
    """Reduced mask of the cells with chatter, and its legend entries; (None, []) without such cells."""
    if not file.has_chatter:
        return None, []
    reduced, counts = class_picture(file, ["regime", "chatter"], lambda _, chatter: np.isin(chatter, 1), 2)
    if not counts[1]:
        return None, []
    return reduced, [Line2D([], [], label=f"chatter ({axes.percent(counts[1] / counts.sum())})",
                            **CHATTER_LOOK | {"markersize": 3.5})]


def _dots(reduced: Reduced) -> tuple[Reals, Reals]:
    """(x, y) of one dot per block of the plane with such a cell: at the cell nearest to the block's centre."""
    shape = np.array(reduced.image.shape)
    cells = np.argwhere(reduced.image != 0)
    blocks = (cells * DOTS) // shape
    away = np.sum(((cells + 0.5) * DOTS / shape - blocks - 0.5) ** 2, axis=1)
    order = np.argsort(away, kind="stable")
    _, first = np.unique(blocks[order] @ [DOTS, 1], return_index=True)
    row, column = cells[order][first].T
    middles = [(edges[1:] + edges[:-1]) / 2 for edges in (reduced.column_edges, reduced.row_edges)]
    return middles[0][column], middles[1][row]


def _edge_of_no_impact(file: PeterkaFile) -> list[Reals]:
    """The line in axes coordinates, as arrays (n, 2); [] if there is none in the picture, or the file lacks the required numbers."""
    across, up = file.columns, file.rows
    if (across.name, up.name) == ("frequency_ratio", "gap_ratio"):
        damping_ratio = file.number("damping_ratio")
        if damping_ratio is None or damping_ratio < 0:
            return []
        ratio = _along(across, LINE_POINTS)
        edge = edge_of_no_impact(ratio, damping_ratio)
        # Far above the picture the line is irrelevant, and its peak of 1/(2 zeta) would disturb the scale.
        line = np.column_stack([ratio, np.where(edge <= 2 * up.edges[-1], edge, np.nan)])
        return [line] if edge.min() <= up.edges[-1] and edge.max() >= up.edges[0] else []
    x, y = _along(across, CONTOUR_POINTS), _along(up, CONTOUR_POINTS)
    try:
        room = swing_of(tables_of(file.data.attribute("job")), {across.name: x[None, :], up.name: y[:, None]}).room()
    except UnreadableJob:
        return []
    found: list[Reals] = contour_generator(x, y, np.broadcast_to(np.maximum(room, -1e9), (len(y), len(x)))).lines(0.0)
    return found


def _along(axis: Axis, points: int) -> Reals:
    low, high = axis.edges[[0, -1]]
    values: Reals = np.geomspace(low, high, points) if axis.log else np.linspace(low, high, points)
    return values
