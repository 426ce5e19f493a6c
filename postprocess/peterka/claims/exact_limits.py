"""Exact band limits from curves: where an orbit of the map ends, doubles its period, or gains or loses an impact."""

from dataclasses import dataclass

from ..maps.curves_file import RIG, SAME_GAP, WORDS, Crossing, Curve
from .folder import Folder, Plane

FILE = "curves_170mm"


@dataclass(frozen=True)
class Limit:
    """`kind` in words; None if no curve is known there, and the limit is taken from the map's cells."""

    hz: float
    kind: str | None = None

    @property
    def text(self) -> str:
        """The limit in Hz, to all known digits, and its kind."""
        return f"{self.hz:.9g} Hz ({self.kind})" if self.kind else f"{self.hz:.2f} Hz"


def limits(folder: Folder, plane: Plane, found: tuple[float, float], z: tuple[int, int], row: int = 0) -> list[Limit]:
    """The two limits [Hz] of a band of z = (p, q), each taken from the curve within one column of it."""
    step = plane.frequency_hz[1] - plane.frequency_hz[0]
    near = [_borders(folder, plane, z, row, value, step) for value in found]
    return [min(borders, key=lambda limit: abs(limit.hz - value)) if borders else Limit(float(value))
            for value, borders in zip(found, near)]


def _borders(folder: Folder, plane: Plane, z: tuple[int, int], row: int, hz: float, step: float) -> list[Limit]:
    return [Limit(border.frequency_ratio * plane.natural_frequency_hz, WORDS[border.curve.kind])
            for border in _crossings(folder, plane)
            if abs(border.gap_ratio - plane.rows[row]) < SAME_GAP and _bounds(border.curve, z)
            and abs(border.frequency_ratio * plane.natural_frequency_hz - hz) <= step]


def _bounds(curve: Curve, z: tuple[int, int]) -> bool:
    """Whether the orbit of z ends or changes on this curve."""
    if curve.kind == "period_doubling" and (2 * curve.impacts, 2 * curve.period) == z:
        return True
    more = z[0] - curve.impacts
    return curve.period == z[1] and (more == 0 or (curve.kind == "grazing" and more == 1))


def _crossings(folder: Folder, plane: Plane) -> list[Crossing]:
    """The file's curves, if computed for the same rig."""
    curves = folder.curves(FILE)
    if curves is None or any(curves.job.get(name) != plane.job.get(name) for name in RIG):
        return []
    return curves.crossings
