"""What identification begins with: pulses and signs, samples and means, first numbers of stop, springs and gap; solving and its errors."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from peterka.errors import PeterkaFileError
from peterka.identification import solve
from peterka.identification.contact_pulse import pulse
from peterka.identification.first_guess import Pulse, _refuse_clipped, _without_rings, look, noise_of
from peterka.identification.impact_table import fault_of, from_impact
from peterka.identification.numbers_found import DAMPING, STIFFNESS, Number
from peterka.identification.problem import Leg, Problem
from peterka.identification.recording import Recording
from peterka.identification.samples import Samples, thinned
from peterka.identification.starts import begin, from_swings, impact_legs, samples_of, window
from simulated_hammer import Hammer, noisy, simulate

RATE = 25600.0
HAMMER = Hammer(stiffness=4e6, damping=700.0)
STOP = pulse(HAMMER.mass, HAMMER.stiffness, HAMMER.damping)  # restitution, contact time [s]


@cache
def release():
    return simulate(HAMMER, 0.15, RATE)


def recorded(names, noise=0.001, signs=1):
    time, columns = release()
    return Recording(Path("simulated"), 0.0, time[1], {name: signs * values for name, values in noisy(columns, names, noise, 3).items()})


def touches():
    """(times [s], speeds [m/s]) of all impacts, from the displacement before them."""
    time, columns = release()
    first = np.flatnonzero((columns["force"][1:] > 0) & (columns["force"][:-1] == 0))
    speeds = (columns["displacement"][first] - columns["displacement"][first - 1]) * RATE
    return time[first] + (HAMMER.gap - columns["displacement"][first]) / speeds, speeds


@pytest.mark.parametrize("rise, flat, clipped", [((1, 3, 6, 8), 3, True), ((1, 3, 6, 8), 2, False), (np.arange(1, 9), 3, True),
                                                 (np.arange(1, 9.2, 0.6), 3, False), (np.arange(1, 9.2, 0.6), 6, True)])
def test_a_pulse_is_clipped_that_is_flat_for_three_samples_and_three_twentieths_of_it(rise, flat, clipped):
    values = np.array([0.0, *rise, *[9.1] * flat, *rise[::-1], 0.0])
    recording, one = Recording(Path("simulated"), 0.0, 1e-4, {"force": values}), Pulse(1, len(values) - 1, 1 + len(rise), 9.1)
    if clipped:
        with pytest.raises(PeterkaFileError, match=f"is clipped: its force stays at 9.1 for {flat} samples"):
            _refuse_clipped(recording, "force", values, one)
    else:
        assert _refuse_clipped(recording, "force", values, one) is None


def test_a_weak_pulse_beside_a_short_one_is_its_ring():
    before, one, after = Pulse(9, 11, 10, 0.15), Pulse(14, 17, 15, 1.0), Pulse(20, 21, 20, 0.1)
    weak, strong = Pulse(22, 23, 22, 0.1), Pulse(20, 21, 20, 0.3)
    assert _without_rings([before, one, after]) == [one] == _without_rings([one])
    assert _without_rings([one, weak]) == [one, weak] and _without_rings([one, strong]) == [one, strong]


@pytest.mark.parametrize("signs", [1, -1])
@pytest.mark.parametrize("names", [("force",), ("acceleration",), ("force", "acceleration", "displacement"), ("displacement",)])
def test_impacts_are_seen_with_their_signs(names, signs):
    guess, times = look(recorded(names, signs=signs)), touches()[0]
    assert guess.signs == {name: signs for name in names}
    assert guess.sharp == (None if names == ("displacement",) else names[0])
    tops = np.array([one.top for one in guess.pulses]) / RATE
    seen, late = (3, 0.001) if guess.sharp is None else (5, STOP[1])  # of a displacement alone the hardest
    assert len(tops) == seen and np.all(np.abs(tops - times[:seen]) < late), (tops, times)
    largest = {name: np.abs(release()[1][name]).max() for name in names}
    for name in names:
        assert guess.noise[name] == pytest.approx(0.001 * largest[name], rel=0.25 if name != "displacement" else 3)
        assert guess.ranges[name] == pytest.approx(np.ptp(release()[1][name]), rel=0.02)
    if guess.sharp:
        assert guess.hardest == 0 and 0.6 * STOP[1] * RATE <= guess.contact <= 1.1 * STOP[1] * RATE + 1
        assert guess.pulses[0].height == pytest.approx(largest[names[0]], rel=0.03)
        assert all(one.first <= one.top < one.last for one in guess.pulses)


def test_a_recording_of_noise_alone_shows_no_impact():
    noise = np.random.default_rng(1).standard_normal(4000)
    for name in ("force", "displacement"):
        with pytest.raises(PeterkaFileError, match="shows no impact"):
            look(Recording(Path("simulated"), 0.0, 1e-4, {name: noise}))


def test_noise_is_that_beside_swings_and_impacts():
    time = np.arange(20000) / RATE
    white = np.random.default_rng(2).standard_normal(len(time))
    values = 0.3 * white + 50 * np.sin(2 * np.pi * 5 * time)
    values[3000:3020] += 4000
    values[9000:9100] = np.nan
    assert noise_of(values) == pytest.approx(0.3, rel=0.05) and noise_of(values[:1]) == 0


def test_single_samples_stand_in_windows_and_means_between():
    values = np.arange(1000.0)**2
    values[[105, 700]] = np.nan
    one = Recording(Path("simulated"), 2.0, 0.01, {"force": values})
    found = thinned(one, [(600, 640), (100, 110), (-5, 3)], 4.0)
    assert list(found.time) == pytest.approx([0.01 * n for n in [*range(3), *range(100, 105), *range(106, 110), *range(600, 640)]])
    assert list(found.values["force"]) == [values[round(100 * time)] for time in found.time]
    assert found.counts.max() == 2
    firsts, lasts = np.rint(100 * found.begins + 0.5).astype(int), np.rint(100 * found.ends + 0.5).astype(int)
    assert list(lasts - firsts) == list(found.counts) and (firsts[0], lasts[-1]) == (3, 1000)
    assert list(found.means["force"]) == pytest.approx([values[first:last].mean() for first, last in zip(firsts, lasts)])
    covered = np.zeros(1000, int)
    for first, last in zip(firsts, lasts):
        covered[first:last] += 1
    missing = [n for n in [*range(3, 100), *range(110, 600), *range(640, 1000)] if covered[n] != 1]
    assert 700 in missing and len(missing) <= 2 and covered.sum() == 947 - len(missing)
    part = found.part(1.0, 6.0)
    assert (part.time.min(), part.time.max()) == (1.0, 6.0) and part.begins.min() >= 1.0 and part.ends.max() <= 6.0
    assert len(part.values["force"]) == len(part.time) and len(part.means["force"]) == len(part.begins) == len(part.counts)
    assert len(found.without_means().begins) == 0 and list(found.without_means().time) == list(found.time)


@pytest.mark.parametrize("flight, size", [(None, 3), (2.0, 2), (4.0, 3), (0.5, 1)])
def test_means_are_a_hundredth_of_the_shortest_flight_and_no_longer_than_600_ask_for(flight, size):
    found = thinned(Recording(Path("simulated"), 0.0, 0.01, {"force": np.zeros(1800)}), [], flight)
    assert found.counts[0] == size and len(found.time) == 0


def test_the_stop_and_all_impacts_begin_close_to_the_truth():
    one = recorded(("force",))
    begun, (times, speeds) = begin(one, look(one), HAMMER.mass), touches()
    assert begun.alone is not None and begun.stiffness == pytest.approx(HAMMER.stiffness, rel=0.03)
    assert (begun.restitution, begun.contact) == pytest.approx(STOP, rel=0.06)
    assert begun.stop_ratio == pytest.approx(HAMMER.damping / (2 * np.sqrt(HAMMER.stiffness * HAMMER.mass)), rel=0.1)
    for impact, time, speed in zip(begun.impacts, times, speeds, strict=True):
        assert abs(impact.touch - time) < 2e-5 and impact.speed == pytest.approx(speed, rel=0.05)
        assert 0 < impact.touch_error < 2e-5 and 0 < impact.speed_error < 0.05


def test_before_the_fit_of_single_impacts_a_scan_is_close(monkeypatch):
    monkeypatch.setattr("peterka.identification.starts._alone", lambda *_: None)
    one = recorded(("force",))
    begun = begin(one, look(one), HAMMER.mass)
    assert begun.alone is None and begun.stiffness == pytest.approx(HAMMER.stiffness, rel=0.3)
    assert begun.restitution == pytest.approx(STOP[0], abs=0.15)
    assert begun.impacts[0].speed == pytest.approx(touches()[1][0], rel=0.15) and abs(begun.impacts[0].touch - touches()[0][0]) < 5e-5
    assert begun.impacts[0].touch_error == pytest.approx(0.3 * begun.contact) and begun.impacts[0].speed_error == 0.3


@pytest.mark.parametrize("names", [("force",), ("acceleration",), ("displacement",)])
def test_contacts_of_few_samples_begin_as_those_of_half_the_speed(names):
    one = recorded(names)
    few = Recording(one.path, 0.0, 40 * one.step, {name: values[5::40] for name, values in one.signals.items()})
    guess = replace(look(one), pulses=look(few).pulses if names != ("displacement",) else look(one).pulses[:1])
    few = few if guess.sharp else one
    hardest, begun = guess.pulses[guess.hardest], begin(few, guess, HAMMER.mass)
    assert begun.alone is None and begun.restitution == pytest.approx(0.5)
    assert begun.contact == pytest.approx(max(guess.contact, 1.5) * few.step)
    omega = np.sqrt(begun.stiffness / HAMMER.mass)
    speed = 1.3 * hardest.height / omega / (HAMMER.mass if names == ("force",) else 1) if guess.sharp else touches()[1][0]
    assert begun.impacts[guess.hardest].speed == pytest.approx(speed, rel=1e-6 if guess.sharp else 0.3)
    assert begun.impacts[guess.hardest].touch == pytest.approx(few.step * (hardest.first - 0.5))
    ratio = 2 * begun.stop_ratio * np.sqrt(begun.stiffness * HAMMER.mass)
    assert pulse(HAMMER.mass, begun.stiffness, ratio) == pytest.approx((0.5, begun.contact), rel=1e-6)


@pytest.mark.parametrize("seen, factor", [("displacement", 1), ("acceleration", -(2 * np.pi * 22.0)**2)])
def test_springs_and_gap_come_from_swings(seen, factor):
    """Of another amplitude in each stretch between impacts, about an offset."""
    one = recorded(("force",))
    begun = begin(one, look(one), HAMMER.mass)
    omega, gap = 2 * np.pi * 22.0, 0.7e-3
    ends = np.linspace(0, 0.15, 601)
    middles = 0.5 * (ends[1:] + ends[:-1])
    times = np.array([impact.touch for impact in begun.impacts])
    piece = np.searchsorted(times, middles)
    values = np.zeros(len(middles))
    for number in range(len(times) + 1):
        at = times[min(number, len(times) - 1)]  # where this piece is at the gap
        other = times[max(number - 1, 0)]
        shape = np.array([[np.cos(omega * (at - at)), np.sin(0.0)], [np.cos(omega * (other - at)), np.sin(omega * (other - at))]])
        swing = np.linalg.lstsq(shape, [gap, gap], rcond=None)[0] + (np.array([0, 2e-3]) if at == other else 0)
        values = np.where(piece == number, factor * (swing[0] * np.cos(omega * (middles - at)) + swing[1] * np.sin(omega * (middles - at))), values)
    samples = Samples(np.zeros(0), {}, ends[:-1], ends[1:], np.ones(600), {seen: -values + 0.01 * abs(factor)})
    guess = replace(look(one), signs={seen: -1})
    (omega_found, gap_found), = from_swings(samples, guess, begun, None, None)
    assert omega_found == pytest.approx(omega, rel=0.01) and gap_found == pytest.approx(gap, rel=0.05)
    (omega_found, gap_found), = from_swings(samples, guess, begun, omega, None)
    assert omega_found == omega and gap_found == pytest.approx(gap, rel=1e-6)
    assert from_swings(samples, guess, begun, omega, 0.1) == [(omega, 0.1)]
    assert from_swings(samples, replace(guess, signs={"force": 1}), begun, None, None) == []
    few = replace(samples, begins=ends[:8], ends=ends[1:9], counts=np.ones(8), means={seen: values[:8]})
    assert from_swings(few, guess, begun, None, None) == []


def test_samples_around_impacts_are_kept_each():
    one = recorded(("force",))
    guess = look(one)
    first, last = window(guess, 0)
    around = max(3 * guess.contact, 15)
    assert (first, last) == (guess.pulses[0].first - around, guess.pulses[0].last + around)
    samples = samples_of(one, guess)
    times = touches()[0]
    assert all(np.sum((samples.time > time) & (samples.time < time + STOP[1])) >= STOP[1] * RATE - 1 for time in times)
    assert samples.counts.max() == min(-(-(one.count - len(samples.time)) // 600), int(np.diff(times).min() * RATE) // 100)
    begun = begin(one, guess, HAMMER.mass)
    legs = impact_legs(one, guess, begun.impacts)
    assert [(leg.touch, leg.speed, leg.impacts) for leg in legs] == [(impact.touch, impact.speed, 1) for impact in begun.impacts]
    for leg, pulse_seen in zip(legs, guess.pulses):
        around = int(1.5 * max(pulse_seen.last - pulse_seen.first, 4))
        assert len(leg.samples.begins) == 0 and leg.samples.time[0] == pytest.approx((pulse_seen.first - around) / RATE)
        assert leg.samples.time[-1] == pytest.approx((pulse_seen.last + around - 1) / RATE)


def problem(noise=0.0, seed=0):
    """(a Problem of the release's force and displacement, true values); its first guesses are 2 % off."""
    time, columns = release()
    names = ("force", "displacement")
    ranges = {name: float(np.ptp(columns[name])) for name in names}
    chance = np.random.default_rng(seed)
    values = {name: columns[name] + ranges[name] * (0.03 + noise * chance.standard_normal(len(time))) for name in names}
    none = np.zeros(0)
    samples = Samples(time, values, none, none, none, {name: none for name in names})
    (touch, *_), (speed, *_) = touches()
    omega, swing = 2 * np.pi * HAMMER.hertz, speed / (2 * np.pi * HAMMER.hertz)
    one = Problem(HAMMER.mass, [Leg(samples, touch, speed)], {"stiffness": 1.02 * HAMMER.stiffness, "omega": 0.98 * omega, "gap": swing, "contact": STOP[1]},
                  ["stiffness", "stop_ratio", "omega", "damping_ratio", "gap"], {}, {"force": 1, "displacement": 1}, dict.fromkeys(names, 0.0), ranges,
                  {name: max(noise, 1e-5) * ranges[name] for name in names}, 1 / RATE)
    ratio = HAMMER.damping / (2 * np.sqrt(HAMMER.stiffness * HAMMER.mass))
    return one, {"stiffness": -np.log(1.02), "stop_ratio": ratio, "omega": -np.log(0.98), "damping_ratio": HAMMER.ratio, "gap": HAMMER.gap / swing,
                 "offset_force": 0.03, "offset_displacement": 0.03}


@pytest.mark.parametrize("impacts", [1, 3, 9])
def test_a_motion_with_fewer_impacts_is_known_until_the_next_one(impacts):
    one, true = problem()
    one.legs = [replace(one.legs[0], impacts=impacts)]
    value, times = true | {"touch 0": 0.0, "speed 0": 0.0}, touches()[0]
    moved = one.motion(value, 0)
    assert moved.touches == pytest.approx(times[:impacts], abs=1 / RATE)
    assert one.known_until(moved, 0) == pytest.approx([*times, *[np.inf] * 9][impacts], abs=1 / RATE)


def test_solving_finds_the_truth_and_its_errors():
    one, true = problem(noise=0.003, seed=5)
    found = solve.solved(one, solve.start(one, stop_ratio=true["stop_ratio"] * 1.05, damping_ratio=0.02, gap=true["gap"], offset_displacement=0.03))
    for name, value in true.items():
        assert abs(found.value[name] - value) < 4 * found.error(name) < (0.05 if "offset" not in name else 0.001), name
    assert found.cost == pytest.approx(found.rows, rel=0.1) and found.rows == pytest.approx(2 * len(release()[0]), rel=0.02)
    noise, more = solve.levels(found)
    for name in ("force", "displacement"):
        assert noise[name] == pytest.approx(0.003 * one.ranges[name], rel=0.05) and 1 <= more[name] < 1.5
    assert found.error("unknown") == 0
    halved = solve.solved(replace(one, noise={name: 2 * level for name, level in one.noise.items()}), found.value)
    assert halved.error("stiffness") == pytest.approx(2 * found.error("stiffness"), rel=0.1)
    assert halved.cost == pytest.approx(found.cost / 4, rel=0.05)


def test_parameters_and_their_bounds():
    one, _ = problem()
    assert one.parameters == [*one.free, "offset_force", "offset_displacement", "touch 0", "speed 0"]
    lowest, highest = (dict(zip(one.parameters, ends)) for ends in one.bounds())
    assert (lowest["stop_ratio"], highest["stop_ratio"], lowest["gap"], highest["gap"]) == (0.0, 50.0, -3.0, 30.0)
    assert (lowest["touch 0"], highest["touch 0"], lowest["speed 0"], highest["speed 0"]) == (-6.0, 6.0, -3.0, 3.0)
    assert (lowest["offset_force"], highest["offset_force"]) == (-np.inf, np.inf)
    pushed = replace(one, pushed=True)
    assert pushed.parameters == [*one.free, "touch 0", "speed 0", "push_cos 0", "push_sin 0", "offset_force 0", "offset_displacement 0"]


def test_a_stop_from_a_restitution_and_a_contact_time_with_errors_of_both():
    def stop(restitution, contact_s, errors=(None, None)):
        return from_impact(0.3, Number(restitution, errors[0]), Number(contact_s, errors[1]))

    for key in (STIFFNESS, DAMPING):
        for errors, ends in (((1e-4, None), (stop(0.6001, 1e-3), stop(0.5999, 1e-3))), ((None, 1e-8), (stop(0.6, 1.00001e-3), stop(0.6, 0.99999e-3)))):
            slope = abs(ends[0].number(key).value - ends[1].number(key).value) / 2
            assert stop(0.6, 1e-3, errors).number(key).error == pytest.approx(slope, rel=1e-3)
    assert stop(1.0, 1e-3, (1e-4, None)).number(DAMPING).error > 0


@pytest.mark.parametrize("restitution, contact_s, words", [
    (0.5, 1e-3, ""), (1.0, 1e-3, ""), (1.0001, 1e-3, "a restitution of 1"), (0.0, 1e-3, "a restitution of 0"), (1e-9, 1e-3, "a restitution of 1e-09"),
    (0.5, 0.0, "a contact time of 0 s; it must be above 0"), (0.5, -1.0, "a contact time of -1 s"), (0.5, np.inf, "a contact time of inf s")])
def test_impacts_that_cannot_be(restitution, contact_s, words):
    found = fault_of(restitution, contact_s)
    assert words in found and bool(found) == bool(words)
