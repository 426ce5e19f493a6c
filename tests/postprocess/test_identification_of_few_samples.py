"""identify.py on releases with few samples in a contact, computed by scipy's DOP853: numbers from three samples on, below that from the
flights or as a bound, and none from what a logger's filter made of contacts."""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from identification_coverage import pulls_of
from peterka.errors import PeterkaFileError
from peterka.identification.contact_pulse import pulse
from peterka.identification.first_guess import look
from peterka.identification.fit import fit
from peterka.identification.flights_alone import RINGS, contact_samples, least_stiffness, ringing
from peterka.identification.numbers_found import STIFFNESS
from peterka.identification.recording import Recording
from peterka.identification.starts import begin
from peterka.identification.words import recording_lines
from scipy.signal import fftconvolve, firwin
from simulated_hammer import Hammer, noisy, simulate

HAMMER = Hammer()
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


def is_true(found, less_than=0.25):
    number = found.number(STIFFNESS)
    return abs(number.value - HAMMER.stiffness) < 4 * number.error < 4 * less_than * HAMMER.stiffness


@pytest.mark.parametrize("names", [("force",), ("force", "displacement"), ("acceleration", "displacement")])
def test_three_samples_of_a_contact_tell_the_stop(names):
    pulls = pulls_of(HAMMER, release(3.0), names, 0.01, 1)
    assert not isinstance(pulls, str) and max(map(abs, pulls.values())) < 4, pulls


def test_below_that_flights_tell_it_whatever_was_recorded_in_contact():
    time, columns = release(2.0)
    near = np.convolve(columns["force"] > 0, np.ones(5), mode="same") > 0
    spoilt = {name: np.where(near, 0.6 * values, values) for name, values in columns.items()}
    spoilt["displacement"] = np.where(near, columns["displacement"] + 1e-4, columns["displacement"])
    told = fit(recorded(("force", "displacement"), 0.001, (time, spoilt)), HAMMER.mass)
    assert is_true(told.found), told.found
    assert "  contacts last for about 2 samples" in recording_lines(told)[1]
    assert contact_samples(told.solved) == pytest.approx(2, rel=0.1)


def test_a_force_has_no_flights():
    with pytest.raises(PeterkaFileError, match="too coarse to see the contact, which lasts for about 2 samples, and it has neither displacement"):
        fit(recorded(("force",), 0.01, release(2.0)), HAMMER.mass)


def test_one_glimpsed_impact_is_too_coarse():
    time, columns = release(3.0)
    until = int(0.025 / time[1])
    one = {name: values[:until] for name, values in columns.items()}
    assert begin(recording := recorded(("force",), 0.01, (time, one)), look(recording), HAMMER.mass).alone is not None
    with pytest.raises(PeterkaFileError, match="too coarse to see the contact"):
        fit(recording, HAMMER.mass)


def test_a_filter_that_rings_is_seen_and_the_flights_tell_the_stop():
    told = fit(recorded(("force", "displacement"), 0.002, release(3.0, filtered=True)), HAMMER.mass)
    assert is_true(told.found) and told.solved.problem.unseen, told.found
    sharp = fit(recorded(("force", "displacement"), 0.002, release(3.0)), HAMMER.mass)
    assert ringing(sharp.solved) > RINGS and not sharp.solved.problem.unseen and is_true(sharp.found)
    with pytest.raises(PeterkaFileError, match="rings beside its contacts, .* neither displacement nor acceleration"):
        fit(recorded(("force",), 0.002, release(3.0, filtered=True)), HAMMER.mass)


def test_a_stop_that_flights_hardly_tell_gets_a_bound():
    with pytest.raises(PeterkaFileError, match="doesn't tell the stop") as refusal:
        fit(recorded(("displacement",), 0.005, release(2.0)), HAMMER.mass)
    least = float(re.search(r"ki is above ([-+.\de]+) N/m \(95 %\)", str(refusal.value))[1])
    ratio, error = map(float, re.search(r"restitution tells ci/sqrt\(m ki\) = ([-+.\de]+) ± ([-+.\de]+) alone", str(refusal.value)).groups())
    assert 0.02 * HAMMER.stiffness < least < HAMMER.stiffness, str(refusal.value)
    assert abs(ratio - HAMMER.damping / np.sqrt(HAMMER.stiffness * HAMMER.mass)) < 3.3 * error


def test_a_bound_is_where_one_of_twenty_recordings_lies():
    """Of a stiffness that is well told, 1.645 standard errors below it."""
    told = fit(recorded(("displacement",), 0.002, release(2.0)), HAMMER.mass)
    below = (told.solved.value["stiffness"] - np.log(least_stiffness(told.solved) / told.solved.problem.scale["stiffness"]))
    assert below / told.solved.error("stiffness") == pytest.approx(1.645, abs=0.35), told.solved.error("stiffness")
