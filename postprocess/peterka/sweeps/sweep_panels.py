"""Shared by the pictures of a sweep: a panel per gap, the classes of the motions above it, second scales, measured points,
and the looks of the directions.

Directions differ in line, marker and brightness, so that they are distinguishable without colour. Their colours, and that of
measured points, differ from those of all classes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Integers, Reals
from ..plotting import axes, style
from ..plotting.classes import CLASSES, INDEX, classify, named
from ..plotting.coordinates import IN_MILLIMETRES, either, label
from ..plotting.fills import fill
from ..plotting.frames import text_width
from ..measurements import marks
from ..measurements.points import Measurements
from .sweep_file import Branch, SweepFile

WIDTH, HEAD, PANEL = 7.0, 0.45, 2.05  # in: two journal columns, the scales above and below, and the height of one panel
STRIP = 0.085  # height of a branch's row of classes over that of its panel
ROW, NOTE_LETTERS = 0.085, 6.5  # height of a line of notes over that of the panel, and size of its letters [pt]
BESIDE, ABOVE = 16, 27  # pt: of a gap over its panel, beside the name of the scale there or above it
STRIP_LETTERS = 0.011  # width of a 6.5 pt letter over that of a panel
EXACT = 13  # significant digits that a number keeps in another unit


@dataclass(frozen=True)
class Look:
    """Look of a direction; {axis} in its label stands for the swept coordinate."""

    label: str
    colour: str
    linestyle: str | tuple[float, tuple[float, ...]]
    marker: str
    linewidth: float
    zorder: float


LOOKS = {
    "up": Look("{axis} rising", "#003355", "-", "^", 1.6, 2.0),
    "down": Look("{axis} falling", "#0099AA", (0, (3.5, 1.8)), "v", 1.1, 2.2),
    "independent": Look("each from the start", "#003355", "-", "o", 1.3, 2.0),
}


def direction_words(file: SweepFile, direction: str) -> str:
    """A direction for the legend: "frequency rising"."""
    usual = {"frequency_ratio": "frequency", "frequency_hz": "frequency", "gap_ratio": "gap"}
    axis = usual.get(file.axis_name) or label(file.axis_name).partition(" (")[0]
    return LOOKS[direction].label.format(axis=axis)


def panels(file: SweepFile, handles: Sequence[Artist], ylabel: str, second: tuple[str, float] | None, ax: Axes | None = None,
           log: bool = False, told: str = "") -> dict[float | None, Axes]:
    """A figure with an Axes per gap, with the classes of its branches and its gap above it.

    `second` is the (label, factor) of a second scale at the right, or None;
    `log`: whether the vertical axis is logarithmic; `told`: in the title. Returns {gap: Axes}."""
    figure, all_axes = axes.diagram(WIDTH, HEAD + PANEL * len(file.gaps), [*handles, *_class_handles(file)],
                                    panels=len(file.gaps), columns=4, ax=ax)
    for number, (gap, ax) in enumerate(zip(file.gaps, all_axes)):
        if file.cells.log:
            axes.log_scale(ax, "x")
        ax.set_xlim(*_edges(file)[[0, -1]])
        ax.set_ylabel(ylabel)
        if log:
            axes.log_scale(ax, "y")
        ax.grid(color="#DDDDDD", linewidth=0.5)
        ax.set_axisbelow(True)
        ax.tick_params(labelbottom=number == len(all_axes) - 1)
        _show_classes(ax, file, gap)
        is_last = number == len(all_axes) - 1
        if is_last:
            ax.set_xlabel(label(file.axis_name))
        has_scale_above = _second_scales(ax, file, second, number == 0, is_last)
        above = 1 + STRIP * len(file.at_gap(gap))
        text = _gap_text(file, gap)
        away = 3 if not has_scale_above else BESIDE if _has_room_beside(ax, text) else ABOVE
        ax.annotate(text, (0, above), xycoords="axes fraction", xytext=(0, away), textcoords="offset points", va="bottom",
                    fontsize=8, weight="bold")
    axes.write_title(figure, file, axes.so_far(file) + told, all_axes[0])
    return dict(zip(file.gaps, all_axes))


def measured_handles(measured: Measurements, quantity: str) -> list[Artist]:
    """Legend entries: one for each series that has points with this quantity."""
    return marks.handles([point for point in measured.points if getattr(point, quantity) is not None])


def draw_measured(ax: Axes, measured: Measurements, gap: float | None, quantity: str, limits: tuple[float, float] | None = None) -> None:
    """Draws points at the height `quantity`, of those `limits` requested within them; points with only a frequency are marks across the panel."""
    low, high = ax.get_xlim()
    bottom, top = limits or (-np.inf, np.inf)
    points = [point for point in measured.at_gap(gap) if low <= point.frequency <= high]
    marked = [point for point in points if getattr(point, quantity) is not None and bottom <= getattr(point, quantity) <= top]
    everyone = [point for point in measured.points if getattr(point, quantity) is not None]
    marks.draw(ax, marked, ("frequency", quantity), everyone)
    ax.set_xlim(low, high)
    marks.vertical_marks(ax, [point for point in points if point.force is None and point.displacement is None])
    marks.name(ax, marked, ("frequency", quantity), 7)


def head_notes(ax: Axes, notes: Sequence[tuple[float, float, str, str]], top: float, bottom: float = 0.0,
               keeps: bool = False) -> None:
    """Writes notes (frequency, height, text, colour) above all data, in as few lines as have room, each with a thin
    line down to its place; the data reach from `bottom` up to `top`, and so does the scale if it `keeps` to that: then notes may
    stand over data. Once the layout is made."""
    width = ax.bbox.width / ax.get_figure().dpi
    placed: list[tuple[int, float, float, float, str, str]] = []
    ends: list[float] = []
    for frequency, height, text, colour in sorted(notes):
        taken = 0.01 + text_width(text, NOTE_LETTERS) / width
        first = max(min(float(across(ax, frequency)), 1 - taken), 0)
        # below every note that it would run into: the lines down cross none of them
        line = max((other[0] + 1 for other, end in zip(placed, ends) if end > first), default=0)
        placed.append((line, first, frequency, height, text, colour))
        ends.append(first + taken)
    head = 0.0 if keeps else ROW * max((note[0] + 1 for note in placed), default=0) + 0.03
    logarithmic = ax.get_yscale() == "log"
    ax.set_ylim(bottom, bottom * (top / bottom) ** (1 / (1 - head)) if logarithmic else bottom + (top - bottom) / (1 - head))
    for line, first, frequency, height, text, colour in placed:
        foot = 1 - 0.02 - ROW * (line + 1)
        ax.annotate(text, (first + 0.004, foot), xycoords="axes fraction", va="bottom", fontsize=NOTE_LETTERS,
                    color="black" if style.is_grey() else colour,  # that of a branch would be pale there
                    path_effects=axes.outline(2), zorder=8)
        ax.plot([frequency, frequency], [height, _at_share(ax, foot)], color=colour, linewidth=0.5, zorder=1.5)


def line_through(file: SweepFile, values: Reals) -> tuple[Reals, Reals]:
    """(x, y) of a line through values at all points, (..., points): that of one point alone goes across its cell."""
    return (file.values, values) if len(file.values) > 1 else (file.cells.edges, np.repeat(values, 2, axis=-1))


def direction_handles(file: SweepFile, values: Callable[[Branch], Reals]) -> list[Artist]:
    """Legend entries of the directions, and of motions without a period that have a value, one of `values` (points,) of a branch."""
    handles: list[Artist] = []
    for name in directions(file):
        look = LOOKS[name]
        handles.append(Line2D([], [], label=direction_words(file, name), color=look.colour, linestyle=look.linestyle, linewidth=look.linewidth))
        if any(np.isfinite(values(branch)[~branch.has_period]).any() for branch in file.branches if branch.direction == name):
            handles.append(Line2D([], [], label=f"no period, {direction_words(file, name)}", color=look.colour, marker=look.marker,
                                  markersize=2.5, linestyle="none"))
    return handles


def draw_branch(ax: Axes, file: SweepFile, branch: Branch, values: Reals) -> None:
    """Draws values of a branch, (points,): a line where its motions have a period, ended where they jump, a dash where neither neighbour
    is joined, and a point of each motion without a period."""
    look = LOOKS[branch.direction]
    along, y = line_through(file, np.where(branch.has_period, values, np.nan))
    cuts = np.flatnonzero(branch.jump) + (1 if branch.direction == "down" else 0)
    ax.plot(np.insert(along, cuts, np.nan), np.insert(y, cuts, np.nan), color=look.colour, linestyle=look.linestyle,
            linewidth=look.linewidth, zorder=look.zorder)
    known = branch.has_period & np.isfinite(values)
    joined = known[:-1] & known[1:]
    joined[cuts[(cuts > 0) & (cuts < len(known))] - 1] = False
    alone = known & ~np.append(joined, False) & ~np.insert(joined, 0, False) if len(known) > 1 else np.zeros_like(known)
    ax.plot(file.values[alone], values[alone], color=look.colour, marker="_", markersize=3, markeredgewidth=look.linewidth,
            linestyle="none", zorder=look.zorder)
    apart = ~branch.has_period & np.isfinite(values)
    ax.plot(file.values[apart], values[apart], color=look.colour, marker=look.marker, markersize=1.8, markeredgewidth=0,
            linestyle="none", zorder=look.zorder - 0.5)


def across(ax: Axes, places: Reals | float) -> Reals:
    """Where places on the axis lie in a panel, 0 at its left to 1 at its right."""
    low, high = ax.get_xlim()
    shares: Reals = np.log(places / low) / np.log(high / low) if ax.get_xscale() == "log" else np.asarray((places - low) / (high - low))
    return shares


def _at_share(ax: Axes, share: float) -> float:
    """The height at this relative position in a panel."""
    low, high = ax.get_ylim()
    return float(low * (high / low) ** share if ax.get_yscale() == "log" else low + share * (high - low))


def place_text(file: SweepFile, value: float) -> str:
    """A place on the axis in words: its ratio, and in Hz or mm if the file gives them, the job's own unit first, or either alone
    as the picture's units."""
    scale = axes.si_scale(file, file.axis_name)
    replaces = file.axis_name in IN_MILLIMETRES
    digits = _digits_apart(file.values)
    if scale is None:
        return f"{value:.{digits}g} {label(file.axis_name).partition(' (')[2].rstrip(')')}".rstrip()
    name, factor = scale
    # the ratio of 20.375 Hz gives back 20.374999..., which would be rounded down
    in_units = f"{float(f'{value * factor:.{EXACT}g}'):.{digits}g} {name.rpartition('(')[2].rstrip(')')}"
    if replaces:
        return in_units
    return either(file, in_units, f"{value:.{digits}g}")


