"""Detects the impacts of a recording, the sign of its signals, and rough contact durations.

Unsuitable recordings are refused with the reason: no impact, or clipped.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Reals
from ..errors import PeterkaFileError
from .problem import SHARP
from .recording import Recording

OVER_NOISE = 8  # detection threshold, in standard deviations of the noise
OVER_SMOOTHED = 6  # the same once the duration of contacts is known
WEAKEST = 0.01  # of the hardest impact
FLAT_TOP = 0.15  # of the width of a pulse: a flat top longer than this was clipped
FEWEST_CLIPPED = 4  # samples at a signal's end of range
HEAPED = 5.0  # times as many there as at the next value: a smooth top has 2.4 on average, if rounding doesn't heap it
BEND_WIDTHS = (100, 200, 500, 1000, 2000)  # of a displacement: recording length over the averaging window
FAR_NOISE, FAR_STEPS, FAR_RANGE = 3, 10, 0.002  # standard deviations, smallest steps, of the range: how far a displacement has left its first value
LEAVES_WITH_SPEED = 1.35  # ratio of times, between 1 and 5/3
OTHER_RUNS = 4  # times as long as other runs of equal samples
REACH = 0.1  # of its peak: level at which a pulse begins and ends
LOOKED_AT = 1_000_000  # samples at most for a median
AT_ONCE = 1_000_000
RING, RING_REACH = 0.2, 4  # of a pulse's height, and samples: a weaker one that is nearer to it isn't an impact of its own
BENT = 24  # largest contact, in samples, assumed for a displacement


@dataclass(frozen=True)
class Pulse:
    """Samples from `first` to before `last`, where the signal exceeds REACH
    of its peak; the index of the peak and its height above the offset."""

    first: int
    last: int
    top: int
    height: float


@dataclass(frozen=True)
class Guess:
    """`signs` {signal: +1 or -1} that map the recorded signals to the model's; offsets in recorded units, noise as a
    standard deviation, `resolution`: the smallest step between values; `sharp`: the signal that showed the `pulses`, which are in order of time; None if a displacement did."""

    signs: dict[str, int]
    offsets: dict[str, float]
    noise: dict[str, float]
    ranges: dict[str, float]
    resolution: dict[str, float]
    sharp: str | None
    pulses: list[Pulse]

    @property
    def hardest(self) -> int:
        """Index of the hardest pulse."""
        return int(np.argmax([pulse.height for pulse in self.pulses]))

    @property
    def contact(self) -> int:
        """Duration of the hardest contact in samples, as estimated from the pulse."""
        pulse = self.pulses[self.hardest]
        return pulse.last - pulse.first


def look(recording: Recording, calm: Recording | None = None) -> Guess:
    """The Guess from a recording; `calm`: the same with less drift and hum, to find impacts by. Raises PeterkaFileError if it shows no measurable impact."""
    signals = (calm or recording).signals
    offsets = {name: float(np.nanmedian(_some(values))) for name, values in signals.items()}
    noise = {name: noise_of(values) for name, values in signals.items()}
    ranges = {name: _range(values) for name, values in signals.items()}
    sharp = next((name for name in SHARP if name in signals), None)
    if sharp is None:
        sign, pulses = _bends(recording)
    else:
        values, offset = signals[sharp], offsets[sharp]
        lowest, highest = _extremes(values)
        sign = 1 if highest - offset >= offset - lowest else -1
        pulses = _pulses(values, sign, offset, noise[sharp], max(highest - offset, offset - lowest))
    if not pulses:
        raise PeterkaFileError(f"{recording.path} shows no impact: its {sharp} never stands out of the rest by "
                          f"{OVER_NOISE} times the noise")
    guess = Guess({}, offsets, noise, ranges, {name: _resolution(values) for name, values in recording.signals.items()}, sharp, pulses)
    hardest = pulses[guess.hardest]
    if sharp is None:
        guess.signs["displacement"] = sign
    else:
        _refuse_clipped(recording, sharp, recording.signals[sharp], hardest)
        guess.signs[sharp] = sign if sharp == "force" else -sign  # the stop pushes the hammer back
        if "acceleration" in signals and sharp == "force":
            guess.signs["acceleration"] = _sign_at(signals["acceleration"], offsets["acceleration"], hardest, turn=-1)
        if "displacement" in signals:
            guess.signs["displacement"] = _sign_of_displacement(signals["displacement"], hardest)
    guess.signs.update({name: 1 for name in signals if name.startswith("cart_")})
    _refuse_heaped(recording, guess)
    _refuse_clipped_start(recording, guess)
    return guess


def noise_of(values: Reals) -> float:
    """Standard deviation of the sample-to-sample noise, insensitive to slow swings and rare impacts."""
    steps = np.diff(_pieces(values))
    steps = steps[np.isfinite(steps)]
    return float(1.4826 * np.median(np.abs(steps - np.median(steps))) / np.sqrt(2)) if len(steps) else 0.0


def _some(values: Reals) -> Reals:
    return np.asarray(values[::max(1, len(values) // LOOKED_AT)], dtype=float)


def _pieces(values: Reals) -> Reals:
    """Samples of neighbouring values, from the whole recording."""
    if len(values) <= LOOKED_AT:
        return np.asarray(values, dtype=float)
    begins = np.linspace(0, len(values) - 1000, LOOKED_AT // 1000).astype(int)
    return np.concatenate([np.append(values[begin:begin + 1000], np.nan) for begin in begins])


def _extremes(values: Reals) -> tuple[float, float]:
    found = [(np.nanmin(part), np.nanmax(part)) for first in range(0, len(values), AT_ONCE)
             if np.isfinite(part := np.asarray(values[first:first + AT_ONCE], dtype=float)).any()]
    return float(min(low for low, _ in found)), float(max(high for _, high in found))


def _range(values: Reals) -> float:
    lowest, highest = _extremes(values)
    return max(highest - lowest, 1e-300)


def _pulses(values: Reals, sign: int, offset: float, noise: float, highest: float) -> list[Pulse]:
    """All Pulses of a signal for impacts of this sign: once the hardest one's
    width is known, weaker ones are detected after smoothing over a third of it."""
    swing = float(np.nanquantile(np.abs(_some(values) - offset), 0.9))  # amplitude between impacts
    if not highest > max(OVER_NOISE * noise, 3 * swing):
        return []
    limit = max(OVER_NOISE * noise, WEAKEST * highest, 1.5 * swing)
    found = _above(values, sign, offset, limit, noise, 1)
    hardest = max(found, key=lambda pulse: pulse.height)
    width = (hardest.last - hardest.first) // 3
    if width < 2:
        return found
    smoothed = max(OVER_SMOOTHED * noise / np.sqrt(width), WEAKEST * highest, 1.5 * swing)
    return _above(values, sign, offset, smoothed, noise, width) if smoothed < limit else found


def _above(values: Reals, sign: int, offset: float, limit: float, noise: float, width: int) -> list[Pulse]:
    """The Pulses found in means over this many samples."""
    count, found, begin = len(values), [], 0
    for start in range(0, count, AT_ONCE):
        stop = min(count, start + AT_ONCE + 10 * width + 1000)
        part = sign * (np.nan_to_num(np.asarray(values[start:stop], dtype=float), nan=offset) - offset)
        level = np.convolve(part, np.ones(width) / width, mode="same") if width > 1 else part
        for at in np.flatnonzero(level[:AT_ONCE] > limit):
            if at + start < begin:
                continue
            pulse = _pulse_around(level, int(at), max(0, begin - start), 3 * noise / np.sqrt(width))
            top = pulse.first + int(np.argmax(part[pulse.first:pulse.last]))
            found.append(Pulse(pulse.first + start, pulse.last + start, top + start, float(level[pulse.top])))
            begin = 2 * found[-1].last - found[-1].first  # skips its tail, which is not an impact
    return _without_rings(found)


def _without_rings(found: list[Pulse]) -> list[Pulse]:
    """The same without those that a logger's filter puts before and after a short one."""
    return [one for at, one in enumerate(found) if not any(
        one.height < RING * other.height and max(one.first - other.last, other.first - one.last) < RING_REACH for other in found[max(0, at - 2):at + 3])]


