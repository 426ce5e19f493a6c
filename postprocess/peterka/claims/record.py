"""A claim of the paper with its verdict, and the limits used for verdicts."""

from collections.abc import Iterable
from dataclasses import dataclass

FREQUENCY = 0.25  # Hz
SHARE, ALL, SOME = 0.10, 0.95, 0.10
HIGH_GAP = 1.5  # A0
CLOSED_FORM = 0.01
RANGE = 0.5
WIDE = 0.05  # of the columns
DRIFT = 0.5  # Hz to either side: two of the printed steps
LIMITS = (
    ("Frequencies", f"agree within {FREQUENCY} Hz, the step of the printed ones; what is higher, or a hysteresis, differs by "
     "more than that"),
    ("Forces and ratios", f"agree within {100 * SHARE:.0f} %, the largest error that the paper calls satisfactory; what is "
     "larger, changed much, or lost at the end of a band, differs by more than that"),
    ("All, identical, robust", f"{100 * ALL:.0f} % of the cells, gaps or starts that are looked at"),
    ("Some", f"{100 * SOME:.0f} % of the starts, or of a gap's cells between the bands; where some starts end in impacts and "
     f"others in none, {100 * SOME:.0f} % of each"),
    ("Closed forms", f"agree within {100 * CLOSED_FORM:.0f} %"),
    ("Spectra", f"a peak reaches {100 * SHARE:.0f} % of the largest value; its frequency agrees within {100 * SHARE:.0f} %, "
     f"in the paper's range of 1 kHz within {100 * RANGE:.0f} %"),
    ("High gaps", f"from gap/A0 = {HIGH_GAP:g} up, the only number that the paper gives for them"),
    ("Between the bands", "from the end of the widest z = 1/1 of a gap to the beginning of its widest z = 1/2; a gap with no "
     f"z = 1/1, or with none of z = 1/2 as wide as {100 * WIDE:.0f} % of the frequencies, takes those of the next lower gap"),
    ("Drift", f"most of the force is left where a place has, at the worst, still {100 * (1 - SHARE):.0f} % of the largest one that a "
     "place of the same gap has without the drift"),
    ("Jumps of a sweep", "change the force by more than a twentieth of the branch's largest one and, between motions with a "
     "period, by more than twice as much as the steps beside it; a motion of four points or more begins or ends there, or one of fewer where "
     "the change is more than twice each of the four before and after it"),
)
SETTLED = ("The limits of frequencies, forces and ratios were set before the numbers were seen. The others, and what is "
           "asked of the claims that print no number, were settled after a first look.")
AGREES, DIFFERS, OPEN = "agrees", "differs", "not computed"


@dataclass(frozen=True)
class Claim:
    """`key` identifies the claim permanently; `place` is its location in the paper; `says` restates it in our words; `computed` and
    `difference` hold numbers from the files; `why` is the likely cause; `pictures` are names without a suffix."""

    key: str
    place: str
    says: str
    computed: str
    verdict: str
    difference: str = ""
    why: str = ""
    pictures: tuple[str, ...] = ()


def claim(key: str, place: str, says: str, computed: str, holds: bool, difference: str = "", why: str = "",
          pictures: Iterable[str] = ()) -> Claim:
    """A Claim that agrees if it holds; explanations of a difference are omitted if there is none."""
    verdict = AGREES if holds else DIFFERS
    return Claim(key, place, says, computed, verdict, difference, "" if holds else why, tuple(pictures))


def not_computed(key: str, place: str, says: str, missing: str) -> Claim:
    """A Claim left open for lack of a file."""
    return Claim(key, place, says, f"{missing} is not in the folder: run jobs/paper.sh", OPEN)


def off_by(value: float, printed: float, unit: str) -> str:
    """The difference between a computed and a printed number, in words."""
    return f"{value - printed:+.3g} {unit} ({100 * (value / printed - 1):+.1f} %)"


def near(value: float, other: float, share: float = SHARE) -> bool:
    """Whether two forces or ratios agree to within this share."""
    return abs(value / other - 1) <= share


def percent(share: float) -> str:
    """0.1234 is "12.34 %"."""
    return f"{100 * share:.4g} %"
