"""Measured points from a CSV file, for drawing over a sweep or a map.

One point a line, named columns in any order, each in SI-like units or as the ratio of the pictures:

    frequency_hz or frequency_ratio          always
    force_n, force_kn or force_ratio         peak force, F or F/(m g)
    displacement_mm or displacement_ratio    hammer, x or x/A0
    gap_mm or gap_ratio                      required over a map, and for a sweep with several gaps
    frequency_error_hz, force_error_n, force_error_kn, displacement_error_mm, gap_error_mm, or ..._error_ratio
                                             standard errors, drawn as bars
    natural_frequency_hz                     of the rig; points of other rigs are left out
    series                                   one legend entry per series
    label                                    written beside the point; a label shared by several points is a series

Columns are parted by commas, or by semicolons or tabs, and then numbers may have decimal commas. A cell may be empty.
Points outside a map or the frequencies of a sweep are left out, and counted.
A point with a frequency alone is a mark on the frequency axis of a sweep. Lines that begin with # are comments.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal, Protocol, TypeGuard

from ..arrays import Reals
from ..errors import PeterkaFileError
from ..files.csv_table import CsvTable, read_csv_table
from ..files.harmless import harmless
from ..files.opened import OpenedFile
from ..plotting.drawn import InUnits, Plane

QUANTITIES = ("frequency", "force", "displacement", "gap")
UNITS = {"frequency": "hz", "force": "n", "displacement": "mm", "gap": "mm"}
PAIRS = {name: (f"{name}_ratio", f"{name}_{UNITS[name]}") for name in QUANTITIES}
ERRORS = {name: (f"{name}_error_ratio", f"{name}_error_{UNITS[name]}") for name in QUANTITIES}
THOUSANDS = {"force_kn": "force_n", "force_error_kn": "force_error_n"}  # columns of 1000 of what the other has
COLUMNS = (*(name for pair in (*PAIRS.values(), *ERRORS.values()) for name in pair), *THOUSANDS, "natural_frequency_hz", "series", "label")
TEXTS = ("series", "label")
MAX_BYTES, MAX_LABEL = 2**24, 60
MOST_LABELS = 200  # of all points
MOST_SERIES = 24  # so many marks can be told apart
SAME = 0.02  # gaps, in A0, and natural frequencies, relative, that differ by less are the same
SAME_END = 1e-9  # relative: 15 Hz as a ratio has other last bits
SAME_PLACE = 1e-6  # and these, in A0, are but for rounding
_Scale = tuple[float | None, float | None]  # of a ratio and of an SI-like unit in the numbers of the file
AXES = {"frequency_ratio": "frequency", "frequency_hz": "frequency", "gap_ratio": "gap", "gap_m": "gap"}  # over which points lie


@dataclass(frozen=True)
class Point:
    """Ratios, except `frequency` and `gap`, which are in the numbers of the file's axes; None if the point lacks the number.
    `gap` is one of the sweep's gaps, or None; over a map, any gap. `errors` {quantity: standard error}."""

    frequency: float
    force: float | None
    displacement: float | None
    gap: float | None
    label: str
    series: str = ""
    errors: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Measurements:
    """The result of reading: the points, and sentences on those omitted or moved."""

    points: list[Point]
    left_out: list[str]  # sentences

    def at_gap(self, gap: float | None) -> list[Point]:
        """The points at one of the sweep's gaps, and those of all gaps."""
        return [point for point in self.points if point.gap is None or point.gap == gap]


NOTHING_MEASURED = Measurements([], [])


class _Sweep(InUnits, Protocol):
    """What is asked of a sweep here."""

    axis_name: str
    gap_name: str
    values: Reals

    @property
    def gaps(self) -> list[float | None]: ...


def _is_sweep(file: OpenedFile) -> TypeGuard[_Sweep]:
    return file.kind == "sweep"


def _is_map(file: OpenedFile) -> TypeGuard[Plane]:
    return file.kind == "map"


