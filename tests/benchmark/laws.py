#!/usr/bin/env python3
"""What rigid stops, rigs of their own and starts cost, as ratios over the paper's stop: a page. jobs/benchmark.sh calls it; it can be run
alone, in a few minutes:

    tests/benchmark/laws.py --build build --results results --page postprocess/examples/laws.md [--quick]
"""

import re
from dataclasses import dataclass
from statistics import median

import h5py
import numpy as np
from bench import ROOT, Bench, markdown, page_arguments  # makes the package in postprocess importable

from peterka.scaling.run_record import read_record

USUAL, QUICK = (256, 24, 9), (64, 8, 3)  # cells per side of a map, and of one with starts; rounds
LINEAR = "[hammer]\ncubic_stiffness_n_per_m3 = 0.0\n"
RIGID = '[contact]\nlaw = "restitution"\ncoefficient = 0.32\n'
STARTS = "[starts]\ncount = 64\ndisplacement_ratio = [-4.0, 0.0]\nvelocity_ratio = [-4.0, 4.0]\n"


def axis(name, first, last, points, scale="linear"):
    return f'[axes.{name}]\nfrom = {first}\nto = {last}\npoints = {points}\nscale = "{scale}"\n'


@dataclass(frozen=True)
class Kind:
    """A job, and the cells on which its time is counted: all are those of the paper's rig with springs of 170 mm."""

    tables: str
    cells: int


def kinds(points, few):
    frequency = axis("frequency_ratio", 0.5, 4.5, points)
    plane = frequency + axis("gap_ratio", 0.0, 5.0, points)
    window = axis("frequency_ratio", 0.5, 4.5, few) + axis("gap_ratio", 0.0, 5.0, few)
    near = "[operating_point]\ngap_ratio = 0.5\n"
    return {
        "plane": Kind(plane, points**2),
        "linear": Kind(LINEAR + plane, points**2),
        "rigid": Kind(LINEAR + RIGID + plane, points**2),
        "stiffness": Kind(near + frequency + axis("contact.stiffness_n_per_m", 4e6, 4e7, points, "log"), points**2),
        "damping": Kind(near + frequency + axis("hammer.damping_ratio", 0.005, 0.05, points), points**2),
        "starts": Kind(LINEAR + STARTS + window, 64 * few**2),
        "rigid starts": Kind(LINEAR + RIGID + STARTS + window, 64 * few**2)}


@dataclass(frozen=True)
class Cost:
    """Of a cell or a start: µs on one core, forcing cycles."""

    time: float
    cycles: float


def cost(bench, name, kind):
    job, file = bench.results / f"laws_{name.replace(' ', '_')}.toml", bench.results / f"laws_{name.replace(' ', '_')}.h5"
    job.write_text(f'schema = 1\nkind = "map"\ntitle = "{name}"\nrig = "{ROOT}/jobs/rigs/170mm.toml"\n' + kind.tables, encoding="utf-8")
    bench.output("mpirun", "-n", 1, bench.build / "peterka", "run", job, "--output", file, "--fresh", "--quiet")
    with h5py.File(file) as opened:
        cycles = float(np.sum(opened["cycles"][:])) / kind.cells
    return Cost(1e6 * read_record(file).seconds / kind.cells, cycles)


def rows_of(costs):
    """[ratio, measured, smallest and largest of the rounds, goal], in words. costs: {kind: [Cost of each round]}."""
    def row(words, goal, value, over):
        ratios = [value(one) / value(other) for one, other in zip(*over)]
        return [words, f"{median(ratios):.2f}", f"{min(ratios):.2f} to {max(ratios):.2f}", f"{goal:g}"]

    def of_cell(one):
        return one.time

    def of_cycle(one):
        return one.time / one.cycles

    return [row("a cell with a rigid stop, over the same cell with the paper's, both with linear springs", 1.2, of_cell,
                (costs["rigid"], costs["linear"])),
            row("a cycle where each cell has its own stiffness of the stop, over one of the paper's plane", 2.0, of_cycle,
                (costs["stiffness"], costs["plane"])),
            row("a cycle where each cell has its own damping ratio, over one of the paper's plane", 1.5, of_cycle,
                (costs["damping"], costs["plane"])),
            row("a start of a rigid stop, over one of the paper's, both with linear springs", 1.5, of_cell,
                (costs["rigid starts"], costs["starts"]))]


def error_beside_time(bench, rounds):
    """Rows (engine, µs per cycle, relative error) of the kernel on a rigid and on the paper's stop."""
    lines = bench.output(bench.build / "tests" / "batch_cycles", rounds).splitlines()
    found = [re.match(r"(batch, .*?)\s{2,}([\d.e+-]+)\s+([\d.e+-]+)", line) for line in lines]
    return [[each[1], f"{float(each[2]):.3g}", f"{float(each[3]):.0e}"] for each in found
            if each and "split" not in each[1]]


def main():
    arguments = page_arguments(__doc__)
    bench = Bench(arguments.build.resolve(), arguments.results.resolve())
    points, few, rounds = QUICK if arguments.quick else USUAL
    every = kinds(points, few)
    costs = {name: [] for name in every}
    for _ in range(rounds):
        for name, kind in every.items():
            costs[name].append(cost(bench, name, kind))
    text = "\n\n".join([
        "# What laws and rigs cost",
        f"Written by `tests/benchmark/laws.py`. Solving alone, on one rank; {points} × {points} cells of the plane of `jobs/peterka_170mm.toml`, or "
        f"of its frequencies and another parameter at gap/A₀ = 0.5; {few} × {few} cells with 64 starts. The kinds take turns: medians of {rounds} "
        "rounds, and the smallest and largest ratio of a round.",
        markdown(["ratio", "measured", "of a round", "goal"], rows_of(costs)),
        markdown(["what", "µs of a core", "forcing cycles"],
                 [[f"{'a start' if 'starts' in name else 'a cell'}, {name.replace(' starts', '').replace('starts', 'linear')}",
                   f"{median(each.time for each in costs[name]):.2f}", f"{costs[name][0].cycles:.1f}"] for name in every]),
        "A forcing cycle in the kernel with force and Jacobian, on eight regular cells of the rig: time beside error, of the peak force "
        "against long double, on a rigid stop of the impact speed.",
        markdown(["kernel", "µs per cycle and cell", "relative error"], error_beside_time(bench, rounds))])
    arguments.page.write_text(text + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
