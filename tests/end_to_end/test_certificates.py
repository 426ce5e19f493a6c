"""Proofs of a map's cells: their record in the file, that each force lies
within its bounds, and independence of the bytes from the number of ranks."""

import h5py
import numpy as np
import pytest

import jobs
import launch
import many_starts

ORBIT, START, NOT_TRIED = 1, 2, 0
EMPTY = -128
ROUNDING = 6  # of `status`
POINTS = 24


def text(cells):
    return (jobs.RIG.format(kind="map", title="proofs") + jobs.axis("frequency_ratio", 0.5, 4.5, POINTS)
            + jobs.axis("gap_ratio", 0.0, 5.0, POINTS) + f"[certificate]\ncells = {cells}\n")


@pytest.fixture(scope="module")
def all_cells(tmp_path_factory):
    folder = tmp_path_factory.mktemp("proofs")
    jobs.write(folder, text('"all"'))
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished.stdout


def read(path):
    with h5py.File(path) as file:
        return {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}


def test_nearly_all_settled_cells_are_proved_and_their_forces_within_the_bounds(all_cells):
    cells = read(all_cells[0])
    settled = np.isin(cells["regime"], (0, 1, 3))
    proved = cells["certified"] > NOT_TRIED
    assert np.all(cells["certified"][~settled] == NOT_TRIED)
    assert np.count_nonzero(proved) > 0.97 * np.count_nonzero(settled)
    assert np.all((cells["certified"] == START) <= (cells["regime"] == 0))
    force = cells["peak_force_ratio"][proved]
    assert np.all(force >= cells["peak_force_lower_ratio"][proved] * (1 - 1e-3))
    assert np.all(force < cells["peak_force_upper_ratio"][proved] * (1 + 1e-3) + 1e-12)
    assert np.all(cells["stability_margin"][proved] > 0)
    assert np.all(np.isnan(cells["stability_margin"][~proved]))


def test_the_summary_counts_them(all_cells):
    path, words = all_cells
    certified = read(path)["certified"]
    assert f"proved              {np.count_nonzero(certified > NOT_TRIED)} (" in words


def test_a_number_of_cells_is_drawn(tmp_path):
    jobs.write(tmp_path, text(30))
    assert launch.run("run", "job.toml", cwd=tmp_path).returncode == 0
    cells = read(tmp_path / "job.h5")
    tried = np.count_nonzero(cells["certified"] != NOT_TRIED)
    assert 20 < tried <= 30


def test_two_ranks_give_the_same_bytes(all_cells, tmp_path):
    jobs.write(tmp_path, text('"all"'))
    assert launch.run("run", "job.toml", cwd=tmp_path, ranks=2).returncode == 0
    one, two = read(all_cells[0]), read(tmp_path / "job.h5")
    assert all(one[name].tobytes() == two[name].tobytes() for name in one)


def test_a_rigid_stop_has_bounds_of_the_speed_and_none_of_the_force(tmp_path):
    jobs.write(tmp_path, jobs.with_rigid_stop(text('"all"')) + '[output]\nfields = ["impact_speed", "orbit"]\n')
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    cells = read(tmp_path / "job.h5")
    settled = np.isin(cells["regime"], (0, 1, 3))
    proved = cells["certified"] > NOT_TRIED
    assert np.count_nonzero(proved) > 0.97 * np.count_nonzero(settled)
    ends_in_rest = proved & (cells["chatter"] == 1)
    assert np.all((cells["stability_margin"] == 1) == ends_in_rest) and np.count_nonzero(ends_in_rest) > 3
    assert np.all(np.isnan(cells["peak_force_lower_ratio"][proved & (cells["regime"] == 1)]))
    speed, lower, upper = (cells[name][proved] for name in ("impact_speed", "impact_speed_lower", "impact_speed_upper"))
    assert np.all((lower <= speed * (1 + 1e-3)) & (speed * (1 - 1e-3) <= upper) & (upper - lower <= 1e-7 * upper))
    assert np.all(np.isnan(cells["impact_speed_lower"][~proved]))
    assert "m/s of an impact, of the cells that are proved" in finished.stdout


