"""Distance of each cell of a curves file from the boundary of its own motion, along one axis of the plane.

The magnitude of the drift in either direction; the file has its sign. A block of a reduced map shows its smallest distance.
"""

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes

from ..arrays import Integers, ma
from ..plotting import axes, style
from ..plotting.coordinates import label
from ..plotting.picture import picture
from .curves_file import EDGE_KINDS, CurvesFile
from .field_map import scale_colours, without_value
from .map_file import Axis
from .reduce import LIMIT, Reduced, block_size, class_picture, with_edges

WIDTH = 3.7  # in
TOP = 99.5  # percentile at which the scale ends
# For each axis: its name in words, and the factor from its ratio to Hz or mm.
SIDES: dict[str, tuple[str, str, str, Callable[[CurvesFile], float | None]]] = {
    "frequency_ratio": ("frequency", r"\Omega/\omega", "Hz", lambda file: file.positive("natural_frequency_hz")),
    "gap_ratio": ("gap", "gap/A_0", "mm", lambda file: (file.positive("cart_amplitude_m") or 0) * 1000),
}
PICTURES = {**{f"edge_distance_{word}": side for side, (word, *_) in SIDES.items()},
            "edge_distance_columns": "columns", "edge_distance_rows": "rows"}  # the latter of axes that are none of SIDES
# What is told of a cell, its colour, and its hatching in the grey palette.
CLASSES = [("an edge within the window", "#FFFFFF", ""), ("no edge within the window", "#CDE7C9", "//"),
           ("could not be followed to one", "#F7C6D0", "++"), ("chaotic, unresolved, or q above curves.max_period", "#F2F2F2", "\\\\")]


@picture(CurvesFile)
def draw(file: CurvesFile, ax: Axes | None = None, *, side: str) -> Axes | None:
    """The picture along an axis, given by its coordinate's name, or as "columns" or "rows"; None if no cell has an edge."""
    axis = next(axis for place, axis in (("columns", file.columns), ("rows", file.rows)) if side in (place, axis.name))
    side = axis.name
    reduced = _smallest(file, axis)
    if not np.isfinite(reduced.image).any():
        return None
    factor, words = _scale(file, side)
    classes, counts = class_picture(file, ["regime", f"edge_kind_{axis.stored}"], lambda _, kind: _class_of(kind), len(CLASSES))
    looks = [without_value(colour, hatch) for _, colour, hatch in CLASSES]
    handles = [axes.legend_patch(text, look) for (text, *_), look, count in list(zip(CLASSES, looks, counts))[1:] if count]
    figure, ax, bar_ax = axes.stack(WIDTH, reduced.image, [(handles, 1, None)], bar=True, ax=ax)
    axes.show_classes(ax, classes, looks, len(CLASSES))
    shown = ma.masked_invalid(reduced.image) * (factor or 1)
    mesh = ax.pcolormesh(reduced.column_edges, reduced.row_edges, shown, cmap=scale_colours(), vmin=0,
                         vmax=float(np.percentile(shown.compressed(), TOP)) or 1, rasterized=True)
    bar = figure.colorbar(mesh, cax=bar_ax, orientation="horizontal", extend="max" if shown.max() > mesh.norm.vmax else "neither")
    bar.outline.set_linewidth(0.6)
    bar.set_label(words, fontsize=8)
    axes.label_axes(ax, file)
    axes.write_title(figure, file, "distance to the edge of its own motion", ax=ax)
    return ax


def has(file: CurvesFile, side: str) -> bool:
    """Whether the file has distances along an axis, named as in draw."""
    names = (file.columns.name, file.rows.name)
    if side in SIDES:
        return file.has_edge_distance and side in names
    return file.has_edge_distance and {"columns": names[0], "rows": names[1]}[side] not in SIDES


def _scale(file: CurvesFile, side: str) -> tuple[float | None, str]:
    """The factor from stored numbers, and the label of the scale."""
    if side not in SIDES:
        return 1.0, f"drift to the nearest edge: {label(side)}"
    word, ratio, unit, factor_of = SIDES[side]
    factor = factor_of(file) if style.current().units != "ratio" else None
    return factor, f"drift of the {word} to the nearest edge ({unit})" if factor else f"drift of ${ratio}$ to the nearest edge"


def _class_of(kind: Integers) -> Integers:
    """Indices into CLASSES."""
    return np.select([(kind >= 0) & (kind < EDGE_KINDS.index("none")), kind == EDGE_KINDS.index("none"),
                      kind == EDGE_KINDS.index("unknown")], [0, 1, 2], 3)


def _smallest(file: CurvesFile, axis: Axis) -> Reduced:
    name = f"edge_distance_{axis.stored}"
    block, pieces = block_size(file.shape, LIMIT), []
    for _, band in file.bands(["regime", name], block):
        rows, columns = (np.arange(0, size, block) for size in band[name].shape)
        pieces.append(np.fmin.reduceat(np.fmin.reduceat(np.abs(band[name]), rows, axis=0), columns, axis=1))
    return with_edges(file, np.concatenate(pieces) / axis.unit, block)
