#!/usr/bin/python3
"""What check foretells of jobs of every kind and law that has a closed form, against what their runs take: cycles as counted, and seconds
of processor time. Fails where the cycles are further off than a factor of 0.7 to 1.5; seconds are told.

    tests/endurance.sh prices
"""

import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

import parts

PROGRAM, JOBS = os.environ["PETERKA_BINARY"], Path(__file__).resolve().parents[2] / "jobs"
PLANE = "axes.frequency_ratio.points={0} axes.gap_ratio.points={0} audit.cells=0"
CASES = [("peterka_170mm", PLANE.format(256)), ("peterka_150mm", PLANE.format(256)), ("peterka_135mm", PLANE.format(256)),
         ("peterka_170mm", PLANE.format(128) + " solver.omit_tolerance=0.0"),
         ("peterka_170mm", PLANE.format(24) + ' solver.engine="cvode"'), ("rigid_170mm", PLANE.format(256)),
         ("rigid_170mm", PLANE.format(128) + " solver.omit_tolerance=0.0"), ("damping", ""), ("design_stop", ""),
         ("attractors_170mm", PLANE.format(32)), ("uncertain_170mm", "audit.cells=0"), ("basin_135mm", ""), ("basin_150mm", ""),
         ("basin_150mm_coexisting", ""), ("sweep_170mm", ""), ("sweep_135mm", ""), ("sweep_attractors_170mm", "")]
UNITS = {"us": 1e-6, "ms": 1e-3, "s": 1, "min": 60, "h": 3600}
LEAST, MOST = 0.7, 1.5


def seconds(words):
    """Of a duration as check prints it."""
    told = words.split()
    return sum(float(number) * UNITS[unit] for number, unit in zip(told[::2], told[1::2], strict=True))


def processor_time(*command):
    """Of a command, in seconds, and what it prints."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(list(map(str, command)), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, check=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, done.stdout


def ratios(folder, name, settings):
    """Foretold over counted cycles, and foretold over used seconds without those that a program takes to start."""
    sets = [word for each in settings.split() for word in ("--set", each)]
    started, _ = processor_time(PROGRAM, "--version")
    _, told = processor_time(PROGRAM, "check", JOBS / f"{name}.toml", *sets)
    cycles, time = re.search(r"#   time     ([\d.,]+) cycles a .*?: (?:some|at least) (.+?) of one core", told).groups()
    file = folder / f"{name}.h5"
    used, _ = processor_time(PROGRAM, "run", JOBS / f"{name}.toml", *sets, "--output", file, "--fresh", "--quiet")
    with h5py.File(file) as opened:
        counted = np.mean(opened["cycles"][()])
    return float(cycles.replace(",", "")) / counted, seconds(time) / (used - started)


def main():
    of_cycles, of_time = [], []
    with tempfile.TemporaryDirectory() as folder:
        for name, settings in CASES:
            cycles, time = ratios(Path(folder), name, settings)
            print(f"{name:24s} {settings:80s} cycles {cycles:.2f}  time {time:.2f}", flush=True)
            of_cycles.append(cycles)
            of_time.append(time)
    off = sum(not LEAST < ratio < MOST for ratio in of_cycles)
    parts.row("check's price of jobs of each kind and law with a closed form, over what the run takes", len(CASES),
              f"cycles {min(of_cycles):.2f} to {max(of_cycles):.2f}, processor time {min(of_time):.2f} to {max(of_time):.2f}")
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main())
