"""The stop from measured restitutions and contact times: single values, or a table of impacts.

    restitution, or speed_before_m_s and speed_after_m_s
    contact_time_s or contact_time_ms
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..arrays import Reals
from ..files.csv_table import CsvTable, read_csv_table
from .contact_pulse import identified
from .numbers_found import Identified, Number, identified_stop

COLUMNS = ("restitution", "speed_before_m_s", "speed_after_m_s", "contact_time_s", "contact_time_ms")
LARGEST_BYTES = 2**24


def from_impact(mass: float, restitution: Number, contact_s: Number) -> Identified:
    """The Identified from two Numbers; errors of None count as 0."""
    values = restitution.value, contact_s.value
    covariance = np.diag([(number.error or 0.0) ** 2 for number in (restitution, contact_s)])
    stiffness, damping = identified(mass, *values)
    slopes = _slopes(mass, values)
    return identified_stop(mass, stiffness, damping, slopes @ covariance @ slopes.T)


def read_impacts(path: Path) -> tuple[Number, Number]:
    """(restitution, contact time [s]) as Numbers from a table of impacts: means, with standard errors from their scatter."""
    table = read_csv_table(path, COLUMNS, "impacts", LARGEST_BYTES)
    speeds = {"speed_before_m_s", "speed_after_m_s"}
    one_time = len({"contact_time_s", "contact_time_ms"} & set(table.names)) == 1
    if not one_time or ("restitution" in table.names) == bool(speeds & set(table.names)) or (
            speeds & set(table.names) and not speeds <= set(table.names)):
        raise table.refusal("needs restitution, or speed_before_m_s and speed_after_m_s, and contact_time_s or contact_time_ms")
    rows = [_impact(table, line, cells) for line, cells in table.rows]
    means = np.mean(rows, axis=0)
    errors = np.std(rows, axis=0, ddof=1) / np.sqrt(len(rows)) if len(rows) > 1 else (None, None)
    restitution, contact_s = (Number(float(mean), None if error is None else float(error)) for mean, error in zip(means, errors))
    return restitution, contact_s


def _impact(table: CsvTable, line: int, cells: dict[str, str]) -> tuple[float, float]:
    numbers = {name: number for name in cells if (number := table.number(line, cells, name)) is not None}
    if len(numbers) < len(cells):
        raise table.refusal("has an empty cell; every impact needs all its numbers", line)
    if "restitution" in numbers:
        restitution = numbers["restitution"]
    else:
        before, after = abs(numbers["speed_before_m_s"]), abs(numbers["speed_after_m_s"])
        restitution = after / before if before else np.inf
    contact_s = numbers.get("contact_time_s", 1e-3 * numbers.get("contact_time_ms", 0))
    fault = fault_of(restitution, contact_s)
    if fault:
        raise table.refusal(fault, line)
    return restitution, contact_s


def fault_of(restitution: float, contact_s: float) -> str:
    """The fault of a measured impact, in words; empty if there is none."""
    if not 1e-9 < restitution <= 1:
        return f"has a restitution of {restitution:.4g}; a stop sends a hammer back with a share of its speed, above 0 up to 1"
    return "" if 0 < contact_s < np.inf else f"has a contact time of {contact_s:.4g} s; it must be above 0"


def _slopes(mass: float, values: Sequence[float]) -> Reals:
    """Derivatives of ki and ci with respect to restitution and contact time, (2, 2)."""
    columns = []
    for column, value in enumerate(values):
        step = 1e-5 * min(value, 1 - value if column == 0 and value < 1 else value)
        ends = [list(values), list(values)]
        ends[0][column] -= step
        ends[1][column] += step if column or value < 1 else 0
        low, high = (np.array(identified(mass, *end)) for end in ends)
        columns.append((high - low) / (ends[1][column] - ends[0][column]))
    return np.transpose(columns)


