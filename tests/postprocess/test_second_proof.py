"""The second proof without the program: steps against scipy's DOP853, claims of three cells that the program proved, and altered ones."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import scipy.optimize
from peterka.second_proof import cells, guessing, shooting
from peterka.second_proof.balls import Ball, Undecided, one, sine_cosine
from peterka.second_proof.cells import CONFIRMED, CONTRADICTED, NOT_DECIDED, Claim, rig_of, verdict_of
from peterka.second_proof.motion import Phase, Step
from scipy.integrate import solve_ivp

NUMBERS = {"hammer.mass_kg": 0.298, "hammer.natural_frequency_hz": 4.5, "hammer.damping_ns_per_m": 0.06, "cart.amplitude_m": 0.89e-3,
           "contact.stiffness_n_per_m": 5.5e6, "contact.damping_ns_per_m": 1200.0, "hammer.cubic": "relative",
           "operating_point.frequency_ratio": 1.4, "operating_point.gap_ratio": 0.1}
ABSOLUTE = NUMBERS | {"hammer.cubic_stiffness_n_per_m3": 238.23, "hammer.cubic": "absolute"}
LATER = NUMBERS | {"operating_point.frequency_ratio": 4.4}
CLAIM = Claim(1, 1, -2.18248379237656, -0.6220947926924877, 38.32160629336081, 38.32160629336508, 0.6837614662225681)
OF_ABSOLUTE = Claim(1, 1, -2.18248379237656, -0.6220947926924877, 38.321504987553254, 38.32150498757458, 0.6837484486210549)
OF_TWO = Claim(1, 2, -4.42363452724972, -2.2218273615624566, 80.54092292710727, 80.54092292711364, 0.8963509890306365)
SOFT = NUMBERS | {"contact.stiffness_n_per_m": 2.4e4, "contact.damping_ns_per_m": 30.0, "operating_point.gap_ratio": 0.4}


@pytest.fixture(autouse=True)
def bits(monkeypatch):
    monkeypatch.setattr(Ball, "bits", 160)


def change_of(numbers, pressed):
    """(time [turns], (u, du/dT, ...)) -> their slopes, from the equation in motion.py; after the state, two columns of its derivative."""
    omega = 2 * np.pi * numbers["hammer.natural_frequency_hz"]
    s, spring = 2 * np.pi / numbers["operating_point.frequency_ratio"], numbers["hammer.mass_kg"] * omega**2
    zeta, gap = numbers["hammer.damping_ns_per_m"] / (2 * numbers["hammer.mass_kg"] * omega), numbers["operating_point.gap_ratio"]
    kappa, chi = numbers["contact.stiffness_n_per_m"] / spring, 2 * zeta * numbers["contact.damping_ns_per_m"] / numbers["hammer.damping_ns_per_m"]
    gamma = numbers.get("hammer.cubic_stiffness_n_per_m3", 0) * numbers["cart.amplitude_m"]**2 / spring
    absolute = numbers["hammer.cubic"] == "absolute"

    def change(time, state):
        u, w, *columns = state
        y = np.sin(2 * np.pi * time)
        x = u + y if absolute else u
        damping, pull = s * (2 * zeta + chi * pressed), s**2 * (1 + kappa * pressed + 3 * gamma * x**2)
        force = (2 * np.pi)**2 * y - s**2 * (u + kappa * (u - gap) * pressed + gamma * (x**3 - y**3 * absolute)) - damping * w
        return [w, force, *columns[2:], *(-pull * a - damping * b for a, b in zip(columns[:2], columns[2:]))]

    return change


@pytest.mark.parametrize("pressed", [False, True])
@pytest.mark.parametrize("more", [{}, {"hammer.cubic_stiffness_n_per_m3": 3e7}, {"hammer.cubic_stiffness_n_per_m3": 3e7, "hammer.cubic": "absolute"}],
                         ids=["linear", "cubic", "absolute"])
def test_a_step_holds_the_motions_of_its_box_and_their_derivatives(pressed, more):
    numbers = SOFT | more
    phase = Phase(rig_of(numbers), pressed)
    begin, length, state = 0.3, phase.longest_step() / 2, (0.7, -2.0)
    cloud = tuple(Ball(Ball.of(x).middle, 1 << 120) for x in state)
    step = Step(phase, Ball.of(begin), Ball.of(length), tuple(map(Ball.of, state)), cloud)
    for theta in (0.25, 1.0):
        end = solve_ivp(change_of(numbers, pressed), (begin, begin + theta * length), [*state, 1, 0, 0, 1], "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
        point, box = (step.state(of, Ball.of(theta)) for of in (step.point, step.cloud))
        assert [float(x) for x in point] == pytest.approx(end[:2], rel=1e-11)
        assert all(whole.holds(part) and part.radius < 1 << 70 and 1 << 117 < whole.radius < 1 << 124 for whole, part in zip(box, point))
        assert [float(x) for row in step.flow(Ball.of(theta)) for x in row] == pytest.approx(end[2:], rel=1e-9, abs=1e-10)
        assert step.penetration(step.point).at(Ball.of(theta)).apart(point[0] - phase.rig.gap) is False
        if pressed:
            assert not step.pressure(step.point).at(Ball.of(theta)).apart(phase.pressure_at(point))
            assert step.pressure(step.point).at(Ball.of(theta)).radius < 1 << 80
    sine = sine_cosine(Ball.of(begin))[0]
    slopes = change_of(numbers, pressed)(begin, [*state, 1, 0, 0, 1])
    assert float(phase.acceleration(tuple(map(Ball.of, state)), sine)) == pytest.approx(slopes[1], rel=1e-12)
    assert -float(phase.slope(Ball.of(state[0]), sine)) == pytest.approx(slopes[4], rel=1e-12)
    met = phase.within(Ball.of(begin), Ball.of(length), cloud)
    assert all(whole.holds(part) for whole, part in zip(met, step.state(step.cloud, one())))


def test_a_step_too_long_for_its_bounds_is_not_decided():
    phase = Phase(rig_of(NUMBERS), True)
    with pytest.raises(Undecided, match="a step too long"):
        phase.within(Ball.of(0.0), Ball.of(1.0), (one(), one()))


@pytest.mark.parametrize("numbers, claim", [(NUMBERS, CLAIM), (ABSOLUTE, OF_ABSOLUTE), (LATER, OF_TWO)], ids=["linear", "absolute", "1/2"])
def test_what_the_program_proved_is_confirmed(numbers, claim):
    assert verdict_of(numbers, claim) == cells.Verdict(CONFIRMED)


def test_a_rig_by_other_keys_is_the_same():
    """Its numbers as doubles differ in the last bits."""
    omega = 2 * np.pi * 4.5
    others = {"hammer.mass_kg": 0.298, "hammer.stiffness_n_per_m": 0.298 * omega**2, "hammer.damping_ratio": 0.06 / (2 * 0.298 * omega),
              "cart.amplitude_m": 0.89e-3, "contact.stiffness_n_per_m": 5.5e6, "contact.damping_ns_per_m": 1200.0,
              "operating_point.frequency_hz": 1.4 * 4.5, "operating_point.gap_m": 0.1 * 0.89e-3}
    one_rig, other = rig_of(NUMBERS), rig_of(others)
    for name in ("frequency", "damping_ratio", "stiffness", "damping", "gap", "cubic", "unit"):
        assert float(getattr(one_rig, name)) == pytest.approx(float(getattr(other, name)), rel=1e-14), name
    assert float(rig_of(ABSOLUTE).cubic) == pytest.approx(238.23 * 0.89e-3**2 / (0.298 * omega**2), rel=1e-14)
    assert rig_of(ABSOLUTE).absolute and not one_rig.absolute and one_rig.cubic.size == 0
    assert float(one_rig.unit) == pytest.approx(omega**2 * 0.89e-3 / 9.80665, rel=1e-14)


@cache
def guessed():
    """(rig, guess) of the claim on NUMBERS."""
    return rig_of(NUMBERS), guessing.guess_of(rig_of(NUMBERS), CLAIM.displacement, CLAIM.velocity, 1)


@cache
def orbit_of_claim():
    return shooting.prove(*guessed(), 1 << 110, {1.0})


@pytest.fixture
def proved():
    """(the orbit of NUMBERS, which is proved; a function: the verdict of the claim, changed, on this or another orbit)."""
    (rig, guess), orbit, radius = guessed(), orbit_of_claim(), 1 << 110
    return orbit, lambda orbit=orbit, **changes: cells._compared(replace(CLAIM, **changes), rig, guess, orbit, radius)


def test_each_number_of_a_claim_is_compared(proved):
    verdict = proved[1]
    low, high, tiny = CLAIM.lower, CLAIM.upper, 1e-9
    assert verdict() == cells.Verdict(CONFIRMED) == verdict(lower=low - tiny) == verdict(stability_margin=0.999 * CLAIM.stability_margin)
    for changes, words in (
            ({"lower": high + tiny, "upper": high + 2 * tiny}, "its largest force is 38.32160629336"),
            ({"lower": low - 2 * tiny, "upper": low - tiny}, "its largest force is 38.32160629336"),
            ({"stability_margin": 1.001 * CLAIM.stability_margin}, "it is less stable"),
            ({"impacts": 2}, "it touches the stop 1 times, not 2"), ({"impacts": 0}, "it touches the stop 1 times, not 0")):
        found = verdict(**changes)
        assert found.word == CONTRADICTED and found.why.startswith(words), found
    for changes in ({"displacement": CLAIM.displacement * (1 + 3e-6)}, {"velocity": CLAIM.velocity - 3e-6}):
        assert verdict(**changes) == cells.Verdict(NOT_DECIDED, "the orbit found isn't the cell's")
    assert verdict(displacement=CLAIM.displacement * (1 + 5e-7)).word == CONFIRMED


@pytest.mark.parametrize("trace, determinant", [(0.0, 1.01), (0.0, -1.01), (2.0, 0.9), (-2.0, 0.9)])
def test_an_orbit_is_stable_inside_jurys_triangle_alone(proved, trace, determinant):
    """Whose sides are determinant 1 and trace +-(1 + determinant)."""
    orbit, verdict = proved
    outside = replace(orbit, trace=Ball.of(trace), determinant=Ball.of(determinant))
    assert verdict(outside) == cells.Verdict(CONTRADICTED, "it is unstable")
    inside = replace(orbit, trace=Ball.of(0.9 * trace), determinant=Ball.of(0.95 * determinant))
    assert verdict(inside, stability_margin=0.01).word == CONFIRMED
    on_it = replace(outside, trace=Ball(Ball.of(trace * 0.95).middle, 1 << 160), determinant=Ball(Ball.of(determinant).middle, 1 << 157))
    with pytest.raises(Undecided, match="can't be told from the unit circle"):
        verdict(on_it, stability_margin=0.0)


def test_a_period_of_two_of_its_own_is_contradicted():
    assert verdict_of(NUMBERS, replace(CLAIM, period=2, impacts=2)) == cells.Verdict(CONTRADICTED, "it repeats itself after 1 cycles")


def test_a_shorter_period_is_shown_and_not_concluded(monkeypatch):
    """From an orbit that is the same after half its period: the box of the shorter one must hold it."""
    (rig, guess), orbit = guessed(), orbit_of_claim()
    twice = replace(guess, period=2, events=[*guess.events, *((time + 1, kind) for time, kind in guess.events)])
    cells._show_shorter(rig, twice, orbit, 1 << 110, 1)
    with pytest.raises(Undecided, match="may have a shorter period"):
        cells._show_shorter(rig, twice, replace(orbit, start=tuple(Ball(x.middle, 1 << 100) for x in orbit.start)), 1 << 110, 1)
    elsewhere = replace(orbit, stops={2.0: orbit.stops[1.0], guess.time + 1: orbit.start})
    monkeypatch.setattr(cells, "_show_shorter", lambda *_: pytest.fail("was shown"))
    with pytest.raises(pytest.fail.Exception, match="was shown"):
        cells._compared(replace(CLAIM, period=2, impacts=2), rig, twice, elsewhere, 1 << 110)


@pytest.mark.parametrize("event, place, speed, acceleration, is_shown", [
    (shooting.TOUCH, 0.1, 1.0, 0.0, True), (shooting.TOUCH, 0.1, -1.0, 0.0, False),
    (shooting.RELEASE, 0.1, -1.0, -1.0, True), (shooting.RELEASE, 0.1, 1.0, 1.0, False),
    (shooting.RENEWED, 0.2, 1.0, 1.0, True), (shooting.RENEWED, 0.2, -1.0, -1.0, False), (shooting.RENEWED, 0.05, 1.0, 1.0, False)])
def test_while_motions_have_their_event_no_other_follows(event, place, speed, acceleration, is_shown):
    """At a gap of 0.1: a touch rises, a release falls, and a renewed contact is beyond the gap."""
    rig, guess = guessed()
    shot = shooting.Shot(rig, guess, tuple(map(Ball.of, guess.state)), 1 << 110)
    met = Ball.of(place), Ball.of(speed)
    if is_shown:
        shot._show_after(event, met, Ball.of(acceleration))
    else:
        with pytest.raises(Undecided, match="another may follow at once"):
            shot._show_after(event, met, Ball.of(acceleration))


def test_no_motion_is_followed_through_an_event_that_another_may_follow(monkeypatch):
    told = []
    monkeypatch.setattr(shooting.Shot, "_show_after", lambda _, event, *__: told.append(event))
    rig, guess = guessed()
    shooting.Shot(rig, guess, tuple(map(Ball.of, guess.state)), 1 << 110)
    assert told == [shooting.TOUCH, shooting.RELEASE]


def test_parts_of_a_period():
    assert [cells._parts(period) for period in (1, 2, 4, 12, 15, 7)] == [[], [2], [2], [2, 3], [3, 5], [7]]


def test_of_an_orbit_without_contacts_nothing_is_decided():
    far = NUMBERS | {"operating_point.gap_ratio": 50.0}
    found = verdict_of(far, replace(CLAIM, displacement=0.0, velocity=0.0))
    assert found == cells.Verdict(NOT_DECIDED, "the orbit meets no stop")


def test_numbers_of_a_cell_are_those_of_its_axes_first():
    tables = {"hammer": {"mass_kg": 0.3, "stiffness_n_per_m": 240.0}, "operating_point": {"gap_m": 1e-3}, "contact": {"damping_ns_per_m": 5.0},
              "axes": {"gap_ratio": {"from": 0, "to": 1}, "hammer": {"natural_frequency_hz": {"from": 1, "to": 2}}}}
    assert cells.axes_of(tables) == [("gap_ratio", "gap_ratio"), ("hammer.natural_frequency_hz", "hammer_natural_frequency_hz")]
    assert cells.numbers_of_cell(tables, {"gap_ratio": 0.5, "hammer.natural_frequency_hz": 1.5}) == {
        "hammer.mass_kg": 0.3, "hammer.natural_frequency_hz": 1.5, "contact.damping_ns_per_m": 5.0, "operating_point.gap_ratio": 0.5}
    assert cells.numbers_of_cell(tables, {"contact.damping_ns_per_m": 7.0})["contact.damping_ns_per_m"] == 7.0


def test_a_guess_begins_in_the_middle_of_its_longest_flight():
    guess = guessing.guess_of(rig_of(LATER), OF_TWO.displacement, OF_TWO.velocity, 2)
    (touch, first), (release, second) = guess.events
    assert (first, second) == (shooting.TOUCH, shooting.RELEASE) and guess.time < touch < release < guess.time + 2 == guess.time + guess.period
    assert touch - guess.time == pytest.approx(guess.time + 2 - release, abs=1e-5)
    end = solve_ivp(change_of(LATER, False), (guess.time, touch), guess.state, "DOP853", rtol=1e-12, atol=1e-13).y[0, -1]
    assert end == pytest.approx(0.1, abs=1e-7)


RIGID = {"hammer.mass_kg": 1.2, "hammer.natural_frequency_hz": 22.0, "hammer.damping_ratio": 0.015, "cart.amplitude_m": 0.6e-3,
         "contact.law": "restitution", "contact.coefficient": 0.6, "operating_point.frequency_ratio": 1.7, "operating_point.gap_ratio": 0.3}


def single_impact(numbers, cycles, pierces=False):
    """The orbit of one impact in `cycles`, in closed form but for two unknowns (Peterka 1974): (its state at phase 0 as x - y and x' - y' in
    A0 and A0 omega, impact speed [m/s], margin of stability, time of the impact [turns]). Of the motion with the period, det = r^2 exp(-2 zeta T) and the trace is that
    of its saltation and flight. `pierces`: one that would go through the stop on its way instead, stable or not."""
    eta, zeta, gap, r = (numbers[f"{name}"] for name in ("operating_point.frequency_ratio", "hammer.damping_ratio", "operating_point.gap_ratio",
                                                        "contact.coefficient"))
    response, rate, length = eta**2 / (1 - eta**2 + 2j * zeta * eta), np.sqrt(1 - zeta**2), 2 * np.pi * cycles / eta

    def steady(t):
        turned = response * np.exp(1j * eta * t)
        return np.array([turned.imag, (1j * eta * turned).imag])

    def flow(t):
        c, s = np.exp(-zeta * t) * np.cos(rate * t), np.exp(-zeta * t) * np.sin(rate * t) / rate
        return np.array([[c + zeta * s, s], [-s, c - zeta * s]])

    def closes(unknown):
        t, v = unknown
        end = flow(length) @ (np.array([gap, -r * v]) - steady(t)) + steady(t + length)
        return end - [gap, v]

    starts = [(t, v) for t in np.linspace(0, 2 * np.pi / eta, 12, endpoint=False) for v in (0.5, 2.0, 4.0)]
    found = [root.x for root in (scipy.optimize.root(closes, start, tol=1e-14) for start in starts) if root.success and root.x[1] > 0.1]
    for t, v in found:
        t %= 2 * np.pi / eta
        before, after = (-gap - 2 * zeta * w + eta**2 * np.sin(eta * t) for w in (v, -r * v))
        monodromy = flow(length) @ np.array([[-r, 0], [(after + r * before) / v, -r]])
        trace, determinant = np.trace(monodromy), np.linalg.det(monodromy)
        margin = min(1 - determinant, 1 + determinant - abs(trace))
        inside = flow(np.linspace(0, length, 400)[1:-1])
        path = inside[0, 0] * (gap - steady(t)[0]) + inside[0, 1] * (-r * v - steady(t)[1]) + steady(t + np.linspace(0, length, 400)[1:-1])[0]
        if (path.max() > gap + 0.1) if pierces else (margin > 0 and path.max() < gap):
            wait = cycles * 2 * np.pi / eta - t if t > 0 else 0.0
            state = flow(wait) @ (np.array([gap, -r * v]) - steady(t)) + steady(0.0)
            return state, v * numbers["cart.amplitude_m"] * 2 * np.pi * numbers["hammer.natural_frequency_hz"], margin, eta * t / (2 * np.pi)
    raise AssertionError("no stable orbit of a single impact")


def rigid_claim(numbers, cycles):
    (u, w), speed, margin, _ = single_impact(numbers, cycles)
    return Claim(1, cycles, u, w, speed * (1 - 1e-12), speed * (1 + 1e-12), margin * (1 - 1e-9))


@pytest.mark.parametrize("changes, cycles", [({}, 1), ({"contact.coefficient": 0.9}, 1), ({"operating_point.frequency_ratio": 1.3,
                                             "operating_point.gap_ratio": 1.5}, 1), ({"operating_point.frequency_ratio": 4.0}, 2)])
def test_an_orbit_of_a_rigid_stop_in_closed_form_is_confirmed(changes, cycles):
    numbers = RIGID | changes
    assert verdict_of(numbers, rigid_claim(numbers, cycles)) == cells.Verdict(CONFIRMED)


def test_each_number_of_a_rigid_stop_is_compared():
    claim = rigid_claim(RIGID, 1)
    for changes, words in (({"lower": claim.upper * (1 + 1e-9), "upper": claim.upper * (1 + 2e-9)}, "its largest impact speed is"),
                           ({"lower": claim.lower * (1 - 2e-9), "upper": claim.lower * (1 - 1e-9)}, "its largest impact speed is"),
                           ({"stability_margin": claim.stability_margin * 1.001}, "it is less stable"),
                           ({"impacts": 2}, "it touches the stop 1 times, not 2"), ({"impacts": 2, "period": 2}, "it repeats itself after 1 cycles")):
        found = verdict_of(RIGID, replace(claim, **changes))
        assert found.word == CONTRADICTED and found.why.startswith(words), (changes, found)
    for other in ({"contact.coefficient": 0.6001}, {"operating_point.gap_ratio": 0.3001}, {"hammer.damping_ratio": 0.0151}):
        assert verdict_of(RIGID | other, claim).word != CONFIRMED, other


def test_a_rebound_is_the_derivative_of_its_motions():
    """The derivative of q cycles through a bounce, against differences of motions by scipy's integrator."""
    claim = rigid_claim(RIGID, 1)
    rig = rig_of(RIGID)
    guess = guessing.guess_of(rig, claim.displacement, claim.velocity, 1)
    start = tuple(map(Ball.of, guess.state))
    flow = shooting.Shot(rig, guess, start, 1 << 100).passage().flow
    step, ends = 1e-6, {}
    for n, sign in ((n, sign) for n in (0, 1) for sign in (1, -1)):
        state = np.array(guess.state) + sign * step * np.eye(2)[n]
        ends[n, sign] = guessing.Simulation(rig, state, guess.time).run(guess.time + 1).state
    for n in (0, 1):
        differences = (ends[n, 1] - ends[n, -1]) / (2 * step)
        assert [float(row[n]) for row in flow] == pytest.approx(differences, rel=1e-5, abs=1e-6)


