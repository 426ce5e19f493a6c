#!/usr/bin/python3
"""Critical kicks of random rigs, attacked by 10,000 smaller ones each, at random phases, by plain runs (critical_kicks.cpp).

    PETERKA_ENDURANCE_ATTRACTORS=20 tests/endurance.sh critical_kicks     instead of 100
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import parts

COUNT = int(os.environ.get("PETERKA_ENDURANCE_ATTRACTORS", "100"))
KICKS = 10_000
BUILD = Path(os.environ["PETERKA_BINARY"]).parent
MOST_BROKEN = 0.02  # share of the attractors


def main():
    if not (BUILD / "build.ninja").exists():
        parts.skip(f"{BUILD} is no build folder: the attack is a program of its own")
    subprocess.run(["cmake", "--build", BUILD, "--target", "critical_kicks"], check=True, stdout=subprocess.DEVNULL)
    told = subprocess.run([BUILD / "tests" / "critical_kicks", str(COUNT), str(KICKS)], check=True, text=True,
                          stdout=subprocess.PIPE).stdout
    print(told, flush=True)
    broken, by_a_tenth = map(int, re.search(r"(\d+) have a smaller one, (\d+) by more than a tenth", told).groups())
    parts.row(f"a critical kick, against {KICKS:,} smaller ones at random phases: orbits of random rigs", COUNT,
              f"{broken} have a smaller one, {by_a_tenth} by more than a tenth")
    return 1 if broken > MOST_BROKEN * COUNT or by_a_tenth else 0


if __name__ == "__main__":
    sys.exit(main())
