"""Frequency response of uncertain rigs: per gap, the band that holds the peak forces of all but the lowest and the highest 5 % of the
drawn rigs, their median, and the job's own rig, with measured points over them.

A rig that doesn't impact counts with force 0. Without forces, as on a rigid stop, the band is that of impact speeds.
"""

from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..maps.outcomes import QUANTILES, draws_of, quantiles
from ..measurements.points import NOTHING_MEASURED, Measurements, Point, lies_between
from ..plotting import style, units
from ..plotting.picture import picture
from . import sweep_panels
from .sweep_file import SweepFile
from .sweep_panels import LOOKS, direction_words

PALE = 0.22  # opacity of a band
OWN = {"color": "#555555", "linewidth": 0.6, "linestyle": (0, (1, 1))}


@picture(SweepFile)
def draw(file: SweepFile, ax: Axes | None = None, *, measured: Measurements = NOTHING_MEASURED) -> list[Axes] | None:
    """The bands as a list of Axes, one per gap; None if no drawn rig impacts."""
    bands = {branch.row: file.force_quantiles(branch) for branch in file.branches}
    largest = max(float(np.nanmax(band, initial=0.0)) for band in bands.values())
    if not largest > 0:
        return None
    draws, is_force = draws_of(file), has_force_bands(file)
    shown = measured if is_force else NOTHING_MEASURED
    handles = [*_handles(file, is_force), *sweep_panels.measured_handles(shown, "force")]
    second = _second_scale(file, largest) if is_force else None
    label = r"peak force $F/(m\,g)$" if is_force else "impact speed (m/s)"
    panels = sweep_panels.panels(file, handles, label, second, ax, log=style.current().log, told=draws.in_words)
    for gap, panel in panels.items():
        for branch in file.at_gap(gap):
            _draw_band(panel, file, branch, bands[branch.row], is_force)
        tops = [float(np.nanmax(bands[branch.row], initial=0.0)) for branch in file.at_gap(gap)]
        tops += [point.force + point.errors.get("force", 0.0) for point in shown.at_gap(gap) if point.force is not None]
        panel.set_ylim(*_limits(file, second, 1.06 * max(tops) or 1.0, [bands[branch.row] for branch in file.at_gap(gap)]))
        sweep_panels.draw_measured(panel, shown, gap, "force")
    return list(panels.values())


def has_bands(file: SweepFile) -> bool:
    """Whether a sweep has quantiles of its drawn rigs."""
    return file.outcome_slots > 0 and bool(quantiles(file.data))


def has_force_bands(file: SweepFile) -> bool:
    """Whether these are of forces, not of impact speeds."""
    return has_bands(file) and quantiles(file.data)[QUANTILES[0]].startswith("force")


def inside_in_words(file: SweepFile, points: Iterable[Point]) -> str:
    """How many of the points with a force lie in a band of their gap, between the sweep's points by interpolation."""
    found = [any(_holds(file, branch, point) for branch in file.at_gap(point.gap if point.gap is not None else file.gaps[0]))
             for point in points if point.force is not None and lies_between(file.values, point.frequency)]
    return f"{sum(found)} of {len(found)} measured forces lie where nine of ten drawn rigs have theirs (5 to 95 %)"


def _holds(file, branch, point):
    low, _, high = (np.interp(point.frequency, file.values, band) for band in file.force_quantiles(branch))
    return bool(low <= point.force <= high)


def _draw_band(panel, file, branch, band, is_force):
    look, x = LOOKS[branch.direction], file.values
    low, median, high = band
    panel.fill_between(x, low, high, facecolor=look.colour, alpha=PALE, linewidth=0, zorder=look.zorder - 0.6)
    for edge in (low, high):
        panel.plot(x, edge, color=look.colour, linestyle=look.linestyle, linewidth=0.4, zorder=look.zorder - 0.5)
    panel.plot(x, median, color=look.colour, linestyle=look.linestyle, linewidth=look.linewidth, zorder=look.zorder)
    if is_force:
        panel.plot(x, branch.force, zorder=look.zorder + 0.5, **OWN)


def _handles(file, is_force):
    handles: list = []
    for name in sweep_panels.directions(file):
        look = LOOKS[name]
        words = direction_words(file, name)
        handles.append(Patch(facecolor=look.colour, alpha=PALE, linewidth=0, label=f"{QUANTILES[0]} to {QUANTILES[-1]} %, {words}"))
        handles.append(Line2D([], [], color=look.colour, linestyle=look.linestyle, linewidth=look.linewidth, label=f"median, {words}"))
    return [*handles, Line2D([], [], label="the job's own rig", **OWN)] if is_force else handles


def _second_scale(file, largest):
    if not file.newtons:
        return None
    factor, unit = units.with_prefix(largest * file.newtons, "N")
    return f"peak force ({unit})", file.newtons * factor


def _limits(file, second, top, bands):
    """(bottom, top) of a panel. Requested limits are in the numbers of the scale."""
    if style.current().limits:
        factor = second[1] if second and style.current().units == "si" else 1.0
        return tuple(limit / factor for limit in style.current().limits)
    if not style.current().log:
        return 0.0, top
    return 0.9 * min(float(np.min(band[band > 0], initial=top / 10)) for band in bands), top
