"""The extent of a drift on a map's axes, and the worst value over the resulting box around each cell.

The box covers at least the drift: if that ends between two cells, the farther one is included. Cells whose box extends
beyond the map have no value, because the outside is not computed.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from ..arrays import Integers, Mask, Reals
from ..files.coordinates import SPOKEN, TWINS, Measured, measured
from ..files.opened import OpenedFile
from ..maps.map_file import Axis, PeterkaFile
from .admitted import NO_REGIME, Admitted

TOUCH = 1e-9  # of a step: rounding
ROUNDING = 1e-6  # of a thousandth of a Hz or mm
OF_UNITS = {"Hz": "frequency", "mm": "gap"}  # what drifts in these
USUAL = {"Hz": 0.5, "mm": 0.1}  # half-widths where none is asked for


@dataclass(frozen=True)
class Reach:
    """Along an axis: `width` of the drift in the axis' own numbers, how many cells the box has `before` and `after` each cell,
    (n,), and whether it lies `inside` the map, (n,)."""

    width: float
    before: Integers
    after: Integers
    inside: Mask

    def meets(self, at: int) -> Mask:
        """Whether the box of each cell overlaps that of the cell `at`, (n,)."""
        here = np.arange(len(self.before))
        mask: Mask = (here - self.before <= at + self.after[at]) & (here + self.after >= at - self.before[at])
        return mask

    def ends(self, values: Reals, at: int) -> tuple[float, float]:
        """From where to where the cells of the box of the cell `at` lie, by the axis' `values`."""
        return float(values[at - self.before[at]]), float(values[at + self.after[at]])


def unit_of(file: OpenedFile, name: str) -> Measured | None:
    """How people set an axis that drifts, in Hz or mm; None for an axis of something else."""
    si = TWINS.get(name, name)
    if si not in ("frequency_hz", "gap_m"):
        return None
    found = measured(file, name)
    if found is None:
        raise file.refusal(f"doesn't say what a {name} of 1 is in {SPOKEN[si][1]}")
    return found


def read_drift(file: PeterkaFile, asked: Mapping[str, float | None]) -> tuple[float, float]:
    """The half-widths (Hz, mm) of the drift that is asked for, {"Hz", "mm": half-width}, or the usual ones for None. Refuses one along what
    the map doesn't vary, where the usual one is none, and one so wide that each of its boxes leaves the map."""
    units = {measure.unit: (axis, measure) for axis in (file.columns, file.rows)
             if len(axis.values) > 1 and (measure := unit_of(file, axis.name))}
    widths = {unit: USUAL[unit] if width is None else width for unit, width in asked.items()}
    for unit, width in widths.items():
        what = OF_UNITS[unit]
        if unit not in units:
            if asked[unit]:
                raise file.refusal(f"has one and the same {what} in all cells, so that it doesn't tell what a drift of ±{width:g} {unit} does: "
                                   f"compute a map over the {what}, or leave this drift out")
            widths[unit] = 0.0
            continue
        axis, own = units[unit]
        low, high = axis.values[[0, -1]] * own.factor
        most = float(np.minimum(axis.values - axis.values[0], axis.values[-1] - axis.values).max() * own.factor)
        if not reach(file, axis, widths["Hz"], widths["mm"]).inside.any():
            raise file.refusal(f"has its {what} from {low:.4g} to {high:.4g} {unit}: a drift of ±{width:g} {unit} leaves that from each of its "
                               f"cells; allow at most ±{np.floor(1e3 * most + ROUNDING) / 1e3:g} {unit}, or compute a wider map")
    return widths["Hz"], widths["mm"]


def reach(file: OpenedFile, axis: Axis, hz: float, mm: float) -> Reach:
    """The Reach of a drift of this half-width; an axis that is neither a frequency nor a gap does not drift."""
    unit = unit_of(file, axis.name)
    width = 0.0 if unit is None else {"Hz": hz, "mm": mm}[unit.unit] / unit.factor
    values = axis.values
    slack = TOUCH * float(np.diff(values).min()) if len(values) > 1 else 0.0
    inside = (values - width >= values[0] - slack) & (values + width <= values[-1] + slack)
    here = np.arange(len(values))
    before = here - np.searchsorted(values, values - width + slack, side="right") + 1
    after = np.searchsorted(values, values + width - slack, side="left") - here
    return Reach(width, np.where(inside, before, 0), np.where(inside, after, 0), inside)


def worst_of_boxes(admitted: Admitted, rows: Reach, columns: Reach, codes: Collection[int] | None = None) -> Reals:
    """The worst value over the box around each cell, (rows, columns); NaN if its regime is not unique or not in `codes`."""
    labels, number = np.unique(admitted.code, return_inverse=True)
    numbers: Reals = number.reshape(admitted.code.shape).astype(float)
    sound = (admitted.code != NO_REGIME) & np.isfinite(admitted.value)
    if codes is not None:
        sound &= np.isin(admitted.code, list(codes))
    worst = over_box(np.where(sound, admitted.value, -np.inf), rows, columns, minimum_filter1d)
    lowest, highest = (over_box(numbers, rows, columns, each) for each in (minimum_filter1d, maximum_filter1d))
    inside = rows.inside[:, None] & columns.inside[None, :]
    return np.where(inside & (lowest == highest) & np.isfinite(worst), worst, np.nan)


def over_box(values: Reals, rows: Reach, columns: Reach, filtered: Callable[..., Reals]) -> Reals:
    """A filter over the box around each cell, separable: along the rows, then along the columns, for each box size that occurs."""
    values = np.asarray(values, dtype=float)  # scipy's filters know no half precision
    for axis, along in ((0, rows), (1, columns)):
        wide = np.empty_like(values)
        for before, after in np.unique(np.column_stack([along.before, along.after]), axis=0).tolist():
            size = before + after + 1
            taken = filtered(values, size, axis=axis, mode="nearest", origin=before - size // 2)
            places = np.flatnonzero((along.before == before) & (along.after == after))
            index: Any = (places, slice(None)) if axis == 0 else (slice(None), places)
            wide[index] = taken[index]
        values = wide
    return values
