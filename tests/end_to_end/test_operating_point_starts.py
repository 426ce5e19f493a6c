"""operating_point.py on a map with [starts] computed by the program: its statements for every start, for a share of them and
for the job's own, and the result of --verify, against plain loops over the files' contents."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray

import jobs
import launch
import many_starts

pytestmark = pytest.mark.thorough

PROGRAM = Path(__file__).resolve().parents[2] / "postprocess" / "operating_point.py"
WEIGHT = 0.298 * 9.80665
COUNT = 12
ACROSS, UP = 2, 2  # cells of the drift to either side: 0.3 Hz of 0.15 Hz, 0.12 mm of 0.089 mm
DRIFT = ("--hz", "0.3", "--mm", "0.12")


@pytest.fixture(scope="module")
def plane(tmp_path_factory):
    """z = 1/1, 2/2 and 1/2, alone at small gaps and coexisting with others at larger ones."""
    folder = tmp_path_factory.mktemp("map")
    jobs.write(folder, jobs.RIG.format(kind="map", title="plane") + jobs.axis("frequency_ratio", 1.2, 3.6, 73)
               + jobs.axis("gap_ratio", 0.0, 2.0, 21) + many_starts.table(COUNT))
    finished = launch.run("run", "job.toml", cwd=folder, ranks=2)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5"


def operate(folder, *arguments):
    done = subprocess.run([sys.executable, PROGRAM, *map(str, arguments), "--formats", "png"], cwd=folder, capture_output=True,
                          text=True, timeout=300, check=False, env=launch.ENVIRONMENT)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    return done.stdout


def ends_of(cells, row, column, starts):
    """The label in which the admitted starts end and the smallest force [N] among them; None if they differ or if it is not an orbit."""
    own = tuple(int(cells[name][row, column]) for name in ("regime", "impacts", "period"))
    own_force = float(cells["peak_force_ratio"][row, column])
    if starts == "job":
        return (own, own_force * WEIGHT) if own[0] == 1 else None
    ends = {}
    for slot in range(len(cells["basin_share"])):
        label = tuple(int(cells[f"attractor_{name}"][slot, row, column]) for name in ("regime", "impacts", "period"))
        share, force = (float(cells[name][slot, row, column]) for name in ("basin_share", "attractor_peak_force_ratio"))
        if label[0] == -128 or (starts != 1 and share == 0):  # known, but not found by any start
            continue
        before, least = ends.get(label, (0.0, np.inf))
        ends[label] = (before + share, min(least, force))
    label, (share, force) = max(ends.items(), key=lambda end: end[1][0])
    if starts == 1 and len(ends) > 1:
        return None
    if label[0] != 1 or round(share * COUNT) < np.ceil(starts * COUNT - 1e-9):
        return None
    if starts == 1:
        return (label, min(force, own_force) * WEIGHT) if own == label else None
    return label, force * WEIGHT


def may_swing_free(cells, width, height):
    """Whether there is a motion without impact in the box around each cell, sampled at many frequencies."""
    eta = cells["frequency_ratio"][:, None] + np.linspace(-width, width, 1001)
    zeta = 0.06 / (4 * np.pi * 0.298 * 4.5)
    amplitude = eta**2 / np.abs(1 - eta**2 + 2j * zeta * eta)
    return amplitude.min(axis=1) < cells["gap_ratio"][:, None] + height


def read(path):
    """(the numbers of the cells, the job)"""
    with xarray.open_dataset(path) as file:
        return {name: file[name].values for name in file.variables}, file.attrs["job"]


def worst_of(ends, rows, columns):
    """The worst value of a box; NaN if it has more than one regime."""
    found = [ends[row, column] for row in rows for column in columns]
    if None in found or len({label for label, _ in found}) > 1:
        return np.nan
    return min(force for _, force in found)


@pytest.mark.parametrize("words, starts", [(("any",), 1), (("share", "0.75"), 0.75), (("job",), "job")])
def test_no_place_is_better_and_the_finer_box_is_told_as_it_is(tmp_path, plane, words, starts):
    told = operate(tmp_path, plane, *DRIFT, "--starts", *words, "--verify")
    cells, _ = read(plane)
    height, width = cells["regime"].shape
    ends = {place: ends_of(cells, *place, starts) for place in np.ndindex(height, width)}
    best_of_boxes = np.array([[worst_of(ends, range(row - UP, row + UP + 1), range(column - ACROSS, column + ACROSS + 1))
                               for column in range(ACROSS, width - ACROSS)] for row in range(UP, height - UP)])
    if starts == 1:
        best_of_boxes[may_swing_free(cells, 0.3 / 4.5, 0.12 / 0.89)[UP:height - UP, ACROSS:width - ACROSS]] = np.nan
    assert np.isfinite(best_of_boxes).sum() > 50
    share = 100 * np.isfinite(best_of_boxes).sum() / (height * width)
    assert float(re.search(r"one motion in the boxes of ([\d.]+) % of the cells", told)[1]) == pytest.approx(share, rel=0.01)
    best = float(re.search(r"at least ([\d.]+) N", told)[1])
    assert best == pytest.approx(np.nanmax(best_of_boxes), rel=1e-3)

    box, job = read(tmp_path / "pictures" / "job_box.h5")
    assert f"count = {COUNT}" in job
    finer = [ends_of(box, row, column, starts) for row, column in np.ndindex(box["regime"].shape)]
    orbit = tuple(int(number) for number in re.search(r"best: .* z = (\d+)/(\d+):", told).groups())
    others = sum(end is None or end[0] != (1, *orbit) for end in finer)
    if others:
        assert f"it doesn't hold: {others} of {len(finer)} cells" in told
        return
    worst = min(force for _, force in finer)
    assert f" {len(finer)} cells" in told and f"{worst:.4g} N" in told
    assert ("it holds" in told) == (worst >= best * (1 - 1e-3))


def test_fewer_starts_leave_no_less(tmp_path, plane):
    """Admitting every start gives no more than admitting some of them."""
    best = [float(re.search(r"at least ([\d.]+) N", operate(tmp_path, plane, *DRIFT, "--starts", *words))[1])
            for words in (("any",), ("share", "0.75"))]
    assert best[0] <= best[1]