def _pulse_around(values: Reals, start: int, begin: int, floor: float) -> Pulse:
    """Extent of the pulse from `begin` on; samples below the floor belong to no pulse."""
    last = start + 1
    top = start
    while last < len(values) and values[last] > max(REACH * values[top], floor):
        top = last if values[last] > values[top] else top
        last += 1
    first = start
    while first > begin and values[first - 1] > max(REACH * values[top], floor):
        first -= 1
    return Pulse(first, last, top, float(values[top]))


def _refuse_clipped(recording: Recording, name: str, values: Reals, pulse: Pulse) -> None:
    height = values[pulse.top]
    piece = np.asarray(values[pulse.first:pulse.last], dtype=float)
    flat = np.abs(piece - height) <= 1e-9 * np.nanmax(np.abs(piece - height), initial=1e-300)
    at = pulse.top - pulse.first
    run = int(np.argmin(np.append(flat[at:], False))) + int(np.argmin(np.append(flat[at::-1], False))) - 1
    if run >= 3 and run > FLAT_TOP * (pulse.last - pulse.first):
        raise PeterkaFileError(f"{recording.path} is clipped: its {name} stays at {height:.4g} for {run} samples at the top of the "
                          f"hardest impact, at {recording.begin + pulse.top * recording.step:.6g} s; record with a larger range")


