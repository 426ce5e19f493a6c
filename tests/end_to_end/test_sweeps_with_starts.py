"""Sweeps with [starts]: every attractor at each point, besides those of the branches."""

import random
import shutil

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

GAPS, POINTS, SAMPLES = (0.0, 2.5), 25, 12
FIRST, LAST = 1.0, 3.4
LABEL = ("attractor_regime", "attractor_impacts", "attractor_period")
OF_POINTS = (*LABEL, "attractor_peak_force_ratio", "basin_share")


def sweep(points=POINTS, direction="both", gaps=GAPS, count=24):
    return (jobs.RIG.format(kind="sweep", title="small sweep with starts") + jobs.axis("frequency_ratio", FIRST, LAST, points)
            + f'[sweep]\ngap_ratio = {list(gaps)}\ndirection = "{direction}"\nsamples = {SAMPLES}\n' + many_starts.table(count))


@pytest.fixture(scope="module")
def sweep_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("sweep_with_starts"), sweep())


@pytest.mark.parametrize("ranks", [1, 2, 3, 7])
def test_it_is_the_same_at_any_number_of_ranks(tmp_path, sweep_file, ranks):
    jobs.write(tmp_path, sweep())
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", sweep_file)


def test_it_is_the_same_after_kills(tmp_path, sweep_file):
    jobs.write(tmp_path, sweep())
    toll, chance = kills.Toll(), random.Random(5)
    for ranks in (1, 3, 2):
        kills.run_and_kill(tmp_path, ranks, chance.choice(kills.VICTIMS), chance)
        kills.look(tmp_path / "job.h5", sweep_file, toll)
    kills.finish(tmp_path, sweep_file, toll)
    assert toll.harm == 0, toll


def test_a_half_done_one_is_completed(tmp_path, sweep_file):
    jobs.write(tmp_path, sweep())
    path = shutil.copy(sweep_file, tmp_path / "job.h5")
    map_contents.take_out(path, [1])
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    assert f"{2 * POINTS} cells to compute, {2 * POINTS} already in the file" in finished.stderr
    map_contents.assert_same_map(path, sweep_file)


@pytest.mark.parametrize("name", ["basin_share", "stroboscopic_attractor", "attractor_impact_velocity"])
def test_a_damaged_gap_is_computed_again(tmp_path, sweep_file, name):
    jobs.write(tmp_path, sweep())
    path = shutil.copy(sweep_file, tmp_path / "job.h5")
    with h5py.File(path, "r+") as file:
        values = file[name][()]
        values[np.isfinite(values)] += 1
        file[name][...] = values
        file["summary/finished"][()] = 0
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0 and "2 tiles are damaged" in finished.stderr
    map_contents.assert_same_map(path, sweep_file)


def test_branches_are_those_of_a_sweep_without_starts(tmp_path, sweep_file):
    plain = many_starts.compute(tmp_path, sweep(count=0))
    with h5py.File(sweep_file) as file:
        for name, values in plain.items():
            if name not in ("start_attractor", "attractors"):
                assert file[name][()].tobytes() == values.tobytes(), name


@pytest.mark.parametrize(("gap", "column"), [(0, 3), (1, 0), (1, 7), (1, 12), (1, 24)])
def test_attractors_are_those_of_a_map_of_one_cell(tmp_path, sweep_file, gap, column):
    with h5py.File(sweep_file) as file:
        frequency = float(file["frequency_ratio"][column])
        here = {name: file[name][()][:, 2 * gap:2 * gap + 2, column] for name in OF_POINTS}
    cell = many_starts.compute(
        tmp_path, jobs.RIG.format(kind="map", title="one cell") + jobs.axis("frequency_ratio", frequency, frequency, 1)
        + jobs.axis("gap_ratio", GAPS[gap], GAPS[gap], 1) + many_starts.table(24), name="cell")
    found = (cell["basin_share"][:, 0, 0] > 0).sum()  # other known motions differ: other points know them
    for name, values in here.items():
        for branch in range(2):  # of one gap: up and down share them
            if values.ndim == 3:
                assert values[:found, branch].tobytes() == cell[name][:found, 0, 0].tobytes(), (name, branch)
    assert np.array_equal((here["basin_share"] > 0).sum(axis=0), [found] * 2)


