#!/usr/bin/python3
"""Probabilities of outcomes and quantiles of forces of [uncertainty], 64 rigs, against plain random draws that are solved one by one by
the scalar engine: 200 cells of five random rigs, three with a spring and dashpot and two with a rigid stop. Fails where one is further off
than draws of both numbers would be by chance in one comparison of a million.

    PETERKA_PLAIN_DRAWS=10000 tests/endurance.sh drawn_rigs     for each cell, instead of 300
"""

import os
import sys
import tempfile
from pathlib import Path

import numpy as np

import parts
import uncertain_rigs

os.environ.setdefault("LIVE_CELLS", str(Path(os.environ["PETERKA_BINARY"]).parent / "live_cells"))

PLAIN, RIGS, COLUMNS, ROWS, SEED = int(os.environ.get("PETERKA_PLAIN_DRAWS", "300")), 64, 8, 5, 2027
MOST = 5.0  # standard errors
AT_A_TIME = 500
FORCES, SPEEDS = ("force_q05_ratio", "force_q50_ratio", "force_q95_ratio"), ("speed_q05", "speed_q50", "speed_q95")
JOB = """schema = 1
kind = "map"
title = "random"
[hammer]
mass_kg = {mass_kg!r}
natural_frequency_hz = {natural_frequency_hz!r}
damping_ratio = {damping_ratio!r}
[cart]
amplitude_m = {amplitude_m!r}
[contact]
{contact}
[axes.frequency_ratio]
from = 0.8
to = 3.9
points = 8
[axes.gap_ratio]
from = 0.0
to = 3.0
points = 5
[uncertainty]
rigs = 64
[uncertainty.hammer]
natural_frequency_hz = {{ relative = 0.02 }}
damping_ratio = {{ from = {damping_low!r}, to = {damping_high!r} }}
[uncertainty.contact]
{spread}
[uncertainty.operating_point]
gap_ratio = {{ standard_deviation = 0.03 }}
"""


def random_rig(random, rigid):
    def spread(low, high):
        return float(np.exp(random.uniform(np.log(low), np.log(high))))

    own = uncertain_rigs.paper_rig() | {"mass_kg": spread(0.05, 50), "natural_frequency_hz": spread(1, 100), "damping_ratio": spread(0.004, 0.05),
                                        "damping_ns_per_m": np.nan, "amplitude_m": spread(1e-4, 5e-3)}
    if rigid:
        return own | {"law": 1, "first": float(random.uniform(0.2, 0.9)), "second": np.nan}
    stiffness = own["mass_kg"] * (2 * np.pi * own["natural_frequency_hz"])**2 * spread(1e3, 1e5)
    return own | {"first": stiffness, "second": float(2 * random.uniform(0.05, 0.4) * np.sqrt(stiffness * own["mass_kg"]))}


def job_of(own):
    if own["law"] == 1:
        contact, spread = f'law = "restitution"\ncoefficient = {own["first"]!r}', "coefficient = { relative = 0.05 }"
    else:
        contact = f'law = "kelvin_voigt"\nstiffness_n_per_m = {own["first"]!r}\ndamping_ns_per_m = {own["second"]!r}'
        spread = "stiffness_n_per_m = { relative = 0.1 }\ndamping_ns_per_m = { relative = 0.2 }"
    return JOB.format(**own, contact=contact, spread=spread, damping_low=0.7 * own["damping_ratio"], damping_high=1.5 * own["damping_ratio"])


def drawn(own, random, frequency, gap):
    """A plain draw in the ranges of the keys."""
    while True:
        rig = own | {"natural_frequency_hz": own["natural_frequency_hz"] * (1 + 0.02 * random.standard_normal()),
                     "damping_ratio": own["damping_ratio"] * random.uniform(0.7, 1.5)}
        rigid = own["law"] == 1
        rig["first"] *= 1 + (0.05 if rigid else 0.1) * random.standard_normal()
        if not rigid:
            rig["second"] *= 1 + 0.2 * random.standard_normal()
        if (0 <= rig["first"] <= 1 if rigid else rig["first"] > 0 and rig["second"] >= 0):
            return uncertain_rigs.placed(own, rig, frequency, gap, 0.03 * random.standard_normal() * own["amplitude_m"])


def solved(rigs):
    """As uncertain_rigs.solve, a few at a time, as it waits for each call only so long."""
    found = [uncertain_rigs.solve(rigs[first:first + AT_A_TIME]) for first in range(0, len(rigs), AT_A_TIME)]
    return [label for labels, _ in found for label in labels], np.concatenate([strengths for _, strengths in found])


def compare(own, random, folder):
    """(cells, comparisons, deviations in standard errors) of a rig."""
    cells = uncertain_rigs.told(uncertain_rigs.compute(folder, job_of(own), "--fresh", "--quiet")[0])
    found = []
    for row, gap in enumerate(cells["gap_ratio"]):
        for column, frequency in enumerate(cells["frequency_ratio"]):
            labels, strengths = solved([drawn(own, random, frequency, gap) for _ in range(PLAIN)])
            found += uncertain_rigs.deviations(cells, row, column, RIGS, labels, strengths, SPEEDS if own["law"] == 1 else FORCES)
    return found


def main():
    random, found = np.random.default_rng(SEED), []
    with tempfile.TemporaryDirectory() as folder:
        for rigid in (False, False, False, True, True):
            found += compare(random_rig(random, rigid), random, Path(folder))
    found = np.array(found)
    parts.row(f"probabilities and quantiles of 64 rigs, against {PLAIN:,} plain draws in each of 200 cells: 5 random rigs", len(found),
              f"furthest off by {found.max():.1f} standard errors; {100 * np.mean(found > 2):.1f} % by more than two; {int(np.sum(found > MOST))} by more than {MOST:g}")
    return int(found.max() > MOST)


if __name__ == "__main__":
    sys.exit(main())
