"""The limits requested of a scale of values, in a unit that doesn't depend on the prefix of the scale: in base SI units (N, m/s, s) where
pictures are in SI alone or a number has no ratio, otherwise in the ratio that the picture shows."""

import numpy as np

from ..arrays import Reals
from ..errors import PeterkaFileError
from ..files.opened import OpenedFile
from . import style, units

EXTENDS = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}  # of a bar, by whether values lie below, above
WEIGHTS = "weights of the hammer, F/(m g)"


class NothingToSee(PeterkaFileError):
    """All values of a picture lie outside the limits that are requested of their scale."""


def beyond(values: Reals, low: float, high: float) -> str:
    """At which ends of a scale values lie beyond it, as a colour bar names them."""
    finite = values[np.isfinite(values)]
    below, above = bool(np.any(finite < low)), bool(np.any(finite > high))
    return EXTENDS[below, above]


def requested(file: OpenedFile, values: Reals, in_si: tuple[str, float] | None, ratio: str = "") -> tuple[float, float] | None:
    """The limits of a scale, in stored numbers; None where none are requested. `values`: what the picture shows, as stored; `in_si`:
    the base unit and its factor from stored numbers, if the file tells; `ratio`: what stored numbers are over, empty if they are in SI."""
    limits = style.scale_option("limits")
    if limits is None:
        return None
    unit, factor = in_si if in_si and (not ratio or style.current().units == "si") else (ratio, 1.0)
    low, high = (limit / factor for limit in limits)
    shown = values[np.isfinite(values) & (values != 0)]
    if len(shown) and (shown.max() < low or shown.min() > high):
        ends = " to ".join(units.number(float(end) * factor, 4) for end in (shown.min(), shown.max()))
        unit = f" {unit}" if unit else ""
        raise NothingToSee(str(file.refusal(
            f"has values from {ends}{unit}, and --limits {limits[0]:g},{limits[1]:g} (in{unit or ' the numbers of the scale'}) leaves "
            "nothing of them to see; other limits show them, and --only draws one picture alone")))
    return low, high
