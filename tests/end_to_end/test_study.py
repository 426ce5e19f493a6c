"""Studies: identical at any number of ranks, readable by xarray, and with correct numbers."""

import shutil

import h5py
import numpy as np
import pytest
import xarray

import jobs
import launch
import map_contents

pytestmark = pytest.mark.thorough


def compute(folder, text, *arguments, ranks=None):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", *arguments, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished


@pytest.fixture(scope="module")
def precision_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("precision"), jobs.small_precision_study())[0]


@pytest.fixture(scope="module")
def label_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("labels"), jobs.small_label_study())[0]


@pytest.fixture(scope="module")
def stability(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("stability"), jobs.stability_study(), ranks=2)


@pytest.mark.parametrize("ranks", [2, 7])
def test_a_study_of_precision_is_the_same_at_any_number_of_ranks(tmp_path, precision_file, ranks):
    path, _ = compute(tmp_path, jobs.small_precision_study(), "--quiet", ranks=ranks)
    map_contents.assert_same_map(path, precision_file)


@pytest.mark.parametrize("ranks", [2, 7])
def test_a_study_of_labels_is_the_same_at_any_number_of_ranks(tmp_path, label_file, ranks):
    path, _ = compute(tmp_path, jobs.small_label_study(), "--quiet", ranks=ranks)
    map_contents.assert_same_map(path, label_file)


def words(variable):
    """The values of a variable of classes, in words."""
    meaning = dict(zip(variable.attrs["flag_values"], variable.attrs["flag_meanings"].split()))
    return np.vectorize(lambda value: meaning[value])(variable.values)


def trials(data, method, setting=None):
    chosen = words(data.method) == method
    if setting is not None:
        chosen &= data.setting.values == setting
    assert chosen.any()
    return data.isel(trial=np.flatnonzero(chosen))


def test_precision_opens_in_xarray(precision_file):
    data = xarray.open_dataset(precision_file)
    run = xarray.open_dataset(precision_file, group="run")
    assert data.attrs["peterka_kind"] == "study" and data.attrs["topic"] == "work_precision"
    assert data.error_peak_force.dims == ("trial", "cell") and data.gap_ratio.dims == ("cell",)
    assert run.seconds_per_cycle.dims == ("trial", "cell")
    assert (run.seconds_per_cycle.values > 0).all()
    assert (words(data.outcome) == "done").all()
    # the model with the paper's parameters gives 235 N at 9 Hz, gap 0
    assert data.reference_peak_force_ratio.values[0] * 0.298 * 9.80665 == pytest.approx(235, abs=0.5)


def test_the_exact_engine_is_exact_and_integrators_keep_their_tolerance(precision_file):
    data = xarray.open_dataset(precision_file)
    exact = trials(data, "exact")
    assert exact.error_peak_force.max() < 1e-11
    assert exact.error_state.max() < 1e-11 and exact.error_impact_time.max() < 1e-12
    for method in ["cvode_adams", "cvode_bdf", "arkode_explicit", "arkode_implicit"]:
        for tolerance in [1e-4, 1e-8]:
            assert trials(data, method, tolerance).error_peak_force.max() < 3 * tolerance, method


def test_the_batched_engine_is_as_exact_as_its_twin(precision_file):
    data = xarray.open_dataset(precision_file)
    batched = trials(data, "batched")
    assert batched.error_peak_force.max() < 1e-11 and batched.error_state.max() < 1e-11
    assert np.isnan(batched.error_impact_time.values).all(), "it doesn't tell when an impact was"
    seconds = xarray.open_dataset(precision_file, group="run").seconds_per_cycle
    assert len(set(seconds[np.flatnonzero(words(data.method) == "batched")].values.ravel())) == 1, "one batch"


def test_fixed_steps_have_order_four_with_events_and_lose_it_without(precision_file):
    data = xarray.open_dataset(precision_file)
    coarse, fine = (trials(data, "rk4_with_events", steps).error_state.values[0] for steps in (2000, 8000))
    np.testing.assert_allclose(np.log(coarse / fine) / np.log(4), 4, atol=0.5)
    without = trials(data, "rk4_without_events", 8000).error_peak_force.values[0]
    assert (without > 1e4 * trials(data, "rk4_with_events", 8000).error_peak_force.values[0]).all()


@pytest.mark.parametrize("form", ["relative", "absolute"])
def test_a_cubic_spring_is_kept_by_splitting_and_missed_by_the_closed_form(tmp_path, form):
    cubic = ["--set", "hammer.cubic_stiffness_n_per_m3=238230.0", "--set", f"hammer.cubic={form}"]
    path, _ = compute(tmp_path, jobs.small_precision_study(), "--quiet", *cubic)
    data = xarray.open_dataset(path)
    assert 1e-3 < trials(data, "exact").error_peak_force.max() < 1
    assert trials(data, "split", 1e-4).error_peak_force.max() < 1e-4
    for method in ["cvode_adams", "cvode_bdf", "arkode_explicit", "arkode_implicit"]:
        assert trials(data, method, 1e-8).error_peak_force.max() < 3e-8, method


