"""The single regime in which the admitted starts of each cell end, and the worst value over them.

A map with [starts] stores all attractors of a cell: on [attractor][rows][columns] attractor_regime int8, attractor_impacts
and attractor_period int32, attractor_peak_force_ratio f64 and basin_share f64 (share of the starts; empty slots have 0 and
regime -128; known motions reached by no start have share 0 and a regime), and on [rows][columns] start_attractor int32, the
slot in which the job's own start ends, -1 for none of them. Admitted starts:

    any      all of them, and the job's own: each must end in that regime, and no other motion may be known
    share s  at least the share s of them, s above one half
    job      the job's own start alone, as in a map without [starts]

Only orbits with impacts count: the largest observed force of chaos is not reliable.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers, Mask, Reals
from ..files.checked_hdf5 import INTEGER, REAL
from ..files.opened import STANDARD_GRAVITY
from ..files.regimes import NOT_COMPUTED, PERIODIC, check_labels
from ..maps.comparison import label_codes
from ..maps.map_file import PeterkaFile
from ..maps.rig_numbers import along_axes, values_of

ANY, JOB = "any", "job"
OVER_WEIGHT = "F/(m g)"  # the unit of forces where no mass is known
MOST_SLOTS = 64
ROUNDING = 1e-9  # of a sum of shares
NO_REGIME = -1  # below every label code
SLOTS = {"attractor_regime": INTEGER, "attractor_impacts": INTEGER, "attractor_period": INTEGER,
         "attractor_peak_force_ratio": REAL, "basin_share": REAL}
QUANTITIES = {"peak_force": "peak_force_ratio", "contact_power": "contact_power_w", "impact_speed": "impact_speed"}


@dataclass(frozen=True)
class Admitted:
    """On [rows][columns]: `code` of the regime (label_codes; NO_REGIME if there is no single one), the worst `value` [as
    stored, or in the unit of a Quantity; NaN if the file lacks it], and the `share` of the starts that end in it (1 for `job`)."""

    code: Integers
    value: Reals
    share: Reals


@dataclass(frozen=True)
class Quantity:
    """The quantity to maximise: `name` from QUANTITIES, `title`, and the factor from the stored numbers to `unit`, for all cells or on
    [rows][columns]."""

    name: str
    title: str
    factor: float | Reals
    unit: str

    def of(self, stored: Admitted) -> Admitted:
        """An Admitted with its values in this unit."""
        return replace(stored, value=stored.value * self.factor)


def quantity_of(file: PeterkaFile, name: str) -> Quantity:
    """The Quantity of this name in a map. Raises PeterkaFileError if the map lacks it."""
    dataset = QUANTITIES[name]
    if dataset != "peak_force_ratio" and dataset not in file.quantities:
        raise file.refusal(f'has no {dataset}; compute it with --set \'output.fields=["{dataset}"]\'')
    if name == "peak_force":
        return force_quantity(file, "peak force")
    return Quantity(name, {"contact_power": "power into the contact", "impact_speed": "impact speed"}[name], 1.0,
                    "W" if name == "contact_power" else "m/s")


def force_quantity(file: PeterkaFile, title: str) -> Quantity:
    """The Quantity of peak forces, in N by each cell's own mass, over the weight where the file tells none."""
    weights = weights_of(file)
    return Quantity("peak_force", title, 1.0, OVER_WEIGHT) if weights is None else Quantity("peak_force", title, weights, "N")


def weights_of(file: PeterkaFile) -> Reals | None:
    """The weight of each cell's hammer [N], (rows, columns); None if the file tells no mass."""
    mass = file.positive("hammer_mass_kg") or values_of(file, along_axes(file), "hammer_mass_kg")
    return None if mass is None else np.broadcast_to(mass * STANDARD_GRAVITY, file.shape)


def has_starts(file: PeterkaFile) -> bool:
    """Whether a map was computed with [starts]."""
    return file.data.has("basin_share")


def admitted(file: PeterkaFile, starts: str | float, name: str) -> Admitted:
    """The Admitted of a map; `starts` is ANY, JOB or a share."""
    slots = 0
    if starts != JOB:
        slots = _check_slots(file)
    pieces = [_band(file, first, band, starts, name, slots) for first, band in file.bands(_names(name))]
    return Admitted(*(np.concatenate([piece[n] for piece in pieces]) for n in range(3)))


