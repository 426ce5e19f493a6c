#!/usr/bin/python3
"""Attacks on the proofs of cells, those of unit/certificate_attacks.cpp on a finer grid, and on those of where curves have given gaps,
those of unit/curves_crossing_proof.cpp on more rigs: claims known to be false must not be proved, and what is proved of a rig or place that
was changed must be what an engine finds there.

    PETERKA_ATTACKED_GRID=128 tests/endurance.sh certificates     cells per side, instead of 80
    PETERKA_ATTACKED_RIGS=48 tests/endurance.sh certificates      random rigs with curves, instead of 12
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import parts

GRID = os.environ.get("PETERKA_ATTACKED_GRID", "80")
RIGS = os.environ.get("PETERKA_ATTACKED_RIGS", "12")
UNIT_TESTS = Path(os.environ["PETERKA_BINARY"]).parent / "tests" / "unit_tests"
LINE = re.compile(r"^attacks: (\w+): (.*): (\d+) tried, (\d+) refused$", re.MULTILINE)
MAP = f"orbits of a map of {GRID} x {GRID} cells"
ATTACKED = {"KelvinVoigt": f"{MAP}, a spring and dashpot", "Rigid0": f"{MAP}, a rigid stop, r 0", "Rigid032": f"{MAP}, a rigid stop, r 0.32",
            "Rigid08": f"{MAP}, a rigid stop, r 0.8",
            "crossings": f"where curves have four gaps, the paper's stop, a rigid one, r 0.7, and {RIGS} random rigs"}
ELSEWHERE = "refused; all others hold there, as an engine finds"
TOLD = {"another gap, damping or stop": "refused; all others hold there, as curves of that rig tell",
        "another gap, stiffness or damping": ELSEWHERE, "another gap, restitution or damping": ELSEWHERE,
        "the orbit of half the period": "unstable and refused; all others stable by an engine, too",
        "two events left out": "solve the equations and are refused by the check of the legs",
        "a bounce left out": "solve the equations and are refused by the check of the legs"}


def main():
    if not UNIT_TESTS.exists():
        parts.skip(f"there is no {UNIT_TESTS.name} beside the program")
    return max(attack("*CertificateAttacks*"), attack("CrossingProofThorough.*"))


def attack(tests):
    """The exit code of these unit tests, with a row for each kind of attack."""
    finished = subprocess.run([UNIT_TESTS, f"--gtest_filter={tests}"], capture_output=True, text=True,
                              env=os.environ | {"PETERKA_ATTACKED_GRID": GRID, "PETERKA_ATTACKED_RIGS": RIGS})
    found = LINE.findall(finished.stdout)
    failures = finished.stdout.count("Failure\n")
    for what, kind, tried, refused in found:
        parts.row(f"a proof of a false claim, {kind}: {ATTACKED[what]}", int(tried),
                  f"{failures} false proofs; {refused} {TOLD.get(kind, 'refused')}")
    if finished.returncode or not found:
        print(finished.stdout[-4000:], file=sys.stderr)
    return finished.returncode or int(not found)


if __name__ == "__main__":
    sys.exit(main())
