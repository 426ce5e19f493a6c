"""How long settled motions last under the disturbances of [noise]: of each cell the one with the largest share, or its own.

Longer lives are lighter, on a scale of powers of ten. Blocks of a reduced map show their shortest life.
"""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from numpy.typing import NDArray

from ..arrays import Integers, Reals, ma
from ..files.regimes import NO_IMPACT, NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT
from ..plotting import axes, style
from ..plotting.limits import beyond, requested
from ..plotting.picture import picture
from .attractor_maps import reduced_values
from .field_map import scale_colours, without_value
from .map_file import LIVES, PeterkaFile
from .reduce import class_picture

WIDTH = 3.7  # in
NONE_SETTLED, WAITING, UNENDED, ENDS = range(4)  # what is known of a cell
COLOURS = ["#F7C6D0", "#FFFFFF", "#F2F2F2", "#FFFFFF"]
HATCHES = ["++", "", "", ""]  # in the grey palette
WIDEST = 1e6  # ratio of the ends of the scale, at most


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None) -> Axes | None:
    """The mean life of the settled motion with the largest share, or of the cell's own. None if none was followed."""
    names = ["regime", *(["attractor_regime"] if file.slots else []), *LIVES]

    def kinds(regime: Integers, *of_motions: NDArray[Any]) -> Integers:
        life, least = _settled(regime, *of_motions)
        kind = np.where(np.isfinite(life), ENDS, np.where(np.isfinite(least), UNENDED, NONE_SETTLED))
        return np.where(regime == NOT_COMPUTED, WAITING, kind)

    classes, counts = class_picture(file, names, kinds, len(COLOURS))
    if not counts[[UNENDED, ENDS]].any():
        return None
    reduced = reduced_values(file, names, lambda regime, *of_motions: _settled(regime, *of_motions)[0], np.fmin)
    texts = {NONE_SETTLED: "none settled, or not followed", UNENDED: "hardly a life seen to end", WAITING: "not computed yet"}
    looks = [without_value(*look) for look in zip(COLOURS, HATCHES)]
    handles = [axes.legend_patch(text, looks[kind], hatched=kind == WAITING) for kind, text in texts.items() if counts[kind]]
    figure, ax, bar_ax = axes.stack(WIDTH, reduced.image, [(handles, 2, None)], bar=True, ax=ax)
    axes.show_classes(ax, classes, looks, WAITING)
    style.scale_option("log")  # lives have such a scale anyway
    limits = requested(file, reduced.image, ("s", 1.0))
    low, high = limits if limits and np.isfinite(reduced.image).any() else _limits(reduced.image)
    low = max(low, high / WIDEST)
    mesh = ax.pcolormesh(reduced.column_edges, reduced.row_edges, ma.masked_invalid(reduced.image), cmap=scale_colours(),
                         norm=LogNorm(low, high), rasterized=True)
    bar = figure.colorbar(mesh, cax=bar_ax, orientation="horizontal", extend=beyond(reduced.image, low, high))
    bar.outline.set_linewidth(0.6)
    bar.minorticks_off()
    whose = "likeliest settled motion" if file.slots else "settled motion"
    bar.set_label(f"mean life of the {whose} under [noise] (s)", fontsize=8)
    axes.label_axes(ax, file)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, ax=ax)
    return ax


def _settled(regime: Integers, *of_motions: NDArray[Any]) -> tuple[Reals, Reals]:
    """The mean life, and its bound, of the first slot with a settled motion, or of the cell: (rows, columns); NaN where it wasn't followed."""
    of, life, least = of_motions if len(of_motions) == 3 else (regime, *of_motions)
    settled = np.isin(of, [NO_IMPACT, PERIODIC, SUSTAINED_CONTACT])
    life, least = (np.where(settled & (values > 0) & np.isfinite(values), values, np.nan) for values in (life, least))
    if life.ndim == 2:
        return life, least
    first = np.argmax(settled, axis=0)[None]
    return np.take_along_axis(life, first, axis=0)[0], np.take_along_axis(least, first, axis=0)[0]


def _limits(lives: Reals) -> tuple[float, float]:
    """The ends of the scale, in whole powers of ten, two apart at least."""
    finite = lives[np.isfinite(lives)]
    if not finite.size:
        return 1.0, 100.0
    low = 10 ** np.floor(np.log10(finite.min()))
    return float(low), float(np.clip(10 ** np.ceil(np.log10(finite.max())), 100 * low, WIDEST * low))
