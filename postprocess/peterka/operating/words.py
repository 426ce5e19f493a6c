"""The results, in words and as a table."""

from collections.abc import Mapping, Sequence

import numpy as np

from ..arrays import Reals
from ..files.coordinates import TWINS
from ..plotting import units
from ..plotting.coordinates import in_words, label, spoken, without_symbol
from ..maps.map_file import Axis, PeterkaFile
from .admitted import ANY, JOB, OVER_WEIGHT, Quantity, weights_of
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
    words, kept = [], []
    for axis, along in ((file.columns, columns), (file.rows, rows)):
        unit = unit_of(file, axis.name)
        if unit is not None and along.width > 0:
            words.append(f"±{along.width * unit.factor:.4g} {unit.unit}")
        elif unit is None:
            kept.append(_named(file, axis)[0])
    as_set = [f"{' and '.join(kept)} as {'it is' if len(kept) == 1 else 'they are'} set"] if kept else []
    return ", ".join([f"drift {', '.join(words)}" if words else "no drift", *as_set])


def drifts(rows: Reach, columns: Reach) -> bool:
    """Whether there is a drift at all."""
    return rows.width > 0 or columns.width > 0


def at_drift(file: PeterkaFile, rows: Reach, columns: Reach) -> str:
    """The drift in a refusal, with how far boxes reach where that is farther."""
    boxes = boxes_in_words(file, rows, columns)[1]
    return f"at a {drift_in_words(file, rows, columns)}{f', where {boxes}' if boxes else ''}" if drifts(rows, columns) else "even without drift"


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
    return ", ".join(on_axis(file, axis, axis.values[at]) for axis, at in ((file.columns, place.column), (file.rows, place.row)))


def on_axis(file: PeterkaFile, axis: Axis, value: float, digits: int = 5) -> str:
    """A place on an axis."""
    if axis.name in TWINS:
        return in_words(file, axis, value, digits)
    what, unit, factor = _named(file, axis)
    return f"{what} {value * factor:.{digits}g} {unit}".rstrip()


def table(file: PeterkaFile, places: Sequence[Place], quantity: Quantity, share: str | None) -> list[str]:
    """The table of the Places, as lines; `share`: what theirs is called, None where it isn't told."""
    heads = [_head(file, file.columns), _head(file, file.rows)]
    names = ["", "z", *heads, f"worst of its box [{quantity.unit}]", f"at the place [{quantity.unit}]"]
    names += [share] if share else []
    lines = []
    for number, place in enumerate(places, 1):
        cells = [str(number), place.z,
                 *(f"{axis.values[at] * _named(file, axis)[2]:.5g}" for axis, at in ((file.columns, place.column), (file.rows, place.row))),
                 units.number(place.worst, 4), units.number(place.value, 4)]
        lines.append(cells + ([f"{100 * place.share:.4g} %"] if share else []))
    widths = [max(len(line[n]) for line in [names, *lines]) for n in range(len(names))]
    return ["  ".join(cell.rjust(width) for cell, width in zip(line, widths)) for line in [names, *lines]]


def best_lines(file: PeterkaFile, place: Place, quantity: Quantity, fields: Mapping[str, float]) -> list[str]:
    """Describes the best place; `fields` {dataset: the file's value there}, NaN where it has none."""
    weights, fields = weights_of(file), {name: value for name, value in fields.items() if np.isfinite(value)}
    lines = [f"best: {place_in_words(file, place)}, {'commonest motion' if place.motion else 'z'} = {place.z}: at least "
             f"{units.amount(place.worst, quantity.unit, 4)} in all cells of its box"]
    there = []
    if "peak_force_ratio" in fields:
        force = fields["peak_force_ratio"]
        there.append(f"peak force {force:.4g} {OVER_WEIGHT}" if weights is None else
                     f"peak force {units.amount(force * weights[place.row, place.column], 'N', 4)}")
    if "contact_power_w" in fields:
        there.append(f"power into the contact {units.amount(fields['contact_power_w'], 'W', 4)}")
    if "impact_speed" in fields:
        there.append(f"impact speed {units.amount(fields['impact_speed'], 'm/s', 4)}")
    return [*lines, "  there, from the job's own start: " + ", ".join(there)] if there else lines


def _span(numbers: Reals, unit: str) -> str:
    low, high = (f"{number:.3g}" for number in (numbers.min(), numbers.max()))
    return f"{low} {unit}" if low == high else f"{low} to {high} {unit}"


def _head(file: PeterkaFile, axis: Axis) -> str:
    what, unit, _ = _named(file, axis)
    return f"{what} [{unit}]" if unit else what


def _named(file: PeterkaFile, axis: Axis) -> tuple[str, str, float]:
    """What an axis runs over, its unit, empty for a pure number, and how many of these its number 1 is."""
    if unit := spoken(file, axis.name):
        return unit.what, unit.unit, unit.factor
    if axis.name in TWINS:
        return axis.name, "", 1.0
    what, _, told = label(axis.name).partition(" (")
    return without_symbol(what), told.rstrip(")").replace("$", ""), 1.0
