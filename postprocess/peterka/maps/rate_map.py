"""The change of the peak force, or on a rigid stop of the impact speed, per unit of one number, over the plane of a map: N per Hz, N per
mm, N per kN/m, as maps/rates.py computes it from an elasticity."""

from matplotlib.axes import Axes

from ..plotting.picture import picture
from . import signed_map
from .map_file import PeterkaFile
from .rates import RESULTS, UNITS, rate_of
from .rig_numbers import along_axes
from .signed_map import SignedField

LACKING = ("no rate of change", "#CFCFCF")


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None, *, name: str) -> Axes | None:
    """The picture of the rate of this name, "force_per_gap" and so on, as Axes; None if no cell has one."""
    rate = rate_of(file, along_axes(file), name)
    assert rate is not None
    _, unit, _, words = RESULTS[rate.result]
    short, _, per, _ = UNITS[rate.number]
    label = f"change of {words} by {short.replace('_', ' ')}"
    return signed_map.draw(file, SignedField(rate.datasets, rate.of, label, f"{{unit}} per {per}", LACKING, unit), ax)


def has(file: PeterkaFile, name: str) -> bool:
    """Whether a file tells the rate of this name."""
    return bool(file.elasticities) and rate_of(file, along_axes(file), name) is not None
