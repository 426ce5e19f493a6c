"""The stop from impacts of a driven hammer, moved by the cart or by hand.

Each impact has its own time, speed and push (the force of springs and cart, varying linearly during the impact); the stop is
common to all. The motion between impacts then does not matter and need not be given.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..errors import PeterkaFileError
from .adequacy import more_left_in_contact, refuse_contradicting
from .channels import calmed, with_channels
from .first_guess import Guess, look
from .fit import Fit, finished, telling
from .problem import SLOW, Problem
from .recording import Recording
from .solve import solved, start
from .starts import SEEN, Begin, Impact, alone_problem, begin, impact_legs

WEAKEST = 0.1  # of the hardest impact: weaker impacts carry little information
MOST = 20  # impacts that are fitted, evenly selected
PUSHES = 2.0  # standard deviation of a push over the mean push between impacts
LARGE = 2.0  # standard deviations: larger ones were in 1 of 56 fits of random springs and dashpots (the largest 2.4)
FAST = 1.5  # the same of ln omega, which takes up a flat top: 1.9 to 2.3 where forces saturated, below 0.1 in sound ones
CHANCE = 3e-3  # of residuals in contact that are that much larger than elsewhere
SPRINGS = {"omega": (0.0, 1.0), "damping_ratio": (0.02, 0.03)}  # mean and standard deviation; ln omega relative to the impacts' rate


def fit_driven(recording: Recording, mass: float, given: Mapping[str, float] | None = None) -> Fit:
    """The Fit of the impacts of a Recording, whatever drives the hammer between them; mass [kg]; `given`: "omega" [rad/s]
    and "damping_ratio" of the springs if known; otherwise the errors allow for springs as fast as the rate of impacts."""
    calm = calmed(recording)
    given, guess = dict(given or {}), look(recording, calm)
    if not guess.sharp:
        raise PeterkaFileError(f"{recording.path} has neither force nor acceleration, without which single impacts can't be told")
    if guess.contact < SEEN:
        raise PeterkaFileError(f"{recording.path} is too coarse to see the contact: the hardest impact has {guess.contact} samples, and {SEEN} "
                          f"are needed at least; record at {2e-3 * SEEN / guess.contact / recording.step:.3g} kHz or more")
    refuse_contradicting(calm, guess, mass)
    begun = begin(recording, guess, mass)
    used, unused, weak = [], [], 0
    for impact in begun.impacts:
        one, width = guess.pulses[impact.number], guess.pulses[impact.number].last - guess.pulses[impact.number].first
        at = f"the impact at {recording.begin + impact.touch:.6g} s isn't used: "
        after = guess.pulses[impact.number + 1].first if impact.number + 1 < len(guess.pulses) else recording.count + width
        before = guess.pulses[impact.number - 1].last if impact.number else -width
        if one.first < width or one.last + width > recording.count:
            unused.append(at + "the recording cuts it")
        elif after - one.last < 2 * width or one.first - before < 2 * width:
            unused.append(at + "the next one is too near")
        elif one.height < WEAKEST * guess.pulses[guess.hardest].height:
            weak += 1
        else:
            used.append(impact)
    if not used:
        raise PeterkaFileError(f"{recording.path} has no impact to tell the stop by: {'; '.join(unused[:3])}")
    chosen = [used[at] for at in np.unique(np.linspace(0, len(used) - 1, MOST).astype(int))]
    if weak:
        unused.append(f"{weak} impacts aren't used: their forces are below {100 * WEAKEST:.0f} % of the hardest one's")
    if len(chosen) < len(used):
        unused.append(f"{len(used) - len(chosen)} impacts aren't used: {MOST}, evenly out of all, are enough")
    problem = _problem(recording, guess, begun, chosen, mass, given)
    first = start(problem, stop_ratio=begun.stop_ratio, damping_ratio=problem.fixed.get("damping_ratio", SPRINGS["damping_ratio"][0]))
    best = with_channels([solved(problem, first)])[0]
    return _by_spring_and_dashpot(telling(finished(recording, guess, best, chosen, unused)))


def _by_spring_and_dashpot(fit: Fit) -> Fit:
    """The Fit, with a doubt where residuals in contact are larger than elsewhere, or of neighbouring samples alike, or where pushes are large or
    springs fast, since these take up whatever of the force a spring and a dashpot don't explain; raises PeterkaFileError where they are larger than springs and cart can be."""
    problem, value = fit.solved.problem, fit.solved.value
    sizes = np.array([(value[name] - mean) / deviation for name, (mean, deviation) in problem.prior.items() if name not in SPRINGS])
    largest = float(np.max(np.abs(sizes)))
    is_fast = "omega" in problem.prior and value["omega"] - problem.prior["omega"][0] > FAST * problem.prior["omega"][1]
    spread = problem.prior["mean_cos"][1]
    hardest = PUSHES * max(abs(value["mean_cos"] + value[f"push_cos {number}"]) for number in range(len(problem.legs))) / spread
    if np.mean(sizes**2) > 1:
        raise PeterkaFileError(f"{fit.recording.path} doesn't tell the stop: a spring and a dashpot explain its impacts only if springs and cart push, in "
                               f"impacts, up to {hardest:.2g} times as hard as between them. The stop is more than these two, or the sensor rings, "
                               "saturates or is filtered")
    if fit.likeness > 0 or largest > LARGE or more_left_in_contact(fit.solved) < CHANCE or is_fast:
        return replace(fit, doubts=["the forces in its impacts aren't those of a spring and a dashpot alone: the stop is more than these two, or the "
                                    "sensor rings, saturates or is filtered, and the numbers may be off by more than their errors"])
    return fit


def _problem(recording: Recording, guess: Guess, begun: Begin, chosen: Sequence[Impact], mass: float,
             given: Mapping[str, float]) -> Problem:
    """The Problem of the impacts with a prior for their pushes: reversing a hammer within a time T at (1 + e) times its
    speed takes (1 + e) v/T on average; during an impact the push is of about that size and changes as fast as a wave of half
    that period. All impacts share one push and have one of their own."""
    flight = float(np.median(np.diff([one.touch for one in begun.impacts]))) if len(begun.impacts) > 1 else recording.count * recording.step / 2
    push = PUSHES * (1 + begun.restitution) * begun.contact / (np.pi * flight)
    turn = 4 * np.pi / flight * begun.contact / SLOW
    problem = alone_problem(recording, guess, mass, begun.stiffness, begun.contact, impact_legs(recording, guess, chosen), push)
    prior = {name: (0.0, push * (turn if "_sin" in name else 1.0)) for name in ("mean_cos", "mean_sin", *problem.prior)}
    springs = {name: SPRINGS[name] for name in SPRINGS if name not in given}
    free = [*problem.free, "mean_cos", "mean_sin", *springs]
    fixed = {"gap": 0.0, "omega": 0.0, "damping_ratio": given.get("damping_ratio", 0.0)}
    return replace(problem, free=free, fixed={name: value for name, value in fixed.items() if name not in free},
                   scale={**problem.scale, "omega": given.get("omega", 2 * np.pi / flight)}, prior={**prior, **springs})
