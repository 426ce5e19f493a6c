"""Distance of a cell from the boundary of its own motion, independently of curves: an inheriting sweep continues the motion
from the cell until its label changes, or its force, with a rigid stop its impact speed, jumps to that of another motion with
the same label."""

import re

import h5py
import numpy as np
from scipy.interpolate import CubicSpline

import jobs
import kept_claims
import launch

PERIODIC = 1
FOLD, DOUBLING, GRAZING, NONE, UNKNOWN = range(5)
SIDES = ("frequency_ratio", "gap_ratio")
POINTS = 40  # of each axis of a map

RIG = """
schema = 1
kind = "{kind}"
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
damping_ratio = {zeta!r}
[cart]
amplitude_m = 0.89e-3
[contact]
{stop}
"""


def random_rigs(seed, count):
    """Rigs, each with a window of frequencies and gaps: {zeta, stop, eta, gap}."""
    return [{**rig, "stop": kept_claims.spring(rig["ki"], rig["ci"]), "eta": rig["eta"] / 2}
            for rig in kept_claims.random_rigs(seed, count)]


def rigid_rigs(seed, count):
    """The same with rigid stops, the first of which takes all speed, and the second nearly all."""
    plastic = {n: f'law = "restitution"\ncoefficient = {coefficient}' for n, coefficient in enumerate((0.0, 0.05))}
    return [{**rig, "stop": plastic.get(n, rig["stop"]), "eta": rig["eta"] / 2} for n, rig in enumerate(kept_claims.rigid_rigs(seed, count))]


def is_rigid(rig):
    return "restitution" in rig["stop"]


def window_of(rig):
    return {"frequency_ratio": (rig["eta"], rig["eta"] + 3.0), "gap_ratio": (rig["gap"], rig["gap"] + 3.0)}


def run(folder, text):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", "--quiet", "--fresh", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return h5py.File(folder / "job.h5")


def cells_of(folder, rig):
    """Arrays over the cells of the rig's window: labels, orbits, distances and kinds of edges."""
    axes = "".join(jobs.axis(name, *map(repr, window_of(rig)[name]), POINTS) for name in SIDES)
    cells = {}
    with run(folder, RIG.format(kind="map", **rig) + axes + '[output]\nfields = ["orbit"]\n') as file:
        for name in ("regime", "impacts", "period", "orbit_displacement", "orbit_velocity", *SIDES):
            cells[name] = file[name][()]
    with run(folder, RIG.format(kind="curves", **rig) + axes + "[curves]\nedge_distance = true\n") as file:
        for side in SIDES:
            cells[f"distance_{side}"] = file[f"edge_distance_{side}"][()]
            cells[f"kind_{side}"] = file[f"edge_kind_{side}"][()]
    return cells


def label_of(cells, cell):
    return tuple(int(cells[name][cell]) for name in ("regime", "impacts", "period"))


def drag(folder, rig, place, side, to, state, steps):
    """Values along a side from a point on, and labels and forces, with a rigid stop impact speeds, of the continued motion."""
    strength = "impact_speed" if is_rigid(rig) else "peak_force_ratio"
    other = SIDES[1 - SIDES.index(side)]
    low, high = sorted([place[side], to])
    direction = f'direction = "{"up" if to > place[side] else "down"}"\n'
    rest = (f"[sweep]\ngap_ratio = [{float(place[other])!r}]\n{direction}" if other == "gap_ratio" else
            f"[operating_point]\nfrequency_ratio = {float(place[other])!r}\n[sweep]\n{direction}")
    text = (RIG.format(kind="sweep", **rig) + jobs.axis(side, repr(float(low)), repr(float(high)), steps + 1) + rest
            + f"[start]\ndisplacement_ratio = {float(state[0])!r}\nvelocity_ratio = {float(state[1] + place['frequency_ratio'])!r}\n"
            + "[steady_state]\nmax_cycles = 20000\n" + '[output]\nfields = ["impact_speed"]\n' * is_rigid(rig))
    onwards = slice(None, None, 1 if to > place[side] else -1)
    with run(folder, text) as file:
        labels = np.stack([file[name][0] for name in ("regime", "impacts", "period")], axis=1)
        return file[side][()][onwards], labels[onwards], file[strength][0][onwards]


def jumps(forces):
    """Whether the force jumps between successive points: by far more than before and after."""
    changes = np.pad(np.abs(np.diff(forces)), 1)
    return (changes[1:-1] > 5 * np.maximum(changes[:-2], changes[2:])) & (changes[1:-1] > 1e-4 * forces[1:])


