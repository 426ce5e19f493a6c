"""The results in words, for a terminal."""

import numpy as np

from .channels import SURE, reference
from .fit import Fit
from .flights_alone import contact_samples
from .numbers_found import DAMPING, DAMPING_RATIO, FREQUENCY, GAP, STIFFNESS, Identified, Number
from .one_mode import share_words
from .recording import Recording

MUCH_LEFT = 3  # multiple of the noise
UNITS = {"force": (1.0, "N"), "acceleration": (1.0, "m/s²"), "displacement": (1e3, "mm")}


def number_text(number: Number) -> str:
    """5.497e+06 ± 1.2e+04 becomes "5497000 ± 12000"."""
    if not number.error:
        return f"{number.value:.5g}"
    digits = 1 - int(np.floor(np.log10(number.error)))  # two significant digits of the error
    if not -12 < digits < 12:
        return f"{number.value:.6g} ± {number.error:.2g}"
    shown = [f"{round(value, digits):.{max(digits, 0)}f}" for value in (number.value, number.error)]
    return " ± ".join(shown)


ROWS = (("stop's stiffness ki", STIFFNESS, 1.0, "N/m"), ("stop's damping ci", DAMPING, 1.0, "Ns/m"),
        ("natural frequency", FREQUENCY, 1.0, "Hz"), ("damping ratio ζ", DAMPING_RATIO, 1.0, ""), ("gap", GAP, 1e3, "mm"))
STRONG = 0.5  # correlations at least this large are reported


def result_lines(found: Identified) -> list[str]:
    """Describes an Identified."""
    restitution, contact_s = found.impact()
    rows = [(name, _scaled(found.number(key), factor), unit) for name, key, factor, unit in ROWS]
    rows += [("restitution", restitution, ""), ("contact time", _scaled(contact_s, 1e3), "ms")]
    lines = [f"  {name:<20} {_value(number, unit)}" for name, number, unit in rows]
    names = {STIFFNESS: "ki", DAMPING: "ci", FREQUENCY: "natural frequency", DAMPING_RATIO: "ζ", GAP: "gap"}
    keys = list(found.values)
    pairs = [(one, other, found.correlation(one, other)) for at, one in enumerate(keys) for other in keys[at + 1:]]
    strong = [f"{names[one]} and {names[other]} {value:+.2f}" for one, other, value in pairs if abs(value) >= STRONG]
    return lines + ([f"  correlations         {', '.join(strong)}"] if strong else [])


def recording_lines(fit: Fit) -> list[str]:
    """Describes a Fit."""
    recording, impacts = fit.recording, len(fit.impacts)
    signals = " and ".join(recording.signals)
    lines = [f"{recording.path}: {recording.count} samples of {signals} at {1e-3 / recording.step:.4g} kHz, {impacts} "
             f"impact{'s' * (impacts != 1)}" + _missing(recording)]
    lines += [f"  {reason}" for reason in (*fit.unused, *channel_lines(fit), *fit.doubts)]
    if fit.solved.problem.unseen:
        lines.append(f"  contacts last for about {contact_samples(fit.solved):.2g} samples, which a logger's filter changes: they aren't used, and "
                     "the flights tell the contact time")
    if fit.share is not None:
        lines.append(f"  {share_words(fit.share)}")
    if fit.misfit > MUCH_LEFT:
        lines.append(f"  in contact {fit.misfit:.2g} times as much is left as elsewhere: the stop is more than a spring and a dashpot, "
                     "or the sensor rings; errors allow for it as far as neighbouring samples show it")
    return lines


def channel_lines(fit: Fit) -> list[str]:
    """The errors of channels that a Fit has found."""
    found, problem, lines = fit.solved, fit.solved.problem, []
    for name in problem.names:
        (factor, unit), late, error = UNITS[name.removeprefix("cart_")], problem.delay(found.value, name), problem.step * fit.error(f"delay_{name}")
        if abs(late) > SURE * error > 0:
            lines.append(f"{name} comes {1e3 * abs(late):.4g} ± {1e3 * error:.2g} ms {'later' if late > 0 else 'earlier'} than {reference(problem)}")
        if f"drift_{name}" in problem.channels:
            lines.append(f"{name} drifts by {factor * problem.ranges[name] * found.value[f'drift_{name}']:.3g} {unit} over the recording")
        if f"hum_cos_{name}" in problem.channels:
            size = factor * problem.ranges[name] * np.hypot(found.value[f"hum_cos_{name}"], found.value[f"hum_sin_{name}"])
            lines.append(f"{name} hums with the mains, {problem.mains:.0f} Hz, with an amplitude of {size:.3g} {unit}")
    return [f"{line}: fitted, too" for line in lines]


def _missing(recording: Recording) -> str:
    missing = recording.missing
    if not missing:
        return ""
    count, longest, begin = recording.gaps()
    if count == 1:
        return f"; {missing} samples are missing, from {begin:.6g} s on for {number_in_ms(longest)}"
    return f"; {missing} samples are missing in {count} places, most of them from {begin:.6g} s on, for {number_in_ms(longest)}"


def number_in_ms(seconds: float) -> str:
    """0.0123 s becomes "12.3 ms"."""
    return f"{1e3 * seconds:.4g} ms"


def _scaled(number: Number | None, factor: float) -> Number | None:
    return number and Number(factor * number.value, None if number.error is None else factor * number.error)


def _value(number: Number | None, unit: str) -> str:
    if number is None:
        return "not told by what was measured"
    if number.error is None:
        return f"{number.value:.6g} {unit} (given)".replace("  ", " ")
    share = f" ({100 * number.error / abs(number.value):.2g} %)" if number.error and number.error < abs(number.value) else ""
    return f"{number_text(number)} {unit}".rstrip() + share
