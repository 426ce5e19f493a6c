"""Fits gap, stop and damping to measured peak forces over the excitation frequency, by least squares over computed branches.

Each point belongs to the nearest branch; the motion that it is on is chosen anew in each round, and within a round the force is that of
this motion, of the end of its branch where a trial rig's branch doesn't reach the point, and what it was where a trial rig has no such
motion. Far rounds have a robust loss over ln F, near ones are of the points that a branch explains, with weights from the standard errors
or, without these, from the force of the round before.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import norm, t

from ..arrays import Integers, Mask, Reals
from ..errors import PeterkaFileError
from .branches import Landscape, Strand, compute
from .numbers_found import DAMPING_RATIO, GAP
from .sweep_points import MeasuredForces
from .sweep_rig import Bounds, SweptRig

POINTS = 241  # of a computed branch
FAR_ROUNDS, FAR_EVALUATIONS, NEAR_ROUNDS, EVALUATIONS = 12, 6, 6, 15
ROUGH, FINE = 0.1, 5e-3  # relative scatter with which far rounds begin, and least that is believed of robust ones
REACH, FAR_OFF = 0.04, 3.0  # of the frequency: how far off its end a branch may be; how much that counts, as a change of ln F
OUTLYING = 5.0  # times the scatter: such a point is on no branch
FAR_CLOSE, CLOSE = 1e-3, 1e-5  # change of the parameters at which rounds end
WITHIN = 1.4826  # standard deviation over median absolute deviation
SPARE = 2  # more points than parameters, at least


@dataclass(frozen=True)
class Place:
    """What is computed at a point: its `strand`, ln F there, d ln F/dx (parameters,), and how far outside the strand it lies [Hz]."""

    strand: Strand
    log_force: float
    slopes: Reals
    beyond: float


class Model:
    """Peak forces of the points of a file for parameters x: logarithms, but for the gap, in A0, and the springs' damping
    ratio, over that of the start, which forces may hardly tell from 0."""

    def __init__(self, rig: SweptRig, points: MeasuredForces, bounds: dict[str, Bounds]) -> None:
        self.rig, self.points, self.bounds, self.keys = rig, points, bounds, list(bounds)
        gaps = np.array(points.gaps())
        self.linear = {GAP: rig.amplitude, DAMPING_RATIO: rig.value(DAMPING_RATIO) or 1.0}
        self.offsets = gaps - gaps[0] if len(gaps) else np.zeros(1)
        self.which = np.zeros(len(points.hertz), dtype=int)
        for number, gap in enumerate(points.gaps()):
            self.which[points.at_gap(gap)] = number
        self.runs = 0
        self._known: dict[bytes, list[Landscape]] = {}

    def x_of(self, which: Callable[[Bounds], float]) -> Reals:
        """Parameters of a side of the bounds."""
        return np.array([which(one) / self.linear[key] if key in self.linear else np.log(which(one)) for key, one in self.bounds.items()])

    def values(self, x: Reals) -> dict[str, float]:
        """{key: SI value} of parameters."""
        return {key: float(one * self.linear[key] if key in self.linear else np.exp(one)) for key, one in zip(self.keys, x)}

    def scales(self, x: Reals) -> Reals:
        """d value/dx of each parameter."""
        return np.array([self.linear.get(key, value) for key, value in self.values(x).items()])

    def landscapes(self, x: Reals) -> list[Landscape]:
        """What the program computes for parameters, a Landscape for each gap."""
        name = np.asarray(x, dtype=float).tobytes()
        if name not in self._known:
            rig = self.rig.with_values(self.values(x))
            self.runs += 1
            self._known[name] = compute(rig, list(self.offsets + (rig.gap or 0.0)), (self.points.hertz.min(), self.points.hertz.max()),
                                        POINTS, self.keys)
            while len(self._known) > 40:
                del self._known[next(iter(self._known))]
        return self._known[name]

    def place(self, x: Reals, number: int, label: str | None, shift: float = 0.0) -> Place | None:
        """The nearest computed motion of a point, on no narrow branch, of this label, else of any; None where none is within reach.
        `shift` of ln F."""
        hertz, wanted = float(self.points.hertz[number]), float(np.log(self.points.force[number])) - shift
        best, least = None, np.inf
        for strand in self.landscapes(x)[self.which[number]].strands:
            if strand.is_narrow:
                continue
            beyond = strand.beyond(hertz)
            if label not in (None, strand.label) or beyond > REACH * hertz:
                continue
            off = abs(strand.at(hertz) - wanted) + FAR_OFF * beyond / hertz * (1 if label is None else 100)
            if off < least:
                best, least = strand, off
        if best is None:
            return None
        return Place(best, best.at(hertz), best.slopes_at(hertz, self.keys) * self.scales(x), best.beyond(hertz))


@dataclass(frozen=True)
class SweepFit:
    """A fit: parameters `x` with `covariance`; `places` of all points there; `used` mask; `left` residuals (points,) over `weight` [N],
    NaN without a place; `scatter`: their standard deviation."""

    model: Model
    x: Reals
    covariance: Reals
    places: Sequence[Place | None]
    used: Mask
    left: Reals
    weight: Reals
    scatter: float
    settled: bool

    @property
    def freedom(self) -> int:
        """Points less parameters."""
        return int(self.used.sum()) - len(self.x)


def _never(x: Reals) -> bool:
    return False


def far(model: Model, x: Reals, enough: Callable[[Reals], bool] = _never) -> Reals:
    """Parameters of a robust fit over ln F from these; rounds end where `enough` is true of them."""
    lowest, highest = model.x_of(lambda one: one.lowest), model.x_of(lambda one: one.highest)
    scatter, before = ROUGH, None
    for _ in range(FAR_ROUNDS):
        labels = _labels(model, x)
        kept = [number for number, label in enumerate(labels) if label is not None]
        if len(kept) < len(x) + SPARE:
            raise PeterkaFileError(f"{model.points.path} has {len(kept)} points with a computed force nearby, and {len(x)} numbers are "
                                   f"fitted to them; {len(x) + SPARE} are needed{_others(model, x)}")

        def rows(x: Reals, kept: list[int] = kept, labels: list[str | None] = labels, begun: Reals = np.zeros(len(kept))
                 ) -> tuple[Reals, Reals]:
            found = [model.place(x, number, labels[number]) for number in kept]
            left = [np.log(model.points.force[number]) - one.log_force if one else same for number, one, same in zip(kept, found, begun)]
            return np.array(left), np.array([-one.slopes if one else np.zeros(len(x)) for one in found])

        begun = rows(x)[0]  # of a point whose motion doesn't exist on a trial rig: neither for nor against it
        answer = least_squares(lambda x: rows(x, begun=begun)[0], x, lambda x: rows(x)[1], bounds=(lowest, highest), loss="soft_l1",
                               f_scale=scatter, x_scale="jac", max_nfev=FAR_EVALUATIONS, xtol=FAR_CLOSE, ftol=FAR_CLOSE)
        left = np.abs(rows(answer.x)[0])
        scatter = float(np.clip(2 * WITHIN * np.median(left), FINE, scatter))
        moved, x = float(np.max(np.abs(answer.x - x))), answer.x
        if enough(x) or (before == labels and moved < 10 * FAR_CLOSE):
            break
        before = labels
    return x


def near(model: Model, x: Reals) -> SweepFit:
    """The SweepFit from parameters near the best ones. Raises PeterkaFileError where too few points are on a branch."""
    lowest, highest = model.x_of(lambda one: one.lowest), model.x_of(lambda one: one.highest)
    measured, off, settled = model.points.force, np.zeros(len(model.points.force), dtype=bool), False
    for turn in range(NEAR_ROUNDS):
        places, left, weight, used = _explained(model, x)
        off |= ~used if turn else False
        used &= ~off
        if used.sum() < len(x) + SPARE:
            raise PeterkaFileError(f"{model.points.path} has {int(used.sum())} points on computed branches, and {len(x)} numbers are "
                                   f"fitted to them; {len(x) + SPARE} are needed{_others(model, x)}")
        kept = np.flatnonzero(used)
        labels = [one.strand.label if one else None for one in places]
        begun = np.array([np.exp(one.log_force) if one else 0.0 for one in places])

        def rows(x: Reals, kept: Integers = kept, labels: list[str | None] = labels, weight: Reals = weight, begun: Reals = begun
                 ) -> tuple[Reals, Reals]:
            found = [model.place(x, number, labels[number]) for number in kept]
            force = np.array([np.exp(one.log_force) if one else same for one, same in zip(found, begun[kept])])
            slopes = np.array([one.slopes if one else np.zeros(len(x)) for one in found])
            return (measured[kept] - force) / weight[kept], -(force / weight[kept])[:, None] * slopes

        answer = least_squares(lambda x: rows(x)[0], x, lambda x: rows(x)[1], bounds=(lowest, highest), x_scale="jac",
                               max_nfev=EVALUATIONS, xtol=CLOSE, ftol=1e-9)
        moved, x = float(np.max(np.abs(answer.x - x))), answer.x
        settled = moved < 10 * CLOSE
        if settled and turn:
            break
    slopes = rows(x)[1]
    places, left, weight_now, _ = _explained(model, x)
    scatter = float(np.sqrt(np.sum(left[used]**2) / max(used.sum() - len(x), 1)))
    size = np.maximum(np.sqrt(np.sum(slopes**2, axis=0)), 1e-30)
    covariance = np.linalg.pinv((slopes / size).T @ (slopes / size), rcond=1e-14, hermitian=True) / np.outer(size, size)
    covariance *= 1.0 if model.points.has_errors else (scatter * widened(int(used.sum()) - len(x)))**2
    return SweepFit(model, x, covariance, places, used, left, weight_now, scatter, settled)


def widened(freedom: int) -> float:
    """The width of Student's t, by its 68 % interval, over that of the normal distribution: of errors that few points tell."""
    return float(t.ppf(norm.cdf(1), max(freedom, 1)))


