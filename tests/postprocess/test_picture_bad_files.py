"""Files that cannot be drawn: exit code 2, one clear line, no picture, whatever untrusted contents they have."""

import os
import struct
import subprocess
import sys

import h5py
import numpy as np
import pytest
from conftest import POSTPROCESS
from picture_samples import write_basin, write_map
from sealing import SealedFile, renew_record

pytestmark = pytest.mark.thorough


def replaced(path, name, values):
    with SealedFile(path, "r+") as file:
        del file[name]
        file[name] = values
    return path


def with_attribute(path, name, value):
    with SealedFile(path, "r+") as file:
        file.attrs[name] = value
    return path


def with_text(path, content):
    path.write_bytes(content)
    return path


def without(path, name):
    with SealedFile(path, "r+") as file:
        del file[name]
    return path


def cut_short(path):
    path.write_bytes(path.read_bytes()[:-3000])
    return path


def link_outside(path):
    other = write_map(path.with_name("other.h5"))
    with SealedFile(path, "r+") as file:
        del file["regime"]
        file["regime"] = h5py.ExternalLink(other.name, "/regime")
    return path


def stored_outside(path):
    raw = with_text(path.with_name("raw"), bytes(16))
    with SealedFile(path, "r+") as file:
        del file["regime"]
        file.create_dataset("regime", (4, 4), "i1", external=[(str(raw), 0, 16)])
    return path


def huge_chunk(path):
    with SealedFile(path, "w") as file:
        file.attrs.update(peterka_layout=np.int32(3), peterka_kind="map")
        for name in ("gap_ratio", "frequency_ratio"):
            file[name] = np.arange(1.0, 40001)
        for name, kind in (("regime", "i1"), ("impacts", "i4"), ("period", "i4"), ("peak_force_ratio", "f8")):
            file.create_dataset(name, (40000, 40000), kind, chunks=(20000, 20000), compression="gzip")
    return path


def huge_plane(path):
    """A small file that claims to have 65536 x 65536 cells."""
    with SealedFile(path, "w") as file:
        file.attrs.update(peterka_layout=np.int32(3), peterka_kind="map")
        for name in ("gap_ratio", "frequency_ratio"):
            file[name] = np.arange(1.0, 65537)
        for name, kind in (("regime", "i1"), ("impacts", "i4"), ("period", "i4"), ("peak_force_ratio", "f8")):
            file.create_dataset(name, (65536, 65536), kind, chunks=(16, 16))
    return path


def huge_text(path):
    """A text of 2 GB that was never written, and that only readers of texts would access."""
    with SealedFile(path, "r+") as file:
        file.create_dataset("summary/omitted_for_long", (), "S2147483647")
    return path


def long_attribute(path):
    """A title with a claimed length of 4 GB: HDF5 allocates that much unchecked."""
    content = bytearray(path.read_bytes())
    at = content.index(struct.pack("<IQ", len("Sample"), content.index(b"GCOL")))
    content[at : at + 4] = struct.pack("<I", 0xFFFFFFF0)
    path.write_bytes(content)
    return path


def one_storage_twice(path):
    """Two datasets sharing one storage: their addresses in the file are made equal."""
    with h5py.File(path) as file:
        of = {name: file[name].id.get_offset().to_bytes(8, "little") for name in ("impacts", "period")}
    content = path.read_bytes()
    assert content.count(of["period"]) == 1
    path.write_bytes(content.replace(of["period"], of["impacts"]))
    renew_record(path)
    return path


def two_names(path):
    with SealedFile(path, "r+") as file:
        del file["period"]
        file["period"] = file["impacts"]
    return path


def virtual(path):
    with SealedFile(path, "r+") as file:
        layout = h5py.VirtualLayout((4, 4), "i1")
        layout[:] = h5py.VirtualSource("other.h5", "regime", shape=(4, 4))
        del file["regime"]
        file.create_virtual_dataset("regime", layout)
    return path


