"""All groups of claims, in the order of the page."""

from . import drift, force_map, gap_zero, jumps, pulse, robust, starts, stiffness
from .folder import Folder
from .record import Claim

GROUPS = [
    ("Bands and forces at gap 0", gap_zero),
    ("Single impacts", pulse),
    ("Forces over frequency and gap", force_map),
    ("Jumps and impact resonances", jumps),
    ("Gap 0 against other gaps", robust),
    ("What a drift leaves", drift),
    ("Three beam springs", stiffness),
    ("What the start decides", starts),
]


def all_claims(folder: Folder) -> list[tuple[str, list[Claim]]]:
    """[(title of the group, its Claims)]"""
    return [(title, group.claims(folder)) for title, group in GROUPS]
