"""The hammer's phase plane: absolute velocity over displacement, as measured by a transducer on the hammer.

Dots mark the beginning of each cycle (forcing phase 0), crosses the impacts."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Integers, Reals
from ..plotting import axes
from ..plotting.picture import picture
from . import trace_look
from .trace_file import TraceFile

WIDTH, HEIGHT = 3.7, 3.3  # in, without the legend
STROBE = {"marker": "o", "markersize": 4, "color": "black", "linestyle": "none"}
TOUCH = {"marker": "x", "markersize": 5, "color": trace_look.FORCE, "linestyle": "none"}


@picture(TraceFile)
def draw(file: TraceFile, ax: Axes | None = None) -> Axes:
    """The phase plane of a trace."""
    motion = file.motion
    handles = [Line2D([], [], label="hammer", **trace_look.HAMMER_LINE)]
    if file.excitation_hz:
        handles.append(Line2D([], [], label="each cycle's beginning", **STROBE))
    if file.impacts is not None:
        handles.append(Line2D([], [], label="first touch", **TOUCH))
    figure, (ax,) = axes.diagram(WIDTH, HEIGHT, handles, ax=ax)
    displacement, unit = trace_look.displacement(file, motion["hammer_displacement_ratio"])
    velocity = motion["hammer_velocity"]
    ax.plot(displacement, velocity, **trace_look.HAMMER_LINE)
    if file.excitation_hz:
        beginnings = np.flatnonzero(np.abs(motion["cycle"] - np.rint(motion["cycle"])) < 1e-6)
        ax.plot(displacement[beginnings], velocity[beginnings], **STROBE)
    if file.impacts is not None:
        touches = np.searchsorted(motion["time"], file.impacts["touch_time"])
        ax.plot(*_before(motion["time"], file.impacts["touch_time"], touches, displacement, velocity), **TOUCH)
    ax.set_xlabel(f"hammer displacement $x$ ({unit})")
    ax.set_ylabel(r"hammer velocity $\dot{x}$ (m/s)")
    trace_look.grid(ax)
    trace_look.write_title(figure, file, ax=ax)
    return ax


def _before(time: Reals, at: Reals, index: Integers, *columns: Reals) -> list[Reals]:
    """Columns extrapolated to these times from the two preceding samples, since the motion changes at a touch."""
    last = np.clip(index - 1, 1, len(time) - 1)
    share = (at - time[last - 1]) / (time[last] - time[last - 1])
    return [column[last - 1] + share * (column[last] - column[last - 1]) for column in columns]
