"""Motions that a map with [starts] knows in its cells although none of their starts found them: against the closed form, an
integrator, and the map itself."""

import math
import shutil

import h5py
import numpy as np
import pytest

import jobs
import launch
import many_starts
import map_contents

pytestmark = pytest.mark.thorough

EMPTY, NO_IMPACT, PERIODIC, CHAOTIC = -128, 0, 1, 2
FEW = 5  # starts: many motions are missed
ZETA = 0.06 / (2 * 0.298 * 2 * math.pi * 4.5)


def text(attractors=8, columns=64, rows=40, count=FEW):
    """Gaps above 1, where impacts and no impact coexist."""
    return (jobs.RIG.format(kind="map", title="few starts") + jobs.axis("frequency_ratio", 1.5, 4.0, columns)
            + jobs.axis("gap_ratio", 1.0, 3.0, rows) + many_starts.table(count, attractors=attractors))


@pytest.fixture(scope="module")
def known_file(tmp_path_factory):
    folder = tmp_path_factory.mktemp("known")
    jobs.write(folder, text())
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    (folder / "summary.txt").write_text(finished.stdout)
    return folder / "job.h5"


def read(path):
    with h5py.File(path) as file:
        return {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}


def without_share(cells):
    return (cells["attractor_regime"] != EMPTY) & (cells["basin_share"] == 0)


def test_a_motion_without_impact_is_known_wherever_the_closed_form_has_one(known_file):
    cells = read(known_file)
    eta = cells["frequency_ratio"]
    exists = cells["gap_ratio"][:, None] > eta**2 / np.sqrt((1 - eta**2) ** 2 + (2 * ZETA * eta) ** 2)
    free = cells["attractor_regime"] == NO_IMPACT
    assert np.array_equal(free.any(axis=0), exists) and free.sum(axis=0).max() == 1
    missed = free & (cells["basin_share"] == 0)
    assert missed.sum() > 50
    assert np.all(cells["attractor_peak_force_ratio"][missed] == 0)
    # the steady motion at phase 0
    place = np.where(exists, free.argmax(axis=0), 0)[None]
    displacement, velocity = (np.take_along_axis(cells[f"attractor_orbit_{name}"], place, axis=0)[0]
                              for name in ("displacement", "velocity"))
    steady = eta**2 / (1 - eta**2 + 2j * ZETA * eta)  # of sin(eta tau): its imaginary part
    np.testing.assert_allclose(displacement[exists], np.broadcast_to(steady.imag, exists.shape)[exists], atol=1e-12)
    np.testing.assert_allclose(velocity[exists], np.broadcast_to(eta * steady.real, exists.shape)[exists], atol=1e-12)


def test_the_orbits_of_neighbours_exist(tmp_path, known_file):
    """An integrator started on them stays there."""
    cells = read(known_file)
    slots = np.argwhere(without_share(cells) & (cells["attractor_regime"] == PERIODIC))
    assert len(slots) > 8
    rng = np.random.default_rng(1)
    for slot, row, column in rng.permutation(slots)[:8]:
        at = (slot, row, column)
        eta, gap = cells["frequency_ratio"][column], cells["gap_ratio"][row]
        one = (jobs.RIG.format(kind="map", title="one") + jobs.axis("frequency_ratio", eta, eta + 1, 1)
               + jobs.axis("gap_ratio", gap, gap + 1, 1)
               + f"[start]\ndisplacement_ratio = {float(cells['attractor_orbit_displacement'][at])!r}\n"
               f"velocity_ratio = {float(cells['attractor_orbit_velocity'][at] + eta)!r}\n"
               "[solver]\nengine = \"cvode\"\ntolerance = 1e-10\n")
        alone = many_starts.compute(tmp_path, one.replace("np.float64(", "").replace(")", ""), name="one")
        for name in ("regime", "impacts", "period"):
            assert alone[name][0, 0] == cells[f"attractor_{name}"][at], (name, at)
        assert alone["peak_force_ratio"][0, 0] == pytest.approx(cells["attractor_peak_force_ratio"][at], rel=1e-6)
        assert alone["cycles"][0, 0] < 200 * alone["period"][0, 0]


