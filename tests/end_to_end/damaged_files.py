"""Finished files of every kind with damaged bytes, and the programs' reaction: a sound file or a refusal, never a signal, a
hang, excessive memory, or wrong contents shown as sound.

Python programs run in children of one process that has loaded everything; `run` is started each time.
"""

import contextlib
import functools
import importlib
import io
import os
import random
import re
import resource
import signal
import subprocess
import sys
import traceback
from dataclasses import dataclass
from pathlib import Path

import jobs
import launch

POSTPROCESS = Path(__file__).parents[2] / "postprocess"
sys.path.insert(0, str(POSTPROCESS))
peterka = importlib.import_module("peterka")
PeterkaFileError = importlib.import_module("peterka.errors").PeterkaFileError
raw_bytes = importlib.import_module("peterka.files.raw_bytes")

SECTOR = 512
SECONDS = 10  # of CPU time, after which a reader is considered to hang
PATIENCE = 300  # the same in wall time: the machine may be busy
PROGRAMS = ("draw", "explore")
LARGEST = 2**30  # bytes of memory
OF_RUN = re.compile(r"[Tt]his run:|on the clocks of all ranks together")  # words that depend on /run
REFUSED, SAME, OTHER, TRACEBACK, WORDS = range(5)  # exit codes of a child

KINDS = {
    "map": jobs.small_map(18, 3) + "[audit]\ncells = 2\n",
    "map with starts": jobs.small_map(5, 3) + "[starts]\ncount = 4\nattractors = 2\n[output]\nfields = [\"critical_kick\"]\n",
    "map of uncertain rigs": jobs.small_map(5, 3) + "[uncertainty]\nrigs = 20\n[uncertainty.hammer]\nnatural_frequency_hz = { relative = 0.01 }\n",
    "refined map": jobs.small_map(17, 9) + "[refine]\nlevels = 2\n",
    "basin": jobs.small_basin(5),
    "sweep": jobs.small_sweep(3, "up", "[1.5]"),
    "trace": jobs.trace(2.0, settings="cycles = 2"),
    "curves": jobs.small_curves(8),
    "study": jobs.small_label_study(2),
}


@dataclass(frozen=True)
class Damage:
    """The change made to a file, in words, and the resulting bytes."""

    what: str
    content: bytes


def make(folder: Path, kind: str) -> Path:
    """A sound file, and its job beside it."""
    jobs.write(folder, KINDS[kind])
    made = launch.run("run", "job.toml", "--quiet", cwd=folder)
    assert made.returncode == 0, made.stderr
    return folder / "job.h5"


def outside_numbers(content: bytes) -> list[int]:
    """Offsets of all bytes covered by the checksum of the file's raw bytes: headers, sizes, texts."""
    numbers = [int(word) for word in content[-4096:].rstrip(b"\0").split()[5:]]
    places, at = [], 0
    for begin, end in zip(numbers[::2], numbers[1::2]):
        places += range(at, begin)
        at = end
    return places


