"""identify.py on releases with few samples in a contact, computed by scipy's DOP853: numbers from three samples on, below that from the
flights or as a bound, and none from what a logger's filter made of contacts."""

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from identification_coverage import pulls_of
from peterka.errors import PeterkaFileError
from peterka.identification import twins
from peterka.identification.contact_pulse import pulse
from peterka.identification.adequacy import refuse_contradicting
from peterka.identification.first_guess import look
from peterka.identification.fit import fit, release_problem
from peterka.identification.flights import Start
from peterka.identification.flights_alone import RINGS, least_stiffness, ringing, trusted
from peterka.identification.recording import Recording
from peterka.identification.solve import solved, start
from peterka.identification.starts import begin, samples_of
from scipy.signal import fftconvolve, firwin
from simulated_hammer import Hammer, noisy, simulate

pytestmark = pytest.mark.thorough

HAMMER = Hammer()
RATIO = HAMMER.damping / (2 * np.sqrt(HAMMER.stiffness * HAMMER.mass))
CONTACT = pulse(HAMMER.mass, HAMMER.stiffness, HAMMER.damping)[1]  # s
FINE, TAPS = 16, 16  # steps of a logger's filter in one of its samples; its samples on each side


@cache
def release(per_contact, filtered=False):
    """(times, signals) with this many samples in a contact; `filtered` by a linear phase up to 0.45 of the rate, as in loggers."""
    time, columns = simulate(HAMMER, 0.15, per_contact * (FINE if filtered else 1) / CONTACT)
    if not filtered:
        return time, columns
    taps = firwin(2 * TAPS * FINE + 1, 0.9 / FINE, window=("kaiser", 8.0))
    return time[::FINE], {name: fftconvolve(np.pad(values, TAPS * FINE, mode="edge"), taps, mode="valid")[::FINE]
                          for name, values in columns.items()}


def recorded(names, noise, release_of, seed=1):
    time, columns = release_of
    return Recording(Path("simulated"), 0.0, time[1], noisy(columns, names, noise, seed))


def test_three_samples_of_a_contact_tell_the_stop():
    pulls = pulls_of(HAMMER, release(3.0), ("force",), 0.002, 1)
    assert not isinstance(pulls, str) and max(map(abs, pulls.values())) < 4, pulls


def test_two_rigs_that_few_samples_dont_tell_apart_are_named():
    """The fit of the true one doesn't go on through the impacts that weren't detected, which once ruled it out, and not the other one."""
    with pytest.raises(PeterkaFileError, match="doesn't tell two rigs apart: springs of 21.9. Hz .*, and springs of 30.* Hz"):
        fit(recorded(("force",), 0.01, release(3.0)), HAMMER.mass)


@pytest.mark.parametrize("stiffness", [2e5, 3e5, 5e5, 1.7e7])
def test_springs_that_push_back_beside_a_soft_stop_are_no_wrong_mass(stiffness):
    time, columns = simulate(Hammer(stiffness=stiffness, damping=20.0, gap=3e-3), 0.3, 2e4)
    recording = Recording(Path("simulated"), 0.0, time[1], noisy(columns, ("force", "acceleration"), 0.002, 1))
    refuse_contradicting(recording, look(recording), Hammer().mass)


def test_a_force_has_no_flights():
    with pytest.raises(PeterkaFileError, match="too coarse to see the contact"):
        fit(recorded(("force",), 0.01, release(2.0)), HAMMER.mass)


def test_one_glimpsed_impact_is_too_coarse():
    time, columns = release(3.0)
    until = int(0.025 / time[1])
    one = {name: values[:until] for name, values in columns.items()}
    assert begin(recording := recorded(("force",), 0.01, (time, one)), look(recording), HAMMER.mass).alone is not None
    with pytest.raises(PeterkaFileError, match="too coarse to see the contact"):
        fit(recording, HAMMER.mass)


@pytest.mark.parametrize("names", [("force", "displacement"), ("acceleration",)])
def test_two_impacts_of_few_samples_are_not_enough(names):
    time, columns = release(3.0)
    until = 0.5 * sum(one.first for one in look(recorded(("force",), 1e-4, release(3.0))).pulses[1:3])
    two = {each: values[:int(until)] for each, values in columns.items()}
    recording = recorded(names, 0.002, (time, two))
    assert len(look(recording).pulses) == 2
    with pytest.raises(PeterkaFileError, match=r"simulated shows 2 impacts of about 3\.?\d* samples; of so few samples 3 impacts are needed"):
        fit(recording, HAMMER.mass)


