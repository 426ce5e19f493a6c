"""Result of an audit: cells solved again by an independent engine, where labels differ, and by how much forces differ.

Top: the map's plane in pale colours of its classes, with a dot at each audited cell and a ring where regime, p or q differ.
Bottom: the share of the compared cells whose peak forces differ by at most a given error.
"""

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Integers, Reals
from ..plotting import axes
from ..plotting.classes import CLASSES, INDEX
from ..plotting.fills import paler
from ..plotting.picture import picture
from .map_file import PeterkaFile
from .reduce import orbit_picture

WIDTH, ERROR_HEIGHT = 3.7, 1.9  # in
PALE = 0.65  # share of white in the colours of the classes
AGREES = {"marker": ".", "markersize": 2.5, "color": "black", "linestyle": "none", "markeredgewidth": 0}
DIFFERS = {"marker": "o", "markersize": 7, "markerfacecolor": "none", "color": "black", "linestyle": "none",
           "markeredgewidth": 1.4, "path_effects": axes.outline(3)}
SMALLEST_ERROR = 1e-17  # equal forces are drawn here: below the unit roundoff of a double


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None) -> Axes | None:
    """The audit of a map file; None if no cell has been audited yet."""
    audit = file.audit
    if audit is None or audit.count == 0:
        return None
    reduced, counts = orbit_picture(file, ["regime", "impacts", "period"])
    differing = int(np.sum(~audit.agrees))
    handles = [Line2D([], [], label=f"same label ({audit.count - differing} cells)", **AGREES | {"markersize": 5}),
               Line2D([], [], label=f"other label ({differing})", **DIFFERS)]
    figure, ax, error_ax = axes.stack(WIDTH, reduced.image, [(handles, 2, None), *_background(counts)], panel_height=ERROR_HEIGHT,
                                      ax=ax)
    axes.show_classes(ax, reduced, [paler(entry.colour, PALE) for entry in CLASSES], INDEX["not computed yet"])
    axes.label_axes(ax, file)
    for chosen, look in ((audit.agrees, AGREES), (~audit.agrees, DIFFERS)):
        if not chosen.any():  # a line without points has no extent, which breaks the layout
            continue
        ax.plot(file.columns.values[audit.column[chosen]], file.rows.values[audit.row[chosen]], clip_on=False, **look)
    _draw_errors(error_ax, audit.force_error)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, f"audit of {audit.count} cells by an independent engine", ax)
    return ax


def _background(counts: Integers) -> list[tuple[list[Artist], int, str | None]]:
    """Legends of the plane's pale classes."""
    present = [(n, axes.legend_patch(CLASSES[n].label, paler(CLASSES[n].colour, PALE), n == INDEX["not computed yet"]))
               for n in np.flatnonzero(counts)]
    orbits = [key for n, key in present if CLASSES[n].orbit or n == INDEX["other p/q"]]
    return [(orbits, 4, "$z = p/q$ of the map"), ([key for _, key in present if key not in orbits], 2, None)]


def compared_errors(force_error: Reals) -> Reals:
    """The comparable errors, ascending."""
    return np.sort(force_error[np.isfinite(force_error)])


def _draw_errors(ax: Axes, force_error: Reals) -> None:
    errors = compared_errors(force_error)
    ax.set_ylim(0, 100)
    ax.set_ylabel("share of cells (%)")
    ax.set_xlabel("difference of peak forces (relative)")
    if not len(errors):
        ax.text(0.5, 0.5, "no cell with forces to compare", transform=ax.transAxes, ha="center", va="center")
        ax.set_xticks([])
        return
    drawn = np.maximum(errors, SMALLEST_ERROR)
    low, high = 10.0 ** np.floor(np.log10(drawn[0]) - 0.1), 10.0 ** np.ceil(np.log10(drawn[-1]) + 0.1)
    steps = 100 * np.arange(len(errors) + 1) / len(errors)
    ax.step(np.concatenate([[low], drawn, [high]]), np.append(steps, 100), where="post", color="#0072B2", linewidth=1.2)
    ax.set_xlim(low, high)
    axes.log_scale(ax, "x")
    median = np.quantile(errors, 0.5, method="inverted_cdf")  # as in the program's summary
    # above the curve, which never reaches there
    ax.text(
        0.03, 0.94, f"{len(errors)} cells\nmedian {median:.1e}\nlargest {errors[-1]:.1e}",
        transform=ax.transAxes, ha="left", va="top", bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5},
    )
