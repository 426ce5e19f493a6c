"""Points that somebody measured, from a CSV file, for drawing over a sweep.

One point a line, named columns in any order, each in SI-like units or as the ratio of the pictures:

    frequency_hz or frequency_ratio          always
    force_n or force_ratio                   peak force, F or F/(m g)
    displacement_mm or displacement_ratio    hammer, x or x/A0
    gap_mm or gap_ratio                      needed where the sweep has several gaps
    natural_frequency_hz                     of the rig; points of other rigs are left out
    label                                    written beside the point

A cell may be empty. A point with a frequency alone is a mark on the frequency axis. Lines that begin with # are comments.
"""

import csv
from dataclasses import dataclass, replace

import numpy as np

from ..files.checked_hdf5 import NotDrawable
from ..files.harmless import harmless

PAIRS = {
    "frequency": ("frequency_ratio", "frequency_hz"),
    "force": ("force_ratio", "force_n"),
    "displacement": ("displacement_ratio", "displacement_mm"),
    "gap": ("gap_ratio", "gap_mm"),
}
COLUMNS = (*(name for pair in PAIRS.values() for name in pair), "natural_frequency_hz", "label")
MAX_BYTES, MAX_LABEL = 2**24, 60
MOST_LABELS = 200  # of all points
SAME = 0.02  # gaps, in A0, and natural frequencies, relative, that differ by less are the same


@dataclass(frozen=True)
class Point:
    """Ratios of the pictures; None where the point has no such number. `gap` is one of the sweep's gaps, or None."""

    frequency: float
    force: float | None
    displacement: float | None
    gap: float | None
    label: str


@dataclass(frozen=True)
class Measurements:
    points: list[Point]
    left_out: list[str]  # sentences

    def at_gap(self, gap):
        return [point for point in self.points if point.gap is None or point.gap == gap]


NOTHING_MEASURED = Measurements([], [])


def read_measurements(path, file):
    """The points of a CSV file that belong to this sweep, in its ratios."""
    if file.kind != "sweep":
        raise NotDrawable(f"{file.path} is of kind {file.kind}; measured points are drawn over a sweep")
    rows = _rows(path)
    factors = _factors(path, file, rows[0][1].keys())
    points, other_rigs, other_gaps = [], 0, []
    for line, cells in rows:
        numbers = {name: _number(path, line, name, cells[name]) for name in cells if name != "label"}
        ratios = {quantity: _ratio(numbers, pair, factors) for quantity, pair in PAIRS.items()}
        if ratios["frequency"] is None or not ratios["frequency"] > 0:
            raise NotDrawable(f"{path}:{line} has no frequency above 0; every point needs one")
        if _is_of_another_rig(numbers.get("natural_frequency_hz"), file):
            other_rigs += 1
            continue
        gap = _gap(path, line, ratios["gap"], file)
        if gap is False:
            other_gaps.append(f"{ratios['gap']:.4g}")
            continue
        label = harmless((cells.get("label") or "").strip(), MAX_LABEL)
        points.append(Point(ratios["frequency"], ratios["force"], ratios["displacement"], gap, label))
    left_out = [f"{path}: {other_rigs} points of rigs with another natural frequency are left out"] * (other_rigs > 0)
    if other_gaps:
        left_out.append(f"{path}: {len(other_gaps)} points at gap/A0 {', '.join(dict.fromkeys(other_gaps))} are left out;"
                        " the sweep has no such gap")
    labelled = [number for number, point in enumerate(points) if point.label]
    if len(labelled) > MOST_LABELS:
        left_out.append(f"{path}: {len(labelled) - MOST_LABELS} of {len(labelled)} labels are left out; no more can be read")
        for number in labelled[MOST_LABELS:]:
            points[number] = replace(points[number], label="")
    return Measurements(points, left_out)


def _rows(path):
    """(line number, {column: text}) of each point; at least one."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise NotDrawable(f"{path} is too large for a list of measured points")
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise NotDrawable(f"{path} cannot be read: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise NotDrawable(f"{path} is not a text in UTF-8; save it as CSV") from error
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1)
             if line.strip() and not line.startswith("#")]
    try:
        cells = list(csv.reader([line for _, line in lines]))
    except csv.Error as error:
        raise NotDrawable(f"{path} is no list of measured points: {error}") from error
    if len(cells) < 2:
        raise NotDrawable(f"{path} has no points; it needs a line with the names of its columns and one for each point")
    names = [name.strip() for name in cells[0]]
    _check_names(path, names)
    for (number, _), row in zip(lines[1:], cells[1:]):
        if len(row) != len(names):
            raise NotDrawable(f"{path}:{number} has {len(row)} cells, and its first line names {len(names)} columns")
    return [(number, dict(zip(names, row))) for (number, _), row in zip(lines[1:], cells[1:])]


def _check_names(path, names):
    for name in names:
        if name not in COLUMNS:
            raise NotDrawable(f"{path} has the unknown column '{harmless(name, 40)}'; it may have {', '.join(COLUMNS)}")
    twice = {name for name in names if names.count(name) > 1}
    both = [pair for pair in PAIRS.values() if set(pair) <= set(names)]
    if twice or both:
        which = " and ".join(both[0]) if both else f"{min(twice)} twice"
        raise NotDrawable(f"{path} has {which}; each quantity has one column")
    if not set(PAIRS["frequency"]) & set(names):
        raise NotDrawable(f"{path} has no column frequency_hz or frequency_ratio; every point needs a frequency")


def _factors(path, file, names):
    """Of each column in SI-like units: how many of them are a ratio of 1."""
    hertz, metres = file.positive("natural_frequency_hz"), file.positive("cart_amplitude_m")
    factors = {"frequency_hz": hertz, "force_n": file.newtons,
               "displacement_mm": metres and 1000 * metres, "gap_mm": metres and 1000 * metres}
    for name in names:
        if name in factors and factors[name] is None:
            raise NotDrawable(f"{path} has a column {name}, and {file.path} doesn't say what a ratio of 1 is in that unit")
    return factors


def _number(path, line, name, text):
    if not text.strip():
        return None
    try:
        number = float(text)
    except ValueError:
        number = np.nan
    if not np.isfinite(number):
        raise NotDrawable(f"{path}:{line} has '{harmless(text, 40)}' as {name}; a number is needed")
    return number


def _ratio(numbers, pair, factors):
    ratio, unit = pair
    if numbers.get(unit) is not None:
        return numbers[unit] / factors[unit]
    return numbers.get(ratio)


def _is_of_another_rig(hertz, file):
    own = file.positive("natural_frequency_hz")
    return hertz is not None and own is not None and abs(hertz / own - 1) > SAME


def _gap(path, line, gap, file):
    """The sweep's gap; None for a point of all gaps, False for one of no gap of the sweep."""
    if gap is None:
        if len(file.gaps) > 1:
            raise NotDrawable(f"{path}:{line} has no gap, and the sweep has {len(file.gaps)} of them; add gap_mm or gap_ratio")
        return None
    nearest = min(file.gaps, key=lambda own: abs(own - gap))
    return nearest if abs(nearest - gap) < SAME else False
