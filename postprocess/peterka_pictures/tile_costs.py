"""Computing time of every tile of a plane, and of a finer grid of the same plane.

Tiles are numbered row by row, as the program deals them. On a finer grid each measured tile stands for the block of
smaller tiles that cover its part of the plane; a tile of 16 x 16 cells costs there what it costs here. Tiles at the
border that hold fewer cells count as whole ones.
"""

from itertools import accumulate

import numpy as np

TILE = 16  # cells along a side


class TileCosts:
    """`seconds` [rows][columns] of the measured tiles; `shape` of the finer grid's tiles, default: the measured one."""

    def __init__(self, seconds, shape=None):
        seconds = np.asarray(seconds, dtype=float)
        rows, self.columns = shape or seconds.shape
        self.count = rows * self.columns
        self._row = [row * seconds.shape[0] // rows for row in range(rows)]
        columns = [column * seconds.shape[1] // self.columns for column in range(self.columns)]
        self._within = [[0.0, *accumulate(measured)] for measured in seconds[:, columns].tolist()]
        self._before = [0.0, *accumulate(self._within[row][-1] for row in self._row)]
        self._row.append(0)  # row of the place after the last tile
        self.total = self._before[-1]  # s
        self.dearest = float(seconds[np.unique(self._row[:-1])][:, np.unique(columns)].max())  # s

    def before(self, tile):
        """Time of all tiles before this one, 0 to count [s]."""
        row, column = divmod(tile, self.columns)
        return self._before[row] + self._within[self._row[row]][column]


def tiles_of(shape):
    """Rows and columns of tiles of a grid of (rows, columns) cells."""
    return tuple(-(-side // TILE) for side in shape)


def whole_tiles(seconds, shape):
    """Times per tile in number order (n,), of a grid of (rows, columns) cells, as [rows][columns] of tiles; one cut off
    by the border is scaled up to a whole one."""
    rows, columns = tiles_of(shape)
    cells = [np.minimum(TILE, side - TILE * np.arange(count)) for side, count in zip(shape, (rows, columns))]
    return np.reshape(seconds, (rows, columns)) * TILE**2 / np.outer(*cells)
