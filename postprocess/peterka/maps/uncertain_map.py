"""What drawn rigs do, over the plane of a map with [uncertainty]: how likely a motion is, where most of them end, and the force that
all but 5 % of them reach.

Lines are drawn at probabilities that the number of draws can tell (peterka/sampling.py). Outcomes that a file doesn't keep, because
others are commoner, count as none of the motions asked for, but as impacts: most kinds of outcomes are p/q. In colour the commonest
outcome is the paler the less likely it is; in grey, where lightness tells classes apart, a line alone tells where it is likely.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from contourpy import contour_generator
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter, minimum_filter

from ..arrays import Integers, Mask, Reals, ma
from ..files.opened import OpenedFile
from ..files.regimes import FAILED, NO_IMPACT, NOT_COMPUTED, SUSTAINED_CONTACT, UNRESOLVED
from ..plotting import axes, style, units
from ..plotting.classes import CLASSES, INDEX, Class, classify
from ..plotting.coordinates import either
from ..plotting.fills import Fill, fill, paler
from ..plotting.limits import WEIGHTS
from ..plotting.picture import picture
from ..sampling import draws_needed
from . import field_map
from .attractor_maps import LEAST_SHARE, MOST_CLASSES, SHARES, reduced_values, undecided_in_words
from .field_map import Field, Scale, scale_colours
from .map_file import PeterkaFile
from .outcomes import OUTCOMES, Draws, draws_of, is_class, probability, quantiles, read_wanted
from .reduce import Reduced, orbit_picture

WIDTH = 3.7  # in
LINES = {0.5: (0, (1, 1.4)), 0.9: (0, (4, 1.6)), 0.95: "-"}  # probability: line style
LEVELS = ((0.95, 0.0), (0.75, 0.3), (0.5, 0.55), (0.0, 0.75))  # probability from which on, and share of white in the colour
HATCHES = {"chaotic": "..", "unresolved": "//"}
LABELS = ["outcome_regime", "outcome_impacts", "outcome_period", "outcome_probability"]
IMPACTS = "impacts"
WITHOUT_IMPACTS = (NO_IMPACT, SUSTAINED_CONTACT, UNRESOLVED, FAILED)  # kinds of outcomes
TICKS, TICK, TICKS_APART = "towards the likelier side", 0.018, 0.07  # gid; length and distance, of the picture
SPECK = 2.0  # cells: lines around less, as around one alone, are left out
ASSURED = 5  # %: of the quantile that all but so many draws reach
_COMMONEST: WeakKeyDictionary[PeterkaFile, list[str]] = WeakKeyDictionary()  # requested once for each of PROBABILITIES
PROBABILITIES = {f"probability_{name.removeprefix('share_')}": entry.label for name, entry in SHARES.items()}


@picture(PeterkaFile)
def draw_probability(file: PeterkaFile, ax: Axes | None = None, *, probability: str = IMPACTS) -> Axes | None:
    """The probability that a drawn rig ends in a motion: "impacts", "no impact", "chaotic", or p/q. None if none does."""
    draws, reduced = draws_of(file), probabilities(file, read_wanted(probability))
    levels, untold = lines_that_draws_tell(draws)
    unkept = _has_others(file, probability)
    undecided = undecided_in_words(file, LABELS[0], LABELS[3], "rigs") if probability == IMPACTS else []
    if not unkept and not np.nanmax(reduced.image, initial=0.0) > 0:
        return None
    lines = _lines(reduced, levels)
    waiting = [axes.legend_patch("not computed yet", None, hatched=True)] if file.computed < 1 else []
    figure, ax, bar_ax = axes.stack(WIDTH, reduced.image, [([*_line_handles(lines), *waiting], 3, None)], bar=True, ax=ax)
    axes.hatch_background(ax)
    mesh = ax.pcolormesh(reduced.column_edges, reduced.row_edges, ma.masked_invalid(reduced.image), cmap=scale_colours(),
                         vmin=0, vmax=1, rasterized=True)
    axes.label_axes(ax, file)
    _draw_lines(ax, reduced, lines)
    bar = figure.colorbar(mesh, cax=bar_ax, orientation="horizontal")
    bar.outline.set_linewidth(0.6)
    of = {IMPACTS: "impacts", "chaotic": "chaos"}.get(probability) or ("$z = %s$" % probability if "/" in probability else probability)
    bar.set_label(f"probability of {of}", fontsize=8)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, _told(file, draws, [*untold, *unkept, *undecided]), ax)
    return ax


@picture(PeterkaFile)
def draw_force(file: PeterkaFile, ax: Axes | None = None) -> Axes | None:
    """The force that all but 5 % of the drawn rigs reach, or impact speed; 0 where more of them don't impact or fail. None without one."""
    draws, name = draws_of(file), quantiles(file.data)[ASSURED]
    needed = draws_needed(1 - ASSURED / 100)
    few = [f"{draws.count} draws are too few to assure it: {needed} could"] if draws.count < needed else []
    field = Field(name, _is_computed, ("failed",), lambda largest: _scale(file, name, largest), told=_told(file, draws, few, place=False),
                  zero=f"0: more than {ASSURED} % of the rigs don't impact, or fail")
    return field_map.draw(file, field, ax)


