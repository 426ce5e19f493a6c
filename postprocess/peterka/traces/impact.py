"""Close-up of the hardest impact: the stop's force with its jump at first touch and its peak or, on a rigid stop, which has none, the
hammer's velocity in the cart; and the hammer's acceleration."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from ..arrays import Reals
from ..plotting import figures
from ..plotting.picture import picture
from . import trace_look
from .trace_file import TraceFile

WIDTH, HEIGHT = 3.7, 4.2  # in


@picture(TraceFile)
def draw(file: TraceFile, ax: Axes | None = None) -> list[Axes] | None:
    """The picture of the hardest impact as a list of Axes; None without impacts."""
    if file.impact is None:
        return None
    figure, grid = figures.divided(figures.width_of(WIDTH), HEIGHT, ax, 2)
    above, below = (figures.panel(figure, grid, row, ax=ax) for row in range(2))
    below.sharex(above)
    above.tick_params(labelbottom=False)
    impact, impacts = file.impact, file.impacts
    motion, number = impact.motion, impact.number
    assert impacts is not None
    milliseconds = 1000 * motion["time_from_touch"]
    if trace_look.strikes_rigid_stop(file):
        above.plot(milliseconds, motion["relative_velocity"], **trace_look.FORCE_LINE)
        above.set_ylabel(r"$\dot{x} - \dot{y}$ (m/s)")
    else:
        force, unit = trace_look.force(file, motion["force_ratio"])
        above.plot(milliseconds, force, **trace_look.FORCE_LINE)
        if impact.peak_time is not None and impact.peak_force_ratio is not None:
            _label_peak(above, file, impact.peak_time - impacts["touch_time"][number], impact.peak_force_ratio)
            _label_jump(above, file, impacts["touch_force_ratio"][number])
            above.set_ylim(top=1.28 * np.max(force))
        above.set_ylabel(f"force ({unit})")
        trace_look.second_force_scale(above, file)
    below.plot(milliseconds, motion["hammer_acceleration"], **trace_look.ACCELERATION_LINE)
    below.set_ylabel(r"$\ddot{x}$ (m/s²)")
    below.set_xlabel("time since first touch (ms)")
    for ax in (above, below):
        trace_look.grid(ax)
    above.set_xlim(milliseconds[0], milliseconds[-1])
    figure.align_ylabels([above, below])
    trace_look.write_title(figure, file, "\n".join(filter(None, [_facts(impacts, number), trace_look.peaks(file)])), above)
    return [above, below]


def _label_peak(ax: Axes, file: TraceFile, since_touch: float, ratio: float) -> None:
    peak, unit = trace_look.force(file, ratio)
    at = 1000 * since_touch
    ax.plot([at], [peak], marker="o", markersize=3.5, color="black", zorder=5)
    ax.annotate(f"peak {peak:.4g} {unit}\nafter {at:.3g} ms", (at, peak), xytext=(8, 3), textcoords="offset points",
                fontsize=8, va="bottom")


def _label_jump(ax: Axes, file: TraceFile, ratio: float) -> None:
    jump, unit = trace_look.force(file, ratio)
    if jump <= 0:
        return
    ax.annotate(f"jump to\n{jump:.4g} {unit}", (0, jump), xytext=(-6, 0), textcoords="offset points", fontsize=8,
                ha="right", va="center")


def _facts(impacts: Mapping[str, Reals], number: int) -> str:
    facts = [f"at {impacts['touch_time'][number]:.4g} s with {impacts['impact_speed'][number]:.3g} m/s"]
    if impacts["contact_time"][number] > 0:
        facts.append(f"pressed for {1000 * impacts['contact_time'][number]:.3g} ms")
    return ", ".join(facts)
