"""The identified rig as a TOML file that jobs include by rig = "...": hammer, contact, and the cart if known."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ..files.harmless import harmless
from ..toml import text_of
from .numbers_found import DAMPING, DAMPING_RATIO, FREQUENCY, GAP, STIFFNESS, Identified, Number
from .words import number_text

TOGETHER = 0.3  # correlation: a damping ratio given later would move the other numbers by more than 0.3 of their errors per error of its own
KNOWN_WITHIN = 0.5  # a damping ratio with a larger relative error is not significant


def rig_text(found: Identified, sources: Iterable[str], amplitude_m: float | None = None,
             kept: Mapping[str, Mapping[str, Any]] | None = None) -> str:
    """The file's text for an Identified; `sources`: names of the files it was identified from; `kept`
    {table: {key: value}}: what else a rig has, such as a cubic spring."""
    lines = ["# Found by identify.py from " + harmless(", ".join(sources), 400) + ", with standard errors.", "", "[hammer]",
             f"mass_kg = {float(found.mass)!r}"]
    frequency, ratio, gap = (found.number(key) for key in (FREQUENCY, DAMPING_RATIO, GAP))
    lines += [_line("natural_frequency_hz", frequency, "Hz") if frequency and told(frequency) else
              "# natural_frequency_hz =               what was measured doesn't tell it: give it here"]
    if ratio and (ratio.error is None or ratio.value > 0 and ratio.error <= KNOWN_WITHIN * ratio.value):
        lines += [_line("damping_ratio", ratio, "")]
    else:
        better = f" better than {number_text(ratio)}" if ratio else " it"
        cure = "identify again with --damping-ratio, for the numbers below were found together with it" if (
            correlation_with_damping(found) > TOGETHER) else "give it here"
        lines += [f"# damping_ratio =               what was measured doesn't tell{better}: {cure}"]
    written = {"mass_kg", "natural_frequency_hz", "damping_ratio", "law", "amplitude_m", "stiffness_n_per_m", "damping_ns_per_m"}
    others = {table: [f"{key} = {_text(value)}" for key, value in (kept or {}).get(table, {}).items() if key not in written]
              for table in ("hammer", "cart", "contact")}
    lines += others["hammer"]
    stiffness, damping = found.number(STIFFNESS), found.number(DAMPING)
    assert stiffness is not None and damping is not None  # of any recording with an impact
    lines += ["", *(["[cart]", f"amplitude_m = {float(amplitude_m)!r}", *others["cart"], ""] if amplitude_m else []), "[contact]",
              'law = "kelvin_voigt"', _line("stiffness_n_per_m", stiffness, "N/m"),
              _line("damping_ns_per_m", damping, "Ns/m"), *others["contact"]]
    if gap and gap.error is not None:
        lines += ["", f"# The gap was {number_text(Number(1e3 * gap.value, 1e3 * gap.error))} mm."]
    return "\n".join(lines) + "\n"


def identified_text(found: Identified, sources: Iterable[str]) -> str:
    """The numbers with their covariance in SI units, as read by jobs with uncertain rigs."""
    kept = [key for key in found.values if (number := found.number(key)) and told(number)]
    places = [list(found.values).index(key) for key in kept]
    table = {"of": kept, "mean": [found.values[key] for key in kept], "matrix": found.covariance[np.ix_(places, places)].tolist()}
    return ("# Found by identify.py from " + harmless(", ".join(sources), 400) + ": what was fitted, with its covariance, in SI.\n"
            + text_of({"covariance": table}))


def correlation_with_damping(found: Identified) -> float:
    """The largest correlation of the springs' damping ratio with another number that was fitted; 0 where it wasn't."""
    keys = list(found.values)
    if DAMPING_RATIO not in keys:
        return 0.0
    at, sizes = keys.index(DAMPING_RATIO), np.sqrt(np.diag(found.covariance))
    with np.errstate(invalid="ignore", divide="ignore"):
        correlations = np.nan_to_num(np.delete(found.covariance[at] / (sizes[at] * sizes), at))
    return float(np.abs(correlations).max(initial=0.0))


def told(number: Number) -> bool:
    """Whether a number is known: given, or with an error small enough to be significant."""
    return number.error is None or number.error < 0.5 * abs(number.value) or 0 < number.error < 1e-4


def _text(value: Any) -> str:
    return text_of({"value": value}).removeprefix("value = ").strip()


def _line(key: str, number: Number, unit: str) -> str:
    comment = "  # given" if number.error is None else f"  # {number_text(number)} {unit}".rstrip()
    return f"{key} = {float(f'{number.value:.10g}')!r}{comment}"
