"""A single system call fails in a small run of each kind, and the required outcome.

Either the file is written nevertheless and is correct, or the run ends with 3, names the file and the reason, and the next
run produces the correct file from what is left. Nothing else: no signal, no wrong file.
"""

import subprocess

import jobs
import launch
from right_file import MPI_FILES, NAME, RightFile

LIBRARY = launch.BINARY.with_name("faulty_io.so")
CALLS = ("write", "read", "fsync", "truncate", "allocate", "rename", "unlink")
HOWS = ("ENOSPC", "EIO", "EDQUOT", "EINTR", "short", "persistent ENOSPC", "persistent EIO")
CAUSES = ("No space left", "Input/output error", "Disk quota exceeded", "Interrupted system call", "cut short",
          "failed", "damaged", "checksum", "doesn't hold", "read twice", "can't be locked")

KINDS = {
    "map": jobs.small_map(18, 3) + "[audit]\ncells = 2\n",
    "map with starts": jobs.small_map(5, 3) + "[starts]\ncount = 4\nattractors = 2\n[output]\nfields = [\"critical_kick\"]\n",
    "map of uncertain rigs": jobs.small_map(5, 3) + "[uncertainty]\nrigs = 20\n[uncertainty.hammer]\nnatural_frequency_hz = { relative = 0.01 }\n",
    "basin": jobs.small_basin(5),
    "curves": jobs.small_curves(8),
    "curves with distances": jobs.small_curves(8) + "[curves]\nedge_distance = true\n",
    "sweep": jobs.small_sweep(3, "up", "[1.5]"),
    "sweep with starts": jobs.small_sweep(3, "both", "[1.5]") + "[starts]\ncount = 4\nattractors = 2\n",
    "trace": jobs.trace(2.0, settings="cycles = 2"),
    "study": jobs.small_label_study(2),
}


def run(folder, ranks=None, **faults):
    settings = {f"FAULTY_{name.upper()}": str(value) for name, value in faults.items()}
    environment = launch.ENVIRONMENT | settings | {"FAULTY_PATH": NAME}
    command = launch.command("run", "job.toml", "--quiet", ranks=ranks)
    command[-4:-4] = ["env", f"LD_PRELOAD={LIBRARY}"]
    return subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=launch.HANGING)


class Kind(RightFile):
    """The number of calls of each kind in a run, and the outcome if one fails."""

    def __init__(self, name, folder):
        super().__init__(folder, KINDS[name])
        self.name = name
        self.calls = {call: self.count(call) for call in CALLS}

    def begin_with_what_is_left_after(self, call, number, how):
        """Applies to each run from now on."""
        self.clear()
        assert run(self.folder, call=call, at=number, how=how).returncode == 3
        self.begun = (self.folder / NAME).read_bytes()

    def count(self, call, **where):
        self.clear()
        report = self.folder / "count"
        report.write_text("0")
        assert run(self.folder, call=call, count=report, **where).returncode == 0
        return int(report.read_text())

    def fails(self, call, number, how, **where):
        """The fault in the outcome; empty if it is as required. `where`: number of ranks, and the failing one."""
        self.clear()
        finished = run(self.folder, call=call, at=number, how=how, **where)
        problem = self._problem(finished, 0 if call != "unlink" else 2 if "persistent" in how else 1)
        return problem and f"{self.name}, {how} at {call} {number}: {problem}"

    def _problem(self, finished, may_stay):
        if finished.returncode not in (0, 3):
            return f"code {finished.returncode}: {finished.stderr[-300:]}"
        if finished.returncode == 3:
            told = launch.messages(finished)
            if len(told) != 1 or NAME not in told[0] or not any(cause in told[0] for cause in CAUSES):
                return f"says {finished.stderr[-300:]}"
            problem = self.problem_of_next_run()
            if problem:
                return f"{problem} (first: {told[0]})"
        problem = self.problem_of_file(finished.returncode)
        if problem:
            return problem
        left = self.left_beside()
        if len(left) <= may_stay and MPI_FILES.issuperset(left):
            return ""
        return f"leaves {left} behind" if left and finished.returncode == 0 else ""
