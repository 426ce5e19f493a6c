"""Numbers that are stored without a unit over the plane of a map: how stable the motion is, where its orbit is, and forces of each cycle.

Multipliers and stroboscopic points exist for orbits, Lyapunov exponents and error growths for every motion that was
followed; forces of each cycle are drawn where impacts continue. In chaos the overall largest force grows with the
observation time, whereas the mean and the 95 % quantile of the cycles' largest forces do not.
"""

from collections.abc import Callable
from dataclasses import dataclass

from matplotlib.axes import Axes

from ..arrays import Integers, Mask
from ..files.coordinates import unit_of
from ..files.opened import OpenedFile
from ..files.regimes import FAILED, NO_IMPACT, NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT
from ..plotting import style, units
from ..plotting.coordinates import either
from ..plotting.limits import WEIGHTS
from ..plotting.picture import picture
from . import field_map
from .field_map import WITHOUT_IMPACTS, Field, Scale
from .map_file import PeterkaFile


def _orbits(regime: Integers, *_: object) -> Mask:
    mask: Mask = (regime == PERIODIC) | (regime == NO_IMPACT) | (regime == SUSTAINED_CONTACT)
    return mask


def _followed(regime: Integers, *_: object) -> Mask:
    mask: Mask = (regime != FAILED) & (regime != NOT_COMPUTED)
    return mask


@dataclass(frozen=True)
class Number:
    """What a field is called on its scale, the cells that have it, the classes told apart from those, whether its scale
    begins at 0, and whether it is a force over the hammer's weight; of a coordinate its name, what it
    is called in SI units, and such a unit with how many of it make 1 m or 1 m/s."""

    label: str
    carries: Callable[..., Mask]
    apart: tuple[str, ...]
    from_zero: bool = True
    is_force: bool = False
    in_si: tuple[str, str, str, float] | None = None


NOT_AN_ORBIT = ("chaotic", "unresolved", "failed")
NUMBERS = {
    "multiplier": Number(r"largest Floquet multiplier $|\mu|$", _orbits, NOT_AN_ORBIT),
    "lyapunov": Number("largest Lyapunov exponent (1/cycle)", _followed, ("failed",), from_zero=False),
    "sensitivity": Number("largest growth of an error, ln $G$", _followed, ("failed",)),
    "orbit_displacement": Number("$u/A_0$ at forcing phase 0", _orbits, NOT_AN_ORBIT, from_zero=False,
                                 in_si=("displacement_ratio", "$u$ at forcing phase 0", "mm", 1000)),
    "orbit_velocity": Number(r"$\dot{u}/(A_0\omega)$ at forcing phase 0", _orbits, NOT_AN_ORBIT, from_zero=False,
                             in_si=("velocity_ratio", r"$\dot{u}$ at forcing phase 0", "m/s", 1)),
    "peak_force_mean_ratio": Number("mean of each cycle's", field_map.has_impacts, WITHOUT_IMPACTS, is_force=True),
    "peak_force_q95_ratio": Number("95 % quantile of each cycle's", field_map.has_impacts, WITHOUT_IMPACTS, is_force=True),
}


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None, *, name: str) -> Axes | None:
    """The picture of one of NUMBERS that the file has, as Axes over its plane; None if no cell has a value."""
    number = NUMBERS[name]
    field = Field(name, number.carries, number.apart, lambda largest: scale_of(file, number, largest), number.from_zero,
                  marks_largest=number.in_si is None)
    return field_map.draw(file, field, ax)


def scale_of(file: OpenedFile, number: Number, largest: float) -> Scale:
    """The Scale of one of NUMBERS, whose values are up to the largest."""
    in_si = style.current().units == "si"
    if number.in_si:
        return _scale_of_coordinate(file, number)
    if not number.is_force:
        return Scale(number.label, 1, units.number)
    label = f"{number.label} largest force, $F/(m\\,g)$"
    newtons = file.newtons or 0.0
    if not newtons:
        return Scale(label, 1, units.number, ratio=WEIGHTS)
    factor, unit = units.with_prefix(largest * newtons, "N")
    return Scale(label, 1, lambda force: either(file, units.amount(force * newtons, "N"), units.number(force)),
                 (f"{number.label} largest force ({unit})" if in_si else f"force ({unit})", newtons * factor),
                 ("N", newtons), WEIGHTS)


def _scale_of_coordinate(file: OpenedFile, number: Number) -> Scale:
    assert number.in_si is not None
    name, words, unit, factor = number.in_si
    own = unit_of(file, name)
    ratio = {"displacement_ratio": "A0", "velocity_ratio": "A0 omega"}[name]
    if own is None:
        return Scale(number.label, 1, units.number, ratio=ratio)
    base = {"mm": "m"}.get(unit, unit), own
    factor *= own
    return Scale(number.label, 1, lambda value: either(file, f"{units.number(factor * value)} {unit}", units.number(value)),
                 (f"{words} ({unit})", factor), base, ratio)
