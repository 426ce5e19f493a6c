#!/usr/bin/env python3
"""How many points of curves a second gives, with which residual, and how far they are from a closed form; the page.
jobs/benchmark.sh calls it; it can be run alone, and takes some seconds:

    tests/benchmark/curves.py --build build --results results --page postprocess/examples/curves.md [--quick]

The closed form is that of the folds of 1/1 with a rigid stop: gap/A0 = P sqrt(1 + alpha^2 eta^2/(r + beta)^2).
"""

import subprocess
import sys

import h5py
import numpy as np
from bench import ROOT, page_arguments

JOB = ROOT / "jobs/curves_170mm.toml"
KINDS = ("fold", "period doubling", "grazing")
USUAL, QUICK = (128, 5), (32, 1)  # cells per side, rounds of which the fastest counts
RESTITUTION, DAMPING_RATIO = 0.6, 0.02
RIGID = f"""schema = 1
kind = "curves"
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
damping_ratio = {DAMPING_RATIO}
[cart]
amplitude_m = 0.89e-3
[contact]
law = "restitution"
coefficient = {RESTITUTION}
[axes.frequency_ratio]
from = 1.3
to = 3.2
points = 32
[axes.gap_ratio]
from = 0.0
to = 3.0
points = 32
[start]
displacement_ratio = -1.0
velocity_ratio = 2.0
[curves]
max_period = 1
"""


def main():
    arguments = page_arguments(__doc__)
    cells, rounds = QUICK if arguments.quick else USUAL
    points = [f"axes.{axis}.points={cells}" for axis in ("frequency_ratio", "gap_ratio")]
    files = [compute(arguments, JOB, f"curves_{n}.h5", points) for n in range(rounds)]
    (arguments.results / "curves_rigid.toml").write_text(RIGID, encoding="utf-8")
    rigid = compute(arguments, (arguments.results / "curves_rigid.toml").resolve(), "curves_rigid.h5")
    text = page(rows_of(files), cells, errors_of_folds(rigid))
    arguments.page.write_text(text, encoding="utf-8")
    print(text)


def compute(arguments, job, name, settings=()):
    """The file of a curves job, computed on one rank."""
    file = arguments.results / name
    command = ["mpirun", "-n", "1", arguments.build / "peterka", "run", job, "--output", file, "--fresh", "--quiet",
               *(word for setting in settings for word in ("--set", setting))]
    done = subprocess.run(list(map(str, command)), cwd=ROOT, stdin=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        sys.exit(f"curves.py: {job} failed with code {done.returncode}")
    return file


def rows_of(files):
    """(name, curves, points, points per second, residuals) of each kind, each q, and the total; the files are rounds of one job."""
    seconds = []
    for path in files:
        with h5py.File(path) as file:
            seconds.append(file["run/curve_seconds"][()])
            kinds, periods, counts = (file[f"curve_{name}"][()] for name in ("kind", "period", "points"))
            residuals = file["point_residual"][()]
    fastest = np.min(seconds, axis=0)
    chosen = [(name, kinds == number) for number, name in enumerate(KINDS)]
    chosen += [(f"q = {q}", periods == q) for q in np.unique(periods)] + [("all", kinds >= 0)]
    return [(name, int(some.sum()), int(counts[some].sum()), counts[some].sum() / fastest[some].sum(),
             residuals[np.repeat(some, counts)]) for name, some in chosen if some.any()]


def errors_of_folds(path):
    """Distance of the gap of each point on the folds of 1/1 from the closed form, in A0."""
    with h5py.File(path) as file:
        of_fold = np.repeat((file["curve_kind"][()] == 0) & (file["curve_impacts"][()] == 1), file["curve_points"][()])
        eta, gap = (file[f"point_{name}_ratio"][()][of_fold] for name in ("frequency", "gap"))
    return np.abs(gap - np.array([fold_of_rigid_stop(each) for each in eta]))


def fold_of_rigid_stop(eta):
    turn, nu = 2 * np.pi / eta, np.sqrt(1 - DAMPING_RATIO**2)
    decay, sine, cosine = np.exp(-DAMPING_RATIO * turn), np.sin(nu * turn), np.cos(nu * turn)
    flow = decay * np.array([[cosine + DAMPING_RATIO / nu * sine, sine / nu],
                             [-sine / nu, cosine - DAMPING_RATIO / nu * sine]])
    alpha, beta = (1 + RESTITUTION) * np.linalg.inv(flow - np.eye(2))[:, 1]
    reach = eta**2 / np.hypot(1 - eta**2, 2 * DAMPING_RATIO * eta)
    return reach * np.hypot(1, alpha * eta / (RESTITUTION + beta))


def page(rows, cells, errors):
    table = "\n".join(
        f"| {name} | {curves} | {points:,} | {speed:,.0f} | {np.median(residuals):.1e} | {np.percentile(residuals, 99):.1e} "
        f"| {residuals.max():.1e} |" for name, curves, points, speed, residuals in rows)
    return f"""# Curves: points a second, and their errors

Written by `tests/benchmark/curves.py`, which `jobs/benchmark.sh` calls; on one core. The curves of `jobs/curves_170mm.toml` with a
coarse map of {cells} × {cells} cells; seconds are those of tracing alone. A point's residual is the largest error of the equations of
its orbit, relative to 1 + the hammer's largest velocity (lengths in A₀, velocities in A₀ω), and of det(M ∓ I) = 0, relative to
the size of what M is the product of. Points are kept up to 10⁻¹¹; Newton's method stops where rounding does.

| curves | number | points | points a second | residual, median | 99 % | largest |
|---|---|---|---|---|---|---|
{table}

Where a curve lies is known in closed form for the fold of 1/1 with a rigid stop (r = {RESTITUTION}, ζ = {DAMPING_RATIO}): the gaps
of its {len(errors)} points are off by {np.median(errors):.1e} A₀ (median) and {errors.max():.1e} A₀ (largest).
"""


if __name__ == "__main__":
    main()
