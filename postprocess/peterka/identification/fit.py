"""Fits a rig's motion over a cart at rest to a recording by least squares, with standard errors.

Parameters: ki and the stop's damping ratio, the springs' omega and damping ratio, the gap, the time and speed of the first
touch, and an offset of each signal; given values are not fitted. Single-impact fits locate each impact; springs and gap have
several initial values, from flights and swings.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Reals
from ..errors import PeterkaFileError
from .adequacy import likeness_of, refuse_contradicting, refuse_other_motion, refuse_unweakened
from .channels import calmed, glimpsed, with_all_channels, with_channels, without_channels
from .first_guess import Guess, look
from .flights import Start, from_events, likely
from .flights_alone import contact_samples, least_stiffness, trusted
from .numbers_found import Identified, Number, identified_from
from .one_mode import share_of_modes, share_words
from .problem import Leg, Problem
from .recording import Recording
from .samples import Samples
from .solve import Solved, coarse, levels, solved, start
from .starts import SEEN, Begin, Impact, begin, from_swings, noise_levels, samples_of
from .twins import likeliest

FIRST_DAMPING_RATIO = 0.01
FEWEST_GLIMPSED = 3  # impacts, of contacts of fewer samples than SEEN
WIDE = {"omega": (0.0, 2.0), "damping_ratio": (0.02, 0.3), "gap": (0.0, 3.0)}  # weakly informative priors
UNKNOWN = 0.25  # relative standard error above which a number counts as unknown
EXPLAINED = 1.5  # sum of squares per residual, in standard deviations: above it, another minimum is looked for
MOST_LATE = 2  # impacts
MOST_AGAIN = 2  # initial values, the best ones
LEAST_RATIO = 0.05  # standard error of a stop's damping ratio that always suffices


@dataclass(frozen=True)
class Fit:
    """`found` from a `recording`; `solved` has the motion; `impacts` are those of the recording that were used, `unused`
    describes the others; `doubts`: in words, why errors may be larger than told; `misfit`: root mean square of the residuals in contact over that elsewhere, the maximum over all
    signals; `share`: of the hammer's mobility in other modes than its swing, None where it isn't told."""

    recording: Recording
    guess: Guess
    solved: Solved
    found: Identified
    misfit: float
    likeness: float
    impacts: Sequence[Impact]
    unused: Sequence[str] = ()
    doubts: Sequence[str] = ()
    share: Number | None = None

    def error(self, name: str) -> float:
        """The standard error of a parameter, as told: with what neighbouring residuals have in common."""
        return self.solved.error(name) * float(np.sqrt((1 + self.likeness) / (1 - self.likeness)))

    def contacts(self) -> list[tuple[float, float]]:
        """(begin, end) of each contact of the motion [s], from the beginning of the recording."""
        problem = self.solved.problem
        return [pair for number in range(len(problem.legs)) for pair in problem.motion(self.solved.value, number).contacts()]

    def model(self, time: Reals) -> dict[str, Reals]:
        """{signal: values as recorded} at these times [s] from the beginning of the recording; NaN where nothing was fitted."""
        problem = self.solved.problem
        found = {name: np.full(len(time), np.nan) for name in problem.names}
        for number, leg in enumerate(problem.legs):
            edges = np.concatenate([leg.samples.time, leg.samples.begins, leg.samples.ends])
            inside = (time >= edges.min()) & (time <= edges.max())
            moved = problem.motion(self.solved.value, number)
            for name, values in problem.recorded(self.solved.value, number, moved, time[inside]).items():
                found[name][inside] = values
        return found


def fit(recording: Recording, mass: float, given: Mapping[str, float] | None = None) -> Fit:
    """The Fit of a Recording over a cart at rest; mass [kg]; `given`: "gap" [m], "omega" [rad/s], "damping_ratio" if known.
    Raises PeterkaFileError if the recording does not determine the stop."""
    calm = calmed(recording)
    given, guess = dict(given or {}), look(recording, calm)
    refuse_contradicting(calm, guess, mass)
    refuse_unweakened(recording, guess)
    begun, samples = begin(recording, guess, mass), samples_of(recording, guess)
    starts = likely(from_events(begun, mass, given))
    starts += [Start(omega, begun.impacts[0].speed / omega, {"gap": gap * omega / begun.impacts[0].speed}, np.inf)
               for omega, gap in from_swings(samples, guess, begun, given.get("omega"), given.get("gap"))]
    if not starts:
        return fit_alone(recording, guess, begun, mass)
    found = _from_each(recording, guess, begun, samples, mass, given, starts)
    if not found:
        raise PeterkaFileError(f"{recording.path} isn't the motion of a hammer that was let go over a cart at rest")
    found.sort(key=lambda one: one.per_row)
    if found[0].per_row > EXPLAINED:  # drift or hum may have led all of them astray
        seen = glimpsed(found[0])
        few = list(dict.fromkeys([*range(len(starts))[:MOST_AGAIN], len(starts) - 1]))  # the likeliest, and the last: that of the swings, if there is one
        found += _from_each(recording, guess, begun, samples, mass, given, [starts[at] for at in few], (seen or found[0]).problem.mains)
        found.sort(key=lambda one: one.per_row)
    found = with_channels(found)
    if guess.sharp and contact_samples(found[0]) < SEEN:
        refuse_few(recording, begun, contact_samples(found[0]))
    best, other = likeliest(trusted(recording.path, found))
    corrected = without_channels(recording, best)
    share = None if corrected is None else share_of_modes(corrected, guess, begun)
    try:
        told = replace(agreeing(finished(recording, guess, best, begun.impacts), begun, given), share=share)
    except PeterkaFileError as refusal:
        if share is None or not share.value - 2 * (share.error or 0) > 0:
            raise
        raise PeterkaFileError(f"{refusal}; {share_words(share)}") from None
    if other is not None:
        raise PeterkaFileError(f"{recording.path} doesn't tell two rigs apart: {other}")
    return told


def refuse_few(recording: Recording, begun: Begin, samples: float) -> None:
    """Raises PeterkaFileError for few impacts of few samples: such a fit once had a frequency off by 8 of its standard errors."""
    if len(begun.impacts) < FEWEST_GLIMPSED:
        raise PeterkaFileError(f"{recording.path} shows {len(begun.impacts)} impacts of about {samples:.2g} samples; of so few samples "
                          f"{FEWEST_GLIMPSED} impacts are needed. Record at a higher rate, from a larger start, or for longer")


def _from_each(recording: Recording, guess: Guess, begun: Begin, samples: Samples, mass: float, given: Mapping[str, float],
               starts: Sequence[Start], mains: float | None = None) -> list[Solved]:
    """[Solved] from each Start from which it converges; with all errors of channels where the frequency of the `mains` [Hz] is given."""
    tried = []
    for one in starts:
        problem = release_problem(recording, guess, begun, samples, mass, given, one)
        if mains is not None:
            problem = with_all_channels(problem, mains)
        value = _begun(problem, begun, one, given)
        try:
            if "damping_ratio" not in one.value:  # from a swing, which is less accurate than one sample
                value = solved(coarse(problem), value).value
            tried.append((solved(problem, value), value))
        except (ValueError, np.linalg.LinAlgError):
            pass  # no convergence from here
    tried.sort(key=lambda pair: pair[0].per_row)
    found = [one for one, _ in tried]
    if found and found[0].per_row > EXPLAINED:
        for reached, value in tried[:MOST_AGAIN]:
            found += _one_after_the_other(reached.problem, value)
    return found


def _one_after_the_other(problem: Problem, value: dict[str, float]) -> list[Solved]:
    """[Solved] without the last impacts at first, then with one more at a time: late ones move the most, and may be missed."""
    leg, found = problem.legs[0], []
    for first in range(leg.impacts - 1, max(leg.impacts - 1 - MOST_LATE, 1), -1):
        then = value
        try:
            for count in range(first, leg.impacts + 1):
                reached = solved(replace(problem, legs=[replace(leg, impacts=count)]), then)
                then = reached.value
        except (ValueError, np.linalg.LinAlgError):
            break  # no convergence from here
        found.append(reached)
        if reached.per_row < EXPLAINED:
            break
    return found


def agreeing(found: Fit, begun: Begin, given: Mapping[str, float]) -> Fit:
    """The Fit; raises PeterkaFileError if its residuals show that the recording is of a different motion."""
    refuse_other_motion(found.recording, found.solved, begun, len(found.impacts), given)
    return telling(found)


def release_problem(recording: Recording, guess: Guess, begun: Begin, samples: Samples, mass: float, given: Mapping[str, float],
                    begin_at: Start) -> Problem:
    """The Problem of the whole recording as one leg."""
    first = begun.impacts[0]
    omega, swing = begin_at.omega, begin_at.swing
    free = [name for name in ("stiffness", "stop_ratio", "omega", "damping_ratio", "gap") if name not in given]
    fixed = {"omega": 0.0, "damping_ratio": given.get("damping_ratio", 0.0), "gap": given.get("gap", 0.0) / swing}
    scale = {"stiffness": begun.stiffness, "omega": given.get("omega", omega), "gap": swing, "contact": begun.contact}
    return Problem(mass, [Leg(samples, first.touch, first.speed, len(begun.impacts))], scale, free,
                   {name: value for name, value in fixed.items() if name not in free}, guess.signs, guess.offsets, guess.ranges,
                   noise_levels(guess), recording.step, prior={name: WIDE[name] for name in free if name in WIDE})


def _begun(problem: Problem, begun: Begin, one: Start, given: Mapping[str, float]) -> dict[str, float]:
    """Initial parameters."""
    told = {"touch 0" if name == "touch" else "speed 0" if name == "speed" else name: value for name, value in one.value.items()}
    value = start(problem, **{"stop_ratio": begun.stop_ratio, "damping_ratio": FIRST_DAMPING_RATIO, **told})
    value.update(problem.fixed)
    try:  # a signal's median, by which impacts are found, may be far from its offset
        singles, means = problem.left(value, 0)
    except (ValueError, FloatingPointError, OverflowError):
        return value
    counts = problem.legs[0].samples.counts
    for name in problem.names:
        value[f"offset_{name}"] += float(np.average(np.concatenate([singles[name], means[name]]),
                                                    weights=np.concatenate([np.ones(len(singles[name])), counts]))) / problem.ranges[name]
    return value


def fit_alone(recording: Recording, guess: Guess, begun: Begin, mass: float) -> Fit:
    """The Fit of the hardest impact alone, if nothing else can be determined."""
    if begun.alone is None or guess.contact < SEEN:
        raise PeterkaFileError(f"{recording.path} is too coarse to see the contact, which lasts for about {guess.contact} samples, and "
                          "shows no flights that tell it otherwise")
    return telling(finished(recording, guess, with_channels([begun.alone])[0], [begun.impacts[guess.hardest]]))


def finished(recording: Recording, guess: Guess, found: Solved, impacts: Sequence[Impact], unused: Sequence[str] = ()) -> Fit:
    """Solves again with the residual noise level, and updates the errors accordingly."""
    problem = found.problem
    noise, more = levels(found, guess.resolution)
    problem = replace(problem, noise={**problem.noise, **noise}, extra_noise=more)
    best = solved(problem, found.value)
    likeness = likeness_of(best)
    return Fit(recording, guess, best, identified_from(best, likeness), max(more.values()), likeness, impacts, unused)


def telling(fit: Fit) -> Fit:
    """The Fit; raises PeterkaFileError if its errors leave the stop undetermined."""
    recording, found = fit.recording, fit.solved
    stiffness, ratio = fit.error("stiffness"), fit.error("stop_ratio")
    if stiffness <= UNKNOWN and ratio <= max(UNKNOWN * found.value["stop_ratio"], LEAST_RATIO):
        return fit
    raise PeterkaFileError(f"{recording.path} doesn't tell the stop: {_what_is_told(fit)}. Record force or acceleration, with less noise or at a "
                      "higher rate, beside a displacement, or measure restitution and contact time")


def _what_is_told(fit: Fit) -> str:
    """Of a stop whose errors are too large, in words."""
    found, stiffness, ratio = fit.solved, fit.error("stiffness"), fit.error("stop_ratio")
    words = [f"ki = {found.problem.rig(found.value).stiffness:.3g} N/m to {100 * stiffness:.2g} %"] * (stiffness < 1)
    least = least_stiffness(found) if stiffness > UNKNOWN and not found.problem.pushed else None
    words += [f"ki is above {least:.3g} N/m (95 %)"] if least else ["no ki is too small"] * (stiffness >= 1)
    told = f"ci/sqrt(m ki) = {2 * found.value['stop_ratio']:.3g} ± {2 * ratio:.2g}"
    if ratio <= max(UNKNOWN * found.value["stop_ratio"], LEAST_RATIO):
        told = f"its restitution tells {told} alone" + ", of any stiffness" * (least is None)
    seen = [f"{fit.guess.contact} samples lie in the hardest contact"] if fit.guess.sharp else []
    return "; ".join([", ".join(words), told, *seen])
