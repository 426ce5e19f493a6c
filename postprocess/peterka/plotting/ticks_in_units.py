"""Ticks of an axis in other units than those of its data: round numbers of these units, and so is the axis's grid."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axis import Axis
from matplotlib.ticker import Formatter, Locator, NullLocator

from ..arrays import Reals
from .linear_ticks import LinearNumbers, LinearTicks
from .log_ticks import LogNumbers, LogTicks


def number_in_units(axis: Axis, factor: float) -> None:
    """Numbers an axis, linear or logarithmic, in units of which one of its own has `factor`."""
    is_log = axis.get_scale() == "log"
    seen = _Seen(axis, factor)
    axis.set_major_locator(_Ticks(LogTicks() if is_log else LinearTicks(), seen))
    axis.set_major_formatter(_Numbers(LogNumbers() if is_log else LinearNumbers(), seen))
    axis.set_minor_locator(NullLocator())


class _Seen:
    """An axis as its ticks see it: from end to end in the other units."""

    def __init__(self, axis: Axis, factor: float) -> None:
        self._axis, self.factor = axis, factor

    def get_view_interval(self) -> Reals:
        return np.asarray(self._axis.get_view_interval()) * self.factor

    def __getattr__(self, name: str) -> Any:
        return getattr(self._axis, name)


class _Ticks(Locator):
    def __init__(self, ticks: Locator, seen: _Seen) -> None:
        self._ticks, self._factor = ticks, seen.factor
        ticks.set_axis(seen)

    def __call__(self) -> Reals:
        return np.asarray(self._ticks()) / self._factor


class _Numbers(Formatter):
    def __init__(self, numbers: Formatter, seen: _Seen) -> None:
        self._numbers, self._factor = numbers, seen.factor
        numbers.set_axis(seen)

    def set_locs(self, locs: Sequence[float]) -> None:
        self.locs = locs
        self._numbers.set_locs(np.asarray(locs, dtype=float) * self._factor)

    def format_ticks(self, values: Sequence[float]) -> list[str]:
        self.set_locs(values)
        found: list[str] = self._numbers.format_ticks(np.asarray(values, dtype=float) * self._factor)
        return found

    def __call__(self, value: float, pos: int | None = None) -> str:
        text: str = self._numbers(value * self._factor, pos)
        return text
