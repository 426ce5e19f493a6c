"""A refined map: some of its cells are computed, the others filled, independently of the run's history."""

import os
import random
import signal

import h5py
import numpy as np
import pytest

import jobs
import launch
import map_contents
from conftest import compute

pytestmark = pytest.mark.thorough

LABELS = ("regime", "impacts", "period")
RANDOM = random.Random(4)


def full_map():
    return jobs.small_map(columns=128, rows=128, title="full map")


def refined_map(levels=2):
    return full_map() + f"\n[refine]\nlevels = {levels}\n"


@pytest.fixture(scope="module")
def full_map_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("full_map"), full_map())


@pytest.fixture(scope="module")
def refined_map_file(tmp_path_factory):
    folder = tmp_path_factory.mktemp("refined_map")
    jobs.write(folder, refined_map())
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    assert "cells computed" in finished.stdout and "filled" in finished.stdout
    return folder / "job.h5"


def contents(path):
    with h5py.File(path) as file:
        return {name: file[name][()] for name in file if isinstance(file[name], h5py.Dataset)}


def test_computed_cells_are_those_of_the_full_map_and_filled_ones_agree(refined_map_file, full_map_file):
    refined, full = contents(refined_map_file), contents(full_map_file)
    computed = refined["computed"] == 1
    assert set(np.unique(refined["computed"])) == {0, 1}
    assert 0.2 < computed.mean() < 0.7
    for name in [*LABELS, "cycles", "peak_force_ratio", "impact_rate", "status", "engine"]:
        assert refined[name][computed].tobytes() == full[name][computed].tobytes(), name

    same = np.logical_and.reduce([refined[name] == full[name] for name in LABELS])
    assert same.mean() >= 0.999
    filled = ~computed & same & (refined["regime"] == 1)
    error = np.abs(refined["peak_force_ratio"][filled] / full["peak_force_ratio"][filled] - 1)
    assert filled.sum() > 500 and np.median(error) < 1e-3 and error.max() < 0.02


def test_filled_cells_say_so(refined_map_file):
    refined = contents(refined_map_file)
    filled = refined["computed"] == 0
    assert not refined["cycles"][filled].any()
    assert not refined["status"][filled].any()
    assert set(np.unique(refined["regime"][filled])) <= {0, 1, 2, 3}
    chaotic = filled & (refined["regime"] == 2)
    assert np.isnan(refined["peak_force_ratio"][chaotic]).all()
    assert np.isfinite(refined["peak_force_ratio"][filled & ~chaotic]).all()
    lattice = np.zeros_like(filled)
    lines = [*range(0, 128, 4), 127]
    lattice[np.ix_(lines, lines)] = True
    assert not filled[lattice].any()


@pytest.mark.parametrize("ranks", [1, 2, 3, 7])
def test_the_same_bytes_at_any_number_of_ranks(tmp_path, refined_map_file, ranks):
    jobs.write(tmp_path, refined_map())
    finished = launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", refined_map_file)


@pytest.mark.parametrize("ranks", [None, 3])
def test_many_short_runs_make_the_same_file_as_one(tmp_path, refined_map_file, ranks):
    jobs.write(tmp_path, refined_map())
    for stops in range(60):
        limit = ["--max-wall", 0.03 * 1.5**stops]
        finished = launch.run("run", "job.toml", "--quiet", *limit, cwd=tmp_path, ranks=ranks)
        if finished.returncode == 0:
            break
        assert finished.returncode == 5, finished.stderr
        ranks = None if ranks else 3
    assert stops > 0
    map_contents.assert_same_map(tmp_path / "job.h5", refined_map_file)


@pytest.mark.parametrize("attempt", range(6))
def test_killed_at_any_moment_it_goes_on_to_the_same_file(tmp_path, refined_map_file, attempt):
    jobs.write(tmp_path, refined_map())
    process = launch.start("run", "job.toml", cwd=tmp_path)
    assert "cells to compute" in process.stderr.readline()
    try:
        process.communicate(timeout=RANDOM.uniform(0, 2))
    except launch.subprocess.TimeoutExpired:
        os.kill(process.pid, signal.SIGKILL)
        process.communicate(timeout=launch.HANGING)
    finished = launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", refined_map_file)