@pytest.mark.parametrize("rigid", [False, True])
def test_starts_are_proved_to_lead_to_the_orbits_of_their_cells(tmp_path, rigid):
    """And decide the label where rounding might have."""
    plain = text('"all"') + '[output]\nfields = ["sensitivity"]\n'
    paths = {}
    for name, job in (("plain", plain), ("proved", plain.replace("[certificate]", "[certificate]\nstarts = true"))):
        (tmp_path / f"{name}.toml").write_text(jobs.with_rigid_stop(job) if rigid else job)
        finished = launch.run("run", f"{name}.toml", cwd=tmp_path, ranks=2 if name == "proved" else 1)
        assert finished.returncode == 0, finished.stderr
        paths[name] = read(tmp_path / f"{name}.h5")
    without, cells = paths["plain"], paths["proved"]
    changed = {name for name in without if not name.startswith(("summary", "tiles")) and without[name].tobytes() != cells[name].tobytes()}
    assert changed <= {"certified", "status"} and "certified" in changed
    proved, start = cells["certified"] >= ORBIT, cells["certified"] == START
    assert np.array_equal(proved, without["certified"] >= ORBIT) and np.all(start[without["certified"] == START])
    periodic = proved & (cells["regime"] == 1) & (cells["sensitivity"] < 20)
    assert np.count_nonzero(periodic) > 100 and np.count_nonzero(start & periodic) > 0.95 * np.count_nonzero(periodic)
    said = f"{np.count_nonzero(proved):,} ({100 * np.count_nonzero(proved) / np.count_nonzero(cells['certified']):.1f} %), in {np.count_nonzero(start):,} that the start leads there, too"
    assert said in finished.stdout, finished.stdout
    assert not np.any(cells["status"][start] == ROUNDING)


def test_a_chatter_is_proved_where_rounding_leaves_a_chain_of_bounces(tmp_path):
    """On each of these cells the hammer comes to rest on the stop once a cycle; some were refused as ones with another label."""
    job = (jobs.with_rigid_stop(jobs.RIG.format(kind="map", title="chatter")).replace("coefficient = 0.5", "coefficient = 0.3")
           + jobs.axis("frequency_ratio", 0.8, 0.88, 161) + jobs.axis("gap_ratio", -0.2, 0.2, 5)
           + '[start]\ndisplacement_ratio = -1.0\n[certificate]\ncells = "all"\n')
    (tmp_path / "job.toml").write_text(job)
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    cells = read(tmp_path / "job.h5")
    assert np.all(cells["certified"][cells["chatter"] == 1] >= ORBIT) and np.count_nonzero(cells["chatter"] == 1) > 400


@pytest.mark.thorough
def test_many_digits_settle_labels_that_rounding_decides(tmp_path):
    """On the way of some of these starts errors grow by e^20 to e^60."""
    job = (jobs.RIG.format(kind="map", title="digits") + jobs.axis("frequency_ratio", 1.85, 2.2, 8) + jobs.axis("gap_ratio", 1.4, 1.9, 8)
           + '[certificate]\ncells = "all"\nstarts = true\nmany_digits = {}\n')
    read_with = {}
    for digits, ranks in (("false", 1), ("true", 2)):
        (tmp_path / f"{digits}.toml").write_text(job.format(digits))
        finished = launch.run("run", f"{digits}.toml", cwd=tmp_path, ranks=ranks)
        assert finished.returncode == 0, finished.stderr
        read_with[digits] = read(tmp_path / f"{digits}.h5")
    doubles, digits = read_with["false"], read_with["true"]
    changed = {name for name in doubles if not name.startswith(("summary", "tiles")) and doubles[name].tobytes() != digits[name].tobytes()}
    assert changed == {"certified", "status"}
    settled = (doubles["status"] == ROUNDING) & (digits["status"] == 0)
    assert np.count_nonzero(settled) > 3 and np.all(digits["certified"][settled] == START)
    assert np.all(doubles["certified"][settled] == ORBIT) and np.all(digits["certified"][doubles["certified"] == START] == START)


