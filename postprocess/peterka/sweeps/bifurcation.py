"""Bifurcation diagram of a sweep: hammer displacement against the excitation frequency, a panel for each gap (the paper's
Figs. 17 to 19), at forcing phase 0 or at first touch."""

from collections.abc import Sequence

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..plotting.picture import picture
from ..maps.curves_file import UnstableBranch
from ..measurements.points import NOTHING_MEASURED, Measurements
from . import every_attractor, sweep_panels
from .borders import NO_BORDERS, Border, at_gap, draw_borders
from .borders import handles as border_handles
from .sweep_file import LEAST_CHANGE, SweepFile
from .sweep_panels import LOOKS, direction_words
from .unstable import NO_UNSTABLE, draw_unstable
from .unstable import at_gap as unstable_at_gap
from .unstable import handles as unstable_handles

WHERE = {
    "stroboscopic_displacement": ("$x/A_0$ at phase 0", "x at phase 0 (mm)"),
    "impact_displacement": ("$x/A_0$ at first touch", "x at first touch (mm)"),
}
# The falling branch is drawn below in larger, paler dots: where both agree, a dark dot has a pale ring.
DOTS = {"up": (LOOKS["up"].colour, 0.9, 3), "down": (LOOKS["down"].colour, 2.6, 2),
        "independent": (LOOKS["independent"].colour, 0.9, 3)}


@picture(SweepFile)
def draw(file: SweepFile, ax: Axes | None = None, *, measured: Measurements = NOTHING_MEASURED,
         borders: Sequence[Border] = NO_BORDERS, unstable: Sequence[UnstableBranch] = NO_UNSTABLE,
         name: str = "stroboscopic_displacement") -> list[Axes] | None:
    """The diagram of one of WHERE as a list of Axes, one per gap; None if there are no samples."""
    samples = {branch.row: file.samples(name, branch) for branch in file.branches}
    if not any(len(points) for points, _ in samples.values()):
        return None
    label, second_label = WHERE[name]
    metres = file.positive("cart_amplitude_m")
    second = (second_label, 1000 * metres) if metres else None
    handles = [*_handles(file), *every_attractor.handles(file), *border_handles(borders), *unstable_handles(unstable),
               *sweep_panels.measured_handles(measured, "displacement")]
    panels = sweep_panels.panels(file, handles, label, second, ax)
    size = max(1.0, min(2.5, (500 / len(file.values)) ** 0.5))
    for gap, ax in panels.items():
        every_attractor.draw_samples(ax, file, gap, name, 0.8 * size)
        for branch in file.at_gap(gap):
            points, values = samples[branch.row]
            colour, width, zorder = DOTS[branch.direction]
            ax.plot(file.values[points], values, marker="o", markeredgewidth=0, linestyle="none", color=colour,
                    markersize=size * width, zorder=zorder, rasterized=len(points) > 5000)
        ax.margins(y=0.08)
        _keep_rounding_flat(ax)
        draw_borders(ax, at_gap(borders, gap))
        draw_unstable(ax, unstable_at_gap(unstable, gap), name)
        sweep_panels.draw_measured(ax, measured, gap, "displacement")
    return list(panels.values())


def _keep_rounding_flat(ax: Axes) -> None:
    """Widens the range of a constant to a tenth of its value on either side; autoscaling would magnify rounding."""
    low, high = ax.get_ylim()
    largest = max(abs(low), abs(high))
    if high - low < LEAST_CHANGE * largest:
        ax.set_ylim((low + high) / 2 - 0.1 * largest, (low + high) / 2 + 0.1 * largest)


def _handles(file: SweepFile) -> list[Artist]:
    return [
        Line2D([], [], label=direction_words(file, name), marker="o", markeredgewidth=0, linestyle="none",
               color=DOTS[name][0], markersize=2 * DOTS[name][1])
        for name in sweep_panels.directions(file)
    ]
