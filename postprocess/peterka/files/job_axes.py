"""Names of the coordinates of a map or sweep, in the order of its job's axes: columns first, then rows."""

import tomllib


def axes_of_job(text: object) -> list[str]:
    """["contact_stiffness_n_per_m", "gap_ratio"] from a job's text; [] if it names none."""
    try:
        tables = tomllib.loads(text).get("axes", {}) if isinstance(text, str) else {}
    except (tomllib.TOMLDecodeError, RecursionError):
        return []
    return list(_names(tables, "")) if isinstance(tables, dict) else []


def _names(tables, before):
    for key, table in tables.items():
        if not isinstance(table, dict):
            continue
        if "from" in table:
            yield before + key
        elif not before:
            yield from _names(table, f"{key}_")