def end_of_motion(folder, rig, place, side, to, state, label, steps=50, most_steps=3200):
    """Distance at which the motion ends on the way to a value, infinite if it does not, and the step used: halved until the
    distance no longer changes, because long steps leave a shrinking basin early. None if it does not converge."""
    before = None
    while steps <= most_steps:
        values, labels, forces = drag(folder, rig, place, side, to, state, steps)
        ends = np.any(labels != label, axis=1)
        ends[1:] |= jumps(forces)
        change = np.abs(values[np.argmax(ends)] - place[side]) if ends.any() else np.inf
        step = abs(to - place[side]) / steps
        if before is not None and (change == before or abs(change - before) <= 2 * step):
            return change, 2 * step
        before, steps = change, 2 * steps
    return None


def disagreement(folder, rig, cells, cell, side):
    """None if a cell's distance agrees with continuation of its motion; "unknown" if the cell says so itself; otherwise a description."""
    kind, told = int(cells[f"kind_{side}"][cell]), float(cells[f"distance_{side}"][cell])
    if kind == UNKNOWN:
        return "unknown"
    place = {"frequency_ratio": float(cells["frequency_ratio"][cell[1]]), "gap_ratio": float(cells["gap_ratio"][cell[0]])}
    state = tuple(float(cells[name][cell]) for name in ("orbit_displacement", "orbit_velocity"))
    label = label_of(cells, cell)
    for border, sign in zip(window_of(rig)[side], (-1, 1), strict=True):
        room = abs(border - place[side])
        is_there = kind != NONE and np.sign(told) == sign
        to = min(room, abs(told) * (1.1 if is_there else 1)) if kind != NONE else room
        if to < 1e-9:
            continue
        found = end_of_motion(folder, rig, place, side, place[side] + sign * to, state, label)
        if found is None:
            return f"{side} {sign:+}: its end doesn't converge"
        change, step = found
        if is_there and not abs(change - abs(told)) <= step:
            return f"{side}: told {told:.6g}, kind {kind}, it ends after {sign * change:.6g} +- {step:.2g}"
        if not is_there and change < to - step:
            return f"{side}: told {told:.6g}, kind {kind}, it ends after {sign * change:.6g} +- {step:.2g}"
    return None


def random_cells(cells, count, seed):
    """Random (cell, side), with an edge or without."""
    random = np.random.default_rng(seed)
    asked = [(tuple(map(int, cell)), side) for side in SIDES
             for cell in np.argwhere((cells["regime"] == PERIODIC) & (cells[f"kind_{side}"] >= FOLD))]
    return [asked[i] for i in random.permutation(len(asked))[:count]]


BORDER = re.compile(r"([\d.e+-]+) (fold|period doubling|grazing)")


