"""What a column of a recording is: its quantity, and the factor from the recorded number to SI.

    time_s, time_ms                      as named here, or a name and its unit as loggers write them: Time (s), Force [kN]
    force_n, force_kn
    acceleration_m_s2, acceleration_g
    displacement_m, displacement_mm

A voltage, V or mV, needs the sensitivity of its sensor.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ..files.harmless import harmless
from ..files.nearest import instead_of
from ..files.opened import STANDARD_GRAVITY

OWN = {
    "time_s": ("time", "s"), "time_ms": ("time", "ms"), "force_n": ("force", "N"), "force_kn": ("force", "kN"),
    "acceleration_m_s2": ("acceleration", "m/s2"), "acceleration_g": ("acceleration", "g"),
    "displacement_m": ("displacement", "m"), "displacement_mm": ("displacement", "mm"),
}
TIMES = tuple(name for name, (quantity, _) in OWN.items() if quantity == "time")
SIGNALS = tuple(name for name in OWN if name not in TIMES)
NAMES = {"time": "time", "t": "time", "force": "force", "f": "force", "load": "force", "acceleration": "acceleration", "accel": "acceleration",
         "acc": "acceleration", "displacement": "displacement", "position": "displacement"}
UNITS = {
    "time": {"s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6},
    "force": {"N": 1.0, "kN": 1e3, "mN": 1e-3},
    "acceleration": {"m/s2": 1.0, "m/s²": 1.0, "m/s^2": 1.0, "m/s**2": 1.0, "mm/s2": 1e-3, "mm/s²": 1e-3, "mm/s^2": 1e-3, "g": STANDARD_GRAVITY},
    "displacement": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "µm": 1e-6},
}
VOLTS = {"V": 1.0, "mV": 1e-3}
SI = {"time": "s", "force": "N", "acceleration": "m/s2", "displacement": "m"}
LEFT_OUT = "-"
_WITH_UNIT = re.compile(r"(?P<name>[^\[\]()]*?)\s*[\[(]\s*(?P<unit>[^\[\]()]*?)\s*[\])]")
_SENSITIVITY = re.compile(r"(?P<number>[^a-zA-Zµ]+)\s*(?P<volts>m?V)\s*/\s*\(?(?P<unit>[^()]+)\)?")


@dataclass(frozen=True)
class Column:
    """A column's quantity, a key of UNITS, and `factor`: SI per recorded number."""

    quantity: str
    factor: float


@dataclass(frozen=True)
class Layout:
    """What the user says of the columns: `columns`, a name, a name with its unit in brackets, or LEFT_OUT for each, or None; `scale`
    {quantity: SI per recorded number}; `sensitivity` {quantity: V per SI unit}; `rate` [Hz] where there is no time."""

    columns: Sequence[str] | None = None
    scale: Mapping[str, float] = field(default_factory=dict)
    sensitivity: Mapping[str, float] = field(default_factory=dict)
    rate: float | None = None


def is_name(cell: str) -> bool:
    """Whether a cell names a quantity, with or without its unit."""
    name, unit = parted(cell)
    return quantity_of(name) is not None and (unit is None or is_unit(unit))


def is_unit(cell: str) -> bool:
    """Whether a cell is a unit, in brackets or not."""
    unit = _plain(cell.strip().strip("[]()").strip())
    return unit in VOLTS or any(unit in units for units in UNITS.values())


def parted(cell: str) -> tuple[str, str | None]:
    """(name, unit or None) of a cell."""
    if cell in OWN:
        return OWN[cell]
    found = _WITH_UNIT.fullmatch(cell.strip())
    return (found["name"], _plain(found["unit"])) if found else (cell.strip(), None)


def quantity_of(name: str) -> str | None:
    """The quantity of a name, None if it is none."""
    return NAMES.get(name.lower())


def columns_of(names: Sequence[str], units: Sequence[str], width: int, layout: Layout) -> list[Column | None]:
    """The Columns of a table with these names and units, each sequence empty if the table has none; None for those left out.
    Raises ValueError with the reason, as a verb and its object, if it can't be told."""
    asked = layout.columns
    if asked is not None and len(asked) != width:
        raise ValueError(f"has {width} columns, and --columns names {len(asked)}; '{LEFT_OUT}' leaves one out")
    if asked is None and not names:
        raise ValueError(f"names no columns; --columns says what each of the {width} is, as in --columns 'time[s],force[kN]'")
    known = [parted(name)[1] for name in names] if len(names) == width else [None] * width
    known = [unit or (_plain(other.strip("[]() ")) if other else None)
             for unit, other in zip(known, units if len(units) == width else [""] * width)]
    found = []
    for name, unit in zip(asked if asked is not None else names, known):
        found.append(None if name == LEFT_OUT else _column(name, unit, layout, asked is not None))
    return found


def _column(cell: str, unit_above: str | None, layout: Layout, asked: bool) -> Column:
    name, unit = parted(cell)
    quantity = quantity_of(name)
    if quantity is None:
        raise ValueError(f"has the unknown column {instead_of([cell], OWN, 'it may have')}; or --columns says what each is, "
                         f"and '{LEFT_OUT}' leaves one out")
    unit = unit or unit_above or (SI[quantity] if asked else None)
    scale = layout.scale.get(quantity)
    if scale is not None and quantity not in layout.sensitivity:
        return Column(quantity, scale)
    if unit in VOLTS:
        if quantity not in layout.sensitivity:
            raise ValueError(f"has its {quantity} in {unit}; --sensitivity {quantity}=10mV/{SI[quantity]}, say, tells its sensor's")
        return Column(quantity, (scale or 1) * VOLTS[unit] / layout.sensitivity[quantity])
    if scale is not None:
        raise ValueError(f"has its {quantity} in no voltage, but --sensitivity for it; --columns '{quantity}[V]' says that --scale {quantity}={scale:g} "
                         f"is the V of one number, and without --sensitivity it is {SI[quantity]}")
    if unit is None:
        raise ValueError(f"has no unit for '{harmless(cell, 40)}'; write {cell} [{SI[quantity]}] into the file, or give --columns with units "
                         f"or --scale {quantity}=FACTOR")
    if unit not in UNITS[quantity]:
        raise ValueError(f"has its {quantity} in '{harmless(unit, 20)}'; it may be in {', '.join((*UNITS[quantity], *VOLTS))}, or --scale "
                         f"{quantity}=FACTOR says how many {SI[quantity]} one is")
    if quantity in layout.sensitivity:
        raise ValueError(f"has its {quantity} in {unit}, which is no voltage: --sensitivity doesn't apply")
    return Column(quantity, UNITS[quantity][unit])


def sensitivity_of(quantity: str, text: str) -> float:
    """V per SI unit from a text as 22.4mV/N or 100 mV/g. Raises ValueError if it is none."""
    found = _SENSITIVITY.fullmatch(text.strip())
    factor = UNITS[quantity].get(_plain(found["unit"].strip())) if found else None
    if not found or factor is None:
        raise ValueError
    return float(found["number"]) * VOLTS[found["volts"]] / factor


def _plain(unit: str) -> str:
    return unit.replace("μ", "µ")  # of two signs for micro
