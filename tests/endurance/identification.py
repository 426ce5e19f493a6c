#!/usr/bin/python3
"""Whether identify.py's standard errors agree with the scatter of repetitions: recordings of random rigs, computed by scipy's DOP853,
with noise of 0.1 to 5 %, of force, or acceleration, with or without displacement. Intervals of 68 % and 95 % must cover the truth at
their nominal rates within chance (binomial, 99.9 %), and the mean of all errors over their standard errors must be below 0.2."""

import os
import sys
from pathlib import Path

import numpy as np
import parts

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / "postprocess"), str(Path(__file__).resolve().parents[2] / "postprocess")]
from identification_coverage import KINDS, coverage_faults, pulls_of, sound_rig  # noqa: E402

RIGS, EACH = (int(os.environ.get("IDENTIFICATION_" + name, default)) for name, default in (("RIGS", 20), ("EACH", 10)))


def main():
    chance, pulls, refused = np.random.default_rng(35), [], []
    for rig in range(RIGS):
        hammer, recorded = sound_rig(chance)
        for number in range(EACH):
            noise = np.exp(chance.uniform(np.log(1e-3), np.log(0.05)))
            found = pulls_of(hammer, recorded, KINDS[(rig + number) % len(KINDS)], noise, 1000 * rig + number)
            if isinstance(found, str):
                refused.append(found)
                print(rig, number, f"{100 * noise:.2g} %", found, flush=True)
            else:
                pulls.append(found)
                print(rig, number, f"{100 * noise:.2g} %", {key: round(pull, 2) for key, pull in found.items()}, flush=True)
    faults, words = coverage_faults(pulls)
    print("\n".join(refused))
    parts.row("errors of identify.py: recordings of random rigs, noise 0.1 to 5 %", RIGS * EACH,
              f"{len(refused)} refused; of the others' numbers {words}" + "".join(f"; **{fault}**" for fault in faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
