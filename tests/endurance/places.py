#!/usr/bin/python3
"""Promises of 30 boxes of operating_point.py, each tested with 10,000 random starts and places. A start that swings without
impact in a box for every start fails the part, as do more starts ending elsewhere than stated.

    PETERKA_ENDURANCE_BOXES=4 tests/endurance.sh places     instead of 30
"""

import os
import random
import sys
import tempfile
from pathlib import Path

import parts
import kept_places

sys.path.insert(0, str(Path(__file__).parents[2] / "postprocess"))
from peterka.operating.told import least_share, share_excluded  # noqa: E402

BOXES = int(os.environ.get("PETERKA_ENDURANCE_BOXES", "30"))
SEED = int(os.environ.get("PETERKA_ENDURANCE_SEED", "17"))
DRIFT = 0.1, 0.03  # Hz, mm
TRIES = 48  # times 210 starts
EACH = 2  # boxes per map
KINDS = [(16, ("any",)), (59, ("any",)), (59, ("share", "0.95"))]


def main():
    chance = random.Random(SEED)
    lots = {" ".join(which) + f", {starts} starts": [0, 0, 0, 0, 0] for starts, which in KINDS}
    boxes = 0
    for rig, window in kept_places.random_rigs(SEED, 10 * BOXES):
        if boxes >= BOXES:
            break
        starts, which = KINDS[boxes // EACH % len(KINDS)]
        with tempfile.TemporaryDirectory() as folder:
            told = kept_places.places(Path(folder), rig, window, starts, which, DRIFT)
            for place in chance.sample(told, min(EACH, len(told), BOXES - boxes)):
                ends = kept_places.ends_of(Path(folder), rig, place, DRIFT, chance, TRIES)
                allowed = share_excluded(starts) if which == ("any",) else 1 - least_share(place[3], starts)
                elsewhere = 1 - ends[place[2]] / ends.total()
                print(f"{place}, {which}: {dict(ends)}, {elsewhere:.4f} elsewhere, {allowed:.4f} allowed", flush=True)
                found = lots[" ".join(which) + f", {starts} starts"]
                found[0] += 1
                found[1] += ends.total()
                found[2] += ends[0] if which == ("any",) else 0  # without impact, which was proved impossible
                found[3] += elsewhere > allowed
                found[4] = max(found[4], elsewhere)
                boxes += 1
    for name, (count, total, free, broken, most) in lots.items():
        proved = f"{free} of {total:,} starts end without impact, which is proved not to be; " if name.startswith("any") else ""
        parts.row(f"a place told for {name}, against starts and places at random: boxes", count,
                  f"{proved}in {broken} boxes more of {total:,} starts end elsewhere than is told, {100 * most:.2g} % at most")
    return 1 if any(free or broken for _, _, free, broken, _ in lots.values()) or boxes < BOXES else 0


if __name__ == "__main__":
    sys.exit(main())
