"""A peterka map file, checked before anything in it is believed and read in bands of rows, never as a whole.

Layout version 1: two coordinate vectors and the data on [rows][columns],
    map    rows gap_ratio,      columns frequency_ratio
    basin  rows velocity_ratio, columns displacement_ratio
with regime int8, impacts and period int32, peak_force_ratio f64 [F/(m g)], and for basins attractor int32 and the group
`attractors`. What cannot be drawn raises NotDrawable.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import classes
from .checked_hdf5 import INTEGER, REAL, CheckedFile, NotDrawable, is_number, shown

__all__ = ["Attractors", "Axis", "NotDrawable", "PeterkaFile"]

LAYOUT = 1
COORDINATES = {"map": ("gap_ratio", "frequency_ratio"), "basin": ("velocity_ratio", "displacement_ratio")}
MAX_POINTS = 65536  # along one axis: a band of rows then still fits in some tens of megabytes
MAX_ATTRACTORS = 4096
BAND_CELLS = 2**21
TITLE_LENGTH = 160


@dataclass(frozen=True)
class Axis:
    """Ratios along one side: cell centres `values` (n,), ascending, and cell borders `edges` (n+1,).

    `log`: the centres are evenly spaced in the logarithm."""

    name: str
    values: np.ndarray
    edges: np.ndarray
    log: bool


@dataclass(frozen=True)
class Attractors:
    """The table of a basin file, one row per attractor; every member has shape (count,)."""

    regime: np.ndarray
    impacts: np.ndarray
    period: np.ndarray
    peak_force_ratio: np.ndarray  # F/(m g)
    orbit_displacement: np.ndarray  # (x - y)/A0 at forcing phase 0
    orbit_velocity: np.ndarray  # (x' - y')/(A0 omega) there
    cells: np.ndarray

    @property
    def count(self):
        return len(self.regime)


class PeterkaFile:
    """A checked, open map file: kind, rows and columns (Axis), shape, attractors. Use it in a `with` block."""

    def __init__(self, path):
        self._file = CheckedFile(path)
        self.path = self._file.path
        try:
            self._check_header()
        except BaseException:
            self._file.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._file.close()

    @cached_property
    def title(self):
        """One printable line; the name of the file where it has no title."""
        text = self._file.attribute("title")
        text = text if isinstance(text, str) else ""
        letters = (letter if letter.isprintable() else " " for letter in text)
        text = " ".join("".join(letters).split()) or self.path.stem
        return text if len(text) <= TITLE_LENGTH else text[: TITLE_LENGTH - 1] + "…"

    def number(self, name):
        """A root attribute that is a finite number, as float; None where it is absent or anything else."""
        value = self._file.attribute(name)
        return float(value) if is_number(value) and np.isfinite(value) else None

    def positive(self, name):
        """The same for a number that must be above zero."""
        value = self.number(name)
        return value if value is not None and value > 0 else None

    @cached_property
    def computed(self):
        """Share of the cells that are computed, 0 to 1."""
        missing = sum(int(np.sum(band["regime"] == classes.NOT_COMPUTED)) for _, band in self.bands(["regime"]))
        return 1 - missing / (self.shape[0] * self.shape[1])

    def bands(self, names, multiple=1):
        """Yields (first row, {name: array (rows, columns)}) over the whole map, `regime` among the names.

        All bands but the last one have a number of rows divisible by `multiple`. Values are checked on the way."""
        rows = multiple * max(1, BAND_CELLS // (self.shape[1] * multiple))
        for first in range(0, self.shape[0], rows):
            band = {name: self._file.values(name, slice(first, first + rows)) for name in names}
            self._check_values(band)
            yield first, band

    def _check_header(self):
        refusal = self._file.refusal
        layout = self._file.attribute("peterka_layout")
        if layout is None:
            raise refusal("is HDF5, but not a peterka file (no attribute peterka_layout)")
        if not is_number(layout) or layout != LAYOUT:
            raise refusal(f"has layout version {shown(layout)}; this program draws version {LAYOUT}")
        self.kind = self._file.attribute("peterka_kind")
        if not isinstance(self.kind, str) or self.kind not in COORDINATES:
            raise refusal(f"is of kind {shown(self.kind)}; this program draws {' and '.join(COORDINATES)} files")
        self.rows, self.columns = (self._axis(name) for name in COORDINATES[self.kind])
        self.shape = (len(self.rows.values), len(self.columns.values))
        for name in ("regime", "impacts", "period"):
            self._file.dataset(name, self.shape, INTEGER)
        self._file.dataset("peak_force_ratio", self.shape, REAL)
        self.attractors = self._attractor_table() if self.kind == "basin" else None

    def _check_values(self, columns):
        regime = columns["regime"]
        known = np.isin(regime, [*range(classes.FAILED + 1), classes.NOT_COMPUTED])
        if not known.all():
            raise self._file.refusal(f"holds the unknown regime {int(regime[~known][0])}")
        periodic = regime == classes.PERIODIC
        for name in ("impacts", "period"):
            if name in columns and np.any(columns[name][periodic] < 1):
                raise self._file.refusal(f"holds a periodic cell whose {name} is below 1")
        attractor = columns.get("attractor")
        if attractor is not None and np.any((attractor < -1) | (attractor >= self.attractors.count)):
            raise self._file.refusal("names an attractor that its table does not have")

    def _axis(self, name):
        shape = self._file.dataset(name, None, INTEGER + REAL).shape
        if len(shape) != 1 or not 2 <= shape[0] <= MAX_POINTS:
            raise self._file.refusal(f"has {name} of shape {shape}; an axis of 2 to {MAX_POINTS} points can be drawn")
        values = np.asarray(self._file.values(name, slice(None)), dtype=float)
        if not (np.isfinite(values).all() and np.all(np.diff(values) > 0)):
            raise self._file.refusal(f"has a coordinate {name} that does not ascend")
        log = _evenly_spaced_in_log(values)
        edges = np.exp(_edges(np.log(values))) if log else _edges(values)
        if name == "frequency_ratio" and values[0] >= 0:
            edges[0] = max(edges[0], 0)  # half a wide cell may reach below 0, where no frequency is
        return Axis(name, values, edges, log)

    def _attractor_table(self):
        self._file.dataset("attractor", self.shape, INTEGER)
        self._file.dataset("attractors/count", (), INTEGER)
        count = int(self._file.values("attractors/count", ()))
        capacity = self._file.dataset("attractors/regime", None, INTEGER).shape
        if len(capacity) != 1 or not 0 <= count <= min(capacity[0], MAX_ATTRACTORS):
            raise self._file.refusal(f"says it has {count} attractors, in a table of shape {capacity}")
        columns = {}
        for name in Attractors.__dataclass_fields__:
            kinds = INTEGER if name in ("regime", "impacts", "period", "cells") else REAL
            self._file.dataset(f"attractors/{name}", capacity, kinds)
            columns[name] = self._file.values(f"attractors/{name}", slice(0, count))
        self._check_values(columns)
        return Attractors(**columns)


def _edges(centres):
    """Borders (n+1,) half-way between the centres (n,); the outer ones as far out as their inner neighbours."""
    inner = (centres[:-1] + centres[1:]) / 2
    return np.concatenate([[2 * centres[0] - inner[0]], inner, [2 * centres[-1] - inner[-1]]])


def _evenly_spaced_in_log(values):
    if len(values) < 3 or values[0] <= 0:
        return False
    linear, log = np.diff(values), np.diff(np.log(values))
    return bool(np.ptp(log) < 1e-6 * log.mean() and np.ptp(linear) > 1e-3 * linear.mean())
