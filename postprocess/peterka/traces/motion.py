"""A trace over time: displacements of hammer and cart, acceleration of the hammer, force of the stop.

The dotted line is the stop: the hammer touches it where the lines meet. At gap 0 it coincides with the cart's line. The
exact peak of each impact lies on the force line, which is sampled elsewhere."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Reals
from ..plotting import axes
from ..plotting.picture import picture
from . import trace_look
from .trace_file import TraceFile

WIDTH, HEIGHT = 5.2, 5.0  # in, without the legend
PEAK = {"marker": "o", "markersize": 3, "color": "black", "linestyle": "none"}


@picture(TraceFile)
def draw(file: TraceFile, ax: Axes | None = None) -> list[Axes]:
    """The picture of a trace as a list of Axes."""
    motion = file.motion
    at_cart = ", stop" if file.number("gap_ratio") == 0 else ""
    handles = [Line2D([], [], label="hammer $x$", **trace_look.HAMMER_LINE),
               Line2D([], [], label=f"cart $y${at_cart}", **trace_look.CART_LINE),
               Line2D([], [], label="stop, $y + \\mathrm{gap}$", **trace_look.STOP_LINE)]
    of = "speed" if trace_look.strikes_rigid_stop(file) else "peak"
    peaks = [] if not trace_look.strikes_rigid_stop(file) and not _shown_peaks(file)[0].size else [Line2D([], [], label=f"{of} of an impact", **PEAK)]
    shows_stop = _near_the_hammer(file)
    figure, panels = axes.diagram(WIDTH, HEIGHT, handles[: 3 if shows_stop else 2] + peaks, panels=2 if file.impacts is None else 3, columns=4,
                                  ax=ax)
    time = motion["time"]
    _draw_displacements(panels[0], file, time, shows_stop)
    panels[1].plot(time, motion["hammer_acceleration"], **trace_look.ACCELERATION_LINE)
    panels[1].set_ylabel(r"$\ddot{x}$ (m/s²)")
    if file.impacts is not None:
        (_draw_speeds if trace_look.strikes_rigid_stop(file) else _draw_force)(panels[2], file)
    panels[-1].set_xlabel("time (s)")
    for ax in panels:
        trace_look.grid(ax)
        ax.set_xlim(time[0], time[-1])
    for ax in panels[:-1]:
        ax.tick_params(labelbottom=False)
    _cycles_on_top(panels[0], motion, file)
    figure.align_ylabels(panels)
    trace_look.write_title(figure, file, trace_look.peaks(file), panels[0])
    return panels


def _draw_speeds(ax: Axes, file: TraceFile) -> None:
    """On a rigid stop, whose forces have no bound: how fast the hammer strikes it."""
    assert file.impacts is not None
    touches, speeds = file.impacts["touch_time"], file.impacts["impact_speed"]
    ax.vlines(touches, 0, speeds, **trace_look.STEM)
    ax.plot(touches, speeds, **PEAK)
    ax.set_ylim(bottom=0)
    ax.set_ylabel("impact speed (m/s)")


def _draw_force(ax: Axes, file: TraceFile) -> None:
    time = file.motion["time"]
    force, unit = trace_look.force(file, file.motion["force_ratio"])
    assert file.impacts is not None
    touches, jumps = file.impacts["touch_time"], trace_look.force(file, file.impacts["touch_force_ratio"])[0]
    peak_times, peaks = _shown_peaks(file)
    # at each touch the force jumps from 0; the peak, which is sampled only nearby, lies on the line, too
    times = np.concatenate([touches, touches, time, peak_times])
    forces = np.concatenate([np.zeros(touches.size), jumps, force, peaks])
    order = np.argsort(times, kind="stable")
    ax.plot(times[order], forces[order], **trace_look.FORCE_LINE)
    ax.plot(peak_times, peaks, **PEAK)
    ax.set_ylabel(f"force ({unit})")
    trace_look.second_force_scale(ax, file)


def _shown_peaks(file: TraceFile) -> tuple[Reals, Reals]:
    """(times [s] to within a sample, forces) of the impacts' peaks in the time shown: at the touch where no sample is in contact, none where the
    trace ends before."""
    if file.impacts is None:
        return np.array([]), np.array([])
    time, touches, jumps, maxima = file.motion["time"], *(file.impacts[name] for name in ("touch_time", "touch_force_ratio", "peak_force_ratio"))
    times = touches.copy()
    for number, end in enumerate([*touches[1:], np.inf]):
        until_next = np.flatnonzero((time > touches[number]) & (time < end))
        forces = file.motion["force_ratio"][until_next]
        if jumps[number] < maxima[number] and np.any(forces > 0):
            at = until_next[np.argmax(forces)]
            times[number] = time[at] if at < time.size - 1 else np.nan
    shown = np.isfinite(times) & np.isfinite(maxima)
    return times[shown], trace_look.force(file, maxima)[0][shown]


def _near_the_hammer(file: TraceFile) -> bool:
    """Whether the stop has its own line, close enough not to compress the motion. At gap 0 it coincides with the cart's."""
    gap, reach = file.number("gap_ratio"), float(np.max(file.motion["relative_displacement_ratio"]))
    return gap is not None and gap != 0 and gap < 2 * max(reach, 1)


def _draw_displacements(ax: Axes, file: TraceFile, time: Reals, shows_stop: bool) -> None:
    motion = file.motion
    for name, line in (("hammer", trace_look.HAMMER_LINE), ("cart", trace_look.CART_LINE)):
        values, unit = trace_look.displacement(file, motion[f"{name}_displacement_ratio"])
        ax.plot(time, values, **line)
    gap = file.number("gap_ratio")
    if shows_stop and gap is not None:
        stop, unit = trace_look.displacement(file, motion["cart_displacement_ratio"] + gap)
        ax.plot(time, stop, **trace_look.STOP_LINE)
    ax.set_ylabel(f"displacement ({unit})")


def _cycles_on_top(ax: Axes, motion: Mapping[str, Reals], file: TraceFile) -> None:
    per_second = (motion["cycle"][-1] - motion["cycle"][0]) / (motion["time"][-1] - motion["time"][0])
    top = ax.secondary_xaxis("top", functions=(lambda t: t * per_second, lambda n: n / per_second))
    top.set_xlabel("forcing cycles" if file.excitation_hz else "natural periods", fontsize=8)
