"""Measured peak forces and the branches fitted to them, those of the start behind, and residuals below; a column for each gap."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..arrays import Mask, Reals
from ..plotting import axes, style, units
from .branches import Landscape
from .picture import plain
from .sweep_fit import SweepFit

WIDTH, HEIGHT = 7.0, 4.6  # in
MOST_GAPS = 3  # columns; more gaps are not drawn
LINES = {"up": {"color": "#003355", "linewidth": 1.5}, "down": {"color": "#0099AA", "linewidth": 1.1, "linestyle": (0, (3.5, 1.8))}}
BEGUN = {"color": "#A0A0A0", "linewidth": 0.9, "linestyle": (0, (1.2, 1.2))}
CHAOS = {"color": "#BBBBBB", "marker": ".", "markersize": 2, "linestyle": "none"}
USED = {"color": "#D55E00", "marker": "o", "markersize": 3.6, "markeredgewidth": 0.5, "markeredgecolor": "black", "linestyle": "none"}
UNUSED = {"color": "#D55E00", "marker": "x", "markersize": 4.5, "markeredgewidth": 1.1, "linestyle": "none"}
BESIDE, ABOVE = 0.06, 1.15  # of the measured frequencies and forces: what is shown beyond them


class _Titled:
    """The data from which the title is written."""

    def __init__(self, title: str) -> None:
        self.title = title


@style.using()
def draw(fit: SweepFit, start: Reals, title: str) -> Figure:
    """The picture of a SweepFit that began from parameters, as a Figure."""
    model, points = fit.model, fit.model.points
    gaps = points.gaps()[:MOST_GAPS] or [0.0]
    figure = axes.new_figure(WIDTH, HEIGHT)
    layout = figure.add_gridspec(3, len(gaps), height_ratios=[3, 1.1, 0.001])
    factor, unit = units.with_prefix(float(points.force.max()), "N")
    now, begun = model.landscapes(fit.x), model.landscapes(start)
    top = ABOVE * factor * float(points.force.max())
    first: list[Axes] = []
    for number in range(len(gaps)):
        upper = figure.add_subplot(layout[0, number], sharey=first[0] if first else None)
        lower = figure.add_subplot(layout[1, number], sharex=upper, sharey=first[1] if first else None)
        first = first or [upper, lower]
        own = model.which == number
        _draw_branches(upper, begun[number], now[number], factor)
        _draw_points(upper, fit, own, factor)
        _draw_left(lower, fit, own)
        span = np.ptp(points.hertz) or points.hertz[0]
        upper.set(xlim=(points.hertz.min() - BESIDE * span, points.hertz.max() + BESIDE * span), ylim=(0, top))
        upper.tick_params(labelbottom=False)
        lower.set_xlabel("frequency (Hz)")
        if points.gap is not None:
            upper.text(0.03, 0.96, f"gap {1e3 * gaps[number]:.4g} mm", transform=upper.transAxes, va="top", fontsize=8)
        for ax in (upper, lower):
            plain(ax)
            if number:
                ax.tick_params(labelleft=False)
    first[0].set_ylabel(f"peak force ({unit})")
    first[1].set_ylabel("residual (s.e.)" if points.has_errors else "residual (%)")
    figure.align_ylabels(first)
    _legend(figure.add_subplot(layout[2, :]), fit, now)
    axes.write_title(figure, _Titled(title))
    return figure


def _draw_branches(ax: Axes, begun: Landscape, now: Landscape, factor: float) -> None:
    for landscape, fixed in ((begun, True), (now, False)):
        for strand in landscape.strands:
            ax.plot(strand.hertz, factor * np.exp(strand.log_force), **(BEGUN if fixed else LINES[strand.direction]))
    for row in now.scattered:
        ax.plot(now.hertz, factor * row, zorder=1, **CHAOS)


def _draw_points(ax: Axes, fit: SweepFit, own: Mask, factor: float) -> None:
    points = fit.model.points
    for mask, look in ((own & fit.used, USED), (own & ~fit.used, UNUSED)):
        if not mask.any():  # matplotlib cannot lay out an empty line
            continue
        if points.has_errors:
            ax.errorbar(points.hertz[mask], factor * points.force[mask], yerr=factor * points.error[mask], fmt="none", ecolor="black",
                        elinewidth=0.7, zorder=4)
        ax.plot(points.hertz[mask], factor * points.force[mask], zorder=5, clip_on=False, **look)


def _draw_left(ax: Axes, fit: SweepFit, own: Mask) -> None:
    points, scale = fit.model.points, 1.0 if fit.model.points.has_errors else 100.0
    left = scale * fit.left
    most = 1.4 * float(np.max(np.abs(left[fit.used])))
    for mask, look in ((own & fit.used, USED), (own & ~fit.used & (np.abs(np.nan_to_num(left, nan=np.inf)) < most), UNUSED)):
        ax.plot(points.hertz[mask], left[mask], **look)
    ax.axhline(0, color="black", linewidth=0.6)
    ax.set_ylim(-most, most)


def _legend(below: Axes, fit: SweepFit, now: Sequence[Landscape]) -> None:
    handles = [Line2D([], [], label="measured", **USED)]
    if (~fit.used).any():
        handles.append(Line2D([], [], label="left out of the fit", **UNUSED))
    handles += [Line2D([], [], label="fitted, frequency rising", **LINES["up"]), Line2D([], [], label="falling", **LINES["down"]),
                Line2D([], [], label="start", **BEGUN)]
    if any(np.isfinite(one.scattered).any() for one in now):
        handles.append(Line2D([], [], label="no period", **CHAOS | {"markersize": 4}))
    below.axis("off")
    below.legend(handles=handles, ncol=3, loc="upper center", bbox_to_anchor=(0.5, 1), borderaxespad=0, frameon=False)
