"""Visible marks of a picture: no text is written over them."""

import numpy as np
from matplotlib.axes import Axes

from ..arrays import Reals

SEEN = "a mark to be seen"  # the gid of such lines and patches


def boxes(ax: Axes) -> Reals:
    """Boxes of these marks, a row [left, bottom, right, top] each [pixels]."""
    half = 0.75 / 72 * ax.get_figure().dpi
    areas = [patch.get_window_extent().extents for patch in ax.patches if patch.get_gid() == SEEN]
    places = [(line.get_transform().transform(line.get_xydata()), half * line.get_markersize()) for line in ax.lines if line.get_gid() == SEEN]
    return np.concatenate([np.reshape(areas, (-1, 4)), *(np.hstack([place - size, place + size]) for place, size in places)])
