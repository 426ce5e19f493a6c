"""Starts the program as a user would: alone or under mpirun, in a folder of its own."""

import os
import re
import subprocess
import time
from pathlib import Path

BINARY = Path(os.environ["PETERKA_BINARY"]).resolve()
MPIEXEC = os.environ.get("MPIEXEC", "mpirun")
DEALING_CHECK = BINARY.with_name("dealing_check")

MPI_SETTINGS = Path(__file__).parents[2] / "jobs" / "mpi_environment.sh"
HANGING = 300  # seconds after which a run is considered to hang


def environment():
    """The environment of a shell that has sourced jobs/mpi_environment.sh, as users do before mpirun."""
    shell = subprocess.run(["sh", "-c", '. "$0" && env -0', MPI_SETTINGS], capture_output=True, text=True, check=True)
    return dict(entry.split("=", 1) for entry in shell.stdout.split("\0") if entry)


# ob1 is what Open MPI chooses on one machine after it has started and left all others, which takes longer than a small job.
ENVIRONMENT = environment() | {"OMPI_MCA_pml": "ob1"}
# Without the daemon that Open MPI 4 starts beside a program not started by mpirun, which takes longer than a small job, too.
# All such have the same folder for their sockets, which one removes while another makes it: it is not made, as they need none.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_create_session_dirs": "0"}


def command(*arguments, ranks=None, binary=BINARY):
    launcher = [] if ranks is None else [MPIEXEC, "-n", str(ranks)]
    return [*launcher, str(binary), *map(str, arguments)]


def run(*arguments, cwd, ranks=None, binary=BINARY):
    """Runs to the end; returns returncode, stdout and stderr."""
    return subprocess.run(
        command(*arguments, ranks=ranks, binary=binary),
        cwd=cwd, env=ENVIRONMENT | (ALONE if ranks is None else {}), stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=HANGING,
    )


def start(*arguments, cwd, ranks=None):
    """Starts the process, as a user would, and returns it, with stdout and stderr as pipes."""
    return subprocess.Popen(
        command(*arguments, ranks=ranks),
        cwd=cwd, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )


def hands_on_last_words():
    """Whether mpirun forwards the ranks' output after it was told to end; Open MPI 5 does not."""
    version = subprocess.run([MPIEXEC, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return "Open MPI" not in version or re.search(r"Open MPI\) (\d+)", version)[1] == "4"


def computing(process):
    """Process ids of the program itself: all ranks, if started by mpirun."""
    found, ahead = [], [process.pid]
    while ahead:
        pid = ahead.pop()
        try:
            if os.readlink(f"/proc/{pid}/exe") == str(BINARY):
                found.append(pid)
            for thread in Path(f"/proc/{pid}/task").iterdir():  # Open MPI 5 starts ranks from one of mpirun's threads
                ahead += map(int, (thread / "children").read_text().split())
        except (FileNotFoundError, ProcessLookupError):
            pass  # it has ended in the meantime
    return sorted(found)


def told_megabytes(checked):
    """The memory per rank that `check` reported."""
    size, unit = re.search(r"memory +about ([\d.]+) (MB|GB) per rank", checked.stdout).groups()
    return float(size) * (1000 if unit == "GB" else 1)


def largest_resident_megabytes(process):
    """Peak memory of a process that runs the program, sampled until it ends."""
    most = 0.0
    while process.poll() is None:
        for pid in computing(process):
            try:
                status = Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
            except OSError:  # it has ended in the meantime
                continue
            most = max([most, *(1.024e-3 * int(size) for size in re.findall(r"VmHWM:\s+(\d+) kB", status))])
        time.sleep(0.005)
    return most


def messages(finished):
    """The program's own messages on stderr, without mpirun's."""
    return [line for line in finished.stderr.splitlines() if line.startswith("peterka: ")]
