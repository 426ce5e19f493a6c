"""Two units, one coordinate, for faulty jobs and those without a counterpart; computed results: test_axes_and_units.py."""

import h5py
import pytest

import either_unit
import jobs
import launch
from either_unit import FEATURES, SI


def test_a_unit_that_changes_from_cell_to_cell_has_no_twin(tmp_path):
    text = (either_unit.rig("map") + jobs.axis("frequency_hz", 5, 9, 3) + jobs.axis("hammer.natural_frequency_hz", 4, 5, 3)
            + "[operating_point]\ngap_m = 1e-3\n")
    jobs.write(tmp_path, text)
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    with h5py.File(tmp_path / "job.h5", "r") as file:
        assert "frequency_hz" in file and "frequency_ratio" not in file


@pytest.mark.parametrize("more, key", [
    ("[start]\nvelocity_ratio = 1\nvelocity_m_per_s = 1\n", "start.velocity_ratio and velocity_m_per_s"),
    ("[starts]\ncount = 2\ndisplacement_m = [-1e-3, 0.0]\ndisplacement_ratio = [-1, 0]\n",
     "starts.displacement_ratio and displacement_m"),
    ("[curves]\ngap_ratio = [1.0]\ngap_m = [1e-3]\n", "curves.gap_ratio and gap_m"),
])
def test_never_both_units_at_once(tmp_path, more, key):
    jobs.write(tmp_path, jobs.small_map() + more)
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 2 and f"{key} are both given" in checked.stderr


@pytest.mark.parametrize("text, words", [
    (FEATURES["basin"](SI) + jobs.axis("velocity_ratio", -1, 1, 3), "[axes.velocity_m_per_s] says the same as [axes.velocity_ratio]"),
    (FEATURES["map"](SI).replace("-0.0002225", "2e9"), "start.displacement_m"),
    (jobs.with_rigid_stop(FEATURES["map"](SI)).replace("displacement_m = -0.0002225", "displacement_m = 0.001"),
     "start.displacement_m = 0.001 lies beyond a rigid stop at the lowest axes.gap_m = 0"),
])
def test_faults_speak_in_the_units_of_the_job(tmp_path, text, words):
    jobs.write(tmp_path, text)
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 2 and words in checked.stderr, checked.stderr
