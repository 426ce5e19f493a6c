"""Single impacts: the release test with the cart at rest, the flight after an impact, and the spectrum at the moment of
impact (sections 4, 4.2; Figs. 13, 20, 21)."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..arrays import Reals
from ..traces.trace_file import TraceFile

from ..identification.contact_pulse import identified
from .folder import Folder, read_job
from .record import CLOSED_FORM, RANGE, SHARE, Claim, claim, near, not_computed, percent

RELEASE, STRONGEST = "trace_170mm_release", "trace_170mm_9hz"
LOW_HZ, AXIAL_HZ, ENVELOPE_HZ, PEAKS_HZ = 1000, 7000, 1000, (3000, 6000)  # as printed
SAYS = {
    "fig_13_parameters": ("section 4, Fig. 13, Table 2", "A release with the cart at rest identifies the stop: one impact's "
                          "restitution and duration determine ki and ci."),
    "fig_13_profile": ("section 4, Fig. 13", "The force of the model jumps at first touch, by its damping, as the real one "
                       "doesn't."),
    "fig_20_flight": ("section 4.2, Fig. 20", "In the flight after an impact the hammer has several peaks at low "
                      "frequencies, from bending modes of the beam springs, and one around 7 kHz."),
    "fig_21_envelope": ("section 4.2, Fig. 21", "The envelope of the acceleration at the moment of impact lies in the 1 kHz "
                        "range."),
    "fig_21_peaks": ("section 4.2, Fig. 21", "The spectrum at the moment of impact has a peak of the envelope, and two more "
                     "at around 3 and 6 kHz."),
}
ONE_MODE = "the model's one mass on one spring has one mode, the swing at {hz:.3g} Hz"
FLIGHT = (f"{ONE_MODE}; the low peaks are further bending modes of the beam springs, the one around 7 kHz is the axial mode of the hammer: "
          "one mass has neither")
PULSE = (f"{ONE_MODE}; the peak at 6 kHz is the axial mode of the hammer, which one mass doesn't have. That at 3 kHz belongs to the profile "
         "of the real force, as the paper says: a pulse that begins with a jump falls smoothly")


def claims(folder: Folder) -> list[Claim]:
    """The claims of this group."""
    files = [f"{name}.h5" for name in (RELEASE, STRONGEST)]
    missing = [name for name in files if not (folder.path / name).exists()]
    if missing:
        return [not_computed(key, place, says, missing[0]) for key, (place, says) in SAYS.items()]
    release, strongest = (Strike(folder.path / name) for name in files)
    return [_parameters(release), _profile(release), _flight(release), _envelope(strongest), _peaks(strongest)]


class Strike:
    """The hardest impact of a trace: spectra of its force and of the flight after it over `frequency` [Hz]."""

    def __init__(self, path: Path) -> None:
        with TraceFile(path) as file:
            if file.impact_spectrum is None or file.impact is None or file.impacts is None or file.newtons is None:
                raise file.refusal("shows no impact with the flight after it, or tells no mass")
            hardest = {name: float(values[file.impact.number]) for name, values in file.impacts.items()}
            if not min(hardest["contact_time"], hardest["impact_speed"]) > 0:
                raise file.refusal("has an impact without speed or time of contact")
            job = read_job(file)
            hammer, contact = job["hammer"], job["contact"]
            self.stiffness, self.damping = contact["stiffness_n_per_m"], contact["damping_ns_per_m"]
            self.mass, self.natural_hz = hammer["mass_kg"], hammer["natural_frequency_hz"]
            self.speed, self.contact_s = hardest["impact_speed"], hardest["contact_time"]
            self.restitution = hardest["impulse"] / (self.mass * self.speed) - 1
            if not 0 < self.restitution < 2:  # well outside what rounding could make of 1
                raise file.refusal(f"has an impact with a restitution of {self.restitution:.3g}")
            self.peak_n = hardest["peak_force_ratio"] * file.newtons
            self.touch_n = hardest["touch_force_ratio"] * file.newtons
            self.frequency, self.force, self.flight = file.impact_spectrum.values()


def peaks(frequency: Reals, spectrum: Reals, least: float) -> list[float]:
    """Frequencies of the interior maxima of a spectrum that reach a given share of its largest value."""
    inner = spectrum[1:-1]
    found = (inner > spectrum[:-2]) & (inner >= spectrum[2:]) & (inner >= least * spectrum.max())
    result: list[float] = frequency[1:-1][found].tolist()
    return result


def _claim(key: str, computed: str, holds: bool, difference: str = "", why: str = "", pictures: Sequence[str] = ()) -> Claim:
    return claim(key, *SAYS[key], computed, holds, difference, why, pictures)


def _parameters(strike: Strike) -> Claim:
    stiffness, damping = identified(strike.mass, strike.restitution, strike.contact_s)
    return _claim(
        "fig_13_parameters",
        f"from a restitution of {strike.restitution:.4g} and {1e3 * strike.contact_s:.4g} ms of contact, of an impact at "
        f"{strike.speed:.4g} m/s, a closed form returns ki = {stiffness:.4g} N/m and ci = {damping:.4g} Ns/m. The impact was "
        f"computed with {strike.stiffness:.4g} and {strike.damping:.4g}: these could differ only if the program were wrong. The "
        "printed values themselves are not tested, as the paper prints neither how far the hammer was drawn back nor the "
        "measured curve as numbers",
        near(stiffness, strike.stiffness, CLOSED_FORM) and near(damping, strike.damping, CLOSED_FORM),
        f"ki {100 * (stiffness / strike.stiffness - 1):+.1g} %, ci {100 * (damping / strike.damping - 1):+.1g} %", "",
        [f"{RELEASE}_impact", f"{RELEASE}_motion"])


def _profile(strike: Strike) -> Claim:
    return _claim("fig_13_profile", f"the force jumps to {strike.touch_n:.4g} N at first touch, "
                  f"{100 * strike.touch_n / strike.peak_n:.3g} % of its peak of {strike.peak_n:.4g} N; of the real one the "
                  "paper prints no numbers", strike.touch_n > SHARE * strike.peak_n)


def _flight(strike: Strike) -> Claim:
    found = peaks(strike.frequency, strike.flight, SHARE)
    low, axial = [hertz for hertz in found if hertz < LOW_HZ], [hertz for hertz in found if near(hertz, AXIAL_HZ)]
    largest, step = int(np.argmax(strike.flight)), strike.frequency[1] - strike.frequency[0]
    place = (f"at the first line (steps of {step:.3g} Hz): the swing of the only mode, at {strike.natural_hz:.3g} Hz"
             if largest == 0 else f"at {strike.frequency[largest]:.0f} Hz (steps of {step:.3g} Hz)")
    return _claim(
        "fig_20_flight", f"the largest value lies {place}; {_reach(found, 'no other peak')} {percent(SHARE)} of it. Below "
        f"{LOW_HZ} Hz counts as low",
        len(low) > 1 and len(axial) == 1, "", FLIGHT.format(hz=strike.natural_hz), [f"{RELEASE}_spectrum"])


def _envelope(strike: Strike) -> Claim:
    half_wave = 0.5 / strike.contact_s
    return _claim(
        "fig_21_envelope", f"contact lasts {1e3 * strike.contact_s:.3g} ms, which is a half wave of {half_wave:.0f} Hz; "
        f"{(1 - RANGE) * ENVELOPE_HZ:.0f} to {(1 + RANGE) * ENVELOPE_HZ:.0f} Hz count as that range",
        _is_envelope(half_wave), "", "", [f"{STRONGEST}_spectrum"])


def _peaks(strike: Strike) -> Claim:
    found = peaks(strike.frequency, strike.force, SHARE)
    low = np.flatnonzero(strike.force < strike.force[0] / 2)
    falls = f"falls to half of its value at 0 Hz at {strike.frequency[low[0]]:.0f} Hz" if len(low) else (
        "never falls to half of its value at 0 Hz")
    return _claim("fig_21_peaks", f"{_reach(found, 'no peak')} {percent(SHARE)} of the largest value of the force's spectrum, "
                  f"which {falls}", any(map(_is_envelope, found))
                  and all(any(near(hertz, printed) for hertz in found) for printed in PEAKS_HZ), "",
                  PULSE.format(hz=strike.natural_hz))


def _is_envelope(hertz: float) -> bool:
    """Whether a frequency lies in the 1 kHz range."""
    return near(hertz, ENVELOPE_HZ, RANGE)


def _reach(found: Sequence[float], none: str) -> str:
    """The subject and verb of a sentence on how far the found peaks reach."""
    listed = ", ".join(f"{hertz:.0f}" for hertz in found)
    if len(found) > 1:
        return f"peaks at {listed} Hz reach"
    return f"a peak at {listed} Hz reaches" if found else f"{none} reaches"
