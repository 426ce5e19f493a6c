"""Maps of the three beam springs against each other (section 4.2, Fig. 22; section 5)."""

from itertools import combinations

import numpy as np
from peterka_pictures.comparison import compare
from peterka_pictures.read import PeterkaFile

from .force_map import RIGS
from .record import ALL, claim, not_computed
from .spans import widest

PLACE = "section 4.2, Fig. 22"
SAYS = {
    "same": "The maps of the three beam springs are identical: the impact behaviour hardly depends on the stiffness.",
    "where": "Their shapes differ only in the chaotic region between z = 1/1 and z = 1/2.",
    "force": "The force behaviour, too, is somehow independent of the stiffness.",
}


def claims(folder):
    planes = {rig: folder.plane(f"peterka_{rig}") for rig in RIGS}
    missing = [f"peterka_{rig}.h5" for rig, plane in planes.items() if plane is None]
    if missing:
        return [not_computed(f"stiffness_{key}", PLACE, says, missing[0]) for key, says in SAYS.items()]
    pairs = list(combinations(RIGS, 2))
    found = [_compared(planes[a].path, planes[b].path) for a, b in pairs]
    pictures = [f"peterka_{rig}_map" for rig in RIGS] + [f"peterka_{a}_against_peterka_{b}" for a, b in pairs]
    return [_same(pairs, found, pictures), _where(pairs, planes, pictures[3:]), _force(pairs, found, planes)]


def _compared(first, second):
    with PeterkaFile(first) as a, PeterkaFile(second) as b:
        return compare(a, b)


def _same(pairs, found, pictures):
    shares = [one.same_label / one.cells for one in found]
    moves = sum((one.moves for one in found), start=type(found[0].moves)())
    often = ", ".join(f"{a} against {b} ({100 * count / (len(found) * found[0].cells):.2f} %)"
                      for (a, b), count in moves.most_common(4))
    listed = ", ".join(f"{100 * share:.2f} % ({a} and {b})" for share, (a, b) in zip(shares, pairs))
    return claim("stiffness_same", PLACE, SAYS["same"],
                 f"cells with the same regime and z: {listed}" + (f"; what differs most: {often}" if often else ""),
                 min(shares) >= ALL, f"{100 * (1 - min(shares)):.2f} % of the cells at most",
                 "nearly all of it lies in the tangle between the bands", pictures)


def _where(pairs, planes, pictures):
    """Of the cells that differ, how many lie between both bands."""
    shares, below, beyond = [], [], []
    for a, b in pairs:
        first, second = planes[a], planes[b]
        differs = (first.regime != second.regime) | (first.impacts != second.impacts) | (first.period != second.period)
        left, right = _between(first)
        columns = np.arange(differs.shape[1])[None, :]
        total = max(int(differs.sum()), 1)
        below.append(np.sum(differs & (columns <= left[:, None])) / total)
        beyond.append(np.sum(differs & (columns >= right[:, None])) / total)
        shares.append(1 - below[-1] - beyond[-1])
    return claim(
        "stiffness_where", "section 5", SAYS["where"],
        f"{100 * min(shares):.0f} to {100 * max(shares):.0f} % of the cells that differ lie between the bands, "
        f"{100 * min(below):.0f} to {100 * max(below):.0f} % at lower frequencies, {100 * min(beyond):.0f} to "
        f"{100 * max(beyond):.0f} % beyond z = 1/2", min(shares) >= ALL,
        f"{100 * (1 - min(shares)):.0f} % lie elsewhere", "beyond z = 1/2 a second tangle of the same kind begins, and at low "
        "frequencies the ranges of p/1 shift with the stop's stiffness relative to the springs'", pictures)


def _between(plane):
    """Per row: the last column of the widest band z = 1/1, and the first of z = 1/2, those of the nearest gap that has
    it."""
    ends, starts = [], []
    for row in range(len(plane.rows)):
        one, half = (widest(plane.is_orbit(1, q)[row]) for q in (1, 2))
        ends.append(one[1] if one else ends[-1] if ends else 0)
        wide = half is not None and half[1] - half[0] >= 0.05 * len(plane.columns)
        starts.append(half[0] if wide else starts[-1] if starts else len(plane.columns))
    return np.array(ends), np.maximum(np.array(starts), np.array(ends))


def _force(pairs, found, planes):
    texts, largest = [], []
    for (a, b), one in zip(pairs, found):
        frequencies = planes[b].natural_frequency_hz / planes[a].natural_frequency_hz
        left = np.quantile(one.differences(one.scale), 0.9)
        largest += [abs(one.scale / frequencies - 1), left]
        texts.append(f"{b} against {a}: {one.scale:.4g} times (natural frequencies {frequencies:.4g} times), 90 % of the "
                     f"cells within {100 * left:.1f} % of that")
    return claim("stiffness_force", f"{PLACE}; section 5", SAYS["force"],
                 "peak forces go with the natural frequency, as impact speeds do: " + "; ".join(texts),
                 max(largest) <= 0.1, f"{100 * max(largest):.1f} % at most from that rule")