def _digits_apart(values: Reals) -> int:
    """Significant digits, 4 at least, that tell neighbouring values and places half-way between apart: the rule of the
    program's summary, so that both print a place alike."""
    larger = np.maximum(np.abs(values[1:]), np.abs(values[:-1]))
    least = np.min(np.abs(np.diff(values)) / larger, initial=1)
    return int(np.clip(np.ceil(1 - np.log10(least / 2)), 4, 12))


def directions(file: SweepFile) -> list[str]:
    """The directions of all branches, each once, in the order of the file."""
    return list(dict.fromkeys(branch.direction for branch in file.branches))


def _gap_text(file: SweepFile, gap: float | None) -> str:
    if gap is None:
        return ""
    if file.gap_name == "gap_m":
        return f"gap = {1000 * gap:.3g} mm"
    metres = file.positive("cart_amplitude_m")
    in_millimetres = f"gap = {1000 * gap * metres:.3g} mm" if metres else ""
    return either(file, in_millimetres, f"gap/A₀ = {gap:.4g}").replace("(gap = ", "(")


def _has_room_beside(ax: Axes, text: str) -> bool:
    """Whether a gap and the name of a scale above the middle of its panel stand in one line."""
    name = max((text_width(scale.get_xlabel(), 8) for scale in ax.child_axes), default=0.0)
    return bool(1.15 * text_width(text, 8) + name / 2 < ax.bbox.width / ax.get_figure().dpi / 2)  # letters are bold


