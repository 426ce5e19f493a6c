"""Whether the verdicts of claims hold for rigs that differ from the printed one as a measured rig may.

    python3 -m peterka.claims.drawn_rigs FOLDER COUNT

writes the jobs of all files of FOLDER on which verdicts depend once more for each of COUNT rigs, into FOLDER/rigs/1, 2, ...: ki and ci
lie within 5 % of the printed ones, gaps within 0.1 mm of those named, uniformly, by the low-discrepancy sequence R3 (Roberts, The
unreasonable effectiveness of quasirandom sequences, 2018). The paper prints no errors of these; its gaps are set by calibrated shims.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..files.opened import OpenedFile
from .record import AGREES, OPEN, Claim

SPREAD, GAP_SPREAD_MM = 0.05, 0.1
NOT_NEEDED = ("rigs", "sensitivity", "nearby_150mm", "nearby_135mm")  # what tells only why a claim differs
_STEP = 1.2207440846057596  # the root of g^4 = g + 1


@dataclass(frozen=True)
class DrawnRig:
    """`stiffness` and `damping` are factors of ki and ci, `gap_mm` is added to each gap [mm]."""

    stiffness: float
    damping: float
    gap_mm: float


def drawn_rig(number: int) -> DrawnRig:
    """The rig of this number, from 1."""
    x, y, z = (2 * ((0.5 + number / _STEP**power) % 1) - 1 for power in (1, 2, 3))
    return DrawnRig(1 + SPREAD * x, 1 + SPREAD * y, GAP_SPREAD_MM * z)


def job_of(text: str, rig: DrawnRig) -> str:
    """The resolved text of a job, for this rig. Starts of a basin that end at the stop go on doing so."""
    job = tomllib.loads(text)
    shift = rig.gap_mm / (1e3 * job["cart"]["amplitude_m"])
    starts = job.get("axes", {}).get("displacement_ratio")
    ends_at_stop = starts is not None and starts["to"] == job["operating_point"]["gap_ratio"]
    changes = {("contact", "stiffness_n_per_m"): (rig.stiffness, 0.0), ("contact", "damping_ns_per_m"): (rig.damping, 0.0)}
    shifted = [("axes.gap_ratio", "from"), ("axes.gap_ratio", "to"), ("operating_point", "gap_ratio"), ("sweep", "gap_ratio"),
               ("curves", "gap_ratio"), *[("axes.displacement_ratio", "to")] * ends_at_stop]
    changes |= {place: (1.0, shift) for place in shifted}
    table, lines = "", []
    for line in text.splitlines():
        table = line.strip("[]") if line.startswith("[") else table
        key, equals, value = line.partition(" = ")
        factor, offset = changes.get((table, key), (1.0, 0.0))
        number, comment, words = value.partition("#")
        if equals and (factor, offset) != (1.0, 0.0):
            number = re.sub(r"[-+.\de]+", lambda found: repr(float(found[0]) * factor + offset), number)
        lines.append(f"{key}{equals}{number}{comment}{words}")
    return "\n".join(lines) + "\n"


@dataclass(frozen=True)
class Agreement:
    """With how many of the rigs for which a claim was computed it agrees."""

    agree: int
    computed: int

    def __str__(self) -> str:
        """As in "5 of 16"."""
        return f"{self.agree} of {self.computed}"


def agreements(of_rigs: Iterable[Sequence[Claim]]) -> dict[str, Agreement]:
    """By claim, from the claims of each rig."""
    found: dict[str, Agreement] = {}
    for claims in of_rigs:
        for claim in claims:
            if claim.verdict != OPEN:
                old = found.get(claim.key, Agreement(0, 0))
                found[claim.key] = Agreement(old.agree + (claim.verdict == AGREES), old.computed + 1)
    return found


def write_jobs(folder: Path, count: int) -> None:
    """The jobs of rigs 1 to `count`, beside each other in FOLDER/rigs."""
    for path in sorted(folder.rglob("*.h5")):
        name = path.relative_to(folder)
        if name.parts[0] in NOT_NEEDED:
            continue
        with OpenedFile(path) as file:
            job = file.data.attribute("job")
        for number in range(1, count + 1):
            of_rig = (folder / "rigs" / str(number) / name).with_suffix(".toml")
            of_rig.parent.mkdir(parents=True, exist_ok=True)
            of_rig.write_text(job_of(str(job), drawn_rig(number)))


if __name__ == "__main__":
    write_jobs(Path(sys.argv[1]), int(sys.argv[2]))
