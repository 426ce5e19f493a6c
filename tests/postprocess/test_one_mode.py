"""Whether a hammer is one mass: shares of mobility of releases of several modes, computed by scipy's DOP853, with noise."""

from pathlib import Path

import numpy as np
import pytest
from peterka.errors import PeterkaFileError
from peterka.identification.first_guess import look
from peterka.identification.fit import fit
from peterka.identification.one_mode import share_of_modes, share_words
from peterka.identification.numbers_found import Number
from peterka.identification.recording import Recording
from peterka.identification.starts import begin
from simulated_hammer import Hammer, noisy, simulate

pytestmark = pytest.mark.thorough

RATE = 51200.0


def recorded(shares, hertz, names=("force", "displacement"), noise=(0.003, 0.002), rate=RATE, **rig):
    """A release of a hammer whose further modes have these shares of its mobility and frequencies [Hz]."""
    mass = Hammer.mass * (1 - sum(shares))  # at the stop
    hammer = Hammer(modes=tuple((mass / share, one, 0.01) for share, one in zip(shares, hertz)), **rig)
    time, columns = simulate(hammer, 0.15, rate)
    signals = {name: noisy(columns, [name], noise[name == "displacement"], seed)[name] for seed, name in enumerate(names)}
    return Recording(Path("simulated"), 0.0, time[1], signals)


@pytest.mark.parametrize("shares, hertz, rig", [
    ((), (), {}),
    ((0.03,), (140.0,), {}),
    ((0.1,), (140.0,), {}),
    ((0.06, 0.03), (140.0, 390.0), {"stiffness": 1e8, "damping": 5800.0}),
    ((0.05, 0.03, 0.02), (140.0, 390.0, 760.0), {"stiffness": 1e8, "damping": 5800.0}),
], ids=["1", "2, small", "2", "3", "4"])
def test_the_share_of_other_modes_comes_back(shares, hertz, rig):
    recording = recorded(shares, hertz, **rig)
    guess = look(recording)
    found = share_of_modes(recording, guess, begin(recording, guess, Hammer.mass))
    assert found is not None and abs(found.value - sum(shares)) < 0.01, found
    assert 0 < found.error < 0.02 and abs(found.value - sum(shares)) < 3 * found.error, found


def test_what_a_share_means_in_words():
    assert share_words(Number(0.049, 0.01)) == "other modes have 0.049 ± 0.010 of the hammer's mobility at the stop"
    assert "so that it isn't one mass" in share_words(Number(0.051, 0.01))


def test_a_share_may_be_why_a_recording_is_refused(monkeypatch):
    monkeypatch.setattr("peterka.identification.fit.share_of_modes", lambda *_: Number(0.1, 0.01))
    with pytest.raises(PeterkaFileError, match=r"the motion of .*; other modes have 0\.100 ± 0\.010 of .* so that it isn't one mass"):
        fit(recorded((), (), ("displacement",), rate=RATE / 2), Hammer.mass, {"gap": 0.7e-3})


@pytest.mark.parametrize("names", [("force",), ("displacement",), ("acceleration", "displacement")])
def test_without_force_and_displacement_it_is_not_told(names):
    recording = recorded((), (), names)
    guess = look(recording)
    assert share_of_modes(recording, guess, begin(recording, guess, Hammer.mass)) is None


def test_a_release_that_is_cut_is_not_told():
    recording = recorded((), ())
    first = int(np.argmax(recording.signals["force"] > 500))
    cut = Recording(recording.path, 0.0, recording.step, {name: signal[first - 30:first + 300] for name, signal in recording.signals.items()})
    guess = look(cut)
    assert share_of_modes(cut, guess, begin(cut, guess, Hammer.mass)) is None
