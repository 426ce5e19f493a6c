"""Fills of areas: a colour or, in the grey palette, a lightness and a hatching.

There are more classes than distinguishable lightnesses, so the most frequent classes differ in lightness and related classes
in hatching: chaos is black and no impact white; classes distinguishable by lightness alone have no hatching. The texture is
drawn in cells of a fine raster, not as lines over the plane, so that it ends exactly where the class does.
"""

from collections.abc import Sequence, Collection
from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb, to_rgba_array
from matplotlib.figure import Figure

from ..arrays import Integers, Mask, Reals
from . import style
from .classes import CLASSES, SECOND_COLOURS

# For each class: lightness 0 (black) to 100 (white), CIE L*, and hatching.
GREYS = {
    "no impact": (97, ""), "1/1": (62, ""), "2/2": (62, "//"), "4/4": (62, "xx"), "3/3": (62, ".."),
    "1/2": (82, ""), "2/4": (82, "//"), "1/3": (42, ""), "2/1": (82, "\\\\"), "4/2": (82, "xx"),
    "3/1": (42, "//"), "6/2": (42, "xx"), "4/1": (42, "\\\\"), "5/1": (42, ".."), "3/2": (97, ".."),
    "other p/q": (97, "\\\\"), "chaotic": (8, ""), "sustained contact": (82, ".."), "unresolved": (24, "++"),
    "failed": (97, "xx"), "not computed yet": (100, ""),
}
# In the other palette, of colours that are so dark that one can't tell them from chaos or from one another in small areas.
DARK = {"#22012A": "//", "#391301": "xx", "#0E046E": "\\\\"}
SECOND = ((24, ""), (97, "//"), (62, "++"), (82, "++"), (24, ".."), (62, "\\\\"), (24, "xx"), (42, "++"))  # of other p/q
PERIOD, STROKE = 8, 2  # of a hatching, in raster cells: in areas thinner than that it looks like a darker grey
RASTER = 700  # cells of the raster along a side
CONTRAST = 42  # between a hatching and its background, in lightness


@dataclass(frozen=True)
class Fill:
    """`colour` '#RRGGBB', and the `hatch` over it in matplotlib's letters, '' for none."""

    colour: str
    hatch: str = ""

    @property
    def stroke(self) -> str:
        """The colour of the hatching."""
        return grey(stroke(lightness(self.colour)))


def stroke(light: float) -> float:
    """The lightness of a hatching on a background of this one."""
    return light - CONTRAST if light > 50 else light + CONTRAST


def grey(light: float) -> str:
    """The neutral '#RRGGBB' of this lightness, CIE L* 0 to 100."""
    linear = ((light + 16) / 116) ** 3 if light > 8 else light / 903.3
    value = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    colour: str = to_hex([float(np.clip(value, 0, 1))] * 3)
    return colour


def lightness(colour: str) -> float:
    """CIE L* of a colour, 0 to 100: its lightness in a grey print."""
    linear = [value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4 for value in to_rgb(colour)]
    luminance = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    return float(116 * luminance ** (1 / 3) - 16 if luminance > 0.008856 else 903.3 * luminance)


_OF_CLASS = {entry.colour: Fill(grey(GREYS[entry.label][0]), GREYS[entry.label][1]) for entry in CLASSES if entry.label in GREYS}
_OF_CLASS |= {colour: Fill(grey(light), hatch) for colour, (light, hatch) in zip(SECOND_COLOURS, SECOND)}


def fill(colour: str | Fill) -> Fill:
    """The Fill of a colour in the current palette; a Fill is returned unchanged."""
    if isinstance(colour, Fill):
        return colour
    if not style.is_grey():
        return Fill(colour, DARK.get(colour, ""))
    return _OF_CLASS.get(colour) or Fill(grey(lightness(colour)))


def paler(colour: str | Fill, white: float) -> str | Fill:
    """The Fill of a colour in the current palette with this share of white, 0 to 1."""
    own = fill(colour)
    pale = to_hex([(1 - white) * value + white for value in to_rgb(own.colour)])
    return Fill(pale, own.hatch) if own.hatch else pale


