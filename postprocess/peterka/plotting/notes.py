"""Places a note beside a point of a picture where it fits: inside the axes, over no other text and no visible mark;
otherwise farther away, with a line to its point. Without any free space it is omitted.

A label of one of several points never goes far: it stays nearer to its own point than to any other. Nor does that of a box,
which it never covers."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

from ..arrays import Reals
from . import seen
from .axes import outline

AWAY = 8  # pt
ABOVE = 7  # the zorder of a note: marks are below it
HALO = 3.0  # pt, of a note's letters: those of neighbours meet, and no dark colour shows between them
LETTER_HALO = 1.6  # pt, of the label of one of several marks: a wider one hides the others
LINE_HALO = 1.8  # pt, of the line to a mark
NEAR = (5, 9, 14, 20)  # pt: of a label from its point; with a line beyond LINED, from a box beyond LINED_BOX
LINED, LINED_BOX = 9, 4
CLEAR = 5  # pt: by which the label of a box without a line to it is nearer to that box than to any other
BESIDE = (3, *NEAR, 28, 38, 50, 65)  # pt: of the label of several marks that share one
ROUND = [(across, up) for across in (1, -1, 0) for up in (0, 1, -1) if (across, up) != (0, 0)]
AIR, ROUNDING = 2, 1e-6  # pixels
APART, LETTER_APART = 5, 1.2  # pt: at least, between a line's name or the letters of marks and any other text or mark
FRAME = 0.5  # of the font size
TURNS = 24  # directions in which a place around a box is sought
TO_MARK, STEPS = "a line from a note to its mark", 60  # its gid, and points by which it is told whether it crosses something
PLACES = np.linspace(0.03, 0.97, 5)  # in the axes, tried if nothing fits beside the point
MORE_PLACES = np.linspace(0.02, 0.98, 21)  # for small text


def write_beside(ax: Axes, x: float, y: float, text: str) -> None:
    """Writes the note, after the layout is computed, on the side of the point with more space."""
    across, up = ax.transAxes.inverted().transform(ax.transData.transform((x, y)))
    right, above = (1 if across < 0.5 else -1), (1 if up < 0.5 else -1)
    sides = [(right, above), (right, -above), (-right, above), (-right, -above)]
    taken = _taken(ax, seen.boxes(ax))
    note = ax.annotate(text, (x, y), xytext=(0, 0), textcoords="offset points",
                       path_effects=outline(HALO), zorder=ABOVE)
    for right, above in sides:
        note.set(position=(AWAY * right, AWAY * above), ha="left" if right > 0 else "right",
                 va="bottom" if above > 0 else "top")
        if _has_room(note, ax, taken):
            return
    note.remove()
    _write_apart(ax, x, y, text, taken)


def write_at(ax: Axes, x: float, y: float, text: str, size: float = 8) -> bool:
    """Writes the label of one of several marks, after all marks are drawn: close to its own, on whichever side it fits, or
    smaller. Returns whether it fits."""
    pixels = ax.get_figure().dpi / 72
    own = ax.transData.transform((x, y))
    marks = seen.boxes(ax)
    taken = _taken(ax, marks)
    others = (marks[:, :2] + marks[:, 2:]) / 2
    others = others[np.linalg.norm(others - own, axis=1) > AIR]
    note = ax.annotate(text, (x, y), xytext=(0, 0), textcoords="offset points", path_effects=outline(LETTER_HALO), zorder=ABOVE)
    for letters in sorted({size, 6.5, 5}, reverse=True):
        note.set_fontsize(min(letters, size))
        box = _box(note)
        for away in NEAR:
            for across, up in ROUND:
                place = own + pixels * away * np.array([across, up]) / np.hypot(across, up)
                low = place - [box.width * (1 - across) / 2, box.height * (1 - up) / 2]
                moved = Bbox([low, low + [box.width, box.height]])
                if _fits(moved, ax, taken) and (away > LINED or _is_nearest(moved, own, others)):
                    note.set(position=(place - own) / pixels, ha={1: "left", -1: "right", 0: "center"}[across],
                             va={1: "bottom", -1: "top", 0: "center"}[up])
                    if away > LINED:
                        _draw_line(ax, own, moved)
                    return True
    note.remove()
    return False


def write_at_group(ax: Axes, points: Reals, text: str, size: float, lines: Reals) -> bool:
    """Writes the label of marks that share one, (n, 2) [pixels], after all marks are drawn: near to one of these, on the side farthest
    from `lines`, (m, 2) [pixels], nearer to them than to other marks, or farther away with a line to one. Returns whether it fits."""
    pixels = ax.get_figure().dpi / 72
    marks = seen.boxes(ax)
    taken, others = _taken(ax, marks), (marks[:, :2] + marks[:, 2:]) / 2
    others = others[np.min(np.linalg.norm(others[:, None] - points, axis=2), axis=1, initial=np.inf) > AIR]
    note = ax.text(0, 0, text, transform=ax.transAxes, fontsize=size, weight="bold", ha="left", va="bottom",
                   path_effects=outline(LETTER_HALO), zorder=ABOVE)
    for letters in (size, 5):
        note.set_fontsize(letters)
        box = np.array([_box(note).width, _box(note).height])
        for away in BESIDE:
            free = []
            for own, (across, up) in product(points, ROUND):
                place = own + pixels * away * np.array([across, up]) / np.hypot(across, up)
                low = place - box * (1 - np.array([across, up])) / 2
                moved = Bbox([low, low + box])
                if _fits(moved.padded(pixels * LETTER_APART), ax, taken) and (away > LINED or _is_nearest(moved, points, others)):
                    free.append((float(np.min(np.linalg.norm(lines - (low + box / 2), axis=1), initial=np.inf)), own, moved))
            if free:
                _, own, moved = max(free, key=lambda each: each[0])
                note.set_position(ax.transAxes.inverted().transform(moved.min))
                if away > LINED:
                    _draw_line(ax, own, moved)
                return True
    note.remove()
    return False


def write_on(ax: Axes, way: Reals, text: str, sizes: Sequence[float], others: Reals, look: Mapping[str, Any]) -> bool:
    """Writes the name of a line, (n, 2) [pixels], on it, as near to its middle as it meets no other text, no mark and none of the `others`,
    points of other lines, (m, 2) [pixels], so that it can't be taken for theirs; smaller where it has to. `look`: properties of the text.
    Returns whether it fits."""
    pixels, taken = ax.get_figure().dpi / 72, _taken(ax, seen.boxes(ax))
    note = ax.text(0, 0, text, transform=ax.transAxes, ha="left", va="bottom")
    inside = way[np.all((way > ax.bbox.min) & (way < ax.bbox.max), axis=1)]
    for size in sizes:
        note.set_fontsize(size)
        box = np.array([_box(note).width, _box(note).height])
        for at in sorted(range(len(inside)), key=lambda at: abs(at - len(inside) // 2)):
            low = inside[at] - box / 2
            place = Bbox([low, low + box])
            if _fits(place.padded(pixels * APART), ax, taken) and not _meets(others, place):
                note.set(position=ax.transAxes.inverted().transform(low), **look)
                return True
    note.remove()
    return False


def write_near_box(ax: Axes, box: Bbox, text: str, sizes: Sequence[float] = (8, 6.5, 5), nearest: float = 0) -> bool:
    """Writes the label of a box of the picture [pixels], after the layout is computed: beside it, over no other text, and over
    no other mark where there is room; smaller, or up to 65 pt away with a line to it, which crosses none of these, where it has to.
    `nearest`: not nearer than so many pt. Returns whether it fits."""
    pixels = ax.get_figure().dpi / 72
    texts, lines = _taken(ax, np.array([box.extents])), _lines_to_marks(ax)
    note = ax.text(0, 0, text, transform=ax.transAxes, ha="left", va="bottom", path_effects=outline(HALO), zorder=ABOVE)
    marks = np.array([mark for mark in seen.boxes(ax) if not np.allclose(mark, box.extents, atol=AIR)]).reshape(-1, 4)
    for taken in (np.concatenate([texts, marks]), texts):
        for letters in sizes:
            note.set_fontsize(letters)
            size = _box(note)
            for away in (each for each in BESIDE if each >= nearest):
                for moved in _around(box, size.width, size.height, pixels * away, ax.bbox):
                    own = np.clip(moved.min + [size.width / 2, size.height / 2], box.min, box.max)
                    line = np.linspace(own, np.clip(own, moved.min, moved.max), STEPS)[STEPS * (away <= LINED_BOX):]
                    bad = _crosses(line[2:], taken[1:], lines) if len(line) else _away(marks, moved).min(initial=np.inf) < pixels * CLEAR + (
                        _away(box.extents[None], moved)[0])
                    if not bad and _fits(moved, ax, taken) and not _meets(lines, moved):
                        note.set_position(ax.transAxes.inverted().transform(moved.min))
                        if len(line):
                            _draw_line(ax, own, moved)
                        return True
    note.remove()
    return False


def _lines_to_marks(ax: Axes) -> Reals:
    """Points of the lines from notes to their marks [pixels], (n, 2)."""
    ends = [ax.transData.transform(line.get_xydata()) for line in ax.lines if line.get_gid() == TO_MARK]
    return np.concatenate([np.zeros((0, 2)), *(np.linspace(begin, end, STEPS) for begin, end in ends)])


def _away(boxes: Reals, box: Bbox) -> Reals:
    """Distances of boxes, a row [left, bottom, right, top] each, from a box."""
    values: Reals = np.linalg.norm(np.maximum(0, np.maximum(boxes[:, :2] - box.max, box.min - boxes[:, 2:])), axis=1)
    return values


def _meets(points: Reals, box: Bbox) -> bool:
    return bool(np.any(np.all((points >= box.min - AIR) & (points <= box.max + AIR), axis=1)))


def _crosses(line: Reals, boxes: Reals, others: Reals) -> bool:
    """Whether a line, as points, meets one of these boxes or other lines."""
    near = len(others) and np.min(np.linalg.norm(line[:, None] - others, axis=2)) < AIR
    return bool(near) or any(_meets(line, Bbox(box.reshape(2, 2))) for box in boxes)


def _around(box: Bbox, width: float, height: float, away: float, inside: Bbox) -> Iterator[Bbox]:
    """Places of this size at a distance from a box: above, below and at its sides, as far as the picture has room there, and all
    around it."""
    def along(low: float, high: float, length: float, first: float, last: float) -> float:
        return min(max((low + high - length) / 2, first + AIR), last - AIR - length)

    x = along(box.x0, box.x1, width, inside.x0, inside.x1)
    y = along(box.y0, box.y1, height, inside.y0, inside.y1)
    right, left, above, below = box.x1 + away, box.x0 - away - width, box.y1 + away, box.y0 - away - height
    for low in ((right, y), (left, y), (x, above), (x, below), (right, above), (right, below), (left, above), (left, below)):
        yield Bbox([low, (low[0] + width, low[1] + height)])
    for turn in np.linspace(0, 2 * np.pi, TURNS, endpoint=False):
        side = np.array([np.cos(turn), np.sin(turn)])
        apart = np.array([box.width + width, box.height + height]) / 2 + away
        corner = (box.min + box.max) / 2 + side * apart - np.array([width, height]) / 2
        yield Bbox([corner, corner + [width, height]])


def _taken(ax: Axes, marks: Reals) -> Reals:
    """Boxes of all texts and of these marks, a row [left, bottom, right, top] each."""
    return np.concatenate([np.reshape([_box(text).extents for text in ax.texts], (-1, 4)), marks])


def _fits(box: Bbox, ax: Axes, taken: Reals) -> bool:
    inside = ax.bbox
    within = inside.x0 + AIR <= box.x0 and box.x1 <= inside.x1 - AIR and inside.y0 + AIR <= box.y0 and box.y1 <= inside.y1 - AIR
    return within and not np.all((taken[:, :2] <= box.max) & (taken[:, 2:] >= box.min), axis=1).any()


def _is_nearest(box: Bbox, own: Reals, others: Reals) -> bool:
    """Whether a box is nearer to its own point, or to one of them, than to any other."""
    away = [np.linalg.norm(points - np.clip(points, box.min, box.max), axis=1) for points in (np.atleast_2d(own), others)]
    return bool(min(away[0]) < min(away[1], default=np.inf) - ROUNDING)


def _draw_line(ax: Axes, own: Reals, box: Bbox) -> None:
    ends = ax.transData.inverted().transform([own, np.clip(own, box.min, box.max)])
    limits = ax.get_xlim(), ax.get_ylim()
    ax.plot(*ends.T, color="black", linewidth=0.6, zorder=5.9, gid=TO_MARK, path_effects=outline(LINE_HALO))
    ax.set(xlim=limits[0], ylim=limits[1])


def _write_apart(ax: Axes, x: float, y: float, text: str, taken: Reals) -> None:
    note = ax.annotate(text, (x, y), xycoords="data", xytext=(0, 0), textcoords="axes fraction",
                       path_effects=outline(HALO), zorder=ABOVE,
                       arrowprops={"arrowstyle": "-", "linewidth": 0.6, "path_effects": outline(LINE_HALO)})
    for size, places in ((8, PLACES), (6.5, PLACES), (5, PLACES), (5, MORE_PLACES)):
        note.set(fontsize=size)
        free = _nearest_free(_box(note), ax, places, taken, ax.transData.transform((x, y)))
        if free is not None:
            across, up = free
            note.set(position=free, ha=("left", "center", "right")[round(2 * across)],
                     va=("bottom", "center", "top")[round(2 * up)])
            return
    note.remove()


def _nearest_free(box: Bbox, ax: Axes, places: Reals, taken: Reals, own: Reals) -> tuple[float, float] | None:
    """(across, up) of the place, of these, at which a box of this size has room nearest to its own point; None without one."""
    anchors = np.array(list(product(places, places)))
    size, start = np.array([box.width, box.height]), np.array([ax.bbox.x0, ax.bbox.y0])
    low = start + anchors * [ax.bbox.width, ax.bbox.height] - np.round(2 * anchors) / 2 * size
    high = low + size
    within = np.all((low >= start + AIR) & (high <= [ax.bbox.x1 - AIR, ax.bbox.y1 - AIR]), axis=1)
    others = taken[:, None]
    meets = np.all((low < others[..., 2:]) & (high > others[..., :2]), axis=2).any(axis=0)
    away = np.where(within & ~meets, np.linalg.norm(own - np.clip(own, low, high), axis=1), np.inf)
    if not np.isfinite(away).any():
        return None
    across, up = anchors[np.argmin(away)]
    return across, up


def _has_room(note: Text, ax: Axes, taken: Reals) -> bool:
    return _fits(_box(note), ax, taken)


def _box(text: Text) -> Bbox:
    """Extent of the text alone, as an annotation's own extent includes its arrow; with the padding of a frame."""
    if isinstance(text, Annotation):
        text.update_positions(_renderer(text))
    box = Text.get_window_extent(text, _renderer(text))
    frame = 0 if text.get_bbox_patch() is None else FRAME * text.get_fontsize() / 72 * text.get_figure().dpi
    return box.padded(frame)


def _renderer(text: Text) -> RendererBase:
    figure = text.get_figure()
    if hasattr(figure.canvas, "get_renderer"):
        return figure.canvas.get_renderer()
    return RendererAgg(*np.ceil(figure.bbox.size), figure.dpi)  # of a figure not shown yet