def read_measurements(path: Path, file: OpenedFile) -> Measurements:
    """The points of a CSV file that belong to this sweep or map, in its numbers. Raises PeterkaFileError for an unusable file."""
    _check_axes(file)
    table = read_csv_table(path, COLUMNS, "points", MAX_BYTES)
    _check_names(table)
    scales, metres = _scales(path, file, [THOUSANDS.get(name, name) for name in table.names]), _metres(file)
    points: list[Point] = []
    other_gaps: list[str] = []
    other_rigs, outside = 0, 0
    moved: dict[float, list[float]] = {}  # for each gap: the distances by which points were moved
    for line, cells in table.rows:
        numbers = _numbers(table, line, cells)
        point = _point(table, line, cells, numbers, scales)
        if _is_of_another_rig(numbers.get("natural_frequency_hz"), file):
            other_rigs += 1
        elif _is_map(file):
            inside = _lies_inside(table, line, point, file)
            points += [point] * inside
            outside += not inside
        elif _is_sweep(file) and lies_between(file.values, point.frequency):
            gap = _gap(table, line, point.gap, file)
            if gap is False:
                assert point.gap is not None
                other_gaps.append(_gap_words(metres, point.gap))
            else:
                points.append(replace(point, gap=gap))
                if gap is not None and point.gap is not None and abs(point.gap - gap) > SAME_PLACE:
                    moved.setdefault(gap, []).append(abs(point.gap - gap))
        else:
            outside += 1
    left_out = [_left_out(path, other_rigs, "of rigs with another natural frequency")] * (other_rigs > 0)
    where = "map" if file.kind == "map" else "frequencies of the sweep"
    left_out += [_left_out(path, outside, f"outside the {where}")] * (outside > 0)
    left_out += [f"{path}: {_points(len(distances), 'is drawn', 'are drawn')} at {_gap_words(metres, gap)}, "
                 f"{'up to ' * (len(distances) > 1)}{_length(metres, max(distances))} from the measured gap"
                 for gap, distances in moved.items()]
    if other_gaps:
        left_out.append(_left_out(path, len(other_gaps), f"at {', '.join(dict.fromkeys(other_gaps))}") + "; the sweep has no such gap")
    if left_out and not points:
        left_out.append(f"{path}: no point is left; {_units_in_words(table.names)}")
    return _with_few_names(path, Measurements(_with_series(points), left_out))


def _units_in_words(names: Sequence[str]) -> str:
    """Of the columns that say where a point lies, in the units that they are read in."""
    spoken = {"frequency_hz": "in hertz", "gap_mm": "in millimetres", "frequency_ratio": "Omega/omega", "gap_ratio": "gap/A0"}
    return ", ".join(f"{name} is {unit}" for name, unit in spoken.items() if name in names)


def _left_out(path: Path, count: int, which: str) -> str:
    return f"{path}: {_points(count, f'{which} is', f'{which} are')} left out"


def _points(count: int, of_one: str, of_many: str) -> str:
    return f"1 point {of_one}" if count == 1 else f"{count} points {of_many}"


def lies_between(values: Reals, x: float) -> bool:
    """Whether ascending numbers reach to x, but for rounding."""
    slack = SAME_END * max(abs(values[0]), abs(values[-1]))
    return bool(values[0] - slack <= x <= values[-1] + slack)


def _check_axes(file: OpenedFile) -> None:
    path = file.path
    if _is_sweep(file):
        if AXES.get(file.axis_name) != "frequency":
            raise PeterkaFileError(f"{path} runs over {file.axis_name}; measured points are drawn over frequencies")
    elif not _is_map(file):
        raise PeterkaFileError(f"{path} is of kind {file.kind}; measured points are drawn over a sweep or a map")
    elif {AXES.get(axis.name) for axis in (file.rows, file.columns)} != {"frequency", "gap"}:
        raise PeterkaFileError(f"{path} runs over {file.columns.name} and {file.rows.name}; measured points are drawn over "
                          "frequencies and gaps")


def _check_names(table: CsvTable) -> None:
    for pair in (*PAIRS.values(), *ERRORS.values()):
        given = [name for name in COLUMNS if name in table.names and THOUSANDS.get(name, name) in pair]
        if len(given) > 1:
            raise table.refusal(f"has {' and '.join(given)}; each quantity has one column")
    if not set(PAIRS["frequency"]) & set(table.names):
        raise table.refusal("has no column frequency_hz or frequency_ratio; every point needs a frequency")


def _numbers(table: CsvTable, line: int, cells: dict[str, str]) -> dict[str, float | None]:
    """The numbers of a line, those of THOUSANDS under the name of the other unit; None of an empty cell."""
    found: dict[str, float | None] = {}
    for name in cells:
        if name not in TEXTS:
            number = table.number(line, cells, name)
            found[THOUSANDS.get(name, name)] = 1e3 * number if number is not None and name in THOUSANDS else number
    return found


