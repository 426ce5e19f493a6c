"""Ticks of a logarithmic axis of any range whose labels don't run together.

Matplotlib's own locators put as many labels on a logarithmic axis as its range has decades, whatever room there is.
This one takes the densest of a few round sequences whose labels have room on an axis of a map's size, and evenly spaced
round numbers where the range is too narrow for any of them.
"""

import numpy as np
from matplotlib.ticker import Locator, MaxNLocator

SEQUENCES = [np.arange(1, 10), (1, 2, 5), (1,)]  # within a decade
LETTER_ROOM, SPACE = 0.027, 0.03
PLAIN_FROM, PLAIN_TO = 1e-3, 1e5  # outside these powers of ten are shorter


class LogTicks(Locator):
    """`letter_room`: width of a label's letter over the length of the axis."""

    def __init__(self, letter_room=LETTER_ROOM):
        self._letter_room = letter_room

    def __call__(self):
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, vmin, vmax):
        low, high = sorted((vmin, vmax))
        if not 0 < low < high < np.inf:
            return np.array([])
        for ticks in _sequences(low, high):
            if self._fits(ticks, low, high):
                return ticks if len(ticks) > 1 else MaxNLocator(nbins=5, steps=[1, 2, 5, 10]).tick_values(low, high)
        return np.array([low, high])

    def _fits(self, ticks, low, high):
        places = np.log(ticks / low) / np.log(high / low)
        widths = self._letter_room * np.array([_letters(tick) for tick in ticks])
        return bool(np.all(np.diff(places) >= (widths[:-1] + widths[1:]) / 2 + SPACE))


def plain_number(value, _=None):
    """1000 as it is, 1e-6 as a power of ten."""
    return f"{value:g}" if PLAIN_FROM <= abs(value) < PLAIN_TO or value == 0 else _power_of_ten(value)


def _power_of_ten(value):
    exponent = int(np.floor(np.log10(abs(value)) + 1e-9))
    factor = value / 10.0**exponent
    return f"$10^{{{exponent}}}$" if np.isclose(factor, 1) else f"${factor:g}\\cdot10^{{{exponent}}}$"


def _letters(value):
    if PLAIN_FROM <= value < PLAIN_TO:
        return len(f"{value:g}")
    return 4.5 if np.isclose(np.log10(value) % 1, 0) else 6


def _sequences(low, high):
    """Round numbers within [low, high], from dense to sparse."""
    first, last = int(np.floor(np.log10(low))), int(np.ceil(np.log10(high)))
    within = lambda values: values[(values >= low * (1 - 1e-9)) & (values <= high * (1 + 1e-9))]  # noqa: E731
    for factors in SEQUENCES:
        yield within(np.ravel(np.outer(10.0 ** np.arange(first, last + 1), factors)))
    for step in range(2, last - first + 1):
        yield within(10.0 ** np.arange(-(-first // step) * step, last + 1, step))
