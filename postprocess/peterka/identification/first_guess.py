"""Where a recording has impacts, which way its signals point, and what rig they would roughly be from.

A recording that can't tell is refused in words: no impact, clipped, or too coarse to see the contact.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Reals
from ..files.checked_hdf5 import NotDrawable
from .recording import Recording

OVER_NOISE = 8  # an impact stands out of the noise by so many of its standard deviations
WEAKEST = 0.03  # of the hardest impact
FEWEST_IN_CONTACT = 6  # samples; fewer don't tell a stiffness from a damping
FLAT_TOP = 0.15  # of the width of a pulse: what is flat for longer was cut off
BEND_WIDTHS = (100, 200, 500, 1000, 2000)  # of a displacement: the recording over the samples looked at together
REACH = 0.1  # of its peak: where a pulse begins and ends


@dataclass(frozen=True)
class Pulse:
    """Samples from `first` to before `last`, where the signal is beyond REACH of its peak; of the peak itself its index, and
    its height above the offset."""

    first: int
    last: int
    top: int
    height: float


@dataclass(frozen=True)
class Guess:
    """`signs` {signal: +1 or -1} that turn the recorded signals to the model's; offsets in the recorded units, noise as a
    standard deviation; of the first impact the touch and of the hardest one how long it lasts [s]; `flights` [s] between
    impacts; `pulses` of force or acceleration, none of a displacement alone."""

    signs: dict[str, int]
    offsets: dict[str, float]
    noise: dict[str, float]
    touch_time: float
    contact_s: float
    flights: list[float]
    pulses: list[Pulse]


def look(recording: Recording) -> Guess:
    """The Guess from a recording; NotDrawable where it shows no impact that could be measured."""
    signals = recording.signals
    sharp = next((name for name in ("force", "acceleration") if name in signals), None)
    if sharp is None:
        return _from_displacement(recording)
    values = signals[sharp]
    offset, noise = float(np.median(values)), noise_of(values)
    sign = int(np.sign(values[np.argmax(np.abs(values - offset))] - offset)) or 1
    pulses = _pulses(sign * (values - offset), noise)
    if not pulses:
        raise NotDrawable(f"{recording.path} shows no impact: its {sharp} never stands out of the rest by "
                          f"{OVER_NOISE} times the noise")
    hardest = max(pulses, key=lambda pulse: pulse.height)
    _refuse_clipped(recording, sharp, values, hardest)
    _refuse_coarse(recording, sharp, hardest)
    signs = {sharp: sign if sharp == "force" else -sign}  # the stop pushes the hammer back
    if "acceleration" in signals and sharp == "force":
        signs["acceleration"] = _sign_at(signals["acceleration"], hardest, turn=-1)
    if "displacement" in signals:
        signs["displacement"] = _sign_of_displacement(signals["displacement"], hardest)
    first = pulses[0]
    return Guess(signs, {name: float(np.median(values)) for name, values in signals.items()},
                 {name: noise_of(values) for name, values in signals.items()},
                 float(recording.time[first.first] - 0.5 * recording.step),
                 (hardest.last - hardest.first) * recording.step,
                 np.diff([recording.time[pulse.first] for pulse in pulses]).tolist(), pulses)


def noise_of(values: Reals) -> float:
    """Standard deviation of what changes from sample to sample; not of what swings slowly, nor of rare impacts."""
    steps = np.diff(values)
    return float(1.4826 * np.median(np.abs(steps - np.median(steps))) / np.sqrt(2))


def _pulses(values, noise):
    """All Pulses of a signal whose impacts point up."""
    highest = values.max()
    swing = np.quantile(np.abs(values), 0.9)  # what it does between impacts
    limit = max(OVER_NOISE * noise, WEAKEST * highest, 1.5 * swing)
    if not highest > max(limit, 3 * swing):
        return []
    found, begin = [], 0
    while (above := np.flatnonzero(values[begin:] > limit)).size:
        pulse = _pulse_around(values, begin + int(above[0]), begin, 3 * noise)
        found.append(pulse)
        begin = 2 * pulse.last - pulse.first  # its tail is no impact
    return found


def _pulse_around(values, start, begin, floor):
    """Of samples from `begin` on; what lies below the floor belongs to no pulse."""
    last = start + 1
    top = start
    while last < len(values) and values[last] > max(REACH * values[top], floor):
        top = last if values[last] > values[top] else top
        last += 1
    first = start
    while first > begin and values[first - 1] > max(REACH * values[top], floor):
        first -= 1
    return Pulse(first, last, top, float(values[top]))


def _refuse_clipped(recording, name, values, pulse):
    height = values[pulse.top]
    flat = np.abs(values[pulse.first:pulse.last] - height) <= 1e-9 * np.ptp(values)
    at = pulse.top - pulse.first
    run = int(np.argmin(np.append(flat[at:], False))) + int(np.argmin(np.append(flat[at::-1], False))) - 1
    if run >= 3 and run > FLAT_TOP * (pulse.last - pulse.first):
        raise NotDrawable(f"{recording.path} is clipped: its {name} stays at {height:.4g} for {run} samples at the top of the "
                          f"hardest impact, at {recording.time[pulse.top]:.6g} s; record with a larger range")


def _refuse_coarse(recording, name, pulse):
    seen = pulse.last - pulse.first
    if seen < FEWEST_IN_CONTACT:
        enough = 2 * FEWEST_IN_CONTACT / seen / recording.step
        raise NotDrawable(f"{recording.path} is too coarse to see the contact: the hardest impact has {seen} samples in its "
                          f"{name}, and {FEWEST_IN_CONTACT} are needed at least; record at {enough / 1000:.3g} kHz or more")


def _sign_at(values, pulse, turn):
    piece = values[pulse.first:pulse.last] - np.median(values)
    return int(np.sign(piece[np.argmax(np.abs(piece))])) * turn or 1


def _sign_of_displacement(values, pulse):
    """+1 where the hammer comes from below: it goes up before the impact and down after it."""
    around = 20 * (pulse.last - pulse.first)
    middle = values[pulse.first:pulse.last].mean()
    before, after = values[max(0, pulse.first - around):pulse.first], values[pulse.last:pulse.last + around]
    return 1 if middle >= np.mean([piece.mean() for piece in (before, after) if piece.size]) else -1


def _from_displacement(recording):
    """Of a displacement alone: an impact is where its speed turns at once, seen over as many samples as show it best."""
    values = recording.signals["displacement"]
    bends = [_bend(values, max(2, len(values) // share)) for share in BEND_WIDTHS]
    width, bend, limit = max(bends, key=lambda found: np.abs(found[1]).max() / found[2])
    at = int(np.argmax(np.abs(bend)))
    if not abs(bend[at]) > limit:
        raise NotDrawable(f"{recording.path} shows no impact: its displacement never turns back at once")
    sign = -int(np.sign(bend[at]))
    beyond = np.flatnonzero(-sign * bend > max(limit, WEAKEST * abs(bend[at])))
    groups = np.split(beyond, np.flatnonzero(np.diff(beyond) > 2 * width) + 1)
    places = [group[np.argmax(np.abs(bend[group]))] + 1.5 * width for group in groups]
    times = recording.time[0] + np.array(places) * recording.step
    return Guess({"displacement": sign}, {"displacement": float(np.median(values))}, {"displacement": noise_of(values)},
                 float(times[0]), 4 * FEWEST_IN_CONTACT * recording.step, np.diff(times).tolist(), [])


def _bend(values, width):
    """(width, second differences of means over so many samples, above what they count for an impact)."""
    sums = np.concatenate([[0], np.cumsum(values - values.mean())])
    means = (sums[width:] - sums[:-width]) / width
    bend = means[2 * width:] - 2 * means[width:-width] + means[:-2 * width]
    noise = noise_of(values) * np.sqrt(6 / width)
    return width, bend, max(OVER_NOISE * noise, 4 * np.quantile(np.abs(bend), 0.9))
