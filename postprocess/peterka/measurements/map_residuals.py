"""How far measured forces are from a map: each from the cell in which its point lies, as a table."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..files.regimes import NAMES, NOT_COMPUTED, PERIODIC
from ..look.drawn import Plane
from . import tables
from .points import AXES, Point


class Map(Plane, Protocol):
    """A map, whose cells are read in bands of rows."""

    @property
    def newtons(self) -> float | None: ...

    def band(self, names: Iterable[str], first: int, last: int) -> dict[str, NDArray[Any]]: ...


@dataclass(frozen=True)
class CellResidual:
    """`force` of the cell [F/(m g)], NaN where it has none, and its `motion` in words."""

    point: Point
    force: float
    motion: str


def residuals(file: Map, points: Iterable[Point]) -> list[CellResidual]:
    """[CellResidual] of the points with a force, in their order."""
    return [_of_cell(file, point) for point in points if point.force is not None]


def table(file: Map, found: Sequence[CellResidual]) -> list[str]:
    """Lines; in Hz, mm and N where the file tells the rig."""
    along = file.rows.name, file.columns.name
    hertz = 1.0 if "frequency_hz" in along else file.positive("natural_frequency_hz")
    metres = 1.0 if "gap_m" in along else file.positive("cart_amplitude_m")
    newtons = file.newtons
    units = "Hz" if hertz else "Omega/omega", "mm" if metres else "gap/A0", "N" if newtons else "F/(m g)"
    heads = (f"frequency [{units[0]}]", f"gap [{units[1]}]", f"measured [{units[2]}]", f"computed [{units[2]}]", "motion", "off by",
             "label")
    return tables.lines(heads, [_cells(one, hertz or 1, 1000 * metres if metres else 1, newtons or 1) for one in found])


def _cells(one, hertz, millimetres, newtons):
    """Of a row: factors are those from the numbers of the file."""
    return (f"{one.point.frequency * hertz:.5g}", f"{one.point.gap * millimetres:.4g}",
            *(f"{force * newtons:.4g}" for force in (one.point.force, one.force)), one.motion,
            tables.share(one.point, one.force), tables.name_of(one.point))


def _of_cell(file, point):
    row, column = (int(np.clip(np.searchsorted(axis.edges, getattr(point, AXES[axis.name]), side="right") - 1, 0,
                               len(axis.values) - 1)) for axis in (file.rows, file.columns))
    band = file.band(["regime", "impacts", "period", "peak_force_ratio"], row, row + 1)
    regime, p, q = (int(band[name][0, column]) for name in ("regime", "impacts", "period"))
    motion = f"{p}/{q}" if regime == PERIODIC else "not computed yet" if regime == NOT_COMPUTED else NAMES[regime]
    return CellResidual(point, float(band["peak_force_ratio"][0, column]), motion)
