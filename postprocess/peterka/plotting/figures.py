"""Figures that consist of one picture, and the place of a picture in a caller's figure."""

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpecBase

from ..files.whole_file import written_whole
from . import style

COARSE_DPI, FINE_DPI, FINE_FROM = 300, 600, 800  # a map with more than FINE_FROM cells per side needs the finer raster
METADATA = {"png": {"Software": None}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}  # reproducible bytes


class Picture(Figure):
    """A figure made for one picture. It keeps the settings it was drawn with, whatever matplotlib's are when it is saved or
    shown, and notebooks display it."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._rc = style.rc()
        FigureCanvasAgg(self)

    def draw(self, renderer: RendererBase) -> None:
        """As Figure.draw, in its own settings."""
        with matplotlib.rc_context(self._rc):
            super().draw(renderer)

    def savefig(self, *arguments: Any, **options: Any) -> None:
        """As Figure.savefig, in its own settings."""
        with matplotlib.rc_context(self._rc):
            super().savefig(*arguments, **options)

    def _repr_png_(self) -> bytes:
        image = io.BytesIO()
        self.savefig(image, format="png", dpi=150)
        return image.getvalue()


def width_of(own: float) -> float:
    """Width [in] of a figure: `own` [in] unless the style requests another."""
    asked = style.current().width
    return asked / style.MILLIMETRES if asked else own


def new_figure(width: float, height: float, cells: int = 1) -> Picture:
    """A Picture [in x in], with a raster fine enough for this many cells per side."""
    if not style.is_in_use():
        raise RuntimeError("a picture is drawn by a function of @picture, or one of @style.using()")
    dpi = style.current().dpi or (COARSE_DPI if cells <= FINE_FROM else FINE_DPI)
    return Picture(figsize=(width, height), dpi=dpi, layout="constrained")


def divided(width: float, height: float, ax: Axes | None = None, rows: int = 1, columns: int = 1, cells: int = 1,
            **ratios: Sequence[float]) -> tuple[Figure, GridSpecBase]:
    """(figure, grid) for the parts of a picture: a new figure of this size
    [in x in], or the place of `ax`, made by subplots(), in its figure."""
    if ax is None:
        figure = new_figure(width, height, cells)
        return figure, figure.add_gridspec(rows, columns, **ratios)
    place = ax.get_subplotspec()
    if place is None:
        raise ValueError("a picture needs Axes that subplots() or add_subplot() made: it divides their place")
    figure = ax.get_figure()
    if figure.get_layout_engine() is None:
        figure.set_layout_engine("constrained")
    return figure, place.subgridspec(rows, columns, **ratios)


def panel(figure: Figure, grid: GridSpecBase, row: int = 0, column: int = 0, ax: Axes | None = None) -> Axes:
    """The Axes of one part of a divided place; the first part takes over `ax`."""
    if ax is None or (row, column) != (0, 0):
        return figure.add_subplot(grid[row, column])
    ax.set_subplotspec(grid[0, 0])
    return ax


def figure_of(drawn: Axes | Sequence[Axes]) -> Figure:
    """The figure of a picture function's result: Axes, or a list of them."""
    return (drawn[0] if isinstance(drawn, list) else drawn).get_figure()


def save(figure: Figure, path: Path) -> None:
    """Writes a finished picture in the format of its suffix, atomically."""
    kind = path.suffix[1:]
    with written_whole(path, "wb") as out:
        figure.savefig(out, format=kind, dpi=figure.dpi, metadata=METADATA[kind])
        figure.set_layout_engine("none")  # other formats share this layout: computing it takes longer than drawing
