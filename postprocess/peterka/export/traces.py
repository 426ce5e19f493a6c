"""The tables of a trace: its motion, its impacts, the hardest one closely, and both spectra, with names and units of their columns."""

from collections.abc import Iterator
from dataclasses import dataclass

from ..arrays import Reals
from ..traces.trace_file import TraceFile

UNITS = {"time": "s", "time_from_touch": "s", "touch_time": "s", "contact_time": "s", "hammer_velocity": "m_s", "cart_velocity": "m_s",
         "relative_velocity": "m_s", "impact_speed": "m_s", "hammer_acceleration": "m_s2", "acceleration_amplitude": "m_s2",
         "flight_acceleration_amplitude": "m_s2", "impulse": "n_s", "force_spectrum": "n_s", "work": "j", "frequency": "hz", "force_amplitude": "n"}


@dataclass(frozen=True)
class TraceTable:
    """`part`: what it is of, "" for the motion; `columns`: {name with its unit: (rows,)}."""

    part: str
    columns: dict[str, Reals]


def tables_of(file: TraceFile) -> Iterator[TraceTable]:
    """Those that the file has, the motion first. Displacements are in mm and forces in N where the file gives the rig, otherwise over A0
    and over the hammer's weight, as in the file."""
    parts = {"": file.motion, "impacts": file.impacts, "impact": file.impact and file.impact.motion, "spectrum": file.spectrum,
             "impact_spectrum": file.impact_spectrum}
    for part, columns in parts.items():
        if columns:
            yield TraceTable(part, dict(_with_unit(file, name, values) for name, values in columns.items()))


def _with_unit(file: TraceFile, name: str, values: Reals) -> tuple[str, Reals]:
    quantity = name.removesuffix("_ratio")
    if quantity == name:
        return (f"{name}_{UNITS[name]}" if name in UNITS else name), values
    factor, unit = (file.newtons, "n") if "force" in name else (file.millimetres, "mm")
    return (f"{quantity}_{unit}", values * factor) if factor else (name, values)
