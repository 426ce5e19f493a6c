"""Visible marks of a picture: no text is written over them."""

from matplotlib.axes import Axes
from matplotlib.transforms import Bbox

SEEN = "a mark to be seen"  # the gid of such lines and patches


def boxes(ax: Axes) -> list[Bbox]:
    """Boxes of these marks [pixels]."""
    half = 0.75 / 72 * ax.get_figure().dpi
    areas = [patch.get_window_extent() for patch in ax.patches if patch.get_gid() == SEEN]
    return areas + [Bbox([place - half * line.get_markersize(), place + half * line.get_markersize()])
            for line in ax.lines if line.get_gid() == SEEN for place in ax.transData.transform(line.get_xydata())]
