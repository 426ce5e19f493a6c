"""Which known name an unknown one was probably meant to be, as the program suggests for the keys of a job."""

from collections.abc import Collection, Sequence
from difflib import get_close_matches

from .harmless import harmless

LONGEST = 60  # letters that are compared
LIKENESS = 0.75  # of 1: a letter or two of a word differ


def did_you_mean(name: str, known: Collection[str]) -> str:
    """" (did you mean ...?)" to follow an unknown name in a message; empty where no known one is near."""
    near = get_close_matches(name[:LONGEST].lower(), known, 1, LIKENESS)
    return f" (did you mean {near[0]}?)" if near else ""


def instead_of(unknown: Sequence[str], known: Collection[str], has: str) -> str:
    """Unknown names, each with the known one that is near; where one has none, all known ones follow, after `has`: "it has"."""
    near = [did_you_mean(name, known) for name in unknown]
    named = ", ".join(f"'{harmless(name, LONGEST)}'{suggestion}" for name, suggestion in zip(unknown, near))
    return named if all(near) else f"{named}; {has} {', '.join(known)}"
