"""Basins of attraction over the start plane, x(0)/A0 and x'(0)/(A0 omega) (the paper's Fig. 24).

By attractor: each has the colour of its class of z; further attractors of the same class have paler or darker shades. A dot
marks the attractor itself if it lies inside the picture; the legend mentions those outside. Its position is the stroboscopic
point at forcing phase 0, where the cart is at 0 and moves at A0 Omega, so that the stored relative state (u, u') corresponds
to the start (u, u' + Omega/omega). A line marks the stop at the start, x = gap.
By impact: the paper's two colours, impact and no impact; chaos counts as impact, undecided cells stay separate. If the file
has the time of the last impact, also as seen by a run of a given number of cycles.
"""

from collections import Counter
from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb
from matplotlib.lines import Line2D

from ..arrays import Integers
from ..files.coordinates import unit_of
from ..files.job_numbers import edge_of_no_impact
from ..files.regimes import CHAOTIC, NO_IMPACT, PERIODIC
from ..plotting import axes, style, units
from ..plotting.classes import CLASSES, INDEX, class_of, classify
from ..plotting.fills import Fill, fill
from ..plotting.picture import picture
from .map_file import PeterkaFile
from .reduce import class_picture
from .tables import Attractors

WIDTH = 3.7  # in
NAMED_ATTRACTORS = 20  # longer legends are unreadable; the smaller basins share one colour
SHADES = [(0, "white"), (0.5, "white"), (0.4, "black"), (0.75, "white"), (0.65, "black")]  # mixed into a class's colour
HATCHES = ["", "//", "\\\\", "xx", ".."]  # for these shades in the grey palette
OTHER_COLOUR = CLASSES[INDEX["other p/q"]].colour
MARK = {"marker": "o", "markersize": 5, "markeredgecolor": "black", "markeredgewidth": 0.8, "linestyle": "none",
        "path_effects": axes.outline(2.0), "zorder": 6}
STOP = {"color": "black", "linewidth": 0.9, "linestyle": (0, (1, 1.2)), "path_effects": axes.outline(1.8), "zorder": 5}
IMPACT_COLOUR, NO_IMPACT_COLOUR = "#0072B2", "#FF7F5C"  # this red is pale enough to differ from the blue in grey