def nearest(recording):
    """The Solved of a recording, from the truth."""
    guess = look(recording)
    begun, omega = begin(recording, guess, HAMMER.mass), 2 * np.pi * HAMMER.hertz
    swing = begun.impacts[0].speed / omega
    one = Start(omega, swing, {"damping_ratio": HAMMER.ratio, "gap": HAMMER.gap / swing, "stop_ratio": RATIO}, 0.0)
    begun = replace(begun, stiffness=HAMMER.stiffness)
    problem = release_problem(recording, guess, begun, samples_of(recording, guess), HAMMER.mass, {}, one)
    return solved(problem, start(problem, **one.value))


def test_a_fit_that_goes_on_as_another_rig_is_no_twin_of_it(monkeypatch):
    found = nearest(recorded(("force", "displacement"), 0.01, release(3.0)))
    far = replace(found, value={**found.value, "omega": found.value["omega"] + 0.1}, cost=2.5 * found.cost)
    monkeypatch.setattr(twins, "_continued", lambda _: found)
    best, other = twins.likeliest([found, far])
    assert best is found and other is None


def test_a_filter_that_rings_is_seen_and_the_flights_tell_the_stop():
    sharp, rings = (nearest(recorded(("force", "displacement"), 0.002, release(3.0, filtered))) for filtered in (False, True))
    assert ringing(sharp) > RINGS > ringing(rings)
    assert trusted(Path("a.csv"), [sharp]) == [sharp]
    by_flights, = trusted(Path("a.csv"), [rings])
    assert by_flights.problem.unseen and abs(np.log(by_flights.problem.rig(by_flights.value).stiffness / HAMMER.stiffness)) < 0.2
    with pytest.raises(PeterkaFileError, match="a.csv .* neither displacement nor acceleration, whose flights"):
        trusted(Path("a.csv"), [nearest(recorded(("force",), 0.002, release(3.0, filtered=True)))])


def test_below_that_samples_in_contact_and_beside_it_have_no_weight():
    recording = recorded(("force", "displacement"), 0.001, release(2.0))
    found = nearest(recording)
    by_flights, = trusted(Path("a.csv"), [found])
    touches = found.problem.motion(found.value, 0).touches
    time = found.problem.legs[0].samples.time / recording.step
    for touch in touches / recording.step:
        beside = (time > touch - 3.9) & (time < touch + 6.3)
        assert beside.sum() >= 10 and not by_flights.settled[0].of("force")[beside].any() and not by_flights.settled[0].of("displacement")[beside].any()
    with pytest.raises(PeterkaFileError, match="a.csv is too coarse to see the contact, which lasts for about .* neither displacement"):
        trusted(Path("a.csv"), [nearest(recorded(("force",), 0.002, release(2.0)))])


def test_a_stop_that_flights_hardly_tell_gets_a_bound():
    with pytest.raises(PeterkaFileError, match="doesn't tell the stop") as refusal:
        fit(recorded(("displacement",), 0.007, release(2.0)), HAMMER.mass)
    least = float(re.search(r"ki is above ([-+.\de]+) N/m \(95 %\)", str(refusal.value))[1])
    ratio, error = map(float, re.search(r"restitution tells ci/sqrt\(m ki\) = ([-+.\de]+) ± ([-+.\de]+) alone", str(refusal.value)).groups())
    assert 0.005 * HAMMER.stiffness < least < HAMMER.stiffness, str(refusal.value)
    assert abs(ratio - HAMMER.damping / np.sqrt(HAMMER.stiffness * HAMMER.mass)) < 3.3 * error


def test_a_bound_is_where_one_of_twenty_recordings_lies():
    """Of a stiffness that is well told, 1.645 standard errors below it."""
    told = fit(recorded(("displacement",), 0.002, release(2.0)), HAMMER.mass)
    below = (told.solved.value["stiffness"] - np.log(least_stiffness(told.solved) / told.solved.problem.scale["stiffness"]))
    assert below / told.solved.error("stiffness") == pytest.approx(1.645, abs=0.35), told.solved.error("stiffness")
