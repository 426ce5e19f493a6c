"""Other steady-state quantities over the plane of a map, if the file has them.

TITLES has short names for some; for others the file's own description and unit are used.

Quantities of impacts are drawn where impacts continue; the largest displacement in every cell of known regime.
"""

from collections.abc import Callable

from matplotlib.axes import Axes

from ..arrays import Integers, Mask
from ..files.regimes import FAILED, NOT_COMPUTED, UNRESOLVED
from ..plotting import units
from ..plotting.picture import picture
from . import field_map
from .field_map import WITHOUT_IMPACTS, Field, Scale
from .map_file import PeterkaFile

TITLES = {
    "impact_speed": "largest impact speed",
    "impulse": "largest impulse of an impact",
    "contact_time": "longest contact of an impact",
    "contact_power_w": "mean power into the contact",
    "max_displacement": "largest displacement $|u|$",
}
FAR_FROM_ZERO = ("contact_time",)  # alike in most cells: half a period of hammer and stop


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None, *, name: str) -> Axes | None:
    """The picture of one of file.quantities, as Axes; None if no cell has a value."""
    carries: Callable[..., Mask] = field_map.has_impacts
    apart: tuple[str, ...] = WITHOUT_IMPACTS
    if name == "max_displacement":
        carries, apart = _known, ("unresolved", "failed")
    return field_map.draw(file, Field(name, carries, apart, lambda largest: _scale(file, name, largest), name not in FAR_FROM_ZERO), ax)


def _known(regime: Integers, *_: object) -> Mask:
    mask: Mask = (regime != UNRESOLVED) & (regime != FAILED) & (regime != NOT_COMPUTED)
    return mask


def _scale(file: PeterkaFile, name: str, largest: float) -> Scale:
    return scale_of(TITLES.get(name) or file.words(name), file.unit(name), largest)


def scale_of(title: str, unit: str, largest: float) -> Scale:
    """The Scale of numbers in a unit, up to the largest."""
    factor, prefixed = units.with_prefix(largest, unit)
    return Scale(f"{title} ({prefixed})", factor, lambda value: units.amount(value, unit), in_si=(unit, 1.0))
