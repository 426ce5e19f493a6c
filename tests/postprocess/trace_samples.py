"""Small trace files in layout version 3, written without peterka: a hammer with one impact per cycle at 9 Hz."""

import numpy as np
from sealing import SealedFile

HZ, AMPLITUDE, MASS = 9.0, 0.89e-3, 0.298
WEIGHT = MASS * 9.80665
CONTACT = 1e-3  # s
PEAK, JUMP = 80.0, 40.0  # F/(mg)
TOUCH = 0.02  # s, in each cycle


def write_trace(path, cycles=3, impacts=True, samples=200, rigid=False, **attributes):
    """Force: from JUMP at touch up to PEAK after a third of the contact, and down; none where the stop is rigid."""
    time = np.arange(cycles * samples + 1) / (samples * HZ)
    with SealedFile(path, "w") as file:
        file.attrs.update({"peterka_layout": np.int32(3), "peterka_kind": "trace", "title": "A trace",
                           "natural_frequency_hz": 4.5, "cart_amplitude_m": AMPLITUDE, "hammer_mass_kg": MASS,
                           "frequency_ratio": 2.0, "gap_ratio": 0.0} | attributes)
        _write_motion(file, time, impacts and not rigid)
        _write(file, "spectrum", frequency=np.arange(50) * HZ, force_amplitude=1 / (1 + np.arange(50.0)),
               acceleration_amplitude=10 / (1 + np.arange(50.0)))
        if not impacts:
            return path
        touches = TOUCH + np.arange(cycles) / HZ
        jump, peak, contact = (np.nan, np.nan, 0.0) if rigid else (JUMP, PEAK, CONTACT)
        _write(file, "impacts", touch_time=touches, impact_speed=np.full(cycles, 0.3),
               touch_force_ratio=np.full(cycles, jump), peak_force_ratio=np.full(cycles, peak),
               impulse=np.full(cycles, 0.1), contact_time=np.full(cycles, contact), work=np.full(cycles, 0.01))
        close = TOUCH + np.linspace(-CONTACT, 2 * CONTACT, 301)
        _write_motion(file.create_group("impact"), close, not rigid)
        _write(file, "impact", time_from_touch=close - TOUCH, impact=np.int32(0))
        if rigid:
            return path
        _write(file, "impact", peak_time=TOUCH + CONTACT / 3, peak_force_ratio=PEAK)
        _write(file, "impact_spectrum", frequency=np.arange(50) * 100.0, force_spectrum=1 / (1 + np.arange(50.0)),
               flight_acceleration_amplitude=1 / (1 + np.arange(50.0)))
    return path


def _write_motion(group, time, impacts):
    angle = 2 * np.pi * HZ * time
    since = np.mod(time - TOUCH + 1e-12, 1 / HZ)
    pressed = impacts & (since < CONTACT)
    force = np.where(pressed, np.interp(since, [0, CONTACT / 3, CONTACT], [JUMP, PEAK, 0]), 0)
    hammer, cart = -2 + np.cos(angle), np.sin(angle)
    for name, values in {
        "time": time, "cycle": time * HZ, "hammer_displacement_ratio": hammer, "cart_displacement_ratio": cart,
        "relative_displacement_ratio": hammer - cart, "hammer_velocity": -0.05 * np.sin(angle),
        "cart_velocity": 0.05 * np.cos(angle), "relative_velocity": -0.05 * np.sin(angle) - 0.05 * np.cos(angle),
        "hammer_acceleration": -3 * np.cos(angle) - 9.80665 * force, "force_ratio": force,
    }.items():
        group[name] = values


def _write(file, group, **values):
    for name, value in values.items():
        file.require_group(group)[name] = value
