"""Forces over the Peterka maps, z = 1/1 (section 4.2, Fig. 23)."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from ..arrays import Integers, Mask, Reals
from .folder import Folder, Plane
from .record import ALL, HIGH_GAP, SHARE, Claim, claim, near, not_computed
from .spans import widest

RIGS = ("170mm", "150mm", "135mm")
PLACE = "section 4.2, Fig. 23"
SAYS = {
    "natural": "At the hammer's natural frequency the force is about 3 times smaller than the maximum.",
    "gap_0_natural": "At gap 0, where it was measured, the force at the natural frequency is about 3 times smaller, too.",
    "inside": "At each gap the largest force lies inside the band z = 1/1, not at its boundary, except at high gaps.",
    "zero_gap": "The largest force at gap 0 is as large as at higher gaps.",
}
TIMES = 3  # as printed


def claims(folder: Folder) -> list[Claim]:
    """The claims of this group."""
    found = {rig: folder.plane(f"peterka_{rig}") for rig in RIGS}
    planes = {rig: plane for rig, plane in found.items() if plane is not None}
    if len(planes) < len(found):
        missing = next(rig for rig in found if rig not in planes)
        return [not_computed(key if key.startswith("gap") else f"map_{key}", PLACE, says, f"peterka_{missing}.h5")
                for key, says in SAYS.items()]
    pictures = [f"peterka_{rig}_force_1_1" for rig in RIGS]
    return [*_natural(planes, pictures), _inside(planes, pictures), _zero_gap(planes, pictures)]


def forces_one_to_one(plane: Plane) -> Reals:
    """Peak force [N] where z = 1/1, 0 elsewhere, (rows, columns)."""
    return np.where(plane.is_orbit(1, 1), plane.force_n, 0)


def _natural(planes: Mapping[str, Plane], pictures: Sequence[str]) -> list[Claim]:
    """At gap 0, any z at the natural frequency; and z = 1/1 alone, over all gaps, as in Fig. 23."""
    at_gap_0, of_one = [], []
    for plane in planes.values():
        forces, column, row = forces_one_to_one(plane), plane.column_at_hz(plane.natural_frequency_hz), plane.row_at(0)
        at_gap_0.append(_over(forces[row].max(), plane.force_n[row, column]))
        of_one.append(_over(forces.max(), forces[:, column].max()))
    return [
        claim("map_natural", PLACE, SAYS["natural"], f"{_each(of_one, planes)} times where z = 1/1, over all gaps",
              _as_printed(of_one), _range(of_one), "", pictures),
        claim("gap_0_natural", "section 3.1, Fig. 9a", SAYS["gap_0_natural"], f"{_each(at_gap_0, planes)} times at gap 0",
              _as_printed(at_gap_0), _range(at_gap_0), "at the natural frequency the model has a second, weak impact in each "
              "cycle (z = 2/1), which takes from the main one; besides, its maximum is too high", pictures),
    ]


def _as_printed(ratios: Sequence[float]) -> bool:
    return all(near(ratio, TIMES) for ratio in ratios)


def _range(ratios: Sequence[float]) -> str:
    return " to ".join(f"{100 * (ratio / TIMES - 1):+.1f}" for ratio in (min(ratios), max(ratios))) + " %"


def _inside(planes: Mapping[str, Plane], pictures: Sequence[str]) -> Claim:
    turns, right = [], []
    for plane in planes.values():
        rows, inside = _largest_lies_inside(plane)
        turn = _best_turn(inside)
        turns.append(plane.rows[rows[turn]] if turn < len(rows) else np.inf)
        right.append(np.sum(inside == (np.arange(len(inside)) < turn)) / max(len(inside), 1))
    holds = all(share >= ALL for share in right) and all(HIGH_GAP <= turn < np.inf for turn in turns)
    return claim(
        "map_inside", PLACE, SAYS["inside"],
        f"inside below gap/A0 = {_each(turns, planes)}, at the boundary from there on; {_each(right, planes, 100, ' %')} of "
        "the gaps follow this", holds, f"{100 * (1 - min(right)):.1f} % of the gaps at most are otherwise",
        "where the maximum comes near the boundary, the start at rest decides where the band ends, and its limit is "
        "frayed", pictures)


def _best_turn(inside: Mask) -> int:
    """The number of leading rows to call `inside` that misclassifies the fewest rows."""
    wrong = [np.sum(~inside[:turn]) + np.sum(inside[turn:]) for turn in range(len(inside) + 1)]
    return int(np.argmin(wrong))


def _largest_lies_inside(plane: Plane) -> tuple[Integers, Mask]:
    """Rows with z = 1/1, and whether the largest force of their widest band lies inside that band."""
    rows, inside = [], []
    for row, mask in enumerate(plane.is_orbit(1, 1)):
        band = widest(mask)
        if band is None:
            continue
        best = band[0] + int(np.argmax(plane.force_n[row, band[0]:band[1] + 1]))
        rows.append(row)
        inside.append(band[0] < best < band[1])
    return np.array(rows, dtype=int), np.array(inside, dtype=bool)


def _zero_gap(planes: Mapping[str, Plane], pictures: Sequence[str]) -> Claim:
    shares = []
    for plane in planes.values():
        forces = forces_one_to_one(plane)
        shares.append(_over(forces[plane.row_at(0)].max(), forces.max()))
    return claim(
        "map_zero_gap", f"{PLACE}; section 5", SAYS["zero_gap"],
        f"at gap 0 {_each(shares, planes, 100, ' %')} of the largest force of z = 1/1 at any gap",
        all(share >= 1 - SHARE for share in shares), f"{100 * (1 - min(shares)):.1f} % less at most", "", pictures)


def _over(force: float, other: float) -> float:
    """The ratio; NaN, which agrees with nothing, if there is no other force."""
    return force / other if other > 0 else np.nan


def _each(values: Sequence[float], planes: Iterable[str], factor: float = 1.0, unit: str = "") -> str:
    return ", ".join(f"{factor * value:.3g}{unit} ({rig})" for value, rig in zip(values, planes))