def _refuse_heaped(recording: Recording, guess: Guess) -> None:
    """Raises PeterkaFileError where a signal's samples heap at an end of its range: forces and accelerations of the impacts at that
    towards which impacts go, displacements at that away from the stop. Before a release the hammer is held there, and at the stop it may come to rest.
    Values of which rounding is coarser than noise are left alone: those of impacts that are alike, sampled in step with them, are all the same."""
    for name in ("force", "acceleration", "displacement"):
        if name not in recording.signals or guess.noise[name] < guess.resolution[name]:
            continue
        values, end = recording.signals[name], guess.signs[name] * (1 if name == "force" else -1)
        if name == "displacement":
            piece = _some(values[guess.pulses[0].first:])
        else:
            piece = np.asarray(values[np.concatenate([np.arange(pulse.first, pulse.last) for pulse in guess.pulses])], dtype=float)
        last, times = _heap(float(end) * piece)
        if times:
            raise PeterkaFileError(f"{recording.path} is clipped: its {name} is {end * last:.4g}, and never beyond, in {times} samples; record with a "
                              "larger range")


def _refuse_clipped_start(recording: Recording, guess: Guess) -> None:
    """Raises PeterkaFileError where a displacement stays at its first value and leaves it with speed. A hammer that was held there leaves from rest: the
    times at which it is once, four and nine times as far away are equally far apart, and 3:5 if it leaves with speed."""
    values = np.asarray(recording.signals.get("displacement", np.empty(0))[:max(0, min(guess.pulses[0].first, AT_ONCE))], dtype=float)
    values = values[np.isfinite(values)]
    if len(values) < FEWEST_CLIPPED:
        return
    away = np.abs(values - values[0])
    run = int(np.argmax(away > 0))
    noise = 1.4826 * float(np.median(np.abs(np.diff(values[run:], 2)))) / np.sqrt(6) if len(values) > run + 2 else 0.0
    near = max(FAR_NOISE * noise, FAR_STEPS * guess.resolution["displacement"], FAR_RANGE * guess.ranges["displacement"])
    if not away.max() > 9 * near:
        return
    once, four, nine = ((np.argmax(away > level) + np.flatnonzero(away[:int(np.argmax(away > 9 * near)) + 1] <= level)[-1]) / 2
                        for level in (near, 4 * near, 9 * near))
    later = np.diff(np.flatnonzero(np.diff(values[run:int(nine) + 2])), prepend=-1)  # lengths of the runs of equal samples on that way
    held = run >= FEWEST_CLIPPED and run > OTHER_RUNS * np.max(later, initial=1)  # others are rounding
    if held and nine - four > LEAVES_WITH_SPEED * (four - once):
        raise PeterkaFileError(f"{recording.path} is clipped: its displacement is {values[0]:.4g} for {run} samples, from which it leaves with speed; "
                          "record with a larger range, or cut that out with --from")


