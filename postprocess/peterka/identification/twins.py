"""Tells apart rigs that meet the same impacts.

Three impacts tell six numbers, times and speeds, and springs, gap, restitution and the first touch are as many: two rigs of quite different
springs may meet them all. A fit has no weight for samples after an impact that wasn't detected, so that fits of different rigs leave
different samples out; here each is continued through such impacts, and then compared in the same samples by likelihood.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .adequacy import likeness_of
from .flights_alone import FEW_IN_CONTACT, contact_samples
from .numbers_found import FREQUENCY, GAP, Identified, identified_from
from .solve import Solved, levels, solved

RULED_OUT = 1e-3  # likelihood over that of the best rig, below which another isn't one that the recording may be of
OUTSIDE = 3.3  # standard errors: a rig beyond is another one; noise does that in one of 1000 cases
HOPELESS = 1.5  # times the sum of squares per residual of the best: such a fit is of no other rig, but of none
MOST_UNSEEN = 6  # impacts that weren't detected
ADVICE = ("Record displacement beside it, more impacts, from a larger start, or with less noise, or give what is known of --natural-frequency-hz, "
          "--gap-mm and --damping-ratio")


@dataclass(frozen=True)
class _Rival:
    """A fit, and the same `continued` through impacts that weren't detected; the continued one twice where these lead to another rig."""

    fit: Solved
    continued: Solved

    @property
    def until(self) -> float:
        """The time [s] up to which the continued fit is valid."""
        problem = self.continued.problem
        return problem.known_until(problem.motion(self.continued.value, 0), 0)


def likeliest(found: Sequence[Solved]) -> tuple[Solved, str | None]:
    """(The likeliest of fits of the same recording as one leg, both rigs in words if that of another is nearly as likely)."""
    different = _different(sorted(found, key=lambda one: one.per_row))
    if len(different) == 1:
        return different[0], None
    rivals = [_rival(one) for one in different]
    least = min(one.continued.per_row for one in rivals)
    rivals = [one for one in rivals if one.continued.per_row <= HOPELESS * least]
    until = min(one.until for one in rivals)
    best = min(rivals, key=lambda one: one.continued.per_row)
    noise, more = levels(best.continued)
    costs = [_unlikely(one.continued, until, noise, more) for one in rivals]
    best = rivals[int(np.argmin(costs))]
    alike = likeness_of(best.fit)
    numbers = identified_from(best.fit, alike)
    for one, cost in zip(rivals, costs):
        likelihood = float(np.exp(-0.5 * (cost - min(costs)) * (1 - alike) / (1 + alike)))
        other = identified_from(one.fit, alike)
        if one is not best and likelihood > RULED_OUT and _apart(numbers, other):
            return best.fit, (f"{_words(numbers)}, and {_words(other)}, whose likelihood is {likelihood:.2g} of the first one's and would have "
                              f"to be below {RULED_OUT:g}. {ADVICE}")
    return best.fit, None


def _rival(fit: Solved) -> _Rival:
    continued = _continued(fit)
    if contact_samples(fit) < FEW_IN_CONTACT and continued.per_row > HOPELESS * fit.per_row:
        return _Rival(fit, fit)  # where few samples tell the restitution, the next impact may be off by a contact, and this says nothing
    before, after = (identified_from(one, likeness_of(one)) for one in (fit, continued))
    return _Rival(continued if _apart(before, after) else fit, continued)


def _different(found: Iterable[Solved]) -> list[Solved]:
    """Those of distinct rigs, of each the first."""
    kept: list[Solved] = []
    for one in found:
        numbers = identified_from(one, likeness_of(one))
        if all(_apart(identified_from(other, likeness_of(other)), numbers) for other in kept):
            kept.append(one)
    return kept


def _apart(one: Identified, other: Identified) -> bool:
    """Whether a number of the other lies outside the errors of the first."""
    errors = np.sqrt(np.maximum(np.diag(one.covariance), 0))
    return bool(np.any(np.abs(np.subtract(list(other.values.values()), list(one.values.values()))) > OUTSIDE * errors))


def _continued(one: Solved) -> Solved:
    """The Solved with one more impact at a time, until its motion has all that happen in the recording; the last one that was found."""
    leg = one.problem.legs[0]
    for more in range(1, MOST_UNSEEN + 1):
        if not np.isfinite(one.problem.known_until(one.problem.motion(one.value, 0), 0)):
            break
        try:
            one = solved(replace(one.problem, legs=[replace(leg, impacts=leg.impacts + more)]), one.value)
        except (ValueError, np.linalg.LinAlgError):
            break
    return one


def _unlikely(one: Solved, until: float, noise: Mapping[str, float], more: Mapping[str, float]) -> float:
    """-2 ln of the likelihood of the samples before a time [s], for noise {signal: standard deviation} and `more` {signal: factor of it
    in contact}, but for a constant."""
    samples, settled = one.problem.legs[0].samples, one.settled[0]
    singles, means = one.problem.left(one.value, 0, settled.places)
    total = 0.0
    for name in one.problem.names:
        level = np.where(settled.contact[name], more[name], 1.0)
        inside = settled.of(name) & (samples.time < until)
        among = settled.known_means & (samples.ends < until)
        # one for each sample: two fits leave out different ones near their touches
        total += float(np.sum((singles[name] / noise[name] / level)[inside]**2 + 2 * np.log(level[inside]) - 1))
        total += float(np.sum((means[name] * np.sqrt(samples.counts) / noise[name])[among]**2 - 1))
    return total


def _words(numbers: Identified) -> str:
    hertz, gap = numbers.number(FREQUENCY), numbers.number(GAP)
    assert hertz is not None and gap is not None
    return f"springs of {hertz.value:.4g} Hz with a gap of {1e3 * gap.value:.4g} mm"
