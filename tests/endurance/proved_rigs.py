#!/usr/bin/python3
"""How many periodic cells of random rigs are proved: maps of 24 x 24 cells of 25 rigs each with a spring and dashpot and with a
rigid stop, with linear and with cubic springs; and of how many, where rounding doesn't decide, the start is proved to lead there. Fails
below 97 and 95 %.

    PETERKA_RANDOM_RIGS=100 tests/endurance.sh proved_rigs     of each kind, instead of 25
"""

import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import h5py
import numpy as np

import parts

RIGS = int(os.environ.get("PETERKA_RANDOM_RIGS", "25"))
LEAST, LEAST_FROM_START = 0.97, 0.95
FAILED_CELLS = 4  # exit code: softening springs let a hammer escape
SEED = 2026
AXES = """[axes.frequency_ratio]
from = 0.5
to = 4.5
points = 24
[axes.gap_ratio]
from = -0.5
to = 3.5
points = 24
[start]
displacement_ratio = -1.0
[certificate]
cells = "all"
starts = true
[output]
fields = ["sensitivity"]
"""


def random_job(random, stop, cubic):
    """Damping ratios from 0.002 to 0.1; cubic springs of either sign, k3 A0^2 up to 1e-3 k."""
    def spread(low, high):
        return float(np.exp(random.uniform(np.log(low), np.log(high))))

    mass, hertz, ratio, amplitude = spread(0.05, 50), spread(1, 100), spread(0.002, 0.1), spread(1e-4, 5e-3)
    stiffness = mass * (2 * np.pi * hertz)**2
    if stop == "kelvin_voigt":
        contact = stiffness * spread(30, 1e5)
        damping = float(2 * random.uniform(0.02, 0.9) * np.sqrt(contact * mass))
        law = f"stiffness_n_per_m = {contact!r}\ndamping_ns_per_m = {damping!r}\n"
    else:
        law = f"coefficient = {float(random.uniform(0, 1))!r}\n"
    spring = f"cubic_stiffness_n_per_m3 = {float(random.uniform(-1, 1) * 1e-3 * stiffness / amplitude**2)!r}\n" if cubic else ""
    return (f'schema = 1\nkind = "map"\ntitle = "random"\n[hammer]\nmass_kg = {mass!r}\nnatural_frequency_hz = {hertz!r}\n'
            f'damping_ratio = {ratio!r}\n{spring}[cart]\namplitude_m = {amplitude!r}\n[contact]\nlaw = "{stop}"\n{law}{AXES}')


def proved(folder, text):
    """(periodic cells, how many have which verdict, how many proved ones with a sensitivity below 20 have which) of a job."""
    (folder / "job.toml").write_text(text)
    finished = subprocess.run([os.environ["PETERKA_BINARY"], "run", "job.toml", "--quiet", "--fresh"], cwd=folder, capture_output=True, text=True)
    if finished.returncode not in (0, FAILED_CELLS):
        raise SystemExit(finished.stderr)
    with h5py.File(folder / "job.h5") as file:
        periodic = file["regime"][()] == 1
        words = dict(zip(file["certified"].attrs["flag_values"].tolist(), file["certified"].attrs["flag_meanings"].split()))
        certified = file["certified"][()]
        sure = periodic & (certified > 0) & (file["sensitivity"][()] < 20)
        return int(periodic.sum()), *(Counter(words[number] for number in certified[of].tolist()) for of in (periodic, sure))


def main():
    random, bad = np.random.default_rng(SEED), False
    with tempfile.TemporaryDirectory() as folder:
        for stop in ("kelvin_voigt", "restitution"):
            for cubic in (False, True):
                cells, verdicts, sure = 0, Counter(), Counter()
                for _ in range(RIGS):
                    count, of_rig, of_sure = proved(Path(folder), random_job(random, stop, cubic))
                    cells, verdicts, sure = cells + count, verdicts + of_rig, sure + of_sure
                share = (verdicts.pop("orbit", 0) + verdicts.pop("start", 0)) / cells
                from_start = sure["start"] / sure.total()
                bad |= share < LEAST or from_start < LEAST_FROM_START
                why = ", ".join(f"{count} {word}" for word, count in verdicts.most_common())
                parts.row(f"a periodic cell without a proof: {RIGS} random rigs, {stop}, {'cubic' if cubic else 'linear'} springs", cells,
                          f"{100 * share:.2f} % proved, and the start of {100 * from_start:.2f} % of those with a sensitivity below 20; "
                          f"not: {why or 'none'}")
    return int(bad)


if __name__ == "__main__":
    sys.exit(main())