def _scales(path: Path, file: OpenedFile, names: Sequence[str]) -> dict[str, _Scale]:
    """For each quantity: the values of a ratio of 1 and of an SI-like unit in the numbers of the file."""
    hertz, metres = file.positive("natural_frequency_hz"), file.positive("cart_amplitude_m")
    along = [file.axis_name] if _is_sweep(file) else [file.rows.name, file.columns.name] if _is_map(file) else []
    of_ratio = {"frequency": hertz, "force": file.newtons, "displacement": metres and 1000 * metres, "gap": metres and 1000 * metres}
    scales: dict[str, _Scale] = {quantity: (1.0, 1 / factor if factor else None) for quantity, factor in of_ratio.items()}
    if "frequency_hz" in along:
        scales["frequency"] = hertz, 1.0
    if "gap_m" in along:
        scales["gap"] = metres, 1e-3
    for quantity, scale in scales.items():
        for pair in (PAIRS[quantity], ERRORS[quantity]):
            for name, factor in zip(pair, scale):
                if name in names and factor is None:
                    raise PeterkaFileError(f"{path} has a column {name}, and {file.path} doesn't say what a ratio of 1 is in SI units")
    return scales


def _point(table: CsvTable, line: int, cells: Mapping[str, str], numbers: Mapping[str, float | None],
           scales: Mapping[str, _Scale]) -> Point:
    """The point with its own gap, not yet matched to the file's."""
    ratios = {name: _scaled(numbers, PAIRS[name], scales[name]) for name in QUANTITIES}
    errors = {name: _scaled(numbers, ERRORS[name], scales[name]) for name in QUANTITIES}
    frequency = ratios["frequency"]
    if frequency is None or not frequency > 0:
        raise table.refusal("has no frequency above 0; every point needs one", line)
    for name, error in errors.items():
        if error is not None and error < 0:
            raise table.refusal(f"has a standard error of {name} below 0", line)
    text = {name: harmless((cells.get(name) or "").strip(), MAX_LABEL) for name in ("label", "series")}
    return Point(frequency, ratios["force"], ratios["displacement"], ratios["gap"], text["label"], text["series"],
                 {name: error for name, error in errors.items() if error and ratios[name] is not None})


def _scaled(numbers: Mapping[str, float | None], pair: tuple[str, str], scale: _Scale) -> float | None:
    return next((number * factor for name, factor in zip(pair, scale) if factor is not None and (number := numbers.get(name)) is not None),
                None)


def _is_of_another_rig(hertz: float | None, file: OpenedFile) -> bool:
    own = file.positive("natural_frequency_hz")
    return hertz is not None and own is not None and abs(hertz / own - 1) > SAME


def _lies_inside(table: CsvTable, line: int, point: Point, file: Plane) -> bool:
    if point.gap is None:
        raise table.refusal("has no gap, and a map has all of them; add gap_mm or gap_ratio", line)
    return all(axis.edges[0] <= getattr(point, AXES[axis.name]) <= axis.edges[-1] for axis in (file.columns, file.rows))


def _gap(table: CsvTable, line: int, gap: float | None, file: _Sweep) -> float | Literal[False] | None:
    """The sweep's gap; None for a point of all gaps, False for a gap not in the sweep."""
    if gap is None and len(file.gaps) > 1:
        raise table.refusal(f"has no gap, and the sweep has {len(file.gaps)} of them; add gap_mm or gap_ratio", line)
    away = {own: abs(own - gap) for own in file.gaps if own is not None} if gap is not None else {}
    if not away:  # or the sweep doesn't tell its own
        return None
    nearest = min(away, key=lambda own: away[own])
    return nearest if away[nearest] < SAME else False


def _gap_words(metres: float | None, gap: float) -> str:
    return f"{'gap' if metres else 'gap/A0'} {_length(metres, gap)}"


def _length(metres: float | None, gap: float) -> str:
    return f"{1000 * gap * metres:.4g} mm" if metres else f"{gap:.4g}"


def _metres(file: OpenedFile) -> float | None:
    """1 m in the numbers of a sweep's gaps."""
    return 1.0 if _is_sweep(file) and file.gap_name == "gap_m" else file.positive("cart_amplitude_m")


def _with_series(points: Sequence[Point]) -> list[Point]:
    """A label shared by several points without a series becomes their series and is shown in the legend."""
    count = Counter(point.label for point in points)
    shared = {label for label, times in count.items() if label and times > 1}
    return [replace(point, series=point.label, label="") if point.label in shared and not point.series else point
            for point in points]


def _with_few_names(path: Path, measured: Measurements) -> Measurements:
    points, left_out = list(measured.points), list(measured.left_out)
    labelled = [number for number, point in enumerate(points) if point.label]
    if len(labelled) > MOST_LABELS:
        left_out.append(f"{path}: {len(labelled) - MOST_LABELS} of {len(labelled)} labels are left out; no more can be read")
        for number in labelled[MOST_LABELS:]:
            points[number] = replace(points[number], label="")
    series = list(dict.fromkeys(point.series for point in points))
    if len(series) > MOST_SERIES:
        raise PeterkaFileError(f"{path} has {len(series)} series; {MOST_SERIES} can be told apart")
    return Measurements(points, left_out)