def test_many_starts_find_what_few_only_know(tmp_path, known_file):
    """An orbit known in a cell is found there by some of 400 starts, or its share is at most a few of them."""
    few = read(known_file)
    many = many_starts.compute(tmp_path, text().replace(f"count = {FEW}", "count = 400").replace("points = 40", "points = 4"),
                               name="many", ranks=2)
    rows = [np.flatnonzero(np.isclose(few["gap_ratio"], gap)) for gap in many["gap_ratio"]]
    assert [len(row) for row in rows] == [1] * 4
    known = found = 0
    for row, there in enumerate(rows):
        for slot, column in np.argwhere(without_share(few)[:, there[0]]):
            known += 1
            label = [few[f"attractor_{name}"][slot, there[0], column] for name in ("regime", "impacts", "period")]
            same = np.all([many[f"attractor_{name}"][:, row, column] == value
                           for name, value in zip(("regime", "impacts", "period"), label)], axis=0)
            found += (many["basin_share"][same, row, column]).sum() > 0
    assert known > 15 and found > 0.8 * known, (known, found)


def test_shares_and_cells_are_as_if_nothing_else_were_known(tmp_path, known_file):
    """A single row has other neighbours, and its own results are unchanged."""
    cells, row = read(known_file), 11
    gap = cells["gap_ratio"][row]
    alone = many_starts.compute(tmp_path, text(rows=1).replace("from = 1.0", f"from = {float(gap)!r}"), name="row")
    for name, values in alone.items():
        if name in ("attractor", "frequency_ratio", "gap_ratio", "frequency_hz", "gap_m"):
            continue
        theirs = cells[name][..., row, :]
        if values.ndim == 3:
            values, theirs = (np.where(one["basin_share"][..., at, :] > 0, part, 0)
                              for one, at, part in ((alone, 0, values[:, 0]), (cells, row, theirs)))
        else:
            values = values[0]
        assert values.tobytes() == theirs.tobytes(), name


@pytest.mark.parametrize("attractors", [1, 2, 8])
def test_a_run_that_was_stopped_in_between_ends_the_same(tmp_path, attractors):
    """Some tiles have the known motions already, in others only starts were solved, and others are missing."""
    jobs.write(tmp_path, text(attractors, columns=48, rows=32, count=30))  # enough that orbits continued by neighbours are displaced
    path = tmp_path / "job.h5"
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    whole = shutil.copy(path, tmp_path / "whole.h5")
    kept = read(whole)
    assert attractors == 8 or (np.sum(kept["basin_share"] > 0, axis=0) < kept["attractors"]).any()
    tiles = map_contents.tile_count(path)
    for ranks, missing in ((1, []), (2, range(0, tiles, 3)), (3, range(1, tiles, 2))):
        map_contents.take_out(path, list(missing))
        with h5py.File(path, "r+") as file:
            file["summary/finished"][()] = 0
        finished = launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=ranks)
        assert finished.returncode == 0, finished.stderr
        map_contents.assert_same_map(path, whole)


@pytest.mark.parametrize("ranks", [2, 3, 5])
def test_it_is_the_same_at_any_number_of_ranks(tmp_path, known_file, ranks):
    jobs.write(tmp_path, text())
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=ranks).returncode == 0
    map_contents.assert_same_map(tmp_path / "job.h5", known_file)


def test_few_slots_keep_the_largest_share_and_what_is_known(tmp_path, known_file):
    all_slots = read(known_file)
    few = many_starts.compute(tmp_path, text(attractors=2), name="few")
    known = without_share(all_slots).sum(axis=0)
    shares = (all_slots["basin_share"] > 0).sum(axis=0)
    crowded = (known > 0) & (shares > 1)
    assert crowded.sum() > 15
    assert np.array_equal(few["basin_share"][0], all_slots["basin_share"][0])
    own = few["start_attractor"]
    # where [start] is not on the smaller share that would be displaced
    gives_way = crowded & (all_slots["start_attractor"] != 1)
    assert np.all(without_share(few)[1][gives_way])
    for name in ("regime", "impacts", "period"):
        of_slot = np.take_along_axis(few[f"attractor_{name}"], np.maximum(own, 0)[None], axis=0)[0]
        assert np.array_equal(of_slot[own >= 0], few[name][own >= 0]), name


def test_the_summary_tells_it(known_file):
    cells = read(known_file)
    known = without_share(cells)
    free = (known & (cells["attractor_regime"] == NO_IMPACT)).any(axis=0).sum()
    hits = (known & np.isin(cells["attractor_regime"], (PERIODIC, CHAOTIC))).any(axis=0).sum()
    words = f"known, though no start ended on it: a motion without impacts in {free:,} cells, one with impacts in {hits:,} cells"
    assert words in (known_file.parent / "summary.txt").read_text()
