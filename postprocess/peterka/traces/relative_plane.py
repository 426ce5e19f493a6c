"""The hammer relative to the cart: relative velocity over x - y, with the stop as a line, and its stroboscopic points.

Dots are the points at forcing phase 0 (stroboscopic Poincaré map): q of them for an orbit of q cycles, a strange set in
chaos, which takes hundreds of cycles to appear ([trace] cycles)."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..arrays import Integers, Reals
from ..files.regimes import CHAOTIC
from ..plotting import axes
from ..plotting.picture import picture
from . import trace_look
from .trace_file import TraceFile

WIDTH, HEIGHT = 3.7, 3.3  # in, without the legend
MANY = 40  # distinct points from which they are drawn smaller
ENOUGH = 200  # points needed to resolve a chaotic set
LEAST_SPAN = 0.05  # of the motion, along each axis: the points of an orbit differ by rounding alone
STROBE = {"marker": "o", "color": "black", "linestyle": "none", "markeredgewidth": 0}


@picture(TraceFile)
def draw_motion(file: TraceFile, ax: Axes | None = None) -> Axes:
    """The phase plane of x - y, from the trace's samples, as Axes."""
    points = strobe(file)
    handles = [Line2D([], [], label="hammer", **trace_look.HAMMER_LINE), _handle(points, 4), *_stop_handle(file)]
    figure, (ax,) = axes.diagram(WIDTH, HEIGHT, [one for one in handles if one], ax=ax)
    displacement, _ = trace_look.displacement(file, file.motion["relative_displacement_ratio"])
    ax.plot(displacement, file.motion["relative_velocity"], **trace_look.HAMMER_LINE)
    if len(points):
        ax.plot(displacement[points], file.motion["relative_velocity"][points], markersize=4, **STROBE)
    return _finished(figure, ax, file)


@picture(TraceFile)
def draw_points(file: TraceFile, ax: Axes | None = None) -> Axes | None:
    """The stroboscopic points alone, as Axes; None for a cart at rest, which has no phase."""
    points = strobe(file)
    if not len(points):
        return None
    places = np.column_stack([file.motion[name][points] for name in ("relative_displacement_ratio", "relative_velocity")])
    size = 4 if len(np.unique(places.round(6), axis=0)) <= MANY else 1.8
    figure, (ax,) = axes.diagram(WIDTH, HEIGHT, [_handle(points, size), *_stop_handle(file)], columns=1, ax=ax)
    way = np.column_stack([trace_look.displacement(file, file.motion["relative_displacement_ratio"])[0], file.motion["relative_velocity"]])
    ax.plot(*way[points].T, markersize=size, **STROBE)
    ax.margins(0.1)
    ax.update_datalim(_least_span(way, points))
    few = file.cell and file.cell["regime"] == CHAOTIC and len(points) < ENOUGH
    return _finished(figure, ax, file, f"{len(points)} points: [trace] cycles = 500 shows what they lie on" if few else "")


def strobe(file: TraceFile) -> Integers:
    """Indices of the samples at forcing phase 0, (n,)."""
    if not file.excitation_hz:
        return np.array([], dtype=int)
    cycle = file.motion["cycle"]
    return np.flatnonzero(np.abs(cycle - np.rint(cycle)) < 1e-6)


def _least_span(way: Reals, points: Integers) -> tuple[Reals, Reals]:
    """Two corners about the middle of these points, at which the axes end at the nearest."""
    middle, half = (way[points].min(axis=0) + way[points].max(axis=0)) / 2, LEAST_SPAN / 2 * np.ptp(way, axis=0)
    return middle - half, middle + half


def _finished(figure: Figure, ax: Axes, file: TraceFile, extra: str = "") -> Axes:
    gap = file.number("gap_ratio")
    unit = trace_look.displacement(file, 0.0)[1]
    if _shows_stop(file):
        ax.axvline(trace_look.displacement(file, gap)[0], **trace_look.STOP_LINE | {"linewidth": 1.2, "zorder": 1})
    ax.set_xlabel(f"$u = x - y$ ({unit})")
    ax.set_ylabel(r"$\dot{u}$ (m/s)")
    trace_look.grid(ax)
    trace_look.write_title(figure, file, extra, ax)
    return ax


def _handle(points: Integers, size: float) -> Line2D | None:
    return Line2D([], [], label="forcing phase 0", markersize=size, **STROBE) if len(points) else None


def _shows_stop(file: TraceFile) -> bool:
    """Draws the stop if close enough not to compress the motion."""
    gap, moved = file.number("gap_ratio"), file.motion["relative_displacement_ratio"]
    return gap is not None and bool(gap <= moved.max() + max(float(np.ptp(moved)), 0.1))


def _stop_handle(file: TraceFile) -> list[Line2D]:
    return [Line2D([], [], label="stop, $u$ = gap", **trace_look.STOP_LINE)] if _shows_stop(file) else []