def test_labels_hang_on_tolerance_and_the_exact_run_is_the_reference(label_file):
    data = xarray.open_dataset(label_file)
    assert int(data.cells) == 81
    assert words(data.method)[int(data.reference_trial)] == "exact"
    assert trials(data, "exact").changed_share.values[0] == 0
    for method in ["cvode_adams", "arkode_explicit"]:
        assert trials(data, method, 1e-7).changed_share.values[0] <= 2 / 81
    assert (data.unproved_share.values <= 0.1).all()


def test_labels_are_those_of_a_map(tmp_path, label_file):
    """The share of unproved cells of the exact engine, from a map of the same cells."""
    jobs.write(tmp_path, jobs.small_map(columns=9, rows=9))
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    regimes = h5py.File(tmp_path / "job.h5")["regime"][()]
    share = trials(xarray.open_dataset(label_file), "exact").unproved_share.values[0]
    assert share == np.isin(regimes, [4, 5]).mean()


def test_no_engine_is_wrong_in_the_battery(stability):
    path, finished = stability
    data = xarray.open_dataset(path)
    outcome = words(data.outcome)
    names = data.scene.attrs["flag_meanings"].split()
    wrong = [(names[scene], engine) for scene, engine in zip(*np.nonzero(outcome == "wrong"))]
    assert wrong == []
    assert "0 wrong" in finished.stdout
    assert len(set(names)) == len(names) >= 50
    agreeing = (outcome == "agrees").sum(axis=0)
    assert (agreeing > 35).all(), agreeing
    # motions that never settle are reported
    for scene in ["conservative", "secular_growth"]:
        row = names.index(scene)
        told = outcome[row][outcome[row] != "not_for_this_scene"]
        assert (told == "says_why_not").all()
        assert set(words(data.regime)[row]) == {"unresolved"}
    assert set(words(data.status)[names.index("conservative")][:2]) == {"conservative"}


def test_the_exact_engine_keeps_energy_and_errors_stay_in_bounds(stability):
    data = xarray.open_dataset(stability[0])
    outcome = words(data.outcome)
    agrees = outcome[:, 0] == "agrees"
    balance = np.abs(data.energy_imbalance.values[agrees, 0])
    assert np.nanmax(balance) < 1e-10 and np.isfinite(balance).sum() > 30
    settled = agrees & (words(data.regime)[:, 0] == "periodic")
    assert np.nanmax(data.error_peak_force.values[settled, 0]) < 1e-7


def test_stiff_stops_tend_to_the_rigid_one(stability):
    data = xarray.open_dataset(stability[0])
    assert float(data.fitted_slope) == pytest.approx(-0.5, abs=0.01)
    assert (np.diff(np.abs(data.speed_difference.values)) < 0).all()


def test_a_complete_study_is_left_alone_and_another_job_is_refused(tmp_path, precision_file):
    jobs.write(tmp_path, jobs.small_precision_study())
    shutil.copy(precision_file, tmp_path / "job.h5")
    before = (tmp_path / "job.h5").read_bytes()
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    assert "job.h5 is complete" in finished.stdout
    refused = launch.run("run", "job.toml", "--set", "study.cycles=21", cwd=tmp_path)
    assert refused.returncode == 3
    assert "study.cycles: 20 in the file, 21 in the job" in refused.stderr
    assert (tmp_path / "job.h5").read_bytes() == before
    fresh = launch.run("run", "job.toml", "--set", "study.cycles=21", "--fresh", cwd=tmp_path)
    assert fresh.returncode == 0, fresh.stderr
    assert h5py.File(tmp_path / "job.h5").attrs["job"].count("cycles = 21") == 1


@pytest.mark.parametrize("ranks", [None, 3])
def test_a_stopped_study_leaves_no_file_and_says_so(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_precision_study())
    finished = launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 5
    said = [line for line in launch.messages(finished) if "stopped early" in line]
    assert len(said) == 1 and "starts over" in said[0]
    assert list(tmp_path.glob("*.h5*")) == []


def test_a_study_does_not_overwrite_what_is_not_its_own(tmp_path):
    jobs.write(tmp_path, jobs.small_precision_study())
    (tmp_path / "job.h5").write_text("my notes")
    finished = launch.run("run", "job.toml", "--fresh", cwd=tmp_path)
    assert finished.returncode == 3
    assert (tmp_path / "job.h5").read_text() == "my notes"


def test_check_tells_the_number_of_runs(tmp_path):
    jobs.write(tmp_path, jobs.small_precision_study())
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 0
    assert "runs     28," in checked.stdout  # 2 cells, and exact, batched, 4 integrators at 2 tolerances, 2 with 2 steps
    assert list(tmp_path.glob("*.h5*")) == []
