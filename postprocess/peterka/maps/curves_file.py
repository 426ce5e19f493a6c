"""A checked file of curves: the coarse map in which orbits were searched, as in a map file, the curves over the same plane,
and the special points on them.
"""

import tomllib
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Reals
from ..files.checked_hdf5 import INTEGER, REAL
from ..files.job_axes import axes_of_job
from ..files.opened import OpenedFile
from .map_file import Axis, PeterkaFile

KINDS = ("fold", "period_doubling", "grazing")
SPECIALS = ("fold_grazing", "flip_grazing", "double_grazing", "cusp", "inflection", "generalized_flip")
EDGE_KINDS = (*KINDS, "none", "unknown")  # of edge_kind_*; -128 for a cell without such an orbit
MAX_POINTS = 10_000_000
MAX_SAMPLES = 4096  # of an orbit
WORDS = {kind: kind.replace("_", " ") for kind in KINDS}
SAME_GAP = 1e-6  # A0: tolerance between a gap requested for curves and one of a sweep or of a map's row
RIG = ("hammer", "cart", "contact")  # job tables that must agree with those of files compared with the curves


@dataclass(frozen=True)
class Curve:
    """`kind` from KINDS, p and q of the orbit on the stable side, and the points
    in order: values (points,) on the axes of the file's columns and rows."""

    kind: str
    impacts: int
    period: int
    columns: Reals
    rows: Reals


@dataclass(frozen=True)
class Special:
    """`kind` from SPECIALS, and its position on the axes of the file's columns and rows."""

    kind: str
    column: float
    row: float


@dataclass(frozen=True)
class Crossing:
    """A point at which a curve has one of the gaps named by its job."""

    curve: Curve
    frequency_ratio: float
    gap_ratio: float


@dataclass(frozen=True)
class UnstableBranch:
    """Unstable orbits p/q along the frequency at one gap. Arrays (points,): position and largest force F/(m g); arrays
    (points, samples), NaN-padded: x/A0 at forcing phase 0 and at first touch."""

    gap_ratio: float
    impacts: int
    period: int
    frequency_ratio: Reals
    force: Reals
    stroboscopic_displacement: Reals
    impact_displacement: Reals


@dataclass(frozen=True)
class Lines:
    """What is drawn of a file of curves: its curves and special points, on the axes of a picture's columns and rows."""

    curves: list[Curve]
    specials: list[Special]