def test_a_path_through_a_rigid_stop_is_no_orbit():
    """One that closes, and goes through the stop on its way to the impact."""
    eta = 0.9
    numbers = RIGID | {"operating_point.frequency_ratio": eta, "operating_point.gap_ratio": 0.1}
    (u, w), _, _, time = single_impact(numbers, 1, pierces=True)
    guess = shooting.Guess(0.0, (u, w * 2 * np.pi / eta), [(time, shooting.BOUNCE)], 1)
    with pytest.raises(Undecided, match="a leg that nearly has another event"):
        shooting.prove(rig_of(numbers), guess, 1 << 100, ())


def test_the_way_to_an_impact_is_shown_to_its_end(monkeypatch):
    told = []
    monkeypatch.setattr(shooting.Shot, "_show", lambda _, step, until, event: told.append(event))
    claim = rigid_claim(RIGID, 1)
    guess = guessing.guess_of(rig_of(RIGID), claim.displacement, claim.velocity, 1)
    shooting.Shot(rig_of(RIGID), guess, tuple(map(Ball.of, guess.state)), 1 << 100)
    assert told.count(shooting.BOUNCE) == 1 < len(told) and set(told) == {"", shooting.BOUNCE}


def test_after_an_impact_the_hammer_surely_leaves():
    claim = rigid_claim(RIGID, 1)
    guess = guessing.guess_of(rig_of(RIGID), claim.displacement, claim.velocity, 1)
    with pytest.raises(Undecided, match="an impact that another may follow at once"):
        shooting.Shot(rig_of(RIGID | {"contact.coefficient": 0.0}), guess, tuple(map(Ball.of, guess.state)), 1 << 100)


def test_impacts_that_end_in_rest_are_not_decided():
    found = verdict_of(RIGID | {"contact.coefficient": 0.2, "operating_point.frequency_ratio": 0.7, "operating_point.gap_ratio": 0.0},
                       replace(rigid_claim(RIGID, 1), displacement=-0.1, velocity=0.0))
    assert found.word == NOT_DECIDED
