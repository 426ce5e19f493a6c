"""Residuals of measured forces against a map: each point against every motion known in the surrounding cells, as a table."""

from collections.abc import Iterable
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..files.job_numbers import UnreadableJob, swing_of, tables_of
from ..files.regimes import NAMES, NOT_COMPUTED, NO_IMPACT, PERIODIC
from ..plotting.drawn import Plane, PlaneAxis
from . import tables
from .matches import Known, Match, Place, around, distance, matches
from .points import AXES, Point

CELL = ("regime", "impacts", "period", "peak_force_ratio")
FREE = Known("no impact", "no impact", 0.0, None)
SLOTS = ("attractor_regime", "attractor_impacts", "attractor_period", "attractor_peak_force_ratio", "basin_share")


class Map(Plane, Protocol):
    """A map, read in bands of rows; `slots`: number of attractors stored per cell."""

    @property
    def newtons(self) -> float | None: ...

    @property
    def slots(self) -> int: ...

    @property
    def data(self) -> Any: ...

    def band(self, names: Iterable[str], first: int, last: int) -> dict[str, NDArray[Any]]: ...


def residuals(file: Map, points: Iterable[Point]) -> list[list[Match]]:
    """The [Match] of each point with a force, in their order."""
    return [matches(point, _places(file, point), _beyond(file, point)) for point in points if point.force is not None]


def table(file: Map, found: list[list[Match]]) -> list[str]:
    """The table as lines; in Hz, mm and N if the file gives the rig."""
    along = file.rows.name, file.columns.name
    metres = 1.0 if "gap_m" in along else file.positive("cart_amplitude_m")
    return tables.table([each for each in found if each], tables.Units(
        1.0 if "frequency_hz" in along else file.positive("natural_frequency_hz"), metres and 1000 * metres, file.newtons))


def _places(file: Map, point: Point) -> list[Place]:
    """The cells between whose centres a point lies: four, or fewer at the border or on a line through centres."""
    places = []
    for row, upward in around(file.rows.values, _along(point, file.rows)):
        band = file.band([*CELL, *(["start_attractor", *SLOTS] if file.slots else [])], row, row + 1)
        for column, across in around(file.columns.values, _along(point, file.columns)):
            away = {AXES[axis.name]: distance(_along(point, axis), axis.values[at]) for axis, at in ((file.rows, row), (file.columns, column))}
            known = known_of_cell({name: values[..., 0, column] for name, values in band.items()})
            if all(one.force > 0 for one in known) and _swings_free(file, row, column):
                known.append(FREE)
            places.append(Place(upward * across, (away["frequency"], away["gap"]), known))
    return places


def _swings_free(file: Map, row: int, column: int) -> bool:
    """Whether the swing without impact, in closed form, stays away from the stop: a motion that exists, whatever a cell's start leads to."""
    place = {axis.name: axis.values[[at]] for axis, at in ((file.rows, row), (file.columns, column))}
    try:
        return bool(swing_of(tables_of(file.data.attribute("job")), place).room()[0] > 0)
    except UnreadableJob:
        return False


def _beyond(file: Map, point: Point) -> tuple[float, float]:
    """Distance of a point beyond the outermost cell centres, (frequency, gap)."""
    away = {AXES[axis.name]: distance(_along(point, axis), np.clip(_along(point, axis), *axis.values[[0, -1]]))
            for axis in (file.rows, file.columns)}
    return away["frequency"], away["gap"]


def _along(point: Point, axis: PlaneAxis) -> float:
    value: float = getattr(point, AXES[axis.name])
    return value


def known_of_cell(cell: dict[str, Any]) -> list[Known]:
    """All motions known to a cell, {dataset: its number, or one per
    slot}: its attractors, and its own motion if that is not among them."""
    found = []
    if "start_attractor" not in cell or cell["start_attractor"] < 0:
        regime, impacts, period, force = (cell[name] for name in CELL)
        found.append(known(regime, impacts, period, force))
    if "basin_share" in cell:
        slots = zip(*(cell[f"attractor_{name}"] for name in CELL), cell["basin_share"])
        found += [known(regime, impacts, period, force, share) for regime, impacts, period, force, share in slots]
    return [one for one in found if one is not None]


def known(regime: int, impacts: int, period: int, force: float, share: float | None = None) -> Known | None:
    """A motion of a file; None if there is none, or none with a force."""
    force = 0.0 if regime == NO_IMPACT else float(force)
    if regime == NOT_COMPUTED or not np.isfinite(force):
        return None
    words = f"{int(impacts)}/{int(period)}" if regime == PERIODIC else NAMES[int(regime)]
    return Known(words, words, force, None if share is None else float(share))
