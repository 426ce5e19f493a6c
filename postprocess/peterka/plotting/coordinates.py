"""What axes are called: the words and units of everything over which a map or a sweep may run, and places on them in words."""

import re
from collections.abc import Callable
from typing import Protocol

from ..files.coordinates import TWINS, Measured, Named, Scales, leads_in_si, measured
from . import style

LABELS = {
    "frequency_ratio": r"$\Omega/\omega$",
    "gap_ratio": r"$\mathrm{gap}/A_0$",
    "displacement_ratio": r"$x/A_0$",
    "velocity_ratio": r"$\dot{x}/(A_0\omega)$",
    "frequency_hz": "excitation frequency (Hz)",
    "gap_m": "gap (m)",
    "displacement_m": "$x$ (m)",
    "velocity_m_per_s": r"$\dot{x}$ (m/s)",
    "start_displacement_m": "start $x$ (m)",
    "start_velocity_m_per_s": r"$\dot{x}$ (m/s)",
    "start_displacement_ratio": r"start $x/A_0$",
    "start_velocity_ratio": r"start $\dot{x}/(A_0\omega)$",
    "cart_amplitude_m": "cart amplitude $A_0$ (m)",
    "hammer_mass_kg": "hammer mass $m$ (kg)",
    "hammer_natural_frequency_hz": "natural frequency (Hz)",
    "hammer_stiffness_n_per_m": "spring stiffness $k$ (N/m)",
    "hammer_damping_ns_per_m": "spring damping $c$ (N s/m)",
    "hammer_damping_ratio": r"damping ratio $\zeta$",
    "hammer_cubic_stiffness_n_per_m3": "cubic stiffness $k_3$ (N/m³)",
    "contact_stiffness_n_per_m": "stop stiffness $k_i$ (N/m)",
    "contact_damping_ns_per_m": "stop damping $c_i$ (N s/m)",
    "contact_coefficient": "coefficient of restitution $r$",
    "contact_stiffness_n_per_m_pow_n": r"stop stiffness $K$ (N/m$^n$)",
    "contact_exponent": "exponent $n$ of the stop",
    "contact_dissipation_s_per_m": "dissipation $D$ of the stop (s/m)",
}

# Shown in mm whatever the units of other scales: jobs give them in m.
IN_MILLIMETRES = {"gap_m": "gap (mm)", "cart_amplitude_m": "cart amplitude $A_0$ (mm)", "displacement_m": "$x$ (mm)",
                  "start_displacement_m": "start $x$ (mm)"}


def label(name: str) -> str:
    """The label; an unknown name is used itself, without characters that a picture would interpret as mathematics."""
    return LABELS.get(name) or name.replace("$", "").replace("\\", "")


def without_symbol(words: str) -> str:
    """A label without its symbol: "stop damping (N s/m)"."""
    return re.sub(r" ?\$[^$]*\$", "", words)


def spoken(file: Scales, name: str) -> Measured | None:
    """How a coordinate is told in the units that are asked for; None where it is told by its name in the file, as it is shown."""
    return None if name in TWINS and style.current().units == "ratio" else measured(file, name)


def in_words(file: Scales, axis: Named, value: float, digits: int = 5) -> str:
    """A place on an axis: "frequency 9 Hz (frequency_ratio 2)" where the job has it in Hz, "frequency_ratio 2 (9 Hz)" where as a
    ratio, or one of both alone where these units are asked for."""
    return _in_words(file, axis, lambda factor: f"{value * factor:.{digits}g}")


def span_in_words(file: Scales, axis: Named, low: float, high: float, digits: int = 6) -> str:
    """The same of a stretch of an axis: "frequency 4 to 14 Hz (frequency_ratio 0.9 to 3.1)"."""
    return _in_words(file, axis, lambda factor: f"{low * factor:.{digits}g} to {high * factor:.{digits}g}")


def _in_words(file: Scales, axis: Named, numbers: Callable[[float], str]) -> str:
    own, unit = f"{axis.name} {numbers(1.0)}", spoken(file, axis.name)
    if unit is None:
        return own
    told = f"{numbers(unit.factor)} {unit.unit}"
    if axis.name not in TWINS or style.current().units != "both":
        return f"{unit.what} {told}"
    return f"{unit.what} {told} ({own})" if leads_in_si(axis.stored) else f"{own} ({told})"


class OfJob(Protocol):
    """A file with the coordinates that its job gives in SI units."""

    @property
    def given_in_si(self) -> frozenset[str]: ...


def either(file: OfJob, in_si: str, ratio: str, joined: str = "{} ({})") -> str:
    """A number in SI units, empty where the file doesn't tell, and as a ratio: both, that of the job's axes first, or the one of
    the units that are asked for."""
    units = style.current().units
    if not in_si or units == "ratio":
        return ratio
    return in_si if units == "si" else joined.format(*((in_si, ratio) if file.given_in_si else (ratio, in_si)))


def called(file: Scales, axis: Named) -> str:
    """What an axis runs over, in a word: "frequency", "gap", or its name."""
    unit = spoken(file, axis.name)
    return unit.what if unit else axis.name