def _explained(model: Model, x: Reals) -> tuple[list[Place | None], Reals, Reals, Mask]:
    """(places, residuals over their weight, weights [N], mask of the points that a branch explains)."""
    places = [model.place(x, number, label) if label else None for number, label in enumerate(_labels(model, x, 0))]
    force = np.array([np.exp(one.log_force) if one else np.nan for one in places])
    weight = model.points.error if model.points.has_errors else force
    left = (model.points.force - force) / weight
    inside = np.array([one is not None and one.beyond == 0 for one in places])
    scatter = WITHIN * np.median(np.abs(left[inside])) * np.sqrt(inside.sum() / max(inside.sum() - len(x), 1)) if inside.any() else 0.0
    least = 1.0 if model.points.has_errors else 1e-4
    with np.errstate(invalid="ignore"):
        return places, left, weight, inside & (np.abs(left) <= OUTLYING * max(scatter, least))


def _labels(model: Model, x: Reals, turns: int = 3) -> list[str | None]:
    """The motion that each point is on, None without one. All forces may be off by one factor: a stiffness that isn't found yet."""
    shift = 0.0
    count = range(len(model.points.hertz))
    places = [model.place(x, number, None) for number in count]
    for _ in range(turns):
        off = [np.log(model.points.force[number]) - one.log_force for number, one in enumerate(places) if one]
        shift = float(np.median(off)) if off else 0.0
        places = [model.place(x, number, None, shift) for number in count]
    return [one.strand.label if one else None for one in places]


def _others(model: Model, x: Reals) -> str:
    """What is computed at the points without a force, in words."""
    found = [model.landscapes(x)[model.which[number]].other_at(float(hertz)) for number, hertz in enumerate(model.points.hertz)
             if model.place(x, number, None) is None]
    words = {"no impact": "the hammer swings without an impact", "chaos": "its motion is chaos"}
    told = [f"at {found.count(one)} of them {text}" for one, text in words.items() if one in found]
    return f": {', '.join(told)}" if told else ""


def with_covariance(fit: SweepFit, factor: float) -> SweepFit:
    """The same with a covariance that is larger by this factor."""
    return replace(fit, covariance=fit.covariance * factor)
