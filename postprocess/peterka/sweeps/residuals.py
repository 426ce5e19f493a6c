"""How far measured forces are from a sweep: each from the nearest branch of its gap, as a table."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ..measurements import tables
from ..measurements.points import Point
from .sweep_file import Branch, SweepFile


@dataclass(frozen=True)
class Residual:
    """`force` of the branch that is nearest at the point's frequency [F/(m g)], between the sweep's own frequencies linear."""

    point: Point
    branch: Branch
    force: float

    @property
    def share(self) -> float | None:
        """Of the computed force by which the measured one is above it; None where nothing impacts."""
        assert self.point.force is not None
        return self.point.force / self.force - 1 if self.force > 0 else None


def residuals(file: SweepFile, points: Iterable[Point]) -> list[Residual]:
    """[Residual] of the points with a force, in their order; those outside the sweep have none."""
    return [found for point in points if point.force is not None
            for found in [_nearest(file, point)] if found is not None]


def table(file: SweepFile, found: Sequence[Residual]) -> list[str]:
    """Lines; in Hz and N where the file tells the rig."""
    hertz = 1.0 if file.axis_name == "frequency_hz" else file.positive("natural_frequency_hz")
    newtons = file.newtons
    units = "Hz" if hertz else "Omega/omega", "N" if newtons else "F/(m g)"
    heads = (f"frequency [{units[0]}]", "gap/A0", f"measured [{units[1]}]", f"computed [{units[1]}]", "branch", "off by", "label")
    rows = []
    for one in found:
        forces = one.point.force or 0.0, one.force
        rows.append((f"{one.point.frequency * (hertz or 1):.5g}", f"{one.branch.gap_ratio:.4g}",
                     *(f"{force * (newtons or 1):.4g}" for force in forces), one.branch.direction,
                     tables.share(one.point, one.force), tables.name_of(one.point)))
    return tables.lines(heads, rows)


def _nearest(file, point):
    branches = [branch for gap in file.gaps if point.gap in (None, gap) for branch in file.at_gap(gap)]
    forces = [(branch, _force(file, branch, point.frequency)) for branch in branches]
    forces = [(branch, force) for branch, force in forces if np.isfinite(force)]
    if not forces:
        return None
    return Residual(point, *min(forces, key=lambda found: abs(found[1] - point.force)))


def _force(file, branch, frequency):
    """Of a branch at this frequency, from both points around it; NaN outside the sweep, where one has no force, and across a
    jump, where nothing lies between."""
    x = file.values
    after = int(np.searchsorted(x, frequency))
    if after < len(x) and x[after] == frequency:
        return float(branch.force[after])
    jump = branch.jump[after - 1 if branch.direction == "down" else after] if 0 < after < len(x) else True
    if jump:
        return np.nan
    weight = (frequency - x[after - 1]) / (x[after] - x[after - 1])
    return float((1 - weight) * branch.force[after - 1] + weight * branch.force[after])
