"""Basins: attractors known from pilot starts end the searches of others, and affect only the computing time."""

import h5py
import numpy as np

import jobs
import launch
import map_contents

RIGID = """schema = 1
kind = "basin"
title = "Two motions on a rigid stop"
[hammer]
mass_kg = 1.0
natural_frequency_hz = 10.0
damping_ratio = 0.01
[cart]
amplitude_m = 1e-3
[contact]
law = "restitution"
coefficient = 0.7
[operating_point]
frequency_ratio = 3.0
gap_ratio = 1.0
[axes.displacement_ratio]
from = -2.0
to = 1.0
points = 20
[axes.velocity_ratio]
from = -4.0
to = 4.0
points = 20
[audit]
cells = 40
"""

def test_starts_end_in_the_neighbourhood_of_a_known_attractor(small_basin_file):
    """A start on one of them needs no cycle; without prior knowledge a periodic cell takes at least three."""
    with h5py.File(small_basin_file) as basin:
        periodic = basin["regime"][()] == 1
        cycles = basin["cycles"][()]
        forces = basin["peak_force_ratio"][()][periodic]
        assert cycles[periodic].min() == 0
        assert cycles[periodic].mean() < 12
        values, cells = np.unique(forces, return_counts=True)
        assert cells.max() > 0.9 * len(forces)  # exactly the attractor's own value
        assert np.ptp(values) < 1e-9 * values[0]


def test_an_independent_engine_finds_the_same_attractors(tmp_path):
    """The audit does not use pilots. Around the motion without impact, where its basin borders on that of 1/1."""
    jobs.write(tmp_path, jobs.small_basin() + "[audit]\ncells = 60\n")
    window = [f"axes.{axis}.{end}={value}" for axis, ends in
              {"displacement_ratio": (-0.5, 0.5), "velocity_ratio": (-1.5, 0.5)}.items()
              for end, value in zip(["from", "to"], ends)]
    settings = [word for key in window for word in ("--set", key)]
    finished = launch.run("run", "job.toml", *settings, cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as basin:
        assert set(basin["audit/regime"][()]) == {0, 1}
    assert "60 of 60" in finished.stdout


def test_attractors_of_a_rigid_stop_are_numbered(tmp_path):
    """It has no peak force. Two motions coexist; bounces followed one by one by another engine (the audit's) end on the same ones."""
    jobs.write(tmp_path, RIGID)
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as basin:
        attractor, impacts, period, rows = (basin[name][()] for name in ("attractor", "impacts", "period", "attractors/count"))
        table = {name: basin[f"attractors/{name}"][:rows] for name in ("impacts", "period", "cells", "peak_force_ratio", "orbit_displacement")}
    assert set(zip(impacts.ravel(), period.ravel())) == {(2, 4), (3, 4)}
    assert list(zip(table["impacts"], table["period"])) == [(2, 4), (3, 4)]
    assert np.array_equal(attractor, impacts - 2)
    assert np.array_equal(table["cells"], np.bincount(attractor.ravel()))
    assert np.isnan(table["peak_force_ratio"]).all() and np.isfinite(table["orbit_displacement"]).all()
    lines = [line.split()[:2] for line in finished.stdout.splitlines() if "at phase 0" in line]
    assert lines == [["2/4", str(table["cells"][0])], ["3/4", str(table["cells"][1])]]
    assert "40 of 40" in finished.stdout


def test_a_basin_that_was_stopped_goes_on_to_the_same_end(tmp_path, small_basin_file):
    jobs.write(tmp_path, jobs.small_basin())
    stopped = launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path, ranks=2)
    assert stopped.returncode == 5
    assert map_contents.done_tiles(tmp_path / "job.h5") == 0
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=3).returncode == 0
    map_contents.assert_same_map(tmp_path / "job.h5", small_basin_file)


def test_a_half_done_basin_is_completed(tmp_path, small_basin_file):
    """The pilots run again; their result must be the one with which the stored tiles were solved."""
    jobs.write(tmp_path, jobs.small_basin())
    (tmp_path / "job.h5").write_bytes(small_basin_file.read_bytes())
    with h5py.File(tmp_path / "job.h5", "r+") as basin:
        basin["tiles/done"][1:3] = 0
        basin["regime"][:16, 16:] = -128
        basin["regime"][16:, :16] = -128
        basin["summary/finished"][()] = 0
    finished = launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=3)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", small_basin_file)
