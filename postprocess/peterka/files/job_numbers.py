"""Quantities that the cells of a map share with its freely swinging hammer: dimensionless frequency, damping and gap, from
the job and its axes, whichever quantities these vary."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Mask, Reals

OF_A_CELL = ("hammer", "cart", "contact", "operating_point")  # tables
EITHER = (("operating_point.frequency_ratio", "operating_point.frequency_hz"), ("operating_point.gap_ratio", "operating_point.gap_m"),
          ("hammer.natural_frequency_hz", "hammer.stiffness_n_per_m"), ("hammer.damping_ratio", "hammer.damping_ns_per_m"))
PLACE = ("frequency_ratio", "gap_ratio", "frequency_hz", "gap_m")  # coordinates that belong to [operating_point]


@dataclass(frozen=True)
class Swing:
    """frequency_ratio, damping_ratio, gap_ratio: Omega/omega, zeta and gap/A0, as arrays of compatible shapes."""

    frequency_ratio: Reals
    damping_ratio: Reals
    gap_ratio: Reals

    def room(self) -> Reals:
        """Clearance over A0 between the stop and the steady motion without a stop, for linear springs; below 0 if it strikes."""
        return self.gap_ratio - edge_of_no_impact(self.frequency_ratio, self.damping_ratio)

    def stays_free(self) -> Mask:
        """Whether the steady motion without a stop stays clear of the stop."""
        return self.room() > 0


def edge_of_no_impact(frequency_ratio: Reals | float, damping_ratio: Reals | float) -> Reals:
    """Amplitude of the steady motion without a stop relative to the cart, over A0."""
    square = np.square(frequency_ratio)
    with np.errstate(divide="ignore"):
        values: Reals = square / np.sqrt((1 - square) ** 2 + (2 * damping_ratio) ** 2 * square)
        return values


class UnreadableJob(ValueError):
    """A job's text that lacks required information."""


def tables_of(text: object) -> dict[str, Any]:
    """The tables of a job's text."""
    try:
        return tomllib.loads(text)  # type: ignore[arg-type]  # non-text is refused below
    except (tomllib.TOMLDecodeError, RecursionError, TypeError, AttributeError) as error:
        raise UnreadableJob("holds no job that can be read") from error


def number_of(tables: Mapping[str, Any], path: str) -> float | None:
    """The number at a dotted path such as "hammer.mass_kg"; None if absent."""
    value: Any = tables
    for key in path.split("."):
        value = value.get(key) if isinstance(value, dict) else None
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else None


def numbers_of_cell(tables: Mapping[str, Any], coordinates: Mapping[str, float]) -> dict[str, Any]:
    """{"contact.damping_ns_per_m" or "operating_point.gap_ratio": value}: what a job's tables and the axes, {name in the file: value},
    give of a cell. Of two keys for the same (EITHER) one is there."""
    numbers = {f"{table}.{key}": value for table in OF_A_CELL for key, value in tables.get(table, {}).items()}
    for name, value in coordinates.items():
        path = _path(name)
        for other in (key for keys in EITHER if path in keys for key in keys):
            numbers.pop(other, None)
        numbers[path] = value
    return numbers


def swing_of(tables: Mapping[str, Any], coordinates: Mapping[str, Reals]) -> Swing:
    """The Swing at these values of the axes, {name in the file: array}. Raises UnreadableJob if the job lacks a number."""
    along = {_path(name): np.asarray(values, dtype=float) for name, values in coordinates.items()}

    def first(*paths: str) -> tuple[str, Reals]:
        """(index of the path that is given, its number): axes take precedence over tables."""
        sources: tuple[Mapping[str, Reals | float | None], ...] = along, {path: number_of(tables, path) for path in paths}
        for source in sources:
            for path in paths:
                if (value := source.get(path)) is not None:
                    return path.split(".")[1], np.asarray(value)
        raise UnreadableJob(f"holds a job that doesn't tell {' or '.join(paths)}")

    mass = first("hammer.mass_kg")[1]
    frequencies, gaps, springs, dampings = EITHER
    name, value = first(*springs)
    natural = value if name == "natural_frequency_hz" else np.sqrt(value / mass) / (2 * np.pi)
    name, value = first(*dampings)
    damping = value if name == "damping_ratio" else value / (4 * np.pi * mass * natural)
    name, value = first(*frequencies)
    frequency = value if name == "frequency_ratio" else value / natural
    name, value = first(*gaps)
    gap = value if name == "gap_ratio" else value / first("cart.amplitude_m")[1]
    return Swing(frequency, damping, gap)


def _path(name: str) -> str:
    if name in PLACE:
        return f"operating_point.{name}"
    table = next((table for table in ("hammer", "cart", "contact", "start") if name.startswith(f"{table}_")), None)
    return f"{table}.{name[len(table) + 1:]}" if table else name
