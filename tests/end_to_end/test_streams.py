"""Output may be lost: the result is safe, and exit code 3 and a message on stderr report it. A lost log does not affect the result."""

import os
import subprocess

import pytest

import jobs
import launch
import map_contents

KINDS = {
    "map": jobs.small_map(columns=8, rows=8),
    "basin": jobs.small_basin(points=8),
    "sweep": jobs.small_sweep(points=8),
    "trace": jobs.trace(2.0),
    "study": jobs.small_label_study(points=3),
    "curves": jobs.small_curves(points=8),
}
FULL = "exec >/dev/full; "
CLOSED = "exec >&-; "
ALL_CLOSED = "exec >&- <&- 2>&-; "


def run_in_shell(redirection, *arguments, cwd):
    """With all closed, as a user would: what MPI opens or starts might take their descriptors, too."""
    line = redirection + 'exec "$0" "$@"'
    return subprocess.run(["sh", "-c", line, *launch.command(*arguments)], cwd=cwd,
                          env=launch.ENVIRONMENT | ({} if redirection == ALL_CLOSED else launch.ALONE),
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=launch.HANGING)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("redirection", [FULL, CLOSED])
def test_a_summary_that_cannot_be_printed_is_told_and_the_file_is_whole(tmp_path, kind, redirection):
    jobs.write(tmp_path, KINDS[kind])
    finished = run_in_shell(redirection, "run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3, finished.stderr
    assert launch.messages(finished)[-1].startswith("peterka: standard output cannot be written: ")
    assert launch.messages(finished)[-1].endswith(". job.h5 is complete")
    again = launch.run("run", "job.toml", cwd=tmp_path)
    assert again.returncode == 0 and "nothing is computed" in again.stdout
    # the same holds for a complete file
    finished = run_in_shell(redirection, "run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3, finished.stderr


def test_under_mpirun_too(tmp_path):
    jobs.write(tmp_path, KINDS["map"])
    shell = ["sh", "-c", FULL + 'exec "$0" "$@"']
    finished = subprocess.run([launch.MPIEXEC, "-n", "2", *shell, *launch.command("run", "job.toml")],
                              cwd=tmp_path, env=launch.ENVIRONMENT, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=launch.HANGING)
    assert finished.returncode == 3, finished.stderr
    assert sum("standard output cannot be written" in line for line in finished.stderr.splitlines()) == 1


def test_what_is_printed_never_gets_into_the_map(tmp_path, small_map_file):
    """With stdout and stderr closed, the next file opened would take their descriptors."""
    jobs.write(tmp_path, jobs.small_map())
    finished = run_in_shell(ALL_CLOSED, "run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3
    map_contents.assert_same_map(tmp_path / "job.h5", small_map_file)


@pytest.mark.parametrize("kind", KINDS)
def test_a_quiet_run_prints_nothing_that_could_be_lost(tmp_path, kind):
    jobs.write(tmp_path, KINDS[kind])
    assert run_in_shell(ALL_CLOSED, "run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0


@pytest.mark.parametrize("kind", KINDS)
def test_a_log_that_nobody_reads_changes_nothing(tmp_path, kind):
    jobs.write(tmp_path, KINDS[kind])
    reads, writes = os.pipe()
    os.close(reads)
    stopped = subprocess.run(launch.command("run", "job.toml", "--max-wall", "1e-9"), cwd=tmp_path, env=launch.ENVIRONMENT | launch.ALONE,
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=writes, timeout=launch.HANGING)
    finished = subprocess.run(launch.command("run", "job.toml"), cwd=tmp_path, env=launch.ENVIRONMENT | launch.ALONE,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=writes, timeout=launch.HANGING)
    os.close(writes)
    assert (stopped.returncode, finished.returncode) == (5, 0)
