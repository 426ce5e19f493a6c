"""Full disks and vanishing files: the run reports where and why, and loses nothing that can be kept."""

import re
import resource
import subprocess

import h5py
import pytest

import jobs
import launch
import map_contents

RANKS = [None, 3]


@pytest.fixture
def small_disk(tmp_path):
    """Creates a file system of this size [KiB] in memory."""
    folder = tmp_path / "disk"

    def mounted(kibibytes):
        folder.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "none", folder],
                               capture_output=True, text=True)
        if mount.returncode != 0:
            pytest.skip(f"a small disk needs the right to mount one: {mount.stderr.strip()}")
        return folder

    yield mounted
    subprocess.run(["umount", folder], stderr=subprocess.DEVNULL)


def said(finished):
    """The program's message about the failure: one, which a second rank repeats that meets it before the first one's abort."""
    told = [line for line in launch.messages(finished) if "cells to compute" not in line]
    assert 1 <= len(told) <= RANKS[-1] and len(set(told)) == 1, finished.stderr
    return told[0]


@pytest.mark.parametrize("ranks", RANKS)
def test_a_disk_too_small_for_the_map(tmp_path, small_disk, ranks):
    jobs.write(tmp_path, jobs.medium_map())
    disk = small_disk(400)
    finished = launch.run("run", "job.toml", "--output", "disk/job.h5", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 3
    assert re.search(r"disk/job.h5: the file needs 6[12]\d\.\d kB ", said(finished))
    assert list(disk.iterdir()) == []


PAGE = 4096


def punch_a_hole(path):
    """Deallocates a page of the file's space for forces, as a copy-on-write file system may."""
    with h5py.File(path) as file:
        forces = file["peak_force_ratio"].id
        middle = forces.get_chunk_info(0).byte_offset + forces.get_storage_size() // 2
    hole = -(-middle // PAGE) * PAGE  # only whole pages can be deallocated
    subprocess.run(["fallocate", "--punch-hole", "-o", str(hole), "-l", str(PAGE), path], check=True)


@pytest.mark.parametrize("ranks", RANKS)
def test_a_disk_that_fills_up_on_the_way(tmp_path, small_disk, medium_map_file, ranks):
    jobs.write(tmp_path, jobs.medium_map())
    disk = small_disk(700)
    run = ["run", "job.toml", "--output", "disk/job.h5"]
    launch.run(*run, "--max-wall", "1e-9", cwd=tmp_path)
    punch_a_hole(disk / "job.h5")
    with open(disk / "ballast", "wb", buffering=0) as ballast, pytest.raises(OSError):
        while True:
            ballast.write(bytes(PAGE))
    finished = launch.run(*run, cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 3
    assert "disk/job.h5: pwrite failed" in said(finished) and "No space left on device" in said(finished)
    assert 0 < map_contents.done_tiles(disk / "job.h5") < map_contents.tile_count(disk / "job.h5")
    assert map_contents.wrong_tiles(disk / "job.h5", medium_map_file) == 0
    (disk / "ballast").unlink()
    assert launch.run(*run, cwd=tmp_path, ranks=ranks).returncode == 0
    map_contents.assert_same_map(disk / "job.h5", medium_map_file)


@pytest.mark.parametrize("ranks", RANKS)
def test_a_file_that_vanishes(tmp_path, ranks):
    jobs.write(tmp_path, jobs.larger_map())
    process = launch.start("run", "job.toml", cwd=tmp_path, ranks=ranks)
    process.stderr.readline()  # "... cells to compute"
    (tmp_path / "job.h5").unlink()
    output, errors = process.communicate(timeout=launch.HANGING)
    assert process.returncode == 3
    assert "job.h5: has vanished" in said(subprocess.CompletedProcess([], 3, output, errors))
    assert output == ""


def test_a_limit_of_file_sizes(tmp_path):
    """As set by batch systems; a signal would end the program without a message."""
    jobs.write(tmp_path, jobs.larger_map())
    process = launch.start("run", "job.toml", cwd=tmp_path)
    process.stderr.readline()  # MPI's own files exist by now
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (300_000, 300_000))
    output, errors = process.communicate(timeout=launch.HANGING)
    assert process.returncode == 3, errors
    assert "job.h5: pwrite failed" in errors and "File too large" in errors


@pytest.mark.parametrize("kind", ["trace", "study"])
def test_a_limit_that_a_file_written_at_once_exceeds(tmp_path, kind):
    """HDF5 could not close it, and the program ended with a signal after its message."""
    jobs.write(tmp_path, jobs.trace(2.0, settings="cycles = 100") if kind == "trace" else jobs.small_label_study(2))
    kibibytes = 300 if kind == "trace" else 10
    finished = subprocess.run(["bash", "-c", 'ulimit -f "$0"; exec "$@"', str(kibibytes), *launch.command("run", "job.toml")],
                              cwd=tmp_path, env=launch.ENVIRONMENT | {"OMPI_MCA_btl": "self"}, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=launch.HANGING)
    assert finished.returncode == 3, finished.stderr
    assert "job.h5.peterka-creating: write failed: File too large" in finished.stderr
    left = {path.name for path in tmp_path.iterdir()}
    assert left <= {"job.toml", "job.h5.peterka-lock"}  # a remaining lock file blocks nobody
