"""Comparison of the maps of the three beam springs (section 4.2, Fig. 22; section 5)."""

from collections.abc import Mapping, Sequence
from itertools import combinations
from pathlib import Path

import numpy as np

from ..arrays import Reals
from ..maps.comparison import Comparison, compare
from ..maps.map_file import PeterkaFile
from .folder import Folder, Plane

from .force_map import RIGS
from .record import ALL, Claim, claim, near, not_computed
from .spans import around_bands

PLACE = "section 4.2, Fig. 22"
SAYS = {
    "same": "The maps of the three beam springs are identical: the impact behaviour hardly depends on the stiffness.",
    "where": "Their shapes differ only in the chaotic region between z = 1/1 and z = 1/2.",
    "force": "The force, too, is somehow not dependent on the stiffness.",
}


def claims(folder: Folder) -> list[Claim]:
    """The claims of this group."""
    there = {rig: folder.plane(f"peterka_{rig}") for rig in RIGS}
    planes = {rig: plane for rig, plane in there.items() if plane is not None}
    missing = [f"peterka_{rig}.h5" for rig in RIGS if rig not in planes]
    if missing:
        return [not_computed(f"stiffness_{key}", PLACE, says, missing[0]) for key, says in SAYS.items()]
    pairs = list(combinations(RIGS, 2))
    found = [_compared(planes[a].path, planes[b].path) for a, b in pairs]
    pictures = [f"peterka_{rig}_map" for rig in RIGS] + [f"peterka_{a}_against_peterka_{b}" for a, b in pairs]
    return [_same(pairs, found, pictures), _where(pairs, planes, pictures[3:]), _force(pairs, found, planes)]


def _compared(first: Path, second: Path) -> Comparison:
    with PeterkaFile(first) as a, PeterkaFile(second) as b:
        return compare(a, b)


def _same(pairs: Sequence[tuple[str, str]], found: Sequence[Comparison], pictures: Sequence[str]) -> Claim:
    shares = [one.same_label / one.cells for one in found]
    moves = sum((one.moves for one in found), start=type(found[0].moves)())
    often = ", ".join(f"{a} against {b} ({100 * count / (len(found) * found[0].cells):.2f} %)"
                      for (a, b), count in moves.most_common(4))
    listed = ", ".join(f"{100 * share:.2f} % ({a} and {b})" for share, (a, b) in zip(shares, pairs))
    return claim("stiffness_same", PLACE, SAYS["same"],
                 f"cells with the same regime and z: {listed}" + (f"; what differs most: {often}" if often else ""),
                 min(shares) >= ALL, f"{100 * (1 - min(shares)):.2f} % of the cells at most",
                 "nearly all of it lies in the tangle between the bands", pictures)


def _where(pairs: Sequence[tuple[str, str]], planes: Mapping[str, Plane], pictures: Sequence[str]) -> Claim:
    """The share of the differing cells that lie between the two bands."""
    places = []
    for a, b in pairs:
        differs = planes[a].label_code != planes[b].label_code
        places.append([np.sum(differs & area) / max(differs.sum(), 1) for area in around_bands(planes[a])])
    lower, between, beyond = np.transpose(places)
    elsewhere = max(lower + beyond)
    return claim(
        "stiffness_where", "section 5", SAYS["where"],
        f"{_range(between)} of the cells that differ lie between the bands, {_range(lower)} at lower frequencies, "
        f"{_range(beyond)} from z = 1/2 on", elsewhere <= 1 - ALL, f"{100 * elsewhere:.0f} % at most lie elsewhere",
        "beyond z = 1/2 a second tangle of the same kind begins, and at low "
        "frequencies the ranges of p/1 shift with the stop's stiffness relative to the springs'", pictures)


def _range(shares: Sequence[float] | Reals) -> str:
    return f"{100 * min(shares):.0f} to {100 * max(shares):.0f} %"


def _force(pairs: Sequence[tuple[str, str]], found: Sequence[Comparison], planes: Mapping[str, Plane]) -> Claim:
    """Forces in N, because F/(m g) refers to a particular hammer."""
    texts = []
    for (a, b), one in zip(pairs, found):
        frequencies = planes[b].natural_frequency_hz / planes[a].natural_frequency_hz
        left = float(np.quantile(one.differences(one.scale), 0.9)) if len(one.force_ratio) else np.nan
        texts.append(f"{b} against {a} {one.scale:.4g} times (natural frequencies {frequencies:.4g} times; 90 % of the cells "
                     f"within {100 * left:.1f} % of the median)")
    furthest = max((one.scale for one in found), key=lambda scale: abs(scale - 1))
    return claim("stiffness_force", f"{PLACE}; section 5", SAYS["force"],
                 "forces of cells with the same z, in the median: " + "; ".join(texts),
                 all(len(one.force_ratio) and near(one.scale, 1) for one in found), f"{100 * (furthest - 1):+.0f} % at most",
                 "in N stiffer springs strike harder, as forces go with impact speeds, and these with A0 ω; apart from this "
                 "factor the maps of force are alike, which is likely what is meant")
