"""Proofs of a map's cells: their record in the file, that each force lies
within its bounds, and independence of the bytes from the number of ranks."""

import h5py
import numpy as np
import pytest

import jobs
import launch

ORBIT, START, NOT_TRIED = 1, 2, 0
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


def test_starts_of_a_basin_are_proved_to_lead_to_its_attractors(tmp_path):
    jobs.write(tmp_path, jobs.small_basin() + '[certificate]\ncells = "all"\nstarts = true\n')
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    cells = read(tmp_path / "job.h5")
    start = cells["certified"] == START
    assert np.count_nonzero(start) > 0.9 * np.count_nonzero(cells["certified"] >= ORBIT)
    assert len(np.unique(cells["attractor"][start])) > 1
