"""The lower bound of ki that a recording tells where it doesn't tell ki: a stop may be too stiff for its contact time to be seen.

ki is kept at smaller and smaller values while all else is fitted. The bound (95 %, one-sided) is where the sum of squares, in standard
deviations, has grown by 1.645^2 from its least: by Wilks (1938) noise does that in one of 20 cases, however the errors of ki are skewed.
"""

from dataclasses import replace

import numpy as np

from .solve import Solved, solved

GROWTH = 1.645**2  # of -2 ln likelihood, for 95 % on one side
FIRST_STEP, LAST_STEP = 0.25, 0.05  # of ln ki
MOST_STEPS = 12  # until it has grown, each twice the one before
ROUNDS = 3  # the samples in contact hardly change from one ki to the next


def least_stiffness(found: Solved, likeness: float) -> float | None:
    """ki [N/m] below which 5 % of such recordings have theirs, for residuals of this correlation of neighbours; None if no ki is too small."""
    most = GROWTH * (1 + likeness) / (1 - likeness)
    start, step = found.value["stiffness"], FIRST_STEP
    one, least, cost = found, _unlikely(found), 0.0
    allowed = start
    for _ in range(MOST_STEPS):
        tried = _kept(one, allowed - step)
        if tried is None:
            return None
        cost = _unlikely(tried)
        if cost > least + most:
            break
        one, least, allowed, step = tried, min(least, cost), allowed - step, 2 * step
    else:
        return None
    forbidden = allowed - step
    while allowed - forbidden > LAST_STEP:
        middle = 0.5 * (allowed + forbidden)
        tried = _kept(one, middle)
        if tried is not None and _unlikely(tried) <= least + most:
            one, allowed = tried, middle
        else:
            forbidden = middle
    return float(found.problem.scale["stiffness"] * np.exp(forbidden))


def _kept(found: Solved, stiffness: float) -> Solved | None:
    """The Solved of all but ki, which is kept; None where it doesn't converge."""
    problem = found.problem
    kept = replace(problem, free=[name for name in problem.free if name != "stiffness"], fixed={**problem.fixed, "stiffness": stiffness})
    try:
        return solved(kept, {**found.value, "stiffness": stiffness}, rounds=ROUNDS)
    except (ValueError, np.linalg.LinAlgError):
        return None


def _unlikely(found: Solved) -> float:
    """-2 ln of the likelihood but for a constant, so that one sample more or less changes it by nothing on average."""
    return found.cost - found.rows
