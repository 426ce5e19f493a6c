"""The rig whose motion over a cart at rest is nearest to a recording, by least squares, with standard errors.

What is fitted: ki, ci, the first touch and its speed, the springs' omega and damping ratio where the recording tells them,
and an offset of each signal; the mass and the gap are given. The window grows from the first impact over the next ones to
the whole recording, so that each impact is met where it is. Samples within a step of a touch count for nothing: there the
force of the model jumps, and that of a real sensor doesn't.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from ..files.checked_hdf5 import NotDrawable
from .first_guess import FEWEST_IN_CONTACT, Guess, look
from .jumps import WITHIN_STEP, away_from_touches, off_jumps, sharp_jumps
from .model import DAMPING, DAMPING_RATIO, LEAST_NOISE, OMEGA, SHARP, Model
from .numbers_found import Identified, Number, identified_from
from .recording import Recording
from .release_motion import Motion

ROUNDS = 4  # of a window, until the samples near touches stay the same
UNKNOWN = 0.25  # a relative standard error above which a number isn't known
ADVICE = "Cut out one release with --from and --to; where the cart moves, give it as --driven"
OTHERWISE, OTHERWISE_ERRORS = 0.1, 4  # by how much, and by how many standard errors, two stiffnesses differ
UNEXPLAINED = 0.2  # of a signal's variance
FREE = 1e-3  # springs that swing by so much during a recording are none
SLICE, WEAKEST_ALONE = 1.5, 0.2  # impacts by themselves: time before and after in contacts, force over the hardest one's
FARTHEST = (8.0, 50.0, 5.0, 5.0, 2.0, 0.99)  # from the first guess of each parameter but offsets
SCANNED = 60
WINDOWS = 4  # impacts that the window takes in one by one


@dataclass(frozen=True)
class Fit:
    """`recording`: what was fitted; `fitted` {signal: values of the model as recorded, sign and offset included}; `noise` {signal: root mean square of
    what is left}; `misfit`: the same in contact alone over the noise elsewhere, of the signal where it is largest."""

    recording: Recording
    found: Identified
    motion: Motion
    fitted: dict[str, np.ndarray]
    noise: dict[str, float]
    misfit: float
    model_between: Callable  # times -> {signal: values} like `fitted`


def fit(recording: Recording, mass: float, gap: float, springs: tuple[float, float] | None = None) -> Fit:
    """The Fit of a Recording over a cart at rest; mass [kg], gap [m], and the (omega [rad/s], damping ratio) of the springs
    where they are known. NotDrawable where the recording doesn't tell."""
    guess = look(recording)
    if springs is None and (guess.flights or set(recording.signals) != {"force"}):
        model = Model(recording, guess, mass, gap, None)
        solved = _with_springs(model)
        if solved is not None:
            return _agreeing(_finished(model, *solved), recording, guess)
    return _agreeing(_fit_to_known_springs(recording, guess, mass, gap, springs), recording, guess)


def _agreeing(found, recording, guess):
    """The Fit, unless the hardest impact by itself says otherwise: flights of the wrong motion may bend a stop to theirs."""
    hardest = [pulse for pulse in guess.pulses if pulse.height == max(one.height for one in guess.pulses)]
    try:
        alone = fit_each(recording, found.found.mass, replace(guess, pulses=hardest))[0].found.stiffness
    except NotDrawable:
        return found
    whole = found.found.stiffness
    apart = abs(whole.value - alone.value)
    if apart > max(OTHERWISE_ERRORS * np.hypot(whole.error, alone.error), OTHERWISE * alone.value):
        raise NotDrawable(f"{recording.path} isn't the motion of a hammer that was let go over a cart at rest, at this gap: as such "
                          f"it has ki = {whole.value:.3g} N/m, and the hardest impact by itself {alone.value:.3g} N/m. {ADVICE}")
    return found


def fit_each(recording: Recording, mass: float, guess: Guess | None = None) -> list[Fit]:
    """[Fit] of each impact of a Recording by itself, whatever moves the hammer between them; the weakest are left out.

    During an impact the springs and the cart change the speed by far less than the stop does."""
    guess = guess or look(recording)
    if not guess.pulses:
        raise NotDrawable(f"{recording.path} has neither force nor acceleration, without which single impacts can't be told")
    found, refusal = [], None
    hardest = max(pulse.height for pulse in guess.pulses)
    for pulse in guess.pulses:
        around = int(SLICE * (pulse.last - pulse.first))
        inside = slice(max(0, pulse.first - around), pulse.last + around)
        if pulse.height < WEAKEST_ALONE * hardest or pulse.first < around or pulse.last + around > len(recording.time):
            continue
        piece = replace(recording, time=recording.time[inside],
                        signals={name: recording.signals[name][inside] for name in SHARP if name in recording.signals})
        offsets = {name: float(np.median(values[:around])) for name, values in piece.signals.items()}
        own = replace(guess, offsets=offsets, flights=[], pulses=[pulse],
                      touch_time=float(recording.time[pulse.first] - 0.5 * recording.step))
        try:
            found.append(_fit_to_known_springs(piece, own, mass, 0.0, None))
        except NotDrawable as reason:
            refusal = reason
    if not found:
        raise refusal or NotDrawable(f"{recording.path} has no impact with {SLICE} times its own time before and after it")
    return found


