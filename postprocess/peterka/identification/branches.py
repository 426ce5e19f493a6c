"""Branches of periodic motions along the excitation frequency, computed by the program, with the derivatives of their peak forces.

A sweep is solved on a grid of frequencies, up and down. What lies between two of its points is a cubic in ln F with the exact slopes of
the file's elasticities (Hermite), so that a force at a measured frequency is as accurate as those on the grid.
"""

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from ..arrays import Reals
from ..files.opened import STANDARD_GRAVITY
from ..files.regimes import NO_IMPACT, PERIODIC
from ..runs import compute as solve
from ..sweeps.sweep_file import Branch, SweepFile
from .numbers_found import DAMPING, DAMPING_RATIO, FREQUENCY, GAP, STIFFNESS
from .sweep_rig import SweptRig

FIELDS = {STIFFNESS: "contact_stiffness_n_per_m", DAMPING: "contact_damping_ns_per_m", FREQUENCY: "hammer_natural_frequency_hz",
          DAMPING_RATIO: "hammer_damping_ratio", GAP: "gap_m"}
BY_FREQUENCY = "frequency_hz"
LEAST_GAP = 1e-7  # of A0: an elasticity by a gap of 0 doesn't exist, and that much changes no force
BEFORE, BEYOND = 0.75, 1.3  # of the lowest and highest measured frequency: branches begin outside, as a motor's do
SMOOTH, LEAST_STEP = 0.5, 2e-3  # of the change that the slopes of both ends tell, and of ln F: a larger difference is a jump
NARROW = 0.05  # of its frequency: width of a branch within a cascade, say
STEEP = 0.3  # change of ln F in one step of the grid: steeper, a branch is about to end


@dataclass(frozen=True)
class Strand:
    """A motion followed along the frequency: `hertz` ascending, `log_force` [ln N], `slope` d ln F/dHz, `slopes` {key: d ln F/d value, SI},
    each (points,); `direction` of the sweep that followed it."""

    label: str
    direction: str
    hertz: Reals
    log_force: Reals
    slope: Reals
    slopes: Mapping[str, Reals]

    @property
    def is_narrow(self) -> bool:
        """Whether errors of the rig may move it by more than its width, so that a point in its place needn't be on it."""
        return bool(np.ptp(self.hertz) < NARROW * self.hertz[0])

    def beyond(self, hertz: float) -> float:
        """How far a frequency lies outside [Hz]; 0 inside."""
        return max(float(self.hertz[0]) - hertz, hertz - float(self.hertz[-1]), 0.0)

    def at(self, hertz: float) -> float:
        """ln F at a frequency; outside, that of the nearer end."""
        inside = float(np.clip(hertz, self.hertz[0], self.hertz[-1]))
        return float(CubicHermiteSpline(self.hertz, self.log_force, self.slope)(inside))

    def slopes_at(self, hertz: float, keys: Sequence[str]) -> Reals:
        """d ln F/d value of each key, (keys,)."""
        return np.array([np.interp(hertz, self.hertz, self.slopes[key]) for key in keys])


@dataclass(frozen=True)
class Landscape:
    """All that is computed at one gap: `strands`; `hertz` (points,) with the words for what `others` (points,) do there, "" where every
    branch is on a strand, and their largest forces `scattered` [N] (branches, points), NaN on strands."""

    strands: Sequence[Strand]
    hertz: Reals
    others: Sequence[str]
    scattered: Reals

    def other_at(self, hertz: float) -> str:
        """What moves without a strand at a frequency."""
        return self.others[int(np.argmin(np.abs(self.hertz - hertz)))]


