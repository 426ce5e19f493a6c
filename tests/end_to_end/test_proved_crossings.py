"""Proofs of where curves have given gaps: the bounds hold numbers of an independent program, and are the same at any number of ranks."""

import re

import h5py
import numpy as np
import pytest

import jobs
import launch
import map_contents

pytestmark = pytest.mark.thorough

FOLD, DOUBLING, GRAZING = range(3)
JOB = jobs.small_curves(points=32) + "\n[curves]\ngap_ratio = [0.0, 1.0, 1.5]\n\n[certificate]\ncells = \"all\"\n"
# Of 1/1: where its multiplier is 1 or -1, or where it ends with the free swing, from an independent program.
KNOWN = [(GRAZING, 0.0, 1.15008754), (DOUBLING, 0.0, 2.659361979), (DOUBLING, 1.0, 0.718391067),
         (DOUBLING, 1.0, 2.264326891), (FOLD, 1.5, 1.862464993)]


def compute(folder, text, *arguments, ranks=None):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", *arguments, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished


@pytest.fixture(scope="module")
def proved(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("proved"), JOB)


def crossings(path):
    with h5py.File(path) as file:
        curve = file["crossing_curve"][()]
        return {"kind": file["curve_kind"][()][curve], "period": file["curve_period"][()][curve],
                **{name: file[f"crossing_{name}"][()] for name in ("frequency_ratio", "gap_ratio", "certified", "lower", "upper")}}


def test_the_bounds_hold_what_an_independent_program_found(proved):
    of = crossings(proved[0])
    for kind, gap, frequency in KNOWN:
        there = ((of["kind"] == kind) & (of["period"] == 1) & (np.abs(of["gap_ratio"] - gap) < 1e-9)
                 & (np.abs(of["frequency_ratio"] - frequency) < 1e-6) & (of["certified"] == 1))
        assert there.any(), (kind, gap, frequency)
        digits = 2e-9  # of these numbers
        assert (of["lower"][there] <= frequency + digits).all() and (of["upper"][there] >= frequency - digits).all()


def test_nearly_all_are_proved_and_the_numbers_told_lie_between_their_bounds(proved):
    of = crossings(proved[0])
    sure = of["certified"] == 1
    assert sure.mean() > 0.85
    assert np.isnan(of["lower"][~sure]).all() and (of["certified"][~sure] < 0).all()
    width = (of["upper"] - of["lower"])[sure] / of["frequency_ratio"][sure]
    assert (width > 0).all() and np.median(width) < 1e-11 and width.max() < 1e-7
    rounding = 1e-12
    assert (of["lower"][sure] < of["frequency_ratio"][sure] * (1 + rounding)).all()
    assert (of["upper"][sure] > of["frequency_ratio"][sure] * (1 - rounding)).all()


def test_the_file_says_what_they_are(proved):
    with h5py.File(proved[0]) as file:
        verdict = file["crossing_certified"]
        assert verdict.dtype == np.int8 and verdict.attrs["flag_meanings"].split()[-2:] == ["not_tried", "proved"]
        assert list(verdict.attrs["flag_values"]) == list(range(-7, 2))
        assert file["crossing_lower"].attrs["units"] == "1"


def test_the_summary_tells_the_proved_interval_in_hertz(proved):
    of = crossings(proved[0])
    said = proved[1].stdout
    assert f"Proofs in interval arithmetic, of {len(of['kind'])} places" in said
    told = re.findall(r"(\d+\.\d+) (?:fold|period doubling|grazing) \(proved: (\d+\.\d+) to (\d+\.\d+)\)", said)
    assert len(told) > 10
    bounds = np.column_stack([of["lower"], of["upper"]]) * 4.5
    for number, low, high in ([float(text) for text in each] for each in told):
        assert low <= number + 6e-9 * number and number <= high + 6e-9 * number and low < high
        within = (bounds[:, 0] >= low - 1e-14 * low) & (bounds[:, 1] <= high + 1e-14 * high)
        assert within.any()


@pytest.mark.parametrize("ranks", [2, 3])
def test_proofs_are_the_same_at_any_number_of_ranks(tmp_path, proved, ranks):
    path, _ = compute(tmp_path, JOB, "--quiet", ranks=ranks)
    map_contents.assert_same_map(path, proved[0])


def test_a_complete_file_is_left_as_it_is_and_one_that_was_stopped_starts_again(tmp_path, proved):
    again = launch.run("run", "job.toml", cwd=proved[0].parent)
    assert again.returncode == 0 and "nothing is computed" in again.stdout
    jobs.write(tmp_path, JOB)
    assert launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path).returncode == 5
    map_contents.assert_same_map(compute(tmp_path, JOB)[0], proved[0])


def test_without_proofs_the_file_has_none_of_it(tmp_path, proved):
    path, finished = compute(tmp_path, JOB.split("[certificate]")[0])
    with h5py.File(path) as file, h5py.File(proved[0]) as other:
        assert set(other) - set(file) == {"crossing_certified", "crossing_lower", "crossing_upper"}
        assert "certificate" not in file.attrs["job"] if "job" in file.attrs else True
    assert "roved" not in finished.stdout


def test_another_axis_and_unit(tmp_path):
    job = (JOB.replace("frequency_ratio", "frequency_hz").replace("from = 0.5", "from = 2.25").replace("to = 4.5", "to = 20.25")
           .replace("points = 32", "points = 24"))
    of_file = compute(tmp_path, job)[0]
    with h5py.File(of_file) as file:
        sure = file["crossing_certified"][()] == 1
        assert sure.mean() > 0.85 and file["crossing_lower"].attrs["units"] == "Hz"
        told = file["crossing_frequency_hz"][()][sure]
        assert (np.abs(file["crossing_lower"][()][sure] - told) < 1e-8 * told).all()


def test_borders_that_a_map_tells_are_proved_too(tmp_path):
    _, finished = compute(tmp_path, JOB.replace('kind = "curves"', 'kind = "map"'))
    assert re.search(r"\d fold \(proved: [\d.]+ to [\d.]+\)", finished.stdout)
    assert re.search(r"places where curves have these gaps", finished.stdout)
