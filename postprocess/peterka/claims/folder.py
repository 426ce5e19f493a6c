"""The files of a results folder, by name, as plain arrays; None for a missing file.

Files are read by the readers used for drawing, which check their input. All maps here are small enough to hold in memory.
"""

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from ..arrays import Integers, Mask, Reals
from ..files.checked_hdf5 import LARGEST, is_number
from ..files.harmless import harmless
from ..errors import PeterkaFileError
from ..files.opened import STANDARD_GRAVITY, OpenedFile
from ..files.regimes import CHAOTIC, NO_IMPACT, NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT
from ..maps.comparison import label_codes
from ..maps.curves_file import Crossing, CurvesFile
from ..maps.map_file import PeterkaFile

from .record import SOME


SMALLEST = 1 / LARGEST  # lower bound of rig numbers that must be positive
BASINS = ("basin_", "nearby_", "sensitivity/1")  # names of basins begin so; those of maps do not


@dataclass(frozen=True)
class Plane:
    """Cells of a map or a basin: the axes' rows (y,) and columns (x,), and each field (y, x). `job` is the job that computed
    them, with all defaults resolved."""

    path: Path
    kind: str
    job: dict[str, Any]
    rows: Reals
    columns: Reals
    regime: Integers
    impacts: Integers
    period: Integers
    peak_force_ratio: Reals  # F/(m g)
    last_impact: Integers | None

    @property
    def natural_frequency_hz(self) -> float:
        """Natural frequency of the hammer on its springs."""
        value: float = self.job["hammer"]["natural_frequency_hz"]
        return value

    @property
    def force_n(self) -> Reals:
        """Peak forces in N, (y, x)."""
        values: Reals = self.peak_force_ratio * self.job["hammer"]["mass_kg"] * STANDARD_GRAVITY
        return values

    @property
    def frequency_hz(self) -> Reals:
        """Frequencies [Hz] of the columns of a map."""
        return self.columns * self.natural_frequency_hz

    @property
    def amplitude_mm(self) -> float:
        """Amplitude of the cart [mm]."""
        value: float = 1e3 * self.job["cart"]["amplitude_m"]
        return value

    def is_orbit(self, impacts: int, period: int) -> Mask:
        """Mask of the cells with the orbit z = impacts/period, (y, x)."""
        mask: Mask = (self.regime == PERIODIC) & (self.impacts == impacts) & (self.period == period)
        return mask

    @property
    def gap_ratio(self) -> float:
        """Gap ratio of a basin."""
        value: float = self.job["operating_point"]["gap_ratio"]
        return value

    @property
    def frequency_ratio(self) -> float:
        """Frequency ratio of a basin."""
        value: float = self.job["operating_point"]["frequency_ratio"]
        return value

    @property
    def label_code(self) -> Integers:
        """A number for each label, (y, x)."""
        return label_codes(self.regime, self.impacts, self.period)

    @property
    def is_settled(self) -> Mask:
        """Mask of regimes verified for all future time: orbit, no impact or lasting contact."""
        return np.isin(self.regime, [NO_IMPACT, PERIODIC, SUSTAINED_CONTACT])

    @property
    def quiet(self) -> Mask:
        """Mask of the cells that end without impacts, (y, x)."""
        mask: Mask = self.regime == NO_IMPACT
        return mask

    @property
    def strikes(self) -> Mask:
        """Mask of the cells whose impacts continue: verified orbits and chaos."""
        mask: Mask = (self.regime == PERIODIC) | (self.regime == CHAOTIC)
        return mask

    @property
    def has_both(self) -> bool:
        """Whether a basin has both starts that end in impacts and starts that end without."""
        return min(self.share(self.strikes), self.share(self.quiet)) >= SOME

    def called_nearer(self, shift: float) -> "Plane":
        """The same cells, their gaps told as smaller by `shift` [A0]."""
        if self.kind == "map":
            return replace(self, rows=self.rows - shift)
        point = self.job["operating_point"]
        return replace(self, job=self.job | {"operating_point": point | {"gap_ratio": point["gap_ratio"] - shift}})

    def share(self, mask: Mask) -> float:
        """Share of all cells in the mask."""
        return float(np.mean(mask))

    def column_at_hz(self, frequency_hz: float) -> int:
        """The column nearest to a frequency. Raises PeterkaFileError where the map doesn't reach it."""
        return self._nearest(self.frequency_hz, frequency_hz, "Hz")

    def row_at(self, value: float) -> int:
        """The row nearest to a value of its axis. Raises PeterkaFileError where the map doesn't reach it."""
        return self._nearest(self.rows, value, "gap/A0")

    def _nearest(self, values: Reals, value: float, unit: str) -> int:
        step = np.ptp(values) / max(len(values) - 1, 1)
        nearest = int(np.argmin(np.abs(values - value)))
        if len(values) > 1 and abs(values[nearest] - value) > step:
            raise PeterkaFileError(f"{self.path} reaches from {values[0]:.4g} to {values[-1]:.4g} {unit}; a map of this name is to reach {value:.4g}")
        return nearest


