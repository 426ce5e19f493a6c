"""Run data of a finished map file: the time of every tile, the ranks, the wall time of all tiles."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Reals
from ..files.checked_hdf5 import INTEGER, REAL
from ..maps.map_file import PeterkaFile
from .tile_costs import TILE, TILE_OF_LIVES, tiles_of, whole_tiles


@dataclass(frozen=True)
class RunRecord:
    """Run data of a finished map."""

    path: str
    title: str
    shape: tuple[int, int]  # in cells
    tile: int  # cells along the side of a tile
    tile_seconds: Reals  # [rows][columns] of tiles, each scaled to a full tile
    ranks: int
    seconds: float  # wall time of solving and storing the cells

    @property
    def cells(self) -> int:
        """Number of cells of the map."""
        return self.shape[0] * self.shape[1]


def read_record(path: Path) -> RunRecord:
    """The RunRecord of the file at this path; PeterkaFileError where it has none."""
    with PeterkaFile(path) as file:
        if not file.is_complete:
            raise file.refusal("is not complete; a finished map is needed")
        tile = TILE_OF_LIVES if file.data.has("mean_life_least_s") else TILE
        rows, columns = tiles_of(file.shape, tile)
        file.data.dataset("run/tile_seconds", (rows * columns,), REAL)
        file.data.dataset("run/ranks", (), INTEGER)
        file.data.dataset("run/solve_seconds", (), REAL)
        seconds = file.data.values("run/tile_seconds", slice(None))
        ranks, wall = int(file.data.values("run/ranks", ())), float(file.data.values("run/solve_seconds", ()))
        if not np.all(np.isfinite(seconds) & (seconds >= 0)) or not seconds.sum() > 0:
            raise file.refusal("lacks the times of some tiles; a finished map is needed")
        if ranks < 1 or not 0 < wall < np.inf:
            raise file.refusal(f"says it took {ranks} ranks {wall:g} s; a finished map is needed")
        return RunRecord(str(file.path), file.title, file.shape, tile, whole_tiles(seconds, file.shape, tile), ranks, wall)
