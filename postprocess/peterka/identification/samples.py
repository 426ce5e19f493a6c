"""A recording as it is fitted: all samples near impacts, and short-time means between them.

The means of a motion are known in closed form like its values, so little information is lost: a mean over n samples has
1/sqrt(n) of their noise, and no signal changes much within 1/100 of a flight.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..arrays import Integers, Mask, Reals
from .recording import Recording

MOST_MEANS = 600  # between impacts
SHORTEST_MEANS = 100  # in the shortest flight


@dataclass(frozen=True)
class Samples:
    """Times [s] count from the beginning of the recording: `time` (n,) of single samples with `values` {signal: (n,)}; (m,)
    means from `begins` to `ends` over `counts` samples with `means` {signal: (m,)}."""

    time: Reals
    values: dict[str, Reals]
    begins: Reals
    ends: Reals
    counts: Reals
    means: dict[str, Reals]

    @property
    def until(self) -> float:
        """The time [s] of the last single sample, or the end of the last mean."""
        return float(np.concatenate([self.time, self.ends]).max())

    def part(self, begin: float, end: float) -> "Samples":
        """The part between these times [s]."""
        inside, within = (self.time >= begin) & (self.time <= end), (self.begins >= begin) & (self.ends <= end)
        return Samples(self.time[inside], _each(self.values, inside), self.begins[within], self.ends[within],
                       self.counts[within], _each(self.means, within))

    def without_means(self) -> "Samples":
        """The single samples alone."""
        none = np.zeros(0)
        return Samples(self.time, self.values, none, none, none, {name: none for name in self.means})


def thinned(recording: Recording, windows: Iterable[tuple[int, int]], shortest_flight: float | None) -> Samples:
    """The Samples of a Recording: single samples in these windows (first, after the last), means between them.
    `shortest_flight` in s; None if unknown."""
    count = recording.count
    borders = np.clip(np.array(sorted(windows), dtype=int).reshape(-1, 2), 0, count)
    single = np.zeros(0, dtype=int)
    if len(borders):
        single = np.unique(np.concatenate([np.arange(first, last) for first, last in borders]))
    outside = _stretches(borders, count)
    left = sum(last - first for first, last in outside)
    flight = int((shortest_flight or count * recording.step / 4) / recording.step)
    size = max(1, min(-(-left // MOST_MEANS), flight // SHORTEST_MEANS))
    blocks = [_blocks(first, last, size) for first, last in outside]
    firsts, lasts = np.concatenate([np.zeros((0, 2), dtype=int), *blocks]).T
    values = {name: np.asarray(signal[single], dtype=float) for name, signal in recording.signals.items()}
    there = np.logical_and.reduce([np.isfinite(one) for one in values.values()])
    means = {name: _means(signal, firsts, lasts) for name, signal in recording.signals.items()}
    whole = np.logical_and.reduce([np.isfinite(one) for one in means.values()])
    step = recording.step
    return Samples(step * single[there], _each(values, there), step * (firsts[whole] - 0.5), step * (lasts[whole] - 0.5),
                   (lasts - firsts)[whole].astype(float), _each(means, whole))


def _each(signals: dict[str, Reals], chosen: Mask) -> dict[str, Reals]:
    return {name: values[chosen] for name, values in signals.items()}


def _stretches(borders: Integers, count: int) -> list[tuple[int, int]]:
    """(first, after the last) of the intervals outside all windows."""
    found, begin = [], 0
    for first, last in borders:
        if first > begin:
            found.append((begin, first))
        begin = max(begin, last)
    return found + [(begin, count)] * int(count > begin)


def _blocks(first: int, last: int, size: int) -> Integers:
    edges = np.append(np.arange(first, last, size), last)
    return np.transpose([edges[:-1], edges[1:]])


def _means(signal: Reals, firsts: Integers, lasts: Integers) -> Reals:
    return np.array([np.mean(np.asarray(signal[first:last], dtype=float)) for first, last in zip(firsts, lasts)])
