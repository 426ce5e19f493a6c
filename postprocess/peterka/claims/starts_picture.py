"""Where the start determines the regime: a picture from several maps that differ only in their start."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from ..arrays import Integers
from ..plotting import axes, style
from ..maps.map_file import PeterkaFile
from ..maps.reduce import class_picture
from .folder import Plane

from .starts import depends_on_start

WIDTH = 3.7  # in
NAMES = ["same from all starts", "depends on the start", "chaotic or undecided from every start"]
COLOURS = ["#F2F2F2", "#0072B2", "#1A1A1A"]


@style.using()
def draw(file: PeterkaFile, planes: Sequence[Plane]) -> Figure:
    """The picture as a Figure; `file` is one of the maps, open."""
    kinds = np.where(depends_on_start(planes), 1, 0)
    kinds[~np.any([plane.is_settled for plane in planes], axis=0)] = 2
    rows = iter(kinds)

    def classify(regime: Integers) -> Integers:
        return np.stack([next(rows) for _ in regime])

    reduced, counts = class_picture(file, ["regime"], classify, len(NAMES))
    handles = [axes.legend_patch(f"{NAMES[n]} ({axes.percent(counts[n] / counts.sum())})", COLOURS[n])
               for n in np.flatnonzero(counts)]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, [(handles, 1, None)])
    axes.show_classes(ax, reduced, COLOURS, -1)
    axes.label_axes(ax, file)
    axes.write_title(figure, file, f"from {len(planes)} starts")
    return figure