def _fit_to_known_springs(recording, guess, mass, gap, springs):
    model = Model(recording, guess, mass, gap, springs or (FREE / np.ptp(recording.time), 0.0))
    return _finished(model, *_grown(model, _first_impact(model, model.start(1.0)), springs=False))


def _with_springs(model):
    """(parameters, covariance) of the best fit with the springs free; None where they can't be told."""
    first = _first_impact(model, model.start(np.pi / (model.guess.flights or [np.ptp(model.recording.time)])[0]))
    solved = []
    for omega in _first_omegas(model, first):
        begun = first.copy()
        begun[OMEGA] = np.log(omega / model.omega)
        try:
            solved.append(_grown(model, begun, springs=True))
        except (ValueError, np.linalg.LinAlgError):
            pass  # it led nowhere
    if not solved:
        return None
    best = min(solved, key=lambda found: _cost(model, found[0]))
    return best if 0 <= best[1][OMEGA, OMEGA] < UNKNOWN**2 else None


def _first_omegas(model, parameters):
    """With which the second impact comes when it was recorded; without one, what the recording could be long enough for."""
    if not model.guess.flights:
        return [np.pi / np.ptp(model.recording.time) * factor for factor in (0.5, 1, 2, 4, 8)]
    flight = model.guess.flights[0]
    omegas, late = np.pi / flight * np.linspace(0.8, 2.1, SCANNED), []
    for omega in omegas:
        moved = parameters.copy()
        moved[OMEGA] = np.log(omega / model.omega)
        touches = model.motion(moved, model.guess.touch_time + 3 * flight).touches
        late.append(touches[1] - touches[0] - flight if len(touches) > 1 else np.nan)
    late = np.array(late)
    passes = np.flatnonzero(late[:-1] * late[1:] <= 0)
    return [omegas[i] + (omegas[i + 1] - omegas[i]) * late[i] / (late[i] - late[i + 1]) for i in passes] or [np.pi / flight]


def _first_impact(model, parameters):
    time, begin, contact = model.recording.time, model.guess.touch_time, model.guess.contact_s
    return _solved(model, parameters, np.abs(time - begin) <= 4 * contact, springs=False)[0]


def _grown(model, parameters, springs):
    """(parameters, covariance), from a window over the first impacts to the whole recording."""
    time = model.recording.time
    ends = model.guess.touch_time + np.cumsum(model.guess.flights)[:WINDOWS] + 4 * model.guess.contact_s
    for end in [*ends, time[-1]]:
        parameters, covariance = _solved(model, parameters, time <= end, springs)
    for name, left in _residuals(model, parameters).items():
        model.noise[name] = max(float(np.sqrt(np.mean(left**2))), LEAST_NOISE * model.ranges[name])
    return _solved(model, parameters, np.ones(len(time), dtype=bool), springs)


def _solved(model, parameters, inside, springs):
    time = model.recording.time[inside]
    recorded = {name: values[inside] for name, values in model.recording.signals.items()}
    free = model.free(springs)
    upper = np.append(FARTHEST, np.ones(len(model.names)))
    lower = np.where(np.isin(np.arange(len(upper)), (DAMPING, DAMPING_RATIO)), 0, -upper)
    before = None
    for _ in range(ROUNDS):
        used = away_from_touches(model, parameters, time)
        if before is not None and np.array_equal(used, before):
            break
        before = used

        jumps = sharp_jumps(model, parameters, time, recorded)

        def left(chosen, used=used, jumps=jumps):
            moved = parameters.copy()
            moved[free] = chosen
            try:
                motion_then = model.motion(moved, time[-1])
            except ValueError:  # no rig at all
                return np.full(int(sum(used.sum() if name in SHARP else len(used) for name in model.names)) + len(jumps), 1e6)
            fitted = model.signals(motion_then, moved, time)
            differences = [(recorded[name] - fitted[name])[used if name in SHARP else slice(None)] / model.noise[name]
                           for name in model.names]
            return np.concatenate([*differences, off_jumps(jumps, motion_then.touches) / (WITHIN_STEP * model.recording.step)])

        answer = least_squares(left, np.clip(parameters, lower, upper)[free], bounds=(lower[free], upper[free]),
                               x_scale="jac", xtol=1e-12, ftol=1e-12, gtol=1e-12, max_nfev=60)
        parameters = parameters.copy()
        parameters[free] = answer.x
    covariance = np.zeros((len(parameters), len(parameters)))
    covariance[np.ix_(free, free)] = np.linalg.pinv(answer.jac.T @ answer.jac)
    return parameters, covariance


