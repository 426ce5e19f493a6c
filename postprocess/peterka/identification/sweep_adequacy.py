"""Whether branches explain measured points: residuals against standard errors or the scatter of neighbours, other rigs that explain them
as well, and numbers that they hardly tell."""

from collections.abc import Iterator

import numpy as np
from scipy.stats import chi2, f, norm, t

from ..arrays import Mask, Reals
from ..errors import PeterkaFileError
from .numbers_found import DAMPING, GAP, STIFFNESS, Identified, Number
from .sweep_fit import OUTLYING, Model, SweepFit, far, near, widened, with_covariance
from .twins import OUTSIDE, RULED_OUT
from .words import number_text

CHANCE, ONE_SIDED = 1e-3, 0.95  # significance of a misfit; probability of a bound
RARE = 0.01  # the same of a scatter that is larger than that from neighbour to neighbour
ALIKE, MOST_ALIKE = 3.1, 0.9  # standard deviations of a correlation of neighbours; largest that errors allow for
FEWEST = 8  # pairs of neighbours
ILL = 1e4  # condition number of the normalised derivatives
WEAK = 0.5  # relative standard error
OTHER_DAMPING, OTHER_GAP = 2.5, 0.4  # factor, and part of the way to a bound: from where other rigs are looked for
SHORT_NAMES = {STIFFNESS: "ki", DAMPING: "ci", GAP: "gap"}


def fitted(model: Model) -> SweepFit:
    """The likeliest SweepFit. Raises PeterkaFileError where quite another rig explains the points about as well."""
    first = far(model, model.x_of(lambda one: one.start))
    found = [near(model, first)]
    for other in _elsewhere(model):
        try:
            x = far(model, other, lambda x: not all(_apart(fit, x) for fit in found))
            if all(_apart(fit, x) for fit in found):
                found.append(near(model, x))
        except PeterkaFileError:
            continue  # no branches there
    most = max(int(fit.used.sum()) for fit in found)  # few points may lie near a branch by chance
    scatter = 1.0 if model.points.has_errors else min(fit.scatter for fit in found if 2 * int(fit.used.sum()) >= most)
    costs = [_cost(fit, scatter) for fit in found]
    best = found[int(np.argmin(costs))]
    for fit, cost in zip(found, costs):
        likelihood = float(np.exp(-0.5 * (cost - min(costs))))
        if fit is not best and likelihood > RULED_OUT and _apart(best, fit.x):
            both = f"{_rig_words(best)}, and {_rig_words(fit)}"
            raise PeterkaFileError(f"{model.points.path} doesn't tell two rigs apart: {both}, whose likelihood is {likelihood:.2g} of the "
                                   f"first one's and would have to be below {RULED_OUT:g}. Measure more frequencies, another gap, "
                                   "or restitution and contact time; --bounds leave one of them out")
    return best


def _elsewhere(model: Model) -> Iterator[Reals]:
    """Parameters from where another rig may be found."""
    start, lowest, highest = (model.x_of(side) for side in (lambda one: one.start, lambda one: one.lowest, lambda one: one.highest))
    for sign in (1, -1):
        x = start.copy()
        if DAMPING in model.keys:
            x[model.keys.index(DAMPING)] += sign * np.log(OTHER_DAMPING)
        if GAP in model.keys:
            at = model.keys.index(GAP)
            x[at] += OTHER_GAP * ((highest if sign > 0 else lowest)[at] - x[at])
        x = np.clip(x, lowest, highest)
        if np.any(x != start):
            yield x


def _apart(fit: SweepFit, x: Reals) -> bool:
    size = np.sqrt(np.maximum(np.diag(fit.covariance), 1e-12))
    return bool(np.any(np.abs(x - fit.x) > OUTSIDE * np.maximum(size, 0.01)))


def _cost(fit: SweepFit, scatter: float) -> float:
    """-2 ln of the likelihood of all points, but for a constant; one that no branch explains counts as far off as an outlier, but where the rig
    has chaos or a narrow branch there: as one of forces that are as likely within a factor of two. Else a rig without chaos would always win."""
    points = fit.model.points
    relative = points.error / points.force if points.has_errors else scatter
    off = np.minimum(np.nan_to_num(fit.left / scatter, nan=OUTLYING)**2, OUTLYING**2)
    of_any = np.clip(2 * np.log(np.log(2) / (np.sqrt(2 * np.pi) * relative)), 1, OUTLYING**2)
    return float(np.sum(np.where(_unforeseen(fit) & ~fit.used, np.minimum(off, of_any), off)))


