"""A note beside a point of a map, where it has room: inside the axes, over no other text and over no mark that is to be
seen."""

from itertools import product

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

from .axes import outline

AWAY = 8  # pt
AIR = 2  # pixels
FRAME = 0.5  # of the size of letters
SEEN = "a mark to be seen"  # the gid of such lines
PLACES = (0.03, 0.27, 0.5, 0.73, 0.97)  # in the axes, where there is no room beside the point


def write_beside(ax, x, y, text):
    """Once the layout is made; on the side of the point where the picture has more room."""
    across, up = ax.transAxes.inverted().transform(ax.transData.transform((x, y)))
    right, above = (1 if across < 0.5 else -1), (1 if up < 0.5 else -1)
    sides = [(right, above), (right, -above), (-right, above), (-right, -above)]
    taken = [*(_box(other) for other in ax.texts), *_marks(ax)]
    note = ax.annotate(text, (x, y), xytext=(0, 0), textcoords="offset points",
                       path_effects=outline(2.4), zorder=7)
    for right, above in sides:
        note.set(position=(AWAY * right, AWAY * above), ha="left" if right > 0 else "right",
                 va="bottom" if above > 0 else "top")
        if _has_room(note, ax, taken):
            return
    note.remove()
    _write_apart(ax, x, y, text, taken)


def _write_apart(ax, x, y, text, taken):
    note = ax.annotate(text, (x, y), xycoords="data", xytext=(0, 0), textcoords="axes fraction",
                       path_effects=outline(2.4), zorder=7,
                       arrowprops={"arrowstyle": "-", "linewidth": 0.6})
    for size in (8, 6.5, 5):
        for across, up in product(PLACES, PLACES):
            note.set(position=(across, up), fontsize=size, ha=("left", "center", "right")[round(2 * across)],
                     va=("bottom", "center", "top")[round(2 * up)])
            if _has_room(note, ax, taken):
                return


def _has_room(note, ax, taken):
    box, inside = _box(note), ax.bbox
    within = inside.x0 + AIR <= box.x0 and box.x1 <= inside.x1 - AIR and inside.y0 + AIR <= box.y0 and (
        box.y1 <= inside.y1 - AIR)
    return within and not any(box.overlaps(other) for other in taken)


def _marks(ax):
    """Boxes of the marks that are to be seen."""
    half = 0.75 / 72 * ax.get_figure().dpi
    return [Bbox([place - half * line.get_markersize(), place + half * line.get_markersize()])
            for line in ax.lines if line.get_gid() == SEEN for place in ax.transData.transform(line.get_xydata())]


def _box(text):
    """Of the letters alone: an annotation's own has its arrow, too. With the air that a frame has."""
    if isinstance(text, Annotation):
        text.update_positions(_renderer(text))
    box = Text.get_window_extent(text, _renderer(text))
    frame = 0 if text.get_bbox_patch() is None else FRAME * text.get_fontsize() / 72 * text.get_figure().dpi
    return box.padded(frame)


def _renderer(text):
    figure = text.get_figure()
    if hasattr(figure.canvas, "get_renderer"):
        return figure.canvas.get_renderer()
    return RendererAgg(*np.ceil(figure.bbox.size), figure.dpi)  # of a figure that nobody has shown yet
