"""Labels of a small map by each method and tolerance: shares of cells
with a different label and of unverified cells, against computing time.

A label differs if its regime, p or q differs from that of the most accurate run. Shares of 0 are drawn at the foot of the
scale, which is linear below one cell.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, NullLocator

from ..plotting import axes
from ..plotting.picture import picture
from .methods import draw_points, look, marker_look, methods_in_order
from .study_file import StudyFile
from .work_precision import care

WIDTH, HEIGHT = 3.7, 4.3  # in, without the legend


@picture(StudyFile)
def draw(file: StudyFile, ax: Axes | None = None) -> list[Axes] | None:
    """The two diagrams of a study of labels as a list of Axes; None without a finished run."""
    table = file.table
    usable = np.isfinite(table.changed_share) & (table.seconds_per_cell > 0) & np.isfinite(table.seconds_per_cell)
    methods = methods_in_order(table.method[usable])
    if not methods:
        return None
    handles = [
        Line2D([], [], label=look(method).name, linewidth=1.1, **marker_look(method) | {
            "linestyle": "-", "color": look(method).colour})
        for method in methods
    ]
    figure, panels = axes.diagram(WIDTH, HEIGHT, handles, panels=2, ax=ax)
    names = ("cells with another\nlabel (%)", "unverified\ncells (%)")
    for ax, shares, name in zip(panels, (table.changed_share, table.unproved_share), names):
        for method in methods:
            runs = np.flatnonzero(usable & (table.method == method) & np.isfinite(shares))
            runs = runs[np.argsort([care(table.setting[run]) for run in runs])]
            draw_points(ax, 1e3 * table.seconds_per_cell[runs], 100 * shares[runs], method)
        _share_scale(ax, table.cells)
        ax.set_ylabel(name)
    panels[0].tick_params(labelbottom=False)
    panels[1].set_xlabel("computing time (ms per cell)")
    axes.write_title(figure, file, axes.so_far(file) + f"map of {table.cells} cells", panels[0])
    return panels


def _share_scale(ax: Axes, cells: int) -> None:
    """The scale from 0 to one cell, then logarithmic up to 100 %."""
    one_cell = 100 / max(cells, 1)
    axes.log_scale(ax, "x")
    ax.margins(x=0.06)
    ax.set_yscale("symlog", linthresh=one_cell, linscale=0.4)
    largest = max(np.max(line.get_ydata(), initial=0) for line in ax.lines)
    top = max(4 * one_cell, 1.6 * largest)
    ax.set_ylim(-0.35 * one_cell, top)
    decades = 10.0 ** np.arange(np.floor(np.log10(one_cell)), 3)
    for factors in ((1,), (1, 2, 5)):
        ticks = np.ravel(np.outer(decades, factors))
        ticks = ticks[(ticks >= one_cell * (1 - 1e-9)) & (ticks <= min(top, 100))]
        if len(ticks) > 1:
            break
    ax.set_yticks([0, *ticks])
    ax.yaxis.set_major_formatter(FuncFormatter(lambda share, _: f"{share:g}"))
    ax.yaxis.set_minor_locator(NullLocator())
