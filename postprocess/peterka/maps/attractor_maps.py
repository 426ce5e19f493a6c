"""Results of many starts per cell: number of attractors, the most frequent one, the share with impacts, the critical kick.

Numbers of attractors grow darker, shares and kicks lighter, so that all are readable in grey; regimes have the colours of
the Peterka map. Blocks of a reduced map show their mean share, and the kick of their most fragile cell.
"""

from collections.abc import Callable, Sequence
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..arrays import Integers, Reals, ma
from ..files.regimes import CHAOTIC, FAILED, NOT_COMPUTED, PERIODIC, UNRESOLVED
from ..plotting import axes
from ..plotting.classes import CLASSES, INDEX, classify
from ..plotting.limits import beyond, requested
from ..plotting.picture import picture
from .field_map import scale_colours, without_value
from .map_file import KICKS, PeterkaFile
from .reduce import LIMIT, Reduced, block_size, class_picture, orbit_picture, with_edges

WIDTH = 3.7  # in
NUMBERS = ["not computed yet", "none", "1", "2", "3", "4", "5 or more"]
NUMBER_COLOURS = ["#FFFFFF", CLASSES[INDEX["unresolved"]].colour, "#F2F2F2", "#9ECAE1", "#4292C6", "#08519C", "#041E42"]
MOST_CLASSES = 6  # of z, each with its own picture
LEAST_SHARE = 0.005  # of the plane; rarer ones get no picture
LABELS = ["regime", "attractor_regime", "attractor_impacts", "attractor_period", "basin_share"]


SHARES = {f"share_{'_'.join(map(str, entry.orbit)) if entry.orbit else entry.label.replace(' ', '_')}": entry
          for entry in CLASSES if entry.orbit or entry.label in ("no impact", "chaotic")}
_COMMONEST: WeakKeyDictionary[PeterkaFile, list[str]] = WeakKeyDictionary()  # requested once for each of SHARES
END_WORDS = {"no impact": "without impacts", "chaotic": "in chaos"}
LACKING_COLOUR = "#F7C6D0"
UNDECIDED = (UNRESOLVED, FAILED)
ROUNDING = 1e-6  # of shares that add up to 1
MOST_UNDECIDED = 0.5  # share of starts or rigs without a result from which on a cell has no share of impacts
NO_ORBIT, WAITING, ALONE, NONE_FOUND, FILLED, THROWN = range(6)  # outcome of a kick in a cell
KIND_COLOURS = [LACKING_COLOUR, "#FFFFFF", "#F2F2F2", "#C9B8E8", "#BFE3D0", "#FFFFFF"]
KIND_HATCHES = ["++", "", "", "\\\\", "..", ""]  # in the grey palette


@picture(PeterkaFile)
def draw_number(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The number of known attractors of a cell: those reached by its starts, and others."""
    def label(regime: Integers, attractors: Integers, slots: Integers) -> Integers:
        return np.where(regime == NOT_COMPUTED, 0, 1 + np.minimum(_known(attractors, slots), len(NUMBERS) - 2))

    reduced, counts = class_picture(file, ["regime", "attractors", "attractor_regime"], label, len(NUMBERS))
    handles = [axes.legend_patch(f"{NUMBERS[n]} ({axes.percent(counts[n] / counts.sum())})", NUMBER_COLOURS[n], n == 0)
               for n in np.flatnonzero(counts)]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, [(handles, 3, f"known attractors of a cell (share of the {file.whole})")], ax=ax)
    axes.show_classes(ax, reduced, NUMBER_COLOURS, 0)
    return _finished(figure, ax, file)


@picture(PeterkaFile)
def draw_largest(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The class of the attractor reached by most starts."""
    names = ["regime", "attractor_regime", "attractor_impacts", "attractor_period"]
    reduced, counts = orbit_picture(file, names, lambda _, *slots: classify(*(slot[0] for slot in slots)))
    orbits: list[Artist] = []
    others: list[Artist] = []
    for n in np.flatnonzero(counts):
        text = f"{CLASSES[n].label} ({axes.percent(counts[n] / counts.sum())})"
        entry = axes.legend_patch(text, CLASSES[n].colour, n == INDEX["not computed yet"])
        (orbits if CLASSES[n].orbit or n == INDEX["other p/q"] else others).append(entry)
    legends = [(orbits, 3, f"where most starts end (share of the {file.whole})"), (others, 2, None)]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, legends, ax=ax)
    axes.show_classes(ax, reduced, [entry.colour for entry in CLASSES], INDEX["not computed yet"])
    named = {n: (entry.label, entry.colour) for n, entry in enumerate(CLASSES)
             if counts[n] and (entry.orbit or n == INDEX["no impact"])}
    _finished(figure, ax, file)
    axes.name_areas(ax, reduced, named)  # into the plane, as labels are drawn
    return ax


