"""Boundaries of a sweep's motions, from curves of the same rig: folds, period doublings and grazings at its gaps.

The curves' job lists the sweep's gaps in curves.gap_ratio. Of all curves there, those are kept that bound a motion which a
branch of the sweep has next to them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Mask
from ..errors import PeterkaFileError
from ..files.checked_hdf5 import is_number
from ..files.coordinates import coordinate
from ..files.job_numbers import tables_of
from ..files.opened import OpenedFile
from ..files.regimes import NO_IMPACT, PERIODIC
from ..maps.curves_file import SAME_GAP, WORDS, CurvesFile, differing, rig_of
from ..maps.curves_map import COLOURS, LOOKS, name_of
from ..plotting.coordinates import spoken
from .sweep_file import Branch, SweepFile

GAPS = ("gap_ratio", "gap_m")
SAME_PLACE = 1e-10  # relative, of two frequencies: more than nine digits


@dataclass(frozen=True)
class Border:
    """`kind` from WORDS; p and q of the orbit on the stable side of the curve, and one of the sweep's gaps."""

    frequency_ratio: float
    gap: float
    kind: str
    impacts: int
    period: int


NO_BORDERS: tuple[Border, ...] = ()


def read_borders(path: Path, sweep: OpenedFile) -> list[Border]:
    """The borders that the sweep's branches meet, by gap and frequency."""
    if not isinstance(sweep, SweepFile):
        raise PeterkaFileError(f"{sweep.path} is no sweep but a {sweep.kind}; borders are drawn over a sweep of frequencies")
    if sweep.axis_name != "frequency_ratio":
        raise PeterkaFileError(f"{sweep.path} runs over {sweep.axis_name}; borders are drawn over a sweep of frequencies")
    with CurvesFile(path) as file:
        if rig_of(file) != rig_of(sweep):
            raise PeterkaFileError(f"{path} has the curves of another rig than {sweep.path}{differing(file, sweep)}")
        crossings = file.crossings
    borders = [Border(each.frequency_ratio, gap, each.curve.kind, each.curve.impacts, each.curve.period)
               for gap in sweep.gaps if gap is not None
               for each in crossings if abs(each.gap_ratio - gap) < SAME_GAP]
    if not borders:
        raise PeterkaFileError(f"{path} tells no border at the gaps of {sweep.path}; {_to_compute(sweep)}")
    met = sorted((border for border in borders if _is_met(sweep, border)),
                 key=lambda border: (border.gap, border.frequency_ratio))
    return [border for n, border in enumerate(met) if not any(_is_same(border, other) for other in met[:n])]


def told(path: Path, sweep: SweepFile, borders: Sequence[Border]) -> list[str]:
    """The table of the borders that the sweep meets, or that it meets none, and the gaps at which the file has no curves."""
    with CurvesFile(path) as file:
        known = _gaps_of(file)
    lines = table(sweep, borders) if borders else [f"{path}: no motion of {sweep.path} meets a border at its gaps"]
    lacking = [gap for gap in sweep.gaps if known and gap is not None and all(abs(gap - one) >= SAME_GAP for one in known)]
    if lacking:
        lines.append(f"{path} has no curves at {_in_words(sweep, lacking)}; {_to_compute(sweep)}")
    return lines


def at_gap(borders: Sequence[Border], gap: float | None) -> list[Border]:
    """The borders at one of the sweep's gaps."""
    return [border for border in borders if border.gap == gap]


def handles(borders: Sequence[Border]) -> list[Line2D]:
    """Legend entries: one per kind."""
    return [Line2D([], [], label=WORDS[kind], color=COLOURS[kind], **_look(kind))
            for kind in WORDS if any(border.kind == kind for border in borders)]


def draw_borders(ax: Axes, borders: Sequence[Border]) -> None:
    """Draws a vertical line at each border."""
    low, high = ax.get_xlim()
    for border in borders:
        if low <= border.frequency_ratio <= high:
            ax.axvline(border.frequency_ratio, color=COLOURS[border.kind], zorder=1.2, **_look(border.kind))


def table(sweep: SweepFile, borders: Sequence[Border]) -> list[str]:
    """Lines; in Hz and mm where the file tells the rig and units are not to be ratios alone."""
    scales = [(spoken(sweep, name), words) for name, words in ((sweep.axis_name, "Omega/omega"), (sweep.gap_name, "gap/A0"))]
    rows = [(*(f"{unit.what} [{unit.unit}]" if unit else words for unit, words in scales), "z", "border")]
    across, up = (unit.factor if unit else 1.0 for unit, _ in scales)
    rows += [(f"{border.frequency_ratio * across:#.9g}", f"{border.gap * up:.6g}", name_of(border.impacts, border.period),
              WORDS[border.kind]) for border in borders]
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in rows]


def _gaps_of(file: CurvesFile) -> list[float]:
    """Ratios of the gaps at which a file's job asks for borders; none where it doesn't tell."""
    asked = tables_of(file.data.attribute("job")).get("curves")
    found = [(coordinate(file, name), asked[name]) for name in GAPS if isinstance(asked, dict) and isinstance(asked.get(name), list)]
    return [float(gap) / at.unit for at, gaps in found for gap in gaps if is_number(gap)]


def _to_compute(sweep: SweepFile) -> str:
    """What of a job of curves has them at all gaps of a sweep."""
    gap_of = coordinate(sweep, "gap_m" if sweep.data.has("gap_m") else sweep.gap_name)
    gaps = ", ".join(f"{gap * gap_of.unit:.10g}" for gap in sweep.gaps if gap is not None)
    return f"compute it with [curves] {gap_of.stored} = [{gaps}]"


def _in_words(sweep: SweepFile, gaps: Sequence[float]) -> str:
    """Gaps in mm where the file tells the rig."""
    unit = spoken(sweep, sweep.gap_name)
    return ", ".join(f"gap {gap * unit.factor:.6g} {unit.unit}" if unit else f"gap/A0 {gap:.6g}" for gap in gaps)


def _look(kind: str) -> dict[str, Any]:
    return {"linestyle": LOOKS[kind]["linestyle"], "linewidth": 0.7}


def _is_same(border: Border, other: Border) -> bool:
    """Whether a curve meets the gap there twice up to rounding, as at gap 0 where it begins."""
    own, others = (replace(each, frequency_ratio=0.0) for each in (border, other))
    return own == others and abs(border.frequency_ratio - other.frequency_ratio) < SAME_PLACE * border.frequency_ratio


def _is_met(sweep: SweepFile, border: Border) -> bool:
    """Whether a branch has the motion of one side within one and a half steps."""
    near = np.abs(sweep.values - border.frequency_ratio) <= 1.5 * np.max(np.diff(sweep.values), initial=0.0)
    p, q = border.impacts, border.period
    sides = {(p, q)} | ({(2 * p, 2 * q)} if border.kind == "period_doubling" else set())
    sides |= {(p + 1, q)} if border.kind == "grazing" else set()
    return any((near & _has(branch, *side)).any() for branch in sweep.at_gap(border.gap) for side in sides)


def _has(branch: Branch, impacts: int, period: int) -> Mask:
    motion = (branch.regime == PERIODIC) & (branch.impacts == impacts) & (branch.period == period)
    found: Mask = motion if impacts else branch.regime == NO_IMPACT
    return found
