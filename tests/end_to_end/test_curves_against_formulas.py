"""Whole curves of a rigid stop against the closed form of 1/1, and the curves' approach to their special points."""

import h5py
import numpy as np
import pytest

import jobs
import launch

pytestmark = pytest.mark.thorough

FOLD, DOUBLING = 0, 1
CUSP = 3
RESTITUTION, DAMPING_RATIO = 0.6, 0.02
RIGID = """
schema = 1
kind = "curves"
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
damping_ratio = 0.02
[cart]
amplitude_m = 0.89e-3
[contact]
law = "restitution"
coefficient = 0.6
[start]
displacement_ratio = -1.0
velocity_ratio = 2.0
[curves]
max_period = 1
"""


def computed(folder, text):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", "--quiet", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5"


@pytest.fixture(scope="module")
def rigid(tmp_path_factory):
    return computed(tmp_path_factory.mktemp("rigid"), RIGID + jobs.axis("frequency_ratio", 1.3, 3.2, 24)
                    + jobs.axis("gap_ratio", 0.0, 3.0, 24))


def curves_of(path, kind):
    """[(frequencies, gaps)] of 1/1, in their order."""
    with h5py.File(path) as file:
        x, y = file["point_frequency_ratio"][()], file["point_gap_ratio"][()]
        return [(x[first:first + count], y[first:first + count]) for number, p, q, first, count in zip(
            *(file[f"curve_{name}"][()] for name in ("kind", "impacts", "period", "first", "points")))
            if (number, p, q) == (kind, 1, 1)]


def closed_form(eta):
    """alpha, beta, P and exp(-2 zeta T) of z = 1/1 with a rigid stop."""
    turn, nu = 2 * np.pi / eta, np.sqrt(1 - DAMPING_RATIO**2)
    decay, sine, cosine = np.exp(-DAMPING_RATIO * turn), np.sin(nu * turn), np.cos(nu * turn)
    flow = decay * np.array([[cosine + DAMPING_RATIO / nu * sine, sine / nu],
                             [-sine / nu, cosine - DAMPING_RATIO / nu * sine]])
    inverse = np.linalg.inv(flow - np.eye(2))
    reach = eta**2 / np.hypot(1 - eta**2, 2 * DAMPING_RATIO * eta)
    return (1 + RESTITUTION) * inverse[0, 1], (1 + RESTITUTION) * inverse[1, 1], reach, flow


def test_each_point_of_a_fold_obeys_the_closed_form(rigid):
    points = [point for curve in curves_of(rigid, FOLD) for point in zip(*curve)]
    assert len(points) > 20
    for eta, gap in points:
        alpha, beta, reach, _ = closed_form(eta)
        assert gap == pytest.approx(reach * np.hypot(1, alpha * eta / (RESTITUTION + beta)), abs=1e-9)


def test_each_point_of_a_period_doubling_obeys_the_closed_form(rigid):
    inside = [point for x, y in curves_of(rigid, DOUBLING) for point in zip(x[1:-1], y[1:-1])]  # the impact speed is nonzero
    assert len(inside) > 20
    for eta, gap in inside:
        off_by = []
        for sign in (1, -1):
            here, there = (_trace_off(eta, g, sign) for g in (gap, gap - 1e-7))
            off_by.append(abs(here * 1e-7 / (there - here)))  # distance of the gap from the root of the formula
        assert min(off_by) < 1e-9


def _trace_off(eta, gap, sign):
    """tr M + 1 + det M of one of the two orbits."""
    alpha, beta, reach, flow = closed_form(eta)
    speed = (RESTITUTION + beta) / eta
    square = alpha**2 + speed**2
    root = np.sqrt((alpha * gap)**2 - square * (gap**2 - reach**2))
    velocity = (alpha * gap + sign * root) / square
    phase = np.arctan2(gap - alpha * velocity, -speed * velocity) + np.arctan2(2 * DAMPING_RATIO * eta, 1 - eta**2)
    jump = np.array([[-RESTITUTION, 0], [(1 + RESTITUTION) * (eta**2 * np.sin(phase) - gap) / velocity, -RESTITUTION]])
    return np.trace(flow @ jump) + 1 + np.linalg.det(flow @ jump)


def test_a_fold_leaves_the_grazing_quadratically(rigid):
    """The impact speed vanishes where alpha is 0, and the gap departs from P quadratically."""
    ends = [(x[::step], y[::step]) for x, y in curves_of(rigid, FOLD) for step in (1, -1)]
    away = [(np.abs(x - x[0]), y - [closed_form(eta)[2] for eta in x]) for x, y in ends]
    away = [(along, above) for along, above in away if abs(above[0]) < 1e-10]
    assert away
    for along, above in away:
        near = (along > 1e-5) & (along < 0.05)
        assert near.sum() > 3
        assert np.polyfit(np.log(along[near]), np.log(above[near]), 1)[0] == pytest.approx(2, abs=0.1)


def test_two_folds_meet_in_a_cusp_as_normal_forms_say(tmp_path):
    """Their distance scales with the power 3/2 of the distance from the cusp."""
    path = computed(tmp_path, jobs.small_curves(points=32))
    with h5py.File(path) as file:
        number = next(n for n in np.flatnonzero(file["special_kind"][()] == CUSP) if file["special_frequency_ratio"][n] > 1.9)
        cusp = np.array([file["special_frequency_ratio"][number], file["special_gap_ratio"][number]])
        first, count = (int(file[f"curve_{name}"][file["special_curve"][number]]) for name in ("first", "points"))
        points = slice(first, first + count)
        curve = np.column_stack([file["point_frequency_ratio"][points], file["point_gap_ratio"][points]])
    at = int(np.argmin(np.hypot(*(curve - cusp).T)))
    one, other = curve[max(at - 12, 0):at][::-1] - cusp, curve[at + 1:at + 13] - cusp
    way = one[1] / np.hypot(*one[1]) + other[1] / np.hypot(*other[1])
    way /= np.hypot(*way)
    aside = np.array([-way[1], way[0]])
    shared = (one @ way > (other @ way).min()) & (one @ way < (other @ way).max())
    apart = np.abs((one @ aside)[shared] - np.interp((one @ way)[shared], other @ way, other @ aside))
    assert shared.sum() > 5
    assert np.polyfit(np.log((one @ way)[shared]), np.log(apart), 1)[0] == pytest.approx(1.5, abs=0.15)
