"""The second proof without the program: steps against scipy's DOP853, claims of three cells that the program proved, and altered ones."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import scipy.optimize
from peterka.second_proof import cells, guessing, shooting
from peterka.files.job_numbers import numbers_of_cell
from peterka.second_proof.balls import Ball, Series, Undecided, one, zero
from peterka.second_proof.cells import CONFIRMED, CONTRADICTED, NOT_DECIDED, Claim, rig_of, verdict_of
from peterka.second_proof.motion import DEPTH, PRESSURE, TIME, Phase, Rig, Step
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
    """(time [turns], (u, du/dT, ...)) -> their slopes, from the equation in motion.py; after the state, what it changes by with T, u and
    du/dT at first, as three times (u, du/dT)."""
    omega = 2 * np.pi * numbers["hammer.natural_frequency_hz"]
    s, spring = 2 * np.pi / numbers["operating_point.frequency_ratio"], numbers["hammer.mass_kg"] * omega**2
    zeta, gap = numbers["hammer.damping_ns_per_m"] / (2 * numbers["hammer.mass_kg"] * omega), numbers["operating_point.gap_ratio"]
    kappa, chi = numbers["contact.stiffness_n_per_m"] / spring, 2 * zeta * numbers["contact.damping_ns_per_m"] / numbers["hammer.damping_ns_per_m"]
    gamma = numbers.get("hammer.cubic_stiffness_n_per_m3", 0) * numbers["cart.amplitude_m"]**2 / spring
    absolute = numbers["hammer.cubic"] == "absolute"

    def change(time, state):
        u, w, *changes = state
        y, slope = np.sin(2 * np.pi * time), 2 * np.pi * np.cos(2 * np.pi * time)
        x = u + y if absolute else u
        damping, pull = s * (2 * zeta + chi * pressed), s**2 * (1 + kappa * pressed + 3 * gamma * x**2)
        by_time = slope * ((2 * np.pi)**2 - 3 * s**2 * gamma * (x**2 - y**2) * absolute)
        force = (2 * np.pi)**2 * y - s**2 * (u + kappa * (u - gap) * pressed + gamma * (x**3 - y**3 * absolute)) - damping * w
        return [w, force, *(slope for n, (v, dv) in enumerate(zip(changes[::2], changes[1::2]))
                            for slope in (dv, by_time * (n == 0) - pull * v - damping * dv))]

    return change


@pytest.mark.parametrize("pressed", [False, True])
@pytest.mark.parametrize("more", [{}, {"hammer.cubic_stiffness_n_per_m3": 3e7}, {"hammer.cubic_stiffness_n_per_m3": 3e7, "hammer.cubic": "absolute"}],
                         ids=["linear", "cubic", "absolute"])
def test_a_step_holds_the_motions_of_its_box_and_what_they_change_by(pressed, more):
    numbers = SOFT | more
    phase = Phase(rig_of(numbers), pressed)
    begin, length, state = 0.3, 0.4 / phase.rate, (0.7, -2.0)
    point = tuple(map(Ball.of, (begin, *state)))
    cloud, units = tuple(Ball(x.middle, 1 << 120) for x in point), [(one(), zero(), zero()), (zero(), one(), zero()), (zero(), zero(), one())]
    step = Step(phase, Ball.of(length), point, cloud, units)
    for theta in (0.25, 1.0):
        end = solve_ivp(change_of(numbers, pressed), (begin, begin + theta * length), [*state, 0, 0, 1, 0, 0, 1], "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
        middle, box = (step.state(of, Ball.of(theta)) for of in (step.point, step.cloud))
        assert [float(x) for x in middle] == pytest.approx([begin + theta * length, *end[:2]], rel=1e-11)
        assert all(whole.holds(part) and part.radius < 1 << 70 and 1 << 117 < whole.radius < 1 << 126 for whole, part in zip(box, middle))
        changes = step.changes(Ball.of(theta))
        assert [float(x) for _, *values in changes for x in values] == pytest.approx(end[2:], rel=1e-9, abs=1e-10)
        assert [float(since) for since, _, _ in changes] == [1, 0, 0]
        u_and_w = np.array([float(x) for x in middle[1:]])
        kappa, chi = float(phase.rig.stiffness), float(phase.rig.damping / phase.turn)
        for name, value, normal in ((DEPTH, u_and_w[0] - 0.4, (0, 1, 0)), (TIME, theta * length - 0.1, (1, 0, 0)),
                                    (PRESSURE, kappa * (u_and_w[0] - 0.4) + chi * u_and_w[1], (0, kappa, chi))):
            surface = step.surface(name, step.point, Ball.of(begin + 0.1)).at(Ball.of(theta))
            assert float(surface) == pytest.approx(value, rel=1e-11, abs=1e-13) and surface.radius < 1 << 80
            assert [float(x) for x in phase.normal(name)] == pytest.approx(normal, rel=1e-14)
            assert step.surface(name, step.cloud, Ball.of(begin + 0.1)).at(Ball.of(theta)).holds(surface)
    slopes = change_of(numbers, pressed)(begin, [*state, 0, 0, 1, 0, 0, 1])
    assert [float(x) for x in phase.accelerations(point, units)] == pytest.approx(slopes[1::2], rel=1e-12)
    met, changed = phase.within(cloud, units, Ball.of(length))
    for found, wholes in ((step.state(step.cloud, one()), met), *zip(step.changes(one()), changed)):
        assert all(whole.holds(part) for whole, part in zip(wholes, found))


def test_a_step_too_long_for_its_bounds_is_not_decided():
    for numbers in (NUMBERS, SOFT | {"hammer.cubic_stiffness_n_per_m3": 3e7}):
        with pytest.raises(Undecided, match="a step too long"):
            Phase(rig_of(numbers), True).within((zero(), one(), one()), [], Ball.of(1.0))


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
    return shooting.prove(*guessed())


@pytest.fixture
def proved():
    """(the orbit of NUMBERS, which is proved; a function: the verdict of the claim, changed, on this or another orbit)."""
    (rig, guess), orbit = guessed(), orbit_of_claim()
    return orbit, lambda orbit=orbit, **changes: cells._compared(replace(CLAIM, **changes), rig, guess, orbit)


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
    cells._show_shorter(rig, twice, orbit, 1)
    with pytest.raises(Undecided, match="may have a shorter period"):
        cells._show_shorter(rig, twice, replace(orbit, box=tuple(Ball(x.middle, 1) for x in orbit.box)), 1)
    elsewhere = replace(orbit, stops={2.0: orbit.stops[1.0], guess.time + 1: orbit.start})
    monkeypatch.setattr(cells, "_show_shorter", lambda *_: pytest.fail("was shown"))
    with pytest.raises(pytest.fail.Exception, match="was shown"):
        cells._compared(replace(CLAIM, period=2, impacts=2), rig, twice, elsewhere)


WITH_RENEWED = NUMBERS | {"hammer.damping_ns_per_m": 0.1 * 0.298 * 2 * np.pi * 4.5, "hammer.cubic_stiffness_n_per_m3": 1e7,
                          "contact.stiffness_n_per_m": 5000.0, "contact.damping_ns_per_m": 60.0,
                          "operating_point.frequency_ratio": 3.4, "operating_point.gap_ratio": 0.2631578947368421}
OF_RENEWED = Claim(1, 2, -3.052762681015511, -6.475855638515262, 0.8863212551498415, 0.886321277474119, 0.9439804392455837)


@cache
def guess_with_renewed_contact():
    return guessing.guess_of(rig_of(WITH_RENEWED), OF_RENEWED.displacement, OF_RENEWED.velocity, 2)


def test_a_contact_that_is_renewed_beyond_the_gap_is_confirmed():
    assert verdict_of(WITH_RENEWED, OF_RENEWED) == cells.Verdict(CONFIRMED)
    assert [kind for _, kind in guess_with_renewed_contact().events] == [shooting.TOUCH, shooting.RELEASE, shooting.RENEWED, shooting.RELEASE]


@pytest.mark.parametrize("kinds, why", [
    ("touch release touch release", "isn't where it was thought|can't be enclosed|may lie anywhere"),
    ("renewed release renewed release", "a renewed contact that may be a first one|isn't where it was thought|can't be enclosed"),
    ("touch release", "nearly has another event"), ("renewed release", "isn't where it was thought|can't be enclosed")])
def test_an_orbit_with_other_events_than_its_own_is_not_decided(kinds, why):
    guess = guess_with_renewed_contact()
    kinds = [{"renewed": shooting.RENEWED}.get(kind, kind) for kind in kinds.split()]
    times = [guess.events[n][0] for n in ((0, 1, 2, 3) if len(kinds) == 4 else (0, 3) if kinds[0] == shooting.TOUCH else (2, 3))]
    with pytest.raises(Undecided, match=why):
        shooting.prove(rig_of(WITH_RENEWED), replace(guess, events=list(zip(times, kinds, strict=True))))


WITHOUT_DASHPOT = SOFT | {"contact.damping_ns_per_m": 0.0, "hammer.damping_ns_per_m": 0.1 * 0.298 * 2 * np.pi * 4.5,
                          "operating_point.frequency_ratio": 1.4, "operating_point.gap_ratio": 0.5}


def test_where_the_stop_is_met_is_no_renewed_contact():
    """Without a dashpot P and u - g vanish together: a first touch alone."""
    rig = rig_of(WITHOUT_DASHPOT)
    state = guessing.follow(rig, np.zeros(2), 60.0)[0]
    guess = guessing.guess_of(rig, state[0], state[1] / float(rig.turn()), 1)
    shooting.prove(rig, guess)
    assert {kind for _, kind in guess.events} == {shooting.TOUCH, shooting.RELEASE}
    with pytest.raises(Undecided, match="a renewed contact that may be a first one"):
        shooting.prove(rig, replace(guess, events=[(time, kind.replace(shooting.TOUCH, shooting.RENEWED)) for time, kind in guess.events]))


def test_a_leg_ends_with_all_motions_on_its_surface(monkeypatch):
    """What they change by there changes nothing across the surface."""
    arrived, arrive = [], shooting.Shot._arrive

    def watched(shot, step, end, event):
        arrive(shot, step, end, event)
        normal = step.phase.normal(shooting._SURFACE[event][0])
        arrived.append(event)
        for change in shot.changes:
            across = sum((n * x for n, x in zip(normal, change)), zero())
            assert across.low <= 0 <= across.high and across.size < 1 << 130

    monkeypatch.setattr(shooting.Shot, "_arrive", watched)
    for rig, guess in ((rig_of(WITH_RENEWED), guess_with_renewed_contact()), guessed()):
        shooting.Shot(rig, guess, tuple(map(Ball.of, guess.state)), 1 << 60)
    assert set(arrived) == {shooting.TOUCH, shooting.RELEASE, shooting.RENEWED, shooting.ARRIVAL}


class Polynomials:
    """Stands for a step, of which `_show` asks u - g and P."""
    cloud = None

    def __init__(self, **surfaces):
        self._surfaces = surfaces

    def surface(self, name, *_):
        return Series(*map(Ball.of, self._surfaces.get("depth" if name == DEPTH else "pressure", [1.0])))


UP_DOWN_UP = [-0.021, 0.26, -0.95, 1.0]  # zeros at 0.15, 0.2 and 0.6, of (x - 0.15) (x - 0.2) (x - 0.6), nearly


@pytest.mark.parametrize("pressed, begun, ends, depth, pressure, is_shown", [
    (False, "", "", [-1.0], [1.0], True), (False, "", "", [1.0], [-1.0], True), (False, "", "", [1.0], [1.0], False),
    (False, "", shooting.TOUCH, [-0.5, 1.0], [1.0], True), (False, "", "", [-0.5, 1.0], [1.0], False),
    (False, "", shooting.RENEWED, [1.0], [-0.5, 1.0], True), (False, "", shooting.TOUCH, [1.0], [-0.5, 1.0], False),
    (False, "", shooting.TOUCH, UP_DOWN_UP, [1.0], False), (False, shooting.REBOUND, "", [0.0, -1.0], [1.0], True),
    (False, shooting.REBOUND, "", [0.0, 1.0], [1.0], False), (False, shooting.REBOUND, "", [0.0, -0.1, 1.0], [1.0], False),
    (False, shooting.RELEASE, shooting.TOUCH, [-0.5, 1.0], [0.0, -1.0, 4.0], True), (False, "", shooting.TOUCH, [-0.5, 1.0], [0.0, -1.0], True),
    (True, "", "", [-1.0], [1.0], True), (True, "", "", [1.0], [-1.0], False), (True, shooting.TOUCH, "", [0.0, 1.0], [0.0, 1.0], True),
    (True, shooting.RENEWED, "", [1.0], [0.0, 1.0], True), (True, shooting.TOUCH, shooting.RELEASE, [0.0, 1.0, -1.0], [0.01, 1.0, -2.0], True),
    (True, "", shooting.RELEASE, [1.0], [0.1, -1.0, 1.5], False)])
def test_a_leg_has_no_event_but_those_it_begins_and_ends_with(pressed, begun, ends, depth, pressure, is_shown):
    rig, guess = guessed()
    shot = shooting.Shot(rig, guess, tuple(map(Ball.of, guess.state)), 0)
    shot._pressed, shot._last_event, shot._radius = pressed, begun, 1
    step, until = Polynomials(depth=depth, pressure=pressure), Ball.of(0.7).middle
    if is_shown:
        shot._show(step, until, ends)
    else:
        with pytest.raises(Undecided, match="nearly has another event"):
            shot._show(step, until, ends)


@pytest.mark.parametrize("series, direction", [([-0.25, 0.0, 1.0], 1), ([-0.5, 1.0], 1), ([0.5, -1.0], -1)])
def test_a_zero_is_enclosed(series, direction):
    functions = Series(Ball(Ball.of(series[0]).middle, 1 << 100), *map(Ball.of, series[1:]))
    found = shooting._around(functions, Ball.of(0.5), direction)
    assert found.holds(Ball(Ball.of(0.5).middle, 1 << 100)) and found.radius < 1 << 103
    with pytest.raises(Undecided, match="can't be enclosed"):
        shooting._around(functions, Ball.of(0.5), -direction)


@pytest.mark.parametrize("series, place", [([0.25, -1.0, 1.0], 0.5), ([-2.0**-70, 0.0, 1.0], 2.0**-36), ([-0.5, 1.0], 0.7)])
def test_a_zero_where_functions_may_not_cross_is_not_enclosed(series, place):
    with pytest.raises(Undecided, match="may lie anywhere"):
        shooting._around(Series(*(Ball(Ball.of(x).middle, 1 << 100) for x in series)), Ball.of(place), 1)


def test_a_box_that_q_cycles_may_not_map_into_itself_is_not_decided(monkeypatch):
    newton_step = shooting.newton_step
    for share, is_shown in ((0.9, True), (1.1, False)):
        monkeypatch.setattr(shooting, "newton_step", lambda shot, start: newton_step(shot, start) if not shot._radius
                            else (Ball(int(share * shot._radius)), zero()))
        if is_shown:
            shooting.prove(*guessed())
        else:
            with pytest.raises(Undecided, match="no box that q cycles surely map into itself"):
                shooting.prove(*guessed())


@pytest.mark.parametrize("numbers", [NUMBERS, SOFT | {"hammer.cubic_stiffness_n_per_m3": 3e7, "hammer.cubic": "absolute"}, WITHOUT_DASHPOT],
                         ids=["linear", "absolute", "no dashpot"])
def test_what_a_series_leaves_out_is_enclosed(numbers):
    """Of a step four times as long as its order is for, against many short ones."""
    phase = Phase(rig_of(numbers), True)
    length, state, units = Ball.of(0.2 / phase.rate), tuple(map(Ball.of, (0.3, 0.7, -2.0))), [(zero(), one(), zero())]
    exact, changed = state, units
    for _ in range(8):
        short = Step(phase, Ball(length.middle >> 3), exact, exact, changed)
        exact, changed = short.state(short.point, one()), short.changes(one())
    true = short.surface(PRESSURE, short.point, zero()).at(one())
    phase.rate /= 4
    step = Step(phase, length, state, state, units)
    pressure = step.surface(PRESSURE, step.point, zero()).at(one())
    for whole, part in zip((*step.state(step.point, one()), *step.changes(one())[0], pressure), (*exact, *changed[0], true)):
        assert not whole.apart(part)
    assert pressure.radius > 1 << 20


def test_a_guess_follows_the_equation():
    numbers = SOFT | {"hammer.cubic_stiffness_n_per_m3": 3e7, "hammer.cubic": "absolute"}
    state, events = guessing.follow(rig_of(numbers), np.array([-2.0, 1.0]), 0.45, 0.25)
    end = solve_ivp(change_of(numbers, False), (0.25, 0.45), [-2.0, 1.0], "DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    assert state == pytest.approx(end, rel=1e-8) and events == []


def swing_through_the_stop(eta, chi, kappa, share, zeta=0.05):
    """(rig, guess): the steady motion without a stop, whose gap is a share of its amplitude; with the moment when P falls through 0 as an event."""
    s, turn = 2 * np.pi / eta, 2 * np.pi
    response = turn**2 / (s**2 - turn**2 + 2j * zeta * s * turn)
    gap, top = share * abs(response), (0.25 - np.angle(response) / turn) % 1

    def state(time):
        turned = response * np.exp(1j * turn * time)
        return turned.imag, turn * turned.real

    def pressure(time):
        return kappa * (state(time)[0] - gap) + chi * state(time)[1] / s

    begin = round((top - 0.4) % 1 * 2**20) / 2**20
    release = scipy.optimize.brentq(pressure, top, top + 0.24)
    rig = Rig(*map(Ball.of, (eta, zeta, kappa, chi, gap, 0.0)), absolute=False, unit=one())
    return rig, shooting.Guess(begin, state(begin), [(release + (release < begin), shooting.RELEASE)], 1)


@pytest.mark.parametrize("numbers", [(0.5, 50, 1, 0.997), (0.7, 20, 0.5, 0.998), (1, 100, 10, 0.998), (1, 10, 100, 0.9999)])
def test_a_release_without_a_contact_proves_nothing(numbers):
    """A strong dashpot's P falls while the hammer is still before the stop, so that no one looks whether it touches this."""
    with pytest.raises(Undecided, match="an event that can't follow"):
        shooting.prove(*swing_through_the_stop(*numbers))


