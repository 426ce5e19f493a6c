"""Maps with [starts]: their contents, and independence of how they were computed."""

import math
import random
import re
import shutil
import tomllib
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray

import jobs
import kills
import launch
import many_starts
import map_contents
from conftest import compute

pytestmark = pytest.mark.thorough

EMPTY = -128
JOBS = Path(__file__).resolve().parents[2] / "jobs"


@pytest.fixture(scope="module")
def starts_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("starts"), many_starts.small_map())


@pytest.mark.parametrize("ranks", [1, 2, 3, 7])
def test_it_is_the_same_at_any_number_of_ranks(tmp_path, starts_file, ranks):
    jobs.write(tmp_path, many_starts.small_map())
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", starts_file)


def test_it_is_the_same_after_kills(tmp_path, starts_file):
    jobs.write(tmp_path, many_starts.small_map())
    toll, chance = kills.Toll(), random.Random(3)
    for ranks in (1, 3, 2, 4):
        kills.run_and_kill(tmp_path, ranks, chance.choice(kills.VICTIMS), chance)
        kills.look(tmp_path / "job.h5", starts_file, toll)
    kills.finish(tmp_path, starts_file, toll)
    assert toll.harm == 0, toll


def test_a_damaged_share_is_noticed(tmp_path, starts_file):
    """The contents of the slots are covered by the tile's checksum, too."""
    jobs.write(tmp_path, many_starts.small_map())
    path = tmp_path / "job.h5"
    path.write_bytes(starts_file.read_bytes())
    with h5py.File(path, "r+") as file:
        file["basin_share"][1, 20, 20] += 0.25
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3
    assert "damaged" in finished.stderr


def test_shares_and_slots_are_sound(starts_file):
    with xarray.open_dataset(starts_file) as cells:
        share, regime = cells.basin_share.values, cells.attractor_regime.values
        assert cells.basin_share.dims == ("attractor", "gap_ratio", "frequency_ratio")
        assert share.shape[0] == 8
        assert cells.attractors.values.max() <= 8  # no attractor without a slot
        np.testing.assert_allclose(share.sum(axis=0), 1, rtol=0, atol=1e-12)
        assert np.array_equal((share > 0).sum(axis=0), cells.attractors.values)
        assert np.all(np.diff(share, axis=0) <= 0)
        used = regime != EMPTY
        assert np.all(used[share > 0]) and np.all(np.diff(used.astype(int), axis=0) <= 0)
        assert (cells.attractors.values > 1).mean() > 0.3  # 41 % with 32 starts in this window
        mine = cells.start_attractor.values
        # the end state of [start] is one of them
        motion = np.isin(cells.regime.values, (0, 1, 2, 3))
        assert mine.min() >= -1 and np.all(mine[motion] >= 0)
        slot = np.maximum(mine, 0)[None]
        for name in ("regime", "impacts", "period"):
            of_slot = np.take_along_axis(cells[f"attractor_{name}"].values, slot, axis=0)[0]
            assert np.array_equal(of_slot[mine >= 0], cells[name].values[mine >= 0]), name


def test_start_itself_is_as_in_a_map_without_starts(tmp_path, starts_file):
    plain = many_starts.compute(tmp_path, jobs.small_map())
    with h5py.File(starts_file) as file:
        for name in ("regime", "impacts", "period", "status", "engine", "peak_force_ratio", "impact_rate"):
            assert file[name][()].tobytes() == plain[name].tobytes(), name


def test_what_is_left_over_is_counted(tmp_path, starts_file):
    few = many_starts.compute(tmp_path, many_starts.small_map().replace("attractors = 8", "attractors = 1"))
    with h5py.File(starts_file) as file:
        assert np.array_equal(few["attractors"], file["attractors"][()])
        assert few["basin_share"].tobytes() == file["basin_share"][:1].tobytes()


def test_a_refined_map_agrees_with_a_full_one(tmp_path):
    text = many_starts.small_map(count=16, columns=96, rows=96)
    full = many_starts.compute(tmp_path, text, name="full")
    refined = many_starts.compute(tmp_path, text + "[refine]\nlevels = 2\n", name="refined", ranks=2)
    computed = refined["computed"] == 1
    assert 0.2 < computed.mean() < 0.95
    for name in ("attractors", "start_attractor"):
        assert np.array_equal(refined[name][computed], full[name][computed])
    for name in ("attractor_regime", "basin_share", "attractor_peak_force_ratio"):
        ours, theirs = (np.where(one["basin_share"] > 0, one[name], 0)[:, computed] for one in (refined, full))
        assert ours.tobytes() == theirs.tobytes(), name
    np.testing.assert_allclose(refined["basin_share"].sum(axis=0), 1, rtol=0, atol=1e-9)
    filled = ~computed
    assert np.mean(refined["attractors"][filled] == full["attractors"][filled]) > 0.98
    # a share has steps of 1/16, so a single cell may differ by several
    assert np.abs(refined["basin_share"] - full["basin_share"])[:, filled].mean() < 0.5 / 16


