"""In which step between samples a touch lies, of releases computed by scipy's DOP853, whose touches are known."""

from pathlib import Path

import numpy as np
import pytest
from identification_coverage import pulls_of
from peterka.identification import solve, touch_steps
from peterka.identification.contact_pulse import pulse
from peterka.identification.first_guess import look
from peterka.identification.fit import release_problem
from peterka.identification.flights import Start
from peterka.identification.recording import Recording
from peterka.identification.starts import begin, samples_of
from simulated_hammer import Hammer, noisy, simulate

pytestmark = pytest.mark.thorough

FINE = 32  # steps of what tells the true touches, in one sample


def release(ratio, per_contact, shift):
    """(Hammer, (times, signals), true touches [s]) of a stop of this damping ratio, sampled `shift` of FINE steps later."""
    hammer = Hammer(hertz=8.0, stiffness=5e6, damping=2 * ratio * np.sqrt(5e6 * 1.2))
    time, columns = simulate(hammer, 0.4, FINE * per_contact / pulse(hammer.mass, hammer.stiffness, hammer.damping)[1])
    touches = time[1:][np.diff((columns["force"] > 0).astype(int)) == 1] - 0.5 * time[1]
    return hammer, (time[:len(time) - shift:FINE], {name: values[shift::FINE] for name, values in columns.items()}), touches - time[shift]


def told(hammer, recorded, names, noise, seed):
    """({index of a contact: middle [s] of the step that is told}, step [s]) at the true motion."""
    time, columns = recorded
    recording = Recording(Path("simulated"), 0.0, time[1], noisy(columns, names, noise, seed))
    guess = look(recording)
    begun, omega = begin(recording, guess, hammer.mass), 2 * np.pi * hammer.hertz
    swing = begun.impacts[0].speed / omega
    one = Start(omega, swing, {}, 0.0)
    problem = release_problem(recording, guess, begun, samples_of(recording, guess), hammer.mass, {}, one)
    value = solve.start(problem, omega=np.log(omega / problem.scale["omega"]), damping_ratio=hammer.ratio, gap=hammer.gap / swing,
                        stiffness=np.log(hammer.stiffness / problem.scale["stiffness"]),
                        stop_ratio=hammer.damping / 2 / np.sqrt(hammer.stiffness * hammer.mass))
    found = solve.solved(problem, value)
    moved = problem.motion(found.value, 0)
    places = np.searchsorted(found.problem.legs[0].samples.time, moved.touches)
    return touch_steps.told(problem, found.value, 0, moved, {name: places for name in names}), problem.step


@pytest.mark.parametrize("names", [("force",), ("acceleration",)])
@pytest.mark.parametrize("ratio", [0.02, 0.1, 0.4])
@pytest.mark.parametrize("per_contact", [5, 7, 12])
def test_the_step_that_is_told_holds_the_touch(ratio, per_contact, names):
    """In few samples a force rises by more in the step after a touch than it jumps at it."""
    right = impacts = 0
    for shift in (3, 17, 28):
        hammer, (time, columns), touches = release(ratio, per_contact, shift)
        if shift == 17:  # a sensor turned round
            columns = {name: -values for name, values in columns.items()}
        steps, step = told(hammer, (time, columns), names, 0.003, shift)
        for index, middle in steps.items():
            assert abs(touches[index] - middle) < 0.52 * step, (index, middle / step, touches / step)
        right, impacts = right + len(steps), impacts + min(3, len(touches))
    assert right >= 0.6 * impacts


def test_a_jump_that_a_sensor_smears_is_not_told():
    hammer, recorded, _ = release(0.4, 12, 3)
    time, columns = recorded
    assert len(told(hammer, recorded, ("force",), 0.003, 1)[0]) > 2
    smeared = {name: 0.5 * (values + np.concatenate([values[:1], values[:-1]])) for name, values in columns.items()}
    assert not told(hammer, (time, smeared), ("force",), 0.003, 1)[0]


def test_touches_at_one_phase_tell_no_more_than_one():
    class Apart:
        def __init__(self, phases):
            self.touches, self.jumps = 100 * np.arange(len(phases)) + np.array(phases), dict.fromkeys(range(len(phases)), 0.0)

    class Unit:
        step = 1.0

    assert solve._together(Unit, [Apart([0.3] * 4)]) == pytest.approx(2)
    assert solve._together(Unit, [Apart([0.2]), Apart([0.7])]) == pytest.approx(np.sqrt(1.5))  # correlation -1/2
    assert solve._together(Unit, [Apart([0.1, 0.1 + 0.5 - np.sqrt(1 / 12)])]) == pytest.approx(1)  # none
    assert solve._together(Unit, [Apart([])]) == 1


@pytest.mark.parametrize("number", [1, 7, 18, 19])
def test_the_sample_nearest_a_touch_counts(number):
    """A third impact jumps by 8 standard deviations, and the fit that leaves out its first sample began it a sample late: refused as ringing."""
    hammer = Hammer(1.42, 8.037, 0.00776, 5.06e6, 2441.0, 0.0, -0.005868 * (1 + 0.03 * np.sin(7.3 * number)))
    time, columns = simulate(hammer, 0.3765, 4 * 5689.3)
    every = {name: values[number % 4::4] for name, values in columns.items()}
    pulls = pulls_of(hammer, (4 * time[:len(every["force"])], every), ("force",), 0.012, 100 + number)
    assert not isinstance(pulls, str) and max(map(abs, pulls.values())) < 4, pulls
