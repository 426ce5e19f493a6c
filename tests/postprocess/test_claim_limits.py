"""Limits of bands from curves: exact where a curve of this rig bounds the orbit, otherwise those of the cells."""

import numpy as np
import pytest
from claim_samples import CHAOS, HALF, JOB, ONE, TWICE, Held, plane
from curves_samples import CROSSINGS, write_curves
from peterka.claims import exact_limits, gap_zero
from peterka.claims.folder import Curves, Folder
from peterka.errors import PeterkaFileError
from peterka.maps.curves_file import Crossing, Curve, CurvesFile
from picture_samples import PLAIN, write_map

HERTZ = np.arange(2, 20, 0.25)
CELLS = [ONE if 4 <= hertz <= 11.5 else TWICE if 4 < hertz < 12.5 else HALF if 4 < hertz <= 16.5 else CHAOS for hertz in HERTZ]


def crossing(kind, impacts, period, hertz, gap=0.0):
    return Crossing(Curve(kind, impacts, period, np.array([]), np.array([])), hertz, gap)


def first_band(*crossings, change=None):
    gaps = plane([CELLS], columns=HERTZ)
    curves = Curves(gaps.job | (change or {}), list(crossings))
    found = gap_zero.claims(Held(curves=curves, gaps_170mm=gaps))
    return next(claim for claim in found if claim.key == "gap_0_first_band")


def test_a_band_ends_where_the_curve_of_its_orbit_is():
    found = first_band(crossing("period_doubling", 1, 1, 11.617), crossing("grazing", 1, 1, 3.8123))
    assert "the lower 3.8123 Hz (grazing) and the upper 11.617 Hz (period doubling)" in found.computed
    assert "upper limit +0.117 Hz" in found.difference and "lower limit -0.188 Hz" in found.difference


@pytest.mark.parametrize("other", [
    crossing("period_doubling", 1, 1, 12.4), crossing("period_doubling", 1, 1, 11.617, gap=1.0),
    crossing("fold", 1, 2, 11.617), crossing("grazing", 2, 1, 11.617), crossing("period_doubling", 2, 2, 11.617)])
def test_other_curves_say_nothing(other):
    found = first_band(other)
    assert "by the curves" not in found.computed and "upper limit +0.125 Hz" in found.difference


def test_curves_of_another_rig_say_nothing():
    at_end = crossing("period_doubling", 1, 1, 11.617)
    assert "by the curves" in first_band(at_end).computed
    assert "by the curves" not in first_band(at_end, change={"cart": {"amplitude_m": 2e-3}}).computed


def test_a_doubled_orbit_begins_at_the_doubling_and_a_grazing_bounds_both_sides():
    gaps = plane([[TWICE, TWICE, ONE, ONE]])
    folder = Held(curves=Curves(gaps.job, [crossing("period_doubling", 1, 1, 2.4), crossing("grazing", 0, 1, 2.6)]))
    assert [limit.text for limit in exact_limits.limits(folder, gaps, (1.0, 2.5), (2, 2))] == \
        ["1.00 Hz", "2.4 Hz (period doubling)"]
    assert exact_limits.limits(folder, gaps, (2.5,), (0, 1))[0].kind == "grazing"
    assert abs(exact_limits.limits(folder, gaps, (2.55,), (1, 1))[0].hz - 2.6) < 1e-12


def test_crossings_are_read_from_the_file_of_curves(tmp_path):
    path = write_curves(tmp_path / "curves_170mm.h5", crossings=CROSSINGS, job=JOB)
    with CurvesFile(path) as file:
        assert [(file.curves.index(each.curve), each.frequency_ratio, each.gap_ratio) for each in file.crossings] == CROSSINGS
    folder = Folder(tmp_path)
    assert len(folder.curves("curves_170mm").crossings) == 2 and folder.curves("elsewhere") is None


def test_a_crossing_that_cannot_be_and_a_file_of_another_kind_are_refused(tmp_path):
    with pytest.raises(PeterkaFileError, match="crossing"):
        CurvesFile(write_curves(tmp_path / "a.h5", crossings=[(3, 1.0, 1.0)]))
    write_map(tmp_path / "curves_170mm.h5", PLAIN, job=JOB)
    with pytest.raises(PeterkaFileError, match="a curves file is needed"):
        Folder(tmp_path).curves("curves_170mm")