@dataclass(frozen=True)
class Curves:
    """Contents of a file of curves: its job, and the curves' crossings of the gaps that the job names."""

    job: dict[str, Any]
    crossings: list[Crossing]


class Folder:
    """The files of a folder, by name without .h5. Where its rig has all gaps larger by `gap_shift_mm` [mm] than they are called, they
    are told as they are called."""

    def __init__(self, path: str | Path, gap_shift_mm: float = 0.0) -> None:
        self.path = Path(path)
        self.gap_shift_mm = gap_shift_mm

    def plane(self, name: str) -> Plane | None:
        """The cells of a map or a basin; None if the file does not exist."""
        path = self.path / f"{name}.h5"
        return self._read(path) if path.exists() else None

    def curves(self, name: str) -> Curves | None:
        """The curves of a file; None if the file does not exist."""
        path = self.path / f"{name}.h5"
        if not path.exists():
            return None
        with CurvesFile(path) as file:
            job = read_job(file)
            shift = self.gap_shift_mm / (1e3 * job["cart"]["amplitude_m"])
            return Curves(job, [replace(each, gap_ratio=each.gap_ratio - shift) for each in file.crossings])

    def planes(self, prefix: str) -> list[Plane]:
        """All files whose names begin with `prefix`, ordered by name."""
        return [self._read(path) for path in sorted(self.path.glob(f"{prefix}*.h5"))]

    def _read(self, path: Path) -> Plane:
        """Reads a plane of the kind that the name implies."""
        plane = read_plane(path)
        kind = "basin" if path.relative_to(self.path).as_posix().startswith(BASINS) else "map"
        if plane.kind != kind:
            raise PeterkaFileError(f"{path} is a {plane.kind}; a {kind} of this name is needed")
        return plane.called_nearer(self.gap_shift_mm / plane.amplitude_mm) if self.gap_shift_mm else plane

    def picture(self, name: str) -> bool:
        """Whether draw.py made this picture."""
        return (self.path / "pictures" / f"{name}.png").exists()


def require_alike(planes: Sequence[Plane]) -> None:
    """Requires planes that can be compared cell by cell."""
    for plane in planes[1:]:
        if plane.regime.shape != planes[0].regime.shape:
            raise PeterkaFileError(f"{plane.path} has {plane.regime.shape} cells, and {planes[0].path} {planes[0].regime.shape}; "
                              "they are compared cell by cell")


def read_plane(path: Path) -> Plane:
    """The cells of a file, which must be complete."""
    with PeterkaFile(path) as file:
        names = ["regime", "impacts", "period", "peak_force_ratio"] + ["last_impact"] * file.has_last_impact
        bands = [band for _, band in file.bands(names)]
        fields: dict[str, Any] = {name: np.concatenate([band[name] for band in bands]) for name in names}
        if np.any(fields["regime"] == NOT_COMPUTED) or not file.data.is_finished:
            raise file.refusal("is not complete; finish it with the command that began it")
        return Plane(path, file.kind, read_job(file), file.rows.values, file.columns.values,
                     last_impact=fields.pop("last_impact", None), **fields)


def read_job(file: OpenedFile) -> dict[str, Any]:
    """The job of a file as tables, with all numbers required of a rig,
    including its natural frequency whichever way the job gave the stiffness."""
    text = file.data.attribute("job")
    try:
        job = tomllib.loads(text if isinstance(text, str) else "")
        hammer = job["hammer"]
        hammer.setdefault("natural_frequency_hz", file.positive("natural_frequency_hz"))
        _require(hammer, ("natural_frequency_hz", "mass_kg"), least=SMALLEST)
        _require(job["cart"], ("amplitude_m",), least=SMALLEST)
        if file.kind == "basin":
            _require(job["operating_point"], ("frequency_ratio", "gap_ratio"))
        return job
    except (tomllib.TOMLDecodeError, KeyError, TypeError, AttributeError, ValueError, RecursionError) as error:
        raise file.refusal(f"holds no job that can be read ({type(error).__name__}: {error})") from error


def _require(table: Mapping[str, Any], keys: Iterable[str], least: float = -LARGEST) -> None:
    for key in keys:
        if not is_number(table[key]) or not least <= table[key] <= LARGEST:
            raise ValueError(f"{key} = {harmless(table[key], 40)}")


__all__ = ["Folder", "LARGEST", "Plane", "SMALLEST", "read_plane", "require_alike"]
