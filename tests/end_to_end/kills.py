"""Runs killed by SIGKILL at random times, repeatedly on the same file, and the state they leave."""

import os
import select
import signal
import subprocess
from collections import Counter
from dataclasses import dataclass, field

import launch
import map_contents

RANKS = [1, 2, 3, 4, 7]
VICTIMS = ["one rank", "all ranks", "mpirun", "mpirun and all ranks"]
LONGEST_WAIT = 0.8  # seconds from the start, or from the first cell, to the kill


@dataclass
class Toll:
    """Outcome of the kills; the last three must stay 0."""

    kills: Counter = field(default_factory=Counter)  # by victim
    maps: int = 0  # completed
    before_the_file: int = 0  # kills before there was a file
    half_done: int = 0  # kills while some tiles were done and some not
    unreadable: int = 0
    wrong_tiles: int = 0  # marked as done with wrong contents
    different_maps: int = 0

    @property
    def harm(self):
        return self.unreadable + self.wrong_tiles + self.different_maps


def kill(process, victim, random):
    ranks = launch.computing(process)
    victims = {
        "one rank": random.sample(ranks, min(1, len(ranks))),
        "all ranks": ranks,
        "mpirun": [process.pid],
        "mpirun and all ranks": [process.pid, *ranks],
    }[victim]
    watched = [os.pidfd_open(pid) for pid in ranks]
    for pid in victims:
        os.kill(pid, signal.SIGKILL)
    process.communicate(timeout=launch.HANGING)
    for descriptor in watched:  # ranks must not outlive mpirun for long
        assert select.select([descriptor], [], [], launch.HANGING)[0], "a rank goes on after the end of mpirun"
        os.close(descriptor)
    return bool(victims)


def run_and_kill(folder, ranks, victim, random, longest=LONGEST_WAIT):
    """Whether a process could be killed before the run ended by itself; `longest`: wait from the first cell."""
    process = launch.start("run", "job.toml", cwd=folder, ranks=ranks)
    wait = LONGEST_WAIT
    if random.random() < 0.7:
        process.stderr.readline()  # "... cells to compute"
        wait = longest
    try:
        process.communicate(timeout=random.uniform(0, wait))
        return False
    except subprocess.TimeoutExpired:
        try:
            return kill(process, victim, random)
        except ProcessLookupError:
            process.communicate(timeout=launch.HANGING)
            return False


def look(file, whole, toll):
    if not file.exists():
        toll.before_the_file += 1
        return
    try:
        toll.half_done += 0 < map_contents.done_tiles(file) < map_contents.tile_count(file)
        toll.wrong_tiles += map_contents.wrong_tiles(file, whole)
    except OSError:
        toll.unreadable += 1


def finish(folder, whole, toll):
    finished = launch.run("run", "job.toml", "--quiet", cwd=folder, ranks=2)
    assert finished.returncode == 0, finished.stderr
    toll.maps += 1
    toll.different_maps += map_contents.datasets(folder / "job.h5") != map_contents.datasets(whole)
    (folder / "job.h5").unlink()


def campaign(folder, whole, kills, random, longest=LONGEST_WAIT):
    """Kills this many runs of the folder's job; `whole` is its map from an uninterrupted run. The shorter the `longest` wait, the fewer
    runs come to their end before they are killed."""
    toll = Toll()
    ranks = None
    while toll.kills.total() < kills:
        ranks = random.choice([number for number in RANKS if number != ranks])
        victim = random.choice(VICTIMS)
        if run_and_kill(folder, ranks, victim, random, longest):
            toll.kills[victim] += 1
            look(folder / "job.h5", whole, toll)
        else:
            finish(folder, whole, toll)
    finish(folder, whole, toll)
    assert toll.half_done > 0, toll  # otherwise nothing was tested
    return toll
