#!/usr/bin/python3
"""Shares of 200 cells of random rigs in which chaos may end in motion without impact, against separate runs: within the
binomial error. The part fails on more than five errors in a cell, or on errors larger than by chance.

    PETERKA_ENDURANCE_CELLS=20 tests/endurance.sh chaos_shares     instead of 200
"""

import os
import random
import sys
import tempfile
from pathlib import Path

import parts
import kept_places
import shares_of_chaos

CELLS = int(os.environ.get("PETERKA_ENDURANCE_CELLS", "200"))
SEED = int(os.environ.get("PETERKA_ENDURANCE_SEED", "5"))
WINDOW = {"frequency_ratio": (1.5, 5.0), "gap_ratio": (1.05, 2.5)}
FROM_EACH = 10  # cells per rig
MOST_ERRORS, LARGEST_MEAN_SQUARE = 5, 1.3


def main():
    chance, errors = random.Random(SEED), []
    for rig, _ in kept_places.random_rigs(SEED, CELLS):
        if len(errors) >= CELLS:
            break
        with tempfile.TemporaryDirectory() as folder:
            cells = shares_of_chaos.chaotic_cells(Path(folder), rig, WINDOW)
            for place in chance.sample(cells, min(FROM_EACH, len(cells), CELLS - len(errors))):
                found = shares_of_chaos.shares(Path(folder), rig, place)
                errors.append(max((shares_of_chaos.errors_apart(*found[regime]) for regime in (0, 2)), key=abs))
                print(f"{place}: {found}, {errors[-1]:.2f} errors", flush=True)
    square = sum(error**2 for error in errors) / max(len(errors), 1)
    far = sum(abs(error) > MOST_ERRORS for error in errors)
    parts.row("shares of chaos that may end, of 256 starts, against as many runs of their own: cells of random rigs", len(errors),
              f"{far} lie more than {MOST_ERRORS} binomial errors apart, {max(map(abs, errors)):.2g} at most, {square**0.5:.2g} in the mean square")
    return 1 if len(errors) < CELLS or far or square > LARGEST_MEAN_SQUARE**2 else 0


if __name__ == "__main__":
    sys.exit(main())