def _unforeseen(fit: SweepFit) -> Mask:
    """Where the rig has chaos or a narrow branch at a point's frequency, (points,)."""
    model, found = fit.model, []
    landscapes = model.landscapes(fit.x)
    for hertz, which in zip(model.points.hertz, model.which):
        there = landscapes[which]
        found.append(there.other_at(float(hertz)) == "chaos" or any(one.is_narrow and one.beyond(float(hertz)) == 0 for one in there.strands))
    return np.array(found)


def _rig_words(fit: SweepFit) -> str:
    values = fit.model.values(fit.x)
    told = [f"{SHORT_NAMES.get(key, key.split('.')[1])} {1e3 * value:.4g} mm" if key == GAP else
            f"{SHORT_NAMES.get(key, key.split('.')[1])} {value:.4g}" for key, value in values.items()]
    return "one with " + ", ".join(told)


def judged(fit: SweepFit) -> tuple[SweepFit, list[str]]:
    """(the fit with errors that allow for what it leaves, sentences on that)."""
    told, factor = [], 1.0
    if fit.model.points.has_errors:
        square = float(np.sum(fit.left[fit.used]**2))
        if fit.freedom > 0 and chi2.sf(square, fit.freedom) < CHANCE:
            factor = square / fit.freedom
            told.append(f"the points differ from the best fit by more than their standard errors: chi-square {square:.4g} where "
                        f"{fit.freedom} is expected; errors are {np.sqrt(factor):.2g} times those that the points' own would give")
    alike, pairs = likeness(fit)
    if pairs >= FEWEST and alike * np.sqrt(pairs) > ALIKE:
        told.append(f"the points differ from the best fit by {1 / np.sqrt(max(1 - alike, 0.01)):.2g} times their scatter from neighbour to "
                    f"neighbour: the model doesn't explain them, and its numbers are off by more than noise; errors allow for the "
                    "correlation of neighbours alone")
        most = min(alike, MOST_ALIKE)
        factor *= (1 + most) / (1 - most)
    elif (more := _over_scatter(fit)) > 1:
        told.append(f"the points differ from the best fit by {more:.2g} times their scatter from neighbour to neighbour: the model doesn't explain them, "
                    "and its numbers may be those of quite another rig")
        factor *= more**2
    if not fit.settled:
        told.append("the fit didn't settle: which points are on which branch still changes; a start that is nearer may help")
    return with_covariance(fit, factor), told


def _over_scatter(fit: SweepFit) -> float:
    """Scatter about the fit over that of each measured force about the line through its neighbours, where noise makes such a ratio in less than RARE
    of all cases (F test); else 1. Rounding of forces counts as noise. Curved branches, jumps and chaos make the second one larger, never smaller."""
    points, which = fit.model.points, fit.model.which
    off: list[float] = []
    for gap in np.unique(which):
        mine = np.flatnonzero(which == gap)
        mine = mine[np.argsort(points.hertz[mine])]
        hertz, force = points.hertz[mine], np.log(points.force[mine])
        inner = (hertz[2:] > hertz[1:-1]) & (hertz[1:-1] > hertz[:-2])
        share = ((hertz[1:-1] - hertz[:-2]) / np.maximum(hertz[2:] - hertz[:-2], 1e-300))[inner]
        lines = (force[1:-1] - force[:-2])[inner] - share * (force[2:] - force[:-2])[inner]
        off += list(np.abs(lines) / np.sqrt(1 + share**2 + (1 - share)**2))
    if points.has_errors or len(off) < FEWEST:
        return 1.0
    steps = np.diff(np.unique(points.force))
    rounded = float(np.min(steps)) / np.sqrt(12) / float(np.median(points.force)) if len(steps) else np.inf
    ratio = fit.scatter / max(float(np.median(off)) / float(norm.ppf(0.75)), rounded, 1e-12)
    told_by = len(off) / 3  # degrees of freedom: a median tells as much as 0.37 of as many squares
    return float(ratio) if f.sf(ratio**2, max(fit.freedom, 1), told_by) < RARE else 1.0


