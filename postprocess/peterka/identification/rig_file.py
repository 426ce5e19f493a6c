"""The rig that was found, as a TOML file that jobs name by rig = "...": hammer, contact, and the cart where it is told."""

from collections.abc import Iterable

from ..files.harmless import harmless
from .numbers_found import Identified
from .words import number_text

KNOWN_WITHIN = 0.5  # a damping ratio with a larger relative error would be chance


def rig_text(found: Identified, sources: Iterable[str], amplitude_m: float | None = None) -> str:
    """Of an Identified; `sources`: the names of what it was found from."""
    lines = ["# Found by identify.py from " + harmless(", ".join(sources), 400) + ", with standard errors.", "", "[hammer]",
             f"mass_kg = {found.mass!r}"]
    frequency, ratio = found.natural_frequency_hz, found.damping_ratio
    lines += [_line("natural_frequency_hz", frequency, "Hz") if frequency else
              "# natural_frequency_hz =               what was measured doesn't tell it: give it here"]
    if ratio and (ratio.error is None or 0 < ratio.error <= KNOWN_WITHIN * ratio.value):
        lines += [_line("damping_ratio", ratio, "")]
    else:
        told = f" better than {number_text(ratio)}" if ratio else " it"
        lines += [f"# damping_ratio =               what was measured doesn't tell{told}: give it here"]
    lines += ["", *(["[cart]", f"amplitude_m = {amplitude_m!r}", ""] if amplitude_m else []), "[contact]",
              'law = "kelvin_voigt"', _line("stiffness_n_per_m", found.stiffness, "N/m"),
              _line("damping_ns_per_m", found.damping, "Ns/m")]
    return "\n".join(lines) + "\n"


def _line(key, number, unit):
    comment = "  # given" if number.error is None else f"  # {number_text(number)} {unit}".rstrip()
    return f"{key} = {float(f'{number.value:.10g}')!r}{comment}"
