"""Cells that no engine can follow fail individually: they state the reason, the others are unaffected."""

import h5py
import numpy
import pytest

import jobs
import launch

FAILED, TOO_MANY_EVENTS, SOLVER_FAILED = 5, 3, 5
REASONS = {TOO_MANY_EVENTS: "too many contacts in one cycle", SOLVER_FAILED: "the integrator gave up"}


@pytest.mark.thorough
@pytest.mark.parametrize("engine, cubic, status", [
    ("exact", 0, TOO_MANY_EVENTS),  # in a batch
    ("split", 238, TOO_MANY_EVENTS),
    ("cvode", 238, SOLVER_FAILED),  # step sizes shrink to zero
    ("arkode", 238, SOLVER_FAILED),
])
def test_each_engine(tmp_path, engine, cubic, status):
    jobs.write(tmp_path, jobs.small_map(columns=2, rows=2))
    settings = [word for setting in (f"solver.engine={engine}", f"hammer.cubic_stiffness_n_per_m3={cubic}",
                                     "solver.tolerance=1e-6") for word in ("--set", setting)]
    sticky = ["--set", "contact.damping_ns_per_m=1e30"]  # contact with such a stop never ends
    finished = launch.run("run", "job.toml", *settings, *sticky, "--output", "sticky.h5", cwd=tmp_path)
    assert finished.returncode == 4, finished.stderr
    assert REASONS[status] in finished.stdout
    assert launch.run("run", "job.toml", *settings, "--output", "sound.h5", cwd=tmp_path).returncode == 0

    with h5py.File(tmp_path / "sticky.h5") as sticky, h5py.File(tmp_path / "sound.h5") as sound:
        failed = sticky["regime"][:] == FAILED
        assert failed.any() and not failed.all()
        assert (sticky["status"][:][failed] == status).all()
        assert numpy.isnan(sticky["peak_force_ratio"][:][failed]).all()
        assert numpy.isnan(sticky["impact_rate"][:][failed]).all()
        untouched = sound["impact_rate"][:] == 0  # cells without any contact
        assert untouched.any() and not (untouched & failed).any()
        for name in ["regime", "status", "engine", "period", "peak_force_ratio"]:
            assert (sticky[name][:][untouched] == sound[name][:][untouched]).all()


def test_as_many_as_the_job_allows_are_no_failure(tmp_path):
    jobs.write(tmp_path, jobs.small_map(columns=4, rows=4))
    sticky = ["--set", "contact.damping_ns_per_m=1e30", "--fresh"]
    assert launch.run("run", "job.toml", *sticky, cwd=tmp_path).returncode == 4
    with h5py.File(tmp_path / "job.h5") as file:
        failed = int((file["regime"][:] == FAILED).sum())
    assert 1 < failed < 16
    for allowed, code in [(failed, 0), (failed - 1, 4)]:
        finished = launch.run("run", "job.toml", *sticky, "--set", f"limits.failed_cells={allowed}", cwd=tmp_path)
        assert finished.returncode == code, finished.stderr
        assert (f"{failed} cells failed, and the job allows {allowed}" in finished.stderr) == (code == 4)