def test_a_shipped_basin_is_one_cell(tmp_path):
    """basin_150mm_coexisting, with cubic springs omitted or kept as in any job, and the same point and rectangle in a map."""
    count, points = 8192, 64  # an attractor takes 1.2 % of the starts
    source = tomllib.loads((JOBS / "basin_150mm_coexisting.toml").read_text(encoding="utf-8"))
    rectangle = {name: tuple(source["axes"][f"{name}_ratio"][end] for end in ("from", "to"))
                 for name in ("displacement", "velocity")}
    place = source["operating_point"]
    head = f'schema = 1\nrig = "{JOBS / "rigs" / "150mm.toml"}"\n'
    cell = many_starts.compute(
        tmp_path, head + 'kind = "map"\n' + jobs.axis("frequency_ratio", place["frequency_ratio"], 1.9, 2)
        + jobs.axis("gap_ratio", place["gap_ratio"], 1.7, 2) + many_starts.table(count, **rectangle), name="cell")
    finished = launch.run("run", JOBS / "basin_150mm_coexisting.toml", "--quiet", "--output", "grid.h5", "--set",
                          f"axes.displacement_ratio.points={points}", "--set", f"axes.velocity_ratio.points={points}",
                          cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "grid.h5") as file:
        assert assert_same_shares(cell, file, count) >= 2


def assert_same_shares(cell, grid, count):
    """Compares a map's first cell with all cells of a basin, within the binomial error; returns the number of attractors compared."""
    found, slots = 0, int(cell["attractors"][0, 0])
    for slot in range(slots):
        label = [int(cell[f"attractor_{name}"][slot, 0, 0]) for name in ("regime", "impacts", "period")]
        same = np.all([grid[name][()] == value for name, value in zip(("regime", "impacts", "period"), label)], axis=0)
        share, expected = cell["basin_share"][slot, 0, 0], same.mean()
        found += expected
        error = math.sqrt(max(expected * (1 - expected), 1 / count) / count)
        assert abs(share - expected) < 4 * error, (label, share, expected)
    assert found > 0.98
    return slots


def test_starts_are_judged_by_the_gaps_of_the_cells(tmp_path):
    """And by no other axis: here the rows are speeds from -6 up, below the first displacement of the rectangle."""
    jobs.write(tmp_path, jobs.RIG.format(kind="map", title="speeds") + jobs.axis("frequency_ratio", 0.5, 4.5, 12)
               + jobs.axis("start.velocity_ratio", -6.0, 6.0, 12) + "[operating_point]\ngap_ratio = 2.0\n" + many_starts.table(4))
    finished = launch.run("check", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr


def test_a_basin_is_one_cell(tmp_path):
    """The same rectangle as a grid and as one cell of a map: within the binomial error."""
    count, points, gap = 1024, 48, 1.6
    rectangle = {"displacement": (-3.0, gap), "velocity": (-4.0, 4.0)}
    cell = many_starts.compute(
        tmp_path, jobs.RIG.format(kind="map", title="one cell") + jobs.axis("frequency_ratio", 1.8, 1.9, 2)
        + jobs.axis("gap_ratio", gap, 1.7, 2) + many_starts.table(count, **rectangle), name="cell")
    grid = many_starts.compute(
        tmp_path, jobs.RIG.format(kind="basin", title="grid")
        + f"[operating_point]\nfrequency_ratio = 1.8\ngap_ratio = {gap}\n"
        + jobs.axis("displacement_ratio", *rectangle["displacement"], points)
        + jobs.axis("velocity_ratio", *rectangle["velocity"], points), name="grid")
    assert_same_shares(cell, grid, count)


def test_the_summary_tells_what_starts_see_and_miss(tmp_path):
    jobs.write(tmp_path, many_starts.small_map(count=64, columns=16, rows=16))
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    for words in ("Where 64 starts of each cell end", "attractors on which they end: 1:", "commonest pairs:", "no impact",
                  "[start] ends on another attractor than most starts in",
                  # 1 - 0.5^(1/64) and 1 - 0.01^(1/64)
                  "64 starts miss an attractor whose basin takes 1.1 % of the rectangle in every second cell",
                  "6.9 % in one cell of a hundred"):
        assert words in finished.stdout, words


def test_a_start_costs_few_cycles(tmp_path):
    """Starts that use the cell's known orbits, and the fate of its chaos where impacts never end, take 84 here, 7 of them to tell
    whether the cubic spring turns the way."""
    points, count = 24, 64
    finished = launch.run("run", JOBS / "attractors_170mm.toml", "--quiet", "--output", "map.h5", "--set",
                          f"axes.frequency_ratio.points={points}", "--set", f"axes.gap_ratio.points={points}", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "map.h5") as file:
        assert file["cycles"][()].sum() < 88 * points**2 * count


def test_check_tells_the_number_of_starts_and_their_memory(tmp_path):
    jobs.write(tmp_path, many_starts.small_map())
    plain, many = (launch.run("check", "job.toml", "--set", f"starts.count={count}", cwd=tmp_path) for count in (0, 5000))
    assert "in all" not in plain.stdout
    assert "5,000 in each cell, 7,000,000 in all" in many.stdout
    assert launch.told_megabytes(many) > launch.told_megabytes(plain) + 100


def test_check_prices_critical_kicks(tmp_path):
    """They take as long as about ten thousand starts: 850,000 cycles per cell, 0.33 us each; these 80 took 3.2 s."""
    jobs.write(tmp_path, many_starts.small_map())
    kicks = launch.run("check", "job.toml", "--set", "axes.gap_ratio.points=2", "--set", 'output.fields=["critical_kick"]',
                       cwd=tmp_path)
    assert "1,920 in all\n#   kicks    of all attractors of each cell: some 22.4 s of one core more" in kicks.stdout, kicks.stdout


def test_one_start_has_its_attractor_as_the_only_share(tmp_path):
    jobs.write(tmp_path, many_starts.small_map())
    finished = launch.run("run", "job.toml", "--quiet", "--set", "starts.count=1", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as file:
        share = file["basin_share"][()]
        assert set(np.unique(share[0])) <= {0.0, 1.0} and share[0].any() and not share[1:].any()
        assert np.array_equal(share[0] > 0, file["attractor_regime"][0] != -128)
