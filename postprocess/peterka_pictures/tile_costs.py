"""Computing time of every tile of a plane, or of a finer grid of the same plane, in the order in which they are dealt.

On a finer grid each measured tile stands for the block of smaller tiles that cover its part of the plane; a tile of
16 x 16 cells costs there what it costs here. Tiles at the border that hold fewer cells count as whole ones.
"""

from itertools import count, islice
from math import gcd

import numpy as np

TILE = 16  # cells along a side
ROW_SHARE, COLUMN_SHARE = 0.7548776662466927, 0.5698402909980532  # of the plane, from one tile dealt to the next
PIECE = 1 << 20  # tiles looked up at once


class TileCosts:
    """`seconds` [rows][columns] of the measured tiles; `shape` of the finer grid's tiles, default: the measured one."""

    def __init__(self, seconds, shape=None):
        seconds = np.asarray(seconds, dtype=float)
        rows, columns = shape or seconds.shape
        measured_row = np.arange(rows) * seconds.shape[0] // rows
        measured_column = np.arange(columns) * seconds.shape[1] // columns
        self.count = rows * columns
        self._before = np.zeros(self.count + 1)  # [s]; by turn
        stride = deal_stride(rows, columns)
        for first in range(0, self.count, PIECE):
            end = min(first + PIECE, self.count)
            row, column = np.divmod(np.arange(first, end) * stride % self.count, columns)
            costs = seconds[measured_row[row], measured_column[column]]
            self._before[first + 1:end + 1] = self._before[first] + np.cumsum(costs)
        self.total = float(self._before[-1])  # s
        self.dearest = float(seconds[np.unique(measured_row)][:, np.unique(measured_column)].max())  # s

    def before(self, turn):
        """Time of all tiles dealt before this turn, 0 to count [s]."""
        return float(self._before[turn])

    def turn_after(self, seconds):
        """The first turn before which the tiles take longer than this; count + 1 where all of them don't."""
        return int(np.searchsorted(self._before, seconds, side="right"))


def deal_stride(rows, columns):
    """From one tile dealt to the next, modulo all tiles; the program's rule (src/parallel/deal_order.cpp)."""
    tiles = rows * columns
    if tiles < 2:
        return 1
    wanted = int(ROW_SHARE * rows + 0.5) * columns + int(COLUMN_SHARE * columns + 0.5)
    strides = (stride for stride in count(max(wanted % tiles, 1)) if gcd(stride, tiles) == 1)
    return max(islice(strides, 16), key=lambda stride: _spread(stride, rows, columns))


def _spread(stride, rows, columns):
    """The least squared distance of two tiles times the turns between them, up to 256, in a plane without edges."""
    tiles = rows * columns
    turns = np.arange(1, min(tiles - 1, 256) + 1)
    row, column = np.divmod(turns * stride % tiles, columns)
    up, along = np.minimum(row, rows - row) / rows, np.minimum(column, columns - column) / columns
    return np.min(turns * (up * up + along * along))


def tiles_of(shape):
    """Rows and columns of tiles of a grid of (rows, columns) cells."""
    return tuple(-(-side // TILE) for side in shape)


def whole_tiles(seconds, shape):
    """Times per tile in number order (n,), of a grid of (rows, columns) cells, as [rows][columns] of tiles; one cut off
    by the border is scaled up to a whole one."""
    rows, columns = tiles_of(shape)
    cells = [np.minimum(TILE, side - TILE * np.arange(count)) for side, count in zip(shape, (rows, columns))]
    return np.reshape(seconds, (rows, columns)) * TILE**2 / np.outer(*cells)