@pytest.mark.parametrize("kinds", [[shooting.BOUNCE], [shooting.TOUCH, shooting.TOUCH], [shooting.TOUCH, shooting.RENEWED], [shooting.RELEASE, shooting.TOUCH]])
def test_events_follow_from_the_phase(kinds):
    rig, guess = guessed()
    times = [time for time, _ in guess.events]
    with pytest.raises(Undecided, match="an event that can't follow"):
        shooting.prove(rig, replace(guess, events=list(zip(times, kinds))))


def test_a_rigid_stop_has_bounces_alone():
    claim = rigid_claim(RIGID, 1)
    guess = guessing.guess_of(rig_of(RIGID), claim.displacement, claim.velocity, 1)
    with pytest.raises(Undecided, match="an event that can't follow"):
        shooting.prove(rig_of(RIGID), replace(guess, events=[(time, shooting.TOUCH) for time, _ in guess.events]))


def test_the_zero_of_the_middle_lies_among_those_of_the_box(monkeypatch):
    around, found = shooting._around, []

    def shifted(series, theta, direction):
        found.append(around(series, theta, direction))
        return found[-1] if len(found) % 2 == 0 else Ball(found[-1].middle + (1 << 150), found[-1].radius)

    monkeypatch.setattr(shooting, "_around", shifted)
    rig, guess = guessed()
    with pytest.raises(Undecided, match="an event that isn't enclosed"):
        shooting.Shot(rig, guess, tuple(map(Ball.of, guess.state)), 1 << 60)


