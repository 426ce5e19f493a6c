"""The best separate places of a map: their boxes are disjoint."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import minimum_filter1d

from ..arrays import Reals
from .admitted import Admitted, read_code
from .drift import Reach, over_box

MOST = 10


@dataclass(frozen=True)
class Place:
    """A cell: its indices, the worst value in its box and its own value [in the unit of the Quantity], its orbit (p, q), and the smallest
    share, over its box, of the starts that end in it; `motion`, where drawn rigs may end in several: the commonest one, whose
    probability is the share then."""

    row: int
    column: int
    worst: float
    value: float
    orbit: tuple[int, int]
    share: float
    motion: str = ""

    @property
    def z(self) -> str:
        """The motion in words."""
        return self.motion or f"{self.orbit[0]}/{self.orbit[1]}"


def box_of(place: Place, rows: Reach, columns: Reach) -> tuple[slice, slice]:
    """The rows and columns of the box around a Place."""
    return (slice(place.row - int(rows.before[place.row]), place.row + int(rows.after[place.row]) + 1),
            slice(place.column - int(columns.before[place.column]), place.column + int(columns.after[place.column]) + 1))


def best_places(worst: Reals, admitted: Admitted, rows: Reach, columns: Reach, most: int = MOST) -> list[Place]:
    """The Places whose boxes have the largest worst values, the best first; may be empty."""
    left = np.where(worst > 0, worst, -np.inf)
    shares = over_box(admitted.share, rows, columns, minimum_filter1d)
    found: list[Place] = []
    while len(found) < most and np.isfinite(left.max()):
        row, column = (int(n) for n in np.unravel_index(_middle_of_best(left), left.shape))
        found.append(Place(row, column, float(worst[row, column]), float(admitted.value[row, column]),
                           read_code(admitted.code[row, column]), float(shares[row, column])))
        left[np.ix_(rows.meets(row), columns.meets(column))] = -np.inf
    return found


def _middle_of_best(values: Reals) -> int:
    """The middle one of several equally good neighbours: they share the worst cell of their boxes."""
    best = np.argwhere(values == values.max())
    away = np.abs(best - np.median(best, axis=0)).sum(axis=1)
    return int(np.ravel_multi_index(tuple(best[np.argmin(away)]), values.shape))