class CurvesFile(PeterkaFile):
    """A checked, open file of curves: the coarse map, `curves`, `specials`, `crossings`, `unstable_branches` and
    has_edge_distance. Crossings and branches exist only for planes of frequency and gap."""

    coordinates = {"curves": ("gap_ratio", "frequency_ratio")}
    _parts: list[slice]  # of each curve, among the points of all

    def check_content(self) -> None:
        """Sets the documented members; raises PeterkaFileError for invalid content."""
        super().check_content()
        self.curves = self._curves() if self.data.has("curve_kind") else []
        self.specials = self._specials() if self.data.has("special_kind") else []
        self.crossings = self._crossings() if self.data.has("crossing_curve") else []
        self.unstable_branches = self._unstable_branches() if self.data.has("branch_first") else []
        self.has_edge_distance = self.data.has(f"edge_distance_{self.columns.stored}")
        for axis in (self.columns, self.rows) if self.has_edge_distance else ():
            self.data.dataset(f"edge_distance_{axis.stored}", self.shape, REAL)
            self.data.dataset(f"edge_kind_{axis.stored}", self.shape, INTEGER)

    def along_curves(self, name: str) -> list[Reals]:
        """For each curve, the values of a dataset at its points."""
        values = self._column(name, REAL, self.data.dataset("point", None, INTEGER).shape)
        return [values[part] for part in self._parts]

    @property
    def lines(self) -> Lines:
        """Its curves and special points."""
        return Lines(self.curves, self.specials)

    def cut_to_window(self) -> None:
        """Leaves of the curves and special points what lies between the outer edges of its axes."""
        kept = [(curve, part, stretch) for curve, part in zip(self.curves, self._parts if self.curves else [])
                for stretch in stretches_within(curve, self.columns, self.rows)]
        self._parts = [slice(part.start + stretch.start, part.start + stretch.stop) for _, part, stretch in kept]
        self.curves, self.specials = within(self.lines, self.columns, self.rows)

    def _curves(self) -> list[Curve]:
        kinds = self._column("curve_kind", INTEGER)
        impacts, periods, firsts, counts = (
            self._column(name, INTEGER, kinds.shape)
            for name in ("curve_impacts", "curve_period", "curve_first", "curve_points"))
        columns = self._along("point", self.columns)
        rows = self._along("point", self.rows, columns.shape)
        if not (np.isin(kinds, range(len(KINDS))).all() and (impacts >= 0).all() and (periods > 0).all()):
            raise self.refusal("has a curve of no known kind or orbit")
        if not ((firsts >= 0).all() and (counts >= 0).all() and (counts <= len(rows)).all()
                and (firsts <= len(rows) - counts).all()):
            raise self.refusal("has a curve with points that the file does not have")
        if not (np.isfinite(columns).all() and np.isfinite(rows).all()):
            raise self.refusal("has a point that is not finite")
        self._parts = [slice(first, first + count) for first, count in zip(firsts, counts)]
        return [Curve(KINDS[kind], int(p), int(q), columns[part], rows[part])
                for kind, p, q, part in zip(kinds, impacts, periods, self._parts)]

    def _specials(self) -> list[Special]:
        kinds = self._column("special_kind", INTEGER)
        columns, rows = (self._along("special", axis, kinds.shape) for axis in (self.columns, self.rows))
        if not (np.isin(kinds, range(len(SPECIALS))).all() and np.isfinite(columns).all() and np.isfinite(rows).all()):
            raise self.refusal("has a special point of no known kind or place")
        return [Special(SPECIALS[kind], float(x), float(y)) for kind, x, y in zip(kinds, columns, rows)]

    def _crossings(self) -> list[Crossing]:
        numbers = self._column("crossing_curve", INTEGER)
        axes = self._frequency_and_gap()
        if axes is None:
            return []
        frequencies, gaps = (self._along("crossing", axis, numbers.shape) for axis in axes)
        if not (((numbers >= 0) & (numbers < len(self.curves))).all() and np.isfinite(frequencies).all()
                and np.isfinite(gaps).all()):
            raise self.refusal("has a crossing of no curve or place")
        return [Crossing(self.curves[number], float(x), float(y)) for number, x, y in zip(numbers, frequencies, gaps)]

    def _unstable_branches(self) -> list[UnstableBranch]:
        axes = self._frequency_and_gap()
        if axes is None:
            return []
        gaps = self._along("branch", axes[1])
        impacts, periods, firsts, counts = (self._column(f"branch_{name}", INTEGER, gaps.shape)
                                            for name in ("impacts", "period", "first", "points"))
        frequencies = self._along("branch", axes[0])
        forces = self._column("branch_peak_force_ratio", REAL, frequencies.shape)
        if not ((firsts >= 0).all() and (counts > 0).all() and (firsts <= len(frequencies) - counts).all()
                and np.isfinite(frequencies).all() and np.isfinite(gaps).all()):
            raise self.refusal("has a branch of no place, or with points that the file does not have")
        displacements = [self._samples(f"branch_{name}_displacement", len(frequencies))
                         for name in ("stroboscopic", "impact")]
        parts = [slice(first, first + count) for first, count in zip(firsts, counts)]
        return [UnstableBranch(float(gap), int(p), int(q), frequencies[part], forces[part],
                               *(samples[part] for samples in displacements))
                for gap, p, q, part in zip(gaps, impacts, periods, parts)]

    def _frequency_and_gap(self) -> tuple[Axis, Axis] | None:
        """The axes required for comparison with a frequency sweep; None if the plane has others."""
        by_name = {axis.name: axis for axis in (self.columns, self.rows)}
        return (by_name["frequency_ratio"], by_name["gap_ratio"]) if by_name.keys() == {"frequency_ratio", "gap_ratio"} else None

    def _along(self, prefix: str, axis: Axis, shape: tuple[int, ...] | None = None) -> Reals:
        """Positions on an axis, in its units."""
        return self._column(f"{prefix}_{axis.stored}", REAL, shape) / axis.unit

    def _samples(self, name: str, points: int) -> Reals:
        found = self.data.dataset(name, None, REAL).shape
        if len(found) != 2 or found[0] != points or not 1 <= found[1] <= MAX_SAMPLES or points * found[1] > MAX_POINTS:
            raise self.refusal(f"has {name} of shape {found}")
        values: Reals = self.data.values(name, slice(None))
        return values

    def _column(self, name: str, numbers: str, shape: tuple[int, ...] | None = None) -> NDArray[Any]:
        found = self.data.dataset(name, shape, numbers).shape
        if len(found) != 1 or not 1 <= found[0] <= MAX_POINTS:
            raise self.refusal(f"has {name} of shape {found}; 1 to {MAX_POINTS} can be drawn")
        values: NDArray[Any] = self.data.values(name, slice(None))
        return values


def within(lines: Lines, columns: Axis, rows: Axis) -> tuple[list[Curve], list[Special]]:
    """The parts of curves, and the special points, between the outer edges of both axes; a part goes one point beyond them."""
    curves = [replace(curve, columns=curve.columns[part], rows=curve.rows[part])
              for curve in lines.curves for part in stretches_within(curve, columns, rows)]
    return curves, [special for special in lines.specials if columns.edges[0] <= special.column <= columns.edges[-1]
                    and rows.edges[0] <= special.row <= rows.edges[-1]]


def stretches_within(curve: Curve, columns: Axis, rows: Axis) -> list[slice]:
    """Of a curve's points, the longest runs whose steps all come into the window."""
    comes_in = np.ones(len(curve.rows) - 1, dtype=bool)
    for values, axis in ((curve.columns, columns), (curve.rows, rows)):
        comes_in &= np.maximum(values[1:], values[:-1]) >= axis.edges[0]
        comes_in &= np.minimum(values[1:], values[:-1]) <= axis.edges[-1]
    ends = np.flatnonzero(np.diff(np.concatenate([[False], comes_in, [False]]).astype(int)))
    return [slice(int(first), int(last) + 1) for first, last in zip(ends[::2], ends[1::2])]


def rig_of(file: OpenedFile) -> dict[str, object]:
    """{table.key: number} of hammer, cart and stop in a file's job, but for what its axes vary."""
    text = file.data.attribute("job")
    axes = axes_of_job(text)
    try:
        job = tomllib.loads(text if isinstance(text, str) else "")
        return {f"{name}.{key}": value for name in RIG for key, value in job[name].items() if f"{name}_{key}" not in axes}
    except (tomllib.TOMLDecodeError, KeyError, AttributeError, RecursionError) as error:
        raise file.refusal(f"holds no job that can be read ({type(error).__name__}: {error})") from error


def differing(first: OpenedFile, second: OpenedFile) -> str:
    """Where the rigs of two files differ: ": hammer.mass_kg differs"; empty if nowhere."""
    one, other = rig_of(first), rig_of(second)
    keys = sorted(key for key in one.keys() | other.keys() if one.get(key) != other.get(key))
    return f": {', '.join(keys)} differ{'s' * (len(keys) == 1)}" if keys else ""
