"""Candidates for comparison with a measured force: every motion known at its point, from the surrounding computed places.

A motion common to all of these places is interpolated linearly in each coordinate; one known only at some is taken from the
nearest of them, and its distance is reported.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from ..arrays import Reals
from .points import Point

ONE_BRANCH = 0.2  # neighbouring forces that differ by a larger share of the larger one may be on different branches
ROUNDING = 1e-9  # of a step: a point closer than this lies at a computed place


@dataclass(frozen=True)
class Known:
    """A motion at a computed place. `words` name it, `force` [F/(m g)] is 0 without impacts, `share` is that of the starts
    ending in it, None if the file does not give it; `directions` are those of the branches that follow it. Places share the
    motion if its `key` is equal and, unless it certainly `goes_on`, the forces are similar."""

    key: str | tuple[int, int | None]
    words: str
    force: float
    share: float | None = None
    goes_on: bool = False
    directions: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """`words` and, of a branch, its directions."""
        return f"{self.words} {' and '.join(self.directions)}".rstrip()


@dataclass(frozen=True)
class Place:
    """A computed place beside a point: its `weight` in an interpolation (those of a point sum to 1), its distance `away`
    (frequency, gap), in the file's numbers, and the motions `known` there."""

    weight: float
    away: tuple[float, float]
    known: Sequence[Known]


@dataclass(frozen=True)
class Match:
    """`motion` beside a point with a force; `force` is its force at the point
    itself or, if `away` (frequency, gap) is not None, at that distance."""

    point: Point
    motion: Known
    force: float
    away: tuple[float, float] | None

    @property
    def residual(self) -> float:
        """Measured minus computed, F/(m g)."""
        assert self.point.force is not None
        return self.point.force - self.force


def matches(point: Point, places: Sequence[Place], beyond: tuple[float, float] = (0.0, 0.0)) -> list[Match]:
    """The [Match] of a point with a force, the nearest force first.
    `beyond` (frequency, gap): distance of the point outside all places."""
    places = sorted((place for place in places if place.weight > ROUNDING), key=lambda place: -place.weight)
    left = [list(place.known) for place in places]
    found = []
    for number, place in enumerate(places):
        while left[number]:
            motion = left[number].pop(0)
            partners = [_taken(others, motion) for others in left[number + 1:]]
            if number == 0 and all(partners):
                force = sum(each.weight * known.force for each, known in zip(places, [motion, *partners]) if known)
                found.append(Match(point, motion, force, beyond if any(beyond) else None))
            else:
                found.append(Match(point, motion, motion.force, place.away))
    return sorted(found, key=lambda match: abs(match.residual))


def _taken(others: list[Known], motion: Known) -> Known | None:
    """The same motion among those of another place; None without one."""
    same = [one for one in others if one.key == motion.key]
    nearest = min(same, key=lambda one: abs(one.force - motion.force), default=None)
    if nearest is None or not (motion.goes_on or abs(nearest.force - motion.force) <= ONE_BRANCH * max(nearest.force, motion.force)):
        return None
    others.remove(nearest)
    return nearest


def distance(first: float, second: float) -> float:
    """The distance; 0 for numbers equal up to rounding."""
    return 0.0 if abs(first - second) <= ROUNDING * max(abs(first), abs(second)) else abs(first - second)


def around(values: Sequence[float] | Reals, x: float) -> list[tuple[int, float]]:
    """[(index, weight)] of the ascending numbers on both sides of x, or of the one equal to x or, outside, nearest to it."""
    after = next((number for number, value in enumerate(values) if value >= x), len(values))
    if after in (0, len(values)):
        return [(min(after, len(values) - 1), 1.0)]
    weight = (x - values[after - 1]) / (values[after] - values[after - 1])
    weight = round(weight) if min(weight, 1 - weight) < ROUNDING else weight
    return [(number, share) for number, share in ((after - 1, 1 - weight), (after, weight)) if share > 0]
