"""The worst value in each cell's box over the plane of a map, with the best separate places and the box of the best one."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.transforms import Bbox

from ..arrays import Reals, ma
from ..plotting import axes, style, units
from ..plotting.frames import label_of_bar
from ..plotting.notes import write_near_box
from ..plotting.seen import SEEN
from ..maps.field_map import scale_colours
from ..maps.map_file import PeterkaFile
from ..maps.reduce import block_size, largest, with_edges
from .admitted import Quantity
from .drift import Reach
from .places import Place

WIDTH = 3.7  # in
INSIDE = 2  # pixels, between a number and the sides of its box, in all
NOTHING = "#F2F2F2"


@style.using()
def draw(file: PeterkaFile, worst: Reals, places: Sequence[Place], rows: Reach, columns: Reach,
         what: tuple[Quantity, str, str]) -> Figure:
    """The picture as a Figure; `what`: the Quantity, and descriptions of the starts and the drift."""
    quantity, starts, drift = what
    block = block_size(file.shape)
    reduced = with_edges(file, largest(worst, block), block)
    entries = [axes.legend_patch("no such place", _nothing())]
    if file.computed < 1:
        entries.append(axes.legend_patch("not computed yet", None, hatched=True))
    figure, ax, bar_ax = axes.stack(WIDTH, reduced.image, [(entries, 2, None)], bar=True)
    axes.hatch_background(ax)
    _show_computed(ax, file, block)
    factor, unit = units.with_prefix(max(place.worst for place in places), quantity.unit)
    mesh = ax.pcolormesh(reduced.column_edges, reduced.row_edges, ma.masked_invalid(reduced.image) * factor,
                         cmap=scale_colours(), vmin=0, vmax=factor * places[0].worst, rasterized=True)
    axes.label_axes(ax, file)
    bar = figure.colorbar(mesh, cax=bar_ax, orientation="horizontal")
    bar.outline.set_linewidth(0.6)
    bar.set_label(label_of_bar("worst of the box:", f"{quantity.title} ({unit})", " ", WIDTH), fontsize=8)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, "\n".join(filter(None, [axes.operating_point(file), f"{axes.so_far(file)}{starts}; {drift}"])))
    _mark(ax, file, places, rows, columns, quantity)
    return figure


def _show_computed(ax: Axes, file: PeterkaFile, block: int) -> None:
    """Draws a pale background under all computed cells."""
    pieces = [largest(np.where(band["regime"] < 0, np.nan, 0.0), block) for _, band in file.bands(["regime"], block)]
    ground = with_edges(file, np.concatenate(pieces), block)
    ax.pcolormesh(ground.column_edges, ground.row_edges, ma.masked_invalid(ground.image), cmap=ListedColormap([_nothing()]),
                  rasterized=True)


def _nothing() -> str:
    return "#FFFFFF" if style.is_grey() else NOTHING  # which the scale hasn't


def _mark(ax: Axes, file: PeterkaFile, places: Sequence[Place], rows: Reach, columns: Reach, quantity: Quantity) -> None:
    boxes = []
    for number, place in reversed(list(enumerate(places, 1))):
        (left, right), (low, high) = columns.ends(file.columns.values, place.column), rows.ends(file.rows.values, place.row)
        box = Rectangle((left, low), right - left, high - low, fill=False, zorder=5, edgecolor="black",
                        linewidth=1.0 if number == 1 else 0.5, path_effects=axes.outline(2))
        box.set_gid(SEEN)
        boxes.append(ax.add_patch(box).get_window_extent())
        if number > 1:
            _number_within(ax, boxes[-1], str(number))
    best = places[0]
    x, y = file.columns.values[best.column], file.rows.values[best.row]
    ax.plot(x, y, marker="x", markersize=4, markeredgewidth=1.1, color="black", path_effects=axes.outline(2.4), zorder=7)
    write_near_box(ax, boxes[-1], f"{best.z}, {units.amount(best.worst, quantity.unit)}")
    written = {text.get_text() for text in ax.texts}
    for number, extent in enumerate(reversed(boxes), 1):  # numbers that are larger than their box
        if number > 1 and str(number) not in written:
            write_near_box(ax, extent, str(number), (6.5, 5))


def _number_within(ax: Axes, box: Bbox, number: str) -> None:
    """Writes a number into its box where it is smaller than that."""
    middle = ax.transAxes.inverted().transform((box.min + box.max) / 2)
    text = ax.text(*middle, number, transform=ax.transAxes, ha="center", va="center", fontsize=6.5, path_effects=axes.outline(1.6), zorder=6,
                   clip_on=True)
    own = text.get_window_extent()
    if own.width > box.width - INSIDE or own.height > box.height - INSIDE:
        text.remove()
