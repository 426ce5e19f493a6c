"""An audited map: a sample of its cells is solved again by an independent engine with every term of the model."""

import h5py
import numpy as np
import pytest
import xarray

import jobs
import launch
import map_contents

pytestmark = pytest.mark.thorough

AUDIT = "[audit]\ncells = 40\n"
CUBIC = "cubic_stiffness_n_per_m3 = {}"


def audited(folder, *, ranks=2, extra=()):
    jobs.write(folder, jobs.small_map() + AUDIT)
    finished = launch.run("run", "job.toml", *extra, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished.stdout


@pytest.fixture(scope="module")
def audited_map(tmp_path_factory):
    return audited(tmp_path_factory.mktemp("audited"))


def test_the_independent_engine_agrees(audited_map):
    file, summary = audited_map
    with xarray.open_dataset(file, group="audit") as audit:
        assert len(np.unique(audit.cell)) == 40
        assert set(audit.engine.values) == {3}  # arkode, while the map is solved in closed form
        assert audit.agreeing_labels >= 0.95  # a few cells may lie on a boundary
        assert np.isfinite(audit.force_error).sum() > 8
        assert audit.force_error_median < 1e-9  # the integrator's tolerance
        # one cell leaves the stop so slowly that the integrator's local errors grow 200-fold in the following hop
        assert audit.force_error_largest < 1e-6
        assert "Audit: 40 cells" in summary


@pytest.mark.parametrize("columns, rows", [(1, 7), (7, 1), (1, 1)])
def test_a_single_column_or_row_is_audited(tmp_path, columns, rows):
    jobs.write(tmp_path, jobs.small_map(columns, rows) + "[audit]\ncells = 5\n")
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as file:
        assert np.all(np.isin(file["audit/agrees"][()], [0, 1])) and len(file["audit/cell"]) == min(5, columns * rows)


def test_labels_that_rounding_decides_are_told(tmp_path):
    job = (jobs.RIG.format(kind="map", title="windows in chaos") + jobs.axis("frequency_ratio", 2.2, 2.4, 6)
           + jobs.axis("gap_ratio", 1.0, 1.2, 6) + "[audit]\ncells = 36\n")
    jobs.write(tmp_path, job)
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    with h5py.File(tmp_path / "job.h5") as file:
        differs = file["audit/agrees"][()] == 0
        sensitivity = file["audit/sensitivity"][()]
    assert 0 < differs.sum() < 10
    assert np.isnan(sensitivity[~differs]).all() and (sensitivity[differs] > 20).all()
    count, words = differs.sum(), "in it" if differs.sum() == 1 else "in each"
    line = next(line for line in finished.stdout.splitlines() if "other label" in line)
    assert f"{count}: {words} a perturbation grew by e^20 or more" in line and "rounding decides" in line


def test_errors_are_those_of_the_map(audited_map):
    with h5py.File(audited_map[0]) as file:
        audit = file["audit"]
        place = audit["row"][()], audit["column"][()]
        assert np.array_equal(audit["cell"][()], place[0] * file["regime"].shape[1] + place[1])
        force = file["peak_force_ratio"][()][place]
        agrees = (file["regime"][()][place] == audit["regime"][()]) & (file["period"][()][place] == audit["period"][()])
        agrees &= file["impacts"][()][place] == audit["impacts"][()]
        assert np.array_equal(audit["agrees"][()] == 1, agrees)
        compared = agrees & (audit["regime"][()] == 1)
        error = np.abs(force[compared] / audit["peak_force_ratio"][()][compared] - 1)
        assert np.array_equal(audit["force_error"][()][compared], error)
        assert np.all(np.isnan(audit["force_error"][()][~compared]))


@pytest.mark.parametrize("ranks", [1, 7])
def test_is_the_same_at_any_number_of_ranks(tmp_path, audited_map, ranks):
    map_contents.assert_same_map(audited(tmp_path, ranks=ranks)[0], audited_map[0])


def test_sees_what_was_left_out(tmp_path):
    """A cubic spring whose effect is far above rounding, omitted by a job that permits it."""
    file, _ = audited(tmp_path, extra=["--set", "hammer.cubic_stiffness_n_per_m3=20000", "--set",
                                       "solver.omit_tolerance=1"])
    with h5py.File(file) as file:
        assert 1e-4 < file["audit/force_error_median"][()] < 0.1


def test_an_interrupted_audit_goes_on(tmp_path, audited_map):
    """As if the run had been stopped after the first audited cells: the rest is audited, the map is unchanged."""
    file, _ = audited(tmp_path)
    with h5py.File(file, "r+") as content:
        content["summary/finished"][()] = 0
        content["audit/agrees"][20:] = -128
        content["audit/force_error"][20:] = np.nan
        content["audit/cell"][20:] = -1
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(file, audited_map[0])
