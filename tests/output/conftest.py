"""A 4x4 map, a 4x4 basin and a sweep with 4 branches of 4 points of the paper's 170 mm rig, computed by the program."""

import os
import subprocess
from pathlib import Path

import pytest

RIG = """
schema = 1
kind = "{kind}"
title = "four by four"
""" + (Path(__file__).parents[1] / "data" / "rig.toml").read_text()

MAP = RIG.format(kind="map") + """
[axes.frequency_ratio]
from = 0.5
to = 3.5
points = 4
[axes.gap_ratio]
from = 0.0
to = 4.5
points = 4
[output]
fields = ["multiplier", "lyapunov", "sensitivity", "orbit"]
"""

# The last column's first row starts on the motion without impact, x = (1 - P) sin(eta tau), P = 1.446.
BASIN = RIG.format(kind="basin") + """
[operating_point]
frequency_ratio = 1.8
gap_ratio = 1.6
[axes.displacement_ratio]
from = -3.0
to = 0.0
points = 4
[axes.velocity_ratio]
from = -0.8
to = 2.2
points = 4
"""

SWEEP = RIG.format(kind="sweep") + """
[axes.frequency_ratio]
from = 0.5
to = 3.5
points = 4
[sweep]
gap_ratio = [0.0, 1.5]
direction = "both"
samples = 5
"""


def compute(folder, text):
    (folder / "job.toml").write_text(text)
    finished = subprocess.run(
        [Path(os.environ["PETERKA_BINARY"]).resolve(), "run", "job.toml", "--output", "made.h5", "--quiet"],
        cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300,
    )
    assert finished.returncode == 0, finished.stderr
    return folder / "made.h5"


@pytest.fixture(scope="session")
def map_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("map"), MAP)


@pytest.fixture(scope="session")
def basin_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("basin"), BASIN)


@pytest.fixture(scope="session")
def sweep_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("sweep"), SWEEP)
