#!/usr/bin/python3
"""Stops runs of every kind of work by a signal or --max-wall, and measures how long they take to end."""

import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import parts
import jobs
import launch
import map_contents

SCENES = {
    "map": (jobs.small_map(256, 256), []),
    "refined map": (jobs.small_map(257, 257), ["--set", "refine.levels=3"]),
    "CVODE at 1e-12": (jobs.small_map(64, 64), ["--set", "solver.engine=cvode", "--set", "solver.tolerance=1e-12"]),
    "cubic spring, split": (jobs.small_map(256, 256), ["--set", "hammer.cubic_stiffness_n_per_m3=238",
                                                       "--set", "solver.engine=split"]),
    "basin": (jobs.small_basin(256), []),
    "audit": (jobs.small_map(8, 8), ["--set", "audit.cells=64", "--set", "solver.tolerance=1e-12"]),
}
WAYS = [(None, "SIGUSR1"), (None, "SIGTERM"), (None, "SIGINT"), (None, "--max-wall"),
        (3, "SIGUSR1"), (3, "SIGTERM"), (3, "--max-wall")]
WALL = 0.5


def stopped(folder, arguments, ranks, way):
    """Exit code, and seconds from the wish to stop to the end; no seconds where the run was over before."""
    limit = ["--max-wall", WALL] if way == "--max-wall" else []
    process = launch.start("run", "job.toml", *arguments, *limit, cwd=folder, ranks=ranks)
    process.stderr.readline()  # "... cells to compute"
    begin = time.monotonic()
    if limit:
        begin += WALL
    else:
        try:
            process.wait(timeout=random.uniform(0, WALL))
        except subprocess.TimeoutExpired:
            begin = time.monotonic()
            process.send_signal(getattr(signal, way))
    process.communicate(timeout=launch.HANGING)
    return process.returncode, max(0.0, time.monotonic() - begin) if process.returncode != 0 else None


def main():
    random.seed(2026)
    bad = 0
    for ranks, way in WAYS:
        seconds, codes = {}, set()
        for scene, (text, arguments) in SCENES.items():
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                jobs.write(folder, text)
                code, taken = stopped(folder, arguments, ranks, way)
                if taken is None:
                    continue
                seconds[scene] = taken
                codes.add(code)
                bad += code != 5 and ranks is None
                map_contents.done_tiles(folder / "job.h5")  # it can be read
        slowest = max(seconds, key=seconds.get)
        print(way, ranks, codes, seconds)
        parts.row(f"{way.replace('SIG', '')}, {'alone' if ranks is None else f'mpirun -n {ranks}'}", len(seconds),
                  f"ends within {seconds[slowest]:.2f} s (slowest: {slowest}); exit code "
                  f"{', '.join(map(str, sorted(codes)))}; the file can be read")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