def flipped(path):
    with h5py.File(path) as file:
        at = file["peak_force_ratio"].id.get_offset() + 5
    content = bytearray(path.read_bytes())
    content[at] ^= 1
    path.write_bytes(content)
    return path


def huge_axis(path):
    with SealedFile(path, "r+") as file:
        del file["gap_ratio"]
        file.create_dataset("gap_ratio", (2**40,), "f8", chunks=(1024,))
    return path


def directory(path):
    path.mkdir()
    return path


def pipe(path):
    os.mkfifo(path)
    return path


def unnamed_coordinate(path):
    """Scales attached to it still refer to it."""
    with h5py.File(path, "r+") as file:
        del file["attractors/attractor"]
    renew_record(path)
    return path


def plain_hdf5(path):
    with SealedFile(path, "w") as file:
        file["regime"] = np.zeros((4, 4), dtype="i1")
    return path


def group_instead(path):
    without(write_map(path), "regime")
    with SealedFile(path, "r+") as file:
        file.create_group("regime")
    return path


CASES = {
    "missing": (lambda p: p, "does not exist"),
    "directory": (directory, "is a directory"),
    "pipe": (pipe, "not a regular file"),
    "rubbish": (lambda p: with_text(p, bytes(range(256)) * 40), "not an HDF5 file"),
    "empty": (lambda p: with_text(p, b""), "not an HDF5 file"),
    "text": (lambda p: with_text(p, b"schema = 1\n"), "not an HDF5 file"),
    "cut short": (lambda p: cut_short(write_map(p)), "is cut short"),
    "not ours": (plain_hdf5, "not a peterka file (no attribute peterka_layout)"),
    "newer layout": (lambda p: with_attribute(write_map(p), "peterka_layout", np.int32(4)), "layout version 4;"),
    "older layout": (lambda p: with_attribute(write_map(p), "peterka_layout", np.int32(1)),
                     "layout version 1, which has no checksum over what lies outside its cells"),
    "layout is text": (lambda p: with_attribute(write_map(p), "peterka_layout", "1"), "layout version '1'"),
    "other kind": (lambda p: with_attribute(write_map(p), "peterka_kind", "chart"), "kind 'chart'"),
    "kind is a list": (lambda p: with_attribute(write_map(p), "peterka_kind", [1, 2]), "kind None"),
    "no regime": (lambda p: without(write_map(p), "regime"), "no dataset regime"),
    "regime is a group": (group_instead, "no dataset regime"),
    "wrong shape": (lambda p: replaced(write_map(p), "impacts", np.zeros((4, 5), "i4")), "impacts of shape (4, 5)"),
    "wrong type": (lambda p: replaced(write_map(p), "regime", np.zeros((4, 4))), "regime of type float64"),
    "text force": (lambda p: replaced(write_map(p), "peak_force_ratio", np.full((4, 4), b"x")), "of type |S1"),
    "unknown regime": (lambda p: replaced(write_map(p), "regime", np.full((4, 4), 17, "i1")), "unknown regime 17"),
    "period 0": (lambda p: replaced(write_map(p), "period", np.zeros((4, 4), "i4")), "period is below 1"),
    "axis descends": (lambda p: replaced(write_map(p), "gap_ratio", [3.0, 2.0, 1.0, 0.0]), "does not ascend"),
    "axis with NaN": (lambda p: replaced(write_map(p), "gap_ratio", [0, 1, np.nan, 3]), "gap_ratio that does not"),
    "axis of one point": (lambda p: replaced(write_map(p), "gap_ratio", [1.0]), "instead of (1, "),
    "axis in two dimensions": (lambda p: replaced(write_map(p), "gap_ratio", np.ones((4, 4))), "shape (4, 4)"),
    "huge axis": (lambda p: huge_axis(write_map(p)), "too short for what it says of gap_ratio"),
    "huge plane": (huge_plane, "too short for what it says of"),
    "huge text": (lambda p: huge_text(write_map(p)), "too short for what it says of summary/omitted_for_long"),
    "long attribute": (lambda p: long_attribute(write_map(p)), "is damaged"),
    "one storage twice": (lambda p: one_storage_twice(write_map(p)), " lies"),
    "two names for one object": (lambda p: two_names(write_map(p)), "two names for one object"),
    "virtual dataset": (lambda p: virtual(write_map(p)), "keeps regime in another file"),
    "flipped bit": (lambda p: flipped(write_map(p)), "not what was written (wrong checksum)"),
    "huge chunk": (huge_chunk, "in a way that no file of peterka has"),
    "link to another file": (lambda p: link_outside(write_map(p)), "no dataset regime"),
    "data in another file": (lambda p: stored_outside(write_map(p)), "keeps regime in another file"),
    "no attractor table": (lambda p: without(write_basin(p), "attractors"), "no dataset attractors/count"),
    "coordinate without a name": (lambda p: unnamed_coordinate(write_basin(p)), "a coordinate that is in none of its groups"),
    "attractor not in the table": (lambda p: replaced(write_basin(p), "attractor", np.full((4, 4), 3)), "an attractor"),
    "too many attractors": (lambda p: replaced(write_basin(p), "attractors/count", np.int32(257)), "257 attractors"),
    "fewer than no attractors": (lambda p: replaced(write_basin(p), "attractors/count", np.int32(-1)), "-1 attractors"),
}


