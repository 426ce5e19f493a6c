"""A note beside a point of a map, where it has room: inside the axes, over no other text and over no mark that is to be
seen; else further away, with a line to its point. Where there is no room at all it is left out."""

from itertools import product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.text import Annotation, Text

from . import seen
from .axes import outline

AWAY = 8  # pt
AIR = 2  # pixels
FRAME = 0.5  # of the size of letters
PLACES = np.linspace(0.03, 0.97, 5)  # in the axes, where there is no room beside the point
MORE_PLACES = np.linspace(0.02, 0.98, 21)  # for small letters


def write_beside(ax: Axes, x: float, y: float, text: str) -> None:
    """Once the layout is made; on the side of the point where the picture has more room."""
    across, up = ax.transAxes.inverted().transform(ax.transData.transform((x, y)))
    right, above = (1 if across < 0.5 else -1), (1 if up < 0.5 else -1)
    sides = [(right, above), (right, -above), (-right, above), (-right, -above)]
    taken = [*(_box(other) for other in ax.texts), *seen.boxes(ax)]
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
    for size, places in ((8, PLACES), (6.5, PLACES), (5, PLACES), (5, MORE_PLACES)):
        note.set(fontsize=size)
        free = _first_free(_box(note), ax, places, taken)
        if free is not None:
            across, up = free
            return note.set(position=free, ha=("left", "center", "right")[round(2 * across)],
                            va=("bottom", "center", "top")[round(2 * up)])
    note.remove()


def _first_free(box, ax, places, taken):
    """(across, up) of the first of these places at which a box of this size has room; None without one."""
    anchors = np.array(list(product(places, places)))
    size, start = np.array([box.width, box.height]), np.array([ax.bbox.x0, ax.bbox.y0])
    low = start + anchors * [ax.bbox.width, ax.bbox.height] - np.round(2 * anchors) / 2 * size
    high = low + size
    within = np.all((low >= start + AIR) & (high <= [ax.bbox.x1 - AIR, ax.bbox.y1 - AIR]), axis=1)
    others = np.array([[other.x0, other.y0, other.x1, other.y1] for other in taken]).reshape(-1, 1, 4)
    meets = np.all((low < others[..., 2:]) & (high > others[..., :2]), axis=2).any(axis=0)
    free = np.flatnonzero(within & ~meets)
    return tuple(anchors[free[0]]) if free.size else None


def _has_room(note, ax, taken):
    box, inside = _box(note), ax.bbox
    within = inside.x0 + AIR <= box.x0 and box.x1 <= inside.x1 - AIR and inside.y0 + AIR <= box.y0 and (
        box.y1 <= inside.y1 - AIR)
    return within and not any(box.overlaps(other) for other in taken)


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
