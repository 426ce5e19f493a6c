"""Unstable orbits at the gaps of a file of curves: confirmed by an integrator independent of event chains, and unstable
there; they begin and end on the curves."""

import h5py
import jobs
import launch
import numpy as np
import pytest
from scipy.integrate import solve_ivp

pytestmark = pytest.mark.thorough

GAP = 1.5
MASS, DAMPING, STIFFNESS, CONTACT_DAMPING = 0.298, 0.06, 5.5e6, 1.2e3
OMEGA = 2 * np.pi * 4.5
ZETA, KAPPA, CHI = DAMPING / (2 * MASS * OMEGA), STIFFNESS / (MASS * OMEGA**2), CONTACT_DAMPING / (MASS * OMEGA)
FOLD_OF_1_1 = 1.862464993  # from an independent program
END = {"border": 0, "fold": 1, "period_doubling": 2, "grazing": 3, "lost": 4}


@pytest.fixture(scope="module")
def branches(tmp_path_factory):
    folder = tmp_path_factory.mktemp("branches")
    jobs.write(folder, jobs.small_curves(points=32) + f"\n[curves]\ngap_ratio = [{GAP}]\n")
    finished = launch.run("run", "job.toml", "--quiet", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        data = {name: file[name][()] for name in file if name.startswith(("branch_", "crossing_", "curve_", "point_"))}
    parts = [slice(first, first + count) for first, count in zip(data["branch_first"], data["branch_points"])]
    return data, parts


def test_each_point_is_an_orbit_and_lies_between_points_of_curves(branches):
    data, parts = branches
    assert data["branch_residual"].max() <= 1e-11
    assert not (data["branch_begin"] == END["lost"]).any() and not (data["branch_end"] == END["lost"]).any()
    for part, begin, end in zip(parts, data["branch_begin"], data["branch_end"]):
        assert (np.abs(data["branch_multiplier"][part][1:-1]) > 1).all()
        for place, kind in ((part.start, begin), (part.stop - 1, end)):
            if kind in (END["fold"], END["period_doubling"]):
                assert abs(data["branch_multiplier"][place]) == pytest.approx(1, abs=1e-6)
        if begin in (END["fold"], END["period_doubling"]):  # what lies beyond its other end may not be visible in any cell
            assert np.abs(data["crossing_frequency_ratio"] - data["branch_frequency_ratio"][part.start]).min() < 1e-9


def test_the_loop_of_1_1_closes(branches):
    """From its fold down to where the impact speed vanishes: there the motion without impacts just reaches the stop."""
    data, parts = branches
    ends = {number: [data["branch_frequency_ratio"][place] for place in (part.start, part.stop - 1)]
            for number, part in enumerate(parts) if (data["branch_impacts"][number], data["branch_period"][number]) == (1, 1)}
    loops = [pair for pair in ends.values() if np.abs(np.array(pair) - FOLD_OF_1_1).min() < 1e-8]
    assert len(loops) == 1
    other = max(loops[0], key=lambda eta: abs(eta - FOLD_OF_1_1))
    reach = other**2 / np.hypot(1 - other**2, 2 * ZETA * other)
    assert reach == pytest.approx(GAP, abs=1e-9)


def after_cycles(eta, cycles, state, gap=GAP):
    """(x - y, x' - y') this many forcing cycles after phase 0, by Runge-Kutta from event to event."""
    def force(u, v):
        return KAPPA * (u - gap) + CHI * v

    def flight(t, x):
        return [x[1], -2 * ZETA * x[1] - x[0] + eta**2 * np.sin(eta * t)]

    def contact(t, x):
        return [x[1], -2 * ZETA * x[1] - x[0] + eta**2 * np.sin(eta * t) - force(*x)]

    def touches(_, x):  # from outside, or again before the hammer has left
        return min(x[0] - gap, force(*x) / KAPPA)
    def releases(_, x):
        return force(*x)
    touches.terminal, touches.direction, releases.terminal, releases.direction = True, 1, True, -1
    time, x, presses = 0.0, np.array(state), state[0] > gap and force(*state) > 0
    while time < (end := 2 * np.pi * cycles / eta):
        found = solve_ivp(contact if presses else flight, (time, end), x, method="DOP853", rtol=1e-12, atol=1e-13,
                          events=releases if presses else touches, max_step=0.01 if presses else 0.002)  # weak hops are short
        time, x, presses = found.t[-1], found.y[:, -1], not presses
        if found.status == 0:
            return x
    return x


def test_an_integrator_finds_them_to_be_unstable_orbits(branches):
    data, parts = branches
    tried = 0
    for number in [n for n, q in enumerate(data["branch_period"]) if q <= 2 and data["branch_points"][n] > 8][:4]:
        at = parts[number].start + int(data["branch_points"][number]) // 2
        eta, cycles = data["branch_frequency_ratio"][at], int(data["branch_period"][number])
        state = np.array([data["branch_stroboscopic_displacement"][at, 0], data["branch_stroboscopic_velocity"][at, 0]])
        assert after_cycles(eta, cycles, state) == pytest.approx(state, abs=1e-7)
        small = 1e-6
        columns = [(after_cycles(eta, cycles, state + step) - after_cycles(eta, cycles, state - step)) / (2 * small)
                   for step in small * np.eye(2)]
        values = np.linalg.eigvals(np.column_stack(columns))
        largest = values[np.argmax(np.abs(values))]
        assert abs(largest) > 1 and largest.real == pytest.approx(data["branch_multiplier"][at], rel=1e-3)
        tried += 1
    assert tried >= 2


@pytest.mark.parametrize("kind", ["fold", "period_doubling", "grazing"])
def test_an_integrator_stays_on_the_orbits_of_curves(branches, kind):
    """At a grazing an error decides whether the impact exists; its speed is the square root of that error."""
    data, _ = branches
    curves = np.flatnonzero((data["curve_kind"] == ("fold", "period_doubling", "grazing").index(kind)) & (data["curve_period"] <= 2))
    tried = 0
    for curve in curves[:4]:
        at = data["curve_first"][curve] + data["curve_points"][curve] // 2
        state = np.array([data["point_orbit_displacement"][at], data["point_orbit_velocity"][at]])
        end = after_cycles(data["point_frequency_ratio"][at], int(data["curve_period"][curve]), state, data["point_gap_ratio"][at])
        assert end == pytest.approx(state, abs=1e-3 if kind == "grazing" else 1e-6), curve
        tried += 1
    assert tried > 1


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_branches_on_a_rigid_stop_end_where_an_impact_vanishes(tmp_path, restitution):
    """There the monodromy matrix has a pole: eight branches, four with r = 0, were lost within 1e-6 of it."""
    text = jobs.with_rigid_stop(jobs.small_curves(points=20)).replace("coefficient = 0.5", f"coefficient = {restitution}")
    jobs.write(tmp_path, text + "\n[curves]\ngap_ratio = [0.5, 1.0, 1.5]\n")
    finished = launch.run("run", "job.toml", "--quiet", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as file:
        ends = file["branch_end"][()]
    assert np.sum(ends == END["grazing"]) >= 4 and not (ends == END["lost"]).any()