@pytest.mark.parametrize("before", [1e-12, 2.0**-19])
def test_a_guess_may_begin_at_the_end_of_the_period(monkeypatch, before):
    """Which is its beginning."""
    follow = guessing.follow
    events = [(0.5 - 2 * before, shooting.TOUCH), (0.5, shooting.RELEASE)]
    monkeypatch.setattr(guessing, "follow", lambda rig, state, until, time=0.0: (np.zeros(2), events))
    guess = guessing.guess_of(guessed()[0], 0.0, 0.0, 1)
    assert 0 <= guess.time < 1 and (guess.time == 0) == (before < 1e-6)
    monkeypatch.setattr(guessing, "follow", follow)


@pytest.mark.parametrize("numbers, claim, most", [(NUMBERS, CLAIM, 400), (ABSOLUTE, OF_ABSOLUTE, 130)], ids=["linear", "cubic"])
def test_contacts_that_cost_too_many_digits_are_not_decided(monkeypatch, numbers, claim, most):
    asked = []
    monkeypatch.setattr(cells, "prove", lambda *_: asked.append(Ball.bits) or orbit_of_claim())
    for growth, word in ((most, CONFIRMED), (most + 1, NOT_DECIDED)):
        monkeypatch.setattr(cells, "growth_of", lambda *_, growth=growth: growth)
        monkeypatch.setattr(cells, "_compared", lambda *_: cells.Verdict(CONFIRMED))
        assert verdict_of(numbers, claim).word == word
    assert asked == [120 + 2 * most]


