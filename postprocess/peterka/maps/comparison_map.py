"""Picture of the differences between two files at their common points: regime, z = p/q, or peak force.

Cells with the same label and a lasting force are coloured by B's force over A's: blue if weaker, red if stronger, white if
equal; in the grey palette the darker the farther from equal, and with strokes if weaker. Other cells have a flat colour. A block of a reduced picture shows its largest difference.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from numpy.typing import NDArray

from ..arrays import Integers, Reals, ma
from ..plotting import axes, signed, style, units
from .common_plane import CommonPlane
from .comparison import WORDS, Comparison, bands, differing_keys, force_ratio, has_lasting_force, label_codes, there
from .field_map import without_value
from .map_file import PeterkaFile
from .reduce import LIMIT, Reduced, block_size, largest, with_edges

WIDTH = 3.7  # in
MOST = 99  # % of the cells' differences lie within the scale
LEAST_SPAN, WIDEST_SPAN = 1.01, 10.0  # the scale goes from 1/span to span
SAME, ORBIT, REGIME, MISSING = range(4)
COLOURS = ["#CFCFCF", "#B8A000", "#1A1A1A", "#FFFFFF"]
HATCHES = ["", "//", "xx", ""]  # in the grey palette
NAMES_OF_KINDS = ["same label, no number compared", "same regime, other z", "other regime", "not in both files"]


@style.using()
def draw(first: PeterkaFile, second: PeterkaFile, comparison: Comparison) -> Figure:
    """The picture as a Figure, with the share of each kind of difference."""
    plane = comparison.plane
    block = block_size(plane.shape, LIMIT)
    counts, kinds, ratios = np.zeros(len(COLOURS), dtype=np.int64), [], []
    for _, a, b in bands(plane, comparison.quantity, block):
        kind, ratio = _kinds(a, b)
        counts += np.bincount(kind[np.isnan(ratio)], minlength=len(COLOURS))
        ratios.append(_farthest(ratio, block))
        kinds.append(largest(kind.astype(float), block).astype(np.uint8))
    reduced = with_edges(plane, np.concatenate(kinds), block)
    total = counts.sum() + len(comparison.force_ratio)
    looks = [without_value(*look) for look in zip(COLOURS, HATCHES)]
    handles = [axes.legend_patch(f"{name} ({axes.percent(counts[kind] / total)})", looks[kind], kind == MISSING)
               for kind, name in enumerate(NAMES_OF_KINDS) if counts[kind]]
    has_forces = len(comparison.force_ratio) > 0
    handles += signed.entries("B weaker than A") if has_forces and comparison.force_ratio.min() < 1 else []
    figure, ax, bar_ax = axes.stack(WIDTH, reduced.image, [(handles, 1, None)], bar=has_forces)
    axes.show_classes(ax, reduced, looks, MISSING)
    if has_forces:
        image = ma.masked_where(reduced.image != SAME, ma.masked_invalid(np.concatenate(ratios)))
        _draw_ratios(figure, ax, bar_ax, reduced, image, comparison)
    axes.label_axes(ax, plane)
    axes.write_title(figure, first, "\n".join(_words(first, second, plane)))
    return figure


def _words(first: PeterkaFile, second: PeterkaFile, plane: CommonPlane) -> list[str]:
    """Below A's title: B's title, if different, the files, and the differing keys."""
    title = [second.title] if second.title != first.title else []
    return [*title, f"A: {first.path.stem}, B: {second.path.stem}", *differing_keys(first, second, is_whole=False),
            *filter(None, [plane.in_words])]


def _draw_ratios(figure: Figure, ax: Axes, bar_ax: Axes, reduced: Reduced, image: Reals, comparison: Comparison) -> None:
    ratio = comparison.force_ratio
    logarithm = np.abs(np.log(ratio))
    span = float(np.clip(np.exp(np.percentile(logarithm, MOST)), LEAST_SPAN, WIDEST_SPAN))
    mesh = signed.show(ax, reduced, ma.filled(image, np.nan), LogNorm(1 / span, span))
    bar = signed.draw_bar(figure, bar_ax, mesh, "both" if logarithm.max() > np.log(span) else "neither")
    bar.set_label(f"{WORDS[comparison.quantity]} of B over A, same $z$ (median {units.number(float(np.median(ratio)))})", fontsize=8)
    bar_ax.xaxis.set_major_locator(FixedLocator(np.geomspace(1 / span, span, 5)))
    bar_ax.xaxis.set_minor_locator(NullLocator())
    bar_ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3f}" if span < 1.1 else f"{value:.2f}"))


def _farthest(ratio: Reals, block: int) -> Reals:
    """For each block, the ratio farthest from 1; NaN where it has none."""
    if block == 1:
        return ratio
    logarithm = np.log(ratio)
    up, down = largest(logarithm, block), -largest(-logarithm, block)
    values: Reals = np.exp(np.where(up >= -down, up, down))
    return values


def _kinds(a: Mapping[str, NDArray[Any]], b: Mapping[str, NDArray[Any]]) -> tuple[Integers, Reals]:
    """A number for each cell, and B's force over A's; NaN where they are not comparable."""
    same = label_codes(**a) == label_codes(**b)
    both = there(a) & there(b)
    forced = both & same & has_lasting_force(a, b)
    ratio = np.where(forced, force_ratio(a, b), np.nan)
    kinds = np.where(same, SAME, np.where(a["regime"] == b["regime"], ORBIT, REGIME))
    return np.where(both, kinds, MISSING), ratio
