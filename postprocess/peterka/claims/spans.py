"""Runs of neighbouring axis points with a common property, and the regions between the bands of a map."""

import numpy as np

from ..arrays import Mask
from .folder import Plane
from .record import WIDE


def spans(mask: Mask) -> list[tuple[int, int]]:
    """(first, last) of each run of True, inclusive."""
    steps = np.diff(np.concatenate([[0], np.asarray(mask, dtype=int), [0]]))
    return list(zip(np.flatnonzero(steps == 1).tolist(), (np.flatnonzero(steps == -1) - 1).tolist()))


def span_around(mask: Mask, index: int) -> tuple[int, int] | None:
    """The run containing this index; None if the mask is False there."""
    return next((span for span in spans(mask) if span[0] <= index <= span[1]), None)


def widest(mask: Mask) -> tuple[int, int] | None:
    """The longest run; None without any."""
    found = spans(mask)
    return max(found, key=lambda span: span[1] - span[0]) if found else None


def around_bands(plane: Plane) -> tuple[Mask, Mask, Mask]:
    """Three masks of a map, (rows, columns): up to the end of the widest band z = 1/1; between it and z = 1/2; from the
    beginning of z = 1/2 on. A gap without a band takes the limit of the next lower gap."""
    ends: list[int] = []
    starts: list[int] = []
    for row in range(len(plane.rows)):
        one, half = (widest(plane.is_orbit(1, q)[row]) for q in (1, 2))
        ends.append(one[1] if one else ends[-1] if ends else 0)
        before = starts[-1] if starts else len(plane.columns)
        starts.append(half[0] if half and half[1] - half[0] >= WIDE * len(plane.columns) else before)
    columns = np.arange(len(plane.columns))
    lower = columns <= np.array(ends)[:, None]
    beyond = ~lower & (columns >= np.array(starts)[:, None])
    return lower, ~lower & ~beyond, beyond
