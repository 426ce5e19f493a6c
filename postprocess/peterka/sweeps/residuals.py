"""Residuals of measured forces against a sweep: each point against every branch and every other attractor of its gap, as a table."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers
from ..measurements import tables
from ..measurements.map_residuals import known
from ..measurements.matches import Known, Match, Place, around, distance, matches
from ..measurements.points import Point, lies_between
from .sweep_file import OF_ATTRACTORS, Branch, SweepFile

Slots = tuple[dict[str, NDArray[Any]], Integers]


def residuals(file: SweepFile, points: Iterable[Point]) -> list[list[Match]]:
    """The [Match] of each point with a force, in their order; empty for points outside the sweep."""
    slots = {gap: _slots(file, file.at_gap(gap)) for gap in file.gaps}
    return [matches(point, _places(file, point, slots)) for point in points
            if point.force is not None and lies_between(file.values, point.frequency)]


def table(file: SweepFile, found: Sequence[Sequence[Match]]) -> list[str]:
    """The table as lines; in Hz, mm and N if the file gives the rig. Where impacts have no force, a line says so."""
    hertz = 1.0 if file.axis_name == "frequency_hz" else file.positive("natural_frequency_hz")
    metres = 1.0 if file.gap_name == "gap_m" else file.positive("cart_amplitude_m")
    lines = tables.table([each for each in found if each], tables.Units(hertz, metres and 1000 * metres, file.newtons))
    return [*lines, f"{file.path}: impacts have no peak force, as on a rigid stop: there is none to compare measured forces with"] if found and file.lacks_forces else lines


def _slots(file: SweepFile, branches: Sequence[Branch]) -> Slots | None:
    """({dataset: (slots, points)}, slots occupied by branches (points, branches)) of a gap; None without [starts]."""
    return (file.attractors(branches[0]), np.column_stack([file.start_attractor(branch) for branch in branches])) if file.slots else None


def _places(file: SweepFile, point: Point, slots: Mapping[float | None, Slots | None]) -> list[Place]:
    gap = point.gap if point.gap is not None else file.gaps[0]
    ends = around(file.values, point.frequency)
    first, last = ends[0][0], ends[-1][0]
    return [Place(weight, (distance(point.frequency, file.values[at]), 0.0),
                  _merged([_on_branch(branch, at, first, last) for branch in file.at_gap(gap)]) + _beside(slots[gap], at))
            for at, weight in ends]


def _on_branch(branch: Branch, at: int, first: int, last: int) -> Known | None:
    """A branch's motion at a point; it continues to the other point except across a jump."""
    motion = known(branch.regime[at], branch.impacts[at], branch.period[at], branch.force[at])
    jumps = first != last and branch.jump[first if branch.direction == "down" else last]
    return None if motion is None else replace(motion, key=(branch.row, at if jumps else None),
                                               directions=(branch.direction,), goes_on=True)


def _merged(motions: Iterable[Known | None]) -> list[Known]:
    """Both branches of a gap are often on the same orbit, whose force is then the same but for rounding: told once."""
    found: list[Known] = []
    for motion in filter(None, motions):
        same = next((n for n, one in enumerate(found) if one.key[1] == motion.key[1] and one.words == motion.words
                     and distance(one.force, motion.force) == 0), None)
        if same is None:
            found.append(motion)
        else:
            found[same] = replace(found[same], directions=found[same].directions + motion.directions)
    return found


def _beside(slots: Slots | None, at: int) -> list[Known]:
    """The attractors at a point that no branch follows."""
    if slots is None:
        return []
    cells, taken = slots
    motions = [known(*(cells[name][slot, at] for name in OF_ATTRACTORS))
               for slot in range(len(cells["basin_share"])) if slot not in taken[at]]
    return [motion for motion in motions if motion is not None]
