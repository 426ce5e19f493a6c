"""How much the peak force of an orbit [N], or on a rigid stop its impact speed [m/s], changes per unit of a number of the rig or of its
place: N per Hz, N per mm, N per kN/m. From the elasticity E, in % per %, it is E times the result over the number.

In a cell where the number is 0, as the gap at the edge of a plane, there is none: nor has a relative change of it a size.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Reals
from ..files.opened import OpenedFile
from .rig_numbers import Along, values_of

# Of each result: its dataset, its unit in words and in names, and the word for it.
RESULTS = {"force": ("peak_force_ratio", "N", "n", "peak force"), "speed": ("impact_speed", "m/s", "m_s", "impact speed")}
# Of each number by which there are elasticities: what names call it, the unit in names and in words, and that in SI.
UNITS = {
    "frequency_hz": ("frequency", "hz", "Hz", 1.0),
    "gap_m": ("gap", "mm", "mm", 1e-3),
    "hammer_mass_kg": ("hammer_mass", "kg", "kg", 1.0),
    "hammer_natural_frequency_hz": ("natural_frequency", "hz", "Hz", 1.0),
    "hammer_stiffness_n_per_m": ("spring_stiffness", "n_per_m", "N/m", 1.0),
    "hammer_damping_ns_per_m": ("spring_damping", "ns_per_m", "N s/m", 1.0),
    "hammer_damping_ratio": ("damping_ratio", "percent", "% of critical damping", 1e-2),
    "hammer_cubic_stiffness_n_per_m3": ("cubic_stiffness", "kn_per_m3", "kN/m³", 1e3),
    "cart_amplitude_m": ("cart_amplitude", "mm", "mm", 1e-3),
    "contact_stiffness_n_per_m": ("stop_stiffness", "kn_per_m", "kN/m", 1e3),
    "contact_damping_ns_per_m": ("stop_damping", "ns_per_m", "N s/m", 1.0),
    "contact_coefficient": ("restitution", "hundredth", "0.01 of the coefficient", 1e-2),
}
_BY_NAME = {f"{result}_per_{short}": (result, number) for result in RESULTS for number, (short, *_) in UNITS.items()}
NAMES = list(_BY_NAME)  # of the pictures of all rates


@dataclass(frozen=True)
class Rate:
    """The change of a `result` per unit of a `number`: the dataset of its `elasticity`; the `factor` from the stored result times the
    elasticity, over the number [SI], to the rate; and the number's `value` [SI], for all cells or along a coordinate."""

    result: str
    number: str
    factor: float
    value: float | Reals

    @property
    def elasticity(self) -> str:
        """The dataset of the elasticity."""
        return f"{self.result}_elasticity_{self.number}"

    @property
    def datasets(self) -> tuple[str, str]:
        """The datasets that it is computed from."""
        return RESULTS[self.result][0], self.elasticity

    @property
    def name(self) -> str:
        """The name of its picture: "force_per_gap"."""
        return f"{self.result}_per_{UNITS[self.number][0]}"

    @property
    def column(self) -> str:
        """Its name in tables: "force_per_gap_n_per_mm"."""
        return f"{self.name}_{RESULTS[self.result][2]}_per_{UNITS[self.number][1]}"

    def of(self, cells: Mapping[str, NDArray[Any]], rows: slice | int) -> Reals:
        """The rate from {dataset: array} of these rows; NaN where there is none."""
        result, elasticity = (np.asarray(cells[name], dtype=float) for name in self.datasets)
        value: Any = self.value
        if isinstance(value, np.ndarray):
            value = value[rows if value.shape[0] > 1 else 0 if isinstance(rows, int) else slice(None)]
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(np.not_equal(value, 0), elasticity * result * self.factor / value, np.nan)


def rate_of(file: OpenedFile, coordinates: Sequence[Along], name: str) -> Rate | None:
    """The Rate of a name; None where the file doesn't have the elasticity, the result in N or m/s, and the number itself in SI units."""
    result, number = _BY_NAME[name]
    dataset, in_si = RESULTS[result][0], file.newtons if result == "force" else 1.0
    if not in_si or not file.data.has(dataset) or not file.data.has(f"{result}_elasticity_{number}"):
        return None
    value = values_of(file, coordinates, number)
    return None if value is None else Rate(result, number, in_si * UNITS[number][3], value)


def rates_of(file: OpenedFile, coordinates: Sequence[Along]) -> list[Rate]:
    """All Rates that a file tells."""
    return [rate for name in NAMES if (rate := rate_of(file, coordinates, name))]


def column_of_elasticity(dataset: str) -> str | None:
    """What tables call an elasticity, whose own name has the unit of the number, not its own: it is a pure number. None of another dataset."""
    result, _, number = dataset.partition("_elasticity_")
    return f"{result}_elasticity_by_{UNITS[number][0]}" if result in RESULTS and number in UNITS else None
