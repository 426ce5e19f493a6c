"""Shares of cells in which chaos may end in motion without impact, against separate runs from a grid of starts."""

import math

import h5py
import numpy as np

import jobs
import kept_places
import launch

NO_IMPACT, CHAOTIC, UNRESOLVED = 0, 2, 4
COUNT, SIDE = 256, 16
RECTANGLE = kept_places.RECTANGLE


def starts_table(count):
    return (f"[starts]\ncount = {count}\ndisplacement_ratio = {list(RECTANGLE['displacement'])}\n"
            f"velocity_ratio = {list(RECTANGLE['velocity'])}\n")


def solve(folder, text, name):
    jobs.write(folder, text, name=f"{name}.toml")
    finished = launch.run("run", f"{name}.toml", "--quiet", "--fresh", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / f"{name}.h5") as file:
        return {key: item[()] for key, item in file.items() if isinstance(item, h5py.Dataset)}


def chaotic_cells(folder, rig, window, points=40):
    """[(Omega/omega, gap/A0)] of a window where some of a few starts are chaotic and a motion without impact exists."""
    axes = "".join(jobs.axis(name, *map(repr, ends), points) for name, ends in window.items())
    cells = solve(folder, rig + axes + starts_table(16), "coarse")
    both = (cells["attractor_regime"] == CHAOTIC).any(axis=0) & (cells["attractor_regime"] == NO_IMPACT).any(axis=0)
    return [(float(cells["frequency_ratio"][column]), float(cells["gap_ratio"][row])) for row, column in np.argwhere(both)]


def shares(folder, rig, place):
    """{regime: (share of the cell's starts, share of as many on a grid, each in a separate run)}."""
    eta, gap = place
    cell = solve(folder, rig + jobs.axis("frequency_ratio", repr(float(eta)), repr(float(eta)), 1) + jobs.axis("gap_ratio", repr(float(gap)), repr(float(gap)), 1)
                 + starts_table(COUNT), "cell")
    text = rig + f"[operating_point]\nfrequency_ratio = {float(eta)!r}\ngap_ratio = {float(gap)!r}\n"
    for name, (low, high) in RECTANGLE.items():
        step = ((min(high, gap) if name == "displacement" else high) - low) / SIDE
        text += jobs.axis(f"start.{name}_ratio", repr(float(low + step / 2)), repr(float(low + step / 2 + (SIDE - 1) * step)), SIDE)
    grid = solve(folder, text, "grid")
    regimes, share = cell["attractor_regime"][:, 0, 0], cell["basin_share"][:, 0, 0]
    return {regime: (float(share[regimes == regime].sum()), float((grid["regime"] == regime).mean()))
            for regime in (NO_IMPACT, 1, CHAOTIC, UNRESOLVED)}


def errors_apart(mine, theirs):
    """Difference of two shares of COUNT starts in binomial standard errors."""
    both = (mine + theirs) / 2
    return (mine - theirs) / math.sqrt(2 * max(both * (1 - both), 0.5 / COUNT) / COUNT)
