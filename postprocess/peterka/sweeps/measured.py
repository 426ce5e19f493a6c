"""Points that somebody measured, from a CSV file, for drawing over a sweep.

One point a line, named columns in any order, each in SI-like units or as the ratio of the pictures:

    frequency_hz or frequency_ratio          always
    force_n or force_ratio                   peak force, F or F/(m g)
    displacement_mm or displacement_ratio    hammer, x or x/A0
    gap_mm or gap_ratio                      needed where the sweep has several gaps
    natural_frequency_hz                     of the rig; points of other rigs are left out
    label                                    written beside the point

Columns are parted by commas, or by semicolons or tabs, and then numbers may have decimal commas. A cell may be empty. A point with a frequency alone is a mark on the frequency axis. Lines that begin with # are comments.
"""

from dataclasses import dataclass, replace

from ..files.checked_hdf5 import NotDrawable
from ..files.csv_table import read_csv_table
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
    if file.axis_name != "frequency_ratio":
        raise NotDrawable(f"{file.path} runs over {file.axis_name}; measured points are drawn over frequency_ratio")
    table = read_csv_table(path, COLUMNS, "points", MAX_BYTES)
    _check_names(table)
    factors = _factors(path, file, table.names)
    points, other_rigs, other_gaps = [], 0, []
    for line, cells in table.rows:
        numbers = {name: table.number(line, cells, name) for name in cells if name != "label"}
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


def _check_names(table):
    both = [pair for pair in PAIRS.values() if set(pair) <= set(table.names)]
    if both:
        raise table.refusal(f"has {' and '.join(both[0])}; each quantity has one column")
    if not set(PAIRS["frequency"]) & set(table.names):
        raise table.refusal("has no column frequency_hz or frequency_ratio; every point needs a frequency")


def _factors(path, file, names):
    """Of each column in SI-like units: how many of them are a ratio of 1."""
    hertz, metres = file.positive("natural_frequency_hz"), file.positive("cart_amplitude_m")
    factors = {"frequency_hz": hertz, "force_n": file.newtons,
               "displacement_mm": metres and 1000 * metres, "gap_mm": metres and 1000 * metres}
    for name in names:
        if name in factors and factors[name] is None:
            raise NotDrawable(f"{path} has a column {name}, and {file.path} doesn't say what a ratio of 1 is in that unit")
    return factors


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