PLACE = {"frequency_ratio": 2.057894736842105, "gap_ratio": 1.5789473684210527}


def solved_at_place(folder, name, more="", digits="true", kind="map", axes=None):
    """The datasets of the cell where rounding leads to no impact, and the exact motion to 2/3."""
    axes = axes or {axis: (value, value, 1) for axis, value in PLACE.items()}
    (folder / f"{name}.toml").write_text(
        jobs.RIG.format(kind=kind, title="led elsewhere") + "".join(jobs.axis(axis, *values) for axis, values in axes.items()) + more
        + f'[certificate]\ncells = "all"\nstarts = {digits}\nmany_digits = {digits}\n')
    finished = launch.run("run", f"{name}.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return {key: np.squeeze(value) for key, value in read(folder / f"{name}.h5").items()}


def test_a_label_is_that_of_the_motion_to_which_the_start_is_proved_to_lead(tmp_path):
    """An integrator of 113 bits finds 2/3 from this start, with the job's exact numbers."""
    fields = '[output]\nfields = ["critical_kick", "last_impact", "multiplier", "orbit", "sensitivity"]\n'
    led = solved_at_place(tmp_path, "led", fields, "false")
    assert (led["regime"], led["status"]) == (0, ROUNDING) and led["last_impact"] > 0
    proved = solved_at_place(tmp_path, "proved", fields)
    assert (proved["regime"], proved["impacts"], proved["period"]) == (1, 2, 3)
    assert (proved["status"], proved["certified"], proved["last_impact"]) == (0, START, -1)
    assert proved["sensitivity"] == led["sensitivity"] > 20 and proved["cycles"] > led["cycles"]
    force = proved["peak_force_ratio"]
    assert proved["peak_force_lower_ratio"] * (1 - 1e-9) < force < proved["peak_force_upper_ratio"] * (1 + 1e-9)
    assert 0 < proved["multiplier"] < 1 and proved["critical_kick"] > 0 and np.isnan(led["critical_kick"])
    from_orbit = solved_at_place(tmp_path, "from_orbit", fields + f'[start]\ndisplacement_ratio = {float(proved["orbit_displacement"])!r}\n'
                                 f'velocity_ratio = {float(proved["orbit_velocity"] + PLACE["frequency_ratio"])!r}\n')
    for name in ("regime", "impacts", "period", "certified"):
        assert from_orbit[name] == proved[name]
    for name in ("peak_force_ratio", "multiplier", "critical_kick", "impact_rate"):
        assert from_orbit[name] == pytest.approx(proved[name], rel=1e-6)
    without_fields = solved_at_place(tmp_path, "without_fields")
    for name in ("regime", "impacts", "period", "certified", "status", "peak_force_ratio"):
        assert without_fields[name] == proved[name]


def test_a_start_proved_to_lead_elsewhere_names_its_attractor(tmp_path):
    led = solved_at_place(tmp_path, "led", many_starts.table(16), "false")
    proved = solved_at_place(tmp_path, "proved", many_starts.table(16))
    for name in ("attractors", "attractor_regime", "attractor_impacts", "attractor_period", "attractor_peak_force_ratio", "basin_share"):
        assert np.array_equal(led[name], proved[name], equal_nan=True), name
    slot = proved["start_attractor"]
    assert led["start_attractor"] != slot and led["attractor_regime"][led["start_attractor"]] == 0
    assert (proved["attractor_impacts"][slot], proved["attractor_period"][slot]) == (2, 3)
    assert proved["attractor_peak_force_ratio"][slot] == pytest.approx(proved["peak_force_ratio"], rel=1e-9)


def test_a_point_of_a_sweep_is_that_to_which_its_start_is_proved_to_lead(tmp_path):
    at = PLACE["frequency_ratio"]
    sweep = f'[sweep]\ngap_ratio = [{PLACE["gap_ratio"]}]\ndirection = "independent"\nsamples = 8\n'
    led, proved = (solved_at_place(tmp_path, name, sweep, digits, "sweep", {"frequency_ratio": (at, at + 0.025, 6)})
                   for name, digits in (("led", "false"), ("proved", "true")))
    assert led["regime"][0] == 0 and np.all(led["certified"][1:3] >= ORBIT)
    assert (proved["impacts"][0], proved["period"][0], proved["certified"][0], proved["status"][0]) == (2, 3, START, 0)
    assert np.count_nonzero(np.isfinite(proved["impact_velocity"][0])) > np.count_nonzero(np.isfinite(led["impact_velocity"][0]))
    assert len(np.unique(np.round(proved["stroboscopic_displacement"][0], 6))) == 3 + np.any(np.isnan(proved["stroboscopic_displacement"][0]))
    assert np.flatnonzero(led["jump"]).tolist() == [1, 3] and np.flatnonzero(proved["jump"]).tolist() == [3]


def test_starts_of_a_basin_are_proved_to_lead_to_its_attractors(tmp_path):
    jobs.write(tmp_path, jobs.small_basin() + '[certificate]\ncells = "all"\nstarts = true\n')
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    cells = read(tmp_path / "job.h5")
    start = cells["certified"] == START
    assert np.count_nonzero(start) > 0.9 * np.count_nonzero(cells["certified"] >= ORBIT)
    assert len(np.unique(cells["attractor"][start])) > 1


def of_attractors(points=20, count=8, more=""):
    """With few starts, so that motions known to a cell from those beside it are among its attractors."""
    return (jobs.RIG.format(kind="map", title="proofs of attractors") + jobs.axis("frequency_ratio", 1.5, 4.0, points)
            + jobs.axis("gap_ratio", 0.5, 3.0, points) + many_starts.table(count)
            + '[certificate]\ncells = "all"\nattractors = true\n' + more)


@pytest.fixture(scope="module")
def attractors(tmp_path_factory):
    """(datasets of the map, what the run said, its file)"""
    folder = tmp_path_factory.mktemp("attractors")
    jobs.write(folder, of_attractors())
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return read(folder / "job.h5"), finished.stdout, folder / "job.h5"


def in_use(cells):
    return cells["attractor_regime"] != EMPTY


def test_nearly_all_attractors_are_proved_and_their_forces_within_the_bounds(attractors):
    cells = attractors[0]
    certified, regime = cells["attractor_certified"], cells["attractor_regime"]
    assert np.array_equal(certified == EMPTY, ~in_use(cells))
    settled = np.isin(regime, (0, 1, 3))
    assert np.all(certified[in_use(cells) & ~settled] == NOT_TRIED)
    proved = certified == ORBIT
    assert np.count_nonzero(certified > ORBIT) == 0
    assert np.count_nonzero(proved) > 0.97 * np.count_nonzero(settled)
    assert np.count_nonzero(proved & (regime == 1)) > 250
    without_share = settled & (cells["basin_share"] == 0)
    assert np.count_nonzero(without_share & proved) > 0.95 * np.count_nonzero(without_share) > 30
    force = cells["attractor_peak_force_ratio"][proved]
    assert np.all(force >= cells["attractor_peak_force_lower_ratio"][proved] * (1 - 1e-3))
    assert np.all(force < cells["attractor_peak_force_upper_ratio"][proved] * (1 + 1e-3) + 1e-12)
    assert np.all(cells["attractor_stability_margin"][proved] > 0)
    assert np.all(np.isnan(cells["attractor_stability_margin"][~proved]))


def test_the_attractor_of_the_start_is_proved_as_the_cell_is(attractors):
    cells = attractors[0]
    rows, columns = np.nonzero(cells["start_attractor"] >= 0)
    slots = cells["start_attractor"][rows, columns]
    both = (cells["certified"][rows, columns] > NOT_TRIED) & (cells["attractor_certified"][slots, rows, columns] > NOT_TRIED)
    assert np.count_nonzero(both) > 300
    of_cell, of_slot = (cells[name][index] for name, index in (
        ("peak_force_upper_ratio", (rows[both], columns[both])),
        ("attractor_peak_force_upper_ratio", (slots[both], rows[both], columns[both]))))
    np.testing.assert_allclose(of_slot, of_cell, rtol=1e-9)


def test_the_summary_counts_attractors(attractors):
    cells, words, _ = attractors
    certified = cells["attractor_certified"]
    tried, proved = np.count_nonzero((certified != NOT_TRIED) & in_use(cells)), np.count_nonzero(certified == ORBIT)
    assert f"of {tried:,} attractors\n  proved              {proved:,} (" in words, words
    assert "of the attractors that are proved" in words


def test_attractors_are_the_same_bytes_on_two_ranks_and_after_a_stop(tmp_path):
    one = many_starts.compute(tmp_path, of_attractors(10), name="one")
    jobs.write(tmp_path, of_attractors(10))
    stopped = launch.run("run", "job.toml", "--max-wall", "0.05", cwd=tmp_path)
    assert stopped.returncode in (0, 5), stopped.stderr
    assert launch.run("run", "job.toml", cwd=tmp_path, ranks=2).returncode == 0
    two = read(tmp_path / "job.h5")
    assert np.count_nonzero(one["attractor_certified"] == ORBIT) > 50
    assert all(one[name].tobytes() == two[name].tobytes() for name in one)


def test_other_datasets_are_those_of_the_map_without_proofs_of_attractors(attractors, tmp_path):
    jobs.write(tmp_path, of_attractors().replace("attractors = true\n", ""))
    assert launch.run("run", "job.toml", cwd=tmp_path).returncode == 0
    plain, cells = read(tmp_path / "job.h5"), attractors[0]
    assert {name for name in cells if name not in plain} == {
        "attractor_certified", "attractor_peak_force_lower_ratio", "attractor_peak_force_upper_ratio", "attractor_stability_margin"}
    assert all(plain[name].tobytes() == cells[name].tobytes() for name in plain)


def test_attractors_on_a_rigid_stop_have_bounds_of_their_speed(tmp_path):
    jobs.write(tmp_path, jobs.with_rigid_stop(of_attractors(10)))
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    cells = read(tmp_path / "job.h5")
    periodic = (cells["attractor_certified"] == ORBIT) & (cells["attractor_regime"] == 1)
    lower, upper = (cells[f"attractor_impact_speed_{side}"][periodic] for side in ("lower", "upper"))
    assert np.count_nonzero(periodic) > 50 and np.all((0 < lower) & (lower <= upper))
    assert np.all(np.isnan(cells["attractor_peak_force_upper_ratio"][periodic]))


def test_a_refined_map_has_no_proofs_of_filled_attractors(tmp_path):
    jobs.write(tmp_path, of_attractors(33, more="[refine]\nlevels = 2\n"))
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    cells = read(tmp_path / "job.h5")
    filled = (cells["computed"] == 0) & in_use(cells)
    assert np.count_nonzero(filled & (cells["basin_share"] > 0)) > 0
    assert np.all(cells["attractor_certified"][filled & (cells["basin_share"] > 0)] == EMPTY)
    assert np.all(cells["attractor_certified"][in_use(cells) & (cells["computed"] == 1)] != EMPTY)


def test_check_tells_the_price_of_each_kind_of_proof(tmp_path):
    def told(text):
        jobs.write(tmp_path, text)
        checked = launch.run("check", "job.toml", cwd=tmp_path)
        assert checked.returncode == 0, checked.stderr
        return [line for line in checked.stdout.splitlines() if line.startswith("#   proofs ")]
    assert len(told(text('"all"'))) == 1
    of_cells, of_slots = told(of_attractors())
    assert "of 400 cells: " in of_cells and "8 are kept at most" in of_slots
    borders = jobs.small_curves(points=8) + '[curves]\ngap_ratio = [0.5, 1.0]\n[certificate]\ncells = "all"\n'
    assert told(borders) == ["#   proofs   of each place where a curve has one of the 2 gaps: some 8.0 ms of one core"]
    assert told(borders.replace("[0.5, 1.0]", "[0.5]"))[0].startswith("#   proofs   of each place where a curve has the gap: some ")
    assert told(borders.replace('"all"', "0")) == []
    assert len(told(text('"all"') + "[curves]\ngap_ratio = [0.5]\n")) == 2
