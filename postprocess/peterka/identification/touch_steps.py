"""In which step between samples a touch lies, where the samples around it tell.

Fits leave out the sample nearest to a touch, so that a touch could end on its wrong side. Force and acceleration jump at a touch, by
2 zeta v sqrt(ki m), and in few samples they may rise by more in the step after. So the model is compared with the samples around as a whole, its
touch in each step in turn: a step is told if all others are far less likely, with larger errors where the best of them leaves more than noise.
What a real sensor smears over two steps isn't.
"""

from collections.abc import Mapping

import numpy as np

from ..arrays import Integers, Reals
from .motion import Motion
from .problem import SHARP, Problem

REACH = 4  # samples on each side
FRACTIONS = np.linspace(0.02, 0.98, 17)  # of a step
ROUGH = 0.02  # of the model's range: its errors beside noise
SURE = 16.0  # -2 ln likelihood above that of the best step: noise prefers a wrong one in less than one of 30,000 cases, Phi(-sqrt(16))
RIGHT = 4.0  # mean square in standard deviations that noise doesn't exceed: with more left, errors are larger in this ratio


def told(problem: Problem, value: Mapping[str, float], number: int, moved: Motion, places: Mapping[str, Integers]) -> dict[int, float]:
    """{index of a contact: middle [s] of the step in which its touch lies}, where samples tell. `places` {signal: index of the first sample in each contact}."""
    name = next((name for name in SHARP if name in problem.names), None)  # the one without a delay
    samples = problem.legs[number].samples
    if name is None:
        return {}
    at = [index for index, place in enumerate(places[name]) if REACH <= place <= len(samples.time) - REACH]
    if not at:
        return {}
    near = places[name][at][:, None] + np.arange(-REACH, REACH)
    times, step = samples.time[near], problem.step
    model = _models(problem, value, number, moved, name, moved.touches[at], times)
    seen = samples.values[name][near] - problem.base(value, number, name, times)
    left = seen[:, None, None, :] - model
    error = np.maximum(problem.noise[name] * problem.extra_noise.get(name, 1.0), ROUGH * np.ptp(model, axis=(1, 2, 3)))
    costs = np.min(np.sum(left**2, axis=3), axis=2)
    found = {}
    for index, row, cost, scale in zip(at, times, costs, error**2):
        best, second = np.argsort(cost)[:2]
        regular = np.ptp(row) < (2 * REACH - 0.5) * step
        if regular and cost[second] > cost[best] + SURE * max(scale, cost[best] / (2 * REACH) / RIGHT):
            found[index] = float(row[best] + 0.5 * step)
    return found


def _models(problem: Problem, value: Mapping[str, float], number: int, moved: Motion, name: str, touches: Reals, times: Reals) -> Reals:
    """(touches, steps, fractions, samples): the signal, without its offset, if the touch lay there."""
    begins = times[:, :-1, None] + FRACTIONS * problem.step
    then = times[:, None, None, :] - (begins - touches[:, None, None])[..., None]
    order = np.argsort(then, axis=None)
    values = np.empty(then.size)
    values[order] = moved.signals(then.ravel()[order], [name])[name]
    return problem.signs[name] * values.reshape(then.shape)
