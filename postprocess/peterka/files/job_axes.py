"""Names of the coordinates of a job: of its axes, columns first, then rows; and those that it gives in SI units."""

import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

from .coordinates import RATIOS, leads_in_si

LISTS = ("sweep", "operating_point")  # tables that give coordinates beside [axes]


def axes_of_job(text: object) -> list[str]:
    """["contact_stiffness_n_per_m", "gap_ratio"] from a job's text; [] if it names none."""
    tables = _job(text).get("axes", {})
    return [name for name, _ in _tables(tables, "")] if isinstance(tables, dict) else []


def points_of_job(text: object) -> dict[str, object]:
    """How many points a job's axes have, by their names."""
    tables = _job(text).get("axes", {})
    return {name: table.get("points") for name, table in _tables(tables, "")} if isinstance(tables, dict) else {}


def given_in_si(text: object) -> frozenset[str]:
    """The coordinates, by the names of their ratios, that a job gives in SI units, on an axis, in a list or as one value:
    these are told in Hz, mm and m/s first."""
    names = set(axes_of_job(text))
    for table in (_job(text).get(name) for name in LISTS):
        names |= set(table) if isinstance(table, dict) else set()
    return frozenset(RATIOS[name] for name in names if leads_in_si(name))


def _job(text: object) -> dict[str, Any]:
    try:
        return tomllib.loads(text) if isinstance(text, str) else {}
    except (tomllib.TOMLDecodeError, RecursionError):
        return {}


def _tables(tables: Mapping[str, Any], before: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for key, table in tables.items():
        if not isinstance(table, dict):
            continue
        if "from" in table:
            yield before + key, table
        elif not before:
            yield from _tables(table, f"{key}_")
