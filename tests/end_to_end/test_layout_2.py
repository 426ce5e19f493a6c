"""tests/data/layout_2.h5, a map with [starts] written before layout 3, is shown and traced; no run resumes it."""

import importlib
import shutil
import sys
from pathlib import Path

import h5py
import pytest

import jobs
import launch

sys.path.insert(0, str(Path(__file__).parents[2] / "postprocess"))
pictures = importlib.import_module("peterka.pictures")

DATA = Path(__file__).parents[1] / "data"


@pytest.fixture
def old(tmp_path):
    shutil.copy(DATA / "layout_2.toml", tmp_path / "layout_2.toml")
    shutil.copy(DATA / "layout_2.h5", tmp_path / "layout_2.h5")
    return tmp_path / "layout_2.h5"


def test_the_file_is_of_layout_2(old):
    with h5py.File(old) as file:
        assert file.attrs["peterka_layout"] == 2
        assert "attractor_status" not in file and "critical_kick" in file


def test_it_is_shown_and_its_kicks_are_of_another_kind(old):
    with pictures.open_file(old) as file:
        names = pictures.pictures_of(file)
        assert "attractors" in names and "map" in names and "kick" not in names


def test_a_trace_follows_a_cell_of_it(old):
    jobs.write(old.parent, jobs.trace_of(old, "row = 0\ncolumn = 1"))
    traced = launch.run("run", "job.toml", cwd=old.parent)
    assert traced.returncode == 0, traced.stderr
    assert "agrees in regime and z" in traced.stdout


def test_a_run_leaves_it_alone_and_says_why(old):
    before = old.read_bytes()
    run = launch.run("run", "layout_2.toml", cwd=old.parent)
    assert run.returncode == 3 and "has layout version 2, this program writes version 3" in run.stderr
    assert "don't say of each label whether rounding may decide it" in run.stderr
    assert old.read_bytes() == before


def test_it_is_computed_again_only_when_told_to(old):
    fresh = launch.run("run", "layout_2.toml", "--fresh", cwd=old.parent)
    assert fresh.returncode == 0, fresh.stderr
    with h5py.File(old) as file:
        assert file.attrs["peterka_layout"] == 3


def with_a_heap_that_crashes_hdf5(path):
    """The size of the first text in the global heap, which has no checksum, nor has a file of this layout one of ours."""
    content = bytearray(path.read_bytes())
    content[content.index(b"GCOL") + 25] ^= 0xFF
    path.write_bytes(content)


def test_hdf5_breaks_down_over_a_damaged_one_in_a_process_of_its_own(old):
    """HDF5 1.10 does. 1.14 continues with invalid texts: then kind, seal or version is refused."""
    breaks_down = h5py.version.hdf5_version_tuple < (1, 14)
    with_a_heap_that_crashes_hdf5(old)
    reason = "HDF5 breaks down over it" if breaks_down else "is of kind None"
    with pytest.raises(importlib.import_module("peterka.errors").PeterkaFileError, match=reason):
        pictures.open_file(old)
    jobs.write(old.parent, jobs.trace_of(old, "row = 0\ncolumn = 1"))
    for job, code, otherwise in (("job.toml", 2, "is damaged: something outside its cells"), ("layout_2.toml", 3, "has layout version 2")):
        run = launch.run("run", job, cwd=old.parent)
        reason = "is damaged: HDF5 breaks down over it" if breaks_down else otherwise
        assert run.returncode == code and reason in run.stderr, run.stderr


def test_one_that_another_program_has_written_anew_is_read(old, small_map_file):
    """Its byte record is no longer at its end; the seal shows that nothing was lost."""
    copy = old.with_name("copy.h5")
    shutil.copy(small_map_file, copy)
    with h5py.File(copy, "r+") as file:
        file.create_group("run/of_another_program")
        file["run/of_another_program/numbers"] = list(range(1000))
    with pictures.open_file(copy) as file:
        assert file.kind == "map"


def test_a_job_with_a_key_of_a_later_program_is_told_from_damage(old, small_map_file):
    copy = old.with_name("later.h5")
    shutil.copy(small_map_file, copy)
    with h5py.File(copy, "r+") as file:
        file.create_group("run/of_another_program")
        file["run/of_another_program/numbers"] = list(range(1000))
        job = file.attrs["job"]
        text = job.decode() if isinstance(job, bytes) else str(job)
        file.attrs["job"] = text.replace("[limits]\n", "[limits]\nkey_of_tomorrow = 1\n")
    jobs.write(old.parent, jobs.trace_of(copy, "row = 0\ncolumn = 1"))
    traced = launch.run("run", "job.toml", cwd=old.parent)
    assert traced.returncode == 2 and "holds a job that this version can't read" in traced.stderr, traced.stderr
