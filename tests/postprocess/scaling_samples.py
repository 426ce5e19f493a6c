"""Runs for testing scaling: tiles of uneven cost, and map files that record them."""

import numpy as np
from peterka.scaling.dealing import Machine
from peterka.scaling.tile_costs import tiles_of
from picture_samples import write_map
from sealing import SealedFile

REAL = Machine(service=3e-6, latency=2e-6, look=1e-4)


def uneven(rows=8, columns=8, seed=2):
    return 1e-3 * (0.2 + np.random.default_rng(seed).exponential(1.0, (rows, columns)))


def write_run(path, side=64, tile_seconds=None, ranks=1, seconds=1.0):
    """A map file of side x side cells with the record of its run."""
    write_map(path, np.zeros((side, side, 3), int).tolist())
    count = tiles_of((side, side))[0] ** 2
    with SealedFile(path, "r+") as file:
        file["run/tile_seconds"] = np.full(count, 1e-3) if tile_seconds is None else np.array(tile_seconds, float)
        file["run/ranks"] = np.int32(ranks)
        file["run/solve_seconds"] = float(seconds)
    return path
