"""The stop from the flights alone, without the samples in and beside contacts.

Of contacts of less than some three samples, a logger's filter shapes what is recorded, and of contacts of few samples it does so where
it is steep, and then rings beside them. The flights before and after tell touches and releases, and so the contact time, and with the
restitution ki and ci. Where the flights don't tell ki, they tell its least value: a stop may always be too stiff for its contact time to be seen.

For that ki is kept at smaller and smaller values while all else is fitted. The bound (95 %, one-sided) is the least ki at which the sum of
squares, in standard deviations, is above its least by no more than 1.645^2: noise makes that more in one of 20 cases (Wilks, 1938).
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.stats import f

from ..errors import PeterkaFileError
from .channels import told_by_flights
from .contact_pulse import pulse
from .problem import SHARP, Problem
from .solve import Solved, converged, levels

FEWEST_IN_CONTACT = 2.5  # steps: shorter contacts have two samples more often than three
FEW_IN_CONTACT = 8.0  # steps: of longer ones, a filter that rings changes the numbers by less than other things do
RINGS = 0.01  # significance level; where noise is taken for it, the flights tell the same numbers with larger errors
BESIDE = 4.0  # steps before a touch and after a release in which a filter rings
AT_TOUCH = 0.25  # steps: a sample closer to a touch may be before it or after
SEEN_IN_FLIGHT = {"displacement", "acceleration"}  # a force is 0 there
GROWTH = 1.645**2  # of -2 ln likelihood, for 95 % on one side
RUNG, LAST_RUNG = 0.5, 0.02  # of ln ki
MOST_RUNGS = 24
FAR = 25.0  # -2 ln likelihood above its least beyond which smaller ki aren't tried


def contact_samples(found: Solved) -> float:
    """The contact time of a rig's stop, in samples."""
    rig = found.problem.rig(found.value)
    return pulse(rig.mass, rig.stiffness, rig.damping)[1] / found.problem.step


def ringing(found: Solved) -> float:
    """The probability that noise is as large as what is left beside contacts, where an ideal sample of force or acceleration has seen nothing
    of them: a logger's filter rings there (F test against the noise elsewhere)."""
    settled, problem = found.settled[0], found.problem
    leg, moved = problem.legs[0], problem.motion(found.value, 0)
    time, step = leg.samples.time, problem.step
    singles, means = problem.left(found.value, 0, settled.places, moved)
    chance = 1.0
    for name in set(SHARP) & set(problem.names):
        near, late = np.zeros(len(time), dtype=bool), problem.delay(found.value, name)
        for begin, end in moved.contacts():
            near |= (time - late > begin - BESIDE * step) & (time - late < end + BESIDE * step)
        beside = near & ~settled.contact[name] & settled.known
        for touch in moved.touches + late:
            beside &= np.abs(time - touch) > AT_TOUCH * step
        far = np.concatenate([singles[name][~near & settled.known], (means[name] * np.sqrt(leg.samples.counts))[settled.known_means]])
        if len(far) and beside.any():
            ratio = np.mean(singles[name][beside]**2) / max(float(np.mean(far**2)), 1e-300)
            chance = min(chance, float(f.sf(ratio, int(beside.sum()), len(far))))
    return chance


def trusted(path: Path, found: Sequence[Solved]) -> list[Solved]:
    """The same fits of a recording as one leg, the best first, of the flights alone where the samples in contacts can't be trusted. Raises
    PeterkaFileError where no flights are seen."""
    samples = contact_samples(found[0])
    if samples >= FEW_IN_CONTACT:
        return list(found)
    if samples < FEWEST_IN_CONTACT:
        why = f"is too coarse to see the contact, which lasts for about {samples:.2g} samples"
    elif ringing(found[0]) < RINGS:
        why = (f"rings beside its contacts, which last for about {samples:.2g} samples, as a logger's filter does, or noise hides on which side of "
               "a sample a touch lies")
    else:
        return list(found)
    if not SEEN_IN_FLIGHT & set(found[0].problem.names):
        raise PeterkaFileError(f"{path} {why}, and it has neither displacement nor acceleration, whose flights would tell it; record at "
                               f"{1e-3 * FEW_IN_CONTACT / samples / found[0].problem.step:.2g} kHz or more")
    unseen = _unseen(found[0])
    without = [one for other in found if (one := converged(replace(other.problem, unseen=unseen, channels=told_by_flights(other.problem)), other.value))]
    if not without:
        raise PeterkaFileError(f"{path} {why}, and its flights don't tell it")
    return without


def least_stiffness(found: Solved) -> float | None:
    """The lower bound of ki [N/m] that the flights tell; None if they tell none."""
    if not SEEN_IN_FLIGHT & set(found.problem.names):
        return None
    problem = found.problem if found.problem.unseen else replace(found.problem, unseen=_unseen(found), channels=told_by_flights(found.problem))
    best = converged(problem, found.value)
    if best is None:
        return None
    best = converged(replace(problem, noise={**problem.noise, **levels(best)[0]}), best.value) or best
    rungs = [(best.value["stiffness"], best)]
    while len(rungs) <= MOST_RUNGS and rungs[-1][1].cost <= min(one.cost for _, one in rungs) + FAR:
        lower = rungs[-1][0] - RUNG
        one = _kept(rungs[-1][1], lower)
        if one is None:
            break
        rungs.append((lower, one))
    most = min(one.cost for _, one in rungs) + GROWTH
    last = max(at for at, (_, one) in enumerate(rungs) if one.cost <= most)
    if last + 1 == len(rungs):
        return None  # it never grew
    return float(problem.scale["stiffness"] * np.exp(_crossing(*rungs[last], rungs[last + 1][0], most)))


def _crossing(allowed: float, one: Solved, forbidden: float, most: float) -> float:
    """Where the sum of squares exceeds `most`, between an ln ki at which it doesn't, with its Solved, and one at which it does."""
    while allowed - forbidden > LAST_RUNG:
        middle = 0.5 * (allowed + forbidden)
        tried = _kept(one, middle)
        if tried is not None and tried.cost <= most:
            one, allowed = tried, middle
        else:
            forbidden = middle
    return forbidden


def _unseen(found: Solved) -> list[tuple[float, float]]:
    """(begin, end) [s] of what is left out at each impact: the same for any ki, so that sums of squares can be compared."""
    step = found.problem.step
    touches = found.problem.motion(found.value, 0).touches
    return [(float(touch) - BESIDE * step, float(touch) + (max(FEWEST_IN_CONTACT, contact_samples(found)) + BESIDE) * step) for touch in touches]


def _kept(found: Solved, stiffness: float) -> Solved | None:
    """The Solved of all but ki, whose logarithm over its scale is kept; None where it doesn't converge."""
    problem = found.problem
    free = [name for name in problem.free if name != "stiffness"]
    return converged(replace(problem, free=free, fixed={**problem.fixed, "stiffness": stiffness}), {**found.value, "stiffness": stiffness})
