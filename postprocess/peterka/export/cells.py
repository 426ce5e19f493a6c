"""The cell fields of a map or basin, or those of a sweep's points, with names and customary units."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from h5py.h5ds import is_scale
from numpy.typing import NDArray

from ..arrays import Reals
from ..files.checked_hdf5 import INTEGER, REAL, CheckedFile
from ..files.coordinates import NAMES, unit_of
from ..errors import PeterkaFileError
from ..files import regimes
from ..maps.map_file import PeterkaFile
from ..maps.rates import Rate, column_of_elasticity, rates_of
from ..maps.rig_numbers import Along, along_axes
from ..sweeps.sweep_file import SweepFile

REGIMES = ("no_impact", "periodic", "chaotic", "sustained_contact", "unresolved", "failed")
NOT_COMPUTED = "not_computed"
NO_COUNT = -1
OF_FOLLOWED = ("status", "engine")  # what a cell that was filled doesn't have
PLAIN_NAME = re.compile(r"[a-z][a-z0-9_]{0,62}")  # as all of the layout's: nothing that a table or a program would take for more
SUFFIXES = {"impact_speed": "m_s", "impact_speed_lower": "m_s", "impact_speed_upper": "m_s", "impulse": "n_s", "contact_time": "s",
            "max_displacement": "mm", "critical_kick": "m_s", "critical_kick_tried": "m_s", "critical_kick_lower": "m_s", "speed_q05": "m_s", "speed_q50": "m_s", "speed_q95": "m_s"}
ORBITS = {"orbit_displacement": ("displacement_ratio", "mm", 1e3), "orbit_velocity": ("velocity_ratio", "m_s", 1.0)}
OF_THE_RUN = ("run", "summary", "tiles")  # groups that tell of the file, not of the cells
MILLI = {"max_displacement": 1e3}


@dataclass(frozen=True)
class Field:
    """A number of each cell, exported under `name`: a dataset on [rows][columns], as the stored value times `factor`, or a `rate` computed
    from several."""

    dataset: str
    name: str
    factor: float
    whole: bool  # integer-valued
    words: Mapping[int, str] = field(default_factory=dict)  # of a table: what the numbers of a dataset of flags mean
    rate: Rate | None = None
    filled_in: str | None = None  # the dataset that is 0 in cells that a refined map filled, where these have none

    @property
    def datasets(self) -> tuple[str, ...]:
        """Those that it is made of."""
        return self.rate.datasets if self.rate else (self.dataset, *([self.filled_in] if self.filled_in else []))

    def values(self, cells: Mapping[str, NDArray[Any]], rows: slice | int) -> NDArray[Any]:
        """From {dataset: array} of these rows; -1 of whole numbers and NaN of others mean no value."""
        if self.rate:
            return self.rate.of(cells, rows)
        if self.filled_in:
            return np.where(cells[self.filled_in] == 0, NO_COUNT, cells[self.dataset])
        return cells[self.dataset] if self.whole else cells[self.dataset] * self.factor


@dataclass(frozen=True)
class Side:
    """An axis: its name and values (n,), in units if the file gives them, and the file's ratios."""

    name: str
    values: Reals
    ratio_name: str
    ratios: Reals


def fields_of(file: PeterkaFile | SweepFile) -> list[Field]:
    """The Fields of a map or basin, or of a sweep on [branch][point], the label first. Datasets added by other programs are skipped if their name does not
    match the layout's pattern or clashes with another field or axis."""
    first = ["regime", "impacts", "period", "peak_force_ratio"]
    edges = {f"edge_distance_{side}": (word, factor) for side, word, factor in (
        ("frequency_ratio", "edge_distance_frequency_hz", file.positive("natural_frequency_hz")),
        ("gap_ratio", "edge_distance_gap_mm", 1e3 * (file.positive("cart_amplitude_m") or 0)),
        ("gap_m", "edge_distance_gap_mm", 1e3)) if factor}
    shape = (len(file.branches), len(file.values)) if isinstance(file, SweepFile) else file.shape
    found = []
    for name in [*first, *(name for name in file.data.names() if name not in first and PLAIN_NAME.fullmatch(name))]:
        try:
            kind = file.data.dataset(name, shape, INTEGER + REAL).dtype.kind
        except PeterkaFileError:  # a group, an axis, or a table of a different kind
            continue
        if name.startswith(("peak_force", "force_q")) and name.endswith("_ratio") and file.newtons:
            found.append(Field(name, f"{name.removesuffix('_ratio')}_n", file.newtons, False))
        elif name in ORBITS:
            ratio, in_si, size = ORBITS[name]
            unit = unit_of(file, ratio)
            found.append(Field(name, f"{name}_{in_si if unit else 'ratio'}", size * unit if unit else 1.0, False))
        elif name in edges:
            found.append(Field(name, *edges[name], False))
        elif column := column_of_elasticity(name):
            found.append(Field(name, column, 1.0, False))
        else:
            suffix = SUFFIXES.get(name)
            found.append(Field(name, f"{name}_{suffix}" if suffix else name, MILLI.get(name, 1.0), kind in INTEGER,
                               _words(file, name) if kind in INTEGER else {},
                               filled_in="computed" if name in OF_FOLLOWED and file.data.has("computed") else None))
    found += [Field(rate.elasticity, rate.column, 1.0, False, rate=rate) for rate in rates_of(file, _coordinates(file))]
    taken = {name for side in sides_of(file) for name in (side.name, side.ratio_name)} | {"title"}
    taken |= {field.name for field in found if field.name != field.dataset}
    return [field for field in found if field.name != field.dataset or field.name not in taken]


