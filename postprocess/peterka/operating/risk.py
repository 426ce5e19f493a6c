"""The value that holds with a probability, over drift, starts and rigs together, from a map with [uncertainty].

In each cell the file keeps the value that all but 5 % of the drawn rigs reach, each of them from a start of its own where the job has
[starts]. The smallest one in a box around a cell is reached with that probability in all of its cells; nothing is known between them. How
sure that is in a cell, with so many draws, follows from order statistics (peterka/sampling.py).
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from ..files.coordinates import SPOKEN
from ..files.regimes import NOT_COMPUTED
from ..maps.comparison import label_codes, name_of_code
from ..maps.map_file import PeterkaFile
from ..maps.rig_numbers import along_axes, deviation_of, values_of
from ..maps.outcomes import OUTCOMES, Draws, draws_of, probability, quantiles
from ..sampling import draws_needed, least_share_above
from .admitted import NO_REGIME, Admitted, Quantity, force_quantity
from .drift import Reach
from .places import Place, box_of

KEPT = {0.95: 5, 0.5: 50}  # probability: per cent of the draws that may lie below the value
ROUNDING = 1e-9  # of sums of probabilities
ANY_MOTION = 0  # the code of all cells: whatever the motion, the value counts


def refuse_untold(file: PeterkaFile, risk: float) -> Draws:
    """The Draws of a map; refuses a probability that they can't tell."""
    if file.outcome_slots == 0 or not quantiles(file.data):
        raise file.refusal("was computed for one rig alone: what others do isn't known; compute it with [uncertainty], which tells what is "
                           f"uncertain, and rigs = {draws_needed(risk)} or more")
    draws, needed = draws_of(file), draws_needed(risk)
    if draws.count < needed:
        raise file.refusal(f"has {draws.count} rigs of each cell, which can't tell a probability of {risk:g}: were all of them to reach a value, "
                           f"a share of {100 * (1 - risk):.3g} % that doesn't might be missed in more than one case of twenty; {needed} "
                           f"could tell it: --set uncertainty.rigs={needed}")
    if risk not in KEPT:
        raise file.refusal(f"doesn't keep what is reached with a probability of {risk:g}; it does for {' and '.join(f'{each:g}' for each in KEPT)}")
    return draws


def quantity_at(file: PeterkaFile, risk: float, regimes: Sequence[str] | None = None) -> Quantity:
    """The Quantity that is reached with this probability: a peak force, or the impact speed on a rigid stop."""
    asked = f"in {','.join(regimes)} with a probability of {risk:g}" if regimes else f"with a probability of {risk:g}"
    if quantiles(file.data)[KEPT[risk]].startswith("speed"):
        return Quantity("impact_speed", f"impact speed {asked}", 1.0, "m/s")
    return force_quantity(file, f"peak force {asked}")


def admitted_at(file: PeterkaFile, risk: float, regimes: Sequence[str] | None) -> Admitted:
    """The Admitted of a map, whatever the motion; with `regimes`, ["p/q"], the value that is reached in these, and as `share` their
    probability.

    The file keeps the values of all motions together. Where P of the draws end in these motions, and Q reach a value, at least P + Q - 1 do
    both (Frechet's inequality): so of the values that it keeps, the largest one counts of which that is not below the risk."""
    kept = quantiles(file.data)
    pieces = []
    for _, band in file.bands(["regime", *(kept[below] for below in KEPT.values()), *OUTCOMES]):
        regime, impacts, period, shares = (band[each] for each in OUTCOMES)
        likely = sum(probability(each, regime, impacts, period, shares) for each in regimes) if regimes else np.ones(band["regime"].shape)
        values = np.full(band["regime"].shape, np.nan)
        for reach in sorted(KEPT, reverse=True):  # larger values last
            both = likely + reach - 1 >= risk - ROUNDING
            values = np.where(both, band[kept[KEPT[reach]]], values)
        sound = (band["regime"] != NOT_COMPUTED) & np.isfinite(values)
        pieces.append((np.where(sound, ANY_MOTION, NO_REGIME), values, likely if regimes else np.nan_to_num(shares[0])))
    return Admitted(*(np.concatenate([piece[n] for piece in pieces]) for n in range(3)))


def needed_share(risk: float) -> float:
    """The probability that motions must have so that the file can tell a value that is reached in them with the risk."""
    return risk + 1 - max(KEPT)


def with_motions(file: PeterkaFile, places: Collection[Place], rows: Reach, columns: Reach) -> list[Place]:
    """The Places with the commonest motion at each, and its smallest probability in the cells of the box as their share."""
    return [_with_motion(file, place, box_of(place, rows, columns)) for place in places]


def _with_motion(file: PeterkaFile, place: Place, box: tuple[slice, slice]) -> Place:
    regime, impacts, period, shares = (file.data.values(name, (slice(None), box[0]))[:, :, box[1]] for name in OUTCOMES)
    row, column = place.row - box[0].start, place.column - box[1].start
    code = int(label_codes(regime, impacts, period)[0, row, column])
    name = name_of_code(code)
    same = label_codes(regime, impacts, period) == code
    return replace(place, motion=name, share=float(np.where(same, np.nan_to_num(shares), 0).sum(axis=0).min()))


def assured(risk: float, draws: int) -> float:
    """The share of all rigs that reach the value which the file keeps for this probability, at least, in 19 cases of 20."""
    return least_share_above(math.ceil(draws * KEPT[risk] / 100), draws)


def strange_offsets(file: PeterkaFile) -> list[str]:
    """A line for each offset of the place in [uncertainty] that is larger than the largest such place in the map: few errors of a setting are."""
    lines = []
    for name, (what, unit, factor) in ((name, SPOKEN[name]) for name in ("frequency_hz", "gap_m")):
        relative, values = deviation_of(file, name), values_of(file, along_axes(file), name)
        if relative is None or values is None or not np.isfinite(relative).any():
            continue
        sizes = np.abs(values)
        largest = float(np.max(sizes))
        with np.errstate(invalid="ignore"):
            offset = float(np.nanmax(relative * sizes))  # of a gap of 0 nothing is relative
        if offset > largest:
            lines.append(f"the offset of the {what} in [uncertainty] has a standard deviation of {offset * factor:.3g} {unit}, and the largest {what} of "
                         f"the map is {largest * factor:.3g} {unit}: most of the rigs drawn lie far outside it; is its unit right?")
    return lines


def text_of_sampling(file: PeterkaFile, risk: float, draws: Draws, regimes: Sequence[str] | None = None) -> str:
    """What the draws imply."""
    starts = ", each from a start of its own" if file.slots else ", each from [start]"
    if regimes:
        return (f"by sampling: {draws.in_words}{starts}; in each cell of a box at least {100 * risk:g} % of them end in {','.join(regimes)} and reach "
                f"its worst value there (what misses either is added up, as the file keeps the values of all motions together: {','.join(regimes)} needs "
                f"{100 * needed_share(risk):g} %); between cells nothing is known, and the best of many places flatters itself: --verify tells")
    return (f"by sampling: {draws.in_words}{starts}; in each cell of a box at least {100 * risk:g} % of them reach its worst value; of all rigs at "
            f"least {100 * assured(risk, draws.count):.3g} %, in 19 cases of 20 for a cell by itself; between cells nothing is known, and the best "
            "of many places flatters itself: --verify tells")
