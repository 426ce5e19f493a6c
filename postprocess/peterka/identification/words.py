"""What came out, in words for a terminal."""

from collections.abc import Sequence

import numpy as np

from .fit import Fit
from .numbers_found import Identified, Number
from .recording import Recording

MUCH_LEFT = 3  # times the noise


def number_text(number: Number) -> str:
    """5.497e+06 ± 1.2e+04 is "5497000 ± 12000"."""
    if not number.error:
        return f"{number.value:.5g}"
    digits = 1 - int(np.floor(np.log10(number.error)))  # two of the error
    if not -12 < digits < 12:
        return f"{number.value:.6g} ± {number.error:.2g}"
    shown = [f"{round(value, digits):.{max(digits, 0)}f}" for value in (number.value, number.error)]
    return " ± ".join(shown)


def result_lines(found: Identified) -> list[str]:
    """Of an Identified."""
    rows = [("stop's stiffness ki", found.stiffness, "N/m"), ("stop's damping ci", found.damping, "Ns/m"),
            ("natural frequency", found.natural_frequency_hz, "Hz"), ("damping ratio ζ", found.damping_ratio, ""),
            ("restitution", found.restitution, ""), ("contact time", _milli(found.contact_s), "ms")]
    return [f"  {name:<20} {_value(number, unit)}" for name, number, unit in rows]


def recording_lines(recording: Recording, fits: Sequence[Fit]) -> list[str]:
    """Of a Recording and its Fits."""
    signals = " and ".join(recording.signals)
    impacts = sum(len(fit.motion.contacts()) for fit in fits)
    lines = [f"{recording.path}: {len(recording.time)} samples of {signals} at {1e-3 / recording.step:.4g} kHz, {impacts} "
             f"impact{'s' * (impacts != 1)}"]
    misfit = max(fit.misfit for fit in fits)
    if misfit > MUCH_LEFT:
        lines.append(f"  in contact {misfit:.2g} times as much is left as elsewhere: the stop is more than a spring and a dashpot, "
                     "or the sensor rings; errors allow for it as far as neighbouring samples show it")
    return lines


def _milli(number):
    return type(number)(1e3 * number.value, None if number.error is None else 1e3 * number.error)


def _value(number, unit):
    if number is None:
        return "not told by what was measured"
    if number.error is None:
        return f"{number.value:.6g} {unit} (given)".replace("  ", " ")
    share = f" ({100 * number.error / abs(number.value):.2g} %)" if number.error and number.error < abs(number.value) else ""
    return f"{number_text(number)} {unit}".rstrip() + share