def _residuals(model, parameters):
    """{signal: recorded less fitted}, without what lies at a touch."""
    time = model.recording.time
    used = away_from_touches(model, parameters, time)
    fitted = model.signals(model.motion(parameters, time[-1]), parameters, time)
    return {name: (model.recording.signals[name] - fitted[name])[used if name in SHARP else slice(None)]
            for name in model.names}


def _cost(model, parameters):
    return sum(float(np.sum((left / model.guess.noise[name])**2)) if model.guess.noise[name] else float(np.sum(left**2))
               for name, left in _residuals(model, parameters).items())


def _finished(model, parameters, covariance):
    moved = model.motion(parameters, model.recording.time[-1])
    fitted = model.signals(moved, parameters, model.recording.time)
    _refuse_other_motion(model, fitted)
    misfit, likeness = _misfit(model, moved, fitted)
    covariance = covariance * (1 + likeness) / (1 - likeness)
    rig, errors = moved.rig, np.sqrt(np.diag(covariance))
    scale = np.array([rig.stiffness, model.first[1]])
    springs = {}
    if not model.springs:
        springs = {"natural_frequency_hz": Number(rig.omega / (2 * np.pi), rig.omega / (2 * np.pi) * errors[OMEGA]),
                   "damping_ratio": Number(rig.damping_ratio, errors[DAMPING_RATIO])}
    found = identified_from(model.mass, rig.stiffness, rig.damping, covariance[:2, :2] * np.outer(scale, scale), **springs)
    _refuse_unknown(model, found)
    noise = {name: float(np.sqrt(np.mean(left**2))) for name, left in _residuals(model, parameters).items()}
    return Fit(model.recording, found, moved, fitted, noise, misfit, lambda time: model.signals(moved, parameters, time))


def _misfit(model, moved, fitted):
    """(root mean square of what is left in contact over that elsewhere, the most of all signals; how alike neighbours of
    what is left in contact are, from 0 to below 1, which makes errors larger than noise alone would)."""
    time, step = model.recording.time, model.recording.step
    contact = np.zeros(len(time), dtype=bool)
    for begin, end in moved.contacts():
        contact |= (time > begin + step) & (time < end)
    most, likeness = 1.0, 0.0
    for name in set(SHARP) & set(model.names):
        left = model.recording.signals[name] - fitted[name]
        inside, outside = left[contact], left[~contact]
        if len(inside) < FEWEST_IN_CONTACT or len(outside) < FEWEST_IN_CONTACT:
            continue
        level = max(1.4826 * np.median(np.abs(outside)), LEAST_NOISE * model.ranges[name])
        most = max(most, float(np.sqrt(np.mean(inside**2)) / level))
        alike = float(np.sum(inside[1:] * inside[:-1]) / max(np.sum(inside**2), 1e-300))
        if alike > 3 / np.sqrt(len(inside)):
            likeness = max(likeness, min(alike, 0.98))
    return most, likeness


def _refuse_other_motion(model, fitted):
    """What moves otherwise than a hammer over a cart at rest isn't this motion, however well one impact fits."""
    for name in model.names:
        values = model.recording.signals[name]
        noise = len(values) * model.guess.noise[name] ** 2
        left, all_of_it = np.sum((values - fitted[name]) ** 2) - noise, np.sum((values - np.median(values)) ** 2) - noise
        if left > UNEXPLAINED * max(all_of_it, noise):
            raise NotDrawable(f"{model.recording.path} isn't the motion of a hammer that was let go over a cart at rest, at this "
                              f"gap: of its {name} {100 * min(left / all_of_it, 1):.0f} % is something else. {ADVICE}")


def _refuse_unknown(model, found):
    path, seen = model.recording.path, found.contact_s.value / model.recording.step
    if seen < FEWEST_IN_CONTACT:
        raise NotDrawable(f"{path} is too coarse to see the contact, which lasts for {seen:.2g} samples; {FEWEST_IN_CONTACT} "
                          "are needed at least")
    stiffness, damping = found.stiffness, found.damping
    critical = 2 * np.sqrt(stiffness.value * model.mass)
    if stiffness.error > UNKNOWN * stiffness.value or damping.error > max(UNKNOWN * damping.value, 0.05 * critical):
        raise NotDrawable(f"{path} doesn't tell the stop: ki = {stiffness.value:.3g} ± {stiffness.error:.2g} N/m, ci = "
                          f"{damping.value:.3g} ± {damping.error:.2g} Ns/m. Record force or acceleration, with less noise or "
                          "at a higher rate, or measure restitution and contact time")