def test_starts_end_where_another_engine_leads_them(tmp_path, sweep_file):
    """Each start at three points in full, one by one, by an integrator independent of the closed form."""
    columns, count = (4, 10, 16), 24
    with h5py.File(sweep_file) as file:
        frequencies = [float(file["frequency_ratio"][column]) for column in columns]
        labels = np.stack([file[name][()][:, 2] for name in LABEL], axis=-1)  # [slot][point][number]
        shares = file["basin_share"][:, 2]
    step = (frequencies[-1] - frequencies[0]) / 2
    assert np.allclose(np.diff(frequencies), step)
    expected, open_ends = [{} for _ in columns], np.zeros(len(columns))
    for x, v in many_starts.starts(count, (-4.0, 1.0), (-4.0, 4.0)):
        single = many_starts.compute(
            tmp_path, jobs.RIG.format(kind="map", title="single")
            + jobs.axis("frequency_ratio", frequencies[0], frequencies[-1], len(columns))
            + jobs.axis("gap_ratio", GAPS[1], GAPS[1], 1) + f"[start]\ndisplacement_ratio = {float(x)!r}\nvelocity_ratio = {float(v)!r}\n"
            '[solver]\nengine = "cvode"\n[output]\nfields = ["sensitivity"]\n', name="single")
        for n in range(len(columns)):
            label = tuple(int(single[name][0, n]) for name in ("regime", "impacts", "period"))
            expected[n][label] = expected[n].get(label, 0) + 1
            open_ends[n] += label[0] not in (0, 1, 3) or single["sensitivity"][0, n] > 15
    for n, column in enumerate(columns):
        found = {}
        for slot in np.flatnonzero(shares[:, column]):
            label = tuple(map(int, labels[slot, column]))
            found[label] = found.get(label, 0) + round(count * float(shares[slot, column]))
        missed = sum(max(wanted - found.get(label, 0), 0) for label, wanted in expected[n].items())
        assert missed <= open_ends[n], (column, expected[n], found)
    assert open_ends.sum() < count  # of three times as many: otherwise nothing was compared


def test_samples_lie_on_their_attractors(tmp_path, sweep_file):
    """An orbit has as many samples as its period and its impacts; a hammer started at one of them by another engine ends there."""
    with xarray.open_dataset(sweep_file) as cells:
        assert cells.attractor_peak_force_ratio.dims == ("attractor", "branch", "frequency_ratio")
        assert cells.attractor_stroboscopic_displacement.dims == ("branch", "frequency_ratio", "sample")
        regime, impacts, period = (cells[name].values for name in LABEL)
        of, of_impact = cells.stroboscopic_attractor.values, cells.impact_attractor.values
        assert np.array_equal(of >= 0, np.isfinite(cells.attractor_stroboscopic_displacement.values))
        assert np.array_equal(of_impact >= 0, np.isfinite(cells.attractor_impact_velocity.values))
        slots = cells.attractor_regime.values >= 0
        compared = 0
        for slot, branch, column in zip(*np.nonzero(slots & np.isin(regime, (0, 1)))):
            room = SAMPLES // slots[:, branch, column].sum()
            place = slot, branch, column
            assert (of[branch, column] == slot).sum() >= min(period[place], room), place
            assert (of_impact[branch, column] == slot).sum() >= min(impacts[place], room), place
            if period[place] <= room:
                assert (of[branch, column] == slot).sum() == period[place]
            compared += 1
        assert compared > 60
        several = np.argwhere((slots[:, 2] & (regime[:, 2] == 1)).sum(axis=0) * slots[:, 2].sum(axis=0) > 1)[::3, 0]
        assert len(several) >= 3
        for column in several:
            frequency = float(cells.frequency_ratio[column])
            slot = int(np.flatnonzero(regime[:, 2, column] == 1)[0])
            sample = int(np.flatnonzero(of[2, column] == slot)[0])
            x = float(cells.attractor_stroboscopic_displacement[2, column, sample])
            v = float(cells.attractor_stroboscopic_velocity[2, column, sample]) + frequency
            single = many_starts.compute(
                tmp_path, jobs.RIG.format(kind="map", title="from a sample")
                + jobs.axis("frequency_ratio", frequency, frequency, 1) + jobs.axis("gap_ratio", GAPS[1], GAPS[1], 1)
                + f'[start]\ndisplacement_ratio = {float(x)!r}\nvelocity_ratio = {float(v)!r}\n[solver]\nengine = "cvode"\n', name="sample")
            found = [int(single[name][0, 0]) for name in ("regime", "impacts", "period")]
            assert found == [int(array[slot, 2, column]) for array in (regime, impacts, period)], column
            assert single["peak_force_ratio"][0, 0] == pytest.approx(
                float(cells.attractor_peak_force_ratio[slot, 2, column]), rel=1e-5)


def test_samples_of_an_orbit_are_those_of_a_branch_on_it(sweep_file):
    """Starts found it from elsewhere."""
    compared = 0
    with h5py.File(sweep_file) as file:
        cells = {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}
    for branch, column in np.argwhere((cells["regime"] == 1) & (cells["start_attractor"] >= 0) & (cells["period"] <= 2)):
        for kind, numbers in (("stroboscopic", ("displacement", "velocity")), ("impact", ("displacement", "velocity"))):
            mine = cells[f"{kind}_attractor"][branch, column] == cells["start_attractor"][branch, column]
            for number in numbers:
                own = cells[f"{kind}_{number}"][branch, column]
                found = cells[f"attractor_{kind}_{number}"][branch, column][mine]
                np.testing.assert_allclose(np.sort(found), np.sort(own[np.isfinite(own)]), rtol=1e-6, atol=1e-7)
                compared += 1
    assert compared > 100


