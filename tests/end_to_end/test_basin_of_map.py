"""Basins at a cell of a map, with its rig: identical to those of a job that gives these numbers itself."""

import h5py
import jobs
import launch
import pytest
from map_contents import assert_same_map

STARTS = jobs.axis("displacement_ratio", -3.0, 0.5, 12) + jobs.axis("velocity_ratio", -4.0, 4.0, 10)
OVER_STOPS = jobs.RIG.format(kind="map", title="stops") + """
[operating_point]
frequency_hz = 8.1
gap_m = 1.4e-3
[axes.contact.stiffness_n_per_m]
from = 1e6
to = 1e7
points = 3
[axes.contact.damping_ns_per_m]
from = 500
to = 1500
points = 3
"""


def basin_of(map_file, settings, axes=STARTS):
    return f'schema = 1\nkind = "basin"\ntitle = "small basin"\n[basin]\nmap = "{map_file}"\n{settings}\n{axes}'


def compute(folder, text, name="job.toml"):
    jobs.write(folder, text, name)
    finished = launch.run("run", name, "--quiet", cwd=folder, ranks=2)
    assert finished.returncode == 0, finished.stderr


def refused(folder, text):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 2, finished.stderr
    assert not (folder / "job.h5").exists()
    return " ".join(finished.stderr.split())


@pytest.fixture(scope="module")
def map_over_stops(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stops")
    compute(folder, OVER_STOPS)
    return folder / "job.h5"


def test_it_is_that_of_a_job_with_the_numbers_that_were_asked_for(tmp_path, map_over_stops):
    """Not those of the nearest cell."""
    compute(tmp_path, basin_of(map_over_stops, "[contact]\nstiffness_n_per_m = 9e6\ndamping_ns_per_m = 600\n"))
    own = jobs.RIG.format(kind="basin", title="small basin").replace("5.5e6", "9e6").replace("1.2e3", "600")
    assert own.count("9e6") == 1 and own.count("= 600") == 1
    compute(tmp_path, own + "[operating_point]\nfrequency_hz = 8.1\ngap_m = 1.4e-3\n" + STARTS, "own.toml")
    assert_same_map(tmp_path / "job.h5", tmp_path / "own.h5")
    with h5py.File(tmp_path / "job.h5") as file, h5py.File(tmp_path / "own.h5") as other:
        assert file.attrs["job"] == other.attrs["job"]  # the file stores the numbers, not the name of the map
        assert len(set(file["attractor"][()].ravel())) > 1


def test_its_place_may_be_named_by_row_and_column_or_by_values(tmp_path, small_map_file):
    with h5py.File(small_map_file) as file:
        frequency, gap = float(file["frequency_ratio"][13]), float(file["gap_ratio"][11])
    asked = frequency + 0.01, gap - 0.01
    values = f"[operating_point]\nfrequency_ratio = {asked[0]!r}\ngap_ratio = {asked[1]!r}\n"
    for settings, place, named in (("row = 11\ncolumn = 13\n", (frequency, gap), "row 11, column 13 of "), (values, asked, "")):
        jobs.write(tmp_path, basin_of(small_map_file, settings))
        told = launch.run("check", "job.toml", cwd=tmp_path).stdout
        assert f"rig      that of {named}{small_map_file}" in told
        assert f"frequency_ratio = {place[0]!r} " in told and f"gap_ratio = {place[1]!r} " in told


def test_a_complete_basin_is_left_alone(tmp_path, map_over_stops):
    text = basin_of(map_over_stops, "row = 0\ncolumn = 2\n")
    compute(tmp_path, text)
    again = launch.run("run", "job.toml", cwd=tmp_path)
    assert again.returncode == 0 and "is complete: nothing is computed" in again.stdout


@pytest.mark.parametrize("settings, message", [
    ("", "no cell of the map is named; give basin.row and basin.column, or contact.stiffness_n_per_m and contact.damping"),
    ("row = 3\ncolumn = 0\n", "basin.row = 3 is out of range; the map has 3 of them"),
    ("row = 1\n", "basin.row and basin.column name a cell together"),
    ("row = 0\ncolumn = 0\n[contact]\nstiffness_n_per_m = 2e6\n", "name a cell, and contact.stiffness_n_per_m names one, too"),
    ("row = 0\ncolumn = 0\n[cart]\namplitude_m = 1e-3\n", "cart.amplitude_m is that of the map's own job"),
    ("row = 0\ncolumn = 0\n[start]\nvelocity_ratio = 1\n", "a basin starts from every point of its axes"),
])
def test_a_cell_that_is_not_there_is_refused(tmp_path, map_over_stops, settings, message):
    assert message in refused(tmp_path, basin_of(map_over_stops, settings))


def test_files_that_have_no_such_cell_are_refused(tmp_path, small_basin_file):
    assert "is itself a basin" in refused(tmp_path, basin_of(small_basin_file, "row = 0\ncolumn = 0\n"))
    assert 'basin.map = "none.h5" does not exist' in refused(tmp_path, basin_of("none.h5", "row = 0\ncolumn = 0\n"))
    two = refused(tmp_path, 'rig = "mine.toml"\n' + basin_of(small_basin_file, "row = 0\ncolumn = 0\n"))
    assert "rig names a rig; the basin has that of the cell that basin.map names; remove one of them" in two
    missing = refused(tmp_path, basin_of("none.h5", "row = 0\ncolumn = 0\n").replace('map = "none.h5"', ""))
    assert "basin.map is missing" in missing


def test_starts_beyond_its_rigid_stop_are_refused(tmp_path):
    rigid = jobs.small_map(3, 3).replace("kelvin_voigt", "restitution")
    rigid = "\n".join(line for line in rigid.splitlines() if "stiffness_n" not in line and "= 1.2e3" not in line)
    compute(tmp_path, rigid.replace('law = "restitution"', 'law = "restitution"\ncoefficient = 0.6'), "rigid.toml")
    said = refused(tmp_path, basin_of("rigid.h5", "row = 0\ncolumn = 0\n"))
    assert "with the rig of row 0, column 0 of rigid.h5" in said and "lies beyond a rigid stop" in said
