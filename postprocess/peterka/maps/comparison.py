"""Cell-by-cell comparison of two files over planes with common points: differences in regime, z = p/q and peak force or, where both
stops are rigid and have none, the largest impact speed, if both files hold it.

Forces are compared as B's over A's if both files have the same label and a lasting force: z = p/q, or sustained contact; forces [N] where
both files tell the hammer's mass, otherwise each over its own hammer's weight.
Peaks in chaos grow with the observation time and are not compared. Memory: 16 bytes per compared cell.
"""

import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers, Mask, Reals
from ..files.harmless import harmless
from ..errors import PeterkaFileError
from ..files.regimes import NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT
from ..plotting.classes import class_of
from ..plotting.coordinates import either, in_words, label, without_symbol
from ..plotting.units import amount, number
from .common_plane import CommonPlane
from .map_file import PeterkaFile

SHARES = (1, 50, 99)  # % of the cells; reported quantiles of the ratio
MOST_KEYS = 6  # differing keys listed
LABELS = ("regime", "impacts", "period")
FORCE, SPEED = "peak_force_ratio", "impact_speed"
WORDS = {FORCE: "peak force", SPEED: "impact speed"}
UNTOLD = ("title",)  # reported elsewhere
OF_A_RUN = ("audit", "certificate", "limits", "output")  # tables that change no cell: untold in a picture
LONGEST_JOB, LONGEST_VALUE = 100_000, 40
Band = dict[str, NDArray[Any]]
_ORBIT = 8  # label codes below this are regimes


@dataclass(frozen=True)
class Comparison:
    """Comparison of files A and B at their common points. `moves`: number of cells for each (label in A, label in B) that
    differ. `force_ratio` (n,): forces of B over those of A; `force` (n,): those of A over the weight of its hammer; `place` (n, 2): (row,
    column) of each in the common plane. `quantity`: FORCE or, of two rigid stops, SPEED, with impact speeds [m/s] for all these forces."""

    plane: CommonPlane
    quantity: str
    cells: int
    same_regime: int
    same_label: int
    moves: Counter[tuple[str, str]]
    force_ratio: Reals
    force: Reals
    place: Integers

    @property
    def scale(self) -> float:
        """The median of B's forces over A's; 1 if none are compared."""
        return float(np.median(self.force_ratio)) if len(self.force_ratio) else 1.0

    def differences(self, scale: float = 1.0) -> Reals:
        """Relative differences of the forces, over the larger of both, (n,)."""
        return force_difference(self.force_ratio, scale)


def compare(first: PeterkaFile, second: PeterkaFile) -> Comparison:
    """The Comparison of two open files. Raises PeterkaFileError if they do not cover the same plane."""
    plane, quantity = CommonPlane(first, second), compared_quantity(first, second)
    cells = same_regime = same_label = 0
    moves: Counter[tuple[str, str]] = Counter()
    ratios, forces, places = [], [], []
    for row, a, b in bands(plane, quantity):
        both = there(a) & there(b)
        codes = label_codes(**a), label_codes(**b)
        same = both & (codes[0] == codes[1])
        cells += int(both.sum())
        same_regime += int(np.sum(both & (a["regime"] == b["regime"])))
        same_label += int(same.sum())
        moves += _moves(*(code[both & ~same] for code in codes))
        forced = same & has_lasting_force(a, b)
        ratios.append(force_ratio(a, b)[forced])
        forces.append(a["blow"][forced])
        places.append(np.argwhere(forced).astype(np.int32) + np.array([row, 0], dtype=np.int32))
    return Comparison(plane, quantity, cells, same_regime, same_label, moves, np.concatenate(ratios), np.concatenate(forces), np.concatenate(places))


def compared_quantity(first: PeterkaFile, second: PeterkaFile) -> str:
    """What of two files is compared beside their labels: FORCE, or SPEED where both stops are rigid, whose forces have no bound."""
    speeds = all(SPEED in file.quantities for file in (first, second))
    return SPEED if speeds and _strike_rigid_stops(first, second) else FORCE


def _strike_rigid_stops(*files: PeterkaFile) -> bool:
    return all((_keys(file.data.attribute("job")) or {}).get("contact.law") == "restitution" for file in files)


def bands(plane: CommonPlane, quantity: str, block: int = 1) -> Iterator[tuple[int, Band, Band]]:
    """(first row, A's, B's) of CommonPlane.bands, with the numbers to compare as "blow": A's, and B's in the same unit."""
    for row, a, b in plane.bands((*LABELS, quantity), block):
        weights = plane.weights if quantity == FORCE else 1.0
        yield row, {**a, "blow": a[quantity]}, {**b, "blow": b[quantity] * weights}


