"""The order of a run's system calls, checked as SQLite checks its own: whenever the power fails, synced data are on disk,
and the file is a complete old one or a complete new one.

Nothing is known about the rest: a name may exist or not, a byte may be written or not. Hence a file gets its name only after
its bytes are synced, and the name is synced, via the folder, before anything relies on it.
"""

import os

import pytest

import disk_faults
import jobs
import launch


def calls_of(folder, *arguments):
    """[(kind, path)] of a run of job.toml, in their order."""
    record = folder.parent / f"{folder.name}.calls"
    record.unlink(missing_ok=True)
    faults = {"FAULTY_PATH": "job.h5", "FAULTY_RECORD": str(record), "LD_PRELOAD": str(disk_faults.LIBRARY)}
    environment = launch.ENVIRONMENT | faults
    finished = disk_faults.subprocess.run(launch.command("run", "job.toml", "--quiet", *arguments), cwd=folder, env=environment,
                                          capture_output=True, text=True, timeout=launch.HANGING, check=False)
    assert finished.returncode == 0, finished.stderr
    lines = [line.split(" ", 1) for line in record.read_text().splitlines()]
    return [(call, path) for call, path in lines if call in ("write", "fsync", "rename", "unlink")]


def faults_in(calls, folder):
    """What a power failure could corrupt, in words."""
    found, unsynced, unnamed = [], set(), set()
    for call, path in calls:
        path = os.path.join(folder, path)
        if call == "write" and path.endswith(("/job.h5", "-creating")):
            unsynced.add(path)
        elif call == "fsync" and path.rstrip("/.") == str(folder):
            unnamed.clear()
        elif call == "fsync":
            unsynced.discard(path)
        elif call == "rename":
            if path in unsynced:
                found.append(f"{path} gets a name before its bytes are on the disk")
            unnamed.add(path)
        elif call == "unlink" and path.endswith("-previous") and (unnamed or unsynced):
            found.append(f"the file before is removed while {sorted(unnamed | unsynced)} may be lost")
    return found + [f"{path} is never waited for" for path in sorted(unnamed | unsynced)]


@pytest.fixture
def folder(tmp_path):
    """Its name contains that of the file by which calls are identified."""
    (tmp_path / "folder_of_job.h5").mkdir()
    return tmp_path / "folder_of_job.h5"


@pytest.mark.parametrize("kind", ["map", "curves", "trace", "study"])
def test_all_that_is_told_is_on_the_disk(kind, folder):
    jobs.write(folder, disk_faults.KINDS[kind])
    calls = calls_of(folder)
    assert [call for call, _ in calls].count("rename") == 1
    assert faults_in(calls, folder) == []


def test_a_map_that_is_replaced_stays_until_the_new_one_is_on_the_disk(folder):
    jobs.write(folder, disk_faults.KINDS["map"])
    calls_of(folder)
    calls = calls_of(folder, "--fresh")
    assert [call for call, _ in calls].count("rename") == 2
    assert faults_in(calls, folder) == []


def test_each_fault_of_the_order_is_seen(folder):
    """Checks the order itself, with one call omitted."""
    jobs.write(folder, disk_faults.KINDS["map"])
    calls_of(folder)
    calls = calls_of(folder, "--fresh")
    for number, (call, path) in enumerate(calls):
        if call == "fsync" and calls[number - 1][0] != "fsync":
            without = [one for at, one in enumerate(calls) if at < number or one[0] != "fsync"]
            assert faults_in(without, folder), path
