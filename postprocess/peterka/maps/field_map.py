"""Draws a number per cell over the plane of a map: shared by force_map, quantity_map and number_map.

Values are coloured on a scale from 0; the largest value of all cells of a map is marked, and may grow beyond the border if
it lies there. Cells without a value have colours outside the scale: those of their class if the picture distinguishes it,
else two pale ones. Cells of a reduced map show the largest value in their block.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import ListedColormap, LogNorm, Normalize
from matplotlib.figure import Figure

from ..arrays import Integers, Mask, Reals, ma
from ..files.regimes import CHAOTIC, PERIODIC
from ..plotting import axes, style
from ..plotting.classes import CLASSES, INDEX, Class, classify
from ..plotting.fills import Fill, fill, grey
from ..plotting.frames import label_of_bar
from ..plotting.limits import EXTENDS, requested
from ..plotting.notes import write_beside
from ..plotting.seen import SEEN
from ..measurements import marks
from ..measurements.points import NOTHING_MEASURED, Measurements
from .map_file import PeterkaFile
from .reduce import Largest, Reduced, class_picture, field_picture

WIDTH = 3.7  # in
COLOURS = "viridis"
OTHER_COLOUR = "#F2F2F2"
NO_VALUE_COLOUR = "#F7C6D0"  # cells whose value is missing, e.g. no contact force for a rigid stop
LOW_SHARE = 2  # lower percentile of scales not starting at 0: exponents of strongly stable orbits are very negative
TOP_SHARE, TOP_EXCESS = 99.9, 1.15  # the scale ends at this percentile if isolated cells exceed it by this factor
# Of values that are alike in most cells (a scale not starting at 0): where this percentile lies below this share of that end, few cells
# would have the scale for themselves, and it ends there.
BULK_SHARE, FLAT = 90, 0.25
GREY_SCALE = (88, 8)  # lightness of the smallest and the largest value in the grey palette
# Areas without a value are white or hatched there: the scale has all other lightnesses for itself.
GREY_APART = {"no impact": "", "sustained contact": "//", "unresolved": "xx", "failed": "..", "chaotic": "\\\\"}
WITHOUT_IMPACTS = ("no impact", "sustained contact", "unresolved", "failed")


@dataclass(frozen=True)
class Scale:
    """`label` of the colour bar; `factor` from stored to displayed numbers; `text` formats a stored number; and an optional
    second scale (label, factor from stored numbers)."""

    label: str
    factor: float
    text: Callable[[float], str]
    second: tuple[str, float] | None = None
    in_si: tuple[str, float] | None = None  # base unit, and factor from stored numbers: of the limits of the scale
    ratio: str = ""  # what stored numbers are over; empty if they are in that unit


@dataclass(frozen=True)
class Field:
    """What to draw: the dataset, a predicate on (regime, p, q) for the cells that carry it, the distinguished classes, and
    the Scale for a largest value."""

    dataset: str
    carries: Callable[..., Mask]
    apart: tuple[str, ...]
    scale: Callable[[float], Scale]
    from_zero: bool = True  # the scale begins at 0; otherwise at the smallest value
    told: str = ""  # in the title, line by line
    zero: str = ""  # what the legend says of cells whose value is 0, set apart from the scale; empty: they are on the scale
    marks_largest: bool = True  # a cross at the largest value; none of a coordinate, of which either sign may be far out


def has_impacts(regime: Integers, *_: object) -> Mask:
    """Mask of the cells of verified orbits with impacts, and of chaos."""
    mask: Mask = (regime == PERIODIC) | (regime == CHAOTIC)
    return mask


def draw(file: PeterkaFile, field: Field, ax: Axes | None = None, measured: Measurements = NOTHING_MEASURED) -> Axes | None:
    """The map of a Field and, for a force, the measured points; None if no cell has a value."""
    values, peak, lacking = field_picture(file, field.dataset, field.carries)
    if peak is None:
        return None
    classes, counts = class_picture(file, ["regime", "impacts", "period"], classify, len(CLASSES))
    carried = [entry.orbit == (1, 1) if not field.apart else entry.label not in field.apart for entry in CLASSES]
    legend = _legend_entries(counts, carried, field.apart, lacking) + marks.handles(measured.points)
    has_zero = bool(field.zero and peak.value > 0 and np.any(values.image == 0))
    if has_zero:
        legend.insert(0, axes.legend_patch(field.zero, without_value(OTHER_COLOUR)))
    scale = _in_units(field.scale(peak.value))
    shown = ma.masked_invalid(values.image) * scale.factor
    limits = requested(file, shown.compressed() / scale.factor, scale.in_si, scale.ratio)
    norm = _norm(shown, peak.value * scale.factor, field.from_zero, limits and [limit * scale.factor for limit in limits])
    has_no_log = isinstance(norm, LogNorm) and not has_zero and bool(np.any(values.image <= 0))
    if has_no_log:
        legend.insert(0, axes.legend_patch("0 or below: no logarithm", without_value(OTHER_COLOUR)))
    figure, ax, bar_ax = axes.stack(WIDTH, values.image, [(legend, 2, None)], bar=True, ax=ax)
    axes.show_classes(ax, classes, _colours_beneath(carried, field.apart), INDEX["not computed yet"])
    if has_zero:
        _show_apart(ax, values, shown == 0)
        shown = ma.masked_equal(shown, 0)
    if has_no_log:
        _show_apart(ax, values, shown <= 0)
        shown = ma.masked_less_equal(shown, 0)
    mesh = ax.pcolormesh(values.column_edges, values.row_edges, shown, cmap=scale_colours(), norm=norm, rasterized=True)
    axes.label_axes(ax, file)
    _draw_bar(figure, bar_ax, mesh, replace(scale, label=_told(scale.label, _beyond(shown.compressed(), norm))),
              (shown.min() < norm.vmin, peak.value * scale.factor > norm.vmax))
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, "\n".join(filter(None, [axes.operating_point(file), field.told])), ax)
    if measured.points:
        marks.draw_over_map(ax, file, measured.points, lambda force: mesh.to_rgba(force * scale.factor))
    if field.marks_largest and file.kind == "map":  # in a basin all starts of an orbit share the largest value
        _mark(ax, file, peak, scale.text(peak.value))
    marks.name_over_map(ax, file, measured.points)
    return ax


def _show_apart(ax: Axes, values: Reduced, cells: Mask) -> None:
    """Draws these cells of an image in the look of those without a value."""
    ax.pcolormesh(values.column_edges, values.row_edges, ma.masked_where(~ma.filled(cells, False), np.zeros(cells.shape)),
                  cmap=ListedColormap([fill(without_value(OTHER_COLOUR)).colour]), rasterized=True)


def _colours_beneath(carried: Sequence[bool], apart: Sequence[str]) -> list[str | Fill]:
    own = {entry.label: _apart_colour(entry) for entry in CLASSES if entry.label in apart}
    return [own.get(entry.label, _no_value_colour() if carries else without_value(OTHER_COLOUR))
            for entry, carries in zip(CLASSES, carried)]


def _apart_colour(entry: Class) -> str | Fill:
    return without_value(entry.colour, GREY_APART[entry.label])


def _no_value_colour() -> str | Fill:
    return without_value(NO_VALUE_COLOUR, "++")


def without_value(colour: str, hatch: str = "") -> str | Fill:
    """The look of cells without a value beside a scale of values: a colour that the scale hasn't, in grey white, which it hasn't
    either, under a hatching where there are several."""
    return Fill(grey(100), hatch) if style.is_grey() else colour


def _legend_entries(counts: Integers, carried: Sequence[bool], apart: Sequence[str], lacking: int) -> list[Artist]:
    """Legend entries of the cells coloured outside the scale."""
    found = [(entry, carries) for entry, carries, count in zip(CLASSES, carried, counts) if count]
    entries = [axes.legend_patch(entry.label, _apart_colour(entry)) for entry, _ in found if entry.label in apart]
    if not apart and any(not carries and entry.label != "not computed yet" for entry, carries in found):
        entries.append(axes.legend_patch("any other regime", without_value(OTHER_COLOUR)))
    if lacking:
        entries.append(axes.legend_patch("no value", _no_value_colour()))
    if counts[INDEX["not computed yet"]]:
        entries.append(axes.legend_patch("not computed yet", None, hatched=True))
    return entries


def scale_colours() -> ListedColormap | str:
    """The colour map of a scale of values, from low to high."""
    return ListedColormap([grey(light) for light in np.linspace(*GREY_SCALE, 256)]) if style.is_grey() else COLOURS


def _in_units(scale: Scale) -> Scale:
    """The scale in SI units alone or in ratios alone, if requested."""
    if scale.second is None or style.current().units == "both":
        return scale
    if style.current().units == "ratio":
        return replace(scale, second=None)
    label, factor = scale.second
    return replace(scale, label=label, factor=factor, second=None)


def _norm(shown: Any, peak: float, from_zero: bool, limits: Sequence[float] | None) -> Normalize:
    """Limits of the displayed values; `limits`: those requested."""
    positive = shown[shown > 0]
    logarithmic = style.scale_option("log") and positive.count() > 0
    if limits:
        low, high = limits
    else:
        low, high = 0.0 if from_zero else float(np.percentile(shown.compressed(), LOW_SHARE)), _top_of_scale(shown.compressed(), peak, from_zero)
        low = float(positive.min()) if logarithmic else low
        high = high if high > low else low + (abs(low) or 1.0)
    return LogNorm(max(low, 1e-6 * high), high) if logarithmic and high > 0 else Normalize(low, high)


def _top_of_scale(values: Reals, peak: float, from_zero: bool) -> float:
    if peak == 0:
        return 1.0
    bulk, top = (float(value) for value in np.percentile(values, (BULK_SHARE, TOP_SHARE)))
    top = top if top > 0 and peak > TOP_EXCESS * top else peak
    return bulk if not from_zero and 0 < bulk < FLAT * top else top


def _beyond(values: Reals, norm: Normalize) -> str:
    """What the scale says of the cells above its end, where that leaves out more than isolated ones."""
    return f"{axes.percent(float(np.mean(values > norm.vmax)))} of these cells above the scale" if norm.vmax < np.percentile(values, TOP_SHARE) else ""


def _told(label: str, beyond: str) -> str:
    return label_of_bar(label, beyond, "; ", WIDTH) if beyond else label


def _draw_bar(figure: Figure, bar_ax: Axes, mesh: QuadMesh, scale: Scale, beyond: tuple[bool, bool]) -> None:
    bar = figure.colorbar(mesh, cax=bar_ax, orientation="horizontal", extend=EXTENDS[bool(beyond[0]), bool(beyond[1])])
    if isinstance(mesh.norm, LogNorm):
        axes.number_log_scale(bar_ax.xaxis)
    bar.outline.set_linewidth(0.6)
    bar.set_label(scale.label, fontsize=8)
    if scale.second:
        label, factor = scale.second
        ratio = factor / scale.factor
        second = bar_ax.secondary_xaxis("top", functions=((lambda f: f * ratio), (lambda n: n / ratio)))
        second.set_xlabel(label, fontsize=8)


def _mark(ax: Axes, file: PeterkaFile, peak: Largest, text: str) -> None:
    """Draws a cross at the largest value, with its text beside it; of a cell cut at the border of the picture, on this border."""
    x, y = (np.clip(value, *axis.edges[[0, -1]])
            for value, axis in ((peak.column_value, file.columns), (peak.row_value, file.rows)))
    ax.plot(
        x, y, marker="x", markersize=5, markeredgewidth=1.2, color="black", clip_on=False,
        path_effects=axes.outline(2.4), zorder=6, gid=SEEN,
    )
    border = ", on the map's border" if file.whole == "map" else ", on the border"
    write_beside(ax, x, y, f"max {text}{border if peak.on_border else ''}")
