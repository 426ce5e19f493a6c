"""One allocation fails in a small run of each kind, as where memory has run out, and what must come of it.

Either the file is written all the same and is the right one, or the run says that memory ran out, and the next one makes the
right file out of what is left. Whose allocation it is decides how the run may end: one of the program's own ends it with 70
(3 where a file is at fault for it), in words; HDF5 and Open MPI may crash over one of theirs, and the file is right then, too.
"""

import re
import subprocess

import disk_faults
import launch
from right_file import RightFile

LIBRARY = launch.BINARY.with_name("faulty_memory.so")
KINDS = disk_faults.KINDS
OWNERS = ("program", "libhdf5", "libmpi", "libsundials")
SAID = re.compile(r"out of memory|memory allocation failed|memory runs? out|memory has run out|MPI_ERR|failed: no reason given|unable to|can't")
# What ends otherwise, and whose fault that is: toml++ 3.3 reads numbers by streams, which hide that memory ran out.
OF_TOML = "TOML syntax, floating-point"


def run(folder, owner, **faults):
    """With LIBRARY; `faults` are its settings AT and PLACES."""
    settings = {f"FAULTY_MEMORY_{name.upper()}": str(value) for name, value in faults.items()}
    environment = launch.ENVIRONMENT | settings | {"FAULTY_MEMORY_OF": owner}
    command = ["env", f"LD_PRELOAD={LIBRARY}", *launch.command("run", "job.toml", "--quiet")]
    return subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=launch.HANGING, check=False)


class Kind(RightFile):
    """What comes of an allocation that fails in a run of one kind."""

    def __init__(self, name, folder):
        super().__init__(folder, KINDS[name])
        self.name = name

    def places(self, owner):
        """[(number of the first allocation, of the last)] of each place, a stack of calls, that allocates in a whole run."""
        self.clear()
        report = self.folder / "places"
        report.write_text("")
        done = run(self.folder, owner, places=report)
        assert done.returncode == 0, done.stderr
        return sorted(tuple(map(int, line.split())) for line in report.read_text().splitlines())

    def fails(self, owner, number):
        """(how the run ended: "went on", "said so", "crashed"; what is wrong: "" where nothing is)."""
        self.clear()
        try:
            finished = run(self.folder, owner, at=number)
        except subprocess.TimeoutExpired:
            return "hung", f"{self.name}, {owner} {number}: hangs"
        ended, problem = self._end_of(finished, owner)
        if not problem and ended != "went on":
            problem = self.problem_of_next_run()
        problem = problem or self.problem_of_file(finished.returncode)
        return ended, problem and f"{self.name}, {owner} {number}: {problem}"

    @staticmethod
    def _end_of(finished, owner):
        if finished.returncode == 0:
            return "went on", ""
        told = launch.messages(finished)
        if finished.returncode in (3, 70) and len(told) == 1 and SAID.search(told[0]):
            return "said so", ""
        if finished.returncode == 2 and OF_TOML in finished.stderr:
            return "said otherwise", ""
        if owner in ("libhdf5", "libmpi") and not told:
            return "crashed", ""
        return "wrong", f"ends with {finished.returncode}: {finished.stderr[-300:]}"
