"""What a measured force is compared with: every motion that is known where its point lies, from the computed places around it.

A motion that all of these places have is interpolated between them, linear in each coordinate; one that only some have is
taken from the nearest of them, and how far that lies away is told.
"""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

from .points import Point

ONE_BRANCH = 0.2  # forces of neighbouring places that differ by a larger share of the larger one may be of two branches
ROUNDING = 1e-9  # of a step: nearer than that, a point lies at a computed place


@dataclass(frozen=True)
class Known:
    """A motion at a computed place. `words` name it, `force` [F/(m g)] is 0 where nothing impacts, `share` that of the starts that
    end in it, None where the file doesn't tell. Places have it in common where its `key` is the same and, unless it `goes_on` for
    sure, the forces are alike, too."""

    key: Hashable
    words: str
    force: float
    share: float | None = None
    goes_on: bool = False


@dataclass(frozen=True)
class Place:
    """A computed place beside a point: how much it `weight`s in an interpolation (all of a point: 1), how far it is `away`
    (frequency, gap), in the file's numbers, and what is `known` there."""

    weight: float
    away: tuple[float, float]
    known: Sequence[Known]


@dataclass(frozen=True)
class Match:
    """`motion` beside a point with a force; `force` of it at the point itself, or, where `away` (frequency, gap) isn't None, that
    far from it."""

    point: Point
    motion: Known
    force: float
    away: tuple[float, float] | None

    @property
    def residual(self) -> float:
        """Measured less computed, F/(m g)."""
        assert self.point.force is not None
        return self.point.force - self.force


def matches(point: Point, places: Sequence[Place], beyond: tuple[float, float] = (0.0, 0.0)) -> list[Match]:
    """[Match] of a point with a force, the nearest force first. `beyond` (frequency, gap): how far outside all places it lies."""
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


def _taken(others, motion):
    """The same motion among those of another place, from which it is taken; None without one."""
    same = [one for one in others if one.key == motion.key]
    nearest = min(same, key=lambda one: abs(one.force - motion.force), default=None)
    if nearest is None or not (motion.goes_on or abs(nearest.force - motion.force) <= ONE_BRANCH * max(nearest.force, motion.force)):
        return None
    others.remove(nearest)
    return nearest


def distance(first: float, second: float) -> float:
    """0 for numbers that are the same but for rounding."""
    return 0.0 if abs(first - second) <= ROUNDING * max(abs(first), abs(second)) else abs(first - second)


def around(values: Sequence[float], x: float) -> list[tuple[int, float]]:
    """[(index, weight)] of the ascending numbers on both sides of x, or of the one at x or, outside, nearest to it."""
    after = next((number for number, value in enumerate(values) if value >= x), len(values))
    if after in (0, len(values)):
        return [(min(after, len(values) - 1), 1.0)]
    weight = (x - values[after - 1]) / (values[after] - values[after - 1])
    weight = round(weight) if min(weight, 1 - weight) < ROUNDING else weight
    return [(number, share) for number, share in ((after - 1, 1 - weight), (after, weight)) if share > 0]
