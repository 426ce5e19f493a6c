"""operating_point.py on maps computed by the program: its statements agree with what the program finds in the box, on
another grid, and no other place of the map is better."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray

import jobs
import launch

pytestmark = pytest.mark.thorough

PROGRAM = Path(__file__).resolve().parents[2] / "postprocess" / "operating_point.py"
WEIGHT = 0.298 * 9.80665


def compute(folder, text, *arguments, name="job"):
    jobs.write(folder, text, f"{name}.toml")
    finished = launch.run("run", f"{name}.toml", *arguments, cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / f"{name}.h5"


def operate(folder, *arguments, **variables):
    return subprocess.run([sys.executable, PROGRAM, *map(str, arguments), "--formats", "png"], cwd=folder, capture_output=True,
                          text=True, timeout=300, check=False, env=launch.ENVIRONMENT | variables)


@pytest.fixture(scope="module")
def plane(tmp_path_factory):
    """The two bands of z = 1/1 and 1/2, with cell spacings of 0.05 Hz and 0.045 mm; borders are told at a gap outside the boxes."""
    folder = tmp_path_factory.mktemp("map")
    return compute(folder, jobs.RIG.format(kind="map", title="plane") + jobs.axis("frequency_ratio", 1.2, 3.6, 217)
                   + jobs.axis("gap_ratio", 0.0, 1.5, 31) + "[curves]\ngap_ratio = [1.45]\n", "--set", 'output.fields=["contact_power_w"]')


def test_the_best_place_has_what_the_program_finds_around_it(tmp_path, plane):
    done = operate(tmp_path, plane, "--hz", 0.3, "--mm", 0.1, "--regime", "1/1", "--verify")
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    hertz, millimetres, newtons = map(float, re.search(
        r"best: frequency_ratio [\d.]+ \(([\d.]+) Hz\), gap_ratio [\d.]+ \(([\d.]+) mm\), z = 1/1: at least ([\d.]+) N", done.stdout).groups())
    frequency, gap = hertz / 4.5, millimetres / 0.89
    around = compute(tmp_path, jobs.RIG.format(kind="map", title="around")
                     + jobs.axis("frequency_ratio", frequency - 0.3 / 4.5, frequency + 0.3 / 4.5, 23)
                     + jobs.axis("gap_ratio", gap - 0.1 / 0.89, gap + 0.1 / 0.89, 19), name="around")
    with xarray.open_dataset(around) as box:
        assert np.all((box.regime == 1) & (box.impacts == 1) & (box.period == 1))
        worst = float(box.peak_force_ratio.min()) * WEIGHT
    assert worst == pytest.approx(newtons, rel=0.02) and worst >= newtons * (1 - 1e-4)
    told = re.search(r"it holds in all (\d+) cells of the finer box: the worst has ([\d.]+) N", done.stdout)
    assert told and int(told[1]) > 200 and float(told[2]) == pytest.approx(worst, rel=1e-3)
    assert "power into the contact" in done.stdout and (tmp_path / "pictures" / "job_operating_point.png").exists()


def test_no_place_of_the_map_is_better(plane):
    """Against all boxes of the map, one by one."""
    done = operate(plane.parent, plane, "--hz", 0.3, "--mm", 0.1)
    told = float(re.search(r"at least ([\d.]+) N", done.stdout)[1])
    with xarray.open_dataset(plane) as cells:
        label = np.where(cells.regime == 1, cells.impacts * 1000 + cells.period, -1).astype(int)
        force = cells.peak_force_ratio.values * WEIGHT
        across, up = 6, 3  # 0.3 Hz of 0.05, 0.1 mm of 0.0445
    best = 0.0
    for row in range(up, label.shape[0] - up):
        for column in range(across, label.shape[1] - across):
            box = np.s_[row - up:row + up + 1, column - across:column + across + 1]
            if label[row, column] > 1000 and np.all(label[box] == label[row, column]):
                best = max(best, force[box].min())
    assert told == pytest.approx(best, rel=1e-3)


def test_a_program_that_is_missing_is_named(tmp_path, plane):
    done = operate(tmp_path, plane, "--hz", 0.3, "--verify", "--peterka", "nowhere")
    assert done.returncode == 2 and "nowhere cannot be started" in done.stderr and done.stderr.count("\n") == 1


def test_the_box_is_refused_by_name_when_the_program_refuses_it(tmp_path, plane):
    script = tmp_path / "refuses"
    script.write_text("#!/bin/sh\necho peterka: no >&2\nexit 2\n", encoding="utf-8")
    os.chmod(script, 0o755)
    done = operate(tmp_path, plane, "--hz", 0.3, "--verify", "--peterka", script)
    assert done.returncode == 2 and "was not computed: peterka: no" in done.stderr
