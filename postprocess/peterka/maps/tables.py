"""Checked tables that a map file may contain besides its cells: attractors of a basin, audited cells."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers, Mask, Reals
from ..files.checked_hdf5 import INTEGER, REAL, Content
from ..files.regimes import check_labels

MAX_ATTRACTORS = 4096
MAX_SAMPLES = 2**20


@dataclass(frozen=True)
class Attractors:
    """The table of a basin file, one row per attractor; every member has shape (count,)."""

    regime: Integers
    impacts: Integers
    period: Integers
    peak_force_ratio: Reals  # F/(m g)
    orbit_displacement: Reals  # (x - y)/A0 at forcing phase 0
    orbit_velocity: Reals  # (x' - y')/(A0 omega) at forcing phase 0
    cells: Integers

    @property
    def count(self) -> int:
        """Number of attractors."""
        return len(self.regime)


@dataclass(frozen=True)
class Audit:
    """Cells of a map solved again by an independent engine; every member has shape (count,)."""

    row: Integers
    column: Integers
    regime: Integers  # these three: result of the audit
    impacts: Integers
    period: Integers
    force_error: Reals  # of the map's peak force relative to the audit's; NaN where not comparable
    agrees: Mask  # bool: same regime, impacts and period

    @property
    def count(self) -> int:
        """Number of audited cells."""
        return len(self.row)

    def within(self, rows: slice, columns: slice) -> "Audit":
        """Of the part of the map that these rows and columns are, counted from its own first ones."""
        inside = (self.row >= rows.start) & (self.row < rows.stop) & (self.column >= columns.start) & (self.column < columns.stop)
        part = {name: getattr(self, name)[inside] for name in self.__dataclass_fields__}
        return Audit(**part | {"row": part["row"] - rows.start, "column": part["column"] - columns.start})


def read_attractors(data: Content, shape: tuple[int, ...]) -> Attractors:
    """The Attractors of a basin file with cells of this shape."""
    data.dataset("attractor", shape, INTEGER)
    data.dataset("attractors/count", (), INTEGER)
    count = int(data.values("attractors/count", ()))
    capacity = data.dataset("attractors/regime", None, INTEGER).shape
    if len(capacity) != 1 or not 0 <= count <= min(capacity[0], MAX_ATTRACTORS):
        raise data.refusal(f"says it has {count} attractors, in a table of shape {capacity}")
    columns = _columns(data, "attractors", Attractors, capacity, slice(0, count))
    check_labels(data, columns)
    return Attractors(**columns)


def read_audit(data: Content, shape: tuple[int, ...]) -> Audit | None:
    """The Audit of a map with cells of this shape, without samples not yet solved; None without an audit, and for a part of
    a map, whose cell numbers differ."""
    if not data.has("audit"):
        return None
    capacity = data.dataset("audit/cell", None, INTEGER).shape
    if len(capacity) != 1 or capacity[0] > MAX_SAMPLES:
        raise data.refusal(f"has an audit of shape {capacity}")
    columns = _columns(data, "audit", Audit, capacity, slice(None)) | {"cell": data.values("audit/cell", slice(None))}
    solved = (columns["agrees"] == 0) | (columns["agrees"] == 1)
    columns = {name: column[solved] for name, column in columns.items()}
    check_labels(data, columns)
    row, column = columns["row"].astype(np.int64), columns["column"].astype(np.int64)
    inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
    if not np.all(inside & (columns.pop("cell") == row * shape[1] + column)):
        if data.may_be_part:
            return None
        raise data.refusal("has an audited cell whose number, row and column don't belong together")
    if np.any(columns["force_error"] < 0):
        raise data.refusal("has an audit with a negative error")
    return Audit(**columns | {"agrees": columns["agrees"] == 1})


def _columns(data: Content, group: str, table: type[Attractors] | type[Audit], capacity: tuple[int, ...],
             rows: slice) -> dict[str, NDArray[Any]]:
    columns = {}
    for name in table.__dataclass_fields__:
        real = name in ("peak_force_ratio", "orbit_displacement", "orbit_velocity", "force_error")
        data.dataset(f"{group}/{name}", capacity, REAL if real else INTEGER)
        columns[name] = data.values(f"{group}/{name}", rows)
    return columns
