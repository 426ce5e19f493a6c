"""Where two files over the same plane differ: regime, z = p/q or peak force. Darker is more.

Forces are those of cells with the same label; where rigs differ, forces of the second file are divided by the median
factor first, and the legend says by which. A block of a reduced picture shows the largest difference in it.
"""

import numpy as np

from . import axes
from .comparison import bands, force_difference, has_lasting_force, label_codes, there
from .reduce import LIMIT, block_size, largest, with_edges

WIDTH = 3.7  # in
SMALL, LARGE = 0.01, 0.1  # of the peak force
SAME, FORCE, MUCH_FORCE, ORBIT, REGIME, MISSING = range(6)
COLOURS = ["#F2F2F2", "#F0E442", "#E69F00", "#0072B2", "#1A1A1A", "#FFFFFF"]


def draw(first, second, comparison):
    """The picture as a Figure, with the share of each kind of difference."""
    scale = comparison.scale if abs(comparison.scale - 1) > SMALL else 1.0
    block = block_size(first.shape, LIMIT)
    counts, pieces = np.zeros(len(COLOURS), dtype=np.int64), []
    for _, a, b in bands(first, second, block):
        kinds = _kinds(a, b, scale)
        counts += np.bincount(kinds.ravel(), minlength=len(COLOURS))
        pieces.append(largest(kinds.astype(float), block).astype(np.uint8))
    reduced = with_edges(first, np.concatenate(pieces), block)
    handles = [axes.legend_patch(f"{name} ({axes.percent(counts[kind] / counts.sum())})", COLOURS[kind], kind == MISSING)
               for kind, name in enumerate(_names(scale)) if counts[kind]]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, [(handles, 1, None)])
    axes.show_classes(ax, reduced, COLOURS, MISSING)
    axes.label_axes(ax, first, second_scales=False)
    axes.write_title(figure, first, f"against: {second.title}")
    return figure


def _names(scale):
    forces = f"peak force/{scale:.4g}" if scale != 1 else "peak force"
    return [f"same z, {forces} within {100 * SMALL:g} %", f"same z, {forces} off by up to {100 * LARGE:g} %",
            f"same z, {forces} off by more", "same regime, other z", "other regime", "not in both files"]


def _kinds(a, b, scale):
    same = label_codes(**a) == label_codes(**b)
    forced = same & has_lasting_force(a, b)
    difference = np.zeros(same.shape)
    difference[forced] = force_difference(b["peak_force_ratio"][forced] / a["peak_force_ratio"][forced], scale)
    kinds = np.where(difference > LARGE, MUCH_FORCE, np.where(difference > SMALL, FORCE, SAME))
    kinds = np.where(same, kinds, np.where(a["regime"] == b["regime"], ORBIT, REGIME))
    return np.where(there(a) & there(b), kinds, MISSING)
