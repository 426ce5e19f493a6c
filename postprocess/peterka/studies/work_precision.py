"""Work and precision: error in peak force against computing time per forcing cycle, one line per method.

A point is the median over the cells for one setting, a band spans the smallest to the largest error of a cell. A point is
hollow if the method failed in some cells: it represents only the others.
"""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Reals
from ..plotting import axes
from ..plotting.picture import picture
from .methods import draw_points, look, marker_look, methods_in_order
from .study_file import StudyFile, WorkPrecision

WIDTH, HEIGHT = 3.7, 3.1  # in, without the legend
SMALLEST_ERROR = 1e-17  # an error of 0 is drawn here: below the unit roundoff of a double


@dataclass(frozen=True)
class Point:
    """A method at one setting; relative errors of the cells that it completed."""

    setting: float
    seconds: float
    error: float
    smallest: float
    largest: float
    done: int
    cells: int


def points_of(table: WorkPrecision, method: str) -> list[Point]:
    """The Points of a method, the coarsest setting first; settings without any completed cell are omitted."""
    points = []
    for run in np.flatnonzero(table.method == method):
        errors, seconds = table.error_peak_force[run], table.seconds_per_cycle[run]
        done = (table.outcome[run] == "done") & np.isfinite(errors) & (seconds > 0) & np.isfinite(seconds)
        if done.any():
            error = np.abs(errors[done])
            points.append(Point(float(table.setting[run]), float(np.median(seconds[done])), float(np.median(error)),
                                float(error.min()), float(error.max()), int(done.sum()), len(done)))
    return sorted(points, key=lambda point: care(point.setting))


def care(setting: float) -> float:
    """A number that increases with the accuracy of a setting: steps per cycle, or the inverse of a tolerance."""
    return 1 / setting if 0 < setting < 1 else setting


@picture(StudyFile)
def draw(file: StudyFile, ax: Axes | None = None) -> Axes | None:
    """The diagram of a study of work and precision; None if no run completed."""
    lines = {method: points_of(file.table, method) for method in methods_in_order(file.table.method)}
    lines = {method: points for method, points in lines.items() if points}
    if not lines:
        return None
    partly = any(point.done < point.cells for points in lines.values() for point in points)
    handles = [_handle(method) for method in lines]
    if partly:
        handles.append(Line2D([], [], label="hollow: not all cells", **marker_look("cvode_adams", True)))
    figure, (ax,) = axes.diagram(WIDTH, HEIGHT, handles, ax=ax)
    for method, points in lines.items():
        seconds, error, low, high = (
            np.array([getattr(point, name) for point in points]) for name in ("seconds", "error", "smallest", "largest")
        )
        draw_points(ax, 1e6 * seconds, _drawn(error), method, _drawn(low), _drawn(high),
                    [point.done < point.cells for point in points])
    axes.log_scale(ax, "x", "y")
    ax.margins(0.06)
    ax.set_xlabel("computing time (µs per forcing cycle)")
    ax.set_ylabel("error in peak force (relative)")
    axes.write_title(figure, file, axes.so_far(file) + f"median and range of {file.table.outcome.shape[1]} cells", ax)
    return ax


def _drawn(error: Reals) -> Reals:
    return np.maximum(error, SMALLEST_ERROR)


def _handle(method: str) -> Line2D:
    return Line2D([], [], label=look(method).name, **marker_look(method) | {
        "linestyle": "-", "color": look(method).colour, "linewidth": 1.1})