def there(band: Mapping[str, NDArray[Any]]) -> Mask:
    """Mask of the computed cells of a band, (rows, columns)."""
    mask: Mask = band["regime"] != NOT_COMPUTED
    return mask


def label_codes(regime: Integers, impacts: Integers, period: Integers, **_: object) -> Integers:
    """A number for each label: the regime, or a code of p and q for an orbit. Arrays of one shape."""
    orbits = _ORBIT + (impacts.astype(np.int64) << 32) + period
    return np.where(regime == PERIODIC, orbits, regime)


def has_lasting_force(a: Mapping[str, NDArray[Any]], b: Mapping[str, NDArray[Any]]) -> Mask:
    """Mask of the cells of two bands with equal labels that have comparable forces, (rows, columns)."""
    lasts = (a["regime"] == PERIODIC) | (a["regime"] == SUSTAINED_CONTACT)
    mask: Mask = lasts & (a["blow"] > 0) & (b["blow"] > 0)
    return mask


def force_ratio(a: Mapping[str, NDArray[Any]], b: Mapping[str, NDArray[Any]]) -> Reals:
    """B's blow over A's in each cell of two bands."""
    with np.errstate(divide="ignore", invalid="ignore"):
        values: Reals = b["blow"] / a["blow"]
    return values


def force_difference(ratio: Reals, scale: float = 1.0) -> Reals:
    """|B - A| over the larger of both, from the ratio B/A divided by `scale`, (n,)."""
    ratio = ratio / scale
    values: Reals = np.abs(ratio - 1) / np.maximum(ratio, 1)
    return values


def text(first: PeterkaFile, second: PeterkaFile, comparison: Comparison) -> str:
    """The report, as lines."""
    lines = [f"A  {first.path}: {first.title}", f"B  {second.path}: {second.title}",
             *differing_keys(first, second), *filter(None, [comparison.plane.in_words]),
             f"{comparison.cells:,} cells that both files hold"]
    if not comparison.cells:
        return "\n".join(lines)
    for name, count in (("same regime", comparison.same_regime), ("same regime and z", comparison.same_label)):
        lines.append(f"  {name:<20}{count:>10,}{_percent(count, comparison.cells)}")
    if comparison.moves:
        lines.append("Labels that differ, A -> B, most frequent first")
    for (a, b), count in comparison.moves.most_common(12):
        lines.append(f"  {a + ' -> ' + b:<40}{count:>10,}{_percent(count, comparison.cells)}")
    if len(comparison.moves) > 12:
        lines.append(f"  and {len(comparison.moves) - 12} more")
    return "\n".join(lines + _force_lines(comparison))


def _force_lines(comparison: Comparison) -> list[str]:
    ratio = comparison.force_ratio
    if not len(ratio):
        rigid = _strike_rigid_stops(comparison.plane.first, comparison.plane.second)
        return ["No impact speed to compare: both files need it in output.fields." if rigid else "No peak force to compare."]
    quantiles = ", ".join(f"{value:.6g} ({share} %)" for share, value in
                          zip(SHARES, np.percentile(ratio, SHARES)))
    plane = comparison.plane
    is_force = comparison.quantity == FORCE
    of = "B's over A's" if plane.tells_forces or not is_force else "B's over A's, each over its own hammer's weight"
    name = WORDS[comparison.quantity]
    medians = (float(np.median(force)) for force in (comparison.force, comparison.force * ratio))
    lines = [f"{name.capitalize()} in {len(ratio):,} cells of the same regime and z, {of}", f"  ratio               {quantiles}",
             f"  {'median ' + name.split()[-1]:<20}{_two_blows(comparison, *medians)}"]
    if plane.weights != 1 and is_force:
        lines.append(f"  weight              B's hammer weighs {plane.weights:.6g} times A's: over their weights these ratios are "
                     f"{1 / plane.weights:.6g} times as large")
    for name, extreme in (("smallest", np.argmin(ratio)), ("largest", np.argmax(ratio))):
        row, column = comparison.place[extreme]
        force = comparison.force[extreme]
        lines.append(f"  {name:<20}{ratio[extreme]:.6g} ({change(ratio[extreme])}), at "
                     f"{in_words(plane, plane.columns, plane.columns.values[column], 6)}, "
                     f"{in_words(plane, plane.rows, plane.rows.values[row], 6)}: {_two_blows(comparison, force, force * ratio[extreme])}")
    return lines


