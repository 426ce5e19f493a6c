"""Draws a number of either sign for each orbit over the plane of a map, on a scale around 0: shared by elasticities and rates.

The scale ends at a percentile of the sizes, for near folds these have no bound; arrows at its ends say so, and words above it how many
cells lie beyond. A block of a reduced map shows what is farthest from 0.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from ..arrays import Integers, Reals
from ..files.regimes import NOT_COMPUTED, PERIODIC
from ..plotting import axes, signed, units
from ..plotting.frames import label_of_bar
from ..plotting.limits import requested
from .field_map import without_value
from .map_file import PeterkaFile
from .reduce import LIMIT, Reduced, block_size, class_picture, largest, with_edges

WIDTH = 3.7  # in
TOP = 95.0  # percentile of the sizes at which the scale ends
WAITING = "not computed yet"


@dataclass(frozen=True)
class SignedField:
    """What to draw: the datasets that it needs; its `values`, (rows, columns), from {dataset: array} of a band and the slice of its rows; a
    `label`; `per`, what they are in, which may name the {unit}; what cells without a value are called, and their colour; and the `unit`,
    told with a prefix where the numbers ask for one, or, where empty, none."""

    datasets: Sequence[str]
    values: Callable[[Mapping[str, NDArray[Any]], slice], Reals]
    label: str
    per: str
    lacking: tuple[str, str]
    unit: str = ""


def draw(file: PeterkaFile, field: SignedField, ax: Axes | None = None) -> Axes | None:
    """The picture as Axes; None if no cell has a value."""
    reduced = _farthest_from_0(file, field)
    values = reduced.image[np.isfinite(reduced.image)]
    if not values.size:
        return None
    top = top_of(reduced.image)
    factor, unit = units.with_prefix(top, field.unit) if field.unit else (1.0, "")
    image, counts = class_picture(file, ["regime"], lambda regime: np.where(regime == NOT_COMPUTED, 1, 0), 2)
    looks = [without_value(field.lacking[1]), without_value("#FFFFFF")]
    handles = [axes.legend_patch(words, looks[n], n == 1) for n, words in enumerate((field.lacking[0], WAITING))
               if counts[n] and _is_seen(image, n, reduced)] + (signed.entries("below 0") if np.nanmin(reduced.image) < 0 else [])
    figure, ax, bar_ax = axes.stack(WIDTH, reduced.image, [(handles, 2, None)], bar=True, ax=ax)
    assert bar_ax is not None
    axes.show_classes(ax, image, looks, 1)
    low, high = requested(file, values, (field.per.format(unit=field.unit), 1.0)) or (-top, top)
    farthest = max(abs(low), abs(high))  # 0 is in the middle whatever the limits
    mesh = signed.show(ax, reduced, reduced.image * factor, Normalize(-farthest * factor, farthest * factor))
    axes.label_axes(ax, file)
    outside = float(np.mean((values < low) | (values > high)))
    bar = signed.draw_bar(figure, bar_ax, mesh, "both" if np.abs(values).max() > farthest else "neither")
    bar.ax.set_xlim(low * factor, high * factor)
    bar.set_label(label_of_bar(field.label, f"({field.per.format(unit=unit)})", " ", WIDTH), fontsize=8)
    bar.ax.set_title(f"{axes.percent(outside)} of these cells beyond the scale" if outside > 0 else "", fontsize=8)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file, axes.operating_point(file), ax)
    return ax


def top_of(values: Reals) -> float:
    """Where the scale of these numbers ends, on either side of 0."""
    sizes = np.abs(values[np.isfinite(values)])
    return float(np.percentile(sizes, TOP)) or 1.0 if sizes.size else 1.0


def _is_seen(image: Reduced, n: int, reduced: Reduced) -> bool:
    return bool(np.any((image.image == n) & ~np.isfinite(reduced.image)))


def _farthest_from_0(file: PeterkaFile, field: SignedField) -> Reduced:
    block, pieces = block_size(file.shape, LIMIT), []
    for first, band in file.bands(["regime", *field.datasets], block):
        regime: Integers = band["regime"]
        values = np.where(regime == PERIODIC, field.values(band, slice(first, first + len(regime))), np.nan)
        up, down = largest(values, block), -largest(-values, block)
        pieces.append(np.where(up >= -down, up, down))
    return with_edges(file, np.concatenate(pieces), block)
