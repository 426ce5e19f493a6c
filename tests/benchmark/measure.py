#!/usr/bin/env python3
"""Runs the benchmarks, prints their tables and writes them as a page; jobs/benchmark.sh calls it.

Runs that are compared take turns, and medians of their rounds count, so that other work on the machine disturbs as
little as possible.
"""

import argparse
import os
import platform
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import h5py
import numpy as np

import cycles
import ratios
from bench import JOB, Bench, markdown  # makes the package in postprocess importable
from labels import CHAOTIC, NO_IMPACT, PERIODIC, SUSTAINED, Labels


HUGE = 8192
PLANNED = 65536
# The fastest other program tested, measured once on a 2-core AVX-512 machine, with the same eight cells.
HEYOKA = [("heyoka (Taylor series), one cell", 3.7, 1e-12), ("heyoka (Taylor series), batch of 8", 2.5, 1e-12)]


@dataclass(frozen=True)
class Sizes:
    map: int  # cells along a side
    ratio: int
    memory: tuple
    labels: int  # cells along a side
    refined: tuple  # cells along a side, levels
    rounds: int


USUAL = Sizes(1024, 2048, (1024, 4096), 200, (4097, 4), 5)
QUICK = Sizes(128, 256, (128, 512), 60, (257, 2), 3)
LONG = 20000  # forcing cycles of the reference labels


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--huge", action="store_true")
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--results", type=Path, required=True)
    parser.add_argument("--page", type=Path, required=True)
    arguments = parser.parse_args()
    bench, sizes = Bench(arguments.build, arguments.results), QUICK if arguments.quick else USUAL
    arguments.page.parent.mkdir(parents=True, exist_ok=True)

    sections = [introduction(bench, arguments.quick)]
    for measure in (engines, maps, decisions, refinement, costs, dealing, memory, huge, scaling):
        if measure is huge and not arguments.huge:
            continue
        section = measure(bench, sizes, arguments.page.parent)
        print(f"\n{section}", flush=True)
        sections.append(section)
    arguments.page.write_text("\n\n".join(sections) + "\n", encoding="utf-8")
    print(f"\nThe page is {arguments.page}.")


def introduction(bench, quick):
    version = bench.output(bench.build / "peterka", "--version").strip().splitlines()[0]
    cautious = " with `--quick`: small maps, few rounds, rough numbers" if quick else ""
    return (f"# Benchmarks\n\nWritten by `jobs/benchmark.sh`{cautious}. {version}; {processor()}, {os.cpu_count()} "
            "cores. Compared runs take turns; numbers are medians.")


def engines(bench, sizes, _page):
    """Microseconds per forcing cycle and cell of every engine."""
    lines = bench.output(bench.build / "tests" / "batch_cycles", sizes.rounds).splitlines()
    rows = []
    for line in lines[1:]:
        name, numbers = line[:32].strip(), line[32:].split()
        if len(numbers) == 3:
            rows.append((name, float(numbers[0]), float(numbers[1])))
    bench.cycle_rows = list(rows)
    cvode = next(microseconds for name, microseconds, _ in rows if name.startswith("cvode"))
    rows += [(f"{name}, quoted", microseconds, error) for name, microseconds, error in HEYOKA]
    table = [[name, f"{microseconds:.3g}", f"{error:.0e}", f"{cvode / microseconds:,.1f}"]
             for name, microseconds, error in rows]
    return "\n\n".join([
        "## A forcing cycle",
        "Eight regular cells of the 170 mm rig; the batched engine carries 256 shuffled copies of each. The fastest round "
        "counts. heyoka's figures were measured once on a 2-core AVX-512 machine.",
        markdown(["engine", "µs per cycle and cell", "error in peak force", "times as fast as CVODE"], table),
        "\n".join(line for line in lines[1:] if ":" in line),
    ]).strip()


