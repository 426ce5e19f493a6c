"""Errors of a recording's channels: releases computed by scipy's DOP853, one channel of which comes late, drifts, or hums with the mains."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from identification_coverage import pulls_of
from peterka.errors import PeterkaFileError
from peterka.identification import channels, numbers_found
from peterka.identification.adequacy import refuse_contradicting
from peterka.identification.first_guess import look
from peterka.identification.fit import fit
from peterka.identification.recording import Recording
from peterka.identification.solve import solved
from peterka.identification.words import UNITS, channel_lines
from simulated_hammer import Hammer, noisy, simulate, write

pytestmark = pytest.mark.thorough

RATE, FINE, NOISE = 51200.0, 10, 0.003
HAMMER = Hammer()
TRUE = {numbers_found.STIFFNESS: HAMMER.stiffness, numbers_found.DAMPING: HAMMER.damping, numbers_found.FREQUENCY: HAMMER.hertz,
        numbers_found.DAMPING_RATIO: HAMMER.ratio, numbers_found.GAP: HAMMER.gap}


@cache
def fine():
    return simulate(HAMMER, 0.15, FINE * RATE)


def release(names, late=0.0):
    """(times, {signal: values}), the last of these signals so many samples late."""
    time, columns = fine()
    at = np.arange(0, len(time), FINE)
    return time[at], {name: columns[name][np.clip(at - round(FINE * late) * (name == names[-1]), 0, None)] for name in names}


def fitted(time, columns):
    return fit(Recording(Path("simulated"), 0.0, time[1], noisy(columns, columns, NOISE, 1)), HAMMER.mass)


def is_right(found):
    numbers = {key: found.number(key) for key in found.values}
    assert len(numbers) >= 4
    for key, number in numbers.items():
        assert abs(number.value - TRUE[key]) < 4 * number.error < 0.2 * TRUE[key], (key, number)


@pytest.mark.parametrize("names, late", [(("force", "displacement"), 3.0), (("acceleration", "displacement"), -0.7), (("force", "acceleration"), 0.3)])
def test_a_channel_that_comes_late_is_told_and_moves_no_number(names, late):
    """By 0.3 of a sample forces and accelerations differ by more than noise; by one, a displacement moved the numbers by 17 of their errors."""
    one = fitted(*release(names, late))
    is_right(one.found)
    delay, error = one.solved.problem.delay(one.solved.value, names[-1]), one.solved.problem.step * one.error(f"delay_{names[-1]}")
    assert abs(delay - late / RATE) < 4 * error < 0.5 / RATE
    word = "later" if late > 0 else "earlier"
    assert [line for line in channel_lines(one) if f"ms {word} than {names[0]}" in line]


@pytest.mark.parametrize("names", [("force",), ("force", "displacement")])
def test_an_offset_that_drifts_is_told_and_moves_no_number(names):
    time, columns = release(names)
    size = np.abs(columns[names[-1]]).max()
    columns[names[-1]] = columns[names[-1]] + 0.05 * size * time / time[-1]
    one = fitted(time, columns)
    is_right(one.found)
    (line,) = (line for line in channel_lines(one) if "drifts" in line)
    assert line.startswith(f"{names[-1]} drifts by ") and float(line.split()[3]) == pytest.approx(0.05 * size * UNITS[names[-1]][0], rel=0.05)


@pytest.mark.parametrize("names, hertz, share", [(("force",), 60.02, 0.02), (("acceleration", "displacement"), 49.95, 0.01)])
def test_hum_of_the_mains_is_told_and_moves_no_number(names, hertz, share):
    """Also the picture's line hums: what it leaves is noise."""
    time, columns = release(names)
    size = np.abs(columns[names[-1]]).max()
    columns[names[-1]] = columns[names[-1]] + share * size * np.sin(2 * np.pi * hertz * time + 0.4)
    one = fitted(time, columns)
    is_right(one.found)
    (line,) = (line for line in channel_lines(one) if "hums" in line)
    assert f"{names[-1]} hums with the mains, {round(hertz)} Hz, with an amplitude of" in line
    assert float(line.split()[-4]) == pytest.approx(share * size * UNITS[names[-1]][0], rel=0.05)
    left = one.recording.signals[names[-1]] - one.model(time)[names[-1]]
    assert np.median(np.abs(left)) < 0.8 * NOISE * size


