"""Springs and gap from the times of impacts, against flights as real parts of a complex exponential; a pulse against steps in time."""

from dataclasses import replace

import numpy as np
import pytest
from peterka.identification import flights
from peterka.identification.contact_pulse import identified, pulse
from peterka.identification.flights import Start, from_events, likely
from peterka.identification.starts import Begin, Impact, _free_pulse
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

MASS, OMEGA, RATIO, GAP = 0.298, 2 * np.pi * 4.5, 0.01, 0.6e-3  # kg, rad/s, 1, m
RESTITUTION, CONTACT = 0.6, 1e-3  # 1, s
STIFFNESS, DAMPING = identified(MASS, RESTITUTION, CONTACT)
LAG = DAMPING / STIFFNESS  # s
TRUE = {"omega": OMEGA, "damping_ratio": RATIO, "gap": GAP}


def flight(place, speed):
    """(place, speed) [m, m/s] of the free hammer after a time [s]."""
    root = OMEGA * (-RATIO + 1j * np.sqrt(1 - RATIO**2))
    turn = complex(place, -(speed - root.real * place) / root.imag)  # Re(turn exp(root t)) begins with this place and speed
    return lambda time: ((turn * np.exp(root * time)).real, (root * turn * np.exp(root * time)).real)


def impacts(count, touch_error=1e-5, speed_error=0.03):
    """[Impact] of a hammer that meets the stop at 0.5 m/s first, 0.1 s after the beginning."""
    touch, speed, found = 0.1, 0.5, []
    for number in range(count):
        found.append(Impact(touch, speed, number, touch_error, speed_error))
        motion = flight(GAP + LAG * RESTITUTION * speed, -RESTITUTION * speed)
        back = np.linspace(0.01, 0.3, 3000)
        low = next(one for one, other in zip(back, back[1:]) if motion(one)[0] < GAP <= motion(other)[0])
        since = brentq(lambda time: motion(time)[0] - GAP, low, low + back[1] - back[0], xtol=1e-15)
        touch, speed = touch + CONTACT + since, motion(since)[1]
    return found


def begun(found, alone=True):
    return Begin(STIFFNESS, DAMPING / (2 * np.sqrt(STIFFNESS * MASS)), CONTACT, RESTITUTION, found, alone or None)


@pytest.mark.parametrize("given", [(), ("omega",), ("damping_ratio",), ("gap",), ("omega", "damping_ratio", "gap")])
def test_springs_and_gap_come_back_from_four_impacts(given):
    best = from_events(begun(impacts(4)), MASS, {name: TRUE[name] for name in given})[0]
    assert best.cost < 1e-9
    assert best.omega == pytest.approx(OMEGA, rel=1e-5) and best.value["damping_ratio"] == pytest.approx(RATIO, abs=1e-6)
    assert best.swing == pytest.approx(0.5 / OMEGA, rel=1e-5) and best.swing * best.value["gap"] == pytest.approx(GAP, rel=1e-4)
    assert best.value["stop_ratio"] == pytest.approx(DAMPING / (2 * np.sqrt(STIFFNESS * MASS)), rel=1e-4)


def test_starts_are_apart_and_the_best_first():
    found = from_events(begun(impacts(2)), MASS, {})
    assert len(found) > 2 and [one.cost for one in found] == sorted(one.cost for one in found)
    assert np.diff(np.sort(np.log([one.omega for one in found]))).min() > 0.5 * flights.APART


def test_one_impact_and_impacts_of_no_fit_of_their_own_tell_no_springs():
    four = impacts(4)
    assert from_events(begun(four[:1]), MASS, {}) == [] == from_events(begun(four, alone=False), MASS, {})
    assert from_events(begun([four[0], Impact(four[0].touch + 0.9 * CONTACT, 0.3, 1, 1e-5, 0.03)]), MASS, {}) == []


@pytest.mark.parametrize("off", [0.75, 1.3])
def test_a_restitution_that_few_samples_hardly_tell_is_found_by_the_flights(off):
    """Springs of the true frequency are the best start, or as good, where the restitution is off by its error."""
    few = begun(impacts(4, touch_error=5e-5))
    few = replace(few, restitution=off * RESTITUTION, restitution_error=0.3, contact_error=0.05)
    best = from_events(few, MASS, {})[0]
    assert best.omega == pytest.approx(OMEGA, rel=0.03)
    sure = from_events(replace(few, restitution_error=0.0), MASS, {})
    assert sure[0].cost > 3 * best.cost


def test_deviations_are_in_standard_deviations():
    """Of a restitution raised, of a gap told, of one touch that is late and of one speed that is larger, each alone."""
    exact = impacts(3)

    def rows(found=exact, told_gap=None, back=0.0):
        return flights._Off(begun(found), LAG, told_gap)(OMEGA, RATIO, back)

    assert flights._Off(begun(exact), LAG, None).restitution(0.7) == pytest.approx(RESTITUTION * np.exp(0.7 * flights.LEAST_SPEED))
    deviations, gap = rows()
    assert gap == pytest.approx(GAP, rel=1e-9) and deviations == pytest.approx(np.zeros(5), abs=1e-8)
    assert rows(back=0.7)[0][0] == 0.7
    assert rows(told_gap=GAP - 1e-5)[0][1] == pytest.approx(1e-5 * OMEGA / (0.5 * flights.LEAST_SPEED), rel=1e-6)
    late = [*exact[:2], Impact(exact[2].touch + 1e-7, exact[2].speed, 2, 4e-5, 0.01)]
    assert rows(late)[0][3] == pytest.approx(-1e-7 / 4e-5, rel=1e-3)
    hard = [*exact[:2], Impact(exact[2].touch, exact[2].speed * 1.1, 2, 1e-6, 0.01)]
    assert rows(hard)[0] == pytest.approx([0, 0, 0, 0, -np.log(1.1) / flights.LEAST_SPEED], abs=1e-7)
    sure = [*exact[:2], Impact(exact[2].touch + 1e-7, exact[2].speed * 1.1, 2, 1e-6, 0.05)]
    assert rows(sure)[0][3:] == pytest.approx([-1e-7 / (flights.LEAST_TIME * CONTACT), -np.log(1.1) / 0.05], rel=1e-3)


@pytest.mark.parametrize("least", [0.0, 0.1, 1.0])
def test_likely_starts_are_those_of_ten_times_the_least_cost_or_a_thousandth_of_its_likelihood(least):
    most = max(10 * least, least - np.log(1e-3))
    found = [Start(OMEGA, 1e-3, {}, cost) for cost in (least, 0.9 * most, most, most + 0.01)]
    assert likely(found) == found[:3]


@pytest.mark.parametrize("ratio", [0.02, 0.1, 0.5])
def test_the_pulse_of_a_free_mass_is_that_of_steps_in_time(ratio):
    damping = 2 * ratio * np.sqrt(STIFFNESS * MASS)

    def force(state):
        return STIFFNESS * state[0] + damping * state[1]

    end = pulse(MASS, STIFFNESS, damping)[1]
    times = np.linspace(0, 0.999 * end, 50)
    motion = solve_ivp(lambda _, state: (state[1], -force(state) / MASS), (0, end), (0.0, 1.0), t_eval=times, rtol=1e-10, atol=1e-15)
    assert _free_pulse(times, STIFFNESS, ratio, MASS) == pytest.approx(force(motion.y), rel=1e-6)
    assert list(_free_pulse(np.array([-1e-9, 1.001 * end, 3 * end]), STIFFNESS, ratio, MASS)) == [0, 0, 0]
