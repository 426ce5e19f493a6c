"""Shared by all pictures: figure and fonts, cells on axes, second scales, legend, notices, writing a picture.

Axes are ratios in the paper's notation; a second scale gives Hz and mm if the file has them. Cells are drawn without
interpolation, between their edges: linear or logarithmic. Sizes are for one journal column.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import matplotlib.patheffects as patheffects
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.patheffects import AbstractPathEffect
from matplotlib.ticker import NullFormatter, NullLocator

from ..arrays import Mask, ma
from ..files.coordinates import TWINS, unit_of
from . import seen, style
from .coordinates import IN_MILLIMETRES, label
from .drawn import AtPoint, Growing, Image, InUnits, Plane
from .figures import figure_of as figure_of, new_figure as new_figure, save as save  # as: pieces every picture shares
from .fills import Fill, fill, textured
from .frames import NOT_COMPUTED_HATCH
from .frames import diagram as diagram, legend_patch as legend_patch, stack as stack
from .linear_ticks import LinearNumbers, LinearTicks
from .log_ticks import LogNumbers, LogTicks
from .ticks_in_units import number_in_units
from .titles import write_title as write_title

LETTER_SHARE = 0.033  # width of a 9 pt character over the width of the map
SEEN_OF_WINDOW = 0.8  # of the smallest one for a name, inside the frame
GREY_BOUNDARY = 0.35  # relative luminance above which black letters read better than white ones


def label_axes(ax: Axes, file: Plane) -> None:
    """Axis labels and scales; at the top and right in Hz, mm and m/s if the file gives frequency and amplitude."""
    for axis, ticks, which in ((file.columns, ax.xaxis, "x"), (file.rows, ax.yaxis, "y")):
        getattr(ax, f"set_{which}label")(label(axis.name))
        getattr(ax, f"set_{which}scale")("log" if axis.log else "linear")
        getattr(ax, f"set_{which}lim")(axis.edges[0], axis.edges[-1])
        _set_ticks(ticks, axis.log)
    for axis, side in ((file.columns, "x"), (file.rows, "y")):
        scale = second_scale(ax, side, si_scale(file, axis.name), replaces=axis.name in IN_MILLIMETRES)
        if scale is not None:
            _set_ticks(getattr(scale, f"{side}axis"), axis.log)


def second_scale(ax: Axes, side: str, label_and_factor: tuple[str, float] | None,
                 place: float | None = None, replaces: bool = False) -> Axes | None:
    """A scale of the side "x" or "y" in other units, given by its (label, factor from those of the axis): opposite to the
    axis, or, where pictures are in SI alone, the axis itself, whose ticks and grid are round numbers of these units then;
    none where `label_and_factor` is None or pictures are in ratios alone. `place`: where, if not there; `replaces`: the
    axis, in any units. Returns the Axes of a scale of its own or None."""
    units = "si" if replaces else style.current().units
    if label_and_factor is None or units == "ratio":
        return None
    label, factor = label_and_factor
    if units == "si":
        getattr(ax, f"set_{side}label")(label)
        number_in_units(getattr(ax, f"{side}axis"), factor)
        return None
    add = ax.secondary_xaxis if side == "x" else ax.secondary_yaxis
    scale = add(place or ("top" if side == "x" else "right"), functions=scale_functions(factor))
    set_label = scale.set_xlabel if side == "x" else scale.set_ylabel
    if getattr(ax, f"get_{side}scale")() == "log":
        number_log_scale(getattr(scale, f"{side}axis"))
    set_label(label, fontsize=8)
    return scale


def si_scale(file: InUnits, name: str) -> tuple[str, float] | None:
    """(label, factor from the numbers of this axis) of its scale in SI units; None if the file does not give it."""
    if name in IN_MILLIMETRES:
        return IN_MILLIMETRES[name], 1000.0
    unit = unit_of(file, name) if name in TWINS else None
    if unit is None:
        return None
    twin = TWINS[name]
    return (IN_MILLIMETRES[twin], 1000 * unit) if twin in IN_MILLIMETRES else (label(twin), unit)


def _set_ticks(ticks: Axis, log: bool) -> None:
    """Round, plain numbers; on a logarithmic axis as many of 1, 2, 5, 10, ... as fit."""
    if log:
        ticks.set_major_locator(LogTicks())
        ticks.set_major_formatter(LogNumbers())
        ticks.set_minor_formatter(NullFormatter())
    else:
        ticks.set_major_locator(LinearTicks())
        ticks.set_major_formatter(LinearNumbers())


def scale_functions(factor: float) -> tuple[Callable[[Any], Any], Callable[[Any], Any]]:
    """Conversion functions of a second scale: from ratios to units, and back."""
    return (lambda ratio: ratio * factor), (lambda value: value / factor)


def show_classes(ax: Axes, reduced: Image, colours: Sequence[str | Fill], not_computed: int) -> None:
    """Draws class numbers (rows, columns) in their colours or fills; the class `not_computed` shows the hatched background."""
    hatch_background(ax)
    fills = [fill(colour) for colour in colours]
    shown = ma.masked_where(reduced.image == not_computed, reduced.image)  # which may not be representable in its type
    rows, columns = reduced.row_edges, reduced.column_edges
    colours = [one.colour for one in fills]
    if any(fills[number].hatch for number in np.unique(shown.compressed())):
        shown, rows, columns, colours = textured(shown, rows, columns, fills, reduced.log)
    ax.pcolormesh(columns, rows, shown, cmap=ListedColormap(colours), vmin=-0.5, vmax=len(colours) - 0.5, rasterized=True)


def hatch_background(ax: Axes) -> None:
    """Hatches the whole plane: areas left uncovered are not computed yet."""
    ax.patch.set(**NOT_COMPUTED_HATCH)


def percent(share: float) -> str:
    """A share 0..1 for a legend, rounded as in the program's summary; where that is neither 0 % nor 100 %, but would read so, it is
    told as below or above the rounding."""
    value = 100 * share
    text = f"{value:.1f} %"
    if value > 0 and text == "0.0 %":
        return "< 0.05 %"
    return "> 99.95 %" if value < 100 and text == "100.0 %" else text


def operating_point(file: AtPoint) -> str:
    """Frequency and gap if common to all cells, as text: both for a basin, none for a map over both; in Hz and mm where the job
    gives them so, and for pictures in SI units alone, if the file tells the rig."""
    units = style.current().units
    hertz, metres = (unit_of(file, name) if units == "si" or (units == "both" and name in file.given_in_si) else None
                     for name in ("frequency_ratio", "gap_ratio"))
    shared = [("Ω/ω", file.positive("frequency_ratio"), "frequency", hertz, "Hz"),
              ("gap/A₀", file.number("gap_ratio"), "gap", metres and 1000 * metres, "mm")]
    return ", ".join(f"{word} = {value * factor:.4g} {unit}" if factor else f"{name} = {value:.4g}"
                     for name, value, word, factor, unit in shared if value is not None)


def notice_incomplete(ax: Axes, file: Growing) -> None:
    """Writes into the picture that the map is incomplete, and the computed share."""
    if not file.is_complete:
        ax.text(
            0.03, 0.97, incomplete_text(file), transform=ax.transAxes, va="top", ha="left", weight="bold",
            bbox={"facecolor": "white", "edgecolor": "black", "linewidth": 0.6, "boxstyle": "square,pad=0.4"},
            zorder=10,
        )


def so_far(file: Growing) -> str:
    """The same notice for a title."""
    text = incomplete_text(file)
    return f"{text}\n" if text else ""


def incomplete_text(file: Growing) -> str:
    """The computed share, in words; empty of a complete file."""
    if file.is_complete:
        return ""
    if file.computed == 1:
        return "incomplete: last steps missing"
    return f"incomplete: {np.floor(1000 * file.computed) / 10:.1f} % computed"


def log_scale(ax: Axes, *sides: str) -> None:
    """Makes the sides "x" or "y" of a diagram logarithmic, with few, plain ticks and a pale grid."""
    for side in sides:
        getattr(ax, f"set_{side}scale")("log")
        number_log_scale(getattr(ax, f"{side}axis"))
    ax.grid(color="#DDDDDD", linewidth=0.5)
    ax.set_axisbelow(True)


def number_log_scale(axis: Axis) -> None:
    """Sets few, plain ticks on a logarithmic axis."""
    axis.set_major_locator(LogTicks())
    axis.set_major_formatter(LogNumbers())
    axis.set_minor_locator(NullLocator())


def name_areas(ax: Axes, reduced: Image, names: Mapping[int, tuple[str, str | Fill]]) -> None:
    """Writes a class's name into its largest rectangle free of visible marks, if large enough.

    `names` maps a class number of the image to (text, colour of the class)."""
    marked = _marked(ax, reduced)
    for number, (text, colour) in names.items():
        colour = fill(colour).colour
        window = largest_window(reduced.image == number, marked, LETTER_SHARE * len(text))
        if window is not None:
            (left, right), (low, high) = window
            xs, ys = reduced.column_edges[[left, right]], reduced.row_edges[[low, high]]
            corners = ax.transAxes.inverted().transform(ax.transData.transform(np.column_stack([xs, ys]))).clip(0, 1)
            if np.min(np.ptp(corners, axis=0)) < SEEN_OF_WINDOW * LETTER_SHARE * len(text):
                continue  # the frame cuts its cells
            middle = corners.mean(axis=0)
            ax.text(*middle, text, transform=ax.transAxes, ha="center", va="center", fontsize=9,
                    color=letter_colour(colour), path_effects=outline(2, colour))


def letter_colour(background: str) -> str:
    """Black or white, whichever reads better on a colour '#RRGGBB'."""
    red, green, blue = (value**2.2 for value in to_rgb(background))
    return "black" if 0.2126 * red + 0.7152 * green + 0.0722 * blue > GREY_BOUNDARY else "white"


def _marked(ax: Axes, reduced: Image) -> Mask:
    """Mask of the image's cells beneath visible marks."""
    cells = np.zeros(reduced.image.shape, dtype=bool)
    for box in seen.boxes(ax):
        (left, low), (right, high) = ax.transData.inverted().transform(box.reshape(2, 2))
        rows, columns = (slice(max(0, np.searchsorted(edges, first, side="right") - 1), np.searchsorted(edges, last))
                         for edges, first, last in ((reduced.row_edges, low, high), (reduced.column_edges, left, right)))
        cells[rows, columns] = True
    return cells


def largest_window(mask: Mask, marked: Mask, smallest: float, purity: float = 0.97) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """The largest window, with the proportions of the whole, in which the share `purity` is True and no cell is `marked`.

    Returns its edges ((left, right), (low, high)) in cells; None if it is below `smallest` of the whole's sides."""
    total = np.zeros(np.add(mask.shape, 1), dtype=np.int64)
    total[1:, 1:] = np.where(marked, -mask.size, mask).cumsum(axis=0).cumsum(axis=1)
    found = None
    low, high = smallest, 1.0
    for _ in range(8):
        share = low if found is None else (low + high) / 2
        height, width = (max(1, round(share * size)) for size in mask.shape)
        inside = total[height:, width:] - total[:-height, width:] - total[height:, :-width] + total[:-height, :-width]
        row, column = np.unravel_index(inside.argmax(), inside.shape)
        if inside[row, column] >= purity * height * width:
            found, low = ((column, column + width), (row, row + height)), share
        elif found is None:
            return None
        else:
            high = share
    return found


def outline(width: float = 2.0, colour: str = "white") -> list[AbstractPathEffect]:
    """Path effect: a halo that keeps a line or letter legible on any colour."""
    return [patheffects.withStroke(linewidth=width, foreground=colour)]
