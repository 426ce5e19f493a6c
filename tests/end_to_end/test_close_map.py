"""What tests/endurance/arm.sh compares maps with: it must see a wrong label and a wrong force, and let pass what isn't verified."""

import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

COMPARE = Path(__file__).parents[1] / "endurance/close_map.py"


@pytest.fixture
def told(tmp_path):
    """Changes one map of two equal ones, of four orbits, and returns what is said of it, with the exit code."""
    def change_and_compare(change):
        for name in ("file", "expected"):
            with h5py.File(tmp_path / name, "w") as file:
                file.attrs["arithmetic"] = name
                for label in ("regime", "impacts", "period"):
                    file[label] = np.ones((2, 2), int)
                file["status"] = np.zeros((2, 2), int)
                file["peak_force_ratio"] = np.full((2, 2), 300.0)
                if name == "file":
                    change(file)
        done = subprocess.run([sys.executable, COMPARE, tmp_path / "file", tmp_path / "expected"], capture_output=True, text=True,
                              check=False)
        assert done.stderr == ""
        return done.returncode, done.stdout
    return change_and_compare


def put(name, value):
    def change(file):
        file[name][0, 1] = value
    return change


def test_equal_maps_agree(told):
    code, words = told(lambda file: None)
    assert code == 0 and "of 4 cells 0 have another label" in words and "blows of 4 settled motions to 0e+00" in words


@pytest.mark.parametrize("name", ["regime", "impacts", "period"])
def test_another_label_is_found(told, name):
    code, words = told(put(name, 2))
    assert code == 1 and "of 4 cells 1 have another label" in words


@pytest.mark.parametrize("ratio, code", [(1 + 1e-10, 0), (1 + 3e-9, 1), (np.nan, 1)])
def test_another_force_is_found(told, ratio, code):
    assert told(put("peak_force_ratio", 300 * ratio))[0] == code


@pytest.mark.parametrize("status", [1, 6], ids=["budget", "rounding"])
def test_a_label_that_is_not_verified_may_differ(told, status):
    def change(file):
        put("status", status)(file)
        put("regime", 2)(file)
    code, words = told(change)
    assert code == 0 and "0 have another label" in words and "1 of the 1 others" in words


def test_missing_variables_are_found(told):
    assert told(lambda file: file.__delitem__("peak_force_ratio"))[0] == 1
