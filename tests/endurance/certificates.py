#!/usr/bin/python3
"""Attacks on the proofs of cells, those of unit/certificate_attacks.cpp on a finer grid: claims known to be false must not be proved,
and what is proved of a rig or place that was changed must be what an engine finds there.

    PETERKA_ATTACKED_GRID=128 tests/endurance.sh certificates     cells per side, instead of 80
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import parts

GRID = os.environ.get("PETERKA_ATTACKED_GRID", "80")
UNIT_TESTS = Path(os.environ["PETERKA_BINARY"]).parent / "tests" / "unit_tests"
LINE = re.compile(r"^attacks: (\w+): (.*): (\d+) tried, (\d+) refused$", re.MULTILINE)
STOPS = {"KelvinVoigt": "a spring and dashpot", "Rigid0": "a rigid stop, r 0", "Rigid032": "a rigid stop, r 0.32", "Rigid08": "a rigid stop, r 0.8"}
ELSEWHERE = "refused; all others hold there, as an engine finds"
TOLD = {"another gap, stiffness or damping": ELSEWHERE, "another gap, restitution or damping": ELSEWHERE,
        "the orbit of half the period": "unstable and refused; all others stable by an engine, too",
        "two events left out": "solve the equations and are refused by the check of the legs",
        "a bounce left out": "solve the equations and are refused by the check of the legs"}


def main():
    if not UNIT_TESTS.exists():
        parts.skip(f"there is no {UNIT_TESTS.name} beside the program")
    finished = subprocess.run([UNIT_TESTS, "--gtest_filter=*CertificateAttacks*"], capture_output=True, text=True,
                              env=os.environ | {"PETERKA_ATTACKED_GRID": GRID})
    found = LINE.findall(finished.stdout)
    failures = finished.stdout.count("Failure\n")
    for stop, kind, tried, refused in found:
        parts.row(f"a proof of a false claim, {kind}: orbits of a map of {GRID} x {GRID} cells, {STOPS[stop]}", int(tried),
                  f"{failures} false proofs; {refused} {TOLD.get(kind, 'refused')}")
    if finished.returncode:
        print(finished.stdout[-4000:], file=sys.stderr)
    return finished.returncode


if __name__ == "__main__":
    sys.exit(main())
