"""A finished file of any kind with one flipped byte is refused by `run` and by every picture."""

import importlib
import random
import shutil
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

import disk_faults
import jobs
import launch

pytestmark = pytest.mark.thorough

TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS / "postprocess"), str(TESTS.parent / "postprocess")]
sealing = importlib.import_module("sealing")
pictures = importlib.import_module("peterka.pictures")
PeterkaFileError = importlib.import_module("peterka.errors").PeterkaFileError


@pytest.fixture(scope="module", params=disk_faults.KINDS)
def finished(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    jobs.write(folder, disk_faults.KINDS[request.param])
    assert launch.run("run", "job.toml", "--quiet", cwd=folder).returncode == 0
    return folder / "job.h5"


@pytest.fixture
def copy(finished, tmp_path):
    shutil.copy(finished.with_name("job.toml"), tmp_path)
    return Path(shutil.copy(finished, tmp_path))


def refused(path):
    """Both by the program and by the readers."""
    run = launch.run("run", "job.toml", cwd=path.parent)
    if run.returncode != 3 or run.stdout != "" or "job.h5" not in run.stderr:
        return f"run ends with {run.returncode}: {run.stderr}"
    try:
        with pictures.open_file(path):
            return "the picture is drawn"
    except PeterkaFileError as reason:
        return "" if str(path) in str(reason) else str(reason)


def drawable(path):
    with pictures.open_file(path):
        return True


def numbers_outside_run(path):
    """(offset, bytes) of the contents of datasets outside /run, except the end marker, without which a file counts as unfinished."""
    found = []

    def collect(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("run/") and name != "summary/finished":
            offset = item.id.get_offset() if item.chunks is None else item.id.get_chunk_info(0).byte_offset
            used = item.size * item.dtype.itemsize if item.chunks is None else item.dtype.itemsize
            if used:
                found.append((name, offset, used))

    with h5py.File(path) as file:
        file.visititems(collect)
    return found


def test_the_sound_file_is_shown(copy):
    assert drawable(copy)
    assert launch.run("run", "job.toml", cwd=copy.parent).returncode == 0


def test_one_flipped_bit_in_any_dataset_is_found(copy):
    chance = random.Random(15)
    whole = copy.read_bytes()
    shown = {}
    for name, offset, used in numbers_outside_run(copy):
        spoilt = bytearray(whole)
        spoilt[offset + chance.randrange(used)] ^= 1 << chance.randrange(8)
        copy.write_bytes(spoilt)
        try:
            with pictures.open_file(copy):
                shown[name] = "drawn"
        except PeterkaFileError:
            pass
    assert shown == {}


def test_the_record_of_bytes_is_a_dataset_and_the_end_of_the_file(copy):
    with h5py.File(copy) as file:
        dataset = file["summary/bytes"]
        assert dataset.id.get_offset() + dataset.id.get_storage_size() == copy.stat().st_size
        assert dataset[()].startswith(b"peterka bytes 1, XXH3 ")


@pytest.mark.parametrize("attribute, value", [("natural_frequency_hz", 45.0), ("hammer_mass_kg", 2.98),
                                              ("title", "another"), ("job", "kind = 'map'")])
def test_a_changed_attribute_is_found(copy, attribute, value):
    with h5py.File(copy, "r+") as file:
        file.attrs[attribute] = value
    assert refused(copy) == ""


def test_a_changed_unit_is_found(copy):
    with h5py.File(copy, "r+") as file:
        name = next(name for name in sorted(file) if isinstance(file[name], h5py.Dataset))
        file[name].attrs["long_name"] = "something else"
    assert refused(copy) == ""


def test_something_added_is_found(copy):
    with h5py.File(copy, "r+") as file:
        file["summary/praise"] = np.int32(1)
    assert refused(copy) == ""


def test_what_differs_from_run_to_run_may_be_changed(copy):
    with h5py.File(copy, "r+") as file:
        file["run/ranks"][()] = 7
    assert drawable(copy)


def test_a_file_of_the_layout_before_says_what_it_lacks(copy):
    with h5py.File(copy, "r+") as file:
        file.attrs["peterka_layout"] = np.int32(1)
    sealing.renew_record(copy)
    assert refused(copy) == ""
    run = launch.run("run", "job.toml", cwd=copy.parent)
    assert "have no checksum over what lies outside their cells" in run.stderr


@pytest.mark.parametrize("name, value", [("hammer_mass_kg", 2.98), ("frequency_ratio", 0.6)])
def test_an_unfinished_map_with_another_frame_is_not_gone_on_with(tmp_path, name, value):
    """Finishing it would seal the error."""
    jobs.write(tmp_path, jobs.small_map())
    assert launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path).returncode == 5
    assert drawable(tmp_path / "job.h5")
    with h5py.File(tmp_path / "job.h5", "r+") as file:
        if name in file:
            file[name][0] = value
        else:
            file.attrs[name] = value
    assert refused(tmp_path / "job.h5") == ""
