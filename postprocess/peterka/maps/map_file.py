"""A checked map or basin file, read in bands of rows, never as a whole.

Layout versions 2 and 3: two coordinate vectors and the data on [rows][columns],
    map    rows gap_ratio,      columns frequency_ratio, unless the axes of its job are others
    basin  rows velocity_ratio, columns displacement_ratio
or the same in SI units, which are brought to ratios where the file tells how (files/coordinates.py);
with regime int8, impacts and period int32, peak_force_ratio f64 [F/(m g)], for basins attractor int32 and the group
`attractors`; where the job asks for them the f64 of QUANTITIES, int8 chatter (0 or 1), int8 computed (0 or 1, refined
maps), int32 last_impact (-1: none), and the group `audit`. What cannot be drawn raises PeterkaFileError.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Reals
from ..files.checked_hdf5 import INTEGER, REAL, shown
from ..files.coordinates import Coordinate, coordinate
from ..files.harmless import harmless
from ..files.job_axes import axes_of_job, points_of_job
from ..errors import PeterkaFileError
from ..files.opened import OpenedFile
from ..files.regimes import CHAOTIC, NOT_COMPUTED, check_labels
from .outcomes import OUTCOMES, check_outcomes
from .tables import Attractors, read_attractors, read_audit

__all__ = ["Attractors", "Axis", "PeterkaFileError", "PeterkaFile", "QUANTITIES"]

COORDINATES = {"map": ("gap_ratio", "frequency_ratio"), "basin": ("velocity_ratio", "displacement_ratio")}
# Optional datasets and the accepted spellings of their unit; the first one is displayed.
QUANTITIES = {
    "impact_speed": ("m/s", "m s-1"),
    "impulse": ("N s", "N*s", "Ns"),
    "contact_time": ("s",),
    "contact_power_w": ("W",),
    "max_displacement": ("m",),
}
UNITS = {spellings[0] for spellings in QUANTITIES.values()} | {"N", "J"}
PURE_NUMBERS = ("multiplier", "lyapunov", "sensitivity", "orbit_displacement", "orbit_velocity", "peak_force_mean_ratio",
                "peak_force_q95_ratio")
# In a map with [starts], on [attractor][gap_ratio][frequency_ratio].
SLOTS = {"attractor_regime": INTEGER, "attractor_impacts": INTEGER, "attractor_period": INTEGER,
         "attractor_peak_force_ratio": REAL, "basin_share": REAL}
SLOT_PROOFS = "attractor_certified"  # the same, with certificate.attractors
# Optional: for the attractors, or for the cells of a map without [starts].
KICKS = {"critical_kick": REAL, "critical_kick_tried": REAL}
LIVES = {"mean_life_s": REAL, "mean_life_least_s": REAL}  # likewise, of a job with [noise]
BOUNDS = {"impact_speed_lower", "impact_speed_upper", "critical_kick_lower"}  # told beside what they bound, no pictures of their own
MAX_SLOTS = 64
MAX_POINTS = 65536  # along one axis: a band of rows then still fits into some tens of megabytes
BAND_CELLS = 2**21


@dataclass(frozen=True)
class Axis:
    """Ratios along one side: cell centres `values` (n,), ascending, and cell edges `edges` (n+1,).

    `log`: the centres are evenly spaced in the logarithm. `stored` is the name in the file, whose numbers are `unit` times the ratios."""

    name: str
    values: Reals
    edges: Reals
    log: bool
    stored: str
    unit: float = 1.0


class PeterkaFile(OpenedFile):
    """A checked, open map or basin file: kind, rows and columns (Axis), shape, `quantities` and `numbers` (those of
    QUANTITIES, others in UNITS, and PURE_NUMBERS that it holds), elasticities (names of datasets), has_chatter, has_last_impact, is_refined, has_proofs, has_slot_proofs (of SLOTS), attractors,
    audit; slots, the number of attractors kept for each cell (0 without [starts]), and has_kicks, has_lives: KICKS
    and LIVES, of each of these, or of the cell; outcome_slots, the number of outcomes kept for each cell (0 without [uncertainty])."""

    coordinates = COORDINATES  # for each kind that this class reads

    @cached_property
    def computed(self) -> float:
        """Share of the cells that are computed, 0 to 1."""
        missing = sum(int(np.sum(band["regime"] == NOT_COMPUTED)) for _, band in self.bands(["regime"]))
        return 1 - missing / (self.shape[0] * self.shape[1])

    @cached_property
    def observed_chaos(self) -> tuple[int, int] | None:
        """The fewest and the most forcing cycles for which chaotic cells were observed; None without such cells."""
        if not self._has_observed_cycles:
            return None
        followed = [band["observed_cycles"][band["regime"] == CHAOTIC]
                    for _, band in self.bands(["regime", "observed_cycles"])]
        cycles = np.concatenate([cells[cells > 0] for cells in followed])  # filled cells were not observed
        return (int(cycles.min()), int(cycles.max())) if cycles.size else None

    @cached_property
    def whole(self) -> str:
        """What its cells are, in words: the map, or a part of it."""
        points = points_of_job(self.data.attribute("job"))
        is_part = any(points.get(axis.stored, len(axis.values)) != len(axis.values) for axis in (self.rows, self.columns))
        return "part shown" if is_part else "map"

    def bands(self, names: Iterable[str], multiple: int = 1) -> Iterator[tuple[int, dict[str, NDArray[Any]]]]:
        """Yields (first row, {name: array (rows, columns)}) over the whole map, `regime` among the names; those of SLOTS
        are (slots, rows, columns).

        All bands but the last have a number of rows divisible by `multiple`. Values are checked as they are read."""
        slots = max(1, self.slots, self.outcome_slots) if any(map(self._is_stacked, names)) else 1
        rows = multiple * max(1, BAND_CELLS // (slots * self.shape[1] * multiple))
        for first in range(0, self.shape[0], rows):
            yield first, self.band(names, first, first + rows)

    def band(self, names: Iterable[str], first: int, last: int) -> dict[str, NDArray[Any]]:
        """{name: array (rows, columns)} of the rows from first to before last, `regime` among the names; values are checked."""
        rows = slice(first, last)
        band = {name: self.data.values(name, (slice(None), rows) if self._is_stacked(name) else rows) for name in names}
        self._check_values(band)
        return band

    def check_content(self) -> None:
        """Sets the documented members; raises PeterkaFileError for invalid content."""
        if self.kind not in self.coordinates:
            raise self.refusal(f"is of kind {shown(self.kind)}; a {' or '.join(self.coordinates)} file is needed")
        self.rows, self.columns = (self._axis(name) for name in self._coordinates())
        self.shape = (len(self.rows.values), len(self.columns.values))
        for name in ("regime", "impacts", "period"):
            self.data.dataset(name, self.shape, INTEGER)
        self.data.dataset("peak_force_ratio", self.shape, REAL)
        self.quantities = [name for name in QUANTITIES if self.data.has(name)]
        for name in self.quantities:
            self._check_quantity(name)
        self.quantities += [name for name in self.data.names() if name not in QUANTITIES.keys() | KICKS.keys() | BOUNDS
                            and self._is_quantity(name)]
        self.numbers = [name for name in PURE_NUMBERS if self.data.has(name)]
        for name in self.numbers:
            self.data.dataset(name, self.shape, REAL)
        self.elasticities = [name for name in self.data.names() if re.fullmatch(r"(force|speed)_elasticity_[a-z0-9_]+", name)]
        for name in self.elasticities:
            self.data.dataset(name, self.shape, REAL)
        self.has_chatter = self._has_integers("chatter")
        self.has_last_impact = self._has_integers("last_impact")
        self._has_observed_cycles = self._has_integers("observed_cycles")
        self.is_refined = self._has_integers("computed")
        self.has_proofs = self._has_integers("certified")
        self.attractors = read_attractors(self.data, self.shape) if self.kind == "basin" else None
        self.slots = self._slots()
        self.has_slot_proofs = self.slots > 0 and self.data.has(SLOT_PROOFS)
        if self.has_slot_proofs:
            self.data.dataset(SLOT_PROOFS, (self.slots, *self.shape), INTEGER)
        self.outcome_slots = check_outcomes(self.data, self.shape, MAX_POINTS**2 * MAX_SLOTS) if self.kind == "map" else 0
        self.has_kicks = self._has_of_motions(KICKS)
        self.has_lives = self._has_of_motions(LIVES)
        self.audit = read_audit(self.data, self.shape) if self.kind == "map" else None

    def _coordinates(self) -> tuple[str, str]:
        names = axes_of_job(self.data.attribute("job"))
        if len(names) == 2 and all(self.data.has(name) for name in names):
            return names[1], names[0]
        return self.coordinates[self.kind]

    def _has_of_motions(self, names: Mapping[str, Any]) -> bool:
        """Whether a map has these of its attractors, or of its cells without [starts]."""
        has_all = self.kind == "map" and all(self.data.has(name) for name in names)
        for name, kind in names.items() if has_all else ():
            self.data.dataset(name, ((self.slots,) if self.slots else ()) + self.shape, kind)
        return has_all

    def _has_integers(self, name: str) -> bool:
        if self.data.has(name):
            self.data.dataset(name, self.shape, INTEGER)
        return self.data.has(name)

    def _slots(self) -> int:
        if self.kind != "map" or not self.data.has("basin_share"):
            return 0
        slots = self.data.dataset("basin_share", None, REAL).shape[:1]
        if not slots or not 1 <= slots[0] <= MAX_SLOTS:
            raise self.refusal(f"keeps {slots[0] if slots else 'no'} attractors for each cell; 1 to {MAX_SLOTS} can be drawn")
        for name, kind in SLOTS.items():
            self.data.dataset(name, slots + self.shape, kind)
        for name in ("attractors", "start_attractor"):
            self.data.dataset(name, self.shape, INTEGER)
        return int(slots[0])

    def _is_stacked(self, name: str) -> bool:
        return name in SLOTS or name == SLOT_PROOFS or name in OUTCOMES or (name in {**KICKS, **LIVES} and self.slots > 0)

    def _check_quantity(self, name: str) -> None:
        self.data.dataset(name, self.shape, REAL)
        unit = self.data.attribute("units", name)
        if unit not in QUANTITIES[name]:
            raise self.refusal(f"has {name} in {shown(unit)} instead of {QUANTITIES[name][0]}")

    def _is_quantity(self, name: str) -> bool:
        """Whether a dataset is a number on the plane with a unit from UNITS: datasets of later versions are drawn, too."""
        try:
            self.data.dataset(name, self.shape, REAL)
        except PeterkaFileError:
            return False
        if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
            return False  # it becomes a part of a picture's file name
        return self.data.attribute("units", name) in UNITS

    def unit(self, name: str) -> str:
        """The unit of one of the quantities."""
        return QUANTITIES[name][0] if name in QUANTITIES else str(self.data.attribute("units", name))

    def words(self, name: str) -> str:
        """The file's description of one of the quantities."""
        said = self.data.attribute("long_name", name)
        return harmless(said, None) if isinstance(said, str) else name

    def _check_values(self, columns: Mapping[str, NDArray[Any]]) -> None:
        check_labels(self.data, columns)
        for of in ("attractor", "outcome"):
            if f"{of}_regime" in columns:
                check_labels(self.data, {name: columns[f"{of}_{name}"] for name in ("regime", "impacts", "period")
                                         if f"{of}_{name}" in columns})
        if "outcome_probability" in columns and not np.all(np.isnan(columns["outcome_probability"]) | (
                (columns["outcome_probability"] >= 0) & (columns["outcome_probability"] <= 1 + 1e-9))):
            raise self.refusal("has an outcome_probability that is no probability")
        if "basin_share" in columns and not np.all((columns["basin_share"] >= 0) & (columns["basin_share"] <= 1 + 1e-9)):
            raise self.refusal("has a basin_share that is no share")
        attractor = columns.get("attractor")
        if attractor is not None and self.attractors is not None and np.any((attractor < -1) | (attractor >= self.attractors.count)):
            raise self.refusal("names an attractor that its table does not have")
        for name in {"chatter", "computed"} & columns.keys():
            if not np.isin(columns[name], [0, 1, NOT_COMPUTED]).all():
                raise self.refusal(f"has a {name} that is neither 0 nor 1")
        for name in {"certified", SLOT_PROOFS} & columns.keys():
            if not np.isin(columns[name], [*range(-8, 3), NOT_COMPUTED]).all():
                raise self.refusal(f"has {'an' if name == SLOT_PROOFS else 'a'} {name} that is no verdict from -8 to 2")

    def _axis(self, name: str) -> Axis:
        """The Axis of a stored coordinate."""
        shape = self.data.dataset(name, None, INTEGER + REAL).shape
        if shape == () and self.data.may_be_part:
            value = float(self.data.values(name, ()))
            raise self.refusal(f"has one {name} alone, so that no plane is left; keep a plane with sel({name}=[{value:g}]), or with "
                               f"sel({name}=slice(FROM, TO)); a sweep shows a line")
        if len(shape) != 1 or not 1 <= shape[0] <= MAX_POINTS:
            raise self.refusal(f"has {name} of shape {shape}; an axis of 1 to {MAX_POINTS} points can be drawn")
        values = np.asarray(self.data.values(name, slice(None)), dtype=float)
        if not (np.isfinite(values).all() and np.all(np.diff(values) > 0)):
            raise self.refusal(f"has a coordinate {name} that does not ascend")
        found = coordinate(self, name)
        return axis_of(found.name, values / found.unit, found)