def test_tiles_that_are_damaged_or_missing_are_made_again(tmp_path, refined_map_file):
    jobs.write(tmp_path, refined_map())
    (tmp_path / "job.h5").write_bytes(refined_map_file.read_bytes())
    with h5py.File(tmp_path / "job.h5", "r+") as file:
        file["peak_force_ratio"][20, 5] = 1.0
        file["tiles/done"][17] = 0
        file["regime"][32:48, 16:32] = -128
        file["summary/finished"][()] = 0
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    assert any("1 tiles are damaged" in line for line in launch.messages(finished))
    map_contents.assert_same_map(tmp_path / "job.h5", refined_map_file)


def test_an_audit_tells_of_filled_cells_apart(tmp_path):
    """No cell twice, and filled ones among them: their labels are the map's, and their forces interpolated."""
    jobs.write(tmp_path, refined_map(levels=3) + "\n[audit]\ncells = 60\n")
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as file:
        rows, columns = file["audit/row"][()], file["audit/column"][()]
        cells, agrees, errors = (file[f"audit/{name}"][()] for name in ("cell", "agrees", "force_error"))
        computed = file["computed"][()][rows, columns] == 1
        assert (cells == rows * 128 + columns).all() and len(np.unique(cells)) == 60
        assert 5 < computed.sum() < 55 and np.isnan(errors[~computed]).all() and np.isfinite(errors[computed]).any()
        same = np.all([file[f"audit/{name}"][()] == file[name][()][rows, columns] for name in ("regime", "impacts", "period")], axis=0)
        assert (same == (agrees == 1)).all() and same[computed].all()
        filled, orbits = ~computed, (agrees == 1) & (file["audit/regime"][()] == 1)
        with np.errstate(invalid="ignore"):  # without impact
            interpolated = np.abs(file["peak_force_ratio"][()][rows, columns] / file["audit/peak_force_ratio"][()] - 1)
    of_filled = np.sort(interpolated[filled & orbits])
    assert f"{of_filled[(len(of_filled) - 1) // 2]:.1e} (median)" in finished.stdout
    assert f"{of_filled[-1]:.1e} (largest) in {len(of_filled)} filled cells" in finished.stdout
    assert "computed cells\n" in finished.stdout.split("peak force          off by")[1][:90]
    assert (f"of these            {same[computed].sum()} of {computed.sum()} computed cells, {same[filled].sum()} of {filled.sum()} filled "
            "from the cells around") in finished.stdout


def test_check_says_what_is_surely_computed(tmp_path):
    jobs.write(tmp_path, refined_map(levels=3))
    finished = launch.run("check", "job.toml", cwd=tmp_path)
    assert "from a grid of stride 8, 289 cells, to all of them" in finished.stdout


def test_a_map_refined_otherwise_is_another_job(tmp_path, refined_map_file):
    jobs.write(tmp_path, refined_map(levels=3))
    (tmp_path / "job.h5").write_bytes(refined_map_file.read_bytes())
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3
    assert "refine.levels" in finished.stderr or "levels" in finished.stderr


def test_basins_are_not_refined(tmp_path):
    jobs.write(tmp_path, jobs.small_basin() + "\n[refine]\nlevels = 1\n")
    finished = launch.run("check", "job.toml", cwd=tmp_path)
    assert finished.returncode == 2
    assert "[refine] is for maps" in finished.stderr


def test_check_prices_the_regions_that_a_rank_keeps(tmp_path):
    jobs.write(tmp_path, jobs.small_map(2001, 2001))
    memory = [launch.told_megabytes(launch.run("check", "job.toml", "--set", f"refine.levels={levels}", cwd=tmp_path))
              for levels in (0, 3, 4)]
    assert memory[1] > memory[0] + 50 and memory[2] > memory[1] + 10
