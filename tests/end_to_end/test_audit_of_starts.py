"""An audited map with [starts]: an independent engine solves some starts of each audited cell again, in full."""

import h5py
import numpy as np
import pytest

import jobs
import launch
import many_starts
import map_contents

pytestmark = pytest.mark.thorough

AUDIT = "[audit]\ncells = 24\n"
OF_A_CELL = 8  # starts that are solved again


def audited(folder, *, ranks=2, extra=(), **size):
    jobs.write(folder, many_starts.small_map(**size) + AUDIT)
    finished = launch.run("run", "job.toml", *extra, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished.stdout


def read(path):
    with h5py.File(path) as file:
        return {name: item[()] for name, item in file["audit"].items()}


@pytest.fixture(scope="module")
def audited_map(tmp_path_factory):
    return audited(tmp_path_factory.mktemp("audited"))


def test_starts_end_where_the_map_says_but_for_those_that_rounding_decides(audited_map):
    file, summary = audited_map
    audit = read(file)
    assert audit["starts"].tolist() == [OF_A_CELL] * 24
    elsewhere, by_rounding = audit["starts_elsewhere"], audit["starts_decided_by_rounding"]
    assert np.all((by_rounding >= 0) & (by_rounding <= elsewhere))
    assert np.array_equal(elsewhere, by_rounding)
    assert audit["agreeing_starts"] == 1 - elsewhere.sum() / (24 * OF_A_CELL) > 0.9
    assert f"{24 * OF_A_CELL - elsewhere.sum()} of {24 * OF_A_CELL}" in summary
    assert "end on the attractor that the map says" in summary
    with h5py.File(file) as cells:  # several attractors, otherwise the starts have no alternative
        assert np.sum(cells["attractors"][()].ravel()[audit["cell"]] > 1) > 5


@pytest.mark.parametrize("ranks", [1, 3])
def test_is_the_same_at_any_number_of_ranks(tmp_path, audited_map, ranks):
    map_contents.assert_same_map(audited(tmp_path, ranks=ranks)[0], audited_map[0])


def test_sees_what_was_left_out(tmp_path):
    """A cubic spring so strong that it moves starts to other attractors, omitted by a job that permits it."""
    extra = ["--set", "hammer.cubic_stiffness_n_per_m3=2e5", "--set", "solver.omit_tolerance=1"]
    audit = read(audited(tmp_path, extra=extra, count=OF_A_CELL, columns=8, rows=6)[0])
    assert audit["starts_elsewhere"].sum() > audit["starts_decided_by_rounding"].sum()
    assert audit["agreeing_starts"] < 0.95


def test_a_map_of_one_start_has_none_of_it(tmp_path):
    jobs.write(tmp_path, jobs.small_map(8, 8) + "[audit]\ncells = 4\n")
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0 and "  starts  " not in finished.stdout
    assert not {"starts", "starts_elsewhere", "agreeing_starts"} & set(read(tmp_path / "job.h5"))
