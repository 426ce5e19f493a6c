"""Two files over the same plane, cell by cell: where regime, z = p/q or peak force differ, as numbers.

The rigs may differ: then all forces differ by much the same factor, so besides the plain differences there are those
that are left when the forces of the second file are divided by the median of that factor, `scale`. Forces are compared
where both files have the same label and a force that lasts: z = p/q, or sustained contact. Chaotic peaks grow with the
time observed and say little. Memory: 16 bytes for each such cell.
"""

from collections import Counter
from dataclasses import dataclass

import numpy as np

from .classes import NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT, class_of
from .opened import NotDrawable

SAME_POINT = 1e-9  # of an axis, over its length: less is rounding
SHARES = (50, 90, 99)  # % of the cells; quantiles of the differences that are told
NAMES = ("regime", "impacts", "period", "peak_force_ratio")
_ORBIT = 8  # codes of a label below it are regimes


@dataclass(frozen=True)
class Comparison:
    """Of files A and B. `moves`: cells of each (label in A, label in B) where they differ. `force_ratio` (n,): forces
    of B over those of A; `place` (row, column) of each, (n, 2)."""

    cells: int
    same_regime: int
    same_label: int
    moves: Counter
    force_ratio: np.ndarray
    place: np.ndarray

    @property
    def scale(self):
        return float(np.median(self.force_ratio)) if len(self.force_ratio) else 1.0

    def differences(self, scale=1.0):
        """Of the forces, over the larger of both, (n,)."""
        return force_difference(self.force_ratio, scale)


def compare(first, second):
    """The Comparison of two open files; NotDrawable where they don't lie over the same plane."""
    refuse_other_plane(first, second)
    cells = same_regime = same_label = 0
    moves, ratios, places = Counter(), [], []
    for row, a, b in bands(first, second):
        both = there(a) & there(b)
        codes = label_codes(**a), label_codes(**b)
        same = both & (codes[0] == codes[1])
        cells += int(both.sum())
        same_regime += int(np.sum(both & (a["regime"] == b["regime"])))
        same_label += int(same.sum())
        moves += _moves(*(code[both & ~same] for code in codes))
        forced = same & has_lasting_force(a, b)
        ratios.append(b["peak_force_ratio"][forced] / a["peak_force_ratio"][forced])
        places.append(np.argwhere(forced).astype(np.int32) + np.array([row, 0], dtype=np.int32))
    return Comparison(cells, same_regime, same_label, moves, np.concatenate(ratios), np.concatenate(places))


def refuse_other_plane(first, second):
    if first.kind != second.kind:
        raise second.refusal(f"is a {second.kind} and {first.path} a {first.kind}: their cells can't be compared")
    for side in ("rows", "columns"):
        a, b = getattr(first, side), getattr(second, side)
        length = a.values[-1] - a.values[0]
        if len(a.values) != len(b.values) or np.any(np.abs(a.values - b.values) > SAME_POINT * length):
            raise second.refusal(f"has {_span(b)}, and {first.path} has {_span(a)}: only cells at the same places can "
                                 "be compared; compute one of them again with the axes of the other")


def bands(first, second, multiple=1):
    """(first row, {name: array} of A, the same of B), band by band."""
    for (row, a), (_, b) in zip(first.bands(NAMES, multiple), second.bands(NAMES, multiple)):
        yield row, a, b


def there(band):
    return band["regime"] != NOT_COMPUTED


def label_codes(regime, impacts, period, **_):
    """A number for each label: the regime, or p and q of an orbit. Arrays of one shape."""
    orbits = _ORBIT + (impacts.astype(np.int64) << 32) + period
    return np.where(regime == PERIODIC, orbits, regime)


def has_lasting_force(a, b):
    lasts = (a["regime"] == PERIODIC) | (a["regime"] == SUSTAINED_CONTACT)
    return lasts & (a["peak_force_ratio"] > 0) & (b["peak_force_ratio"] > 0)


def force_difference(ratio, scale=1.0):
    ratio = ratio / scale
    return np.abs(ratio - 1) / np.maximum(ratio, 1)


def text(first, second, comparison):
    """What is told, some lines."""
    lines = [f"A  {first.path}: {first.title}", f"B  {second.path}: {second.title}",
             f"{comparison.cells} cells that both files hold"]
    if not comparison.cells:
        return "\n".join(lines)
    for name, count in (("same regime", comparison.same_regime), ("same regime and z", comparison.same_label)):
        lines.append(f"  {name:<20}{count:>10}{_percent(count, comparison.cells)}")
    if comparison.moves:
        lines.append("Labels that differ, A -> B, most frequent first")
    for (a, b), count in comparison.moves.most_common(12):
        lines.append(f"  {a + ' -> ' + b:<40}{count:>10}{_percent(count, comparison.cells)}")
    if len(comparison.moves) > 12:
        lines.append(f"  and {len(comparison.moves) - 12} more")
    return "\n".join(lines + _force_lines(first, comparison))


def _force_lines(first, comparison):
    count = len(comparison.force_ratio)
    if not count:
        return ["No peak force to compare."]
    lines = [f"Peak force in {count} cells of the same regime and z; B's are {comparison.scale:.6g} times A's (median)"]
    scales = [("difference", 1.0)]
    if abs(comparison.scale - 1) > 0.01:
        scales.append(("divided by that", comparison.scale))
    for name, scale in scales:
        differences = comparison.differences(scale)
        worst = int(np.argmax(differences))
        row, column = comparison.place[worst]
        quantiles = ", ".join(f"{value:.2e} ({share} %)" for share, value in
                              zip(SHARES, np.percentile(differences, SHARES, method="inverted_cdf")))
        lines.append(f"  {name:<20}{quantiles}, {differences[worst]:.2e} at most, at {first.columns.name} "
                     f"{first.columns.values[column]:.6g}, {first.rows.name} {first.rows.values[row]:.6g}")
    return lines


def _moves(codes_a, codes_b):
    pairs, counts = np.unique(np.stack([codes_a, codes_b]), axis=1, return_counts=True)
    return Counter({(_name(a), _name(b)): int(count) for (a, b), count in zip(pairs.T, counts)})


def _name(code):
    if code < _ORBIT:
        return class_of(code, 0, 0).label
    return f"{(code - _ORBIT) >> 32}/{(code - _ORBIT) & 0xFFFFFFFF}"


def _percent(count, total):
    return f"{100 * count / total:>10.3f} %"


def _span(axis):
    spacing = ", evenly in the logarithm" if axis.log else ""
    return f"{len(axis.values)} points of {axis.name} from {axis.values[0]:.6g} to {axis.values[-1]:.6g}{spacing}"


__all__ = ["Comparison", "NotDrawable", "compare", "text"]
