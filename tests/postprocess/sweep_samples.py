"""A small sweep's file in layout version 3, written without peterka: up and down at two gaps.

At gap 0 only z = 1/1, force 20 to 40, its largest at 2.0. At 1.5 z = 1/1 up to a jump to no impact after 1.75 going up and,
from above, before 1.5 going down; then chaos at the two last points.
"""

import numpy as np
from sealing import SealedFile

POINTS = 13
FREQUENCY = np.linspace(1.0, 2.5, POINTS)  # steps of 1/8
SAMPLES = 4
GAPS = (0.0, 1.5)
NO_IMPACT, PERIODIC, CHAOTIC = 0, 1, 2
WEIGHT = 0.298 * 9.80665  # N


def force_of(gap, direction):
    if gap == 0:
        return 40 - 20 * np.abs(FREQUENCY - 2.0)
    last = 1.75 if direction == 0 else 1.5
    return np.where(FREQUENCY <= last, 30 + 40 * (FREQUENCY - 1), np.where(FREQUENCY >= 2.375, 25.0, 0.0))


def regime_of(gap, force):
    if gap == 0:
        return np.full(POINTS, PERIODIC)
    return np.where(force == 25, CHAOTIC, np.where(force > 0, PERIODIC, NO_IMPACT))


def write_sweep(path, gaps=GAPS, directions=(0, 1), **attributes):
    """directions: 0 up, 1 down, 2 independent."""
    branches = [(gap, direction) for gap in gaps for direction in directions]
    force = np.array([force_of(*branch) for branch in branches])
    regime = np.array([regime_of(gap, values) for (gap, _), values in zip(branches, force)])
    periodic = (regime == PERIODIC).astype("i4")
    jump = np.zeros_like(regime)
    for row, (gap, direction) in enumerate(branches):
        if gap:
            edge = int(np.flatnonzero(regime[row] == NO_IMPACT)[0])
            jump[row, edge - 1 if direction == 1 else edge] = 1
    shape = (*force.shape, SAMPLES)
    stroboscopic, impact = np.full(shape, np.nan), np.full(shape, np.nan)
    stroboscopic[..., 0] = -force / 10
    stroboscopic[regime == CHAOTIC, :] = [-1, -2, -3, -4]
    impact[regime != NO_IMPACT, 0] = 0.5
    with SealedFile(path, "w") as file:
        file.attrs.update({"title": "Sample", "peterka_layout": np.int32(3), "peterka_kind": "sweep",
                           "natural_frequency_hz": 4.5, "cart_amplitude_m": 0.89e-3, "hammer_mass_kg": 0.298} | attributes)
        file["frequency_ratio"] = FREQUENCY
        file["gap_ratio"] = np.array([gap for gap, _ in branches], dtype="f8")
        file["direction"] = np.array([direction for _, direction in branches], dtype="i1")
        file["sample"] = np.arange(SAMPLES, dtype="i4")
        file["regime"], file["jump"] = regime.astype("i1"), jump.astype("i1")
        file["impacts"], file["period"] = periodic, np.where(regime == NO_IMPACT, 1, periodic).astype("i4")
        file["peak_force_ratio"] = force
        file["stroboscopic_displacement"], file["impact_displacement"] = stroboscopic, impact
    return path


def write_sweep_with_starts(path):
    """The same with two attractors stored: at 1.5 another one of force 70, at the first six points."""
    write_sweep(path)
    with SealedFile(path, "r+") as file:
        force = file["peak_force_ratio"][()]
        other = np.full(force.shape, np.nan)
        other[2:, :6] = 70
        share = np.where(np.isfinite(other), 0.25, 0)
        file["attractor"] = np.arange(2, dtype="i4")
        file["basin_share"] = np.stack([1 - share, share])
        file["attractor_peak_force_ratio"] = np.stack([force, other])
        found = np.stack([np.ones(force.shape, dtype=bool), np.isfinite(other)])
        file["attractor_regime"] = np.where(found, [file["regime"][()], np.full(force.shape, PERIODIC)], -128).astype("i1")
        for name in ("impacts", "period"):
            file[f"attractor_{name}"] = np.where(found, [file[name][()], np.ones(force.shape)], 0).astype("i4")
        file["start_attractor"] = np.zeros(force.shape, dtype="i4")
        samples = file["stroboscopic_displacement"][()]
        samples[2:, :6, 1] = -9
        file["attractor_stroboscopic_displacement"] = samples
        file["attractor_impact_displacement"] = file["impact_displacement"][()]
    return path
