"""A claim of the paper and how it fared.

A verdict comes from a tolerance that is stated with the claim ; these follow from the paper, not from the numbers:
- FREQUENCY: the paper prints frequencies in steps of 0.25 Hz;
- SHARE: what the paper calls satisfactory agreement goes up to an error of 10 %, forces and frequency ratios alike;
- ALL: `all`, `identical` and `robust` are taken for 95 % of the cells or starts that are looked at.
"""

from dataclasses import dataclass

FREQUENCY, SHARE, ALL = 0.25, 0.10, 0.95
AGREES, DIFFERS, OPEN = "agrees", "differs", "not computed"


@dataclass(frozen=True)
class Claim:
    """`key` names it for ever; `place` is where the paper says it; `says` is in our words; `computed` and `difference`
    hold numbers of the files; `why` is the likely cause; `pictures` are names without a suffix."""

    key: str
    place: str
    says: str
    computed: str
    verdict: str
    difference: str = ""
    why: str = ""
    pictures: tuple[str, ...] = ()


def claim(key, place, says, computed, holds, difference="", why="", pictures=()):
    """A Claim that agrees where it holds; what explains a difference is left out where there is none."""
    verdict = AGREES if holds else DIFFERS
    return Claim(key, place, says, computed, verdict, difference, "" if holds else why, tuple(pictures))


def not_computed(key, place, says, missing):
    return Claim(key, place, says, f"{missing} is not in the folder: run jobs/paper.sh", OPEN)


def off_by(value, printed, unit):
    """How far a computed number is from the printed one."""
    return f"{value - printed:+.3g} {unit} ({100 * (value / printed - 1):+.1f} %)"


def percent(share):
    return f"{100 * share:.4g} %"
