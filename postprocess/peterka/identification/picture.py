"""A recording and its fitted motion: the whole recording, a close-up of the hardest impact, and the residual of each signal."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..arrays import Mask, Reals
from ..plotting import axes, style, units
from ..plotting.linear_ticks import LinearNumbers, LinearTicks
from .fit import Fit

WIDTH, ROW, HEAD = 7.0, 2.35, 0.75  # in: two journal columns, the height of a signal, and the space above and below
RECORDED = {"color": "#8C8C8C", "marker": "o", "markersize": 1.8, "markeredgewidth": 0, "linestyle": "none"}
FITTED = {"color": "#D55E00", "linewidth": 1.1}
LEFT = {"color": "#003355", "marker": "o", "markersize": 1.4, "markeredgewidth": 0, "linestyle": "none"}
NAMES = {"force": ("force", "N"), "acceleration": ("acceleration", "m/s²"), "displacement": ("displacement", "m")}
MOST_SHOWN = 20_000  # samples
AROUND = 0.8  # of the contact time, shown before and after it


class _Titled:
    """The data from which the title is written."""

    def __init__(self, title: str) -> None:
        self.title = title


@style.using()
def draw(fit: Fit, title: str) -> Figure:
    """The picture of a Fit as a Figure."""
    recording = _Shown(fit)
    names = [name for name in NAMES if name in fit.solved.problem.names]
    figure = axes.new_figure(WIDTH, HEAD + ROW * len(names))
    layout = figure.add_gridspec(2 * len(names) + 1, 2, height_ratios=[3, 1.2] * len(names) + [0.001])
    grid = np.empty((2 * len(names), 2), dtype=object)
    for row, column in np.ndindex(grid.shape):
        grid[row, column] = figure.add_subplot(layout[row, column], sharex=grid[0, column])
        grid[row, column].tick_params(labelbottom=row == len(grid) - 1)
    zoom = _window(fit)
    for row, name in enumerate(names):
        factor, unit = units.with_prefix(float(np.nanmax(np.abs(recording.signals[name]))), NAMES[name][1])
        for column, inside in enumerate((None, zoom)):
            upper, lower = grid[2 * row:2 * row + 2, column]
            _draw_signal(upper, recording, name, factor, inside, (1, 1e3)[column])
            _draw_left(lower, recording, name, factor, inside, (1, 1e3)[column])
            for ax in (upper, lower):
                plain(ax)
            if column == 0:
                upper.set_ylabel(f"{NAMES[name][0]} ({unit})")
                lower.set_ylabel(f"residual ({unit})")
    grid[-1, 0].set_xlabel("time (s)")
    grid[-1, 1].set_xlabel(f"time from {zoom[0]:.6g} s (ms)")
    figure.align_ylabels(grid[:, 0])
    handles = [Line2D([], [], label="recorded", **RECORDED | {"markersize": 3}), Line2D([], [], label="fitted", **FITTED),
               Line2D([], [], label="residual (recorded less fitted)", **LEFT | {"markersize": 3})]
    below = figure.add_subplot(layout[-1, :])
    below.axis("off")
    below.legend(handles=handles, ncol=3, loc="upper center", bbox_to_anchor=(0.5, 1), borderaxespad=0, frameon=False)
    axes.write_title(figure, _Titled(title))
    return figure


class _Shown:
    """Samples and the motion fitted to them: as many as a picture shows, and all of those near the hardest impact."""

    def __init__(self, fit: Fit) -> None:
        self.fit, recording = fit, fit.recording
        begin, end = _window(fit)
        single = np.arange(max(0, int((begin - recording.begin) / recording.step)),
                           min(recording.count, int((end - recording.begin) / recording.step) + 1))
        every = np.unique(np.concatenate([np.arange(0, recording.count, max(1, recording.count // MOST_SHOWN)), single]))
        self.time = recording.begin + recording.step * every
        self.signals = {name: np.asarray(signal[every], dtype=float) for name, signal in recording.signals.items()}
        self.fitted = fit.model(recording.step * every)


def _window(fit: Fit) -> tuple[float, float]:
    """(begin, end) [s] of a window around the hardest impact."""
    first = fit.guess.pulses[fit.guess.hardest].top * fit.recording.step
    begin, end = min(fit.contacts(), key=lambda pair: abs(sum(pair) / 2 - first))
    around = AROUND * (end - begin)
    return fit.recording.begin + begin - around, fit.recording.begin + end + around


def _draw_signal(ax: Axes, shown: _Shown, name: str, factor: float, inside: tuple[float, float] | None, per_second: float) -> None:
    begin, keep = inside[0] if inside else 0.0, _inside(shown.time, inside)
    ax.plot(per_second * (shown.time[keep] - begin), factor * shown.signals[name][keep],
            rasterized=bool(keep.sum() > 5000), **RECORDED | ({"markersize": 3} if inside else {}))
    time, values = shown.time, shown.fitted[name]
    if inside:  # also between the samples
        time = np.linspace(*inside, 2000)
        values = shown.fit.model(time - shown.fit.recording.begin)[name]
    ax.plot(per_second * (time - begin), factor * values, rasterized=len(time) > 5000, **FITTED)


def _draw_left(ax: Axes, shown: _Shown, name: str, factor: float, inside: tuple[float, float] | None, per_second: float) -> None:
    keep = _inside(shown.time, inside)
    begin, left = inside[0] if inside else 0.0, shown.signals[name] - shown.fitted[name]
    ax.plot(per_second * (shown.time[keep] - begin), factor * left[keep], rasterized=bool(keep.sum() > 5000),
            **LEFT | ({"markersize": 3} if inside else {}))
    ax.axhline(0, color="black", linewidth=0.5)
    largest = np.nanquantile(np.abs(left[keep]), 0.999)
    ax.set_ylim(-1.3 * factor * largest, 1.3 * factor * largest)


def _inside(time: Reals, inside: tuple[float, float] | None) -> Mask:
    return np.ones(len(time), dtype=bool) if inside is None else (time >= inside[0]) & (time <= inside[1])


def plain(ax: Axes) -> None:
    """Grid and plain numbers, for axes in units that are told beside them."""
    ax.grid(color="#DDDDDD", linewidth=0.5)
    ax.set_axisbelow(True)
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(LinearTicks())
        axis.set_major_formatter(LinearNumbers())
