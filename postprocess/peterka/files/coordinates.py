"""The coordinates of a file in both of their units: the single place that pairs their names and converts ratios to SI units.

A job may give frequency, gap and start as ratios or in Hz, m and m/s; the file names its axes and the coordinates of curves
accordingly. Pictures and computations always use ratios: `coordinate` converts the stored numbers to ratios if the required
scales are common to all cells of the file. If they are not, because an axis changes the rig, the coordinate stays as stored.
What is told in words has the job's own unit first, `leads_in_si`, and the other one beside it.
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
# Of each name in SI units: what people call it, and the unit in which they measure it, with how many of these it is.
SPOKEN = {
    "frequency_hz": ("frequency", "Hz", 1.0),
    "gap_m": ("gap", "mm", 1e3),
    "displacement_m": ("displacement", "mm", 1e3),
    "velocity_m_per_s": ("velocity", "m/s", 1.0),
    "start_displacement_m": ("start displacement", "mm", 1e3),
    "start_velocity_m_per_s": ("start velocity", "m/s", 1.0),
    "cart_amplitude_m": ("cart amplitude", "mm", 1e3),
}
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


@dataclass(frozen=True)
class Measured:
    """How people say a coordinate: `what` it is, and its `unit`; a number that is shown, times `factor`, is in that."""

    what: str
    unit: str
    factor: float


class Named(Protocol):
    """A coordinate or an axis with its name as shown, and its name in the file."""

    @property
    def name(self) -> str: ...
    @property
    def stored(self) -> str: ...


def leads_in_si(stored: str) -> bool:
    """Whether a coordinate is told in SI units first: where the job, and so the file, gives it so."""
    return stored in RATIOS


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


def measured(file: Scales, name: str) -> Measured | None:
    """The Measured of a coordinate, by either of its names; None where the file doesn't tell, or where it is something else."""
    si = TWINS.get(name, name)
    one = unit_of(file, name) if name in TWINS else 1.0
    if si not in SPOKEN or one is None:
        return None
    what, unit, factor = SPOKEN[si]
    return Measured(what, unit, factor * one)
