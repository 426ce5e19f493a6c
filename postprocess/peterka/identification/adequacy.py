"""Tests whether the fitted motion explains a recording: residuals against noise.

Fits of single impacts, each with its own time and speed, show how much a spring and a dashpot leave unexplained; if the
whole motion leaves more in the same samples (F test, allowing for correlated neighbours), its springs, gap or cart are wrong.
Between impacts the residuals must change sign as often as noise does (runs test of Wald and Wolfowitz, 1940).
"""

from collections.abc import Mapping

import numpy as np
from scipy.stats import f, norm

from ..arrays import Integers, Reals
from ..errors import PeterkaFileError
from .first_guess import Guess
from .problem import SHARP
from .recording import Recording
from .solve import Solved, left_outside_and_in_contact, settle
from .starts import Begin

CHANCE = 1e-6  # significance level below which residuals are not noise
LEAST_LEFT = 3e-4  # of the hardest peak; no sensor resolves less
LEAST_SWING = 0.01  # of a signal's range: smaller residuals between impacts are ignored
FEWEST = 20  # residuals for a test
NEAR_TOP = 0.5  # of the hardest peak: samples above it are compared
CONTRADICTION = 1.25  # ratio of force to mass times acceleration, or its inverse; other modes of the hammer make some of it, too
SPRINGS_SHARE = 4.0  # of a contact over the time between impacts: more than springs take from the force at gaps up to 0.89 of the swing
FEWEST_UNWEAKENED, UNWEAKENED = 9, 0.97  # impacts, median of the last third's peaks over the first's: a loss of less than 0.5 % of the speed in each
ADVICE = "cut out one release with --from and --to; where the cart moves, give it as --driven"


def refuse_contradicting(recording: Recording, guess: Guess, mass: float) -> None:
    """Raises PeterkaFileError where force and acceleration in the impacts aren't in the ratio of the mass [kg]. The springs push back, too, so that the
    force is the less, the longer a contact is beside the time between impacts."""
    if not set(SHARP) <= recording.signals.keys():
        return
    tops = np.concatenate([np.arange(pulse.first, pulse.last) for pulse in guess.pulses])
    hardest = np.arange(guess.pulses[guess.hardest].first, guess.pulses[guess.hardest].last)

    def signal(name: str, at: Integers, factor: float = 1.0) -> Reals:
        values = np.asarray(recording.signals[name][np.clip(at, 0, recording.count - 1)], dtype=float)
        return guess.signs[name] * factor * (values - guess.offsets[name])

    # One may be recorded later than the other.
    late = max(range(-guess.contact, guess.contact + 1),
               key=lambda late: abs(float(np.nansum(signal("force", hardest) * signal("acceleration", hardest + late)))))
    force, push = signal("force", tops), signal("acceleration", tops + late, -mass)
    seen = np.isfinite(force) & np.isfinite(push)
    seen &= force > NEAR_TOP * np.max(force[seen], initial=0)
    size = float(np.sum(push[seen]**2))
    if not size > 0:
        return
    ratio = abs(float(np.sum(force[seen] * push[seen]))) / size
    noise = np.hypot(guess.noise["force"], ratio * mass * guess.noise["acceleration"]) / np.sqrt(size)
    apart = np.diff([pulse.top for pulse in guess.pulses])
    springs = min(1.0, SPRINGS_SHARE * guess.contact / float(apart.min())) if len(apart) else 1.0
    widest = CONTRADICTION * np.exp(4 * noise)
    if not (1 - springs) / widest <= ratio <= widest:
        raise PeterkaFileError(f"{recording.path} has forces in its impacts of {ratio:.3g} times the mass times the acceleration, {mass:.4g} kg: the mass, or "
                          "the sensitivity of a sensor, is wrong, or the hammer isn't one mass there")


def refuse_unweakened(recording: Recording, guess: Guess) -> None:
    """Raises PeterkaFileError where impacts stay as hard as the first ones: over a cart at rest each takes some of the hammer's speed."""
    heights = [pulse.height for pulse in guess.pulses]
    third = len(heights) // 3
    if guess.sharp and len(heights) >= FEWEST_UNWEAKENED and np.median(heights[-third:]) > UNWEAKENED * np.median(heights[:third]):
        raise PeterkaFileError(f"{recording.path} isn't the motion of a hammer that was let go over a cart at rest: the last of its {len(heights)} impacts are as hard "
                          f"as the first. {ADVICE[0].upper() + ADVICE[1:]}")


