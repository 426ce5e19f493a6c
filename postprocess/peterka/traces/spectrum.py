"""Amplitude spectra of force and hammer acceleration, and of the hardest
impact alone: its force pulse, and the acceleration in the subsequent flight.

The model has a single mode: the spectra show lines of an orbit at multiples of its frequency, the impact pulse, and the
springs' oscillation in flight. It does not contain structural resonances seen in measurements."""

import numpy as np
from matplotlib.axes import Axes

from ..arrays import Reals
from ..plotting import axes, figures
from ..plotting.picture import picture
from . import trace_look
from .trace_file import TraceFile

WIDTH, HEIGHT = 5.2, 5.4  # in
NARROW, FLAT = 4.5, 0.75  # in: width from which on two panels stand side by side; height of one in a column, over theirs
LEAST = 1e-5  # of the largest value: smaller values are not shown
FEW_LINES = 400
ACCELERATION = r"acceleration $\ddot{x}$ (m/s²)"


@picture(TraceFile)
def draw(file: TraceFile, ax: Axes | None = None) -> list[Axes] | None:
    """The spectra of a trace as a list of Axes."""
    frequency, pulse = file.spectrum["frequency"], file.impact_spectrum
    panels = [(frequency, file.spectrum["force_amplitude"], trace_look.FORCE, "force (N)", "whole motion"),
              (frequency, file.spectrum["acceleration_amplitude"], trace_look.HAMMER, ACCELERATION, "whole motion")]
    if pulse is not None:
        panels += [(pulse["frequency"], pulse["force_spectrum"], trace_look.FORCE, "force (N s)", "hardest impact alone"),
                   (pulse["frequency"], pulse["flight_acceleration_amplitude"], trace_look.HAMMER, ACCELERATION,
                    "flight after it")]
    panels = [panel for panel in panels if np.any((panel[0] > 0) & (panel[1] > 0))]  # omits empty ones
    if not panels:
        return None
    width = figures.width_of(WIDTH)
    columns = min(len(panels), 2 if width >= NARROW else 1)  # side by side, narrow panels have room for two ticks alone
    rows = -(-len(panels) // columns)
    figure, places = figures.divided(width, HEIGHT * rows / 2 * (1 if columns > 1 else FLAT), ax, rows, columns)
    grid = [figures.panel(figure, places, *divmod(number, columns), ax) for number in range(len(panels))]
    for number, (one, panel) in enumerate(zip(grid, panels)):
        _draw(one, *panel)
        if number + columns >= len(panels):
            one.set_xlabel("frequency (Hz)")
    trace_look.write_title(figure, file, f"lines {frequency[1] - frequency[0]:.3g} Hz apart"
                           if len(frequency) > 1 else "", grid[0])
    return grid


def _draw(ax: Axes, frequency: Reals, amplitude: Reals, colour: str, label: str, name: str) -> None:
    shown = (frequency > 0) & (amplitude > 0)
    x, y = frequency[shown], amplitude[shown]
    floor = max(LEAST * y.max(), y.min() / 2)
    ax.plot(x, y, color=colour, linewidth=0.8, marker="." if len(x) < FEW_LINES else "", markersize=2.5)
    axes.log_scale(ax, "x", "y")
    ax.set_ylim(floor, 3 * y.max())
    ax.set_ylabel(label)
    ax.set_title(name, fontsize=8)
