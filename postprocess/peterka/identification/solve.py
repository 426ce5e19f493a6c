"""Solves the least-squares Problem with scipy and estimates errors.

The set of samples in contact is fixed before each round, from the touches of the previous round, and the sample nearest to a
touch (for well-sampled contacts, those within one step of it) has no weight: there the model's force jumps, and a real
sensor's does not. The residuals are then a smooth function of the parameters.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from ..arrays import Integers, Mask, Reals
from . import touch_steps
from .motion import Motion
from .problem import LEAST_NOISE, NO_RIG, SHARP, Problem

ROUNDS = 8  # at most, until the set of samples in contact no longer changes
NO_JUMP = 100.0  # standard deviations
WITHIN_STEP = 12**-0.5  # standard deviation of a position uniformly distributed within a step
MANY = 10  # samples of a contact from which two more can be dropped at each touch: one wrongly assigned there misleads the fit
STAYS = 0.3  # of a step: tolerance on the motion of touches in the last round
FEWEST = 4  # residuals needed to estimate a level
CLOSE = 1e-8  # relative change at which least squares terminates
COARSE, BLIND = 0.02, 0.1  # of a signal's range, of a contact
STEP = 1e-6  # difference step of the parameters, which are of order 1
WHITE, FAR = 0.01, 0.01  # standard deviations, and largest change of a parameter, for differences along principal axes


@dataclass(frozen=True)
class Settled:
    """State of a leg: `touches` [s]; of each signal, as delays may differ, `places`: index of the first sample in each contact, `used`: mask of the
    single samples that are not nearest to a touch, `contact`: mask of the single samples in contact; `known` and `known_means`: masks of the part
    before the first excluded impact, without what the problem leaves unseen; `jumps` {index of a contact: middle [s] of the step in which its touch lies}, where
    samples tell it."""

    touches: Reals
    places: dict[str, Integers]
    used: dict[str, Mask]
    known: Mask
    known_means: Mask
    contact: dict[str, Mask]
    jumps: dict[int, float]

    def of(self, name: str) -> Mask:
        """Mask of the single samples of this signal that have weight."""
        return self.used[name] & self.known if name in SHARP else self.known


@dataclass(frozen=True)
class Solved:
    """`value` {parameter}; `covariance` in the order of problem.parameters; `cost`: sum of squares in standard deviations,
    of `rows` residuals; `settled` for each leg."""

    problem: Problem
    value: dict[str, float]
    covariance: Reals
    cost: float
    rows: int
    settled: list[Settled]

    @property
    def per_row(self) -> float:
        """Sum of squares per residual: about 1 where the motion explains the recording."""
        return self.cost / max(self.rows, 1)

    def error(self, name: str) -> float:
        """Standard error of a parameter; 0 if it is fixed."""
        names = self.problem.parameters
        return float(np.sqrt(max(self.covariance[names.index(name), names.index(name)], 0))) if name in names else 0.0


def start(problem: Problem, **begun: float) -> dict[str, float]:
    """{parameter: the given initial value, else 0}."""
    return {name: begun.get(name, problem.fixed.get(name, 0.0)) for name in [*problem.fixed, *problem.parameters]}


def solved(problem: Problem, value: dict[str, float], most: int = 60, rounds: int = ROUNDS) -> Solved:
    """The Solved nearest to these values. Raises ValueError if no rig moves so."""
    names = problem.parameters
    lowest, highest = problem.bounds()
    reach = max(problem.blind, problem.step) / problem.scale["contact"]  # beyond this a touch's samples no longer follow it
    own = np.array([name.startswith("touch ") for name in names])
    settled = [settle(problem, problem.values(np.array([value.get(name, 0.0) for name in names])), number)
               for number in range(len(problem.legs))]
    for _ in range(rounds):
        chosen = np.clip([value.get(name, 0.0) for name in names], lowest, highest)
        lower, upper = np.where(own, chosen - reach, lowest), np.where(own, chosen + reach, highest)
        rows = [_rows(problem, one) for one in settled]
        off = WITHIN_STEP * problem.step * _together(problem, settled)

        def left(chosen: Reals, settled: list[Settled] = settled, rows: list[int] = rows, off: float = off) -> Reals:
            then = problem.values(chosen)
            return np.concatenate([*(_leg(problem, then, number, settled[number], rows[number], off)
                                     for number in range(len(problem.legs))), _priors(problem, then)])

        def slopes(chosen: Reals, left: Callable[[Reals], Reals] = left, rows: list[int] = rows, lower: Reals = lower,
                   upper: Reals = upper) -> Reals:
            rough = _slopes(problem, left, chosen, upper, [*rows, len(problem.prior)])
            return rough if problem.pushed else _sharper(left, chosen, lower, upper, rough)

        answer = least_squares(left, chosen, slopes, bounds=(lower, upper), x_scale="jac", xtol=CLOSE, ftol=CLOSE, gtol=CLOSE,
                               max_nfev=most)
        value, before = problem.values(answer.x), settled
        settled = [settle(problem, value, number) for number in range(len(problem.legs))]
        if all(_stays(old, new, problem.step) for old, new in zip(before, settled)):
            break
    return Solved(problem, value, _covariance(answer.jac), 2 * float(answer.cost), int(sum(rows)), before)


def converged(problem: Problem, value: dict[str, float], **most: int) -> Solved | None:
    """The same; None where it doesn't converge."""
    try:
        return solved(problem, value, **most)
    except (ValueError, np.linalg.LinAlgError):
        return None


