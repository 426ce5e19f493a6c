"""A scale of values on both sides of a middle, as 0 or equal forces: blue below and red above. In the grey palette lightness tells
how far a value lies from the middle, and strokes, drawn as minus signs are, that it lies below.
"""

from collections.abc import Callable

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colorbar import Colorbar
from matplotlib.colors import Colormap, ListedColormap, Normalize
from matplotlib.figure import Figure

from ..arrays import Reals, ma
from . import style
from .drawn import Image
from .fills import RASTER, Fill, grey, raster_of, stroke, strokes
from .frames import legend_patch

COLOURS = "RdBu_r"
HATCH = "--"  # of what lies below the middle, in the grey palette
MIDDLE, ENDS = 88.0, 8.0  # lightness in the grey palette, at the middle and at both ends: white has another meaning
LEVELS = 256
BAR_ROWS = 24  # raster cells across a colour bar


def show(ax: Axes, reduced: Image, values: Reals, norm: Normalize) -> QuadMesh:
    """Draws values (rows, columns), NaN where there are none, in the place of an image; `norm` has 0.5 in the middle."""
    edges = reduced.column_edges, reduced.row_edges
    mesh = ax.pcolormesh(*edges, ma.masked_invalid(values), cmap=_colours(), norm=norm, rasterized=True)
    if style.is_grey():
        row_edges, rows = raster_of(reduced.row_edges, reduced.log[0])
        column_edges, columns = raster_of(reduced.column_edges, reduced.log[1])
        fine = np.asarray(values)[np.ix_(rows, columns)]
        _hatch(ax, (column_edges, row_edges), ma.masked_where(~strokes(HATCH, *fine.shape), ma.masked_invalid(fine)), norm)
    return mesh


def draw_bar(figure: Figure, ax: Axes, mesh: QuadMesh, extend: str) -> Colorbar:
    """The colour bar of what show() has drawn; `extend`: its ends with an arrow, as matplotlib names them."""
    bar = figure.colorbar(mesh, cax=ax, orientation="horizontal", extend=extend)
    bar.outline.set_linewidth(0.6)
    if style.is_grey():
        limits: tuple[tuple[float, float], ...] = ax.get_xlim(), ax.get_ylim()
        ends: Reals = mesh.norm.inverse(np.linspace(0, 0.5, RASTER // 2 + 1))
        shown = np.broadcast_to((ends[1:] + ends[:-1]) / 2, (BAR_ROWS, RASTER // 2))
        up = np.linspace(limits[1][0], limits[1][1], BAR_ROWS + 1)
        level = strokes(HATCH, RASTER, RASTER)[:BAR_ROWS, :RASTER // 2]
        _hatch(ax, (ends, up), ma.masked_where(~level, shown), mesh.norm)
        ax.set(xlim=limits[0], ylim=limits[1])
    return bar


def entries(below: str) -> list[Artist]:
    """The legend entry that says what strokes mean; none in colour."""
    return [legend_patch(below, Fill(grey((MIDDLE + ENDS) / 2), HATCH))] if style.is_grey() else []


def _hatch(ax: Axes, edges: tuple[Reals, Reals], values: Reals, norm: Normalize) -> None:
    """Strokes, where values are not masked and below the middle, in the contrast that each has to its background."""
    below = ma.masked_where(ma.filled(norm(values), 1.0) >= 0.5, values)
    ax.pcolormesh(*edges, below, cmap=_of_lightness(stroke), norm=norm, rasterized=True)


def _colours() -> Colormap | str:
    return _of_lightness(lambda light: light) if style.is_grey() else COLOURS


def _of_lightness(change: Callable[[float], float]) -> Colormap:
    """Colours from end to end, by what becomes of the lightness at each."""
    away = np.abs(np.linspace(-1, 1, LEVELS))
    return ListedColormap([grey(change(float(light))) for light in np.interp(away, [0, 1], [MIDDLE, ENDS])])