@picture(PeterkaFile)
def draw_kick(file: PeterkaFile, ax: Axes | None = None) -> Axes | None:
    """The critical kick of the periodic attractor with the largest share, or of the cell's own orbit; cells without one are
    distinguished by whether another motion is known. None if no orbit was kicked."""
    names = ["regime", *KICKS] + (["attractors", "attractor_regime"] if file.slots else [])
    filled = ["computed"] if file.is_refined else []

    def kinds(regime: Integers, kick: Reals, tried: Reals, *more: Integers) -> Integers:
        known, computed = (more[:-1], more[-1]) if filled else (more, None)
        kick, tried = (_of_kicked(values, tried) for values in (kick, tried))
        others = np.where(_known(*known) == 1, ALONE, NONE_FOUND) if known else np.full(regime.shape, NONE_FOUND)
        kind = np.where(np.isfinite(kick), THROWN, np.where(np.isfinite(tried), others, NO_ORBIT))
        if computed is not None:
            kind = np.where((computed == 0) & (regime == PERIODIC), FILLED, kind)
        return np.where(regime == NOT_COMPUTED, WAITING, kind)

    def values(regime: Integers, kick: Reals, tried: Reals, *_: Integers) -> Reals:
        return np.where(regime == NOT_COMPUTED, np.nan, _of_kicked(kick, tried))

    classes, counts = class_picture(file, names + filled, kinds, len(KIND_COLOURS))
    if not counts[[ALONE, NONE_FOUND, THROWN]].any():
        return None
    reduced = reduced_values(file, names, values, np.fmin)
    top = float(np.nanpercentile(reduced.image, 99.9)) if counts[THROWN] else 1.0
    least, most = (f"{size:.3g}" for size in _tried_without(file))
    tried = f"{least} m/s" if least == most else f"{least}–{most} m/s"
    texts = {NO_ORBIT: "no orbit", ALONE: f"one motion alone known, no kick up to {tried}",
             NONE_FOUND: f"no kick found up to {tried}", FILLED: "filled from the cells around: not kicked", WAITING: "not computed yet"}
    looks = [without_value(*look) for look in zip(KIND_COLOURS, KIND_HATCHES)]
    handles = [axes.legend_patch(text, looks[kind], hatched=kind == WAITING) for kind, text in texts.items() if counts[kind]]
    figure, ax, bar_ax = axes.stack(WIDTH, reduced.image, [(handles, 1, None)], bar=True, ax=ax)
    axes.show_classes(ax, classes, looks, WAITING)
    whose = "likeliest orbit" if file.slots else "orbit"
    return _with_scale(figure, ax, bar_ax, file, reduced, f"critical kick of the {whose}, at its worst phase (m/s)", top, unit="m/s")


def _known(attractors: Integers, slots: Integers) -> Integers:
    """The number of known attractors of each cell; slots (slot, row, column) hold the regimes of the stored ones, starts without a
    result among them, which are none."""
    number: Integers = np.maximum(attractors, (slots != NOT_COMPUTED).sum(axis=0)) - np.isin(slots, UNDECIDED).sum(axis=0)
    return number


def _of_kicked(values: Reals, tried: Reals) -> Reals:
    """The values of the first slot with a kicked orbit, or of the cell: (rows, columns)."""
    if values.ndim == 2:
        return values
    found: Reals = np.take_along_axis(values, np.argmax(np.isfinite(tried), axis=0)[None], axis=0)[0]
    return found


