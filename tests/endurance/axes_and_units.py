#!/usr/bin/python3
"""The table of end_to_end/test_axes_and_units.py over every pair of axes: what programs report of a file, in either unit."""

import os
import re
import subprocess
import sys
from pathlib import Path

import parts

TABLE = Path(__file__).parents[1] / "end_to_end/test_axes_and_units.py"


def main():
    binary = Path(os.environ["PETERKA_BINARY"])
    run = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", TABLE], text=True, stdout=subprocess.PIPE,
                         env={"LIVE_CELLS": str(binary.parent / "live_cells"), "MPIEXEC": "mpiexec"} | os.environ | {"PETERKA_EVERY_PAIR": "1"})
    print(run.stdout)
    counts = {word: int(number) for number, word in re.findall(r"(\d+) (passed|failed|error)", run.stdout.splitlines()[-1])}
    parts.row("kind, feature and every pair of axes, as ratios and in SI units", sum(counts.values()),
              "the same numbers, or refused with the reason" if run.returncode == 0 else f"**{counts}**")
    return run.returncode


if __name__ == "__main__":
    sys.exit(main())
