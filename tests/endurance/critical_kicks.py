#!/usr/bin/python3
"""Critical kicks of random rigs, each tested against 10,000 smaller kicks at random phases, by plain simulations (critical_kicks.cpp).

    PETERKA_ENDURANCE_ATTRACTORS=20 tests/endurance.sh critical_kicks     instead of 100

The outcomes of the worst case's kicks are drawn into pictures/critical_kick.png: for the orbit with the smallest
counterexample relative to the reported kick or, if there is none, for the orbit with the smallest critical kick.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import parts
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

COUNT = int(os.environ.get("PETERKA_ENDURANCE_ATTRACTORS", "100"))
KICKS = 10_000
SEED = int(os.environ.get("PETERKA_ENDURANCE_SEED", "1"))
BUILD = Path(os.environ["PETERKA_BINARY"]).parent
MOST_BROKEN = 0.02  # share of the attractors


POINTS = 300  # of the picture, along phases and sizes
ENDS = {"back on the orbit": "#F2F2F2", "elsewhere": "#2171B5", "on chaos": "#222222"}
ORBIT = re.compile(r"rig (\d+) slot (\d+) (\d+/\d+) kick ([\d.e+-]+) phase ([\d.]+) direction (-?1)(?:.*least ([\d.]+) of it)?")


def worst_of(told):
    """(rig, slot, "p/q", kick, phase, direction) of an orbit; None if no kick ends elsewhere."""
    found = [(float(least or 1), float(kick), (rig, slot, label, float(kick), float(phase), int(direction)))
             for rig, slot, label, kick, phase, direction, least in ORBIT.findall(told)]
    return min(found)[2] if found else None


def draw(case, path):
    """Where kicks of an orbit end, over their phase and size."""
    rig, slot, label, kick, phase, direction = case
    with tempfile.TemporaryDirectory() as folder:
        plane = Path(folder) / "plane.txt"
        subprocess.run([BUILD / "tests" / "critical_kicks", "plane", rig, slot, str(POINTS), str(SEED), plane], check=True)
        kicks = np.loadtxt(plane, usecols=(0, 1, 2))  # in order of completion
    phases, changes, ends = (column.reshape(POINTS, POINTS) for column in kicks[np.lexsort((kicks[:, 0], kicks[:, 1]))].T)
    figure, ax = plt.subplots(figsize=(4.6, 3.6), layout="constrained")
    ax.pcolormesh(phases, changes, ends, cmap=ListedColormap(list(ENDS.values())), vmin=0, vmax=len(ENDS) - 1, rasterized=True)
    ax.plot(phase, direction * kick, "o", markersize=7, markerfacecolor="none", markeredgecolor="#D62728", markeredgewidth=1.4)
    ax.set(xlabel="phase of the kick (cycles)", ylabel="change of velocity ($A_0\\omega$)", title=f"Where the hammer on its {label} orbit ends")
    ax.legend([Patch(facecolor=colour, edgecolor="grey", linewidth=0.5) for colour in ENDS.values()], list(ENDS), fontsize=8,
              ncol=len(ENDS), loc="upper center", bbox_to_anchor=(0.5, -0.18), frameon=False)
    path.parent.mkdir(exist_ok=True)
    figure.savefig(path, dpi=150)
    print(f"worst case: rig {rig}, {label}, critical kick {kick:g} A0 omega: {path}", flush=True)


def main():
    if not (BUILD / "build.ninja").exists():
        parts.skip(f"{BUILD} is no build folder: the attack is a program of its own")
    subprocess.run(["cmake", "--build", BUILD, "--target", "critical_kicks"], check=True, stdout=subprocess.DEVNULL)
    told = subprocess.run([BUILD / "tests" / "critical_kicks", str(COUNT), str(KICKS), str(SEED)], check=True, text=True,
                          stdout=subprocess.PIPE).stdout
    print(told, flush=True)
    if (worst := worst_of(told)) is not None:
        draw(worst, Path("pictures") / "critical_kick.png")
    broken, by_a_tenth = map(int, re.search(r"(\d+) have a smaller one, (\d+) by more than a tenth", told).groups())
    parts.row(f"a critical kick, against {KICKS:,} smaller ones at random phases: orbits of random rigs", COUNT,
              f"{broken} have a smaller one, {by_a_tenth} by more than a tenth")
    bounds, below = map(int, re.search(r"(\d+) have a lower bound, .*; (\d+) of these", told).groups())
    parts.row(f"a lower bound of a critical kick, against {KICKS:,} kicks below it at random phases: orbits of random rigs", bounds,
              f"{below} have one that leads elsewhere")
    return 1 if broken > MOST_BROKEN * COUNT or by_a_tenth or below else 0


if __name__ == "__main__":
    sys.exit(main())
