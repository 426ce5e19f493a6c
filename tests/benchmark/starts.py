#!/usr/bin/env python3
"""How far basin shares and numbers of attractors are off against the time for them, from 4 to 1024 starts a cell; the page
and its picture. jobs/benchmark.sh calls it; it can be run alone:

    tests/benchmark/starts.py --build build --results results --page postprocess/examples/starts.md [--quick]

The truth is that of many more starts, over the same cells. As many independent random starts would err by what the binomial
distribution says, sqrt(s (1 - s)/n) for a share s, and miss an attractor with probability (1 - s)^n.
"""

import subprocess
import sys
from collections import defaultdict
from dataclasses import dataclass

import h5py
import numpy as np
from bench import ROOT, page_arguments  # makes the package in postprocess importable

from peterka.plotting import axes, style
from peterka.plotting.figures import new_figure

JOB = "jobs/attractors_170mm.toml"
COUNTS = (4, 16, 64, 256, 1024)
SLOTS = 64  # all attractors of a cell
USUAL, QUICK = (24, 8192), (6, 2048)  # cells per side, starts of the reference
NAMES = ("attractor_regime", "attractor_impacts", "attractor_period", "basin_share")


@dataclass(frozen=True)
class Found:
    """`shares` {label: share} of each cell; cycles and seconds of computing for all of them."""

    shares: list
    cycles: float
    seconds: float


@dataclass(frozen=True)
class Row:
    """For `count` starts: seconds per cell, cycles per start; the error of a share (root mean square over cells and
    attractors), that of as many random starts, the largest error; fraction of the existing attractors found, and the same
    for random starts; mean number of attractors found per cell."""

    count: int
    seconds: float
    cycles: float
    error: float
    bound: float
    largest: float
    found: float
    expected: float
    attractors: float


def main():
    arguments = page_arguments(__doc__)
    side, many = QUICK if arguments.quick else USUAL
    truth = compute(arguments, side, many)
    rows = [row_of(count, compute(arguments, side, count), truth) for count in COUNTS]
    with style.using():
        axes.save(picture(rows), arguments.page.with_suffix(".png"))
    text = page(rows, side, many, truth, arguments.page)
    arguments.page.write_text(text, encoding="utf-8")
    print(text)


def compute(arguments, side, count):
    """The Found for this many starts per cell."""
    file = arguments.results / f"starts_{side}_{count}.h5"
    changes = {"axes.frequency_ratio.points": side, "axes.gap_ratio.points": side, "starts.count": count,
               "starts.attractors": SLOTS}
    command = ["mpirun", "-n", "1", arguments.build / "peterka", "run", JOB, "--output", file, "--fresh", "--quiet"]
    command += [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
    done = subprocess.run(list(map(str, command)), cwd=ROOT, stdin=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        sys.exit(f"starts.py: {count} starts in {side} x {side} cells failed with code {done.returncode}")
    return read(file)


def read(path):
    with h5py.File(path) as file:
        regime, impacts, period, share = (file[name][()].reshape(SLOTS, -1) for name in NAMES)
        cells = []
        for cell in range(share.shape[1]):
            shares = defaultdict(float)
            for slot in np.flatnonzero(share[:, cell]):
                shares[int(regime[slot, cell]), int(impacts[slot, cell]), int(period[slot, cell])] += float(share[slot, cell])
            cells.append(dict(shares))
        return Found(cells, float(file["cycles"][()].sum()), float(np.nansum(file["run/tile_seconds"][()])))


def row_of(count, found, truth):
    pairs = [(cell.get(label, 0.0), share) for cell, true in zip(found.shares, truth.shares)
             for label, share in true.items() if len(true) > 1]
    shares, true = np.array(pairs).T
    off = np.abs(shares - true)
    cells = len(truth.shares)
    return Row(count, found.seconds / cells, found.cycles / cells / count, rms(off), rms(np.sqrt(true * (1 - true) / count)),
               float(off.max()), float(np.mean(shares > 0)), float(np.mean(1 - (1 - true)**count)),
               float(np.mean([len(cell) for cell in found.shares])))


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def picture(rows):
    """Errors and missed attractors against time."""
    figure = new_figure(9.2, 2.9)
    seconds = [row.seconds for row in rows]
    left, right, last = figure.subplots(1, 3)
    left.loglog(seconds, [row.error for row in rows], "o-", color="black", label="starts of the program")
    left.loglog(seconds, [row.bound for row in rows], "--", color="#D55E00", label="random starts (binomial)")
    right.semilogx(seconds, [100 * (1 - row.found) for row in rows], "o-", color="black")
    right.semilogx(seconds, [100 * (1 - row.expected) for row in rows], "--", color="#D55E00")
    for row in rows:
        left.annotate(str(row.count), (row.seconds, row.error), textcoords="offset points", xytext=(-4, -3), ha="right",
                      va="top", fontsize=7)
    left.set_ylabel("error of a basin share (rms)")
    right.set_ylabel("attractors missed (%)")
    last.semilogx(seconds, [row.attractors for row in rows], "o-", color="black")
    last.set_ylabel("attractors of a cell, as found")
    for panel in (left, right, last):
        panel.margins(x=0.12, y=0.1)
        panel.set_xlabel("computing time of a cell (s)")
    left.legend(fontsize=7)
    return figure


def page(rows, side, many, truth, path):
    several = [len(cell) for cell in truth.shares if len(cell) > 1]
    lines = ["| starts | time of a cell (ms) | cycles of a start | error of a share: rms | random starts | largest | attractors "
             "found | random starts | attractors of a cell |", "| --- " * 9 + "|"]
    lines += [f"| {row.count} | {1e3 * row.seconds:.3g} | {row.cycles:.1f} | {row.error:.4f} | {row.bound:.4f} | "
              f"{row.largest:.3f} | {100 * row.found:.1f} % | {100 * row.expected:.1f} % | {row.attractors:.3f} |" for row in rows]
    return "\n\n".join([
        "# Starts: error against time",
        f"Written by `tests/benchmark/starts.py`. {side} × {side} cells of `{JOB}`; the truth is that of {many} starts in each. "
        f"{len(several)} of these cells have several attractors, {np.mean(several):.2f} on average, and alone are compared; labels z count as one "
        "attractor each. *Random starts*: what the binomial distribution says of as many independent ones.",
        "\n".join(lines),
        "From one line to the next there are four times as many starts: independent ones would err half as much.",
        f"![error against time]({path.with_suffix('.png').name})"]) + "\n"


if __name__ == "__main__":
    main()
