"""operating_point.py --risk on a map of drawn rigs that the program computed: its value against plain loops over the file, fresh draws
against plain random ones, solved one by one; pictures of such maps and sweeps."""

import re

import numpy as np
import pytest
import xarray

import jobs
import postprocessing
import uncertain_rigs

pytestmark = pytest.mark.thorough

WEIGHT = 0.298 * 9.80665
AXES = jobs.axis("frequency_ratio", 1.5, 2.5, 21) + jobs.axis("gap_ratio", 0.0, 1.5, 16)
ACROSS, UP = 2, 1  # cells of the drift to either side: 0.4 Hz of 0.225 Hz, 0.08 mm of 0.089 mm
DRIFT = ("--hz", "0.4", "--mm", "0.08")


def compute(folder, kind="map", axes=AXES, rigs=64, file=None, more=""):
    text = jobs.RIG.format(kind=kind, title="uncertain") + axes + more + uncertain_rigs.table(rigs, file)
    return uncertain_rigs.compute(folder, text)[0]


@pytest.fixture(scope="module", params=[None, "stop_identified.toml"], ids=["by key", "covariance"])
def plane(request, tmp_path_factory):
    return compute(tmp_path_factory.mktemp("map"), file=request.param), request.param


def program(name, folder, *arguments, code=0):
    return postprocessing.program(name, folder, *arguments, "--formats", "png", code=code)


def read(path):
    with xarray.open_dataset(path) as file:
        return {name: file[name].values for name in file.variables}, file.attrs["job"]


def plain_forces(place, with_covariance, monkeypatch, count=2000):
    """The forces [N] of random rigs at a place."""
    if not with_covariance:
        monkeypatch.setattr(uncertain_rigs, "MATRIX", np.zeros((3, 3)))
    cells = uncertain_rigs.numpy_draws(uncertain_rigs.paper_rig(), np.random.default_rng(1), count, place)
    return WEIGHT * uncertain_rigs.solve(cells)[1]


def test_the_best_place_and_what_fresh_draws_say_of_it(tmp_path, plane, monkeypatch):
    path = plane[0]
    told = program("operating_point", tmp_path, path, *DRIFT, "--risk", "0.95", "--verify")
    low = read(path)[0]["force_q05_ratio"]
    height, width = low.shape
    least = np.array([[low[row - UP:row + UP + 1, column - ACROSS:column + ACROSS + 1].min() for column in range(ACROSS, width - ACROSS)]
                      for row in range(UP, height - UP)])
    best = float(re.search(r"at least ([\d.]+) N in all cells", told)[1])
    assert best == pytest.approx(WEIGHT * least.max(), rel=1e-3)

    within, _ = read(tmp_path / "pictures" / "job_places.h5")
    place = [float(number) for number in re.search(r"best: frequency_ratio ([\d.]+) .*, gap_ratio ([\d.]+) ", told).groups()]
    for name, middle, drift in (("frequency_ratio", place[0], 0.4 / 4.5), ("gap_ratio", place[1], 0.08 / 0.89)):
        assert within[name] == pytest.approx(np.linspace(middle - drift, middle + drift, 17), rel=1e-4)
    row, column = np.unravel_index(within["force_q05_ratio"].argmin(), (17, 17))
    worst = float(within["frequency_ratio"][column]), float(within["gap_ratio"][row])
    cells, job = read(tmp_path / "pictures" / "job_draws.h5")
    assert (float(cells["frequency_ratio"][0]), float(cells["gap_ratio"][0])) == pytest.approx(worst) and "rigs = 1024" in job
    fresh = WEIGHT * cells["force_q05_ratio"].item()
    line = told.splitlines()[-1]
    assert "of 1,024 rigs, 960 of them new, at the worst of 289 places within the drift" in line and f"95 % reach {fresh:.4g} N" in line
    assert line.startswith("it holds" if fresh >= best else "it falls short")

    forces = plain_forces(worst, plane[1] is not None, monkeypatch)
    assert np.mean(forces >= fresh * (1 - 1e-6)) == pytest.approx(0.95, abs=4 * np.sqrt(0.95 * 0.05 * (1 / forces.size + 1 / 1024)))


def test_few_rigs_are_refused(tmp_path):
    path = compute(tmp_path, rigs=24, axes=jobs.axis("frequency_ratio", 1.5, 2.5, 4) + jobs.axis("gap_ratio", 0.0, 1.5, 4))
    refusal = program("operating_point", tmp_path, path, "--hz", "0", "--mm", "0", "--risk", "0.95", code=2)
    assert "has 24 rigs of each cell" in refusal and "--set uncertainty.rigs=59" in refusal


def test_a_box_is_verified_for_the_job_s_own_rig_alone_where_no_risk_is_asked_for(tmp_path, plane):
    told = program("operating_point", tmp_path, plane[0], *DRIFT, "--verify")
    assert "finer box" in told and "outcome_probability" not in read(tmp_path / "pictures" / "job_box.h5")[0]


def test_maps_and_sweeps_are_drawn_and_exported(tmp_path, plane):
    only = () if plane[1] is None else ("--only", "outcome,force_q05,probability_1_1,probability_impacts")  # all others once
    program("draw", tmp_path, plane[0], "--export", "csv", *only)
    names = {path.name for path in (tmp_path / "pictures").iterdir()}
    assert {"job_outcome.png", "job_force_q05.png", "job_probability_1_1.png", "job_probability_impacts.png", "job.csv"} <= names
    cells, _ = read(plane[0])
    path = compute(tmp_path, "sweep", jobs.axis("frequency_ratio", 1.5, 2.5, 21), file=plane[1],
                   more="\n[sweep]\ngap_ratio = [0.0, 0.5]\n")
    assert "job_response_of_rigs.png" in program("draw", tmp_path, path, *(only and ("--only", "response_of_rigs")))
    branches, _ = read(path)
    assert np.allclose(branches["force_q50_ratio"][branches["gap_ratio"] == 0.0], cells["force_q50_ratio"][0], rtol=1e-6)


def test_a_refined_map_of_a_rigid_stop_has_speeds(tmp_path):
    text = jobs.with_rigid_stop(jobs.RIG.format(kind="map", title="rigid") + AXES + "\n[refine]\nlevels = 1\n" + uncertain_rigs.table(64))
    path = uncertain_rigs.compute(tmp_path, text)[0]
    assert "job_force_q05.png" in program("draw", tmp_path, path, "--only", "force_q05")
    told = program("operating_point", tmp_path, path, *DRIFT, "--risk", "0.95", "--verify")
    assert "impact speed with a probability of 0.95" in told and "m/s" in told.splitlines()[-1]
