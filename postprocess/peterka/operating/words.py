"""The results, in words and as a table."""

from collections.abc import Mapping, Sequence

import numpy as np

from ..arrays import Reals
from ..plotting import units
from ..plotting.coordinates import in_words, spoken
from ..maps.map_file import Axis, PeterkaFile
from .admitted import ANY, JOB, Quantity
from .drift import Reach, unit_of
from .places import Place

SAME = 1e-6  # relative: a box as wide as the drift but for rounding


def starts_in_words(starts: str | float) -> str:
    """Describes the starts considered."""
    if starts == JOB:
        return "from the job's own start"
    return "from every start tried" if starts == ANY else f"from {100 * starts:g} % of the starts"


def drift_in_words(file: PeterkaFile, rows: Reach, columns: Reach) -> str:
    """Describes the drift along both axes, those in Hz and mm first."""
    words = []
    for axis, along in ((file.columns, columns), (file.rows, rows)):
        unit = unit_of(file, axis.name)
        if unit is not None and along.width > 0:
            words.append(f"±{along.width * unit.factor:.4g} {unit.unit}")
        elif unit is None:
            words.append(f"{axis.name} as it is set")
    return "drift " + (", ".join(words) or "none")


def boxes_in_words(file: PeterkaFile, rows: Reach, columns: Reach) -> tuple[str, str]:
    """How far the map's cells lie apart, and how far boxes reach to either side; empty where that is as far as the drift."""
    apart, reaching, wider = [], [], False
    for axis, along in ((file.columns, columns), (file.rows, rows)):
        unit = unit_of(file, axis.name)
        if unit is None or not along.width > 0 or not along.inside.any():
            continue
        boxes = [(axis.values[at], *along.ends(axis.values, at)) for at in np.flatnonzero(along.inside)]
        reach = np.array([max(middle - low, high - middle) for middle, low, high in boxes])
        wider |= bool(reach.max() > along.width * (1 + SAME))
        apart.append(_span(np.diff(axis.values) * unit.factor, unit.unit))
        reaching.append(f"±{_span(reach * unit.factor, unit.unit)}")
    return (f"the map's cells are {' and '.join(apart)} apart", f"boxes are {' and '.join(reaching)}") if wider else ("", "")


def place_in_words(file: PeterkaFile, place: Place) -> str:
    """Where a place is."""
    return ", ".join(in_words(file, axis, axis.values[at]) for axis, at in ((file.columns, place.column), (file.rows, place.row)))


def table(file: PeterkaFile, places: Sequence[Place], quantity: Quantity, share: str | None) -> list[str]:
    """The table of the Places, as lines; `share`: what theirs is called, None where it isn't told."""
    heads = [_head(file, file.columns), _head(file, file.rows)]
    names = ["", "z", *heads, f"worst of its box [{quantity.unit}]", f"at the place [{quantity.unit}]"]
    names += [share] if share else []
    lines = []
    for number, place in enumerate(places, 1):
        cells = [str(number), place.z,
                 *(f"{_number(file, axis, at):.5g}" for axis, at in ((file.columns, place.column), (file.rows, place.row))),
                 units.number(quantity.factor * place.worst, 4), units.number(quantity.factor * place.value, 4)]
        lines.append(cells + ([f"{100 * place.share:.4g} %"] if share else []))
    widths = [max(len(line[n]) for line in [names, *lines]) for n in range(len(names))]
    return ["  ".join(cell.rjust(width) for cell, width in zip(line, widths)) for line in [names, *lines]]


def best_lines(file: PeterkaFile, place: Place, quantity: Quantity, fields: Mapping[str, float]) -> list[str]:
    """Describes the best place; `fields` {dataset: the file's value there}, NaN where it has none."""
    newtons, fields = file.newtons, {name: value for name, value in fields.items() if np.isfinite(value)}
    lines = [f"best: {place_in_words(file, place)}, {'commonest motion' if place.motion else 'z'} = {place.z}: at least "
             f"{units.amount(quantity.factor * place.worst, quantity.unit, 4)} in all cells of its box"]
    there = []
    if "peak_force_ratio" in fields:
        force = fields["peak_force_ratio"]
        there.append(f"peak force {units.amount(force * newtons, 'N', 4)}" if newtons else f"peak force {force:.4g} F/(m g)")
    if "contact_power_w" in fields:
        there.append(f"power into the contact {units.amount(fields['contact_power_w'], 'W', 4)}")
    if "impact_speed" in fields:
        there.append(f"impact speed {units.amount(fields['impact_speed'], 'm/s', 4)}")
    return [*lines, "  there, from the job's own start: " + ", ".join(there)] if there else lines


def _span(numbers: Reals, unit: str) -> str:
    low, high = (f"{number:.3g}" for number in (numbers.min(), numbers.max()))
    return f"{low} {unit}" if low == high else f"{low} to {high} {unit}"


def _head(file: PeterkaFile, axis: Axis) -> str:
    unit = spoken(file, axis.name)
    return f"{unit.what} [{unit.unit}]" if unit else axis.name


def _number(file: PeterkaFile, axis: Axis, at: int) -> float:
    unit = spoken(file, axis.name)
    value: float = axis.values[at] * (unit.factor if unit else 1.0)
    return value
