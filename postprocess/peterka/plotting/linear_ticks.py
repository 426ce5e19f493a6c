"""Ticks of linear axes of any range with labels that do not overlap: as many round numbers as fit.

Matplotlib writes a power of ten common to the labels at the end of the axis, where other scales and titles are; here each
label includes it. The labels of an axis are either all plain, or all with the same power of ten.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, ScalarFormatter
from matplotlib.transforms import Bbox

from ..arrays import Reals
from .log_ticks import LETTER, LINE, PLAIN_FROM, PLAIN_TO, SPACE, USUAL_LENGTH

MOST, MOST_OF_LONG, LONG = 7, 10, 4.5  # intervals between ticks, and the axis length [in] from which more are permitted


class LinearTicks(MaxNLocator):
    """Set it as the major locator; it asks the axis's own LinearNumbers for the width of labels."""

    def __init__(self) -> None:
        super().__init__(nbins=MOST, steps=[1, 2, 5, 10])

    def __call__(self) -> Reals:
        low, high = sorted(self.axis.get_view_interval())
        ticks = np.array([])
        for intervals in range(MOST if _length(self.axis) < LONG else MOST_OF_LONG, 0, -1):
            self.set_params(nbins=intervals)
            ticks = self.tick_values(low, high)
            if self._fit(ticks, low, high):
                break
        return ticks

    def _fit(self, ticks: Reals, low: float, high: float) -> bool:
        slack = 1e-9 * (high - low)
        seen = ticks[(ticks >= low - slack) & (ticks <= high + slack)]
        if len(seen) < 2 or not high > low:
            return True
        places = _length(self.axis) * (seen - low) / (high - low)
        widths = np.full(len(seen), LINE)
        if self.axis.axis_name == "x":
            widths = LETTER * np.array([letters(text) for text in numbers(seen)])
        return bool(np.all(np.diff(places) >= (widths[:-1] + widths[1:]) / 2 + SPACE))


class LinearNumbers(ScalarFormatter):
    """The labels that go with LinearTicks."""

    def __init__(self) -> None:
        super().__init__(useOffset=False)
        self.set_scientific(False)

    def format_ticks(self, values: Sequence[float]) -> list[str]:
        """All labels at once."""
        self.set_locs(values)
        return numbers(np.asarray(values, dtype=float))

    def __call__(self, value: float, pos: int | None = None) -> str:
        return numbers(np.asarray([value, *self.locs], dtype=float))[0]


def numbers(values: Reals) -> list[str]:
    """Labels of evenly spaced values."""
    largest = np.max(np.abs(values), initial=0)
    if largest == 0:
        return ["0"] * len(values)
    step = np.min(np.diff(np.unique(values)), initial=largest)
    exponent = 0 if PLAIN_FROM <= largest < PLAIN_TO else int(np.floor(np.log10(largest) + 1e-9))
    decimals = int(np.clip(np.ceil(exponent - np.log10(step) - 1e-9), 0, 15))
    while decimals < 15 and abs(round(step / 10.0**exponent, decimals) * 10.0**exponent - step) > 1e-6 * step:
        decimals += 1
    return [_label(value, exponent, decimals) for value in values]


def _label(value: float, exponent: int, decimals: int) -> str:
    text = f"{round(value / 10.0**exponent, decimals) + 0.0:.{decimals}f}".replace("-", "\N{MINUS SIGN}")
    if exponent == 0:
        return text
    return "0" if value == 0 else f"${text}\\cdot10^{{{exponent}}}$".replace("\N{MINUS SIGN}", "-")


def letters(label: str) -> float:
    """The width of a label, in digits."""
    if not label.startswith("$"):
        return len(label)
    factor, exponent = label.strip("$").split("\\cdot10^")
    return len(factor) + 3 + 0.7 * len(exponent.strip("{}"))


def use_everywhere(figure: Figure) -> None:
    """Sets these ticks on all linear axes of a figure with default ticks, including second scales."""
    for ax in figure.axes:
        for one in [ax, *ax.child_axes]:
            for axis in (one.xaxis, one.yaxis):
                # "function" is the scale of a second axis
                if axis.get_scale() in ("linear", "function") and isinstance(axis.get_major_locator(), MaxNLocator):
                    axis.set_major_locator(LinearTicks())
                    axis.set_major_formatter(LinearNumbers())


def _length(axis: Axis) -> float:
    """Length of the axis [in]."""
    ax = axis.axes
    box = ax.bbox if ax is not None and ax.figure is not None else Bbox.unit()
    if not box.width > 1:
        return USUAL_LENGTH
    return float((box.height if axis.axis_name == "y" else box.width) / ax.figure.dpi)