@pytest.mark.parametrize("engine", ["netcdf4", "h5netcdf"])
def test_other_readers_open_it(sweep_file, engine):
    with xarray.open_dataset(sweep_file, engine=engine) as cells:
        assert cells.sizes == {"frequency_ratio": POINTS, "branch": 4, "sample": SAMPLES, "attractor": 8}
        assert cells.basin_share.dims == ("attractor", "branch", "frequency_ratio")
        assert cells.stroboscopic_attractor.dims == ("branch", "frequency_ratio", "sample")
        np.testing.assert_allclose(cells.basin_share.sum("attractor"), 1, rtol=0, atol=1e-12)


def test_each_point_says_which_of_them_it_is_on(sweep_file):
    with xarray.open_dataset(sweep_file) as cells:
        mine = cells.start_attractor.values
        assert np.all(mine[np.isin(cells.regime.values, (0, 1, 2, 3))] >= 0)
        slot = np.maximum(mine, 0)[None]
        for name in ("regime", "impacts", "period"):
            of_slot = np.take_along_axis(cells[f"attractor_{name}"].values, slot, axis=0)[0]
            assert np.array_equal(of_slot[mine >= 0], cells[name].values[mine >= 0]), name
        # where up and down are on different motions, starts found both
        apart = (cells.impacts.values[2] != cells.impacts.values[3]) & (mine[2:] >= 0).all(axis=0)
        assert apart.any() and np.all(mine[2][apart] != mine[3][apart])


@pytest.mark.parametrize("attractors", [8, 2])
def test_what_a_branch_ends_on_is_one_of_them_though_no_start_found_it(tmp_path, attractors):
    """Starts are close to the motion without impact where it exists; the falling branch with impacts coexists."""
    sets = ("axes.frequency_ratio.points=81", "starts.count=2", "starts.displacement_ratio=[-0.1,0.1]", "starts.velocity_ratio=[-0.9,-0.5]", f"starts.attractors={attractors}")
    cells = many_starts.compute(tmp_path, sweep(), *(word for one in sets for word in ("--set", one)))
    mine = cells["start_attractor"]
    assert np.isin(cells["regime"], (0, 1, 2, 3)).all() and np.all(mine >= 0)
    at = np.maximum(mine, 0)[None]
    share, force, regime = (np.take_along_axis(cells[name], at, axis=0)[0]
                            for name in ("basin_share", "attractor_peak_force_ratio", "attractor_regime"))
    alone = share == 0
    assert 5 < alone.sum() < alone.size
    assert np.array_equal(regime, cells["regime"])
    orbits = alone & (regime == 1)
    assert orbits.sum() > 5
    np.testing.assert_allclose(force[orbits], cells["peak_force_ratio"][orbits], rtol=1e-6)
    # with as many samples as attractors found by starts
    for branch, column in np.argwhere(orbits):
        samples = (cells["stroboscopic_attractor"][branch, column] == mine[branch, column]).sum()
        assert samples >= min(cells["period"][branch, column], SAMPLES // attractors)


def test_the_summary_tells_what_branches_miss(tmp_path, sweep_file):
    """Recounted from the file."""
    with h5py.File(sweep_file) as file:
        regime, mine = file["attractor_regime"][:, 2], file["start_attractor"][2:]
        known = np.isin(regime, [0, 1, 2, 3])  # also those that no start found; not the unresolved
        several = int((known.sum(axis=0) > 1).sum())
        missed = sum(any(known[slot, column] and slot not in mine[:, column] for slot in range(len(known)))
                     for column in range(POINTS))
    jobs.write(tmp_path, sweep())
    shutil.copy(sweep_file, tmp_path / "job.h5")
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0
    assert missed > 2 and several > 5
    of_gap = finished.stdout.split("Gap/A0 2.5")[1]
    assert f"{several} of {POINTS} points have several attractors" in of_gap
    assert f"on no branch      at {missed} points:" in of_gap
    assert "a branch is on another attractor than most starts" in finished.stdout


def test_one_direction_and_kicks(tmp_path):
    cells = many_starts.compute(tmp_path, sweep(points=5, direction="independent", gaps=[2.5])
                                + '[output]\nfields = ["critical_kick"]\n')
    assert cells["basin_share"].shape == cells["critical_kick"].shape == (8, 1, 5)
    periodic = cells["attractor_regime"] == 1
    assert np.isfinite(cells["critical_kick"][periodic]).any() and np.isnan(cells["critical_kick"][~periodic]).all()


def test_check_prices_it(tmp_path, sweep_file):
    jobs.write(tmp_path, sweep())
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 0, checked.stderr
    assert "24 in each point, 1,200 in all" in checked.stdout
    foretold = float(checked.stdout.split("job.h5, ")[1].split(" kB")[0]) * 1000
    assert 0 <= foretold + 100 - sweep_file.stat().st_size < 20_000