@picture(PeterkaFile)
def draw_attractors(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The basin of each attractor of a basin file, with its share of the starts, as Axes."""
    table = file.attractors
    assert table is not None
    named = _largest_attractors(table)
    named_entries = _attractor_entries(table, named, *((file.newtons, unit_of(file, "displacement_ratio")) if style.current().units == "si" else (None, None)))
    # Labels below len(CLASSES) are classes, for starts without an attractor; then the named attractors, then the rest.
    entries = _class_entries() + named_entries + [("other attractors", OTHER_COLOUR)]
    number = np.full(table.count + 1, len(entries) - 1)
    number[named] = len(CLASSES) + np.arange(len(named))

    def label(attractor: Integers, regime: Integers, impacts: Integers, period: Integers) -> Integers:
        return np.where(attractor >= 0, number[attractor], classify(regime, impacts, period))

    marks = _attractor_points(file, named, named_entries)
    inside = [point for point in marks if _is_inside(file, point)]
    ax = _draw(file, ax, ["attractor", "regime", "impacts", "period"], label, entries, 1,
                       _mark_handles(file, len(inside), len(marks) - len(inside), int(np.max(table.period[named], initial=1))))
    for x, y, colour in inside:
        ax.plot(x, y, **MARK | {"markerfacecolor": fill(colour).colour})
    return ax


@picture(PeterkaFile)
def draw_impact(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The starts that end in impacts and those that do not, as Axes."""
    entries = [*_class_entries(), ("impact", IMPACT_COLOUR)]
    entries[INDEX["no impact"]] = ("no impact", NO_IMPACT_COLOUR)

    def label(regime: Integers, impacts: Integers, period: Integers) -> Integers:
        hits = (regime == PERIODIC) | (regime == CHAOTIC)
        return np.where(hits, len(CLASSES), classify(regime, impacts, period))

    return _draw(file, ax, ["regime", "impacts", "period"], label, entries, 2)


@picture(PeterkaFile)
def draw_impact_after(file: PeterkaFile, ax: Axes | None = None, *, cycles: int = 300) -> Axes:
    """The starts that still impact after a number of forcing cycles and those that do not: a run that stops then mistakes
    them for two attractors, where impacts are merely a long transient."""
    entries = [*_class_entries(), (f"impact after {cycles} cycles", IMPACT_COLOUR)]
    entries[INDEX["no impact"]] = ("no impact any more", NO_IMPACT_COLOUR)

    def label(regime: Integers, impacts: Integers, period: Integers, last_impact: Integers) -> Integers:
        hits = (regime == PERIODIC) | (regime == CHAOTIC) | ((regime == NO_IMPACT) & (last_impact > cycles))
        return np.where(hits, len(CLASSES), classify(regime, impacts, period))

    return _draw(file, ax, ["regime", "impacts", "period", "last_impact"], label, entries, 1)


def _draw(file: PeterkaFile, ax: Axes | None, names: Sequence[str], label: Callable[..., Integers],
          entries: Sequence[tuple[str, str | Fill]], columns: int, marks: Sequence[Artist] = ()) -> Axes:
    """Axes of labelled starts; `entries` holds (legend text, colour) for each
    label, `columns` is the legend's, `marks` are additional legend entries."""
    reduced, counts = class_picture(file, names, label, len(entries))
    gap = file.number("gap_ratio")
    shows_stop = gap is not None and file.columns.edges[0] <= gap <= file.columns.edges[-1]
    stop = [Line2D([], [], label="stop at $t$ = 0: $x$ = gap", **STOP)] if shows_stop else []
    legends = [(_legend_entries(counts, entries), columns, None), ([*marks, *stop, *_missed_free_motion(file)], 1, None)]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, legends, ax=ax)
    axes.show_classes(ax, reduced, [colour for _, colour in entries], INDEX["not computed yet"])
    axes.label_axes(ax, file)
    if shows_stop:
        ax.axvline(gap, **STOP)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, axes.operating_point(file), ax)
    return ax


def _missed_free_motion(file: PeterkaFile) -> list[Artist]:
    """An entry for the motion without impact, known from the closed form for linear springs, if no start ends on it."""
    ratio, damping, gap = file.positive("frequency_ratio"), file.number("damping_ratio"), file.number("gap_ratio")
    if ratio is None or damping is None or gap is None or file.computed != 1 or not edge_of_no_impact(ratio, damping) < gap:
        return []
    if any((band["regime"] == NO_IMPACT).any() for _, band in file.bands(["regime"])):
        return []
    return [Line2D([], [], label="a motion without impact exists, too:\nnone of these starts ends on it", linestyle="none")]


def _class_entries() -> list[tuple[str, str | Fill]]:
    return [(entry.label, entry.colour) for entry in CLASSES]


def _legend_entries(counts: Integers, entries: Sequence[tuple[str, str | Fill]]) -> list[Artist]:
    largest_first = sorted(np.flatnonzero(counts), key=lambda n: -int(counts[n]))
    return [
        axes.legend_patch(f"{entries[n][0]} ({axes.percent(counts[n] / counts.sum())})", entries[n][1],
                          n == INDEX["not computed yet"])
        for n in largest_first
    ]


def _largest_attractors(table: Attractors) -> Integers:
    """Rows of the table with most starts, at most NAMED_ATTRACTORS, in table order."""
    by_size = np.argsort(-table.cells.astype(np.int64), kind="stable")
    return np.sort(by_size[:NAMED_ATTRACTORS])