def _words(file: PeterkaFile | SweepFile, name: str) -> dict[int, str]:
    """{number: word} of a dataset of flags; empty where its numbers are counts, or the file doesn't say."""
    if name == "regime":
        return dict(enumerate(REGIMES)) | {regimes.NOT_COMPUTED: NOT_COMPUTED}
    try:
        return {regimes.NOT_COMPUTED: ""} | file.data.words(name)
    except PeterkaFileError:
        return {}


def _coordinates(file: PeterkaFile | SweepFile) -> list[Along]:
    if isinstance(file, PeterkaFile):
        return along_axes(file)
    found = [Along(file.axis_name, file.axis.stored, file.axis.unit, file.values[None, :])]
    if any(branch.gap_ratio is not None for branch in file.branches) and file.gap_name != file.axis_name:
        gaps = np.array([np.nan if branch.gap_ratio is None else branch.gap_ratio for branch in file.branches])
        found.append(Along(file.gap_name, file.gap_name, 1.0, gaps[:, None]))
    return found


def sides_of(file: PeterkaFile | SweepFile) -> tuple[Side, Side]:
    """The axes (rows, columns) as Sides; of a sweep the gaps of its branches, and the axis of its points. A gap that a sweep's file
    doesn't tell for each branch, as where it is the axis, is NaN."""
    if isinstance(file, SweepFile):
        gaps = np.array([np.nan if branch.gap_ratio is None else branch.gap_ratio for branch in file.branches])
        stored = next((name for name in ("gap_ratio", "gap_m") if file.data.has(name) and file.axis.stored != name), file.gap_name)
        return (_side(file, file.gap_name, stored if file.data.has(stored) else file.gap_name, gaps),
                _side(file, file.axis_name, file.axis.stored, file.values))
    rows, columns = (_side(file, axis.name, axis.stored, axis.values) for axis in (file.rows, file.columns))
    return rows, columns


def _side(file: PeterkaFile | SweepFile, own_name: str, stored: str, ratios: Reals) -> Side:
    units = {"frequency_ratio": ("frequency_hz", 1.0), "gap_ratio": ("gap_mm", 1e3)} | {
        f"{start}{ratio}": (f"{start}{name}", size) for start in ("", "start_")
        for ratio, name, size in (("displacement_ratio", "displacement_mm", 1e3), ("velocity_ratio", "velocity_m_s", 1.0))}
    name, values = own_name, ratios
    unit = unit_of(file, own_name) if own_name in units else None
    if unit:
        name, size = units[own_name]
        # those that the file has in SI units are these, to the last bit
        values = size * (values * unit if stored == own_name else file.data.values(stored, slice(None)))
    elif own_name == "gap_m":
        name, values = "gap_mm", 1e3 * values
    return Side(name, values, own_name, ratios)


def left_out(file: PeterkaFile | SweepFile) -> list[str]:
    """Names of the datasets, or groups, of a file that aren't one number of each cell, and so are none of its Fields or Sides."""
    if not isinstance(file.data, CheckedFile):
        return []
    axes = {"direction", file.axis.stored} if isinstance(file, SweepFile) else {axis.stored for axis in (file.rows, file.columns)}
    told = {field.dataset for field in fields_of(file)} | axes | NAMES | set(OF_THE_RUN)
    names = dict.fromkeys(name.partition("/")[0] for name, dataset in file.data.numbers().items() if not is_scale(dataset.id))
    return [name for name in names if name not in told and PLAIN_NAME.fullmatch(name)]


def bands(file: PeterkaFile, fields: Sequence[Field]) -> Iterator[tuple[int, dict[str, NDArray[Any]]]]:
    """(first row, {name: values (rows, columns)}) over all cells."""
    names = list(dict.fromkeys(["regime", *(name for field in fields for name in field.datasets)]))
    for first, band in file.bands(names):
        rows = slice(first, first + len(band["regime"]))
        yield first, {field.name: field.values(band, rows) for field in fields}
