"""Promises of operating_point.py, against random starts and places: each an independent run."""

import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import h5py

import jobs
import kept_claims
import launch

PROGRAM = Path(__file__).resolve().parents[2] / "postprocess" / "operating_point.py"
NATURAL_HZ, AMPLITUDE_MM = 4.5, 0.89
RECTANGLE = {"displacement": (-4.0, 1.0), "velocity": (-4.0, 4.0)}
INSIDE = 0.99  # of a box: its place is printed with five digits
RIG = """
schema = 1
kind = "map"
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
damping_ratio = {zeta!r}
[cart]
amplitude_m = 0.89e-3
[contact]
{stop}
"""


def random_rigs(seed, count):
    """Job tables, each with a window of frequencies and gaps: (text, {axis: (from, to)})."""
    rigs = [{**rig, "stop": kept_claims.spring(rig["ki"], rig["ci"])} for rig in kept_claims.random_rigs(seed, count)]
    return [(RIG.format(**rig), {"frequency_ratio": (0.6, 4.0), "gap_ratio": (0.0, 2.0)}) for rig in rigs]


def places(folder, rig, window, starts, which, drift, points=60):
    """[(frequency in Hz, gap in mm, "p/q", smallest share)] reported for a map, possibly empty; (hz, mm) is the drift."""
    axes = "".join(jobs.axis(name, *map(repr, ends), points) for name, ends in window.items())
    jobs.write(folder, rig + axes + f"[starts]\ncount = {starts}\ndisplacement_ratio = {list(RECTANGLE['displacement'])}\n"
               f"velocity_ratio = {list(RECTANGLE['velocity'])}\n")
    finished = launch.run("run", "job.toml", "--quiet", "--fresh", cwd=folder, ranks=2)
    assert finished.returncode == 0, finished.stderr
    told = subprocess.run([sys.executable, PROGRAM, "job.h5", "--hz", str(drift[0]), "--mm", str(drift[1]), "--starts", *which,
                           "--formats", "png"], cwd=folder, capture_output=True, text=True, timeout=300, check=False,
                          env=launch.ENVIRONMENT)
    row = r"^ *\d+ +(\d+/\d+) +([\d.]+) +([\d.e-]+) +\S+ +\S+(?: +([\d.]+) %)?$"
    return [(float(hertz), float(gap), label, float(share or 100) / 100)
            for label, hertz, gap, share in re.findall(row, told.stdout, re.MULTILINE)]


def ends_of(folder, rig, place, drift, chance, tries, grid=(15, 14)):
    """Number of random starts, `tries` times 210, that end in each label, each batch at a random point of the box."""
    ends = Counter()
    for _ in range(tries):
        eta = (place[0] + INSIDE * drift[0] * chance.uniform(-1, 1)) / NATURAL_HZ
        gap = (place[1] + INSIDE * drift[1] * chance.uniform(-1, 1)) / AMPLITUDE_MM
        text = rig + f"[operating_point]\nfrequency_ratio = {float(eta)!r}\ngap_ratio = {float(gap)!r}\n"
        for (name, (low, high)), points in zip(RECTANGLE.items(), grid):
            step = ((min(high, gap) if name == "displacement" else high) - low) / points
            first = low + step * chance.random()
            text += jobs.axis(f"start.{name}_ratio", repr(float(first)), repr(float(first + (points - 1) * step)), points)
        jobs.write(folder, text, name="starts.toml")
        finished = launch.run("run", "starts.toml", "--quiet", "--fresh", cwd=folder)
        assert finished.returncode == 0, finished.stderr
        with h5py.File(folder / "starts.h5") as file:
            labels = zip(*(file[name][()].ravel().tolist() for name in ("regime", "impacts", "period")))
            ends.update(f"{p}/{q}" if regime == 1 else regime for regime, p, q in labels)
    return ends
