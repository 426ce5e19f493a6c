"""Whether the hammer is one mass: the share of its mobility at the stop that belongs to other modes than its swing.

An impulse J changes the velocity of each mode by J over its modal mass, that of the contact point by J times the sum of 1/m_k. If S is the
share of the modes beyond the first in that sum, and e the restitution of the contact, which the shape of the force alone tells, a
swing that meets the stop while the other modes are at rest changes its velocity by 1 - S of what the contact point's changes, (1 + e) v,
and so returns with e_swing = e - (1 + e) S:

    S = (e - e_swing)/(1 + e)

Swings are fitted to the displacement in the flights before and after an impact: of common frequency and damping, with own amplitudes,
and beside them as many faster modes as stand out of the noise. Impacts that other modes meet moving aren't used. Modes with periods of
less than some five contacts have time to yield to the force while it lasts, and count in part.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from ..arrays import Reals
from .contact_pulse import pulse
from .first_guess import Guess
from .numbers_found import Number, propagated
from .recording import Recording
from .starts import Begin, from_swings, samples_of

MOST_IMPACTS = 4  # the first ones, with flights on both sides
MOST_ROWS = 5000  # of displacement, as means over several samples if there are more
LEAST_ROWS = 40  # in a flight
MOST_MODES = 4
STANDS_OUT = 5.0  # over the median of a spectrum of amplitudes
FASTER = 2.0  # a mode, than the swing
FIRST_RATIO = 0.01
QUIET = 0.03  # of the swing's velocity
SPREAD = 0.3  # of omega: bound on its change
AFTER = 0.3  # of a contact: left out after it
TOO_MUCH = 0.05  # share beyond which the hammer isn't one mass
KNOWN = 0.05  # standard error of a share that is worth telling

Rates = Sequence[Sequence[float]] | Reals  # (omega [rad/s], damping ratio) of each mode


@dataclass(frozen=True)
class _Flights:
    """Displacement of all flights: `time`, `value`, `weight` and `flight` (its index) of each row; `begins` of the flights."""

    time: Reals
    value: Reals
    weight: Reals
    flight: Reals
    begins: Reals


def share_of_modes(recording: Recording, guess: Guess, begun: Begin) -> Number | None:
    """S with its standard error; None where force and displacement don't tell it."""
    if begun.alone is None or guess.sharp != "force" or "displacement" not in guess.signs:
        return None
    impacts = begun.impacts[:MOST_IMPACTS]
    flights = _flights(recording, guess, begun)
    swings = from_swings(samples_of(recording, guess), guess, begun, None, None)
    sizes = np.bincount(flights.flight, minlength=len(impacts) + 1)
    kept = [at for at in range(len(impacts)) if min(sizes[at], sizes[at + 1]) >= LEAST_ROWS]
    if not kept or not swings:
        return None
    rates = _fitted(flights, [(swings[0][0], FIRST_RATIO)])
    while len(rates) < MOST_MODES and (more := _standing_out(flights, rates)):
        rates = _fitted(flights, [*rates, (more, FIRST_RATIO)])
    alone = begun.alone
    ratio, error = alone.value["stop_ratio"], alone.error("stop_ratio")
    restitution = propagated(lambda z: [pulse(1.0, 1.0, 2 * z)[0]], [ratio], np.array([[error**2]]))[0]
    kept = [at for at in kept if _quiet(flights, rates, begun, at)]
    if not kept:
        return None
    shares, covariance = _shares(flights, rates, begun, kept)
    weights = 1 / np.diag(covariance)
    weights = weights / weights.sum()
    changed = float(weights @ shares)  # (1 - S)(1 + e)
    scatter = float(np.sum((shares - changed)**2 / np.diag(covariance))) / max(len(kept) - 1, 1)
    own = float(weights @ covariance @ weights) * max(1.0, scatter)
    plus = 1 + restitution.value
    error = float(np.hypot(np.sqrt(own) / plus, changed * (restitution.error or 0.0) / plus**2))
    return Number(1 - changed / plus, error) if error < KNOWN else None


