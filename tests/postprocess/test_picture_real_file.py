"""Pictures of files written by the real program: its layout is the one that the pictures expect."""

import os
import subprocess
from pathlib import Path

import pytest

pytestmark = pytest.mark.thorough

RIG = """
schema = 1
kind = "{kind}"
title = "Four by four"
""" + (Path(__file__).parents[1] / "data" / "rig.toml").read_text()
AXIS = """
[axes.{name}]
from = {first}
to = {last}
points = 4
"""
MAP = RIG.format(kind="map") + AXIS.format(name="frequency_ratio", first=1.2, last=3.9) + AXIS.format(
    name="gap_ratio", first=0.0, last=5.0)
BASIN = RIG.format(kind="basin") + "[operating_point]\nfrequency_ratio = 1.8\ngap_ratio = 1.5\n" + AXIS.format(
    name="displacement_ratio", first=-3.0, last=1.0) + AXIS.format(name="velocity_ratio", first=-4.0, last=4.0)


@pytest.fixture
def compute(tmp_path):
    binary = os.environ.get("PETERKA_BINARY")
    assert binary and os.access(binary, os.X_OK), "set PETERKA_BINARY to the built program (build/peterka)"

    def run(name, job):
        (tmp_path / f"{name}.toml").write_text(job)
        command = [binary, "run", f"{name}.toml", "--output", f"{name}.h5", "--quiet"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
        assert done.returncode == 0, done.stderr
        return tmp_path / f"{name}.h5"

    return run


def test_a_map_is_drawn(compute, draw):
    outcome = draw(compute("rig", MAP))
    assert (outcome.code, outcome.stderr) == (0, "")
    assert "incomplete" not in outcome.stdout
    assert outcome.pictures == [
        f"rig_{name}.{suffix}" for name in ("force_1_1", "force_all", "map") for suffix in ("pdf", "png")
    ]


def test_a_basin_is_drawn(compute, draw):
    outcome = draw(compute("starts", BASIN))
    assert (outcome.code, outcome.stderr) == (0, "")
    assert "incomplete" not in outcome.stdout
    assert outcome.pictures == [
        f"starts_{name}.{suffix}" for name in ("basin", "basin_impact") for suffix in ("pdf", "png")
    ]