def _second_scales(ax: Axes, file: SweepFile, second: tuple[str, float] | None, top: bool, bottom: bool) -> bool:
    """Of a panel, which may be the top or the bottom one; whether it has one above."""
    scale, replaces = None, file.axis_name in IN_MILLIMETRES
    if bottom if replaces or style.current().units == "si" else top:
        scale = axes.second_scale(ax, "x", axes.si_scale(file, file.axis_name), 1 + STRIP * len(file.at_gap(file.gaps[0])), replaces)
    axes.second_scale(ax, "y", second)
    return scale is not None


def _classes(branch: Branch) -> Integers:
    return classify(branch.regime, branch.impacts, branch.period)


def _shown(file: SweepFile) -> Integers:
    """The displayed class of each class, common to all panels."""
    return named(np.bincount(np.concatenate([_classes(branch) for branch in file.branches]), minlength=len(CLASSES)))


def _class_handles(file: SweepFile) -> list[Artist]:
    present = np.unique(_shown(file)[np.concatenate([_classes(branch) for branch in file.branches])])
    missing = INDEX["not computed yet"]
    return [axes.legend_patch(CLASSES[i].label, CLASSES[i].colour, hatched=i == missing) for i in present]


def _show_classes(ax: Axes, file: SweepFile, gap: float | None) -> None:
    """A row of classes per branch, the first at the bottom, each with the mark of its direction."""
    edges, shown = across(ax, _edges(file)), _shown(file)
    for place, branch in enumerate(file.at_gap(gap)):
        strip = ax.inset_axes([0, 1 + STRIP * place, 1, STRIP])
        strip.set(xlim=(0, 1), ylim=(0, 1), xticks=[], yticks=[])
        numbers = shown[_classes(branch)]
        changes = np.flatnonzero(np.diff(numbers)) + 1
        for first, last in zip([0, *changes], [*changes, len(numbers)]):
            entry = CLASSES[numbers[first]]
            look = fill(entry.colour)
            strip.axvspan(edges[first], edges[last], facecolor=look.colour, edgecolor=look.stroke, hatch=3 * look.hatch,
                          linewidth=0)
            if edges[last] - edges[first] > STRIP_LETTERS * (len(entry.label) + 1):
                strip.text((edges[first] + edges[last]) / 2, 0.46, entry.label, ha="center", va="center", fontsize=6.5,
                           color=axes.letter_colour(look.colour), path_effects=axes.outline(1.5, look.colour))
        direction = LOOKS[branch.direction]
        strip.plot(-0.008, 0.5, marker=direction.marker, markersize=3, color=direction.colour, clip_on=False,
                   transform=strip.transAxes)


def _edges(file: SweepFile) -> Reals:
    """Of the stretches of the axis that points stand for, which end at the outermost ones; one point alone has a cell of a map."""
    ends = file.values if len(file.values) > 1 else file.cells.edges
    return np.concatenate([ends[:1], file.cells.edges[1:-1], ends[-1:]])
