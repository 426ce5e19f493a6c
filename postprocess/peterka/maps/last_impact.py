"""The number of forcing cycles until the last impact, where impacts end (an example is the paper's Fig. 24b).

Light is early, dark is late; cells whose impacts continue or are undecided have other colours.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ..arrays import Integers
from ..files.regimes import CHAOTIC, FAILED, NO_IMPACT, NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT
from ..plotting import axes, style
from ..plotting.classes import CLASSES, INDEX
from ..plotting.fills import Fill, grey
from ..plotting.picture import picture
from .map_file import PeterkaFile
from .reduce import class_picture

WIDTH = 3.7  # in
ENDS = (0, 30, 100, 300, 1000, 3000, 10000)  # forcing cycles: each class ends at its value
SHADES = ["#F2F2F2", "#FDE9A9", "#F6B95A", "#E37F3A", "#B8433F", "#7A1F4E", "#3D0F4A", "#140A26"]
GOES_ON, PRESSED, UNDECIDED, FILLED, MISSING = (len(SHADES) + n for n in range(5))
COLOURS = [*SHADES, "#0072B2", CLASSES[INDEX["sustained contact"]].colour, "#C04DF7", "#BFE3D0", "#FFFFFF"]
NAMES = ["none at all", *(f"{low + 1} to {high}" for low, high in zip(ENDS, ENDS[1:])),
         f"more than {ENDS[-1]}", "impacts go on", "sustained contact", "undecided", "no impact, filled: without a run", "not computed yet"]


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The picture as Axes, with the share of each class."""
    reduced, counts = class_picture(file, ["regime", "last_impact", *(["computed"] if file.is_refined else [])], _classify, len(NAMES))
    colours: Sequence[str | Fill] = COLOURS
    if style.is_grey():  # distinct from the scale of lightness
        colours = [*SHADES, Fill(grey(70), "//"), Fill(grey(55), ".."), Fill(grey(100), "xx"), Fill(grey(100), ".."), COLOURS[MISSING]]
    handles = [axes.legend_patch(f"{NAMES[n]} ({axes.percent(counts[n] / counts.sum())})", colours[n], n == MISSING)
               for n in np.flatnonzero(counts)]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, [(handles, 2, "forcing cycles until the last impact")], ax=ax)
    axes.show_classes(ax, reduced, colours, MISSING)
    axes.label_axes(ax, file)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, axes.operating_point(file), ax)
    return ax


def _classify(regime: Integers, last_impact: Integers, computed: Integers | None = None) -> Integers:
    ended = np.searchsorted(ENDS, np.maximum(last_impact, 0))
    goes_on = np.isin(regime, [PERIODIC, CHAOTIC])
    others = np.where(goes_on, GOES_ON, np.where(regime == SUSTAINED_CONTACT, PRESSED, UNDECIDED))
    kinds = np.where(last_impact >= 0, ended, others)
    kinds = np.where(regime == NOT_COMPUTED, MISSING, np.where(regime == FAILED, UNDECIDED, kinds))
    return kinds if computed is None else np.where((computed == 0) & (regime == NO_IMPACT), FILLED, kinds)
