"""The classes of a Peterka map and their fixed colours.

A class is a regime, or one p/q of the periodic regime; p/q is never reduced. Each class has the same colour in every picture, so that
maps of different rigs can be compared. 1/1 and 1/2 are near the paper's red and green. The first seven p/q use the palette of Okabe and
Ito; the others were optimised so that every pair is distinguishable for normal vision and for protanopes, deuteranopes and tritanopes
(simulated in tests/postprocess/test_picture_colours.py). A period-doubled orbit is darker than its parent. 1/1 and 1/2 are equally
bright, so pictures also write p/q into large areas and remain readable in grey.

Every other p/q up to 12/12 has one of a few further colours, by a fixed table of p and q. If two in a picture share a
colour, or a legend would be too long, the most frequent are named and all rarer ones are "other p/q".
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers
from ..files.regimes import CHAOTIC, FAILED, NO_IMPACT, NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT, UNRESOLVED


@dataclass(frozen=True)
class Class:
    """One entry of a legend. `colour` is '#RRGGBB'; `orbit` is (p, q) for a class of a single p/q, else None."""

    label: str
    colour: str
    orbit: tuple[int, int] | None = None


_ORBITS = {
    (1, 1): "#D55E00",
    (2, 2): "#E69F00",
    (4, 4): "#762024",
    (3, 3): "#8F5100",
    (1, 2): "#009E73",
    (2, 4): "#4F7A46",
    (1, 3): "#0072B2",
    (2, 1): "#CC79A7",
    (4, 2): "#74285D",
    (3, 1): "#56B4E9",
    (6, 2): "#A9D3DC",
    (4, 1): "#5A12B8",
    (5, 1): "#8F5F86",
    (3, 2): "#F0E442",
}

# Colours of the other p/q, optimised for distance from the others and from each other.
SECOND_COLOURS = ("#22012A", "#D1FDC2", "#594248", "#92A99B", "#07E0FE", "#78DF77", "#391301", "#0E046E")
_LARGEST = 12  # p and q that have colours
MOST_NAMED = 14  # p/q in a legend

_BEFORE = [Class("no impact", "#F2F2F2")]
_AFTER = [
    Class("other p/q", "#D4BEA5"),
    Class("chaotic", "#1A1A1A"),
    Class("sustained contact", "#99AA66"),
    Class("unresolved", "#686868"),
    Class("failed", "#C04DF7"),
    Class("not computed yet", "#FFFFFF"),
]



def _second_colour(p: int, q: int) -> str:
    """A hashed colour; it differs for the most frequent p/q, such as 2/3, 1/4, 3/4, 4/3, 5/2 and 2/5."""
    return SECOND_COLOURS[(p + 2 * q + 6 * p * q) % len(SECOND_COLOURS)]


_ALL_ORBITS = _ORBITS | {(p, q): _second_colour(p, q) for p in range(1, _LARGEST + 1) for q in range(1, _LARGEST + 1)
                         if (p, q) not in _ORBITS}
CLASSES = _BEFORE + [Class(f"{p}/{q}", colour, (p, q)) for (p, q), colour in _ALL_ORBITS.items()] + _AFTER
INDEX = {entry.label: index for index, entry in enumerate(CLASSES)}

_OF_REGIME = {
    NO_IMPACT: "no impact",
    PERIODIC: "other p/q",
    CHAOTIC: "chaotic",
    SUSTAINED_CONTACT: "sustained contact",
    UNRESOLVED: "unresolved",
    FAILED: "failed",
    NOT_COMPUTED: "not computed yet",
}
_OF_ORBIT = np.zeros((_LARGEST + 1, _LARGEST + 1), dtype=np.uint8)
for (_p, _q) in _ALL_ORBITS:
    _OF_ORBIT[_p, _q] = INDEX[f"{_p}/{_q}"]


def classify(regime: Integers, impacts: Integers, period: Integers) -> NDArray[np.uint8]:
    """Index into CLASSES of each cell, uint8. All three arguments are integer arrays of one shape."""
    table = np.zeros(256, dtype=np.uint8)
    for value, label in _OF_REGIME.items():
        table[value % 256] = INDEX[label]
    index = table[np.asarray(regime).astype(np.uint8)]
    known = (np.asarray(regime) == PERIODIC) & (impacts <= _LARGEST) & (period <= _LARGEST)
    index[known] = _OF_ORBIT[np.asarray(impacts)[known], np.asarray(period)[known]]
    return index


def named(counts: Integers) -> NDArray[np.uint8]:
    """The displayed class of each class for these cell counts, (len(CLASSES),): itself, or "other p/q", which is rarer than
    all named ones except for orbits with p or q above 12."""
    shown = np.arange(len(CLASSES), dtype=np.uint8)
    orbits = [n for n in np.argsort(-np.asarray(counts), kind="stable") if CLASSES[n].orbit]
    taken: set[str] = set()
    for n in orbits:
        colour = CLASSES[n].colour
        if counts[n] and len(taken) < MOST_NAMED and colour not in taken:
            taken.add(colour)
        else:
            break
    for n in orbits[len(taken):]:
        if counts[n] or CLASSES[n].colour in taken:
            shown[n] = INDEX["other p/q"]
    return shown


def class_of(regime: int, impacts: int, period: int) -> Class:
    """The Class of one cell; an orbit without a colour of its own keeps its p/q in the label."""
    entry = CLASSES[int(classify(*(np.array([value]) for value in (regime, impacts, period)))[0])]
    return Class(f"{impacts}/{period}", entry.colour) if entry.label == "other p/q" else entry