def likeness(fit: SweepFit) -> tuple[float, int]:
    """(correlation of the residuals of neighbours on one branch, 1 - half the ratio of von Neumann (1941), their pairs)."""
    hertz, which = fit.model.points.hertz, fit.model.which
    numbers = [int(number) for number in np.flatnonzero(fit.used)]
    labels = {number: place.strand.label for number in numbers if (place := fit.places[number]) is not None}
    numbers.sort(key=lambda number: (which[number], labels[number], hertz[number]))
    steps = [fit.left[after] - fit.left[before] for before, after in zip(numbers, numbers[1:])
             if which[before] == which[after] and labels[before] == labels[after]]
    square = float(np.mean(fit.left[numbers]**2))
    return (1 - float(np.mean(np.square(steps))) / (2 * square) if steps and square > 0 else 0.0), len(steps)


def hardly_told(fit: SweepFit, found: Identified, doubted: bool) -> list[str]:
    """Sentences on numbers that the points don't tell, with a bound where the fit isn't doubted, and on those that ended at a bound."""
    told = []
    errors = np.sqrt(np.maximum(np.diag(fit.covariance), 0))
    for at, (key, bounds) in enumerate(fit.model.bounds.items()):
        value = found.values[key]
        number = found.number(key)
        assert number is not None and number.error is not None
        name, factor, unit = SHORT_NAMES.get(key, key.split(".")[1]), *((1e3, " mm") if key == GAP else (1.0, ""))
        if key != GAP and number.error > WEAK * value or key == GAP and number.error > WEAK * fit.model.rig.amplitude:
            alone = _without(fit, at)
            others = ", ".join(f"{SHORT_NAMES[other]} to {100 * one:.2g} % instead of {100 * error:.2g} %"
                               for other, one, error in zip(fit.model.keys, alone, errors)
                               if other in (STIFFNESS, DAMPING) and other != key)
            below = f": below {number_text(Number(factor * (value + _one_sided(fit) * number.error)))}{unit} (95 %)" * (not doubted)
            told.append(f"{name} is hardly told{below}. "
                        f"Were it known, the points would tell {others or 'the others better'}")
        elif any(abs(value - edge) <= 1e-3 * (bounds.highest - bounds.lowest) for edge in (bounds.lowest, bounds.highest)):
            told.append(f"{name} ended at a bound, {factor * value:.4g}{unit}: errors of the others hold for it there; wider --bounds may "
                        "fit better")
    condition = _condition(fit.covariance)
    if condition > ILL:
        told.append(f"the points tell combinations of the numbers and hardly each of them (condition number {condition:.2g})")
    return told


def _one_sided(fit: SweepFit) -> float:
    """The bound, in told standard errors, below which 95 % lie: of Student's t where these are estimated from the points."""
    return float(norm.ppf(ONE_SIDED) if fit.model.points.has_errors else t.ppf(ONE_SIDED, max(fit.freedom, 1)) / widened(fit.freedom))


def _without(fit: SweepFit, at: int) -> Reals:
    """Standard errors of the parameters where one is known."""
    matrix = fit.covariance
    left = np.diag(matrix) - matrix[at]**2 / max(matrix[at, at], 1e-300)
    errors: Reals = np.sqrt(np.maximum(left, 0))
    return errors


def _condition(covariance: Reals) -> float:
    size = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    return float(np.linalg.cond(covariance / np.outer(size, size)))


def identified_from_sweep(fit: SweepFit) -> Identified:
    """The numbers of a fit with their covariance in SI, and those that were given."""
    model, scales = fit.model, fit.model.scales(fit.x)
    values = model.values(fit.x)
    given = {key: value for key in ("contact.stiffness_n_per_m", "contact.damping_ns_per_m", "hammer.natural_frequency_hz",
                                    "hammer.damping_ratio", GAP) if key not in values and (value := model.rig.value(key)) is not None}
    return Identified(model.rig.mass, values, fit.covariance * np.outer(scales, scales), given)
