"""Writes a job's tables as TOML, limited to what a job file can hold. (Python's standard library only reads TOML.)"""

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any


def text_of(tables: Mapping[str, Any]) -> str:
    """Values first, then the tables, each under its full name."""
    return "\n".join(_lines(tables, ())) + "\n"


def _lines(table: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    values = {key: value for key, value in table.items() if not isinstance(value, Mapping)}
    if path and (values or not table):
        yield f"[{'.'.join(path)}]"
    yield from (f"{key} = {_value(value)}" for key, value in values.items())
    for key, inner in table.items():
        if isinstance(inner, Mapping):
            yield from _lines(inner, (*path, str(key)))


def _value(value: Any) -> str:
    if hasattr(value, "tolist"):  # numpy's numbers and arrays
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(_value(one) for one in value)}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")  # JSON allows DEL unescaped, TOML does not
    if isinstance(value, float) and not math.isfinite(value):
        return {math.inf: "inf", -math.inf: "-inf"}.get(value, "nan")
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"{value!r} is nothing that a job can hold: numbers, texts, true and false, lists and tables of them")
