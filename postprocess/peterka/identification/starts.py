"""Initial values for least squares: the stop from single impacts, springs and gap from the swings between them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..arrays import Reals
from .contact_pulse import identified, pulse
from .first_guess import Guess
from .problem import SHARP, SLOW, Leg, Problem
from .recording import Recording
from .samples import Samples, thinned
from .solve import Solved, solved, start

FIRST_RESTITUTION = 0.5
SLICE = 1.5  # of a pulse's width: window of a single impact before and after the pulse
AROUND, LEAST_AROUND = 3, 15  # widths of a pulse, and samples, kept before and after it
SEEN = 4  # samples of a contact from which it determines a stop by itself
GLIMPSED = 2  # samples from which it gives initial values, of which flights tell the better ones
SCANNED_RATIOS, SCANNED_LENGTHS, SCANNED_TOUCHES = (0.02, 0.1, 0.25, 0.5), np.linspace(0.6, 1.2, 7), 24
MOST_ALONE = 8  # impacts fitted individually at first
WAVES: tuple[Any, ...] = (np.cos, np.sin)
SWINGS = 400  # omegas tried for a detected swing
ROUGH = 0.3  # error of a touch, in contact times, and relative error of a speed estimated from a pulse height
FIRST_PUSH = 0.03  # standard deviation of the push by springs and cart during an impact, relative to the stop's


@dataclass(frozen=True)
class Impact:
    """A pulse of a Guess as an impact: touch [s] from the beginning of the recording, speed [m/s], and their errors, [s] and relative."""

    touch: float
    speed: float
    number: int
    touch_error: float
    speed_error: float


@dataclass(frozen=True)
class Begin:
    """First guesses: ki [N/m], damping ratio of the stop, contact time [s], and all impacts; `alone`: the fit of the hardest
    ones by themselves; None if they are not resolved well enough; relative errors of restitution and contact time in that fit."""

    stiffness: float
    stop_ratio: float
    contact: float
    restitution: float
    impacts: list[Impact]
    alone: Solved | None
    restitution_error: float = 0.0
    contact_error: float = 0.0


def window(guess: Guess, number: int) -> tuple[int, int]:
    """(first, after the last) of the samples around a pulse that are kept individually."""
    one = guess.pulses[number]
    around = max(AROUND * max(one.last - one.first, guess.contact), LEAST_AROUND)
    return one.first - around, one.last + around


def samples_of(recording: Recording, guess: Guess) -> Samples:
    """The Samples of the whole recording, thinned between impacts."""
    flights = np.diff([one.first for one in guess.pulses]) * recording.step
    return thinned(recording, [window(guess, number) for number in range(len(guess.pulses))],
                   float(flights.min()) if len(flights) else None)


def begin(recording: Recording, guess: Guess, mass: float) -> Begin:
    """The Begin of a recording."""
    hardest = guess.pulses[guess.hardest]
    contact = max(guess.contact, 1.5) * recording.step
    stiffness, damping = identified(mass, FIRST_RESTITUTION, contact)
    ratio, touch = damping / (2 * np.sqrt(stiffness * mass)), recording.step * (hardest.first - 0.5)
    speed, alone = _rough_speed(recording, guess, mass, stiffness), None
    if guess.sharp and guess.contact >= GLIMPSED:
        stiffness, ratio, touch, speed = _scanned(recording, guess, mass)
        contact = pulse(mass, stiffness, 2 * ratio * np.sqrt(stiffness * mass))[1]
    impacts = [Impact(touch + recording.step * (one.first - hardest.first), speed * one.height / hardest.height, number,
                      ROUGH * contact, ROUGH)
               for number, one in enumerate(guess.pulses)]
    if guess.sharp and guess.contact >= GLIMPSED:
        alone = _alone(recording, guess, mass, stiffness, ratio, contact, sorted(
            sorted(impacts, key=lambda one: -one.speed)[:MOST_ALONE], key=lambda one: one.touch))
    if alone is not None:
        rig, legs = alone.problem.rig(alone.value), alone.problem.legs
        stiffness, ratio = rig.stiffness, alone.value["stop_ratio"]
        for number, leg in enumerate(legs):
            at = next(at for at, one in enumerate(impacts) if one.touch == leg.touch)
            impacts[at] = replace(impacts[at], touch=leg.touch + contact * alone.value[f"touch {number}"],
                                  speed=float(leg.speed * np.exp(alone.value[f"speed {number}"])),
                                  touch_error=contact * alone.error(f"touch {number}"), speed_error=alone.error(f"speed {number}"))
    restitution, contact = pulse(mass, stiffness, 2 * ratio * np.sqrt(stiffness * mass))
    return Begin(stiffness, ratio, contact, restitution, impacts, alone, *(_errors_of(alone, ratio) if alone else ()))


def _errors_of(alone: Solved, ratio: float) -> tuple[float, float]:
    """Relative errors of (restitution, contact time) of a stop of this damping ratio."""
    error = alone.error("stop_ratio")
    less, more = (pulse(1.0, 1.0, 2 * max(ratio + way * error, 0.0)) for way in (-1, 1))
    return float(0.5 * np.log(less[0] / max(more[0], 1e-300))), 0.5 * alone.error("stiffness")


def impact_legs(recording: Recording, guess: Guess, impacts: Sequence[Impact]) -> list[Leg]:
    """A separate Leg for each impact."""
    legs = []
    for impact in impacts:
        one = guess.pulses[impact.number]
        around = int(SLICE * max(one.last - one.first, 4))
        inside = one.first - around, one.last + around
        part = thinned(recording, [inside], None).part(recording.step * (inside[0] - 0.5), recording.step * (inside[1] - 0.5))
        legs.append(Leg(only_sharp(part).without_means(), impact.touch, impact.speed, 1))
    return legs


def only_sharp(samples: Samples) -> Samples:
    """The same without displacements, which do not determine a single impact."""
    return replace(samples, values={name: values for name, values in samples.values.items() if name in SHARP},
                   means={name: values for name, values in samples.means.items() if name in SHARP})


def alone_problem(recording: Recording, guess: Guess, mass: float, stiffness: float, contact: float, legs: Sequence[Leg],
                  pushes: float) -> Problem:
    """The Problem of single impacts, each with its own push by springs and cart."""
    names = [name for name in SHARP if name in guess.signs]
    push = max(leg.speed for leg in legs) * np.pi / contact
    prior = {f"push_{part} {leg}": (0.0, pushes / (1 if part == "cos" else SLOW)) for leg in range(len(legs)) for part in ("cos", "sin")}
    return Problem(mass, legs, {"stiffness": stiffness, "omega": 1e-3 / contact, "gap": 1.0, "contact": contact, "push": push},
                   ["stiffness", "stop_ratio"], {"omega": 0.0, "damping_ratio": 0.0, "gap": 0.0, "mean_cos": 0.0, "mean_sin": 0.0}, guess.signs, guess.offsets,
                   {name: guess.ranges[name] for name in names}, noise_levels(guess), recording.step, pushed=True, prior=prior)


def noise_levels(guess: Guess) -> dict[str, float]:
    """Noise of all signals, none of them 0."""
    return {name: max(noise, 1e-6 * guess.ranges[name]) for name, noise in guess.noise.items()}


def _alone(recording: Recording, guess: Guess, mass: float, stiffness: float, ratio: float, contact: float,
           impacts: Sequence[Impact]) -> Solved | None:
    """The Solved of single impacts with a common stop; None if the fit fails."""
    problem = alone_problem(recording, guess, mass, stiffness, contact, impact_legs(recording, guess, impacts), FIRST_PUSH)
    try:
        return solved(problem, start(problem, stop_ratio=ratio))
    except (ValueError, np.linalg.LinAlgError):
        return None


def _scanned(recording: Recording, guess: Guess, mass: float) -> tuple[float, float, float, float]:
    """(ki, damping ratio, touch [s], speed [m/s]) of the hardest impact: the best match among many pulses of a free mass."""
    one = guess.pulses[guess.hardest]
    around, step = one.last - one.first, recording.step
    first, last = max(0, one.first - around), one.last + around
    time = step * np.arange(first, min(last, recording.count))
    assert guess.sharp is not None
    signal = -guess.signs[guess.sharp] * mass if guess.sharp == "acceleration" else guess.signs[guess.sharp]
    recorded: Reals = np.asarray(recording.signals[guess.sharp][first:last], dtype=float)
    force = np.nan_to_num(signal * (recorded - guess.offsets[guess.sharp]))
    best = (float(np.inf), 0.0, 0.0, 0.0, 0.0)
    for ratio in SCANNED_RATIOS:
        for length in around * SCANNED_LENGTHS:
            stiffness = mass * (pulse(mass, mass, 2 * ratio * mass)[1] / (length * step))**2
            for begin in np.linspace(one.first - 1, one.top, SCANNED_TOUCHES):
                shape = _free_pulse(time - step * begin, stiffness, ratio, mass)
                speed = float(shape @ force / max(float(shape @ shape), 1e-300))
                cost = float(np.sum((force - speed * shape)**2))
                if speed > 0 and cost < best[0]:
                    best = (cost, stiffness, ratio, step * begin, speed)
    return best[1:]


def _free_pulse(since: Reals, stiffness: float, ratio: float, mass: float) -> Reals:
    """Force [N] of a free mass that touches at time 0 with 1 m/s; damping ratio below 1."""
    omega = np.sqrt(stiffness / mass)
    swing = omega * np.sqrt(1 - ratio**2)
    inside = np.clip(since, 0, np.pi / swing)
    place = np.exp(-ratio * omega * inside) * np.sin(swing * inside) / swing
    speed = np.exp(-ratio * omega * inside) * (np.cos(swing * inside) - ratio * omega / swing * np.sin(swing * inside))
    return np.where(since >= 0, np.maximum(stiffness * place + 2 * ratio * np.sqrt(stiffness * mass) * speed, 0), 0)


def _rough_speed(recording: Recording, guess: Guess, mass: float, stiffness: float) -> float:
    """The speed at which an impact is as strong as the recorded one; for a displacement, its slope before the impact."""
    hardest = guess.pulses[guess.hardest]
    if guess.sharp:
        value: float = hardest.height * (1 / mass if guess.sharp == "force" else 1) / np.sqrt(stiffness / mass) * 1.3
        return value
    values = recording.signals["displacement"]
    before = np.asarray(values[max(0, hardest.first - 100):hardest.first], dtype=float)
    slope = np.polyfit(np.arange(len(before)), before, 1)[0] if len(before) > 2 else guess.ranges["displacement"] / 100
    return max(abs(float(slope)) / recording.step, 1e-9)


def from_swings(samples: Samples, guess: Guess, begun: Begin, omega: float | None, gap: float | None) -> list[tuple[float, float]]:
    """[(omega [rad/s], gap [m])] of detected swings: a separate amplitude for each stretch between impacts, a common omega,
    by linear least squares for each trial omega; given values are kept."""
    seen = next((name for name in ("displacement", "acceleration") if name in guess.signs), None)
    if seen is None:
        return []
    time, values = 0.5 * (samples.begins + samples.ends), guess.signs[seen] * samples.means[seen]
    weights = np.sqrt(samples.counts)
    touches = np.array([one.touch for one in begun.impacts])
    piece = np.searchsorted(touches, time)
    kept = np.isin(piece, [number for number in np.unique(piece) if np.sum(piece == number) >= 12])
    if kept.sum() < 12:
        return []
    time, values, weights, piece = time[kept], values[kept], weights[kept], piece[kept]
    longest = max(np.ptp(time[piece == number]) for number in np.unique(piece))
    shortest = np.median(np.diff(np.sort(time)))
    omegas = np.array([omega]) if omega else np.geomspace(0.5 * np.pi / longest, min(np.pi / (4 * shortest), 400 * np.pi / longest), SWINGS)
    costs, answers = [], []
    for tried in omegas:
        columns = [np.ones(len(time))]
        for number in np.unique(piece):
            columns += [np.where(piece == number, wave(tried * time), 0.0) for wave in WAVES]
        matrix = np.transpose(columns)
        answer = np.linalg.lstsq(matrix * weights[:, None], values * weights, rcond=None)[0]
        costs.append(float(np.sum((weights * (values - matrix @ answer))**2)))
        answers.append(answer)
    best = int(np.argmin(costs))
    tried, answer, found = omegas[best], answers[best], []
    for at, number in enumerate(np.unique(piece)):
        for impact in (number - 1, number):
            if 0 <= impact < len(touches):
                swing = answer[1 + 2 * at] * np.cos(tried * touches[impact]) + answer[2 + 2 * at] * np.sin(tried * touches[impact])
                found.append(swing if seen == "displacement" else -swing / tried**2)
    return [(float(tried), float(np.median(found)) if gap is None else gap)] if found else []
