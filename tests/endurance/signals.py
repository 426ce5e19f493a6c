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
    """Exit code, and seconds from the wish to stop to the program's last word and to the end of all; None for no word."""
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
    word = None
    for line in process.stderr:
        if "stopped early" in line:
            word = max(0.0, time.monotonic() - begin)
    process.communicate(timeout=launch.HANGING)
    return process.returncode, word, max(0.0, time.monotonic() - begin)


def main():
    random.seed(2026)
    bad = 0
    for ranks, way in WAYS:
        words, ends, codes = [], [], set()
        for text, arguments in SCENES.values():
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                jobs.write(folder, text)
                code, word, end = stopped(folder, arguments, ranks, way)
                if code == 0:
                    continue  # it was over before
                codes.add(code)
                words += [word] if word is not None else []
                ends.append(end)
                bad += code != 5 and ranks is None
                map_contents.done_tiles(folder / "job.h5")  # it can be read
        print(way, ranks, codes, words, ends)
        last_word = f"in {len(words)} the ranks say after {max(words):.2f} s at most how to go on; " if words else ""
        parts.row(f"{way.replace('SIG', '')}, {'alone' if ranks is None else f'mpirun -n {ranks}'}", len(ends),
                  f"{last_word}ends within {max(ends):.2f} s; exit code {', '.join(map(str, sorted(codes)))}; the file "
                  "can be read")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