@picture(PeterkaFile)
def draw_commonest(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The class of the commonest outcome, the paler the less likely it is."""
    draws = draws_of(file)
    reduced, counts = orbit_picture(file, ["regime", *LABELS[:3]], lambda _, *slots: classify(*(slot[0] for slot in slots)))
    likely = reduced_values(file, ["regime", *LABELS], lambda regime, *slots: _computed(regime, slots[3][0]), None)
    told, untold = lines_that_draws_tell(draws)
    lines = _lines(likely, told[-1:] if style.is_grey() or max(LINES) in told else [])
    orbits: list[Artist] = []
    others: list[Artist] = []
    for n in np.flatnonzero(counts):
        entry = axes.legend_patch(f"{CLASSES[n].label} ({axes.percent(counts[n] / counts.sum())})", _look_of(CLASSES[n]),
                                  n == INDEX["not computed yet"])
        (orbits if CLASSES[n].orbit or n == INDEX["other p/q"] else others).append(entry)
    legends = [(orbits, 3, f"commonest outcome (share of the {file.whole})"), (others, 2, None),
               (_level_handles(counts), 4, None if style.is_grey() else "its probability"), (_line_handles(lines, "ticks point to where it is likelier"), 1, None)]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, legends, ax=ax)
    shown, colours = _with_levels(reduced, likely)
    axes.show_classes(ax, shown, colours, INDEX["not computed yet"])
    axes.label_axes(ax, file)
    _draw_lines(ax, likely, lines, has_ticks=True)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, _told(file, draws, untold), ax)
    axes.name_areas(ax, _beside_lines(reduced, likely, list(lines)), {n: (entry.label, entry.colour) for n, entry in enumerate(CLASSES)
                                  if counts[n] and (entry.orbit or n == INDEX["no impact"])})
    return ax


def refuse_without_draws(file: OpenedFile) -> None:
    """Refuses to tell the probability of a motion where no rigs were drawn for the cells of a map."""
    if not isinstance(file, PeterkaFile) or file.kind != "map":
        raise file.refusal(f"is of kind {file.kind}; the probability of a motion is told of a map with [uncertainty]")
    if file.outcome_slots == 0:
        raise file.refusal("was computed for one rig alone, so that no motion has a probability; a job with [uncertainty] draws rigs for each cell")


def has(file: PeterkaFile, name: str) -> bool:
    """Whether a map has the probability picture of this one of PROBABILITIES: of the commonest outcomes."""
    return file.outcome_slots > 0 and name in _commonest(file)


def has_quantiles(file: PeterkaFile) -> bool:
    """Whether a map with outcomes has quantiles of forces or impact speeds."""
    return file.outcome_slots > 0 and bool(quantiles(file.data))


def probabilities(file: PeterkaFile, wanted: str) -> Reduced:
    """The probability of what is wanted (maps/outcomes.py) over the plane; NaN where nothing is computed."""
    counts_others = wanted == IMPACTS and file.data.has("outcome_others")

    def values(regime: Integers, *slots: NDArray[Any]) -> Reals:
        kept = probability(wanted, *slots[:4])
        return _computed(regime, kept + np.nan_to_num(slots[4]) if counts_others else kept)

    return reduced_values(file, ["regime", *LABELS, *["outcome_others"] * counts_others], values, None)


def lines_that_draws_tell(draws: Draws) -> tuple[list[float], list[str]]:
    """Those of LINES that so many draws can tell, and words for the others."""
    told = [level for level in LINES if draws.count >= draws_needed(level)]
    untold = [f"{level:g} ({draws_needed(level)} could)" for level in LINES if level not in told]
    return told, [f"draws too few for a line at {', '.join(untold)}"] if untold else []


def _told(file: PeterkaFile, draws: Draws, more: Sequence[str], place: bool = True) -> str:
    return "\n".join(filter(None, [axes.operating_point(file) if place else "", draws.in_words, *more]))


def _has_others(file: PeterkaFile, wanted: str) -> list[str]:
    """What a picture says of outcomes that aren't kept, none of which is likelier than the last one that is."""
    if not file.data.has("outcome_others"):
        return []
    most = max(_may_be_off(wanted, band) for _, band in file.bands(["regime", "outcome_others", *OUTCOMES]))
    return [f"where a cell has more than {file.outcome_slots} outcomes, the probability may be up to {rounded_up(most)} "
            f"{'lower' if wanted == IMPACTS else 'higher'}"] if most > 0 else []


def rounded_up(most: float) -> str:
    """A bound above 0 with two digits, no smaller than it is."""
    step = 10.0 ** (np.floor(np.log10(most)) - 1)
    return f"{np.ceil(most / step * (1 - 1e-12)) * step:.2g}"


def _may_be_off(wanted: str, band: Mapping[str, NDArray[Any]]) -> float:
    """By how much a probability may be off in a cell of a band, at most: the kinds asked for, or those without impacts, that aren't
    among the kept ones."""
    labels, shares, others = [band[name] for name in LABELS[:3]], band[LABELS[3]], np.nan_to_num(band["outcome_others"])
    if wanted == IMPACTS:
        missing = len(WITHOUT_IMPACTS) - np.isin(labels[0], WITHOUT_IMPACTS).sum(axis=0)
    else:
        missing = 1 - is_class(wanted, *labels).any(axis=0)
    off = np.minimum(others, missing * np.nan_to_num(shares[-1]))
    return float(np.max(np.where(band["regime"] == NOT_COMPUTED, 0.0, off), initial=0.0))


def _commonest(file: PeterkaFile) -> list[str]:
    if file not in _COMMONEST:
        _COMMONEST[file] = _find_commonest(file)
    return _COMMONEST[file]


def _find_commonest(file: PeterkaFile) -> list[str]:
    total, cells = np.zeros(len(CLASSES)), 0
    for _, band in file.bands(["regime", *OUTCOMES]):
        kinds = classify(*(band[name] for name in LABELS[:3]))
        total += np.bincount(kinds.ravel(), weights=np.nan_to_num(band[LABELS[3]]).ravel(), minlength=len(CLASSES))
        cells += int(np.sum(band["regime"] != NOT_COMPUTED))
    names = sorted(PROBABILITIES, key=lambda name: -float(total[INDEX[PROBABILITIES[name]]]))
    return [name for name in names[:MOST_CLASSES] if total[INDEX[PROBABILITIES[name]]] > LEAST_SHARE * max(cells, 1)]


def _computed(regime: Integers, values: Reals) -> Reals:
    return np.where(regime == NOT_COMPUTED, np.nan, values)


def _is_computed(regime: Integers, *_: object) -> Mask:
    mask: Mask = (regime != NOT_COMPUTED) & (regime != FAILED)
    return mask


def _scale(file: PeterkaFile, name: str, largest: float) -> Scale:
    if name.startswith("speed"):
        factor, unit = units.with_prefix(largest, "m/s")
        return Scale(f"impact speed of all but {ASSURED} % of the rigs ({unit})", factor, lambda speed: units.amount(speed, "m/s"),
                     in_si=("m/s", 1.0))
    label = f"peak force of all but {ASSURED} % of the rigs, $F/(m\\,g)$"
    newtons = file.newtons or 0.0
    if not newtons:
        return Scale(label, 1, units.number, ratio=WEIGHTS)
    factor, unit = units.with_prefix(largest * newtons, "N")
    alone = style.current().units == "si"
    return Scale(label, 1, lambda force: either(file, units.amount(force * newtons, "N"), units.number(force)),
                 (f"peak force of all but {ASSURED} % of the rigs ({unit})" if alone else f"peak force ({unit})", newtons * factor),
                 ("N", newtons), WEIGHTS)


def _look_of(entry: Class) -> str | Fill:
    """The look of a class: those without a hue are hatched, for where they are less likely their greys are nearly alike, and no impact's."""
    hatch = "" if style.is_grey() else HATCHES.get(entry.label, "")
    return Fill(entry.colour, hatch) if hatch else entry.colour


def _with_levels(reduced: Reduced, likely: Reduced) -> tuple[Reduced, list[str | Fill]]:
    """The classes of an image, each in the LEVELS of its probability, and the fills of all: class n of level m is the number
    n + m len(CLASSES)."""
    if style.is_grey():
        return reduced, [fill(entry.colour) for entry in CLASSES]
    level = np.argmax([np.nan_to_num(likely.image) >= least - 1e-9 for least, _ in LEVELS], axis=0)
    level[reduced.image == INDEX["not computed yet"]] = 0
    image = reduced.image.astype(np.int16) + level.astype(np.int16) * len(CLASSES)
    return replace(reduced, image=image), [paler(_look_of(entry), white) for _, white in LEVELS for entry in CLASSES]


def _beside_lines(reduced: Reduced, likely: Reduced, levels: Sequence[float]) -> Reduced:
    """The classes of an image without cells near lines, where no name would be legible."""
    size = 1 + 2 * max(1, max(reduced.image.shape) // 25)
    near = np.zeros(reduced.image.shape, dtype=bool)
    for level in levels:
        above = np.nan_to_num(likely.image) >= level
        near |= maximum_filter(above, size) & ~minimum_filter(above, size)
    return replace(reduced, image=np.where(near, INDEX["not computed yet"], reduced.image))


def _draw_ticks(ax: Axes, reduced: Reduced, line: Reals) -> None:
    """Ticks along a line, towards the side on which the image is larger."""
    within = ax.transScale + ax.transLimits
    places = within.transform(line)
    way = np.append(0, np.cumsum(np.hypot(*np.diff(places, axis=0).T)))
    for along in np.arange(TICKS_APART / 2, way[-1], TICKS_APART):
        ahead = np.array([np.interp([along - TICK, along + TICK], way, one) for one in places.T])
        own, (dx, dy) = np.array([np.interp(along, way, one) for one in places.T]), np.diff(ahead, axis=1)[:, 0]
        if not np.hypot(dx, dy) > 0:
            continue
        aside = TICK * np.array([-dy, dx]) / np.hypot(dx, dy)
        ends = [own + aside, own - aside]
        values = [_value_at(reduced, within.inverted().transform(end)) for end in ends]
        if np.isfinite(values).all() and values[0] != values[1]:
            ax.plot(*np.array([own, ends[int(np.argmax(values))]]).T, transform=ax.transAxes, color="black", linewidth=0.8, zorder=3.1,
                    path_effects=axes.outline(1.6), gid=TICKS)


def _value_at(reduced: Reduced, place: Sequence[float]) -> float:
    """The image at a place (column, row) in data; NaN beyond it."""
    row, column = (int(np.searchsorted(edges, value, side="right")) - 1
                   for edges, value in ((reduced.row_edges, place[1]), (reduced.column_edges, place[0])))
    rows, columns = reduced.image.shape
    return float(reduced.image[row, column]) if 0 <= row < rows and 0 <= column < columns else np.nan


def _level_handles(counts: Integers) -> list[Artist]:
    """Of the commonest class that has a colour."""
    if style.is_grey():
        return []
    coloured = [n for n in np.argsort(-counts, kind="stable") if CLASSES[n].orbit] or [INDEX["chaotic"]]
    above = [1.0, *(least for least, _ in LEVELS)]
    words = [f"≥ {least:g}" if top == 1 else f"{least:g}–{top:g}" if least else f"< {top:g}" for (least, _), top in zip(LEVELS, above)]
    return [axes.legend_patch(text, paler(CLASSES[coloured[0]].colour, white)) for text, (_, white) in zip(words, LEVELS)]


def _line_handles(lines: Iterable[float], more: str = "") -> list[Artist]:
    return [Line2D([], [], label=", ".join(filter(None, [f"probability {level:g}", more])), **_look(level)) for level in lines]


def _look(level: float) -> dict[str, Any]:
    return {"color": "black", "linewidth": 0.9, "linestyle": LINES[level]}


def _lines(reduced: Reduced, levels: Sequence[float]) -> dict[float, list[Reals]]:
    """The lines (points, 2) of those of these probabilities that have any, but for specks."""
    if min(reduced.image.shape) < 2:
        return {}
    x, y = (np.sqrt(edges[1:] * edges[:-1]) if log else (edges[1:] + edges[:-1]) / 2
            for edges, log in ((reduced.column_edges, reduced.log[1]), (reduced.row_edges, reduced.log[0])))
    contours = contour_generator(x, y, ma.masked_invalid(reduced.image))
    cell = np.array([np.ptp(values) / (len(values) - 1) for values in (x, y)])
    lines = {level: [line for line in contours.lines(level) if np.any(np.ptp(line, axis=0) >= SPECK * cell)] for level in levels}
    return {level: found for level, found in lines.items() if found}


def _draw_lines(ax: Axes, reduced: Reduced, lines: Mapping[float, Sequence[Reals]], has_ticks: bool = False) -> None:
    """`has_ticks`: whether lines have short ticks towards the side of the larger probability."""
    limits = ax.get_xlim(), ax.get_ylim()
    for level, found in lines.items():
        for line in found:
            ax.plot(*line.T, path_effects=axes.outline(1.8), zorder=3, **_look(level))
            if has_ticks:
                _draw_ticks(ax, reduced, line)
    ax.set(xlim=limits[0], ylim=limits[1])
