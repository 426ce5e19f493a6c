"""Frequency bands and forces at gap 0, beam springs 170 mm (section 3.1, Figs. 4-9, 14)."""

import numpy as np

from ..errors import PeterkaFileError
from . import exact_limits
from .folder import Folder, Plane
from .record import FREQUENCY, Claim, claim, near, not_computed, off_by
from .spans import span_around, widest

FILE = "gaps_170mm"  # a map of few gaps, 0 first, with finely spaced frequencies
PLACE = "section 3.1"
BAND_ONE, BAND_HALF = (4.00, 11.50), (12.0, 16.0)  # Hz, as printed
PEAK_N, PEAK_HZ, ALTERNATING_HZ, HALF_HZ = 204.0, 9.00, 12.25, 15.25
SAYS = {
    "first_band": "At gap 0 one impact comes in each cycle, z = 1/1, from 4.00 to 11.50 Hz.",
    "alternating": "At 12.25 Hz one impact comes in each cycle, but strong and weak ones alternate.",
    "second_band": "From 12 to 16 Hz one impact comes in two cycles, z = 1/2.",
    "half": "At 15.25 Hz z = 1/2.",
    "peak_force": "The largest force of the band z = 1/1 is 204 N, at 9.00 Hz.",
    "peak_frequency": "The impact resonance of the band z = 1/1 lies at 9.00 Hz.",
    "half_is_stronger": "Forces in the band z = 1/2 exceed those in the band z = 1/1.",
}
# The number of N with bending modes: tests/endurance/bending_modes.py.
SOFTER_STOP = ("a stop of half the stiffness would give it, as would a smaller amplitude of the cart; other damping, of the stop or of the hammer, "
               "would not (see the sensitivity below). Energy lost to bending modes explains a third at most: with three modes of two steel "
               "beams, clamped at the cart and guided by the hammer, another integrator finds 225 N")


def claims(folder: Folder) -> list[Claim]:
    """The claims of this group."""
    plane = folder.plane(FILE)
    if plane is None:
        return [not_computed(f"gap_0_{key}", PLACE, says, f"{FILE}.h5") for key, says in SAYS.items()]
    if plane.row_at(0) != 0:
        raise PeterkaFileError(f"{plane.path} has gaps below 0; a map of this name is to begin at 0")
    return [*_bands(folder, plane), *_labels(plane), *_forces(plane)]


def limits_hz(plane: Plane, impacts: int, period: int, inside_hz: float | None = None,
              row: int = 0) -> tuple[float, float] | None:
    """(from, to) of a band of this z at a gap: the band containing a given frequency, else the widest; None without one.

    Limits lie half-way to the next column."""
    mask = plane.is_orbit(impacts, period)[row]
    span = widest(mask) if inside_hz is None else span_around(mask, plane.column_at_hz(inside_hz))
    if span is None:
        return None
    frequency, step = plane.frequency_hz, (plane.frequency_hz[1] - plane.frequency_hz[0]) / 2
    return max(frequency[span[0]] - step, frequency[0]), min(frequency[span[1]] + step, frequency[-1])


def at_edge(plane: Plane, found: tuple[float, float]) -> tuple[bool, bool]:
    """Whether each of the two limits is the edge of the map: the band then continues, and the limit cannot be compared."""
    return found[0] <= plane.frequency_hz[0], found[1] >= plane.frequency_hz[-1]


def in_words(plane: Plane, found: tuple[float, float]) -> str:
    """"from 4.01 to 11.50 Hz", noting where the map ends before the band does."""
    first, last = at_edge(plane, found)
    begins = f"from below {found[0]:.2f}" if first else f"from {found[0]:.2f}"
    return f"{begins} to beyond {found[1]:.2f} Hz, where the map ends" if last else f"{begins} to {found[1]:.2f} Hz"


def force_at(plane: Plane, frequency_hz: float, row: int = 0) -> float:
    """Force [N] in this row, interpolated in frequency. Raises PeterkaFileError where the map doesn't reach it."""
    plane.column_at_hz(frequency_hz)
    return float(np.interp(frequency_hz, plane.frequency_hz, plane.force_n[row]))


def resonance(plane: Plane, impacts: int, period: int, row: int = 0) -> tuple[float, float] | None:
    """(frequency [Hz], force [N]) of the largest force in the widest band of a z at a gap; None without a band."""
    span = widest(plane.is_orbit(impacts, period)[row])
    if span is None:
        return None
    column = span[0] + int(np.argmax(plane.force_n[row, span[0]:span[1] + 1]))
    return float(plane.frequency_hz[column]), float(plane.force_n[row, column])


def label(plane: Plane, frequency_hz: float, row: int = 0) -> str:
    """The regime of the cell nearest to a frequency: its z, or its regime in words."""
    column = plane.column_at_hz(frequency_hz)
    if plane.quiet[row, column]:
        return "no impact"
    if not plane.strikes[row, column]:
        return "sustained contact or undecided"
    p, q = int(plane.impacts[row, column]), int(plane.period[row, column])
    return f"{p}/{q}" if q else "chaotic"


