"""Which parameter would remove a difference from the paper, and by how much it must change: ci, ki, A0 and zeta, one at a time.

Gaps keep their values in mm when A0 changes, as they are set by shims. Each file's own job tells what was changed.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Mask, Reals
from ..errors import PeterkaFileError
from .folder import LARGEST, SMALLEST, Folder, Plane
from .gap_zero import BAND_HALF, BAND_ONE, HALF_HZ, PEAK_HZ, PEAK_N, at_edge, force_at, limits_hz
from .record import SOME, percent

PARAMETERS = {
    "ci": ("contact", "damping_ns_per_m", "stop's damping ci"),
    "ki": ("contact", "stiffness_n_per_m", "stop's stiffness ki"),
    "A0": ("cart", "amplitude_m", "cart's amplitude A0"),
    "zeta": ("hammer", "damping_ns_per_m", "hammer's damping ζ"),
}


@dataclass(frozen=True)
class Row:
    """Dependence of one number on one parameter: `values` at `factors` times the parameter, 1 among them.

    For a basin, where the paper prints no number but has both outcomes: `values` are the shares of starts that end in
    impacts and `quiet` those of starts that end without, in %; `has_both` tells where both occur."""

    what: str
    unit: str
    printed: float | None
    parameter: str
    factors: Reals
    values: Reals
    quiet: Reals
    has_both: Mask

    @property
    def answer(self) -> str:
        """The factor nearest to 1 at which the number equals the paper's, in words."""
        factor = self.needed
        if factor is not None:
            return f"{factor:.3g} times"
        tried = f"from {self.factors[0]:g} to {self.factors[-1]:g}"
        return f"none tried {tried} has {percent(SOME)} of each" if self.printed is None else f"no factor {tried}"

    @property
    def needed(self) -> float | None:
        """The factor itself; None if there is none."""
        if self.printed is None:
            return _nearest_to_1(self.factors[self.has_both].tolist())
        return _crossing(self.factors, self.values - self.printed)


def rows(folder: Folder) -> list[Row]:
    """All Rows, those of the same number adjacent; empty if the files are missing."""
    found = []
    gap_0 = folder.plane("gaps_170mm")
    if gap_0 is not None:
        for what, unit, printed, number in _NUMBERS:
            found += _rows_of(folder, "sensitivity/gap_0_", gap_0, what, unit, printed, number)
    for rig, figure in (("150mm", "24a"), ("135mm", "24b")):
        base = folder.plane(f"basin_{rig}")
        if base is not None:
            what = f"starts that end in impacts / in none, Fig. {figure}"
            found += _rows_of(folder, f"sensitivity/{rig}_", base, what, "%", None,
                              lambda plane: 100 * plane.share(plane.strikes))
    return found


def contact_damping_with_both(folder: Folder, prefix: str) -> str:
    """Describes the contact damping that gives both outcomes at a basin's operating point; '' if none was found."""
    base = folder.plane(f"basin_{prefix.split('/')[1].rstrip('_')}")
    if base is None:
        return ""
    moved = [(_distance(_factor(plane, base, "ci")), plane) for plane in folder.planes(prefix) if _moved(plane, base) == "ci"]
    for _, plane in sorted(moved, key=lambda pair: pair[0]):
        if plane.has_both:
            return (f"with ci = {plane.job['contact']['damping_ns_per_m']:.4g} Ns/m instead of "
                    f"{base.job['contact']['damping_ns_per_m']:.4g} both are there: {outcomes(plane)}")
    return ""


def outcomes(plane: Plane) -> str:
    """Describes the shares of a basin's starts by outcome."""
    left = plane.share(~(plane.quiet | plane.strikes))
    return (f"{percent(plane.share(plane.strikes))} of the starts end in impacts, {percent(plane.share(plane.quiet))} in none"
            + (f", {percent(left)} in lasting contact or undecided" if left > 0 else ""))


def _limit(number: float, z: tuple[int, int], inside: float, end: int) -> tuple[str, str, float, Callable[[Plane], float]]:
    """Limit 0 (lower) or 1 (upper) of a band; NaN without the band, or if it extends beyond the map."""
    def value(plane: Plane) -> float:
        found = limits_hz(plane, *z, inside)
        return np.nan if found is None or at_edge(plane, found)[end] else found[end]
    return (f"{('lower', 'upper')[end]} limit of z = {z[0]}/{z[1]} at gap 0", "Hz", number, value)


_NUMBERS = [
    ("force at 9.00 Hz, gap 0", "N", PEAK_N, lambda plane: force_at(plane, PEAK_HZ)),
    _limit(BAND_ONE[0], (1, 1), PEAK_HZ, 0),
    _limit(BAND_ONE[1], (1, 1), PEAK_HZ, 1),
    _limit(BAND_HALF[0], (1, 2), HALF_HZ, 0),
]


def _rows_of(folder: Folder, prefix: str, base: Plane, what: str, unit: str, printed: float | None,
             number: Callable[[Plane], float]) -> list[Row]:
    by_parameter = {name: {1.0: base} for name in PARAMETERS}
    for plane in folder.planes(prefix):
        name = _moved(plane, base)
        if name:
            by_parameter[name][_factor(plane, base, name)] = plane
    return [_row(what, unit, printed, number, name, dict(sorted(planes.items())))
            for name, planes in by_parameter.items() if len(planes) > 1]


def _row(what: str, unit: str, printed: float | None, number: Callable[[Plane], float], name: str, planes: Mapping[float, Plane]) -> Row:
    return Row(what, unit, printed, name, np.array(list(planes)), np.array([number(plane) for plane in planes.values()]),
               np.array([100 * plane.share(plane.quiet) for plane in planes.values()]),
               np.array([plane.has_both for plane in planes.values()]))


def _parameter(plane: Plane, name: str) -> float:
    table, key, words = PARAMETERS[name]
    try:
        value = float(plane.job[table][key])
    except (KeyError, TypeError, ValueError):
        value = 0.0
    if not SMALLEST <= value <= LARGEST:
        raise PeterkaFileError(f"{plane.path} doesn't tell the {words} ({table}.{key}), or it is nothing")
    return value


def _factor(plane: Plane, base: Plane, name: str) -> float:
    return round(_parameter(plane, name) / _parameter(base, name), 9)


def _moved(plane: Plane, base: Plane) -> str | None:
    """The single parameter that differs; None if none or several do."""
    moved = [name for name in PARAMETERS if _factor(plane, base, name) != 1]
    return moved[0] if len(moved) == 1 else None


def _crossing(factors: Reals, off: Reals) -> float | None:
    """The factor nearest to 1 at which `off` crosses 0, between two neighbours that both have numbers."""
    found = []
    for n in range(len(factors) - 1):
        a, b = off[n], off[n + 1]
        if np.isfinite([a, b]).all() and a * b <= 0 and a != b:
            found.append(factors[n] + (factors[n + 1] - factors[n]) * a / (a - b))
    return _nearest_to_1([float(factor) for factor in found])


def _nearest_to_1(factors: Sequence[float]) -> float | None:
    return min(factors, key=_distance) if factors else None


def _distance(factor: float) -> float:
    value: float = abs(np.log(factor))
    return value