@pytest.mark.parametrize("make", [huge_plane, lambda p: huge_text(write_map(p)), lambda p: long_attribute(write_map(p))],
                         ids=["huge plane", "huge text", "long attribute"])
def test_a_small_file_takes_little_memory(make, tmp_path):
    path = make(tmp_path / "bad.h5")
    code = "import resource, sys; import draw; code = draw.main(); " \
           "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss); sys.exit(code)"
    drawn = subprocess.run([sys.executable, "-c", code, str(path), "--output-dir", str(tmp_path / "out")], cwd=POSTPROCESS,
                           capture_output=True, text=True, check=False)
    assert drawn.returncode == 2, drawn.stderr
    assert int(drawn.stdout.split()[-1]) < 600_000  # KiB, with matplotlib


@pytest.mark.parametrize("case", CASES)
def test_a_bad_file_is_refused_in_one_line(case, tmp_path, draw):
    make, reason = CASES[case]
    path = make(tmp_path / "bad.h5")
    outcome = draw(path)
    assert outcome.code == 2
    assert outcome.stderr.startswith(f"draw.py: {path} ") and reason in outcome.stderr
    assert outcome.stderr.count("\n") == 1 and "Traceback" not in outcome.stderr
    assert outcome.pictures == []


def test_the_good_files_are_still_drawn(tmp_path, draw):
    outcome = draw(tmp_path / "missing.h5", write_map(tmp_path / "good.h5"), "--formats", "png")
    assert outcome.code == 2
    assert outcome.pictures == ["good_force_1_1.png", "good_force_all.png", "good_map.png"]


@pytest.mark.parametrize("place", ["name", "attribute"])
def test_names_that_are_no_text_are_told(place, tmp_path, draw):
    path = write_map(tmp_path / "bad.h5")
    with SealedFile(path, "r+") as file:
        if place == "name":
            file.create_group(b"\xff\xfe")
        else:
            file.attrs.create(b"\xff\xfe", 1.0)
    outcome = draw(path)
    assert outcome.code == 2 and outcome.stderr.endswith("has a name in / that is no text\n")


def test_a_title_that_is_no_text_is_drawn(tmp_path, draw):
    path = write_map(tmp_path / "odd.h5")
    with SealedFile(path, "r+") as file:
        file.attrs["title"] = np.bytes_(b"\xff\xfe title")
    outcome = draw(path)
    assert outcome.code == 0 and outcome.stderr == ""