def compute(rig: SweptRig, gaps: Sequence[float], span: tuple[float, float], points: int, keys: Sequence[str]) -> list[Landscape]:
    """A Landscape for each gap [m], over `span` [Hz] of measured frequencies. Raises PeterkaError if the program doesn't compute it."""
    least = LEAST_GAP * rig.amplitude
    at = [gap if abs(gap) > least else least for gap in gaps]
    job = {"schema": 1, "kind": "sweep", **rig.tables, "sweep": {"gap_m": at, "direction": "both", "samples": 1},
           "axes": {"frequency_hz": {"from": BEFORE * span[0], "to": BEYOND * span[1], "points": points}},
           "output": {"fields": [f"force_elasticity_{name}" for name in (BY_FREQUENCY, *(FIELDS[key] for key in keys))]}}
    with tempfile.TemporaryDirectory(prefix="peterka-") as folder:
        path = Path(folder) / "sweep.h5"
        solve(job, path)
        return _read(path, rig, at, keys)


def _read(path: Path, rig: SweptRig, gaps: Sequence[float], keys: Sequence[str]) -> list[Landscape]:
    """The Landscapes of a file with up and down branches at these gaps [m]."""
    newtons = rig.mass * STANDARD_GRAVITY
    with SweepFile(path) as file:
        found, hertz = [], np.asarray(file.data.values("frequency_hz", slice(None)), dtype=float)
        elasticities = {name: np.asarray(file.data.values(f"force_elasticity_{name}", slice(None)))
                        for name in (BY_FREQUENCY, *(FIELDS[key] for key in keys))}
        for number, gap in enumerate(gaps):
            branches = file.branches[2 * number:2 * number + 2]
            values = {key: gap if key == GAP else float(rig.value(key) or 0) for key in keys}
            strands = [strand for branch in branches for strand in _strands(
                branch, hertz, newtons, elasticities[BY_FREQUENCY][branch.row] / hertz,
                {key: elasticities[FIELDS[key]][branch.row] / values[key] for key in keys})]
            found.append(_landscape(strands, branches, hertz, newtons))
        return found


def _strands(branch: Branch, hertz: Reals, newtons: float, slope: Reals, slopes: Mapping[str, Reals]) -> list[Strand]:
    known = (branch.regime == PERIODIC) & (branch.force > 0) & np.all(np.isfinite([slope, *slopes.values()]), axis=0)
    log_force = np.log(newtons * np.where(known, branch.force, 1.0))
    step = np.diff(hertz)
    known &= np.abs(np.where(known, slope, 0.0)) * step[0] < STEEP
    found, first = [], 0
    for after in range(1, len(hertz) + 1):
        if after < len(hertz) and _goes_on(branch, known, log_force, slope, step[after - 1], after):
            continue
        if known[first] and after - first > 1:
            inside = slice(first, after)
            found.append(Strand(f"{branch.impacts[first]}/{branch.period[first]}", branch.direction, hertz[inside], log_force[inside],
                                slope[inside], {key: one[inside] for key, one in slopes.items()}))
        first = after
    return found


def _goes_on(branch: Branch, known: Reals, log_force: Reals, slope: Reals, step: float, after: int) -> bool:
    """Whether the motion at a point is that of the point before."""
    pair = [after - 1, after]
    if not known[pair].all() or np.ptp(branch.impacts[pair]) or np.ptp(branch.period[pair]):
        return False
    change, told = log_force[after] - log_force[after - 1], step * slope[pair]
    return bool(abs(change - told.mean()) <= SMOOTH * np.abs(told).max() + LEAST_STEP)


def _landscape(strands: Sequence[Strand], branches: Sequence[Branch], hertz: Reals, newtons: float) -> Landscape:
    others, scattered = [], np.full((len(branches), len(hertz)), np.nan)
    for row, branch in enumerate(branches):
        off = (branch.regime != PERIODIC) & (branch.regime != NO_IMPACT) & np.isfinite(branch.force)
        scattered[row, off] = newtons * branch.force[off]
    for at in range(len(hertz)):
        regimes = {int(branch.regime[at]) for branch in branches}
        others.append("chaos" if np.isfinite(scattered[:, at]).any() else "no impact" if NO_IMPACT in regimes else "")
    return Landscape(strands, hertz, others, scattered)
