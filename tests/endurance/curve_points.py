#!/usr/bin/python3
"""Points of curves, each against the motion that begins there: those of folds and period doublings of random rigs have to return after
their q cycles (curve_points.cpp), within 1e-5 (1 + velocity). The first and the last two of a curve aren't counted: at a grazing, where many
curves end, motions are as sensitive as one likes. Their places at 99 gaps are compared with each other, too: how many of one kind and
period are told twice is counted.

    PETERKA_ENDURANCE_RIGS=5 tests/endurance.sh curve_points     instead of 30
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
import parts

import jobs
import launch

RIGS = int(os.environ.get("PETERKA_ENDURANCE_RIGS", "30"))
SEED = int(os.environ.get("PETERKA_ENDURANCE_SEED", "2028"))
BUILD = Path(os.environ["PETERKA_BINARY"]).parent
POINTS, ENDS, GRAZING, WRONG = 30, 2, 2, 1e-5
GAPS, SAME = 99, 1e-8  # gaps at which places are told, and how near two of them are one, relative
MASS, HERTZ, AMPLITUDE = 0.4, 8.0, 2e-3  # numbers that scales alone depend on
STIFFNESS, IMPEDANCE = MASS * (2 * np.pi * HERTZ)**2, MASS * 2 * np.pi * HERTZ
JOB = f"""schema = 1
kind = "curves"
[hammer]
mass_kg = {MASS}
natural_frequency_hz = {HERTZ}
damping_ratio = {{ratio!r}}
[cart]
amplitude_m = {AMPLITUDE}
[contact]
{{stop}}
{{axis}}
[axes.gap_ratio]
from = {{low!r}}
to = 4.0
points = {POINTS}
[curves]
max_period = 4
gap_ratio = {{gaps!r}}
"""
AXIS = "[axes.{}]\nfrom = {!r}\nto = {!r}\npoints = " + f"{POINTS}\n"


def random_rig(chance, number):
    """{ratio, kappa, chi, coefficient (None of a stop that yields), frequency (None if the stop's number is the axis)}"""
    rigid = number % 3 == 0
    kappa = 10**chance.uniform(1.3, 4)
    return {"ratio": 10**chance.uniform(-2.2, -0.8), "kappa": kappa, "chi": 2 * chance.uniform(0.05, 0.8) * np.sqrt(1 + kappa),
            "coefficient": chance.choice([0.0, chance.uniform(0.01, 0.3), chance.uniform(0.3, 0.95)]) if rigid else None,
            "frequency": None if number % 2 else chance.uniform(1.5, 3.5), "low": 0.0 if rigid else chance.uniform(-0.5, 0.0)}


def job_of(rig):
    kappa, rigid = rig["kappa"], rig["coefficient"] is not None
    stop = (f'law = "restitution"\ncoefficient = {rig["coefficient"]!r}' if rigid else
            f'law = "kelvin_voigt"\nstiffness_n_per_m = {kappa * STIFFNESS!r}\ndamping_ns_per_m = {rig["chi"] * IMPEDANCE!r}')
    axis = AXIS.format("frequency_ratio", 0.5, 4.5)
    if rig["frequency"] is not None:
        axis = AXIS.format("contact.coefficient", 0.0, 0.95) if rigid else (
            AXIS.format("contact.stiffness_n_per_m", 0.1 * kappa * STIFFNESS, 30 * kappa * STIFFNESS) + 'scale = "log"\n')
        axis += f'[operating_point]\nfrequency_ratio = {rig["frequency"]!r}\n'
    gaps = np.linspace(rig["low"], 4.0, GAPS + 2)[1:-1].tolist()
    return JOB.format(stop=stop, axis=axis, ratio=rig["ratio"], low=rig["low"], gaps=gaps)


def told_twice(file):
    """(number of places at gaps, of those told twice)"""
    if "crossing" not in file:
        return 0, 0
    curve = file["crossing_curve"][()]
    along = next(item[()] for name, item in file.items() if name.startswith("crossing_")
                 and name.endswith(("frequency_ratio", "stiffness_n_per_m", "coefficient")))
    keys = file["curve_kind"][()][curve], file["curve_period"][()][curve], file["crossing_gap_ratio"][()]
    order = np.lexsort((along, *reversed(keys)))
    same = np.abs(np.diff(along[order])) < SAME * along[order][1:]
    for key in keys:
        same &= np.diff(key[order]) == 0
    return len(curve), int(same.sum())


def numbers_of(file, rig):
    """(what curve_points reads, (points, 9); mask of the points that count)"""
    point = {name.removeprefix("point_"): item[()] for name, item in file.items() if name.startswith("point_")}
    count, rigid = len(point["gap_ratio"]), rig["coefficient"] is not None
    first = np.full(count, rig["coefficient"] if rigid else rig["kappa"])
    if rig["frequency"] is not None:
        first = point["contact_coefficient"] if rigid else point["contact_stiffness_n_per_m"] / STIFFNESS
    first = np.maximum(first, 0.0)  # a curve reaches beyond the window by rounding, to a coefficient of -4e-11
    frequency = point.get("frequency_ratio", np.full(count, rig["frequency"], dtype=float))
    period, counts = np.zeros(count), np.zeros(count, dtype=bool)
    for begin, length, kind, q in zip(*(file[f"curve_{name}"][()] for name in ("first", "points", "kind", "period"))):
        period[begin:begin + length] = q
        counts[begin + ENDS:begin + length - ENDS] = kind != GRAZING
    columns = [np.full(count, rig["ratio"]), np.full(count, rigid), first, np.full(count, 0.0 if rigid else rig["chi"]), frequency,
               point["gap_ratio"], period, point["orbit_displacement"], point["orbit_velocity"]]
    return np.column_stack(columns), counts


def main():
    if not (BUILD / "build.ninja").exists():
        parts.skip(f"{BUILD} is no build folder: the attack is a program of its own")
    subprocess.run(["cmake", "--build", BUILD, "--target", "curve_points"], check=True, stdout=subprocess.DEVNULL)
    chance = np.random.default_rng(SEED)
    tried = wrong = places = twice = 0
    for number in range(RIGS):
        rig = random_rig(chance, number)
        with tempfile.TemporaryDirectory() as folder:
            jobs.write(Path(folder), job_of(rig))
            finished = launch.run("run", "job.toml", "--quiet", cwd=folder)
            assert finished.returncode == 0, finished.stderr
            with h5py.File(Path(folder) / "job.h5") as file:
                told, again = told_twice(file)
                lines, counts = numbers_of(file, rig) if "curve" in file else (np.zeros((0, 9)), np.zeros(0, dtype=bool))
        lines = lines[counts]
        text = "".join(f"{one[0]!r} {one[1]:.0f} {one[2]!r} {one[3]!r} {one[4]!r} {one[5]!r} {one[6]:.0f} {one[7]!r} {one[8]!r}\n" for one in lines.tolist())
        answers = subprocess.run([BUILD / "tests" / "curve_points"], input=text, check=True, text=True, stdout=subprocess.PIPE).stdout
        missed = np.array(answers.split(), dtype=float)
        assert len(missed) == len(lines)
        bad = np.flatnonzero(missed > WRONG * (1 + np.abs(lines[:, 8])))
        print(f"rig {number}: {len(lines)} points, {len(bad)} wrong, {told} places, {again} twice", *(f"\n  {missed[at]:.2e}: {lines[at].tolist()}" for at in bad[:3]), flush=True)
        tried, wrong, places, twice = tried + len(lines), wrong + len(bad), places + told, twice + again
    parts.row(f"a point of a fold or a period doubling, against the motion that begins there: {RIGS} random rigs, over frequency, stiffness or coefficient "
              "and gap", tried, f"{wrong} don't return")
    parts.row(f"a place of a curve at a gap, against the others: the same rigs, {GAPS} gaps each", places, f"{twice} told twice")
    return 1 if wrong or not tried else 0


if __name__ == "__main__":
    sys.exit(main())
