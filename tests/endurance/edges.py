#!/usr/bin/python3
"""Distances of cells from the boundary of their motion, against sweeps that continue the motion until its label changes or
its force, with a rigid stop its impact speed, jumps: 500 random cells of five random rigs with a spring and dashpot, and as many
with rigid stops, along both axes. A wrong distance fails the part and is reported, as do more than 2 % of cells with unknown
distance, but on rigid stops, where many motions end as the hammer begins to stick. Also checks the borders listed in summaries.

    PETERKA_ENDURANCE_CELLS=20 tests/endurance.sh edges     of each rig, instead of 100
"""

import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import parts
import edges_of_motions

RIGS = 5
CELLS = int(os.environ.get("PETERKA_ENDURANCE_CELLS", "100"))
SEED = int(os.environ.get("PETERKA_ENDURANCE_SEED", "11"))


def distances(folder, rig, seed):
    """The faults in the distances of random cells, None if correct."""
    cells = edges_of_motions.cells_of(folder, rig)

    def one(number, cell, side):
        place = folder / str(number)
        place.mkdir()
        return edges_of_motions.disagreement(place, rig, cells, cell, side)

    chosen = edges_of_motions.random_cells(cells, CELLS, seed)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(one, range(len(chosen)), *zip(*chosen)))
    for (cell, side), words in zip(chosen, found):
        if words is not None:
            print(f"cell {cell}, {side}: {words}", flush=True)
    return found


def borders(folder, rig):
    """Whether each border listed at three gaps is one."""
    low, high = edges_of_motions.window_of(rig)["gap_ratio"]
    found = []
    for gap in (low + share * (high - low) for share in (0.2, 0.5, 0.8)):
        for place in [told for told in edges_of_motions.borders_told(folder, rig, gap) if told[0] > 0]:
            found.append(edges_of_motions.is_border(folder, rig, gap, *place))
            if not found[-1]:
                print(f"gap/A0 {gap:.6g}: {place[:3]} is no border", flush=True)
    return found


def attack(rigs, words, most_unknown):
    """Distances and borders of some rigs; whether they are as they should be."""
    told, bordering = [], []
    for number, rig in enumerate(rigs):
        print(rig, flush=True)
        with tempfile.TemporaryDirectory() as folder:
            told += distances(Path(folder), rig, number)
            bordering += borders(Path(folder), rig)
    unknown = told.count("unknown")
    wrong = len(told) - told.count(None) - unknown
    parts.row(f"distance to the edge of a cell's motion, against dragging it there: cells of {RIGS} random rigs{words}", len(told),
              f"{wrong} wrong, {unknown} say that they don't know")
    parts.row(f"a border of a regime, against dragging a motion there, from starts and from the curve's own orbit, and what 512 starts find on either side: {RIGS} random rigs{words}", len(bordering),
              f"{bordering.count(False)} where none ends and as many have the label on both sides")
    return wrong == 0 and unknown <= most_unknown * len(told)


def main():
    springs = attack(edges_of_motions.random_rigs(SEED, RIGS), "", 0.02)
    rigid = attack(edges_of_motions.rigid_rigs(SEED, RIGS), " with rigid stops, r 0, 0.05, and 0.2 to 0.95", 1.0)
    return 0 if springs and rigid else 1


if __name__ == "__main__":
    sys.exit(main())