def borders_told(folder, rig, gap):
    """(impacts, period, Omega/omega, orbits) of each border listed in the summary at a gap; no impact is 0, 1. Orbits are
    those (x - y, x' - y') of its curves there."""
    axes = "".join(jobs.axis(name, *map(repr, window_of(rig)[name]), POINTS) for name in SIDES)
    jobs.write(folder, RIG.format(kind="curves", **rig) + axes + f"[curves]\ngap_ratio = [{float(gap)!r}]\n")
    finished = launch.run("run", "job.toml", "--fresh", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        data = {name: file[name][()] for name in file if isinstance(file[name], h5py.Dataset)}
    for line in finished.stdout.split("Borders at gap/A0")[1].splitlines()[1:]:
        label = re.match(r"  (no impact|\d+/\d+) ", line)
        if label is None:
            break
        impacts, period = (0, 1) if label[1] == "no impact" else map(int, label[1].split("/"))
        for frequency, _ in BORDER.findall(line):
            yield impacts, period, float(frequency) / 4.5, orbits_at(data, float(frequency) / 4.5, gap)


def orbits_at(data, frequency, gap):
    """The orbit (x - y, x' - y') of each curve that crosses a gap at a frequency, by cubic interpolation between its stored points."""
    orbits = []
    for curve in set(data["crossing_curve"][np.abs(data["crossing_frequency_ratio"] - frequency) < 1e-6]):
        first, count = (int(data[f"curve_{name}"][curve]) for name in ("first", "points"))
        points = np.stack([data[f"point_{name}"][first:first + count]
                           for name in ("frequency_ratio", "gap_ratio", "orbit_displacement", "orbit_velocity")], axis=1)
        lengths = np.cumsum(np.linalg.norm(np.diff(points[:, :2], axis=0, prepend=points[:1, :2]), axis=1))
        at = CubicSpline(lengths, points)
        for length in CubicSpline(lengths, points[:, 1]).solve(gap, extrapolate=False):
            if abs(at(length)[0] - frequency) < 1e-3 * frequency:
                orbits.append(at(length)[2:])
    return orbits


def ends_on_its_curve(folder, rig, gap, impacts, period, frequency, orbits):
    """Whether a motion of the label that begins near a frequency, on an orbit of the curve there or on one that starts beside it
    find, ends when continued across it."""
    for away in (sign * size for size in (3e-3, 1e-3, 1e-4, 1e-5, 1e-6) for sign in (-1, 1)):
        begin = {"frequency_ratio": frequency * (1 + away), "gap_ratio": gap}
        near = [motions_with_label(folder, rig, gap, [begin["frequency_ratio"]], impacts, period, 2048, around(rig, begin, orbit))[0] for orbit in orbits]
        for orbit in [*orbits, *map(tuple, np.concatenate(near or [[]]).tolist())]:
            found = end_of_motion(folder, rig, begin, "frequency_ratio", frequency * (1 - away), orbit, (PERIODIC, impacts, period))
            if found is not None and abs(found[0] - abs(frequency * away)) <= found[1]:
                return True
    return False


def around(rig, place, orbit, most=0.05):
    """(displacements, absolute velocities) of starts near an orbit, which is as far off as the cubic between its curve's points."""
    gap = place["gap_ratio"]
    (low, high), speeds = ([float(value) - most, float(value) + most] for value in (orbit[0], orbit[1] + place["frequency_ratio"]))
    return [min(low, gap - most), min(high, gap)] if is_rigid(rig) else [low, high], speeds


def motions_with_label(folder, rig, gap, frequencies, impacts, period, starts, box=None):
    """For each frequency: states (displacement, velocity) of the motions of a label found from this many starts of a box
    ([from, to] of displacements, of absolute velocities)."""
    displacements, velocities = box or ([gap - 6.0, gap] if is_rigid(rig) else [-6.0, 2.0], [-6.0, 6.0])
    text = (RIG.format(kind="map", **rig) + jobs.axis("frequency_ratio", repr(float(frequencies[0])), repr(float(frequencies[-1])), len(frequencies))
            + jobs.axis("gap_ratio", repr(float(gap)), repr(float(gap)), 1)
            + f"[starts]\ncount = {starts}\nattractors = 16\ndisplacement_ratio = {displacements}\nvelocity_ratio = {velocities}\n")
    with run(folder, text) as file:
        is_one = ((file["attractor_regime"][:, 0] == (PERIODIC if impacts else 0)) & (file["attractor_impacts"][:, 0] == impacts)
                  & ((file["attractor_period"][:, 0] == period) | (impacts == 0)))
        orbits = np.stack([file[f"attractor_orbit_{name}"][:, 0] for name in ("displacement", "velocity")], axis=-1)
        return [orbits[:, side][is_one[:, side]] for side in range(len(frequencies))]


def ends_there(folder, rig, gap, impacts, period, frequency):
    """Whether a motion of the label found from starts some distance away ends at a frequency when continued there."""
    for away in (-0.01, 0.01, -0.03, 0.03):
        begin, beyond = frequency * (1 + away), frequency * (1 - away / 10)
        for orbit in motions_with_label(folder, rig, gap, [begin], impacts, period, starts=64)[0]:
            found = end_of_motion(folder, rig, {"frequency_ratio": begin, "gap_ratio": gap}, "frequency_ratio", beyond,
                                  tuple(map(float, orbit)), (PERIODIC, impacts, period), steps=400)
            if found is not None and abs(found[0] - abs(frequency - begin)) <= found[1]:
                return True
    return False


def is_border(folder, rig, gap, impacts, period, frequency, orbits):
    """Whether a motion of the label ends there, continued from where starts find it or from the orbit of its curve, or
    exists on only one side of a frequency, within a small or a smaller distance, as starts tell, also dense ones near that orbit."""
    if impacts and (ends_there(folder, rig, gap, impacts, period, frequency)
                    or ends_on_its_curve(folder, rig, gap, impacts, period, frequency, orbits)):
        return True
    for beside in (1e-3, 1e-4, 1e-5, 1e-6):
        sides = [frequency * (1 - beside), frequency * (1 + beside)]
        at_curve = {"frequency_ratio": frequency, "gap_ratio": gap}
        for starts, box in [(512, None), *((2048, around(rig, at_curve, orbit)) for orbit in orbits)]:
            below, above = motions_with_label(folder, rig, gap, sides, impacts, period, starts, box)
            if len(below) != len(above):
                return True
    return False