def damages(content: bytes, count: int, chance: random.Random):
    """This many damages: a third single bits anywhere, a third single bits outside the numbers, the rest sectors and ends."""
    outside = outside_numbers(content) or list(range(len(content) - 4096))
    sectors = range(0, len(content), SECTOR)
    turns = [lambda: flipped(content, chance.randrange(len(content)), chance), lambda: flipped(content, chance.choice(outside), chance),
             lambda: of_sectors(content, chance.choice(sectors), chance.choice(sectors), chance)]
    cuts = list(sectors) if count > 4 * len(sectors) else chance.sample(sectors, min(count // 4, len(sectors)))
    for end in cuts:
        yield Damage(f"cut short at {end}", content[:end])
    for number in range(count - len(cuts)):
        yield turns[number % 3]()


def flipped(content, place, chance):
    bit = chance.randrange(8)
    spoilt = bytearray(content)
    spoilt[place] ^= 1 << bit
    return Damage(f"bit {bit} of byte {place} flipped", bytes(spoilt))


def of_sectors(content, one, other, chance):
    """Zeroed, overwritten by another sector, or swapped with it."""
    spoilt = bytearray(content)
    first, second = content[one:one + SECTOR], content[other:other + SECTOR]
    size = min(len(first), len(second))
    how = chance.choice(("zeroed", "repeated", "swapped"))
    if how == "zeroed":
        spoilt[one:one + len(first)] = bytes(len(first))
        return Damage(f"sector at {one} zeroed", bytes(spoilt))
    spoilt[one:one + size] = second[:size]
    if how == "swapped":
        spoilt[other:other + size] = first[:size]
    return Damage(f"sector at {one} {how} with that at {other}", bytes(spoilt))


def contents_of(path: Path) -> dict:
    """Everything that peterka.open returns except /run."""
    with peterka.open(path) as data:
        told = {str(name): (str(variable.dims), str(variable.attrs), str(variable.dtype), variable.values.tobytes())
                for name, variable in data.variables.items() if not str(name).startswith("run/")}
        return told | {"attributes": str(data.attrs)}


class Readers:
    """The readers of files of one kind; `sound` is the expected contents."""

    def __init__(self, folder: Path, kind: str) -> None:
        self.folder, self.kind = folder, kind
        self.sound = contents_of(make(folder, kind))
        self.content = (folder / "job.h5").read_bytes()
        self.said = self._run().stdout
        for name in PROGRAMS:
            importlib.import_module(name)

    def by_python(self, damage: Damage) -> tuple[str, str]:
        """(outcome, fault: "" if there is none)."""
        path = self.folder / "damaged.h5"
        path.write_bytes(damage.content)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        child = os.fork()
        if child == 0:
            os._exit(self._read(path))
        _, status, used = os.wait4(child, 0)
        grown = 1024 * (used.ru_maxrss - before)
        if os.WIFSIGNALED(status):
            ended = os.WTERMSIG(status)
            return "wrong", "hangs" if ended in (signal.SIGALRM, signal.SIGXCPU, signal.SIGKILL) else f"signal {ended}"
        if grown > LARGEST:
            return "wrong", f"takes {grown} bytes"
        told = {REFUSED: "", SAME: "", OTHER: "shown as sound", TRACEBACK: "traceback", WORDS: "more or less than a line"}
        code = os.WEXITSTATUS(status)
        return {REFUSED: "refused", SAME: "unread"}.get(code, "wrong"), told.get(code, f"exit code {code}")

    def by_run(self, damage: Damage) -> tuple[str, str]:
        """The same for the program."""
        (self.folder / "job.h5").write_bytes(damage.content)
        try:
            done = self._run()
        except subprocess.TimeoutExpired:
            return "wrong", "run hangs"
        if done.returncode == 0 and done.stdout == self.said:
            return "unread", ""
        if done.returncode == 3 and len(launch.messages(done)) == 1 and not done.stdout:
            return "refused", ""
        return "wrong", f"run ends with {done.returncode}: {done.stdout[:100]} {done.stderr[-300:]}"

    def _run(self):
        done = subprocess.run(launch.command("run", "job.toml"), cwd=self.folder, env=launch.ENVIRONMENT | launch.ALONE, timeout=PATIENCE,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        done.stdout = "\n".join(line for line in done.stdout.splitlines() if not OF_RUN.search(line))
        return done

    def _read(self, path):
        """Runs in the child, which no exception may leave."""
        signal.alarm(PATIENCE)
        used = int(sum(resource.getrusage(resource.RUSAGE_SELF)[:2]))
        resource.setrlimit(resource.RLIMIT_CPU, (used + SECONDS, used + SECONDS))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        os.chdir(self.folder)
        # each reader asks for a trial of the same bytes, which starts a Python: one answers all three
        raw_bytes._fault_in_trial = functools.cache(raw_bytes._fault_in_trial)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                return self._read_by_all(path)
        except BaseException:  # any exception is a fault
            traceback.print_exc(limit=-3)
            return TRACEBACK

    def _read_by_all(self, path):
        """A file refused by one reader must be refused by all; equal numbers give equal pictures."""
        with contextlib.suppress(PeterkaFileError):
            return SAME if contents_of(path) == self.sound else OTHER
        for name in PROGRAMS:
            errors = io.StringIO()
            if _call(name, path, errors) != 2 or errors.getvalue().count("\n") != 1:
                return WORDS
        return REFUSED


def _call(name, path, errors):
    sys.argv = [f"{name}.py", str(path)]
    sys.argv += ["--output-dir", "out", "--formats", "png"] if name == "draw" else ["--output", "page.html"]
    try:
        with contextlib.redirect_stderr(errors):
            return sys.modules[name].main()
    except SystemExit as stop:
        return stop.code
