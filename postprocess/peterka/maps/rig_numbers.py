"""The numbers of the rig and of its place on which results depend, as a file's axes and its job tell them: their values in each cell,
and how well [uncertainty] says that they are known.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Reals
from ..files.coordinates import RATIOS, unit_of
from ..files.job_numbers import UnreadableJob, number_of, tables_of
from ..files.opened import OpenedFile
from .map_file import PeterkaFile


@dataclass(frozen=True)
class Along:
    """A coordinate of all cells: its `name` as shown and as `stored`, and `values` in the former, broadcastable to [rows][columns]; times
    `unit` they are those stored."""

    name: str
    stored: str
    unit: float
    values: Reals


def along_axes(file: PeterkaFile) -> list[Along]:
    """The axes of a map."""
    return [Along(axis.name, axis.stored, axis.unit, axis.values.reshape(shape))
            for axis, shape in ((file.columns, (1, -1)), (file.rows, (-1, 1)))]


def values_of(file: OpenedFile, coordinates: Sequence[Along], number: str) -> float | Reals | None:
    """A number [SI], named as in the datasets of elasticities: for all cells, or along the coordinate that varies it; None where the file
    doesn't tell it."""
    tables = _tables(file)
    if tables is None:
        return None
    value = _values(file, coordinates, tables, _paths(number)[0])
    if value is None and number in RATIOS:
        ratio, one = number_of(tables, _paths(number)[1]), unit_of(file, number)
        return ratio * one if ratio is not None and one else None
    return value


def deviation_of(file: PeterkaFile, number: str) -> float | Reals | None:
    """The relative standard deviation that [uncertainty] gives a number, for all cells or for each row or column; None where it is
    certain, or the file doesn't tell the number itself."""
    tables = _tables(file)
    spreads = None if tables is None else tables.get("uncertainty")
    if tables is None or not isinstance(spreads, dict) or not spreads.get("rigs"):
        return None
    for path in _paths(number):
        table, key = path.split(".")
        spread = spreads.get(table, {}).get(key) if isinstance(spreads.get(table), dict) else None
        absolute = _identified(spreads, path)
        if isinstance(spread, dict):
            if "relative" in spread:
                return float(spread["relative"])
            absolute = float(spread.get("standard_deviation", (spread.get("to", 0.0) - spread.get("from", 0.0)) / 12**0.5))
        if absolute is not None:
            value = _values(file, along_axes(file), tables, path)
            with np.errstate(divide="ignore"):
                return None if value is None else absolute / np.abs(value)
    return None


def _tables(file: OpenedFile) -> dict[str, Any] | None:
    try:
        return tables_of(file.data.attribute("job"))
    except UnreadableJob:
        return None


def _paths(number: str) -> list[str]:
    """Where a job may tell a number, or how uncertain it is: of a place in SI units, then as a ratio."""
    if number in RATIOS:
        return [f"operating_point.{number}", f"operating_point.{RATIOS[number]}"]
    table, _, key = number.partition("_")
    return [f"{table}.{key}"]


def _identified(spreads: Mapping[str, Any], path: str) -> float | None:
    """The standard deviation of a number that is identified together with others."""
    covariance: Any = spreads.get("covariance")
    try:
        n = covariance["of"].index(path)
        return math.sqrt(covariance["matrix"][n][n])
    except (TypeError, KeyError, ValueError, IndexError):
        return None


def _values(file: OpenedFile, coordinates: Sequence[Along], tables: Mapping[str, Any], path: str) -> float | Reals | None:
    """The number at a path, along the coordinate that varies it; None if neither these nor the job tell it."""
    key = path.removeprefix("operating_point.").replace(".", "_")
    for along in coordinates:
        if along.stored == key:
            return along.values * along.unit
        if along.name in (key, RATIOS.get(key)):
            one = unit_of(file, along.name) if key in RATIOS else 1.0
            return along.values * one if one else None
    return number_of(tables, path) or None
