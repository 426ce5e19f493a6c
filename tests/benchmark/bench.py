"""The programs run by a benchmark, and the cost of a map: its time, and the memory of its largest rank."""

import argparse
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

from peterka.scaling.run_record import read_record  # noqa: E402

JOB = "jobs/peterka_170mm.toml"


@dataclass(frozen=True)
class Run:
    """A map computed once."""

    wall: float  # s, of the whole command
    solving: float  # s, without start-up and finalisation
    memory: float  # MB, resident, of the largest rank
    file: Path


class Bench:
    def __init__(self, build, results):
        self.build, self.results = build, results
        self.cycle_rows = []  # of batch_cycles: (name, µs, error)
        self.refined_over_full = self.refined_file = None  # of the refined map
        results.mkdir(parents=True, exist_ok=True)

    def output(self, *command):
        """The output of a command, which must succeed."""
        done = subprocess.run(list(map(str, command)), cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"measure.py: {' '.join(map(str, command))} failed with code {done.returncode}")
        return done.stdout

    def file_of(self, points, ranks, name=""):
        return self.results / f"benchmark_{points}_on_{ranks}{name}.h5"

    def map(self, points, ranks, name="", settings=()):
        """Computes the paper's plane with this many points per side, without an audit; returns a Run."""
        file = self.file_of(points, ranks, name)
        command = ["mpirun", "-n", ranks, self.build / "peterka", "run", JOB, "--output", file, "--fresh", "--quiet",
                   "--set", f"axes.frequency_ratio.points={points}", "--set", f"axes.gap_ratio.points={points}",
                   "--set", "audit.cells=0", *(word for setting in settings for word in ("--set", setting))]
        start = time.monotonic()
        process = subprocess.Popen(list(map(str, command)), cwd=ROOT, stdin=subprocess.DEVNULL)
        resident = 0.0
        while process.poll() is None:
            resident = max(resident, resident_memory(self.build / "peterka", file))
            time.sleep(0.05)
        wall = time.monotonic() - start
        if process.returncode != 0:
            sys.exit(f"measure.py: the map of {points} x {points} cells on {ranks} ranks failed")
        run = Run(wall, read_record(file).seconds, resident, file)
        tell(f"  {points} x {points} on {ranks}: {wall:.2f} s, solving {run.solving:.2f} s, {run.memory:.0f} MB")
        return run

    def in_turn(self, points, all_ranks, rounds):
        """{ranks: [Run of each round]} for these numbers of ranks."""
        runs = {ranks: [] for ranks in all_ranks}
        for _ in range(rounds):
            for ranks in all_ranks:
                runs[ranks].append(self.map(points, ranks))
        return runs


def resident_memory(program, file):
    """Largest memory [MB] so far of any running process for this file; 0 without one."""
    most = 0.0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_text(encoding="utf-8").split("\0")
            if words[0] == str(program) and str(file) in words:
                status = (folder / "status").read_text(encoding="utf-8")
                most = max(most, *(int(line.split()[1]) / 1024 for line in status.splitlines() if "VmHWM" in line), 0.0)
        except OSError:  # it has ended in the meantime
            continue
    return most


def markdown(head, rows):
    return "\n".join("| " + " | ".join(line) + " |" for line in [head, ["---"] * len(head), *rows])


def page_arguments(description):
    """--build, --results, --page and --quick of a benchmark that writes a page of its own; its folders exist then."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--results", type=Path, required=True)
    parser.add_argument("--page", type=Path, required=True)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    for folder in (arguments.page.parent, arguments.results):
        folder.mkdir(parents=True, exist_ok=True)
    return arguments


def tell(line):
    print(line, file=sys.stderr, flush=True)
