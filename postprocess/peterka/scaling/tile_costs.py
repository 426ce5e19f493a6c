"""Computing time of every tile of a plane, or of a finer grid of the same plane, in dealing order.

On a finer grid each measured tile represents the block of smaller tiles that cover its part of the plane; a tile of as many
cells costs the same on both grids. Tiles at the border with fewer cells count as full ones.
"""

from copy import copy
from itertools import count, islice
from math import gcd
from typing import Self

import numpy as np

from ..arrays import Integers, Reals

TILE = 16  # cells along a side
TILE_OF_LIVES = 4  # in a map with [noise]
ROW_SHARE, COLUMN_SHARE = 0.7548776662466927, 0.5698402909980532  # of the plane, between successive tiles (R2 sequence, Roberts 2018)
PIECE = 1 << 20  # tiles looked up at once
MANY = 3500  # tiles per rank from which they are dealt by squares


class TileCosts:
    """`seconds` [rows][columns] of the measured tiles; `shape` of the finer grid's tiles, default: the measured one; in the
    order for this number of `ranks`."""

    def __init__(self, seconds: Reals, shape: tuple[int, int] | None = None, ranks: int = 1) -> None:
        seconds = np.asarray(seconds, dtype=float)
        rows, columns = shape or seconds.shape
        measured_row = np.arange(rows) * seconds.shape[0] // rows
        measured_column = np.arange(columns) * seconds.shape[1] // columns
        self.count = rows * columns
        self._before = np.zeros(self.count + 1)  # [s], cumulative by turn; turns without a tile count as 0
        order = DealOrder(rows, columns, ranks)
        end = 0
        for first in range(0, order.turns, PIECE):
            row, column = order.places(np.arange(first, min(first + PIECE, order.turns)))
            costs = seconds[measured_row[row], measured_column[column]]
            begin, end = end, end + len(costs)
            self._before[begin + 1:end + 1] = self._before[begin] + np.cumsum(costs)
        self.total = float(self._before[-1])  # s
        self.dearest = float(seconds[np.unique(measured_row)][:, np.unique(measured_column)].max())  # s

    def measured_again(self, random: np.random.Generator, noise: float) -> Self:
        """TileCosts with randomly perturbed times (relative standard deviation)."""
        again = copy(self)
        costs = np.diff(self._before) * np.maximum(1 + noise * random.standard_normal(self.count), 0)
        again._before = np.concatenate([[0.0], np.cumsum(costs)])
        again.total = float(again._before[-1])
        return again

    def before(self, turn: int) -> float:
        """Total time of the tiles dealt before this turn, 0 to count [s]."""
        return float(self._before[turn])

    def turn_after(self, seconds: float) -> int:
        """The first turn before which the tiles take longer than this; count + 1 if there is none."""
        return int(np.searchsorted(self._before, seconds, side="right"))


class DealOrder:
    """The order in which the program deals tiles; its rules are those of src/parallel/deal_order.cpp."""

    def __init__(self, rows: int, columns: int, ranks: int) -> None:
        self._grid = rows, columns
        self._side = 4 if goes_by_squares(rows * columns, ranks) else 1
        self._squares = -(-rows // self._side), -(-columns // self._side)
        squares = self._squares[0] * self._squares[1]
        self.turns = squares * self._side**2
        self._stride = deal_stride(*self._squares)
        self._first_alone = self.turns if self._side == 1 else squares * 3 // 4 * self._side**2
        self._alone = max(self.turns - self._first_alone, 1)
        self._alone_stride = deal_stride(1, self._alone)

    def places(self, turns: Integers) -> tuple[Integers, Integers]:
        """Rows and columns of the tiles of these turns, omitting turns without a tile."""
        alone = (turns - self._first_alone) * self._alone_stride % self._alone
        places = np.where(turns < self._first_alone, turns, self._first_alone + alone)
        square, within = np.divmod(places, self._side**2)
        square = square * self._stride % (self._squares[0] * self._squares[1])
        row = square // self._squares[1] * self._side + within // self._side
        column = square % self._squares[1] * self._side + within % self._side
        exists = (row < self._grid[0]) & (column < self._grid[1])
        return row[exists], column[exists]


def goes_by_squares(tiles: int, ranks: int) -> bool:
    """Whether tiles are dealt in squares of several: if there are many per rank."""
    return tiles // ranks >= MANY


def deal_stride(rows: int, columns: int) -> int:
    """Stride from one square to the next, modulo all squares; scatters them evenly over the plane."""
    squares = rows * columns
    if squares < 2:
        return 1
    wanted = int(ROW_SHARE * rows + 0.5) * columns + int(COLUMN_SHARE * columns + 0.5)
    strides = (stride for stride in count(max(wanted % squares, 1)) if gcd(stride, squares) == 1)
    return max(islice(strides, 16), key=lambda stride: _spread(stride, rows, columns))


def _spread(stride: int, rows: int, columns: int) -> float:
    """The minimum over up to 256 turns of the squared distance of two squares times the turns between them, in a periodic plane."""
    squares = rows * columns
    turns = np.arange(1, min(squares - 1, 256) + 1)
    row, column = np.divmod(turns * stride % squares, columns)
    up, along = np.minimum(row, rows - row) / rows, np.minimum(column, columns - column) / columns
    value: float = np.min(turns * (up * up + along * along))
    return value


def tiles_of(shape: tuple[int, int], tile: int = TILE) -> tuple[int, int]:
    """Rows and columns of tiles with so many cells along a side for a grid of (rows, columns) cells."""
    rows, columns = shape
    return -(-rows // tile), -(-columns // tile)


def whole_tiles(seconds: Reals, shape: tuple[int, int], tile: int = TILE) -> Reals:
    """Times per tile in number order (n,), for a grid of (rows, columns) cells, as [rows][columns] of tiles; tiles cut by
    the border are scaled to full size."""
    rows, columns = tiles_of(shape, tile)
    cells = [np.minimum(tile, side - tile * np.arange(count)) for side, count in zip(shape, (rows, columns))]
    values: Reals = np.reshape(seconds, (rows, columns)) * tile**2 / np.outer(*cells)
    return values