def _heap(values: Reals) -> tuple[float, int]:
    """(largest value, number of samples there), 0 if these are no more than a smooth top has."""
    values = values[np.isfinite(values)]
    if not len(values):
        return np.nan, 0
    largest, near = float(values.max()), 1e-9 * float(np.ptp(values))
    others = values[values < largest - near]
    if not len(others):  # a constant
        return largest, 0
    there = len(values) - len(others)
    next_to_it = int(np.sum(others >= others.max() - near))
    return largest, there if there >= FEWEST_CLIPPED and there > HEAPED * next_to_it else 0


def _resolution(values: Reals) -> float:
    steps = np.diff(np.unique(_some(values)))
    return float(np.min(steps[steps > 0], initial=np.inf)) if np.any(steps > 0) else 0.0


def _sign_at(values: Reals, offset: float, pulse: Pulse, turn: int) -> int:
    piece = np.asarray(values[max(0, pulse.first - 1):pulse.last + 1]) - offset
    return int(np.sign(piece[np.nanargmax(np.abs(piece))])) * turn or 1


def _sign_of_displacement(values: Reals, pulse: Pulse) -> int:
    """+1 if the hammer approaches from below: it rises before the impact and falls after it."""
    around = 20 * (pulse.last - pulse.first)
    middle = np.nanmean(values[pulse.first:pulse.last])
    before, after = values[max(0, pulse.first - around):pulse.first], values[pulse.last:pulse.last + around]
    return 1 if middle >= np.mean([np.nanmean(piece) for piece in (before, after) if np.isfinite(piece).any()]) else -1


def _bends(recording: Recording) -> tuple[int, list[Pulse]]:
    """(sign, Pulses) of a displacement alone: an impact is an abrupt change
    of its velocity, seen over the number of samples that shows it best."""
    if "displacement" not in recording.signals:
        raise PeterkaFileError(f"{recording.path} has no force, acceleration or displacement of the hammer")
    values = np.asarray(recording.signals["displacement"], dtype=float)
    there = np.isfinite(values)
    values = np.interp(np.arange(len(values)), np.flatnonzero(there), values[there])
    bends = [_bend(values, max(2, len(values) // share)) for share in BEND_WIDTHS]
    width, bend, limit = max(bends, key=lambda found: float(np.abs(found[1]).max() / found[2]))
    at = int(np.argmax(np.abs(bend)))
    if not abs(bend[at]) > limit:
        raise PeterkaFileError(f"{recording.path} shows no impact: its displacement never turns back at once")
    sign = -int(np.sign(bend[at]))
    beyond = np.flatnonzero(-sign * bend > max(limit, 0.05 * abs(bend[at])))
    groups = np.split(beyond, np.flatnonzero(np.diff(beyond) > 2 * width) + 1)
    tops = [int(group[np.argmax(np.abs(bend[group]))] + 1.5 * width) for group in groups]
    return sign, [Pulse(top - BENT // 4, top + BENT // 4, top, float(abs(bend[min(max(0, int(top - 1.5 * width)), len(bend) - 1)])))
                  for top in tops]


def _bend(values: Reals, width: int) -> tuple[int, Reals, float]:
    """(width, second differences of means over `width` samples, relative to the detection threshold)."""
    sums = np.concatenate([[0], np.cumsum(values - values.mean())])
    means = (sums[width:] - sums[:-width]) / width
    bend = means[2 * width:] - 2 * means[width:-width] + means[:-2 * width]
    noise = noise_of(values) * np.sqrt(6 / width)
    return width, bend, max(OVER_NOISE * noise, 4 * np.quantile(np.abs(bend), 0.9))
