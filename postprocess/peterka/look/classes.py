"""The classes of a Peterka map and their fixed colours.

A class is a regime, or one p/q of the periodic regime; p/q is never reduced. Each class has the same colour in every
picture, so that maps of different rigs can be laid side by side. 1/1 and 1/2 are near the paper's red and green. The
first seven p/q are the palette of Okabe and Ito; the others were searched for so that every pair stays apart for normal
sight and for deuteranopes (tests/postprocess/test_picture_colours.py holds that). A doubled orbit is darker than its
parent. 1/1 and 1/2 are equally bright, so pictures also write p/q into the large areas: they can be read in grey.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers
from ..files.regimes import CHAOTIC, FAILED, NO_IMPACT, NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT, UNRESOLVED


@dataclass(frozen=True)
class Class:
    """One entry of a legend. `colour` is '#RRGGBB'; `orbit` is (p, q) for a p/q of its own, else None."""

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

_BEFORE = [Class("no impact", "#F2F2F2")]
_AFTER = [
    Class("other p/q", "#D4BEA5"),
    Class("chaotic", "#1A1A1A"),
    Class("sustained contact", "#99AA66"),
    Class("unresolved", "#686868"),
    Class("failed", "#C04DF7"),
    Class("not computed yet", "#FFFFFF"),
]

CLASSES = _BEFORE + [Class(f"{p}/{q}", colour, (p, q)) for (p, q), colour in _ORBITS.items()] + _AFTER
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


def classify(regime: Integers, impacts: Integers, period: Integers) -> NDArray[np.uint8]:
    """Index into CLASSES of each cell, uint8. All three arguments are integer arrays of one shape."""
    table = np.zeros(256, dtype=np.uint8)
    for value, label in _OF_REGIME.items():
        table[value % 256] = INDEX[label]
    index = table[np.asarray(regime).astype(np.uint8)]
    for (p, q) in _ORBITS:
        index[(regime == PERIODIC) & (impacts == p) & (period == q)] = INDEX[f"{p}/{q}"]
    return index


def class_of(regime: int, impacts: int, period: int) -> Class:
    """The Class of one cell; an orbit without a colour of its own keeps its p/q in the label."""
    entry = CLASSES[int(classify(*(np.array([value]) for value in (regime, impacts, period)))[0])]
    return Class(f"{impacts}/{period}", entry.colour) if entry.label == "other p/q" else entry