def maps(bench, sizes, _page):
    """Total time per cell, and the speed-up with more ranks."""
    cells = sizes.map**2
    runs = bench.in_turn(sizes.map, (1, 2), sizes.rounds)
    rows = []
    for ranks, all_rounds in runs.items():
        wall, solving = median(run.wall for run in all_rounds), median(run.solving for run in all_rounds)
        rows.append([f"{sizes.map} × {sizes.map}", str(ranks), f"{wall:.2f}", f"{1e6 * wall * ranks / cells:.2f}",
                     f"{1e6 * solving * ranks / cells:.2f}", ratio(runs, 1, ranks)])
    large = bench.in_turn(sizes.ratio, (1, 2, 8), max(2, sizes.rounds // 2))
    cells = sizes.ratio**2
    for ranks, all_rounds in large.items():
        wall, solving = median(run.wall for run in all_rounds), median(run.solving for run in all_rounds)
        cores = min(ranks, os.cpu_count())
        rows.append([f"{sizes.ratio} × {sizes.ratio}", str(ranks), f"{wall:.2f}", f"{1e6 * wall * cores / cells:.2f}",
                     f"{1e6 * solving * cores / cells:.2f}", ratio(large, 1, ranks)])
    return "\n\n".join([
        "## A map",
        f"The plane of `{JOB}` without its audit. `time` is that of the whole command, with mpirun, starting up and "
        f"writing the file. 8 ranks share {os.cpu_count()} cores.",
        markdown(["cells", "ranks", "time (s)", "µs per cell and core", "solving alone", "solving: 1 rank/this"], rows),
    ])


def ratio(runs, ranks, other):
    """Median over the rounds of the speed-up with `other` ranks."""
    return f"{median(one.solving / two.solving for one, two in zip(runs[ranks], runs[other])):.3f}"


def decisions(bench, sizes, _page):
    """How soon cells are decided, and how their labels compare with a much longer observation."""
    # where chaos cannot end, it is declared after 0.3 of chaos_cycles
    long = ("steady_state.max_cycles=" + str(LONG + 100), "steady_state.chaos_cycles=" + str(LONG * 10 // 3))
    usual = Labels(bench.map(sizes.labels, 2, "_labels").file)
    truth = Labels(bench.map(sizes.labels, 2, "_labels_long", long).file)
    settles = np.isin(truth.regime, [NO_IMPACT, PERIODIC, SUSTAINED])
    chaotic, periodic = usual.regime == CHAOTIC, usual.regime == PERIODIC
    other = periodic & settles & ~truth.same(usual)
    rows = [[name, f"{int(np.sum(chaotic & where))}", *(f"{int(np.sum(chaotic & where & (truth.regime == regime)))}"
                                                        for regime in (NO_IMPACT, PERIODIC))]
            for name, where in (("no impact is possible, too", usual.comes_free), ("impacts go on for ever",
                                                                                  ~usual.comes_free))]
    return "\n\n".join([
        "## Decisions",
        f"{sizes.labels} × {sizes.labels} cells of the same plane, and again with {LONG} cycles before a cell is called "
        f"chaotic. {np.mean(usual.cycles):.1f} cycles per cell, {np.mean(usual.cycles[periodic]):.1f} per periodic one, "
        "Newton's method and measuring included. Periodic cells with another label after the long run: "
        f"{int(np.sum(other))} of {int(np.sum(periodic))}.",
        markdown(["where", "called chaotic", f"no impact within {LONG} cycles", "periodic by then"], rows),
        "The same with fewer `chaos_cycles`: what the certainty of chaos costs.",
        markdown(cycles.SOONER, cycles.called_sooner(bench, sizes, truth)),
    ])


def refinement(bench, sizes, _page):
    """The saving from computing only some of the cells, and its cost in labels."""
    points, levels = sizes.refined
    whole, refined = bench.map(points, 2, "_whole"), bench.map(points, 2, "_refined", [f"refine.levels={levels}"])
    true, found = Labels(whole.file), Labels(refined.file)
    with h5py.File(refined.file) as file:
        computed = np.mean(file["computed"][:])
    wrong = ~found.same(true)
    bench.refined_over_full, bench.refined_file = refined.solving / whole.solving, refined.file
    row = [f"{points} × {points}", str(levels), f"{100 * computed:.2f} %", f"{100 - 100 * np.mean(wrong):.3f} %",
           f"{np.sum(found.cycles) / np.sum(true.cycles):.2f}", f"{refined.solving / whole.solving:.2f}"]
    return "\n\n".join([
        "## Refinement",
        "A refined map against the same one with every cell computed; one run of each.",
        markdown(["cells", "levels", "computed", "labels right", "cycles: refined/whole", "solving: refined/whole"], [row]),
        *([what_is_wrong(true.regime[wrong], found.regime[wrong])] if np.any(wrong) else []),
    ])


def costs(bench, sizes, _page):
    return "\n\n".join([
        "## What a cell costs",
        "Over what its cycles cost in the kernel with peak force and Jacobian, measured in the same run. On one rank; "
        f"{sizes.map} × {sizes.map} cells of the plane, windows of a quarter as many.",
        markdown(["ratio", "measured", "goal"],
                 ratios.rows_of(bench, sizes, bench.cycle_rows, bench.refined_over_full)),
        "Where the map's cycles go, and those of the cells that the refined one computes. What a neighbour's orbit could spare a "
        "computed cell lies in the second row; below it the certainty that is asked for decides (see Decisions).",
        markdown(cycles.WHERE, cycles.by_regime(bench.file_of(sizes.map, 1, "_ratios"), bench.refined_file)),
    ])


def what_is_wrong(true, found):
    """Regimes of cells with a wrong label, in words."""
    def share(regimes, regime):
        return f"{100 * np.mean(regimes == regime):.0f} %"

    return (f"Of the cells with a wrong label {share(true, PERIODIC)} are periodic in the whole map and "
            f"{share(true, NO_IMPACT)} without impact; {share(found, CHAOTIC)} are filled as chaotic.")


def deal_rates(bench, sizes):
    """[(ranks, runs a second, µs of rank 0 per run, µs waited)], medians."""
    rows = []
    for ranks in (2, 4, 8):
        all_rounds = []
        for _ in range(sizes.rounds):
            last = bench.output("mpirun", "-n", ranks, bench.build / "tests" / "deal_rate").splitlines()[-1]
            all_rounds.append([float(number) for number in last.split()[2:]])
        rows.append((ranks, *(median(column) for column in zip(*all_rounds))))
    return rows


def dealing(bench, sizes, _page):
    bench.rates = deal_rates(bench, sizes)
    table = [[str(ranks), f"{rate:,.0f}".replace(",", " "), f"{own:.2f}", f"{waited:.1f}"]
             for ranks, rate, own, waited in bench.rates]
    return "\n\n".join([
        "## Dealing",
        f"Rank 0 deals empty tiles one by one and does nothing else. With more ranks than the {os.cpu_count()} cores all "
        "take turns on them. Rank 0's own time per run then still holds; it includes looks at which nothing has come, the "
        "fewer of them the more ranks ask.",
        markdown(["ranks", "runs a second", "µs of rank 0 per run", "µs that a rank waits for a run"], table),
    ])


def memory(bench, sizes, _page):
    rows = [[f"{points} × {points}", f"{bench.map(points, 1).memory:.0f}"] for points in sizes.memory]
    planned = bench.output(bench.build / "peterka", "check", JOB, "--set", f"axes.frequency_ratio.points={PLANNED}",
                           "--set", f"axes.gap_ratio.points={PLANNED}", "--set", "audit.cells=0")
    told = [line.lstrip("# ") for line in planned.splitlines() if line.startswith("#   ")]
    return "\n\n".join([
        "## Memory",
        "Largest resident memory of a rank while it computes a map.",
        markdown(["cells", "MB"], rows),
        f"`peterka check` of {PLANNED} × {PLANNED} cells:\n\n```\n" + "\n".join(told) + "\n```",
    ])


def huge(bench, _sizes, _page):
    run = bench.map(HUGE, 2)
    return (f"A map of {HUGE} × {HUGE} = {HUGE**2 / 1e6:.0f} million cells on 2 ranks: {run.wall:.0f} s, "
            f"{run.memory:.0f} MB resident in the larger rank.")


def scaling(bench, sizes, page):
    """The measured tiles replayed for many ranks, next to the measurements."""
    own = min(busy for _, _, busy, _ in bench.rates)  # the more runs wait, the fewer polls find nothing
    waited = bench.rates[0][3]
    files = [bench.results / f"benchmark_{sizes.ratio}_on_{ranks}.h5" for ranks in (1, 2)]
    text = bench.output(sys.executable, "postprocess/scaling.py", files[0], "--measured", *files, "--service", own,
                        "--latency", max(waited - own, 0.2) / 2, "--ranks", 1000 if sizes is QUICK else 100000,
                        "--output-dir", bench.results / "pictures", "--formats", "png")
    shutil.copyfile(bench.results / "pictures" / f"{files[0].stem}_scaling.png", page / "scaling.png")
    lines = text.splitlines()
    told = [line for line in lines if "efficiency up to" in line]
    return "\n\n".join(["## Scaling", "\n".join(f"- {line}" for line in told), "![scaling](scaling.png)"])


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.machine())


if __name__ == "__main__":
    main()