def _two_blows(comparison: Comparison, a: float, b: float) -> str:
    if comparison.quantity == FORCE:
        return _two_forces(comparison.plane, a, b)
    return f"{amount(a, 'm/s')} in A, {amount(b, 'm/s')} in B"


def _two_forces(plane: CommonPlane, a: float, b: float) -> str:
    """A's and B's force, given over the weight of A's hammer, in N and over the weight of each one's own."""
    newtons = plane.first.newtons if plane.tells_forces else None
    return ", ".join(f"{either(plane, amount(force * newtons, 'N') if newtons else '', f'{number(force / weight)} weights', '{} = {}')} in {name}"
                     for name, force, weight in (("A", a, 1.0), ("B", b, plane.weights)))


def change(ratio: float) -> str:
    """+5.0 %, -29.0 %, or a factor if the ratio is extreme."""
    return f"{100 * (ratio - 1):+.3g} %" if 0.1 < ratio < 10 else f"{ratio:.3g} times"


def differing_keys(first: PeterkaFile, second: PeterkaFile, is_whole: bool = True) -> list[str]:
    """A line for each key in which the jobs differ, with both values; empty if there is none. `is_whole`: with keys that change no cell,
    and with the name of a key that is known by words beside them."""
    a, b = (_keys(file.data.attribute("job")) for file in (first, second))
    if a is None or b is None:
        return []
    keys = [key for key in dict.fromkeys([*a, *b]) if a.get(key) != b.get(key)]
    if not is_whole:
        keys = [key for key in keys if key.partition(".")[0] not in OF_A_RUN]
    lines = [f"{_called(key, is_whole)}: {_both(a, b, key)}" for key in keys if key not in UNTOLD]
    more = len(lines) - MOST_KEYS
    return lines if more <= 0 else [*lines[:MOST_KEYS], f"and {more} more keys"]


def _called(key: str, has_key: bool) -> str:
    """A key of a job with its words and its unit, if these are known: "stop damping (N s/m), contact.damping_ns_per_m"."""
    words = label(key.replace(".", "_"))
    if words == key.replace(".", "_"):
        return key
    return without_symbol(words) + f", {key}" * has_key


def _keys(text: object) -> dict[str, Any] | None:
    """{table.key: value} of a job's resolved text; None if it is not valid."""
    try:
        return _flat(tomllib.loads(text)) if isinstance(text, str) and len(text) < LONGEST_JOB else None
    except tomllib.TOMLDecodeError:
        return None


def _flat(table: Mapping[str, Any], path: str = "") -> dict[str, Any]:
    keys: dict[str, Any] = {}
    for name, value in table.items():
        keys |= _flat(value, f"{path}{name}.") if isinstance(value, dict) else {path + name: value}
    return keys


def _both(a: Mapping[str, Any], b: Mapping[str, Any], key: str) -> str:
    """The values of a key; of long lists only what one of them lacks."""
    first, second = a.get(key), b.get(key)
    if not (isinstance(first, list) and isinstance(second, list)) or max(len(str(first)), len(str(second))) <= LONGEST_VALUE:
        return f"{_value(a, key)} in A, {_value(b, key)} in B"
    alone = {"A": [value for value in first if value not in second], "B": [value for value in second if value not in first]}
    told = [f"{harmless(', '.join(map(str, values)), LONGEST_VALUE)} in {name} alone" for name, values in alone.items() if values]
    return ", ".join(told) or "the same values, in another order or number"


def _value(job: Mapping[str, Any], key: str) -> str:
    if key not in job:
        return "nothing"
    value = job[key]
    return f"{value:,.15g}" if isinstance(value, float) else harmless(str(value), LONGEST_VALUE)


def _moves(codes_a: Integers, codes_b: Integers) -> Counter[tuple[str, str]]:
    pairs, counts = np.unique(np.stack([codes_a, codes_b]), axis=1, return_counts=True)
    return Counter({(name_of_code(a), name_of_code(b)): int(count) for (a, b), count in zip(pairs.T, counts)})


def name_of_code(code: int) -> str:
    """The label of a code of label_codes in words: p/q, or the regime."""
    if code < _ORBIT:
        return class_of(code, 0, 0).label
    return f"{(code - _ORBIT) >> 32}/{(code - _ORBIT) & 0xFFFFFFFF}"


def _percent(count: float, total: float) -> str:
    return f"{100 * count / total:>10.3f} %"


__all__ = ["Comparison", "PeterkaFileError", "compare", "text"]