def refuse_other_motion(recording: Recording, found: Solved, begun: Begin, impacts: int, given: Mapping[str, float]) -> None:
    """Raises PeterkaFileError if the whole motion of one leg is not the recorded one."""
    named = {"gap": f"{1e3 * given.get('gap', 0):.4g} mm from the stop", "omega": "with these springs", "damping_ratio": ""}
    what = " ".join(["the motion of a hammer that was let go over a cart at rest", *(named[name] for name in given if named[name])])
    touches = found.problem.motion(found.value, 0).touches
    if len(touches) < impacts:
        raise PeterkaFileError(f"{recording.path} isn't {what}: it shows {impacts} impacts, and the nearest such motion has {len(touches)}. "
                          f"{_hint(given)}")
    if begun.alone is not None and not found.problem.unseen:
        chance, more = _impacts_left(found, begun.alone)
        if chance < CHANCE:
            raise PeterkaFileError(f"{recording.path} isn't {what}: its impacts are off the nearest one by {more:.3g} times what they are off a "
                              f"spring and a dashpot by themselves, which noise does in less than one of {1 / CHANCE:.0e} cases. Sensors that are too slow for the "
                              f"contacts, ring, or have another sensitivity than told do it, too. {_hint(given)}")
    for name in found.problem.names:
        chance, share = _between_left(found, name)
        if chance < CHANCE and share > LEAST_SWING:
            raise PeterkaFileError(f"{recording.path} isn't {what}: between impacts its {name} is off the nearest one by {100 * share:.2g} % of "
                              f"its range, and not by noise. {_hint(given)}")


def _hint(given: Mapping[str, float]) -> str:
    if "gap" in given:
        return "Without --gap-mm the gap is fitted; else " + ADVICE
    return ADVICE[0].upper() + ADVICE[1:]


def _impacts_left(found: Solved, alone: Solved) -> tuple[float, float]:
    """(p-value, ratio of root mean squares) of the residuals near impacts, of the whole motion against single-impact fits."""
    problem = found.problem
    moved = problem.motion(found.value, 0)
    whole = itself = 0.0
    count = 0
    for number, leg in enumerate(alone.problem.legs):
        settled, time = settle(alone.problem, alone.value, number), leg.samples.time
        model = problem.recorded(found.value, 0, moved, time)
        single = alone.problem.left(alone.value, number, settled.places)[0]
        for name in alone.problem.names:
            touches = moved.touches + problem.delay(found.value, name)
            far = settled.used[name] & np.all([np.abs(time - touch) > problem.step for touch in touches], axis=0)
            floor = LEAST_LEFT * problem.ranges[name]
            whole += float(np.sum((leg.samples.values[name] - model[name])[far]**2 / floor**2))
            itself += float(np.sum(single[name][far]**2 / floor**2)) + far.sum()
            count += int(far.sum())
    own = 2 * len(alone.problem.legs)
    if count <= 3 * own or whole <= itself:
        return 1.0, 1.0
    alike = likeness_of(alone)  # as errors allow for it: what changes slowly is that much larger
    ratio = (whole - itself) / own / (itself / (count - own)) * (1 - alike) / (1 + alike)
    return float(f.sf(ratio, own, count - own)), float(np.sqrt(whole / itself))


def more_left_in_contact(found: Solved) -> float:
    """The probability that noise leaves that much more in contact than elsewhere (F test), the smallest of all signals."""
    problem, least = found.problem, 1.0
    for name in problem.names:
        outside, inside = left_outside_and_in_contact(found, name)
        own = len(problem.parameters) / len(problem.names)
        if len(outside) >= FEWEST and len(inside) > own + FEWEST:
            ratio = float(np.sum(inside**2)) / (len(inside) - own) / max(float(np.mean(outside**2)), problem.noise[name]**2)
            least = min(least, float(f.sf(ratio, len(inside) - own, len(outside))))
    return least


def likeness_of(found: Solved) -> float:
    """Correlation of neighbouring residuals in contact, from 0 to below 1, which increases errors beyond those of white noise."""
    problem = found.problem
    most = 0.0
    for name in set(SHARP) & set(problem.names):
        pieces = []
        for number in range(len(problem.legs)):
            settled = found.settled[number]
            left = problem.left(found.value, number, settled.places)[0][name]
            pieces.append(left[settled.contact[name] & settled.of(name)])
        square = sum(float(np.sum(left**2)) for left in pieces)
        count = sum(len(left) for left in pieces)
        if count > 20 and square > 0:
            alike = sum(float(np.sum(left[1:] * left[:-1])) for left in pieces) / square
            if alike > 3 / np.sqrt(count):
                most = max(most, min(alike, 0.98))
    return most


def _between_left(found: Solved, name: str) -> tuple[float, float]:
    """(p-value of so few sign changes, structured part of the residual over the signal's range) between impacts."""
    settled, problem = found.settled[0], found.problem
    left = problem.left(found.value, 0, settled.places)[1][name][settled.known_means]
    if name in SHARP and name == "force" or len(left) < FEWEST:
        return 1.0, 0.0
    alike = float(np.mean(left[1:] * left[:-1]))
    return runs_chance(left), float(np.sqrt(max(alike, 0.0))) / problem.ranges[name]


def runs_chance(left: Reals) -> float:
    """The probability that noise changes sign so rarely, by the normal approximation of Wald and Wolfowitz (1940)."""
    signs = left > np.median(left)
    above, below = int(signs.sum()), int((~signs).sum())
    if min(above, below) < 2:
        return 1.0
    runs = 1 + int(np.sum(signs[1:] != signs[:-1]))
    product, count = 2 * above * below, above + below
    mean, variance = product / count + 1, product * (product - count) / (count**2 * (count - 1))
    return float(norm.cdf((runs + 0.5 - mean) / np.sqrt(variance)))