def test_of_an_orbit_without_contacts_nothing_is_decided():
    far = NUMBERS | {"operating_point.gap_ratio": 50.0}
    found = verdict_of(far, replace(CLAIM, displacement=0.0, velocity=0.0))
    assert found == cells.Verdict(NOT_DECIDED, "the orbit meets no stop")


def test_numbers_of_a_cell_are_those_of_its_axes_first():
    tables = {"hammer": {"mass_kg": 0.3, "stiffness_n_per_m": 240.0}, "operating_point": {"gap_m": 1e-3}, "contact": {"damping_ns_per_m": 5.0}}
    assert numbers_of_cell(tables, {"gap_ratio": 0.5, "hammer_natural_frequency_hz": 1.5}) == {
        "hammer.mass_kg": 0.3, "hammer.natural_frequency_hz": 1.5, "contact.damping_ns_per_m": 5.0, "operating_point.gap_ratio": 0.5}
    assert numbers_of_cell(tables, {"contact_damping_ns_per_m": 7.0})["contact.damping_ns_per_m"] == 7.0
    of_ratios = {"hammer": {"damping_ratio": 0.1}, "operating_point": {"frequency_ratio": 2.0}}
    assert numbers_of_cell(of_ratios, {"frequency_hz": 3.0, "hammer_damping_ns_per_m": 0.2}) == {
        "operating_point.frequency_hz": 3.0, "hammer.damping_ns_per_m": 0.2}


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
    changes = shooting.Shot(rig, guess, start, 1 << 100).changes
    step, ends = 1e-6, {}
    for n, sign in ((n, sign) for n in (0, 1) for sign in (1, -1)):
        state = np.array(guess.state) + sign * step * np.eye(2)[n]
        ends[n, sign] = guessing.follow(rig, state, guess.time + 1, guess.time)[0]
    for n in (0, 1):
        differences = (ends[n, 1] - ends[n, -1]) / (2 * step)
        assert [float(x) for x in changes[n][1:]] == pytest.approx(differences, rel=1e-5, abs=1e-6)


def test_a_path_through_a_rigid_stop_is_no_orbit():
    """One that closes, and goes through the stop on its way to the impact."""
    eta = 0.9
    numbers = RIGID | {"operating_point.frequency_ratio": eta, "operating_point.gap_ratio": 0.1}
    (u, w), _, _, time = single_impact(numbers, 1, pierces=True)
    guess = shooting.Guess(0.0, (u, w * 2 * np.pi / eta), [(time, shooting.BOUNCE)], 1)
    with pytest.raises(Undecided, match="a leg that nearly has another event"):
        shooting.prove(rig_of(numbers), guess)


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
    with pytest.raises(Undecided, match="a leg that nearly has another event"):
        shooting.Shot(rig_of(RIGID | {"contact.coefficient": 0.0}), guess, tuple(map(Ball.of, guess.state)), 1 << 100)


def test_impacts_that_end_in_rest_are_not_decided():
    found = verdict_of(RIGID | {"contact.coefficient": 0.2, "operating_point.frequency_ratio": 0.7, "operating_point.gap_ratio": 0.0},
                       replace(rigid_claim(RIGID, 1), displacement=-0.1, velocity=0.0))
    assert found.word == NOT_DECIDED