def axis_of(name: str, values: Reals, stored: Coordinate | None = None) -> Axis:
    """The Axis with these ascending values, which are the stored ones unless `stored` is given."""
    log = _evenly_spaced_in_log(values)
    edges = np.exp(_edges(np.log(values))) if log else _edges(values)
    if name in ("frequency_ratio", "frequency_hz") and values[0] >= 0:
        edges[0] = max(edges[0], 0)  # half a wide cell may reach below 0, where frequencies do not exist
    return Axis(name, values, edges, log, *(name, 1.0) if stored is None else (stored.stored, stored.unit))


def _edges(centres: Reals) -> Reals:
    """Edges (n+1,) half-way between the centres (n,); the outer cells are symmetric. A single cell is a tenth of its value wide, or 1."""
    if len(centres) == 1:
        half = abs(centres[0]) / 20 or 0.5
        return np.array([centres[0] - half, centres[0] + half])
    inner = (centres[:-1] + centres[1:]) / 2
    return np.concatenate([[2 * centres[0] - inner[0]], inner, [2 * centres[-1] - inner[-1]]])


def _evenly_spaced_in_log(values: Reals) -> bool:
    if len(values) < 3 or values[0] <= 0:
        return False
    linear, log = np.diff(values), np.diff(np.log(values))
    return bool(np.ptp(log) < 1e-6 * log.mean() and np.ptp(linear) > 1e-3 * linear.mean())