def test_a_sound_recording_has_no_errors_of_channels(tmp_path, run_program):
    time, columns = release(("force", "displacement"))
    path = write(tmp_path / "a.csv", time, noisy(columns, columns, NOISE, 2))
    code, out, err = run_program("identify", path, "--mass-kg", HAMMER.mass, "--formats", "png")
    assert (code, err) == (0, "") and ": fitted, too" not in out


def test_drift_of_a_displacement_is_no_other_mode(tmp_path, run_program):
    """The share of other modes is told from the swings before and after impacts, from which a drift is taken away."""
    time, columns = release(("force", "displacement"))
    columns["displacement"] = columns["displacement"] + 5e-4 * time / time[-1]
    path = write(tmp_path / "a.csv", time, noisy(columns, columns, 0.001, 2))
    code, out, err = run_program("identify", path, "--mass-kg", HAMMER.mass, "--formats", "png")
    assert (code, err) == (0, "") and "displacement drifts by 0.5 mm over the recording: fitted, too" in out
    (line,) = (line for line in out.splitlines() if "other modes have" in line)
    share, error = float(line.split()[3]), float(line.split()[5])
    assert abs(share) < max(3 * error, 0.01)


def test_what_a_sound_recording_does_not_show_is_not_kept():
    """Also where a fit has been begun with all of it, and no delay is there to be fitted."""
    time, columns = release(("force",))
    sound = fitted(time, columns).solved
    whole = solved(channels.with_all_channels(sound.problem, 50.0), sound.value)
    assert len(whole.problem.channels) == 4
    (best, *others) = channels.with_channels([whole])
    assert [one.problem.channels for one in (best, *others)] == [[]] * (1 + len(others))
    assert best.cost == pytest.approx(sound.cost, rel=1e-4)


@pytest.mark.parametrize("names, kept", [(("force", "displacement"), []), (("acceleration", "displacement"), ["delay_displacement"]),
                                         (("force", "acceleration", "displacement"), ["delay_displacement"]), (("force",), [])])
def test_flights_tell_no_delay_against_a_force(names, kept):
    """It is 0 there: such a delay and all touches would move together."""
    problem = fitted(*release(names)).solved.problem
    whole = channels.with_all_channels(problem, 50.0)
    assert [name for name in channels.told_by_flights(whole) if name.startswith("delay_")] == kept
    assert f"drift_{names[-1]}" in channels.told_by_flights(whole)


@pytest.mark.parametrize("late", [-4, 4])
def test_a_late_acceleration_contradicts_no_force(late):
    """In contacts of 7 samples, products of samples taken together would be off by 30 to 50 %."""
    time, columns = fine()
    at = np.arange(400, len(time) - 400, 50)
    recording = Recording(Path("simulated"), 0.0, 50 * time[1], noisy(
        {"force": columns["force"][at], "acceleration": columns["acceleration"][at - 50 * late]}, ("force", "acceleration"), NOISE, 1))
    guess = look(recording)
    assert 5 <= guess.contact <= 9
    refuse_contradicting(recording, guess, HAMMER.mass)
    with pytest.raises(PeterkaFileError, match="times the mass"):
        refuse_contradicting(recording, guess, 1.5 * HAMMER.mass)


def test_means_of_drift_and_hum_are_those_of_their_values():
    """In closed form; over a period and a half of the mains, here."""
    time, columns = release(("force", "displacement"))
    problem = channels.with_all_channels(fitted(time, columns).solved.problem, 60.0)
    value = {name: 0.1 * at for at, name in enumerate([*problem.parameters, *problem.fixed])}
    begins = np.array([0.01, 0.03])
    ends = begins + 0.025
    inside = begins[:, None] + 0.025 * (np.arange(4000) + 0.5) / 4000
    for name in problem.names:
        values = problem.base(value, 0, name, inside.ravel()).reshape(inside.shape)
        assert problem.base(value, 0, name, begins, ends) == pytest.approx(values.mean(axis=1), rel=1e-6)


def test_errors_cover_delays():
    """Three repetitions with other noise: a delay that is always fitted leaves the numbers' errors true."""
    time, columns = release(("force", "displacement"), 0.4)
    for seed in (3, 4, 5):
        pulls = pulls_of(HAMMER, (time, columns), ("force", "displacement"), NOISE, seed)
        assert max(abs(pull) for pull in pulls.values()) < 4
