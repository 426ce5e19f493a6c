"""Measured peak forces over the excitation frequency, in Hz, m and N, read as draw.py --measured reads points."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np

from ..arrays import Mask, Reals
from ..errors import PeterkaFileError
from ..files.csv_table import column_names
from ..files.opened import STANDARD_GRAVITY, OpenedFile
from ..measurements.points import Point, read_measurements
from ..measurements.tables import name_of
from .sweep_rig import SweptRig

GAP_COLUMNS = ("gap_mm", "gap_ratio")
SLOWEST, FASTEST = 0.02, 50.0  # of the natural frequency: beyond, a column has another unit
SAME_GAP = 1e-9  # m


@dataclass(frozen=True)
class MeasuredForces:
    """Points of a file in the order of gap and frequency: `hertz`, `force` [N], `error` [N] (standard errors, NaN without), each (points,);
    `gap` [m] (points,), None where the file has no gap; `names` for messages; `left_out`: sentences."""

    path: Path
    hertz: Reals
    force: Reals
    error: Reals
    gap: Reals | None
    names: Sequence[str]
    left_out: Sequence[str]

    @property
    def has_errors(self) -> bool:
        """Whether the file tells standard errors of its forces."""
        return bool(np.isfinite(self.error).all())

    def gaps(self) -> list[float]:
        """The measured gaps [m], each once; empty where the file has none."""
        found: list[float] = []
        for gap in [] if self.gap is None else np.sort(self.gap).tolist():
            if not found or gap - found[-1] > SAME_GAP:
                found.append(gap)
        return found

    def at_gap(self, gap: float) -> Mask:
        """Mask of the points at a gap of gaps()."""
        assert self.gap is not None
        mask: Mask = np.abs(self.gap - gap) <= SAME_GAP
        return mask


@dataclass(frozen=True)
class _Axis:
    """An unbounded side of a plane."""

    name: str
    edges: tuple[float, float]


class _Units:
    """What the reader of points asks of a file, of a rig instead: a plane of all frequencies [Hz] and gaps [m], or frequencies alone."""

    axis_name, gap_name = "frequency_hz", "gap_m"
    columns, rows = _Axis("frequency_hz", (0.0, np.inf)), _Axis("gap_m", (-np.inf, np.inf))
    values, gaps = np.array([0.0, np.inf]), (None,)

    def __init__(self, rig: SweptRig, has_gaps: bool) -> None:
        self.path, self.kind, self.newtons = rig.path, "map" if has_gaps else "sweep", rig.mass * STANDARD_GRAVITY
        self._scales = {"natural_frequency_hz": rig.natural_hz, "cart_amplitude_m": rig.amplitude}

    def positive(self, name: str) -> float | None:
        return self._scales.get(name)


def read_forces(path: Path, rig: SweptRig) -> MeasuredForces:
    """The points of a file that have a force. Raises PeterkaFileError for a file without any, or with numbers in another unit."""
    has_gaps = bool(set(GAP_COLUMNS) & set(column_names(path)))
    units = _Units(rig, has_gaps)
    read = read_measurements(path, cast(OpenedFile, units))
    points = [point for point in read.points if point.force is not None]
    if not points:
        reasons = f": {'; '.join(read.left_out)}" if read.left_out else "; a column force_n, force_kn or force_ratio has them"
        raise PeterkaFileError(f"{path} has no measured peak force{reasons}")
    points.sort(key=lambda point: (point.gap or 0.0, point.frequency))
    for point in points:
        _refuse_strange(path, point, rig, units.newtons)
    hertz, force = (np.array([getattr(point, name) for point in points], dtype=float) for name in ("frequency", "force"))
    error = np.array([point.errors.get("force", np.nan) for point in points])
    told = int(np.isfinite(error).sum())
    if told not in (0, len(points)):
        raise PeterkaFileError(f"{path} tells the standard error of {told} of {len(points)} forces; tell it, above 0, for all or for none")
    gap = np.array([point.gap for point in points], dtype=float) if has_gaps else None
    return MeasuredForces(path, hertz, units.newtons * force, units.newtons * error, gap,
                          [_in_words(point, units.newtons) for point in points], read.left_out)


def _refuse_strange(path: Path, point: Point, rig: SweptRig, newtons: float) -> None:
    ratio = point.frequency / rig.natural_hz
    if not SLOWEST < ratio < FASTEST:
        raise PeterkaFileError(f"{path} has a point at {point.frequency:.5g} Hz, {ratio:.3g} times the natural frequency of {rig.path}, "
                               f"{rig.natural_hz:.5g} Hz; frequency_hz is in hertz, frequency_ratio is Omega/omega")
    if not cast(float, point.force) > 0:
        raise PeterkaFileError(f"{path} has a force of {newtons * cast(float, point.force):.4g} N at {point.frequency:.5g} Hz; peak forces "
                               "are above 0, and a point without an impact has none")


def _in_words(point: Point, newtons: float) -> str:
    gap = "" if point.gap is None else f", gap {1e3 * point.gap:.4g} mm"
    name = name_of(point)
    return f"{point.frequency:.5g} Hz{gap}, {newtons * (point.force or 0):.4g} N{f' ({name})' if name else ''}"