def _attractor_entries(table: Attractors, named: Integers, newtons: float | None, metres: float | None) -> list[tuple[str, str | Fill]]:
    """(legend text, colour) of each named attractor: class of z, force with enough digits to distinguish it within the
    class, and a shade of the class's colour. On a rigid stop, which has no force, several of a class are distinguished by u at forcing phase 0.
    The force is given over the weight, or in N if `newtons` (the weight) is known, u over A0, or in mm if `metres` (A0) is."""
    seen: Counter[str] = Counter()
    entries: list[tuple[str, str | Fill]] = []
    classes = [class_of(table.regime[row], table.impacts[row], table.period[row]) for row in named]
    for row, entry in zip(named, classes):
        text = f"$z$ = {entry.label}" if table.regime[row] == PERIODIC else entry.label
        if table.regime[row] != NO_IMPACT and np.isfinite(table.peak_force_ratio[row]):
            factor = newtons or 1.0
            others = [factor * table.peak_force_ratio[other] for other, theirs in zip(named, classes) if theirs == entry]
            force = units.number_apart(factor * table.peak_force_ratio[row], others)
            is_one = "" if table.regime[row] != CHAOTIC else " of one start"  # others observe a little more or less
            text += (f", $F$ = {force} N" if newtons else f", $F/(m\\,g)$ = {force}") + is_one
        elif table.regime[row] == PERIODIC and classes.count(entry) > 1:
            factor = 1e3 * metres if metres else 1.0
            others = [factor * table.orbit_displacement[other] for other, theirs in zip(named, classes) if theirs == entry]
            displacement = units.number_apart(factor * table.orbit_displacement[row], others)
            text += f", $u$ = {displacement} mm" if metres else f", $u/A_0$ = {displacement}"
        entries.append((text, _shade(entry.colour, seen[entry.colour])))
        seen[entry.colour] += 1
    return entries


def _shade(colour: str, repeat: int) -> str | Fill:
    weight, towards = SHADES[repeat % len(SHADES)]
    if style.is_grey() and repeat:
        return Fill(_mixed(fill(colour).colour, weight / 2, towards), HATCHES[repeat % len(HATCHES)])
    return _mixed(colour, weight, towards) if weight else colour


def _mixed(colour: str, weight: float, towards: str) -> str:
    mixed: str = to_hex([(1 - weight) * own + weight * other for own, other in zip(to_rgb(colour), to_rgb(towards))])
    return mixed


def _attractor_points(file: PeterkaFile, named: Integers,
                      entries: Sequence[tuple[str, str | Fill]]) -> list[tuple[float, float, str | Fill]]:
    """(x/A0, x'/(A0 omega), colour) of a point of each orbit at phase 0, of q; a chaotic attractor is not a single point."""
    frequency_ratio, table = file.positive("frequency_ratio"), file.attractors
    if frequency_ratio is None or table is None:
        return []
    points = [(table.orbit_displacement[row], table.orbit_velocity[row] + frequency_ratio, colour)
              for row, (_, colour) in zip(named, entries) if table.regime[row] != CHAOTIC]
    return [point for point in points if np.isfinite(point[:2]).all()]


def _is_inside(file: PeterkaFile, point: tuple[float, float, str | Fill]) -> bool:
    return all(axis.edges[0] <= value <= axis.edges[-1] for axis, value in zip((file.columns, file.rows), point))


def _mark_handles(file: PeterkaFile, inside: int, outside: int, longest: int) -> list[Artist]:
    """longest: the largest number of cycles of an attractor."""
    of_what = "its attractor," if longest == 1 else "a point of its attractor"
    handles = [Line2D([], [], label=f"{of_what} at forcing phase 0{_relative_in_words(file)}", **MARK | {"markerfacecolor": "white"})]
    handles = handles if inside else []
    if outside:
        kind = "attractor" if longest == 1 else "point"
        words = f"1 {kind} lies" if outside == 1 else f"{outside} {kind}s lie"
        handles.append(Line2D([], [], label=f"{words} outside the picture", linestyle="none"))
    return handles


def _relative_in_words(file: PeterkaFile) -> str:
    """How the point of an attractor in the picture follows from that of the program's summary, relative to the cart."""
    ratio, unit = file.positive("frequency_ratio"), unit_of(file, "velocity_ratio")
    if ratio is None:
        return ""
    if unit is None or style.current().units == "ratio":
        return f":\n$x = u$, $\\dot{{x}} = \\dot{{u}} + A_0\\Omega$, $A_0\\Omega/(A_0\\omega)$ = {ratio:.4g}"
    return f":\n$x = u$, $\\dot{{x}} = \\dot{{u}} + A_0\\Omega$, $A_0\\Omega$ = {units.amount(ratio * unit, 'm/s')}"