def coarse(problem: Problem) -> Problem:
    """The same with large noise and without samples near touches, which limits the pull of samples far from the motion."""
    return replace(problem, noise={name: max(noise, COARSE * problem.ranges[name]) for name, noise in problem.noise.items()
                                   if name in problem.ranges}, blind=BLIND * problem.scale["contact"])


def settle(problem: Problem, value: dict[str, float], number: int) -> Settled:
    """The Settled of a leg for these parameters."""
    samples, moved, delays = problem.legs[number].samples, problem.motion(value, number), problem.by_delay(value)
    places, used, contact = {}, {}, {}
    for late, names in delays.items():
        one = _contacts_seen(problem, samples.time - late, moved)
        for name in names:
            places[name], used[name], contact[name] = one
    until = problem.known_until(moved, number) + min(0.0, *delays)
    known, known_means = samples.time < until, samples.ends < until
    for first, last in problem.unseen:
        first, last = first + min(0.0, *delays), last + max(0.0, *delays)
        known &= (samples.time < first) | (samples.time > last)
        known_means &= (samples.ends < first) | (samples.begins > last)
    jumps = {} if problem.blind or problem.unseen else touch_steps.told(problem, value, number, moved, places)
    return Settled(moved.touches, places, used, known, known_means, contact, jumps)


def _contacts_seen(problem: Problem, time: Reals, moved: Motion) -> tuple[Integers, Mask, Mask]:
    """(places, used, contact) as in Settled, of a signal that is sampled at these times [s]."""
    used, contact = np.ones(len(time), dtype=bool), np.zeros(len(time), dtype=bool)
    places = np.searchsorted(time, moved.touches)
    for touch, place in zip(moved.touches, places):
        near = [at for at in (place - 1, place) if 0 <= at < len(time)]
        if near:
            nearest = min(near, key=lambda at: float(abs(time[at] - touch)))
            used[nearest] = abs(time[nearest] - touch) > problem.step
        used &= np.abs(time - touch) > max(problem.blind, problem.step * (problem.scale["contact"] > MANY * problem.step))
    for begin, end in moved.contacts():
        contact |= (time > begin) & (time < end)
    return places, used, contact


def _together(problem: Problem, settled: Sequence[Settled]) -> float:
    """Factor on the error of a touch's position in its step, since the times between touches are known better than a step: impacts a whole number
    of samples apart are all sampled at the same phase, and many carry no more information than one. Positions, from the middle, of two touches whose phases are a
    fraction f of a step apart have the correlation 1 - 6 f (1 - f) (of sawtooths; f = 0: 1, f = 1/2: -1/2); the factor is the square root of the
    largest eigenvalue of these correlations."""
    touches = np.array([one.touches[at] for one in settled for at in one.jumps]) / problem.step
    apart = np.mod(touches[:, None] - touches, 1)
    return float(np.sqrt(np.linalg.eigvalsh(1 - 6 * apart * (1 - apart))[-1])) if len(touches) else 1.0


def levels(found: Solved, resolution: Mapping[str, float] | None = None) -> tuple[dict[str, float], dict[str, float]]:
    """({signal: root mean square of the residuals outside contact}, {signal: ratio of that in contact to it, at least 1}).
    `resolution` {signal: its smallest step}: values that are rounded to it have an error of their own."""
    noise, more = {}, {}
    for name in found.problem.names:
        outside, inside = left_outside_and_in_contact(found, name)
        level = _level(outside if len(outside) >= FEWEST else inside)
        noise[name] = max(level, LEAST_NOISE * found.problem.ranges[name], (resolution or {}).get(name, 0.0) / np.sqrt(12))
        more[name] = max(1.0, _level(inside) / noise[name]) if len(inside) >= FEWEST else 1.0
    return noise, more


def left_outside_and_in_contact(found: Solved, name: str) -> tuple[Reals, Reals]:
    """Residuals of a signal in all legs: outside contact, scaled to a single sample's noise; in contact."""
    outside, inside = [np.concatenate(parts) for parts in zip(*(_parts(found, number, name) for number in range(len(found.problem.legs))))]
    return outside, inside


