"""Shows of which cells the motion, or each attractor, is proved in interval arithmetic, and why that of the others is not."""

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes

from ..arrays import Integers, Mask
from ..files.regimes import NO_IMPACT, NOT_COMPUTED, PERIODIC, SUSTAINED_CONTACT
from ..plotting import axes
from ..plotting.picture import picture
from .map_file import PeterkaFile
from .reduce import class_picture

WIDTH = 3.7  # in
UNSETTLED = 100
# By the number of `certified`, or UNSETTLED: words and colour, in the order of the legend.
VERDICTS = {
    2: ("proved, and that the start leads there", "#0072B2"),
    1: ("proved", "#7FC4F0"),
    -1: ("cubic spring too strong", "#4F7A46"),
    -2: ("no theorem for this stop", "#8F5F86"),
    -3: ("no orbit found", "#D55E00"),
    -4: ("another p or q", "#762024"),
    -5: ("no orbit enclosed", "#E69F00"),
    -6: ("near a grazing", "#1A1A1A"),
    -7: ("not surely stable", "#CC79A7"),
    -8: ("force not bounded", "#F0E442"),
    0: ("not tried", "#C8C8C8"),
    UNSETTLED: ("no motion that settles", "#F2F2F2"),
    NOT_COMPUTED: ("not computed yet", "#FFFFFF"),
}
_NUMBERS = np.array(sorted(VERDICTS))
NAMES = [VERDICTS[number][0] for number in _NUMBERS.tolist()]
COLOURS = [VERDICTS[number][1] for number in _NUMBERS.tolist()]
MISSING = NAMES.index("not computed yet")


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The picture as Axes, with the share of each verdict in its legend."""
    return _draw(file, ax, ["regime", "certified"], _classify, "what is proved")


@picture(PeterkaFile)
def draw_attractors(file: PeterkaFile, ax: Axes | None = None) -> Axes:
    """The same of the attractors of each cell: proved where all that settle are, else why the one with the largest share isn't."""
    return _draw(file, ax, ["regime", "attractor_regime", "attractor_certified"], _classify_attractors, "what is proved of the attractors that settle")


def _draw(file: PeterkaFile, ax: Axes | None, names: Sequence[str], classify: Callable[..., Integers], title: str) -> Axes:
    reduced, counts = class_picture(file, names, classify, len(NAMES))
    verdicts = [NAMES.index(words) for words, _ in VERDICTS.values()]
    handles = [axes.legend_patch(f"{NAMES[n]} ({axes.percent(counts[n] / counts.sum())})", COLOURS[n], n == MISSING)
               for n in verdicts if counts[n]]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, [(handles, 1, None)], ax=ax)
    axes.show_classes(ax, reduced, COLOURS, MISSING)
    axes.label_axes(ax, file)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, title, ax)
    return ax


def _settles(regime: Integers) -> Mask:
    mask: Mask = (regime == NO_IMPACT) | (regime == PERIODIC) | (regime == SUSTAINED_CONTACT)
    return mask


def _classify(regime: Integers, certified: Integers) -> Integers:
    number = np.where(regime == NOT_COMPUTED, NOT_COMPUTED, certified.astype(int))
    is_told = _settles(regime) | (regime == NOT_COMPUTED) | (number != 0)
    return np.searchsorted(_NUMBERS, np.where(is_told, number, UNSETTLED))


def _classify_attractors(regime: Integers, of_slots: Integers, certified: Integers) -> Integers:
    """`of_slots`, `certified`: (slots, rows, columns), the largest share first. Slots of filled cells have no verdict."""
    settles = _settles(of_slots)
    fails = settles & (certified < 0) & (certified != NOT_COMPUTED)
    first = np.take_along_axis(certified, fails.argmax(axis=0)[None], axis=0)[0].astype(int)
    number = np.where(np.all(~settles | (certified > 0), axis=0), 1, 0)
    number = np.where(fails.any(axis=0), first, np.where(settles.any(axis=0), number, UNSETTLED))
    return np.searchsorted(_NUMBERS, np.where(regime == NOT_COMPUTED, NOT_COMPUTED, number))
