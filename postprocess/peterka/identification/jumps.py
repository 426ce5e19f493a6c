"""Where the force jumps at first touch: which samples that leaves out, and what it tells of the touch."""

from collections.abc import Mapping

import numpy as np

from ..arrays import Mask, Reals
from .model import SHARP, Model

SHARP_JUMP = 0.85  # of the model's jump at first touch, from one sample to the next
JUMP_OVER_NOISE = 10
WITHIN_STEP = 12**-0.5  # standard deviation of a place that may be anywhere within a step


def sharp_jumps(model: Model, parameters: Reals, time: Reals, recorded: Mapping[str, Reals]) -> dict[int, float]:
    """{number of an impact: middle [s] of the step in which it begins}, where a recorded signal jumps within that step as
    far as the model says: then the touch lies in it."""
    moved = model.motion(parameters, time[-1])
    found: dict[int, float] = {}
    name = next((name for name in SHARP if name in model.names), None)
    if name is None:
        return found
    sign = model.guess.signs[name] * (1 if name == "force" else -1)
    values = sign * recorded[name]
    for number, touch in enumerate(moved.touches):
        place = int(np.searchsorted(time, touch))
        if not 3 <= place < len(time) - 3:
            continue
        height = float(moved.signals(np.array([touch + 1e-3 * model.recording.step]), ["force"])["force"][0])
        height /= 1 if name == "force" else model.mass
        steps = np.diff(values[place - 3:place + 3])
        largest = int(np.argmax(steps))
        if height > JUMP_OVER_NOISE * model.noise[name] and steps[largest] > SHARP_JUMP * height:
            found[number] = float(time[place - 3 + largest] + 0.5 * model.recording.step)
    return found


def off_jumps(jumps: Mapping[int, float], touches: Reals) -> Reals:
    """How far [s] touches are from where jumps were recorded; those that aren't there any more are off by nothing."""
    return np.array([touches[number] - middle if number < len(touches) else 0.0 for number, middle in jumps.items()])


def away_from_touches(model: Model, parameters: Reals, time: Reals) -> Mask:
    """Which of these times [s] lie more than a step of the recording from every touch, (n,)."""
    touches = model.motion(parameters, time[-1] + model.recording.step).touches
    nearest = np.clip(np.searchsorted(touches, time), 1, max(1, len(touches) - 1))
    away = np.minimum(np.abs(time - touches[nearest - 1]), np.abs(time - touches[min(len(touches) - 1, 1):][nearest - 1])
                      if len(touches) > 1 else np.inf)
    return away > model.recording.step
