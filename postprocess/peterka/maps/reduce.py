"""Reduces a map of any size to a picture of at most LIMIT cells along each axis, one band of rows at a time.

A map within LIMIT is kept cell by cell. A larger one is divided into square blocks of `block` x `block` cells (smaller at
the end): a block gets its most frequent class, in a tie the first in the table. Class numbers are never averaged. A block of
a field gets its largest value. Shares and the largest value are always taken over all cells. Memory: one band and the
picture, whatever the size of the map.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers, Mask, Reals
from ..plotting import classes
from ..plotting.drawn import Plane
from .map_file import PeterkaFile

LIMIT = 2000


@dataclass(frozen=True)
class Reduced:
    """`image` (rows, columns) of the picture; `row_edges` and `column_edges`, one longer, in the units of the axes; `log`:
    whether rows and columns are logarithmically spaced."""

    image: NDArray[Any]
    row_edges: Reals
    column_edges: Reals
    log: tuple[bool, bool] = (False, False)


@dataclass(frozen=True)
class Largest:
    """The largest value of a field and the centre of its cell."""

    value: float
    row_value: float
    column_value: float
    on_border: bool  # of the plane


def block_size(shape: tuple[int, ...], limit: int = LIMIT) -> int:
    """Side of a block in cells, chosen so that neither side of (rows, columns) has more blocks than the limit."""
    return max(1, -(-max(shape) // limit))


def majority(labels: Integers | Mask, block: int, class_count: int) -> NDArray[np.uint8]:
    """Most frequent label of each block: (rows, columns) of numbers below class_count to (ceil(rows/block), ...)."""
    if block == 1:
        return labels.astype(np.uint8)
    rows, columns = (-(-size // block) for size in labels.shape)
    row, column = (np.arange(size) // block for size in labels.shape)
    place = (row[:, None] * columns + column[None, :]) * class_count + labels
    votes = np.bincount(place.ravel(), minlength=rows * columns * class_count)
    found: NDArray[np.uint8] = votes.reshape(rows, columns, class_count).argmax(axis=2).astype(np.uint8)
    return found


def largest(values: Reals, block: int) -> Reals:
    """Largest value of each block, NaN where it has none: (rows, columns) to (ceil(rows/block), ...)."""
    row_starts, column_starts = (np.arange(0, size, block) for size in values.shape)
    return np.fmax.reduceat(np.fmax.reduceat(values, row_starts, axis=0), column_starts, axis=1)


def class_picture(file: PeterkaFile, names: Sequence[str], classify: Callable[..., Integers | Mask], class_count: int,
                  limit: int = LIMIT) -> tuple[Reduced, NDArray[np.int64]]:
    """The classes of a file, reduced, and the number of its cells in each class, (class_count,).

    `classify` takes the band's arrays `names` and returns labels below class_count, in the shape of the band."""
    block = block_size(file.shape, limit)
    counts = np.zeros(class_count, dtype=np.int64)
    pieces = []
    for _, band in file.bands(names, block):
        labels = classify(*(band[name] for name in names))
        counts += np.bincount(labels.ravel(), minlength=class_count)
        pieces.append(majority(labels, block, class_count))
    return with_edges(file, np.concatenate(pieces), block), counts


def orbit_picture(file: PeterkaFile, names: Sequence[str], classify: Callable[..., Integers] = classes.classify,
                  limit: int = LIMIT) -> tuple[Reduced, NDArray[np.int64]]:
    """As class_picture, of plotting.classes.CLASSES; the p/q that are rarer than those that can be named are "other p/q"."""
    reduced, counts = class_picture(file, names, classify, len(classes.CLASSES), limit)
    shown = classes.named(counts)
    together = np.bincount(shown, weights=counts, minlength=len(shown)).astype(np.int64)
    return replace(reduced, image=shown[reduced.image]), together


def field_picture(file: PeterkaFile, name: str, carries: Callable[..., Mask],
                  limit: int = LIMIT) -> tuple[Reduced, Largest | None, int]:
    """The field `name` of the cells that carry it, reduced, NaN elsewhere; its Largest, or None without any value; and the
    number of cells that should carry it but have no finite value.

    `carries` takes regime, impacts and period of a band and returns a mask of its shape."""
    block = block_size(file.shape, limit)
    best, lacking, pieces = None, 0, []
    for first, band in file.bands(["regime", "impacts", "period", name], block):
        values, carrying = band[name], carries(band["regime"], band["impacts"], band["period"])
        usable = carrying & np.isfinite(values)
        lacking += int(np.sum(carrying & ~usable))
        values = np.where(usable, values, np.nan)
        if usable.any():
            row, column = np.unravel_index(np.nanargmax(values), values.shape)
            if best is None or values[row, column] > best.value:
                on_border = first + row in (0, file.shape[0] - 1) or column in (0, file.shape[1] - 1)
                best = Largest(float(values[row, column]), file.rows.values[first + row], file.columns.values[column],
                               on_border)
        pieces.append(largest(values, block))
    return with_edges(file, np.concatenate(pieces), block), best, lacking


def with_edges(file: Plane, image: Integers | Reals, block: int) -> Reduced:
    """The Reduced of an image of a plane's blocks, (rows, columns)."""
    rows, columns = (np.append(axis.edges[:-1:block], axis.edges[-1]) for axis in (file.rows, file.columns))
    return Reduced(image, rows, columns, (file.rows.log, file.columns.log))