def _parts(found: Solved, number: int, name: str) -> tuple[Reals, Reals]:
    """(residuals outside contact, scaled to a single sample's noise; residuals in contact) of a signal in a leg."""
    settled, counts = found.settled[number], found.problem.legs[number].samples.counts
    singles, means = found.problem.left(found.value, number, settled.places)
    fine, known = settled.of(name), settled.known_means
    return (np.concatenate([singles[name][fine & ~settled.contact[name]], (means[name] * np.sqrt(counts))[known]]),
            singles[name][fine & settled.contact[name]])


def _level(left: Reals) -> float:
    return float(np.sqrt(np.mean(left**2))) if len(left) else 0.0


def _stays(old: Settled, new: Settled, step: float) -> bool:
    return bool(len(old.touches) == len(new.touches) and np.all(np.abs(old.touches - new.touches) < STAYS * step)
                and old.jumps == new.jumps and np.sum(old.known != new.known) + np.sum(old.known_means != new.known_means) <= 1)


def _rows(problem: Problem, settled: Settled) -> int:
    return int(sum(settled.of(name).sum() + settled.known_means.sum() for name in problem.names)) + len(settled.jumps)


def _leg(problem: Problem, value: dict[str, float], number: int, settled: Settled, rows: int, off: float) -> Reals:
    try:
        moved = problem.motion(value, number)
        singles, means = problem.left(value, number, settled.places, moved)
    except (ValueError, FloatingPointError, OverflowError):
        return np.full(rows, NO_RIG)
    counts, found = np.sqrt(problem.legs[number].samples.counts), []
    for name in problem.names:
        noise = problem.noise[name] * np.where(settled.contact[name], problem.extra_noise.get(name, 1.0), 1.0)
        found += [(singles[name] / noise)[settled.of(name)], (means[name] * counts / problem.noise[name])[settled.known_means]]
    touches = moved.touches
    found.append(np.array([(touches[at] - middle) / off if at < len(touches) else NO_JUMP for at, middle in settled.jumps.items()]))
    values: Reals = np.clip(np.nan_to_num(np.concatenate(found), nan=NO_RIG), -NO_RIG, NO_RIG)
    return values


def _slopes(problem: Problem, left: Callable[[Reals], Reals], chosen: Reals, upper: Reals, rows: Sequence[int]) -> Reals:
    """Jacobian of all residuals, (residuals, parameters), by differences; a leg's own parameters are varied in all legs at once."""
    names, here = problem.parameters, left(chosen)
    edges, found = np.concatenate([[0], np.cumsum(rows)]), np.zeros((len(here), len(names)))
    for own in dict.fromkeys(name.split()[0] for name in names):
        columns = [column for column, name in enumerate(names) if name.split()[0] == own]
        moved = np.array(chosen)
        steps = np.where(moved[columns] + STEP < upper[columns], STEP, -STEP)
        moved[columns] += steps
        change = left(moved) - here
        for column, step in zip(columns, steps):
            words = names[column].split()
            inside = slice(None) if len(words) == 1 else slice(edges[int(words[1])], edges[int(words[1]) + 1])
            found[inside, column] = change[inside] / step
        if len(columns) > 1 or " " in names[columns[0]]:
            for column, step in zip(columns, steps):  # each prior depends only on its own parameter
                found[edges[-2]:, column] = [1 / deviation if names[column] == name else 0.0
                                             for name, (_, deviation) in problem.prior.items()]
    return found


def _sharper(left: Callable[[Reals], Reals], chosen: Reals, lower: Reals, upper: Reals, rough: Reals) -> Reals:
    """The Jacobian by central differences along the principal axes of a rough one, by WHITE standard deviations each, but at most FAR.
    Springs, gap and speed compensate each other to 1e-4 and less, which differences along the single parameters do not resolve."""
    size = np.maximum(np.sqrt(np.sum(rough**2, axis=0)), 1e-30)
    _, strengths, axes = np.linalg.svd(rough / size, full_matrices=False)
    found = []
    for strength, way in zip(strengths, axes / size):
        room = np.min(np.minimum(chosen - lower, upper - chosen) / np.maximum(np.abs(way), 1e-300))
        step = min(WHITE / max(strength, 1e-300), FAR / np.max(np.abs(way)), room)
        if room * np.max(np.abs(way)) < STEP:
            return rough
        found.append((left(chosen + step * way) - left(chosen - step * way)) / (2 * step))
    values: Reals = np.transpose(found) @ (axes * size)
    return values


def _priors(problem: Problem, value: Mapping[str, float]) -> Reals:
    return np.array([(value[name] - mean) / deviation for name, (mean, deviation) in problem.prior.items()])


def _covariance(jacobian: Reals) -> Reals:
    size = np.sqrt(np.sum(jacobian**2, axis=0))
    size[size == 0] = 1e-30
    scaled = jacobian / size
    return np.linalg.pinv(scaled.T @ scaled, rcond=1e-15, hermitian=True) / np.outer(size, size)
