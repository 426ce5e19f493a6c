"""Identified numbers with standard errors and covariance, and error propagation through a function."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Reals
from .contact_pulse import pulse

# Keys as in jobs, in SI units; the gap is last, a key of the operating point rather than of the rig.
KEYS = ("contact.stiffness_n_per_m", "contact.damping_ns_per_m", "hammer.natural_frequency_hz", "hammer.damping_ratio",
        "operating_point.gap_m")
STIFFNESS, DAMPING, FREQUENCY, DAMPING_RATIO, GAP = KEYS


@dataclass(frozen=True)
class Number:
    """A value and its standard error; None if the value was given."""

    value: float
    error: float | None = None


@dataclass(frozen=True)
class Identified:
    """Results for a hammer of `mass` [kg]: {key of KEYS: value}, their `covariance` in the order of `values`, and `given` {key:
    value}, which were not measured."""

    mass: float
    values: Mapping[str, float]
    covariance: Reals
    given: Mapping[str, float]

    def number(self, key: str) -> Number | None:
        """The Number of a key; None if it is undetermined."""
        if key in self.given:
            return Number(self.given[key])
        if key not in self.values:
            return None
        return Number(self.values[key], float(np.sqrt(max(self._variance(key), 0.0))))

    def _variance(self, key: str) -> float:
        at = list(self.values).index(key)
        value: float = self.covariance[at, at]
        return value

    def correlation(self, one: str, other: str) -> float:
        """Correlation of two keys of `values`."""
        names = list(self.values)
        pair = self.covariance[names.index(one), names.index(other)]
        size = np.sqrt(self._variance(one) * self._variance(other))
        return float(pair / size) if size > 0 else 0.0

    def impact(self) -> tuple[Number, Number]:
        """(restitution, contact time [s]) of one impact of a free mass on this stop."""
        both = [self.number(STIFFNESS), self.number(DAMPING)]
        names, matrix = list(self.values), np.zeros((2, 2))  # 0 where a number was given
        fitted = [at for at, key in enumerate((STIFFNESS, DAMPING)) if key in names]
        places = [names.index((STIFFNESS, DAMPING)[at]) for at in fitted]
        matrix[np.ix_(fitted, fitted)] = self.covariance[np.ix_(places, places)]
        restitution, contact_s = propagated(lambda k, c: pulse(self.mass, k, c), [number.value for number in both if number], matrix)
        return restitution, contact_s


def identified_from(found: Any, likeness: float) -> Identified:
    """Identified from a Solved, with errors for correlated neighbouring residuals."""
    problem, names = found.problem, found.problem.parameters
    rig = problem.rig(found.value)
    stop = 2 * np.sqrt(rig.stiffness * rig.mass)
    # rows: KEYS, columns: parameters
    slopes = {STIFFNESS: {"stiffness": rig.stiffness}, DAMPING: {"stop_ratio": stop, "stiffness": rig.damping / 2},
              FREQUENCY: {"omega": rig.omega / (2 * np.pi)}, DAMPING_RATIO: {"damping_ratio": 1.0}, GAP: {"gap": problem.scale["gap"]}}
    values = {STIFFNESS: rig.stiffness, DAMPING: rig.damping, FREQUENCY: rig.omega / (2 * np.pi), DAMPING_RATIO: rig.damping_ratio,
              GAP: rig.gap}
    fitted = [key for key in KEYS[:2 if problem.pushed else None] if set(slopes[key]) <= set(names)]
    matrix = np.zeros((len(fitted), len(names)))
    for row, key in enumerate(fitted):
        for name, slope in slopes[key].items():
            matrix[row, names.index(name)] = slope
    covariance = matrix @ found.covariance @ matrix.T * (1 + likeness) / (1 - likeness)
    given = {} if problem.pushed else {key: values[key] for key in KEYS if key not in fitted}
    return Identified(rig.mass, {key: float(values[key]) for key in fitted}, covariance, given)


def identified_stop(mass: float, stiffness: float, damping: float, covariance: Reals) -> Identified:
    """Identified from ki and ci with their covariance (2, 2) alone."""
    return Identified(mass, {STIFFNESS: stiffness, DAMPING: damping}, np.asarray(covariance), {})


def propagated(function: Callable[..., Sequence[float]], values: Sequence[float], covariance: Reals) -> list[Number]:
    """Numbers of a function of values with this covariance, by linear error propagation."""
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
    """Combines several Identified of the same mass by generalised least squares. If they scatter more than their errors
    allow, the errors are increased accordingly."""
    if len(found) == 1:
        return found[0]
    keys = [key for key in KEYS if any(key in one.values for one in found)]
    information, target, freedom = np.zeros((len(keys), len(keys))), np.zeros(len(keys)), -len(keys)
    weighed = []
    for one in found:
        places = [keys.index(key) for key in one.values]
        size = np.sqrt(np.maximum(np.diag(one.covariance), 1e-300))
        weight = np.linalg.pinv(one.covariance / np.outer(size, size), hermitian=True) / np.outer(size, size)
        values = np.array(list(one.values.values()))
        information[np.ix_(places, places)] += weight
        target[places] += weight @ values
        freedom += len(places)
        weighed.append((places, weight, values))
    size = 1 / np.sqrt(np.diag(information))
    covariance = np.linalg.pinv(information * np.outer(size, size), hermitian=True) * np.outer(size, size)
    mean = covariance @ target
    scatter = sum((values - mean[places]) @ weight @ (values - mean[places]) for places, weight, values in weighed)
    given = {key: value for one in found for key, value in one.given.items() if key not in keys}
    return Identified(found[0].mass, dict(zip(keys, mean.tolist())), covariance * max(1.0, scatter / max(freedom, 1)), given)
