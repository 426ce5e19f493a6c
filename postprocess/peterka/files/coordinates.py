"""The coordinates of a file in both of their units: the single place that pairs their names and converts ratios to SI units.

A job may give frequency, gap and start as ratios or in Hz, m and m/s; the file names its axes and the coordinates of curves
accordingly. Pictures and reports always use ratios, with SI units beside them or in their place: `coordinate` converts the
stored numbers to ratios if the required scales are common to all cells of the file. If they are not, because an axis changes
the rig, the coordinate stays as stored.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

# For each ratio: its name in SI units, and the value of ratio 1 there, from the root attributes of a file.
TWINS = {
    "frequency_ratio": "frequency_hz",
    "gap_ratio": "gap_m",
    "displacement_ratio": "displacement_m",
    "velocity_ratio": "velocity_m_per_s",
    "start_displacement_ratio": "start_displacement_m",
    "start_velocity_ratio": "start_velocity_m_per_s",
}
RATIOS = {si: ratio for ratio, si in TWINS.items()}
NAMES = TWINS.keys() | RATIOS.keys()


class Scales(Protocol):
    """A file with natural_frequency_hz and cart_amplitude_m if common to all of its cells; else None."""

    def positive(self, name: str) -> float | None: ...


@dataclass(frozen=True)
class Coordinate:
    """`name` as shown, `stored` as in the file, and `unit`: shown value times `unit` = stored value."""

    name: str
    stored: str
    unit: float = 1.0


def unit_of(file: Scales, name: str) -> float | None:
    """The value of ratio 1 in SI units [Hz, m or m/s], for a coordinate by either of its names; None if the file does not give it."""
    ratio = RATIOS.get(name, name)
    hertz, metres = file.positive("natural_frequency_hz"), file.positive("cart_amplitude_m")
    if ratio == "frequency_ratio":
        return hertz
    if ratio in ("velocity_ratio", "start_velocity_ratio"):
        return 2 * np.pi * hertz * metres if hertz and metres else None
    return metres if ratio in TWINS else None


def coordinate(file: Scales, stored: str) -> Coordinate:
    """The Coordinate for a name in the file."""
    unit = unit_of(file, stored) if stored in RATIOS else None
    return Coordinate(RATIOS[stored], stored, unit) if unit else Coordinate(stored, stored)