def read_code(code: int) -> tuple[int, int]:
    """(p, q) of a code of an orbit."""
    orbit = int(code) - int(label_codes(np.array([PERIODIC]), np.array([0]), np.array([0]))[0])
    return orbit >> 32, orbit & 0xFFFFFFFF


def _names(name: str) -> list[str]:
    return list(dict.fromkeys(["regime", "impacts", "period", "peak_force_ratio", QUANTITIES[name]]))


def _check_slots(file: PeterkaFile) -> int:
    if not has_starts(file):
        raise file.refusal("was computed from one start alone; compute it with [starts], or ask for --starts job")
    shape = file.data.dataset("basin_share", None, REAL).shape
    if len(shape) != 3 or shape[1:] != file.shape or not 1 <= shape[0] <= MOST_SLOTS:
        raise file.refusal(f"has basin_share of shape {shape} over cells of shape {file.shape}")
    for dataset, kinds in SLOTS.items():
        file.data.dataset(dataset, shape, kinds)
    file.data.dataset("start_attractor", file.shape, INTEGER)
    for dataset in QUANTITIES.values():
        if file.data.has(f"attractor_{dataset}"):
            file.data.dataset(f"attractor_{dataset}", shape, REAL)
    return int(shape[0])


def _band(file: PeterkaFile, first: int, band: Mapping[str, NDArray[Any]], starts: str | float, name: str,
          slots: int) -> tuple[Integers, Reals, Reals]:
    own = label_codes(band["regime"], band["impacts"], band["period"])
    value = band[QUANTITIES[name]]
    if starts == JOB:
        code = np.where(_strikes(band["regime"], band["impacts"]), own, NO_REGIME)
        return code, value, np.ones(code.shape)
    rows = slice(first, first + len(own))
    stored = {key: file.data.values(key, (slice(0, slots), rows)) for key in SLOTS}
    shares = stored["basin_share"]
    if not np.all((shares >= 0) & (shares <= 1 + ROUNDING)):
        raise file.refusal("has a basin_share that is no share")
    regime, impacts, period = (stored[f"attractor_{key}"] for key in ("regime", "impacts", "period"))
    check_labels(file.data, {"regime": regime, "impacts": impacts, "period": period})
    used = (regime != NOT_COMPUTED) & ((shares > 0) | (starts == ANY))
    codes = np.where(_strikes(regime, impacts) & used, label_codes(regime, impacts, period), NO_REGIME)
    least = 1.0 if starts == ANY else float(starts)
    code, share = _common(codes, shares, least - ROUNDING)
    if starts == ANY:
        code = np.where((used & (codes != code)).any(axis=0), NO_REGIME, code)
    here = (codes == code) & (code != NO_REGIME)
    kept = file.data.values("start_attractor", rows)
    worst = _worst(file, QUANTITIES[name], stored, here, (value, kept), (slice(0, slots), rows))
    if starts == ANY:
        code = np.where(own == code, code, NO_REGIME)
        worst = np.minimum(worst, value)  # NaN propagates
    return code, worst, share


def _strikes(regime: Integers, impacts: Integers) -> Mask:
    mask: Mask = (regime == PERIODIC) & (impacts > 0)
    return mask


def _common(codes: Integers, shares: Reals, least: float) -> tuple[Integers, Reals]:
    """The code shared by at least this share of the starts, NO_REGIME if there is none, and its share."""
    code, share = np.full(codes.shape[1:], NO_REGIME, dtype=np.int64), np.zeros(codes.shape[1:])
    for slot in range(len(codes)):
        total = np.where(codes == codes[slot], shares, 0).sum(axis=0)
        holds = (codes[slot] != NO_REGIME) & (total >= least)
        code, share = np.where(holds, codes[slot], code), np.where(holds, total, share)
    return code, share


def _worst(file: PeterkaFile, dataset: str, stored: Mapping[str, NDArray[Any]], here: Mask, own: tuple[Reals, Integers],
           index: tuple[slice, slice]) -> Reals:
    """The smallest value over the selected slots; NaN if the file lacks one of them."""
    if dataset == "peak_force_ratio":
        values = stored["attractor_peak_force_ratio"]
    elif file.data.has(f"attractor_{dataset}"):
        values = file.data.values(f"attractor_{dataset}", index)
    else:  # the file has only that of the attractor reached by the job's own start
        value, kept = own
        values = np.where(np.arange(len(here))[:, None, None] == kept, value, np.nan)
    smallest = np.where(here, values, np.inf).min(axis=0)  # NaN propagates
    return np.where(np.isinf(smallest), np.nan, smallest)
