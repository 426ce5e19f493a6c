"""Ticks of a logarithmic axis of any range with labels that do not overlap.

Matplotlib's own locators place as many labels on a logarithmic axis as its range has decades, whatever the space. This one
takes the densest of a few round sequences whose labels fit, and evenly spaced round numbers if the range is too narrow for
any of them. The labels of an axis are all plain, or all powers of ten.
"""

from collections.abc import Iterable, Iterator

import numpy as np
from matplotlib.ticker import Formatter, Locator, MaxNLocator

from ..arrays import Reals

SEQUENCES: list[tuple[int, ...]] = [tuple(range(1, 10)), (1, 2, 5), (1,)]  # within a decade
LETTER, LINE, SPACE = 0.079, 0.12, 0.09  # in: width and height of an 8 pt digit, least space between labels
USUAL_LENGTH = 2.9  # in, of an axis without a figure
PLAIN_FROM, PLAIN_TO = 1e-3, 1e5  # outside this range powers of ten are shorter
ROUNDING = 1e-9


class LogTicks(Locator):
    """Set it as the major locator."""

    def __call__(self) -> Reals:
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, vmin: float, vmax: float) -> Reals:
        """The ticks between two ends, which are round numbers if any fit."""
        low, high = sorted((vmin, vmax))
        if not 0 < low < high < np.inf:
            return np.array([])
        for ticks in _sequences(low, high):
            if self._fits(ticks, low, high):
                return ticks if len(ticks) > 1 or high > 10 * low else _even_ticks(low, high)
        return np.array([low, high])

    def _fits(self, ticks: Reals, low: float, high: float) -> bool:
        places = self._length() * np.log(ticks / low) / np.log(high / low)
        plain = all_plain(ticks)
        letters = np.array([len(f"{tick:g}") if plain else 4.5 for tick in ticks])
        widths = np.full(len(ticks), LINE) if self._upright() else LETTER * letters
        return bool(np.all(np.diff(places) >= (widths[:-1] + widths[1:]) / 2 + SPACE))

    def _upright(self) -> bool:
        return self.axis is not None and self.axis.axis_name == "y"

    def _length(self) -> float:
        """Length of the axis [in]."""
        ax = getattr(self.axis, "axes", None)
        if ax is None or ax.figure is None:
            return USUAL_LENGTH
        return float((ax.bbox.height if self._upright() else ax.bbox.width) / ax.figure.dpi)


class LogNumbers(Formatter):
    """The labels that go with LogTicks."""

    def __call__(self, value: float, _: int | None = None) -> str:
        shown = self.locs
        if self.axis is not None:
            low, high = sorted(self.axis.get_view_interval())
            shown = [tick for tick in self.locs if low <= tick <= high]
        return plain_number(value) if all_plain(shown) else power_of_ten(value)


def all_plain(values: Iterable[float]) -> bool:
    """Whether labels are plain numbers; otherwise they are powers of ten."""
    return all(PLAIN_FROM <= value < PLAIN_TO for value in values)


def plain_number(value: float) -> str:
    """0.02 is "0.02"."""
    return f"{value:g}"


def power_of_ten(value: float) -> str:
    """2e-5 is "2·10⁻⁵", as matplotlib writes mathematics."""
    exponent = int(np.floor(np.log10(abs(value)) + ROUNDING))
    factor = value / 10.0**exponent
    return f"$10^{{{exponent}}}$" if np.isclose(factor, 1) else f"${factor:g}\\cdot10^{{{exponent}}}$"


def _even_ticks(low: float, high: float) -> Reals:
    ticks = MaxNLocator(nbins=5, steps=[1, 2, 5, 10]).tick_values(low, high)
    values: Reals = ticks[(ticks >= low) & (ticks <= high)]
    return values


def _sequences(low: float, high: float) -> Iterator[Reals]:
    """Round numbers within [low, high], from dense to sparse."""
    first, last = int(np.floor(np.log10(low))), int(np.ceil(np.log10(high)))

    def within(values: Reals) -> Reals:
        return values[(values >= low * (1 - ROUNDING)) & (values <= high * (1 + ROUNDING))]

    for factors in SEQUENCES:
        yield within(np.ravel(np.outer(10.0 ** np.arange(first, last + 1), factors)))
    for step in range(2, last - first + 1):
        yield within(10.0 ** np.arange(-(-first // step) * step, last + 1, step))
