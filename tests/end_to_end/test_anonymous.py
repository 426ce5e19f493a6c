"""References to machines and other files within a file: host names only in the group /run, a trace's map by the path
relative to the trace, and neither with output.anonymous."""

import platform

import h5py
import pytest

import jobs
import launch

KINDS = {
    "map": jobs.small_map(columns=8, rows=8),
    "basin": jobs.small_basin(points=8),
    "sweep": jobs.small_sweep(points=8),
    "trace": jobs.trace(2.0),
    "study": jobs.small_label_study(points=3),
    "curves": jobs.small_curves(points=8),
}
ANONYMOUS = ["--set", "output.anonymous=true"]


def compute(folder, text, *arguments):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", "--quiet", *arguments, cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5"


def places_of(path, name, run=True):
    """Attributes and datasets that contain this name, with the group /run or without it."""
    found = []

    def look(where, thing):
        values = list(thing.attrs.items())
        if isinstance(thing, h5py.Dataset) and thing.dtype.kind in "OS":
            values.append(("", thing[()]))
        is_run = where.startswith("run/")
        found.extend((where, key) for key, value in values if name in str(value) and (run or not is_run))

    with h5py.File(path) as file:
        look("/", file)
        file.visititems(look)
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_hosts_are_named_in_one_place_and_nowhere_if_wanted_so(tmp_path, kind):
    path = compute(tmp_path, KINDS[kind])
    assert places_of(path, platform.node(), run=False) == []
    with h5py.File(path) as file:
        assert file["run/hosts"][()].decode() == platform.node()
    path = compute(tmp_path, KINDS[kind], *ANONYMOUS, "--fresh")
    assert places_of(path, platform.node()) == []
    with h5py.File(path) as file:
        assert file["run/hosts"][()] == b""


def test_it_is_the_same_job(tmp_path):
    jobs.write(tmp_path, KINDS["map"])
    assert launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path).returncode == 5
    finished = launch.run("run", "job.toml", *ANONYMOUS, cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as file:
        assert file["run/hosts"][()] == b""


def test_a_trace_names_the_way_to_its_map(tmp_path, small_map_file):
    (tmp_path / "maps").mkdir()
    (tmp_path / "traces").mkdir()
    (tmp_path / "maps" / "map.h5").write_bytes(small_map_file.read_bytes())
    place = "row = 3\ncolumn = 4"
    for named in ("maps/map.h5", tmp_path / "maps" / "map.h5"):
        compute(tmp_path, jobs.trace_of(named, place), "--output", "traces/trace.h5")
        with h5py.File(tmp_path / "traces" / "trace.h5") as file:
            assert file.attrs["map_file"] == "../maps/map.h5"
        assert places_of(tmp_path / "traces" / "trace.h5", str(tmp_path)) == []
    path = compute(tmp_path, jobs.trace_of("maps/map.h5", place), *ANONYMOUS)
    with h5py.File(path) as file:
        assert "map_file" not in file.attrs
    assert places_of(path, "map.h5") == []
