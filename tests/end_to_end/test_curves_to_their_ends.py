"""Curves where they are hard to tell: between many weak impacts, near the end of a fold at a grazing, and where the stop comes to hold
the hammer. Numbers to compare with are of another integrator (Taylor series of order 26 with event location)."""

import h5py
import numpy as np
import pytest

import jobs
import launch

FOLD, DOUBLING = 0, 1
PROVED = 1

BOUNCES = """schema = 1
kind = "curves"
title = "bounces"
[hammer]
mass_kg = 0.741818
natural_frequency_hz = 2.46413
damping_ratio = 0.0803928
[cart]
amplitude_m = 0.000377742
[contact]
law = "restitution"
coefficient = 0.54067
[axes.frequency_hz]
from = 1.09
to = 1.14
points = 40
[axes.gap_m]
from = 4.4e-5
to = 5.4e-5
points = 40
[curves]
max_period = 1
edge_distance = false
gap_m = [5.05e-5, 5.2e-5]
[certificate]
cells = "all"
"""

FOLD_THAT_ENDS = """schema = 1
kind = "curves"
title = "a fold that ends"
[hammer]
mass_kg = 0.123061
natural_frequency_hz = 0.805994
damping_ratio = 0.0112852
[cart]
amplitude_m = 0.000204148
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 28.3075
damping_ns_per_m = 0.342504
[axes.frequency_hz]
from = 1.12964
to = 3.14554
points = 40
[axes.gap_m]
from = 0
to = 0.000367639055
points = 40
[curves]
max_period = 4
edge_distance = false
gap_m = [2.3875e-4, 2.39e-4, 2.395e-4, 2.41e-4]
[certificate]
cells = "all"
"""

HELD = """schema = 1
kind = "curves"
title = "held"
[hammer]
mass_kg = 0.2534
natural_frequency_hz = 4.58101
damping_ratio = 0.0123655
[cart]
amplitude_m = 0.000782562
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 37866
damping_ns_per_m = 47.5634
[axes.frequency_hz]
from = 2.79729
to = 12.3601
points = 12
[axes.gap_m]
from = -0.000758783326
to = 0.00122679281
points = 12
[curves]
max_period = 1
"""

MEETINGS = (jobs.RIG.format(kind="curves", title="meetings").replace("damping_ns_per_m = 0.06", "damping_ratio = 0.02").replace(
    jobs.KELVIN_VOIGT, 'law = "kelvin_voigt"\nstiffness_n_per_m = 2e5\ndamping_ns_per_m = 100\n')
    + jobs.axis("frequency_ratio", 1.0, 4.0, 80) + jobs.axis("gap_ratio", 0.0, 2.5, 60))


def run(folder, text):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        found = {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}
    for name in ("kind", "impacts", "period"):
        found[f"crossing_{name}"] = found[f"curve_{name}"][found.get("crossing_curve", [])]
    return found


# Up to eleven impacts a cycle, each slower than the one before.
def test_a_doubling_between_many_weak_impacts_is_told_once_and_where_it_is(tmp_path):
    found = run(tmp_path, BOUNCES)
    doubles = found["crossing_kind"] == DOUBLING
    assert (found["crossing_impacts"][doubles] >= 9).sum() >= 4
    assert found["crossing_multiplier"][doubles] == pytest.approx(-1, abs=1e-6)
    sign = np.repeat(np.array([1.0, -1.0, np.nan])[found["curve_kind"]], found["curve_points"])
    multiplier = found["point_multiplier"][np.isfinite(sign)]
    assert np.nanmax(np.abs(multiplier - sign[np.isfinite(sign)])) < 1e-6
    frequency, proved = found["crossing_frequency_hz"], found["crossing_certified"] == PROVED
    assert proved.mean() > 0.5
    assert (found["crossing_lower"][proved] <= frequency[proved] * (1 + 1e-12)).all()
    assert (frequency[proved] <= found["crossing_upper"][proved] * (1 + 1e-12)).all()
    ten = doubles & (found["crossing_impacts"] == 10) & np.isclose(found["crossing_gap_m"], 5.05e-5)
    assert frequency[ten & (frequency > 1.12)] == pytest.approx([1.1206042333], abs=1e-9)
    told = np.stack([frequency, found["crossing_gap_m"] * 1e4, found["crossing_impacts"], found["crossing_kind"]], axis=1)
    assert len(np.unique(told.round(8), axis=0)) == len(told)


# The fold of z = 3/4 ends at a grazing at 0.23995 mm: at lower gaps that motion would strike once more.
def test_a_fold_ends_where_its_motion_meets_the_stop_once_more(tmp_path):
    found = run(tmp_path, FOLD_THAT_ENDS)
    assert (found["crossing_certified"] == PROVED).all()
    fold = (found["crossing_kind"] == FOLD) & (found["crossing_impacts"] == 3) & (found["crossing_period"] == 4)
    above = fold & (found["crossing_frequency_hz"] > 1.878)
    assert found["crossing_gap_m"][above] == pytest.approx([2.41e-4])
    assert len(found["crossing"]) > 60
    (curve,) = set(found["crossing_curve"][above])
    first, last = found["curve_first"][curve], found["curve_first"][curve] + found["curve_points"][curve] - 1
    ends = sorted((found["point_frequency_hz"][n], found["point_gap_m"][n]) for n in (first, last))
    assert any(end == pytest.approx((1.88032, 2.3996e-4), rel=1e-4) for end in ends), ends


# Where two curves meet, each finds the place by equations of its own. One told an orbit whose stop released and pressed again in the
# same instant, 1e-5 off: it solves the equations, but the hammer first leaves the stop for 1.6 ms.
@pytest.mark.thorough
def test_curves_that_meet_tell_one_place(tmp_path):
    found = run(tmp_path, MEETINGS)
    place = np.stack([found["special_frequency_ratio"], found["special_gap_ratio"]], axis=1)
    apart = np.linalg.norm(place[:, None] - place[None], axis=2)
    pairs = np.triu((found["special_kind"][:, None] == found["special_kind"]) & (apart < 1e-4), 1)
    assert pairs.sum() > 30
    assert apart[pairs].max() < 1e-9


# The last pair of events is lost: the motion has none from there on.
def test_a_branch_that_ends_in_lasting_contact_is_no_error(tmp_path):
    found = run(tmp_path, HELD)
    assert len(found["curve"]) > 0