def share_words(share: Number) -> str:
    """Says what a share means."""
    told = f"other modes have {share.value:.3f} ± {share.error:.3f} of the hammer's mobility at the stop"
    if share.value > TOO_MUCH:
        return (told + ", so that it isn't one mass: it swings back slower than its contact with the stop sends it off, and computed "
                "forces are off")
    return told


def _flights(recording: Recording, guess: Guess, begun: Begin) -> _Flights:
    """The _Flights around the first impacts."""
    step, impacts = recording.step, begun.impacts[:MOST_IMPACTS]
    last = begun.impacts[len(impacts)].touch if len(begun.impacts) > len(impacts) else step * (recording.count - 1)
    begins = [0.0, *(one.touch + (1 + AFTER) * begun.contact for one in impacts)]
    ends = [*(one.touch - 2 * step for one in impacts), last - 2 * step]
    edges = [(int(np.ceil(begin / step)), int(end / step)) for begin, end in zip(begins, ends)]
    size = max(1, sum(max(0, end - begin) for begin, end in edges) // MOST_ROWS)
    parts = []
    for number, (begin, end) in enumerate(edges):
        rows = max(0, end - begin) // size
        values = np.asarray(recording.signals["displacement"][begin:begin + rows * size], dtype=float).reshape(rows, size)
        time = step * (begin + size * np.arange(rows) + 0.5 * (size - 1))
        there = np.isfinite(values).all(axis=1)
        parts.append((time[there], guess.signs["displacement"] * values.mean(axis=1)[there], np.full(there.sum(), number)))
    time, value, flight = (np.concatenate(one) for one in zip(*parts))
    return _Flights(time, value, np.ones(len(time)), flight, np.array(begins))


def _matrix(flights: _Flights, rates: Rates) -> Reals:
    """Columns: a constant, then of each mode and flight a decaying cosine and sine that begin with the flight."""
    columns = [np.ones(len(flights.time))]
    since = flights.time - flights.begins[flights.flight]
    for omega, ratio in rates:
        swinging = np.exp(-ratio * omega * since) * np.exp(1j * omega * np.sqrt(1 - ratio**2) * since)
        for number in range(len(flights.begins)):
            here = np.where(flights.flight == number, swinging, 0)
            columns += [here.real, here.imag]
    return np.transpose(columns)


def _amplitudes(flights: _Flights, rates: Rates) -> tuple[Reals, Reals]:
    matrix = _matrix(flights, rates)
    return np.linalg.lstsq(matrix, flights.value, rcond=1e-10)[0], matrix


def _fitted(flights: _Flights, rates: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """(omega [rad/s], damping ratio) of each mode by least squares; amplitudes follow linearly."""
    first = np.ravel([(0.0, ratio) for _, ratio in rates])
    omegas = np.array([omega for omega, _ in rates])

    def pairs(chosen: Reals) -> list[tuple[float, float]]:
        return [(omega * np.exp(chosen[2 * at]), chosen[2 * at + 1]) for at, omega in enumerate(omegas)]

    def left(chosen: Reals) -> Reals:
        answer, matrix = _amplitudes(flights, pairs(chosen))
        return (flights.value - matrix @ answer) / scale

    scale = max(float(np.std(flights.value)), 1e-300)
    lower, upper = np.tile([-SPREAD, 0.0], len(rates)), np.tile([SPREAD, 0.5], len(rates))
    return pairs(least_squares(left, first, bounds=(lower, upper), x_scale=np.tile([1e-3, 1e-2], len(rates)), xtol=1e-6, max_nfev=15).x)


def _standing_out(flights: _Flights, rates: Rates) -> float:
    """omega [rad/s] of the largest peak of what is left in a flight, if it stands out of the spectrum; else 0."""
    answer, matrix = _amplitudes(flights, rates)
    left, best = flights.value - matrix @ answer, (STANDS_OUT, 0.0)
    for number in range(1, len(flights.begins)):
        inside = flights.flight == number
        if inside.sum() < LEAST_ROWS:
            continue
        time = flights.time[inside]
        step = float(np.median(np.diff(time)))
        size = 4 * len(time)
        spectrum = np.abs(np.fft.rfft(left[inside] * np.hanning(len(time)), size))
        omegas = 2 * np.pi * np.fft.rfftfreq(size, step)
        spectrum[omegas < FASTER * rates[0][0]] = 0
        top = int(np.argmax(spectrum))
        level = float(np.median(spectrum[spectrum > 0])) if spectrum.any() else np.inf
        near = any(abs(np.log(omegas[top] / omega)) < 0.05 for omega, _ in rates) if top else True
        if not near and spectrum[top] > best[0] * level:
            best = (spectrum[top] / level, float(omegas[top]))
    return best[1]


def _velocity(flights: _Flights, amplitudes: Reals, rate: Sequence[float] | Reals, mode: int, flight: int, time: float) -> float:
    """Velocity [m/s] of a mode of this (omega, damping ratio) in a flight."""
    omega, ratio = rate
    root = omega * (-ratio + 1j * np.sqrt(1 - ratio**2))
    at = 1 + 2 * (mode * len(flights.begins) + flight)
    value: float = ((amplitudes[at] - 1j * amplitudes[at + 1]) * root * np.exp(root * (time - flights.begins[flight]))).real
    return value


def _quiet(flights: _Flights, rates: Rates, begun: Begin, at: int) -> bool:
    """Whether the swing alone moves before an impact: others move by less than QUIET of its velocity, at any phase."""
    amplitudes, _ = _amplitudes(flights, rates)
    touch = begun.impacts[at].touch
    swing, *others = (np.hypot(_velocity(flights, amplitudes, rate, mode, at, touch),
                               _velocity(flights, amplitudes, rate, mode, at, touch - 0.5 * np.pi / rate[0]) if mode else 0.0)
                      for mode, rate in enumerate(rates))
    return bool(sum(others) < QUIET * swing)


def _shares(flights: _Flights, rates: Rates, begun: Begin, kept: Sequence[int]) -> tuple[Reals, Reals]:
    """((1 - S)(1 + e) of each kept impact, their covariance)."""
    modes = len(rates)
    flat = np.ravel(rates)

    def told(chosen: Reals) -> Reals:
        answer, pairs = chosen[2 * modes:], chosen[:2 * modes].reshape(-1, 2)
        found = []
        for at in kept:
            middle = begun.impacts[at].touch + 0.5 * begun.contact
            before, after = (_velocity(flights, answer, pairs[0], 0, flight, middle) for flight in (at, at + 1))
            found.append((before - after) / before)
        return np.array(found)

    answer, matrix = _amplitudes(flights, rates)
    steps = 1e-5 * np.maximum(np.abs(flat), 1e-3)
    slopes = np.transpose([(_matrix(flights, (flat + step * axis).reshape(-1, 2)) - matrix) @ answer / step
                           for step, axis in zip(steps, np.eye(len(flat)))])
    jacobian = np.hstack([slopes, matrix])
    size = np.maximum(np.sqrt(np.sum(jacobian**2, axis=0)), 1e-300)
    noise = np.sum((flights.value - matrix @ answer)**2) / max(len(flights.value) - jacobian.shape[1], 1)
    chosen = np.concatenate([flat, answer])
    scaled = jacobian / size
    covariance = noise * np.linalg.pinv(scaled.T @ scaled, rcond=1e-13, hermitian=True) / np.outer(size, size)
    here = told(chosen)
    way = np.transpose([(told(chosen + step * axis) - told(chosen - step * axis)) / (2 * step)
                        for step, axis in zip(1e-5 * np.maximum(np.abs(chosen), 1e-3 / size), np.eye(len(chosen)))])
    return here, way @ covariance @ way.T + 1e-12 * np.eye(len(kept))
