"""Shows which cells of a refined map are computed, and which are filled in from computed neighbours."""

import numpy as np
from matplotlib.axes import Axes

from ..arrays import Integers
from ..files.regimes import NOT_COMPUTED
from ..plotting import axes
from ..plotting.picture import picture
from .map_file import PeterkaFile
from .reduce import class_picture

WIDTH = 3.7  # in
FILLED, COMPUTED, MISSING = 0, 1, 2
COLOURS = ["#F2F2F2", "#0072B2", "#FFFFFF"]
NAMES = ["filled", "computed", "not computed yet"]


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The picture as Axes, with both shares in its legend."""
    reduced, counts = class_picture(file, ["regime", "computed"], _classify, len(NAMES))
    handles = [axes.legend_patch(f"{NAMES[n]} ({axes.percent(counts[n] / counts.sum())})", COLOURS[n], n == MISSING)
               for n in (COMPUTED, FILLED, MISSING) if counts[n]]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, [(handles, 2, None)], ax=ax)
    axes.show_classes(ax, reduced, COLOURS, MISSING)
    axes.label_axes(ax, file)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, ax=ax)
    return ax


def _classify(regime: Integers, computed: Integers) -> Integers:
    return np.where(regime == NOT_COMPUTED, MISSING, np.where(computed == 0, FILLED, COMPUTED))