def _bands(folder: Folder, plane: Plane) -> list[Claim]:
    below = ("the model counts every touch: at lower frequencies the hammer follows the cart and each cycle has small "
             "hops after the main impact (z = p/1, p growing as the frequency falls), which a sensor that is triggered "
             "by the main impact shows as one; the cycle still repeats")
    return [
        _band(folder, "first_band", plane, (1, 1), BAND_ONE, PEAK_HZ,
              f"{below}. The upper limit is a period doubling that no parameter moves far (see the sensitivity below), and "
              f"lies in the paper's own transition, which it leaves open between {BAND_ONE[1]:.2f} and {BAND_HALF[0]:.2f} "
              "Hz"),
        _band(folder, "second_band", plane, (1, 2), BAND_HALF, HALF_HZ,
              "between both bands the model has alternating impacts, chaos and windows of 3/2 and 2/2; the paper, too, shows "
              f"alternating impacts at {ALTERNATING_HZ} Hz, inside this band, and calls them transitory. Its upper limit is "
              "likely where the measurements end"),
    ]


def _band(folder: Folder, key: str, plane: Plane, z: tuple[int, int], printed: tuple[float, float], inside_hz: float, why: str) -> Claim:
    found = limits_hz(plane, *z, inside_hz)
    if found is None:
        return claim(f"gap_0_{key}", PLACE, SAYS[key], f"z = {label(plane, inside_hz)} at {inside_hz} Hz", False)
    exact = exact_limits.limits(folder, plane, found, z)
    known = [f"{name} {limit.text}" for name, limit in zip(("lower", "upper"), exact) if limit.kind]
    by_curves = f"; by the curves the {' and the '.join(known)}" if known else ""
    holds, differences = True, []
    computed = [limit.hz for limit in exact]
    for name, value, limit, is_edge, outward in zip(("lower", "upper"), computed, printed, at_edge(plane, found), (-1, 1)):
        if is_edge:  # a lower bound on the distance, if the edge lies beyond the printed limit
            beyond = outward * (value - limit)
            holds = False
            differences.append(f"{name} limit {'below' if outward < 0 else 'above'} {value:.2f} Hz, where the map ends"
                               + (f": off by more than {beyond:.3g} Hz" if beyond > 0 else ": not to be told"))
        else:
            holds &= bool(abs(value - limit) <= FREQUENCY)
            differences.append(f"{name} limit {off_by(value, limit, 'Hz')}")
    return claim(
        f"gap_0_{key}", f"{PLACE}, Fig. 9a", SAYS[key],
        f"z = {z[0]}/{z[1]} {in_words(plane, found)}{by_curves}; at {printed[0]:.2f} Hz z = "
        f"{label(plane, printed[0])}, at {printed[1]:.2f} Hz {label(plane, printed[1])}",
        holds, "; ".join(differences), why, ["peterka_170mm_map"])


def _labels(plane: Plane) -> list[Claim]:
    out = []
    for key, frequency, expected, figure, trace in (("alternating", ALTERNATING_HZ, "2/2", "Fig. 6", "12hz"),
                                                    ("half", HALF_HZ, "1/2", "Figs. 7, 8", "15hz")):
        found = label(plane, frequency)
        p, q = (int(number) for number in expected.split("/"))
        band = limits_hz(plane, p, q, frequency)
        around = f", as {in_words(plane, band)}" if band else ""
        out.append(claim(f"gap_0_{key}", f"{PLACE}, {figure}", SAYS[key], f"z = {found} at {frequency} Hz{around}",
                         found == expected, "", "", [f"trace_170mm_{trace}_motion"]))
    return out


def _forces(plane: Plane) -> list[Claim]:
    force, one, two = force_at(plane, PEAK_HZ), resonance(plane, 1, 1), resonance(plane, 1, 2)
    if one is None or two is None:
        return [claim(f"gap_0_{key}", PLACE, SAYS[key], f"no z = 1/{1 if one is None else 2} at gap 0", False)
                for key in ("peak_force", "peak_frequency", "half_is_stronger")]
    (frequency, largest), (highest_hz, highest) = one, two
    inside = np.where(plane.frequency_hz <= BAND_HALF[1], plane.force_n[0], 0)
    half = float(np.max(inside[plane.is_orbit(1, 2)[0]], initial=0))
    exceed = (f"exceed those of z = 1/1 only at higher frequencies: {highest:.4g} N at" if highest > largest else
              f"nowhere exceed those of z = 1/1: at most {highest:.4g} N, at")
    return [
        claim("gap_0_peak_force", f"{PLACE}, Figs. 4, 5, 9a", SAYS["peak_force"], f"{force:.4g} N at {PEAK_HZ:.2f} Hz",
              near(force, PEAK_N), off_by(force, PEAK_N, "N"), SOFTER_STOP,
              ["peterka_170mm_force_1_1", "trace_170mm_9hz_motion", "trace_170mm_9hz_impact"]),
        claim("gap_0_peak_frequency", f"{PLACE}, Fig. 9a", SAYS["peak_frequency"],
              f"{frequency:.2f} Hz (Ω/ω = {frequency / plane.natural_frequency_hz:.3f}), {largest:.4g} N",
              abs(frequency - PEAK_HZ) <= FREQUENCY, off_by(frequency, PEAK_HZ, "Hz")),
        claim("gap_0_half_is_stronger", f"{PLACE}, Fig. 9a", SAYS["half_is_stronger"],
              f"up to {BAND_HALF[1]:g} Hz {half:.4g} N with z = 1/2, against {largest:.4g} N with z = 1/1", half > largest,
              f"{half / largest:.3f} times", f"in the model the forces of z = 1/2 {exceed} {highest_hz:.2f} Hz"),
    ]
