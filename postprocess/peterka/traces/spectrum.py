"""Amplitude spectra of force and hammer acceleration, and of the hardest impact alone: its force pulse, and the
acceleration in the flight that follows.

One mode is all the model has: lines of an orbit at multiples of its frequency, the pulse of the impact, and the
swing of the springs in flight. Resonances of the structure, as measurements show them, are not in it."""

import numpy as np

from ..look import axes, figures
from ..look.picture import picture
from . import trace_look
from .trace_file import TraceFile

WIDTH, HEIGHT = 5.2, 5.4  # in
LEAST = 1e-5  # of the largest value: what is smaller isn't shown
FEW_LINES = 400


@picture(TraceFile)
def draw(file, ax=None):
    """The spectra of a trace as a list of Axes."""
    rows = 2 if file.impact_spectrum is not None else 1
    figure, places = figures.divided(figures.width_of(WIDTH), HEIGHT * rows / 2, ax, rows, 2)
    grid = [[figures.panel(figure, places, row, column, ax) for column in range(2)] for row in range(rows)]
    spectrum, pulse = file.spectrum, file.impact_spectrum
    frequency = spectrum["frequency"]
    _draw(grid[0][0], frequency, spectrum["force_amplitude"], trace_look.FORCE, "force (N)", "whole motion")
    _draw(grid[0][1], frequency, spectrum["acceleration_amplitude"], trace_look.HAMMER,
          r"acceleration $\ddot{x}$ (m/s²)", "whole motion")
    if pulse is not None:
        _draw(grid[1][0], pulse["frequency"], pulse["force_spectrum"], trace_look.FORCE, "force (N s)",
              "hardest impact alone")
        _draw(grid[1][1], pulse["frequency"], pulse["flight_acceleration_amplitude"], trace_look.HAMMER,
              r"acceleration $\ddot{x}$ (m/s²)", "flight after it")
    for ax in grid[-1]:
        ax.set_xlabel("frequency (Hz)")
    trace_look.write_title(figure, file, f"lines {frequency[1] - frequency[0]:.3g} Hz apart"
                           if len(frequency) > 1 else "", grid[0][0])
    return [ax for row in grid for ax in row]


def _draw(ax, frequency, amplitude, colour, label, name):
    shown = (frequency > 0) & (amplitude > 0)
    if shown.any():
        x, y = frequency[shown], amplitude[shown]
        floor = max(LEAST * y.max(), y.min() / 2)
        ax.plot(x, np.maximum(y, floor), color=colour, linewidth=0.8,
                marker="." if len(x) < FEW_LINES else "", markersize=2.5)
        axes.log_scale(ax, "x", "y")
        ax.set_ylim(floor, 3 * y.max())
    ax.set_ylabel(label)
    ax.set_title(name, fontsize=8)
