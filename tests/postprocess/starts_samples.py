"""Adds attractors to synthetic maps."""

import h5py
import numpy as np
from sealing import seal_file

EMPTY = (-128, 0, 0)


def add_starts(path, slots, shares, forces, start_attractor):
    """Adds the datasets of [starts]: slots[k][row][column] is (regime, p, q)."""
    slots = np.array(slots)
    with h5py.File(path, "r+") as file:
        file["attractor"] = np.arange(len(slots), dtype="i4")
        file["attractors"] = np.sum(slots[..., 0] != EMPTY[0], axis=0, dtype="i4")
        for name, kind, values in (("attractor_regime", "i1", slots[..., 0]), ("attractor_impacts", "i4", slots[..., 1]),
                                   ("attractor_period", "i4", slots[..., 2]), ("basin_share", "f8", shares),
                                   ("attractor_peak_force_ratio", "f8", forces), ("start_attractor", "i4", start_attractor)):
            file[name] = np.array(values).astype(kind)
    seal_file(path)
    return path
