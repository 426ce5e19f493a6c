"""Frequency response of uncertain rigs: per gap, the band that holds the peak forces of all but the lowest and the highest 5 % of the
drawn rigs, their median, and the branches of the job's own rig, with measured points over them.

Drawn rigs begin at starts of their own, not where a branch is, so that all branches of a gap have the same band. A rig that doesn't impact, or that failed, counts with force 0. Without forces, as on a rigid stop, the band is that of impact speeds.
"""

from collections.abc import Iterable

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..arrays import Reals
from ..maps.outcomes import QUANTILES, draws_of, quantiles
from ..measurements.points import NOTHING_MEASURED, Measurements, Point, lies_between
from ..plotting import style, units
from ..plotting.limits import WEIGHTS, requested
from ..plotting.picture import picture
from . import sweep_panels
from .sweep_file import Branch, SweepFile
from .sweep_panels import LOOKS, direction_words

BAND, MEDIAN = {"facecolor": "#B8C4CE", "linewidth": 0}, {"color": "black", "linewidth": 1.3, "linestyle": (0, (1, 1.2))}
OWN_WIDTH = 1.0  # pt, of the branches of the job's own rig, in the looks of their directions


@picture(SweepFile)
def draw(file: SweepFile, ax: Axes | None = None, *, measured: Measurements = NOTHING_MEASURED) -> list[Axes] | None:
    """The bands as a list of Axes, one per gap; None if no drawn rig impacts."""
    bands = {gap: file.force_quantiles(file.at_gap(gap)[0]) for gap in file.gaps}
    largest = max(float(np.nanmax(band, initial=0.0)) for band in bands.values())
    if not largest > 0:
        return None
    draws, is_force = draws_of(file), has_force_bands(file)
    shown = measured if is_force else NOTHING_MEASURED
    handles = [*_handles(file, is_force), *sweep_panels.measured_handles(shown, "force")]
    second = _second_scale(file, largest) if is_force else None
    in_si = (("N", file.newtons) if file.newtons else None) if is_force else ("m/s", 1.0)
    limits = requested(file, np.concatenate([band.ravel() for band in bands.values()]), in_si, WEIGHTS if is_force else "")
    label = r"peak force $F/(m\,g)$" if is_force else "impact speed (m/s)"
    panels = sweep_panels.panels(file, handles, label, second, ax, log=style.scale_option("log"),
                                 told=f"{draws.in_words}; {_begin_in_words(file)}")
    for gap, panel in panels.items():
        _draw_band(panel, file, bands[gap])
        for branch in file.at_gap(gap) if is_force else ():
            look = LOOKS[branch.direction]
            panel.plot(*sweep_panels.line_through(file, branch.force), color=look.colour, linestyle=look.linestyle, linewidth=OWN_WIDTH, zorder=look.zorder)
        tops = [float(np.nanmax(bands[gap], initial=0.0))]
        tops += [float(np.nanmax(branch.force, initial=0.0)) for branch in file.at_gap(gap) if is_force]
        tops += [point.force + point.errors.get("force", 0.0) for point in shown.at_gap(gap) if point.force is not None]
        panel.set_ylim(*_limits(limits, 1.06 * max(tops) or 1.0, bands[gap]))
        sweep_panels.draw_measured(panel, shown, gap, "force")
    return list(panels.values())


def has_bands(file: SweepFile) -> bool:
    """Whether a sweep has quantiles of its drawn rigs."""
    return file.outcome_slots > 0 and bool(quantiles(file.data))


def has_force_bands(file: SweepFile) -> bool:
    """Whether these are of forces, not of impact speeds."""
    return has_bands(file) and quantiles(file.data)[QUANTILES[0]].startswith("force")


def inside_in_words(file: SweepFile, points: Iterable[Point]) -> str:
    """How many of the points with a force lie in the band of their gap, between the sweep's points by interpolation."""
    found = [_holds(file, file.at_gap(point.gap if point.gap is not None else file.gaps[0])[0], point)
             for point in points if point.force is not None and lies_between(file.values, point.frequency)]
    return (f"{sum(found)} of {len(found)} measured forces lie where nine of ten drawn rigs have theirs (5 to 95 %); "
            f"{_begin_in_words(file)}: where several motions exist, the rigs may be on others than those of this table")


def _begin_in_words(file: SweepFile) -> str:
    """Where drawn rigs begin, and where branches do."""
    own = "from a start of their own" if file.slots else "from [start]"
    apart = any(branch.direction != "independent" for branch in file.branches)
    return f"drawn rigs begin {own}" + ", branches with the motion at the point before" * apart


def _holds(file: SweepFile, branch: Branch, point: Point) -> bool:
    low, _, high = (np.interp(point.frequency, file.values, band) for band in file.force_quantiles(branch))
    return bool(low <= point.force <= high)


def _draw_band(panel: Axes, file: SweepFile, band: Reals) -> None:
    along, (low, median, high) = sweep_panels.line_through(file, band)
    panel.fill_between(along, low, high, zorder=1.2, **BAND)
    panel.plot(along, median, zorder=1.8, **MEDIAN)


def _handles(file: SweepFile, is_force: bool) -> list[Artist]:
    handles: list[Artist] = [Patch(label=f"{QUANTILES[0]} to {QUANTILES[-1]} % of the rigs", **BAND),
                             Line2D([], [], label="their median", **MEDIAN)]
    for name in sweep_panels.directions(file) if is_force else ():
        look = LOOKS[name]
        handles.append(Line2D([], [], color=look.colour, linestyle=look.linestyle, linewidth=OWN_WIDTH,
                              label=f"the job's own, {direction_words(file, name)}"))
    return handles


def _second_scale(file: SweepFile, largest: float) -> tuple[str, float] | None:
    if not file.newtons:
        return None
    factor, unit = units.with_prefix(largest * file.newtons, "N")
    return f"peak force ({unit})", file.newtons * factor


def _limits(limits: tuple[float, float] | None, top: float, band: Reals) -> tuple[float, float]:
    """(bottom, top) of a panel; `limits`: those requested."""
    if limits:
        return limits
    if not style.scale_option("log"):
        return 0.0, top
    return 0.9 * float(np.min(band[band > 0], initial=top / 10)), top
