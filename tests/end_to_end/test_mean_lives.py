"""Mean lives of settled motions under [noise]: in files of maps and sweeps, with and without [starts], in the summary, in check, and
with the same bytes on any number of ranks."""

import re

import h5py
import numpy as np
import pytest

import jobs
import launch
import postprocessing

pytestmark = pytest.mark.thorough

LIVES = ("mean_life_s", "mean_life_error_s", "mean_life_least_s")
NOISE = "[noise]\nacceleration_m_s2_per_sqrt_hz = 0.1\ncycles = 2000\n"
SETTLED = (0, 1, 3)  # of `regime`


def text(more=NOISE, kind="map", columns=5):
    second = jobs.axis("gap_ratio", 1.0, 3.0, 3) if kind == "map" else "[sweep]\ngap_ratio = [2.0]\n"
    return jobs.RIG.format(kind=kind, title="disturbed") + jobs.axis("frequency_ratio", 0.9, 2.2, columns) + second + more


def run(folder, job, ranks=1):
    jobs.write(folder, job)
    finished = launch.run("run", "job.toml", cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        return {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}, finished.stdout


@pytest.fixture(scope="module")
def with_starts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("starts")
    return run(folder, text(NOISE + "[starts]\ncount = 32\n"), ranks=2), (folder / "job.h5").read_bytes()


def check_lives(regime, life, error, least):
    settled = np.isin(regime, SETTLED)
    assert settled.any()
    assert np.all(np.isfinite(life[settled]) ^ np.isfinite(least[settled]))
    assert np.all(np.isnan(least[~settled]))
    assert np.array_equal(np.isfinite(life), np.isfinite(error))
    assert np.all(life[settled & np.isfinite(life)] > 0)
    assert np.all(least[np.isfinite(least)] > 0)


def test_each_settled_attractor_has_a_mean_life_or_a_bound(with_starts):
    cells, summary = with_starts[0]
    check_lives(cells["attractor_regime"], *(cells[name] for name in LIVES))
    settled = np.isin(cells["attractor_regime"], SETTLED)
    assert f"{np.count_nonzero(settled)} attractors followed" in summary


def test_the_bytes_are_those_of_any_number_of_ranks(with_starts, tmp_path):
    cells, _ = run(tmp_path, text(NOISE + "[starts]\ncount = 32\n"), ranks=3)
    for name, values in with_starts[0][0].items():
        if name not in ("tile_seconds",):
            assert values.tobytes() == cells[name].tobytes(), name


def test_without_starts_each_cell_tells_that_of_its_own_motion(tmp_path):
    cells, summary = run(tmp_path, text())
    check_lives(cells["regime"], *(cells[name] for name in LIVES))
    assert "motions followed" in summary
    (tmp_path / "many").mkdir()
    many, _ = run(tmp_path / "many", text(NOISE.replace("2000", "100000")))
    least, life, more = cells["mean_life_least_s"], cells["mean_life_s"], many["mean_life_s"]
    both = np.isfinite(life)
    assert both.any() and np.all(np.abs(life - more)[both] < 4 * np.hypot(cells["mean_life_error_s"], many["mean_life_error_s"])[both])
    none = np.isnan(many["mean_life_s"]) & np.isfinite(least)
    assert none.any() and np.all(least[none] < many["mean_life_least_s"][none])


@pytest.mark.parametrize("starts", ["", "[starts]\ncount = 8\n"])
def test_sweeps_tell_them_too(starts, tmp_path):
    cells, _ = run(tmp_path, text(NOISE + starts, kind="sweep", columns=4))
    check_lives(cells["attractor_regime" if starts else "regime"], *(cells[name] for name in LIVES))


def test_a_map_of_lives_is_in_small_tiles(tmp_path):
    """So that many ranks share it, and a run that stops loses little."""
    job = text(NOISE.replace("2000", "1000"), columns=7).replace("points = 3", "points = 9")
    run(tmp_path, job, ranks=3)
    with h5py.File(tmp_path / "job.h5") as file:
        assert file["regime"].chunks == (4, 4)
        assert len(file["tiles/checksum"]) == len(file["run/tile_seconds"]) == 3 * 2
    assert "% efficiency" in postprocessing.program("scaling", tmp_path, "job.h5", "--cells", "1e4", "--ranks", "8", "--formats", "png")
    (tmp_path / "refined").mkdir()
    refined, _ = run(tmp_path / "refined", job + "[refine]\nlevels = 1\n", ranks=2)
    with h5py.File(tmp_path / "job.h5") as file:
        whole = {name: file[name][()] for name in ("regime", *LIVES)}
    computed = refined["computed"] == 1
    assert 10 < np.count_nonzero(computed)
    for name, values in whole.items():
        assert values[computed].tobytes() == refined[name][computed].tobytes(), name


def test_stronger_noise_makes_lives_shorter(tmp_path):
    lives, errors = [], []
    for speed in (0.1, 0.3):
        noise = NOISE.replace("0.1", str(speed)).replace("2000", "5000")
        job = text(noise + "[starts]\ncount = 16\n").replace("from = 1.0\nto = 3.0\npoints = 3", "from = 2.0\nto = 2.0\npoints = 1")
        folder = tmp_path / str(speed)
        folder.mkdir()
        cells, _ = run(folder, job)
        lives.append(np.where(np.isin(cells["attractor_regime"], SETTLED), cells["mean_life_s"], np.nan))
        errors.append(cells["mean_life_error_s"])
    ended = [np.isfinite(of_one) for of_one in lives]
    assert ended[0].any()
    assert np.all(ended[1][ended[0]])
    weak, strong = (of_one[ended[0]] for of_one in lives)
    error = np.hypot(*(of_one[ended[0]] for of_one in errors))
    assert np.all(strong <= weak + 3 * error)  # the shortest are of a cycle or two, and hardly differ
    assert np.count_nonzero(strong < weak) > weak.size / 2


def test_a_job_without_noise_has_no_such_datasets_and_no_table(tmp_path):
    cells, summary = run(tmp_path, text(more=""))
    assert not set(LIVES) & set(cells)
    assert "noise" not in summary
    with h5py.File(tmp_path / "job.h5") as file:
        assert "noise" not in file.attrs["job"]


def test_a_motion_that_takes_too_long_to_relax_is_not_followed(tmp_path):
    slow = text().replace("damping_ns_per_m = 0.06", "damping_ns_per_m = 1e-8")
    assert slow != text()
    told, summary = run(tmp_path, slow)
    free = (told["regime"] == 0) & (told["impacts"] == 0)
    assert free.any()
    assert all(np.all(np.isnan(told[name][free])) for name in LIVES)
    none = np.isin(told["regime"], SETTLED) & np.isnan(told["mean_life_s"]) & np.isnan(told["mean_life_least_s"])
    assert f"{none.sum()} settled motions were not followed: " in summary
    assert "more than 100 forcing cycles to relax, a twentieth of noise.cycles" in summary


@pytest.mark.parametrize("job, tried", [
    (text(), "15 cells"), (text(NOISE + "[starts]\ncount = 8\n"), "15 cells"), (text(kind="sweep"), "10 points"),
    (text(NOISE + "[starts]\ncount = 8\n", kind="sweep"), "10 points"), (text().replace("[noise]", '[solver]\nengine = "cvode"\n[noise]'), None)])
def test_check_tries_what_they_cost(tmp_path, job, tried):
    jobs.write(tmp_path, job)
    told = launch.run("check", "job.toml", cwd=tmp_path).stdout
    cost, places = re.search(r"#   noise    lives of settled motions: some (.+?) of one core more, .+? to .+?, by (\d+ \w+) tried here", told).groups()
    assert re.search("[1-9]", cost) and (places == tried or tried is None), told


def test_check_says_nothing_of_lives_without_noise(tmp_path):
    jobs.write(tmp_path, text(more=""))
    assert "#   noise" not in launch.run("check", "job.toml", cwd=tmp_path).stdout
