"""The common points of two maps, or two basins, and the cells of both at these points, band by band.

If the grids differ, these are, along each axis, the points of the coarser grid that coincide with points of the other.
"""

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers, Reals
from ..files.coordinates import Coordinate
from ..plotting.coordinates import called, span_in_words
from .map_file import BAND_CELLS, Axis, PeterkaFile, axis_of

SAME_POINT = 1e-9  # of the length of an axis, or of the value on a logarithmic one: smaller differences are rounding


class CommonPlane:
    """kind, rows and columns (Axis), shape, and the first file's plain attributes: all that drawing axes needs."""

    def __init__(self, first: PeterkaFile, second: PeterkaFile) -> None:
        pairs = [(getattr(first, side), getattr(second, side)) for side in ("rows", "columns")]
        if first.kind == second.kind and any(a.name != b.name and a.stored != b.stored for a, b in pairs):
            raise second.refusal(f"runs over {_axes(second)}, and {first.path} over {_axes(first)}: only cells at the same places "
                                 "can be compared")
        if first.kind != second.kind:
            raise second.refusal(f"is a {second.kind} and {first.path} a {first.kind}: their cells can't be compared")
        self.first, self.second, self.kind = first, second, first.kind
        (self.rows, self._rows), (self.columns, self._columns) = (self._shared(side) for side in ("rows", "columns"))
        self.shape = len(self.rows.values), len(self.columns.values)

    def positive(self, name: str) -> float | None:
        """A scale in SI units; None unless it is the same in both files."""
        mine, other = self.first.positive(name), self.second.positive(name)
        return mine if mine == other else None

    @property
    def given_in_si(self) -> frozenset[str]:
        """The coordinates, by the names of their ratios, that both jobs give in SI units."""
        return self.first.given_in_si & self.second.given_in_si

    @property
    def tells_forces(self) -> bool:
        """Whether both files tell forces in N."""
        return bool(self.first.newtons and self.second.newtons)

    @property
    def weights(self) -> float:
        """The weight of the second file's hammer over that of the first; 1 unless both are told."""
        return self.second.newtons / self.first.newtons if self.first.newtons and self.second.newtons else 1.0

    @property
    def in_words(self) -> str:
        """Which part of each file is common; empty if both are common as a whole."""
        if self.shape == self.first.shape == self.second.shape:
            return ""
        shapes = ["{1} by {0}".format(*shape) for shape in (self.shape, self.first.shape, self.second.shape)]
        return f"compared at the {shapes[0]} points that both have: A has {shapes[1]}, B {shapes[2]}"

    def bands(self, names: Iterable[str],
              multiple: int = 1) -> Iterator[tuple[int, dict[str, NDArray[Any]], dict[str, NDArray[Any]]]]:
        """(first row, {name: array} of A, the same of B); all but the last band have a number of rows divisible by `multiple`."""
        cells = max(self.first.shape[1], self.second.shape[1])
        stride = max(self.first.shape[0], self.second.shape[0]) // self.shape[0] + 1  # rows read per row used
        rows = multiple * max(1, BAND_CELLS // (cells * stride * multiple))
        for row in range(0, self.shape[0], rows):
            yield row, self._band(0, names, row, row + rows), self._band(1, names, row, row + rows)

    def _band(self, which: int, names: Iterable[str], begin: int, end: int) -> dict[str, NDArray[Any]]:
        file, rows, columns = (self.first, self.second)[which], self._rows[which][begin:end], self._columns[which]
        band = file.band(names, int(rows[0]), int(rows[-1]) + 1)
        return {name: values[np.ix_(rows - rows[0], columns)] for name, values in band.items()}

    def _shared(self, side: str) -> tuple[Axis, tuple[Any, Any]]:
        """The Axis of the common points, and their indices in the first and
        the second file: in the common unit, or as ratios if the units differ."""
        axes = getattr(self.first, side), getattr(self.second, side)
        same_unit, shown = axes[0].stored == axes[1].stored, Coordinate(axes[0].name, axes[0].stored, axes[0].unit)
        if same_unit and axes[0].unit != axes[1].unit:  # the same frequencies for rigs with different natural frequencies
            axes = as_stored(axes[0]), as_stored(axes[1])
            shown = Coordinate(axes[0].name, axes[0].stored)
        coarse, fine = sorted(axes, key=lambda axis: len(axis.values))
        nearest = _nearest(fine.values, coarse.values)
        length = (coarse.values[-1] - coarse.values[0]) or abs(coarse.values[0]) or 1
        sizes = np.abs(coarse.values) if coarse.log else length
        same = np.abs(fine.values[nearest] - coarse.values) <= SAME_POINT * sizes
        if same.sum() < min(2, len(coarse.values)):
            a, b = axes
            raise self.second.refusal(f"has {_span(self.second, b)}, and {self.first.path} has {_span(self.first, a)}: only cells at the same places "
                                      "can be compared, two along each axis at least; compute one of them again with an axis "
                                      "whose points fall on the other's")
        of_coarse, of_fine = np.flatnonzero(same), nearest[same]
        indices = (of_coarse, of_fine) if coarse is axes[0] else (of_fine, of_coarse)
        return axis_of(shown.name, coarse.values[same], shown), indices


def as_stored(axis: Axis) -> Axis:
    """The axis in the file's own numbers."""
    return axis_of(axis.stored, axis.values * axis.unit)


def _nearest(fine: Reals, coarse: Reals) -> Integers:
    """Index in `fine` of the value nearest to each value of `coarse`, both ascending."""
    if len(fine) == 1:
        return np.zeros(len(coarse), dtype=int)
    nearest = np.clip(np.searchsorted(fine, coarse), 1, len(fine) - 1)
    numbers: Integers = nearest - (coarse - fine[nearest - 1] < fine[nearest] - coarse)
    return numbers


def _axes(file: PeterkaFile) -> str:
    return f"{called(file, file.columns)} and {called(file, file.rows)}"


def _span(file: PeterkaFile, axis: Axis) -> str:
    spacing = ", evenly in the logarithm" if axis.log else ""
    return f"{len(axis.values)} points of {span_in_words(file, axis, axis.values[0], axis.values[-1])}{spacing}"