def _tried_without(file: PeterkaFile) -> tuple[float, float]:
    """The smallest and the largest limit up to which cells without a critical kick were tested, m/s."""
    least, most = np.inf, 0.0
    for _, band in file.bands(["regime", *KICKS]):
        none = np.isnan(band["critical_kick"]) & np.isfinite(band["critical_kick_tried"])
        least = np.min(band["critical_kick_tried"][none], initial=least)
        most = np.max(band["critical_kick_tried"][none], initial=most)
    return least, most


@picture(PeterkaFile)
def draw_impacting(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The share of starts that end with impacts."""
    def share(regime: Integers, of: Integers, shares: Reals) -> Reals:
        impacting = np.where(np.isin(of, [PERIODIC, CHAOTIC]), shares, 0).sum(axis=0)
        return np.where((regime == NOT_COMPUTED) | (_unknown_share(of, shares) >= MOST_UNDECIDED), np.nan, impacting)

    reduced = reduced_values(file, ["regime", "attractor_regime", "basin_share"], share, None)
    told = [*undecided_in_words(file, "attractor_regime", "basin_share", "starts"), *_not_kept_in_words(file, "ones without impacts")]
    left_out = any(np.any(_unknown_share(band["attractor_regime"], band["basin_share"]) >= MOST_UNDECIDED)
                   for _, band in file.bands(["regime", "attractor_regime", "basin_share"]))
    lacking = f"half or more unresolved{' or not kept' * _keeps_few(file)}" if left_out else None
    return _draw_scale(file, ax, reduced, "share of starts that end with impacts", 1, lacking, told)


def _unknown_share(of: Integers, shares: Reals) -> Reals:
    return undecided_share(of, shares) + _share_not_kept(shares)


def _share_not_kept(shares: Reals) -> Reals:
    """The share of starts that end on attractors beyond those that a cell's slots hold, from (slots, rows, columns)."""
    kept: Reals = np.nan_to_num(shares).sum(axis=0)
    return np.where((kept > 0) & (kept < 1 - ROUNDING), 1 - kept, 0.0)


def _keeps_few(file: PeterkaFile) -> bool:
    return any(np.any(_share_not_kept(band["basin_share"]) > 0) for _, band in file.bands(["regime", "basin_share"]))


def _not_kept_in_words(file: PeterkaFile, counts_as: str) -> list[str]:
    """What a picture of shares says of starts that end on attractors beyond a cell's slots; those of cells that it leaves out don't count."""
    most = max(float(np.max(_share_not_kept(band["basin_share"]), initial=0,
                            where=_unknown_share(band["attractor_regime"], band["basin_share"]) < MOST_UNDECIDED))
               for _, band in file.bands(["regime", "attractor_regime", "basin_share"]))
    return [f"starts on attractors that aren't kept count as {counts_as}: up to {axes.percent(most)} in a cell"] if most > 0 else []


def undecided_share(of: Integers, shares: Reals) -> Reals:
    """The share of starts or rigs without a result, from (slots, rows, columns)."""
    values: Reals = np.where(np.isin(of, UNDECIDED), np.nan_to_num(shares), 0.0).sum(axis=0)
    return values


def undecided_in_words(file: PeterkaFile, of: str, shares: str, whose: str) -> list[str]:
    """What a picture of impacts says of starts or rigs without a result, where they are fewer than half, and taken for such without impacts."""
    undecided = [undecided_share(band[of], band[shares]) for _, band in file.bands(["regime", of, shares])]
    most = max(float(np.max(some, where=some < MOST_UNDECIDED, initial=0)) for some in undecided)
    return [f"unresolved {whose} count as ones without impacts: up to {axes.percent(most)} in a cell"] if most > 0 else []


@picture(PeterkaFile)
def draw_share(file: PeterkaFile, ax: Axes | None = None, name: str = "share_1_1") -> Axes:
    """The share of starts that end in the class named by one of SHARES."""
    entry = SHARES[name]

    def share(regime: Integers, *slots: NDArray[Any]) -> Reals:
        reached = np.where(classify(*slots[:3]) == INDEX[entry.label], slots[3], 0).sum(axis=0)
        return np.where(regime == NOT_COMPUTED, np.nan, reached)

    reduced = reduced_values(file, LABELS, share, None)
    text = f"in $z = {entry.label}$" if entry.orbit else END_WORDS[entry.label]
    return _draw_scale(file, ax, reduced, f"share of starts that end {text}", 1, None, _not_kept_in_words(file, "ones that end otherwise"))


def commonest(file: PeterkaFile) -> list[str]:
    """Names from SHARES: the classes with most starts over the plane."""
    if file not in _COMMONEST:
        _COMMONEST[file] = _find_commonest(file)
    return _COMMONEST[file]


def _find_commonest(file: PeterkaFile) -> list[str]:
    total, cells = np.zeros(len(CLASSES)), 0
    for _, band in file.bands(LABELS):
        classes = classify(*(band[name] for name in LABELS[1:4]))
        total += np.bincount(classes.ravel(), weights=band["basin_share"].ravel(), minlength=len(CLASSES))
        cells += int(np.sum(band["regime"] != NOT_COMPUTED))
    names = sorted(SHARES, key=lambda name: -float(total[INDEX[SHARES[name].label]]))
    return [name for name in names[:MOST_CLASSES] if total[INDEX[SHARES[name].label]] > LEAST_SHARE * max(cells, 1)]


def _draw_scale(file: PeterkaFile, ax: Axes | None, reduced: Reduced, label: str, top: float, lacking: str | None,
                told: Sequence[str] = ()) -> Axes:
    computed, counts = class_picture(file, ["regime"], lambda regime: np.isin(regime, NOT_COMPUTED), 2)
    handles = [axes.legend_patch(lacking, LACKING_COLOUR)] if lacking and counts[0] else []
    handles += [axes.legend_patch("not computed yet", None, hatched=True)] if counts[1] else []
    figure, ax, bar_ax = axes.stack(WIDTH, reduced.image, [(handles, 2, None)], bar=True, ax=ax)
    axes.show_classes(ax, computed, [LACKING_COLOUR, "#FFFFFF"], 1)
    return _with_scale(figure, ax, bar_ax, file, reduced, label, top, told)


def _with_scale(figure: Figure, ax: Axes, bar_ax: Axes, file: PeterkaFile, reduced: Reduced, label: str, top: float,
                told: Sequence[str] = (), unit: str = "") -> Axes:
    low, high = requested(file, reduced.image, (unit, 1.0)) or (0.0, top)
    mesh = ax.pcolormesh(reduced.column_edges, reduced.row_edges, ma.masked_invalid(reduced.image), cmap=scale_colours(),
                         vmin=low, vmax=high, rasterized=True)
    bar = figure.colorbar(mesh, cax=bar_ax, orientation="horizontal", extend=beyond(reduced.image, low, high))
    bar.outline.set_linewidth(0.6)
    bar.set_label(label, fontsize=8)
    return _finished(figure, ax, file, told)


def _finished(figure: Figure, ax: Axes, file: PeterkaFile, told: Sequence[str] = ()) -> Axes:
    axes.label_axes(ax, file)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, "\n".join(filter(None, [axes.operating_point(file), *told])), ax)
    return ax


def reduced_values(file: PeterkaFile, names: Sequence[str], values: Callable[..., Reals], least: Any | None) -> Reduced:
    """Cell values, reduced to a block's mean or, with np.fmin, its minimum; NaN where it has none."""
    block, pieces = block_size(file.shape, LIMIT), []
    for _, band in file.bands(names, block):
        cells = values(*(band[name] for name in names))
        starts = [np.arange(0, size, block) for size in cells.shape]
        if least is not None:
            pieces.append(least.reduceat(least.reduceat(cells, starts[0], axis=0), starts[1], axis=1))
            continue
        sums, counts = (np.add.reduceat(np.add.reduceat(part, starts[0], axis=0), starts[1], axis=1)
                        for part in (np.nan_to_num(cells), np.isfinite(cells).astype(float)))
        pieces.append(np.where(counts > 0, sums / np.maximum(counts, 1), np.nan))
    return with_edges(file, np.concatenate(pieces), block)