def textured(image: Integers, row_edges: Reals, column_edges: Reals, fills: Sequence[Fill],
             log: tuple[bool, bool] = (False, False)) -> tuple[Integers, Reals, Reals, list[str]]:
    """An image of class numbers (rows, columns) as a raster of colour numbers, for fills with hatchings.

    `log`: whether rows and columns are spaced in the logarithm. Returns (raster, its row edges, its column edges,
    colours): a class n has the colour n, its hatching the colour len(fills) + n. Masked cells stay masked."""
    row_edges, rows = raster_of(row_edges, log[0])
    column_edges, columns = raster_of(column_edges, log[1])
    numbers = image[np.ix_(rows, columns)].astype(np.int16)  # a type that holds twice the number of classes
    masks = {hatch: strokes(hatch, len(rows), len(columns)) for hatch in {one.hatch for one in fills} - {""}}
    raster = numbers.copy()
    for number, one in enumerate(fills):
        if one.hatch:
            raster[(numbers == number) & masks[one.hatch]] = len(fills) + number
    return raster, row_edges, column_edges, [one.colour for one in fills] + [one.stroke for one in fills]


def raster_of(edges: Reals, log: bool) -> tuple[Reals, Integers]:
    """(edges of the raster, index of the cell under each of its cells), of cells with these edges."""
    cells = len(edges) - 1
    count = cells * -(-RASTER // cells)
    fine: Reals = np.geomspace(edges[0], edges[-1], count + 1) if log else np.linspace(edges[0], edges[-1], count + 1)
    fine[[0, -1]] = edges[[0, -1]]
    middles = np.sqrt(fine[1:] * fine[:-1]) if log else (fine[1:] + fine[:-1]) / 2
    return fine, np.clip(np.searchsorted(edges, middles) - 1, 0, len(edges) - 2)


def strokes(hatch: str, rows: int, columns: int) -> Mask:
    """Mask (rows, columns) of a hatching's lines or dots; rows are counted upwards."""
    row, column = np.ogrid[:rows, :columns]
    row, column = row * RASTER / rows, column * RASTER / columns
    half = PERIOD / 2
    dots = (row % half < STROKE) & (column % half < STROKE)
    level, upright = row % PERIOD < STROKE, column % PERIOD < STROKE
    rising, falling = (row - column) % PERIOD < STROKE, (row + column) % PERIOD < STROKE
    from_middle = np.hypot(row % PERIOD - PERIOD / 2, column % PERIOD - PERIOD / 2)
    masks = {"--": level | (column < 0), "||": upright | (row < 0), "//": rising, "\\\\": falling, "xx": rising | falling,
             "++": level | upright, "**": level | upright | rising | falling, "oo": from_middle < STROKE,
             "..": dots, "xx..": rising | falling | dots, "OO": np.abs(from_middle - 0.4 * PERIOD) < STROKE / 2}
    mask: Mask = masks[hatch]
    return mask


def without_colour(figure: Figure, others: Collection[Axes] = ()) -> None:
    """Converts the lines, letters and marks of a figure, except in the given Axes, to greys of the same lightness."""
    for ax in figure.axes:
        if ax not in others:
            for artist in ax.findobj():
                _turn_grey(artist)


def _turn_grey(artist: Artist) -> None:
    if getattr(artist, "get_array", lambda: None)() is not None:  # colours of a scale or of classes
        return
    for name in ("color", "facecolor", "edgecolor", "markerfacecolor", "markeredgecolor"):
        if hasattr(artist, f"get_{name}") and hasattr(artist, f"set_{name}"):
            colours = getattr(artist, f"get_{name}")()
            if isinstance(colours, str) and colours in ("none", "auto"):
                continue
            greys = [(*to_rgb(grey(lightness(one))), one[3]) for one in to_rgba_array(colours)]
            if greys:
                getattr(artist, f"set_{name}")(greys[0] if len(greys) == 1 else greys)
    if getattr(artist, "arrow_patch", None) is not None:
        _turn_grey(artist.arrow_patch)
