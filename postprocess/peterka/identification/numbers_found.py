"""What came out of measurements: numbers with their standard errors, and how errors go on through a function."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ..arrays import Reals
from .contact_pulse import pulse


@dataclass(frozen=True)
class Number:
    """A value and its standard error, None where it was given."""

    value: float
    error: float | None = None


@dataclass(frozen=True)
class Identified:
    """ki [N/m], ci [Ns/m]; natural frequency [Hz] and damping ratio of the springs, None where neither the recording nor
    anybody tells; restitution and contact time [s] of one impact of a free mass on this stop."""

    mass: float
    stiffness: Number
    damping: Number
    natural_frequency_hz: Number | None
    damping_ratio: Number | None
    restitution: Number
    contact_s: Number
    covariance: np.ndarray  # of ki and ci, (2, 2)

    def replaced(self, **numbers: Number) -> Self:
        """The same with other Numbers."""
        return replace(self, **numbers)


def identified_from(mass: float, stiffness: float, damping: float, covariance: Reals,
                    natural_frequency_hz: Number | None = None, damping_ratio: Number | None = None) -> Identified:
    """Identified of ki and ci with their covariance (2, 2), and the Numbers of the springs."""
    covariance = np.asarray(covariance)
    errors = np.sqrt(np.diag(covariance))
    restitution, contact_s = propagated(lambda k, c: pulse(mass, k, c), (stiffness, damping), covariance)
    return Identified(mass, Number(stiffness, float(errors[0])), Number(damping, float(errors[1])), natural_frequency_hz,
                      damping_ratio, restitution, contact_s, covariance)


def propagated(function: Callable[..., Sequence[float]], values: Sequence[float], covariance: Reals) -> list[Number]:
    """Numbers of what a function makes of values with this covariance."""
    at = np.asarray(values, dtype=float)
    middle = np.array(function(*at))
    slopes = np.empty((len(middle), len(at)))
    for column, step in enumerate(1e-5 * np.maximum(np.abs(at), 1e-300)):
        ends = [at.copy() for _ in range(2)]
        ends[0][column] = max(ends[0][column] - step, 0)
        ends[1][column] += step
        slopes[:, column] = (np.array(function(*ends[1])) - np.array(function(*ends[0]))) / (ends[1][column] - ends[0][column])
    errors = np.sqrt(np.maximum(np.diag(slopes @ covariance @ slopes.T), 0))
    return [Number(float(value), float(error)) for value, error in zip(middle, errors)]


def combined(found: Sequence[Identified]) -> Identified:
    """The Identified of several of the same mass: means, each with its own weight. Where they scatter by more than their
    errors, the errors grow by as much."""
    if len(found) == 1:
        return found[0]
    values = np.array([[one.stiffness.value, one.damping.value] for one in found])
    weights = [np.linalg.pinv(one.covariance) for one in found]
    covariance = np.linalg.pinv(sum(weights))
    mean = covariance @ sum(weight @ value for weight, value in zip(weights, values))
    scatter = sum((value - mean) @ weight @ (value - mean) for weight, value in zip(weights, values)) / (2 * len(found) - 2)
    springs = {name: _mean([getattr(one, name) for one in found]) for name in ("natural_frequency_hz", "damping_ratio")}
    return identified_from(found[0].mass, float(mean[0]), float(mean[1]), covariance * max(1.0, scatter), **springs)


def combined_impacts(found: Sequence[Identified], in_step: bool) -> Identified:
    """The same of impacts of one recording. Where sampling is in step with them, all jumps lie at the same place between
    samples, and that many impacts tell no better than one where it is: the errors don't shrink."""
    mean = combined(found)
    if not in_step:
        return mean
    covariance = np.mean([one.covariance for one in found], axis=0)
    return identified_from(mean.mass, mean.stiffness.value, mean.damping.value, covariance)


def _mean(numbers):
    """Of those that there are."""
    numbers = [number for number in numbers if number is not None]
    if not numbers:
        return None
    values, errors = np.transpose([(number.value, max(number.error, 1e-300)) for number in numbers])
    weights = errors**-2 / np.sum(errors**-2)
    mean, error = float(np.sum(weights * values)), float(np.sum(errors**-2) ** -0.5)
    scatter = np.sum(((values - mean) / errors)**2) / max(len(values) - 1, 1)
    return Number(mean, error * float(np.sqrt(max(1.0, scatter))))
