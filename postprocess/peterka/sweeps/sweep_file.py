"""A checked sweep file: branches along the frequency, one for each gap and direction, each with the classes and peak forces
of a map and with samples of its steady motions.

Layout versions 2 and 3, on [branch][frequency_ratio], or another axis of its job: regime int8, impacts and period int32, peak_force_ratio f64 [F/(m g)],
jump int8; on [branch][frequency_ratio][sample], NaN-padded f64: stroboscopic_displacement [x/A0 at forcing phase 0] and
impact_displacement [x/A0 at first touch]. With [starts], on [attractor][branch][frequency_ratio]: basin_share, attractor_peak_force_ratio f64,
attractor_regime int8, attractor_impacts and attractor_period int32, start_attractor int32 without the first; and samples of all attractors' motions, attractor_stroboscopic_displacement and
attractor_impact_displacement. What cannot be drawn raises PeterkaFileError.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers, Reals, Mask
from ..files.checked_hdf5 import INTEGER, REAL
from ..files.coordinates import coordinate
from ..files.job_axes import axes_of_job
from ..files.opened import OpenedFile
from ..files.regimes import CHAOTIC, NOT_COMPUTED, PERIODIC, UNRESOLVED, check_labels
from ..maps.map_file import Axis, axis_of
from ..maps.outcomes import QUANTILES, check_outcomes, quantiles

MAX_POINTS = 2**20  # of all branches together
MAX_SAMPLES = 2**27
DIRECTIONS = ("up", "down", "independent")
CELLS = {"regime": INTEGER, "impacts": INTEGER, "period": INTEGER, "peak_force_ratio": REAL, "jump": INTEGER}
SAMPLED = ("stroboscopic_displacement", "impact_displacement")
OF_ATTRACTORS = {"attractor_regime": INTEGER, "attractor_impacts": INTEGER, "attractor_period": INTEGER,
                 "attractor_peak_force_ratio": REAL, "basin_share": REAL}
MAX_SLOTS = 64
LEAST_CHANGE = 1e-6  # of the largest value: smaller changes may be rounding, which changes a verified motion by up to 5e-8
WITHOUT_PERIOD = (CHAOTIC, UNRESOLVED)
_GAPS = ("gap_ratio", "gap_m")


@dataclass(frozen=True)
class Branch:
    """One gap and direction; every array has shape (points,), along the axis."""

    row: int
    gap_ratio: float | None  # None where the gap is the axis
    direction: str
    regime: Integers
    impacts: Integers
    period: Integers
    force: Reals  # F/(m g), NaN where there is none
    jump: Mask  # whether the force jumps from the previous point in the branch's direction to this one

    @property
    def has_period(self) -> Mask:
        """Mask of the points that are neither chaotic nor unresolved, (points,)."""
        mask: Mask = ~np.isin(self.regime, WITHOUT_PERIOD)
        return mask

    def jumps(self) -> list[tuple[int, int]]:
        """(index before, index after) of each jump, the largest first."""
        after = np.flatnonzero(self.jump)
        before = after + 1 if self.direction == "down" else after - 1
        order = np.argsort(-np.abs(self.force[after] - self.force[before]), kind="stable")
        return [(int(before[i]), int(after[i])) for i in order]

    def strongest_single(self) -> int | None:
        """Index of the largest force among z = 1/1; None if no point has one, or if rounding alone decides which is the largest."""
        single = self._single()
        forces = self.force[single]
        if not single.any() or (len(forces) > 1 and np.ptp(forces) < LEAST_CHANGE * forces.max()):
            return None
        return int(np.argmax(np.where(single, self.force, -1.0)))

    def is_resonance(self, at: int) -> bool:
        """Whether the largest force is a maximum inside its band of z = 1/1; otherwise it may be cut off by a jump, by
        another class or by the end of the sweep."""
        inside = 0 < at < len(self.force) - 1
        landings = (at, at - 1) if self.direction == "down" else (at, at + 1)
        return bool(inside and self._single()[at - 1:at + 2].all() and not self.jump[list(landings)].any())

    def _single(self) -> Mask:
        mask: Mask = (self.regime == PERIODIC) & (self.impacts == 1) & (self.period == 1) & (self.force > 0)
        return mask


class SweepFile(OpenedFile):
    """A checked, open sweep: axis, its name axis_name, values (points,), branches, gaps (ratios unless gap_name is gap_m
    because the cart's amplitude is the axis), slots, the number of attractors stored at each point (0 without [starts]), and
    outcome_slots, that of outcomes (0 without [uncertainty])."""

    gap_name = "gap_ratio"

    @cached_property
    def computed(self) -> float:
        """Share of the points that are computed, 0 to 1."""
        return float(np.mean([np.mean(branch.regime != NOT_COMPUTED) for branch in self.branches]))

    @property
    def lacks_forces(self) -> bool:
        """Whether there are motions with impacts, and none has a force."""
        return any(np.any(branch.impacts > 0) for branch in self.branches) and not any(np.any(branch.force > 0) for branch in self.branches)

    @cached_property
    def cells(self) -> Axis:
        """Its axis as that of a map: logarithmic or not, with an edge on either side of each point."""
        return axis_of(self.axis_name, self.values)

    @property
    def gaps(self) -> list[float | None]:
        """Gap ratios in the order of the file, each once."""
        return list(dict.fromkeys(branch.gap_ratio for branch in self.branches))

    def at_gap(self, gap: float | None) -> list[Branch]:
        """The branches at one of the gaps."""
        return [branch for branch in self.branches if branch.gap_ratio == gap]

    def samples(self, name: str, branch: Branch) -> tuple[Integers, Reals]:
        """(index of the point, value) of every sample of a branch, two arrays of one length."""
        values = np.asarray(self.data.values(name, branch.row), dtype=float)
        points, columns = np.nonzero(np.isfinite(values))
        return points, values[points, columns]

    def attractor_samples(self, name: str, branch: Branch) -> tuple[Integers, Reals]:
        """The same for the motions on all attractors of the branch's points."""
        return self.samples(f"attractor_{name}", branch)

    def attractor_forces(self, branch: Branch) -> Reals:
        """Forces (slots, points) [F/(m g)]; NaN in empty slots and for attractors without one."""
        slots = self.attractors(branch)
        return np.where(slots["attractor_regime"] >= 0, np.asarray(slots["attractor_peak_force_ratio"], dtype=float), np.nan)

    def attractors(self, branch: Branch) -> dict[str, NDArray[Any]]:
        """{dataset: (slots, points)} of OF_ATTRACTORS, at the points of a branch."""
        slots = {name: self.data.values(name, (slice(None), branch.row)) for name in OF_ATTRACTORS}
        check_labels(self.data, {name.removeprefix("attractor_"): values for name, values in slots.items()})
        return slots

    def start_attractor(self, branch: Branch) -> Integers:
        """The attractor slot of a branch at each of its points, (points,); negative if none."""
        return np.asarray(self.data.values("start_attractor", branch.row))

    def force_quantiles(self, branch: Branch) -> Reals:
        """Of QUANTILES over the drawn rigs, (3, points): of forces [F/(m g)], or of impact speeds [m/s]."""
        names = quantiles(self.data)
        values = np.array([self.data.values(names[share], branch.row) for share in QUANTILES], dtype=float)
        for share, row in zip(QUANTILES, values):
            if np.isinf(row).any():
                raise self.refusal(f"has an infinite {names[share]}")
        return values

    def check_content(self) -> None:
        """Sets the documented members; raises PeterkaFileError for invalid content."""
        names = axes_of_job(self.data.attribute("job"))
        self.axis = coordinate(self, names[0] if len(names) == 1 and self.data.has(names[0]) else "frequency_ratio")
        self.axis_name = self.axis.name
        self.values = self._numbers(self.axis.stored) / self.axis.unit
        if not (np.isfinite(self.values).all() and np.all(np.diff(self.values) > 0)):
            raise self.refusal(f"has a coordinate {self.axis_name} that does not ascend")
        gaps = self._gaps()
        shape = (len(gaps), len(self.values))
        if np.prod(shape) > MAX_POINTS:
            raise self.refusal(f"has {np.prod(shape)} points; at most {MAX_POINTS} can be drawn")
        self.slots = self._slots(shape)
        self.outcome_slots = check_outcomes(self.data, shape, MAX_SAMPLES)
        self._check_samples(shape)
        directions = self._directions(len(gaps))
        self.branches = [self._branch(row, gap, direction, shape)
                         for row, (gap, direction) in enumerate(zip(gaps, directions))]

    def _gaps(self) -> list[float | None]:
        """Gaps of the branches: one each, or a common one for the whole file; None if the gap is the axis."""
        stored = next((name for name in _GAPS if self.data.has(name) and self.axis.stored not in _GAPS), None)
        if stored is None:
            branches = self.data.dataset("direction", None, INTEGER).shape
            if len(branches) != 1 or not 1 <= branches[0] <= MAX_POINTS:
                raise self.refusal(f"has branches of shape {branches}")
            return [self.number("gap_ratio")] * branches[0]
        gap = coordinate(self, stored)
        self.gap_name = gap.name
        gaps = self._numbers(stored) / gap.unit
        if not np.isfinite(gaps).all():
            raise self.refusal(f"has a {stored} that is no number")
        return [float(value) for value in gaps]

    @property
    def frequency_ratio(self) -> Reals:
        """Frequency ratios at the points: the axis of a frequency sweep; otherwise a common value if the file gives it."""
        shared = self.positive("frequency_ratio")
        return self.values if self.axis_name == "frequency_ratio" or shared is None else np.full(len(self.values), shared)

    def _numbers(self, name: str) -> Reals:
        shape = self.data.dataset(name, None, REAL).shape
        if len(shape) != 1 or not 1 <= shape[0] <= MAX_POINTS:
            raise self.refusal(f"has {name} of shape {shape}; 1 to {MAX_POINTS} can be drawn")
        return np.asarray(self.data.values(name, slice(None)), dtype=float)

    def _directions(self, count: int) -> list[str]:
        self.data.dataset("direction", (count,), INTEGER)
        numbers = self.data.values("direction", slice(None))
        if not np.isin(numbers, range(len(DIRECTIONS))).all():
            raise self.refusal(f"has a direction that is not one of {', '.join(DIRECTIONS)}")
        return [DIRECTIONS[number] for number in numbers]

    def _check_samples(self, shape: tuple[int, ...]) -> None:
        samples = self.data.dataset("sample", None, INTEGER).shape
        if len(samples) != 1 or np.prod(shape) * samples[0] > MAX_SAMPLES:
            raise self.refusal(f"has samples of shape {(*shape, *samples)}, too many to draw")
        for name in SAMPLED:
            self.data.dataset(name, (*shape, *samples), REAL)
            if self.slots:
                self.data.dataset(f"attractor_{name}", (*shape, *samples), REAL)

    def _slots(self, shape: tuple[int, ...]) -> int:
        if not self.data.has("basin_share"):
            return 0
        slots = self.data.dataset("basin_share", None, REAL).shape[:1]
        if not slots or not 1 <= slots[0] <= MAX_SLOTS or slots[0] * np.prod(shape) > MAX_SAMPLES:
            raise self.refusal(f"keeps {slots[0] if slots else 'no'} attractors at each point; 1 to {MAX_SLOTS} can be drawn")
        for name, kinds in OF_ATTRACTORS.items():
            self.data.dataset(name, slots + shape, kinds)
        self.data.dataset("start_attractor", shape, INTEGER)
        return int(slots[0])

    def _branch(self, row: int, gap: float | None, direction: str, shape: tuple[int, ...]) -> Branch:
        for name, kinds in CELLS.items():
            self.data.dataset(name, shape, kinds)
        cells = {name: self.data.values(name, row) for name in CELLS}
        check_labels(self.data, cells)
        if not np.isin(cells["jump"], [0, 1, NOT_COMPUTED]).all():
            raise self.refusal("has a jump that is neither 0 nor 1")
        jump = cells["jump"] == 1
        jump[-1 if direction == "down" else 0] = False  # there is no previous point
        return Branch(row, gap, direction, cells["regime"], cells["impacts"], cells["period"],
                      np.asarray(cells["peak_force_ratio"], dtype=float), jump)
