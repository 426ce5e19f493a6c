"""A single allocation fails in a small run of each kind, as if out of memory, and the required outcome.

Either the file is written nevertheless and is correct, or the run reports the failure in one line, and the next run produces
the correct file from what is left. The allocation's owner determines how the run may end: a failure of the program's own
ends it with 70 (3 if a file is at fault), with a message; HDF5, Open MPI and SUNDIALS may crash on one of theirs, and the
next file must be correct then, too.
"""

import re
import subprocess

import disk_faults
import launch
from right_file import RightFile

LIBRARY = launch.BINARY.with_name("faulty_memory.so")
KINDS = disk_faults.KINDS
OWNERS = ("program", "libhdf5", "libmpi", "libsundials")
SAID = re.compile(r"memory|MPI_ERR|failed: (no reason given|unable to|can't)")
# A library may hide the cause, and the message then blames the file; toml++ blames the job, because it reads numbers by
# streams, which hide an allocation failure.
OF_TOML = "TOML syntax, floating-point"


def run(folder, owner, **faults):
    """With LIBRARY; `faults` are its settings AT and PLACES."""
    settings = {f"FAULTY_MEMORY_{name.upper()}": str(value) for name, value in faults.items()}
    environment = launch.ENVIRONMENT | settings | {"FAULTY_MEMORY_OF": owner}
    command = ["env", f"LD_PRELOAD={LIBRARY}", *launch.command("run", "job.toml", "--quiet")]
    return subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=launch.HANGING, check=False)


class Kind(RightFile):
    """Outcomes of a failed allocation in a run of one kind."""

    def __init__(self, name, folder):
        super().__init__(folder, KINDS[name])
        self.name = name

    def places(self, owner):
        """[(number of the first allocation, of the last)] for each call stack that allocates in a whole run."""
        self.clear()
        report = self.folder / "places"
        report.write_text("")
        done = run(self.folder, owner, places=report)
        assert done.returncode == 0, done.stderr
        return sorted(tuple(map(int, line.split())) for line in report.read_text().splitlines())

    def fails(self, owner, number):
        """(how the run ended: "went on", "said so", "crashed"; the fault: "" if there is none)."""
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
        if finished.returncode in (3, 70) and len(told) == 1 and (owner != "program" or SAID.search(told[0])):
            return "said so", ""
        if finished.returncode == 2 and OF_TOML in finished.stderr:
            return "said otherwise", ""
        if owner != "program" and not told:
            return "crashed", ""
        return "wrong", f"ends with {finished.returncode}: {finished.stderr[-300:]}"
