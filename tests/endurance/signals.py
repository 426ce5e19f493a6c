#!/usr/bin/python3
"""Stops runs of every kind of work by a signal or --max-wall, and measures how long they take to end."""

import itertools
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
        (3, "SIGUSR1"), (3, "SIGTERM"), (3, "SIGINT"), (3, "--max-wall")]
LONGEST_WAIT = 0.5  # seconds of work before the stop request
PROMPT = 0.5  # seconds from the request to the end of a run without mpirun
PROMPT_OF_MPIRUN = 5
OF_MPIRUN = {"SIGTERM": (1, 128 + signal.SIGTERM), "SIGINT": (1, 128 + signal.SIGINT)}  # mpirun's exit codes upon these signals
STOPPED_EARLY = 5
TRIES = 4


def stopped(folder, arguments, ranks, way, wait):
    """Exit code, and seconds from the stop request to the program's last
    message and to the end of all processes; None without a message."""
    limit = ["--max-wall", wait] if way == "--max-wall" else []
    wish = time.monotonic() + wait  # the program's clock starts as soon as the job is read
    process = launch.start("run", "job.toml", *arguments, *limit, cwd=folder, ranks=ranks)
    begin = process.stderr.readline()  # "... cells to compute", or the last message if the time was already over
    if not limit:
        try:
            process.wait(timeout=wait)
        except subprocess.TimeoutExpired:
            process.send_signal(getattr(signal, way))
        wish = time.monotonic()
    word = None
    for line in itertools.chain([begin], process.stderr):
        if "stopped early" in line:
            word = time.monotonic() - wish
    process.communicate(timeout=launch.HANGING)
    return process.returncode, word, time.monotonic() - wish


def stopped_on_the_way(text, arguments, ranks, way):
    """The same for a run still at work: one that ended before is repeated with a shorter wait."""
    wait = LONGEST_WAIT if way == "--max-wall" else random.uniform(0, LONGEST_WAIT)
    for _ in range(TRIES):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            jobs.write(folder, text)
            code, word, end = stopped(folder, arguments, ranks, way, wait)
            map_contents.done_tiles(folder / "job.h5")  # the file can be read
        if code != 0:
            return code, word, end
        wait /= 4
    raise AssertionError(f"a run goes on to its end in spite of {way}")


def as_it_should_be(ranks, way, code, end):
    if ranks is None:
        return code == STOPPED_EARLY and end <= PROMPT
    return code in (STOPPED_EARLY, *OF_MPIRUN.get(way, ())) and end <= PROMPT_OF_MPIRUN


def main():
    random.seed(2026)
    bad = 0
    for ranks, way in WAYS:
        words, ends, codes, wrong = [], [], set(), 0
        for scene, (text, arguments) in SCENES.items():
            code, word, end = stopped_on_the_way(text, arguments, ranks, way)
            print(f"{way}, {ranks} ranks, {scene}: code {code}, last word {word}, end {end:.2f} s")
            words += [word] if word is not None else []
            ends.append(end)
            codes.add(code)
            wrong += not as_it_should_be(ranks, way, code, end)
        last_word = f"in {len(words)} the ranks say after {max(words):.2f} s at most how to go on; " if words else ""
        verdict = f"; **{wrong} not as it should be**" if wrong else ""
        parts.row(f"{way.replace('SIG', '')}, {'alone' if ranks is None else f'mpirun -n {ranks}'}", len(ends),
                  f"{last_word}ends within {max(ends):.2f} s; exit code {', '.join(map(str, sorted(codes)))}; the file "
                  f"can be read{verdict}")
        bad += wrong
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
