"""Jobs with [starts], and an independent computation of their sequence of starts."""

from fractions import Fraction

import h5py
import jobs
import launch
import numpy as np


def table(count, displacement=(-4.0, 1.0), velocity=(-4.0, 4.0), attractors=8):
    return (f"\n[starts]\ncount = {count}\ndisplacement_ratio = {list(displacement)}\nvelocity_ratio = {list(velocity)}\n"
            f"attractors = {attractors}\n")


def small_map(count=24, columns=40, rows=35, fields=()):
    """A window in which two attractors are common, with tiles cropped at two edges."""
    output = f'[output]\nfields = {list(fields)}\n'.replace("'", '"')
    return jobs.small_map(columns, rows, title="small map of attractors") + output + table(count)


def plastic(digits=60):
    """1/g with g^3 = g + 1 (plastic number; R2 sequence, Roberts 2018), as a fraction, by bisection."""
    low, high = Fraction(1), Fraction(2)
    for _ in range(digits * 4):
        middle = (low + high) / 2
        low, high = (middle, high) if middle**3 < middle + 1 else (low, middle)
    return 1 / low


def starts(count, displacement, velocity):
    """x(0)/A0 and x'(0)/(A0 omega) of each start, (count, 2), for starts not constrained by the stop."""
    step = plastic()
    points = []
    for n in range(count):
        across, up = (float((Fraction(1, 2) + n * power) % 1) for power in (step, step**2))
        points.append((displacement[0] + (displacement[1] - displacement[0]) * across,
                       velocity[0] + (velocity[1] - velocity[0]) * up))
    return np.array(points)


def compute(folder, text, *arguments, name="job", ranks=None):
    """The datasets at the root of a map's file, {name: array}."""
    jobs.write(folder, text, name=f"{name}.toml")
    finished = launch.run("run", f"{name}.toml", "--quiet", "--fresh", *arguments, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / f"{name}.h5") as file:
        return {key: item[()] for key, item in file.items() if isinstance(item, h5py.Dataset)}
