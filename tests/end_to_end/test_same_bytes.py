"""A cell's result depends only on the job and the cell: any number of ranks gives the same file."""

import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

import jobs
import launch
import map_contents

pytestmark = pytest.mark.thorough


@pytest.mark.parametrize("ranks", [1, 2, 3, 4, 7])
def test_a_map_is_the_same_at_any_number_of_ranks(tmp_path, small_map_file, ranks):
    jobs.write(tmp_path, jobs.small_map())
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", small_map_file)


@pytest.mark.parametrize("ranks", [1, 2, 3, 4, 7])
def test_a_basin_is_the_same_at_any_number_of_ranks(tmp_path, small_basin_file, ranks):
    jobs.write(tmp_path, jobs.small_basin())
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", small_basin_file)


@pytest.mark.parametrize("seed", [1, 2])
def test_tiles_are_the_same_in_any_order_and_company(tmp_path, medium_map_file, seed):
    """Random tiles are removed from a map, and in each of three runs others of them are restored."""
    jobs.write(tmp_path, jobs.medium_map())
    path = shutil.copy(medium_map_file, tmp_path / "job.h5")
    shuffled = np.random.default_rng(seed).permutation(map_contents.tile_count(path))
    for part in np.array_split(shuffled, 3):
        map_contents.take_out(path, part)
        finished = launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=2)
        assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(path, medium_map_file)


def test_a_cell_is_the_same_in_a_coarser_map(tmp_path):
    """Also shows that every cell lies at its place, in cropped tiles too: steps of 1/8 and 1/4 are exact."""
    jobs.write(tmp_path, jobs.map_of_steps(columns=41, rows=21), name="fine.toml")
    jobs.write(tmp_path, jobs.map_of_steps(columns=21, rows=11), name="coarse.toml")
    for job in ["fine.toml", "coarse.toml"]:
        assert launch.run("run", job, "--quiet", cwd=tmp_path, ranks=2).returncode == 0
    with h5py.File(tmp_path / "fine.h5") as fine, h5py.File(tmp_path / "coarse.h5") as coarse:
        assert len(set(coarse["cycles"][()].ravel())) > 20
        for field in ["regime", "impacts", "period", "cycles", "peak_force_ratio", "impact_rate"]:
            assert fine[field][::2, ::2].tobytes() == coarse[field][()].tobytes(), field


def test_the_comparison_sees_a_difference(tmp_path, small_map_file):
    """Validates the tests above: another job's file differs."""
    jobs.write(tmp_path, jobs.small_map().replace("5.5e6", "5.6e6"))
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    with pytest.raises(AssertionError):
        map_contents.assert_same_map(tmp_path / "job.h5", small_map_file)


def test_what_compares_files_for_other_hosts_tells_same_from_different(small_map_file, small_basin_file):
    compare = Path(__file__).parents[1] / "endurance/same_map.py"
    for other, same in ((small_map_file, True), (small_basin_file, False)):
        compared = subprocess.run([sys.executable, compare, small_map_file, other], capture_output=True, text=True, timeout=60)
        assert (compared.returncode == 0) == same, compared.stderr
        assert same or "AssertionError" in compared.stderr
