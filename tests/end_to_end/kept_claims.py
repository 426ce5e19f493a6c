"""Claims of cells against more expensive verification: number of trials and of violations.

All functions solve maps of one rig in a folder, and return (tried, violated) unless stated otherwise.
"""

import h5py
import numpy as np

import jobs
import launch

PERIODIC, CHAOTIC, UNRESOLVED = 1, 2, 4
ROUNDING_DECIDES = 20  # sensitivity
ROUNDING, IMPRECISE = 6, 7  # status
FIELDS = ["regime", "impacts", "period", "peak_force_ratio", "status", "cycles", "sensitivity", "multiplier", "orbit_displacement",
          "orbit_velocity"]

TEXT = """
schema = 1
kind = "map"
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
damping_ratio = {zeta!r}
cubic_stiffness_n_per_m3 = {cubic!r}
[cart]
amplitude_m = 0.89e-3
[contact]
{stop}
[axes.frequency_ratio]
from = {eta!r}
to = {eta_to!r}
points = {points}
[axes.gap_ratio]
from = {gap!r}
to = {gap_to!r}
points = {points}
[start]
displacement_ratio = {x!r}
velocity_ratio = {v!r}
[output]
fields = ["sensitivity", "multiplier", "orbit"]
"""
PAPER = {"zeta": 0.00356, "cubic": 238.23, "ki": 5.5e6, "ci": 1200.0}


def spring(ki, ci):
    return f'law = "kelvin_voigt"\nstiffness_n_per_m = {float(ki)!r}\ndamping_ns_per_m = {float(ci)!r}'


def solve(folder, rig, *extra):
    """The fields of the map of a rig, {name: (rows, columns)}."""
    rig = {"x": 0.0, "v": 0.0, "cubic": 0.0, "points": 20, **rig}
    rig["eta_to"], rig["gap_to"] = rig["eta"] + rig.get("wide", 0.4), rig["gap"] + rig.get("high", 0.5)
    rig.setdefault("stop", spring(rig["ki"], rig["ci"]) if "ki" in rig else "")
    jobs.write(folder, TEXT.format(**rig))
    finished = launch.run("run", "job.toml", "--fresh", "--quiet", *extra, cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        return {name: file[name][()] for name in FIELDS} | {
            "frequency": file["frequency_ratio"][()], "gap": file["gap_ratio"][()]}


def random_rigs(seed, count, **limits):
    """Spring-dashpot stops from soft and nearly elastic to overdamped, lightly damped hammers, gaps from -0.4 A0."""
    random = np.random.default_rng(seed)
    rigs = []
    for _ in range(count):
        ki = float(np.exp(random.uniform(np.log(1e5), np.log(2e7))))
        ratio = float(np.exp(random.uniform(np.log(limits.get("least", 0.02)), np.log(1.2))))
        rigs.append({"zeta": float(np.exp(random.uniform(np.log(0.002), np.log(0.05)))), "ki": ki,
                     "ci": 2 * ratio * float(np.sqrt(0.298 * ki)), "eta": float(random.uniform(*limits.get("eta", (0.8, 5)))),
                     "gap": float(random.uniform(-0.4, 1.2)), "cubic": 238.23})
    return rigs


def labels(cells):
    return np.stack([cells["regime"], cells["impacts"], cells["period"]])


def differ(a, b):
    return np.any(labels(a) != labels(b), axis=0)


def decided_by_rounding(*all_cells):
    return np.any([(cells["sensitivity"] > ROUNDING_DECIDES) | (cells["status"] == 6) for cells in all_cells], axis=0)


def rigid_rigs(seed, count):
    """Rigid stops, from plastic to nearly elastic, lightly damped hammers."""
    random = np.random.default_rng(seed)
    return [{"zeta": float(np.exp(random.uniform(np.log(0.002), np.log(0.05)))), "eta": float(random.uniform(0.8, 7)),
             "gap": float(random.uniform(0, 1.2)),
             "stop": f'law = "restitution"\ncoefficient = {float(random.uniform(0.2, 0.95))!r}'} for _ in range(count)]


def cubic_left_out(folder, rig):
    """Labels and forces without the cubic term, where rounding decides neither,
    against runs that keep it: labels agree, and forces to omit_tolerance."""
    without = solve(folder, rig)
    kept = solve(folder, rig, "--set", "solver.omit_tolerance=0")
    told = decided_by_rounding(without, kept)
    claimed = (without["regime"] != UNRESOLVED) & (kept["regime"] != UNRESOLVED) & ~told
    compared = (without["regime"] == PERIODIC) & ~differ(without, kept) & claimed
    force, right = (cells["peak_force_ratio"][compared] for cells in (without, kept))
    return int(claimed.sum()), int((differ(without, kept) & claimed).sum() + (np.abs(force / right - 1) > 1e-3).sum())


def one_orbit_one_force(folder, rig):
    """Pairs of starts that lead to the same orbit: forces agree to 1e-9, and multipliers to 1e-6 unless a cell is flagged
    imprecise. Also returns the longest period."""
    starts = [(0.0, 0.0), (-3.0, 1.0), (-1.5, -2.0), (-4.0, 0.5)]
    maps = [solve(folder, {**rig, "cubic": 0.0, "x": min(x, rig["gap"]), "v": v}) for x, v in starts]
    pairs = broken = longest = 0
    for n, one in enumerate(maps):
        for other in maps[:n]:
            same = (one["regime"] == PERIODIC) & ~differ(one, other)
            for name in ("orbit_displacement", "orbit_velocity"):
                same &= np.abs(one[name] - other[name]) < 1e-6 * (1 + np.abs(other[name]))
            force, right = one["peak_force_ratio"][same], other["peak_force_ratio"][same]
            precise = ((one["status"] != IMPRECISE) & (other["status"] != IMPRECISE))[same]
            pairs += int(same.sum())
            broken += int(((np.abs(force / right - 1) >= 1e-9)
                           | (precise & (np.abs(one["multiplier"][same] - other["multiplier"][same]) >= 1e-6))).sum())
            longest = max(longest, int(one["period"][same].max(initial=0)))
    return pairs, broken, longest


def chaos_that_turns(folder, rig):
    """Cells called chaotic where impacts never end, and those of them that settle within 20,000 cycles."""
    cells = solve(folder, rig)
    later = solve(folder, rig, "--set", "steady_state.chaos_cycles=70000", "--set", "steady_state.max_cycles=20000")
    square = cells["frequency"] ** 2
    reach = square / np.sqrt((1 - square) ** 2 + (2 * rig["zeta"]) ** 2 * square)
    goes_on = (cells["regime"] == CHAOTIC) & (cells["gap"][:, None] < reach)
    return int(goes_on.sum()), int((goes_on & np.isin(later["regime"], [0, 1, 3])).sum())


def last_bit_of_an_input(folder, rig):
    """Labels that change when an input changes by its last bit, although no sensitivity indicates it."""
    rig = {**rig, "cubic": 0.0}
    cells = solve(folder, rig)
    tried = broken = 0
    for name in [name for name in ("zeta", "ki", "ci", "eta", "gap") if name in rig]:
        moved = solve(folder, {**rig, name: float(np.nextafter(rig[name], np.inf))})
        tried += cells["regime"].size
        broken += int((differ(cells, moved) & ~decided_by_rounding(cells) & ~decided_by_rounding(moved)).sum())
    return tried, broken
