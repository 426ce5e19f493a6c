"""Cost of a cell over that of its cycles in the kernel: machine-independent ratios."""

from statistics import median

import h5py
import numpy as np

# Windows of the paper's plane: (frequency ratio, gap ratio), each as (from, to).
WINDOWS = {"1/1 alone": ((1.3, 2.0), (0.0, 1.0)), "chaos": ((2.90, 3.05), (0.6, 0.8)),
           "never meets the stop": ((2.5, 4.5), (3.0, 5.0))}


def kernel_times(rows):
    """(µs per cycle of the batched engine with linear springs, and of the exact one with peak force) for the best instruction
    set, which comes first in the rows (name, µs, error) of batch_cycles."""
    batched = next(time for name, time, _ in rows if name.startswith("batch, ") and "split" not in name and "rigid" not in name)
    exact = next(time for name, time, _ in rows if name == "exact + peak force")
    return batched, exact


def window_of(name):
    """Settings of the command line for a window."""
    (lowest, highest), (near, far) = WINDOWS[name]
    return (f"axes.frequency_ratio.from={lowest}", f"axes.frequency_ratio.to={highest}", f"axes.gap_ratio.from={near}",
            f"axes.gap_ratio.to={far}")


def cycles_per_cell(file):
    """Mean number of forcing cycles per cell."""
    with h5py.File(file) as opened:
        return float(np.mean(opened["cycles"][:]))


def over_kernel(microseconds, cycles, kernel):
    """Time per cell over that of its cycles in the kernel."""
    return microseconds / (cycles * kernel)


def rows_of(bench, sizes, kernel_rows, refined_over_full):
    """[quantity, value, goal], in words. refined_over_full: None if not measured."""
    kernel, exact = kernel_times(kernel_rows)
    runs = [bench.map(sizes.map, 1, "_ratios") for _ in range(sizes.rounds)]
    cells = sizes.map**2
    wall = 1e6 * median(run.wall for run in runs) / cells
    beyond = 1e6 * median(run.wall - run.solving for run in runs) / cells
    cycles = cycles_per_cell(runs[0].file)
    rows = [["a map's cell, everything included, over its cycles in the kernel", over_kernel(wall, cycles, kernel), 1.5]]
    for name, goal in zip(WINDOWS, (2.5, 1.2, 1)):
        part = [bench.map(sizes.map // 2, 1, "_window", window_of(name)) for _ in range(sizes.rounds)]
        solving = 1e6 * median(run.solving for run in part) / (sizes.map // 2)**2
        if name == "never meets the stop":
            rows.append([f"solving a cell that {name}, in cycles of the kernel", solving / kernel, goal])
        else:
            rows.append([f"solving a cell of a window of {name}, over its cycles in the kernel",
                         over_kernel(solving, cycles_per_cell(part[0].file), kernel), goal])
    rows += [["what a run takes beyond solving, in cycles of the kernel a cell", beyond / kernel, 2],
             ["cycles per cell", cycles, 22]]
    if refined_over_full is not None:
        rows.append(["solving a refined map over the full one", refined_over_full, 0.30])
    rows.append(["kernel: the exact engine with peak force over the batched one", exact / kernel, 60])
    return [[what, f"{value:.3g}", f"{goal:g}"] for what, value, goal in rows]
