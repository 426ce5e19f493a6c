"""A small synthetic map with [starts]."""

import numpy as np
from picture_samples import CHAOTIC, MISSING, NO_IMPACT, orbit, write_map
from sealing import SealedFile

EMPTY = (-128, -1, -1)
# For each cell: attractors with their shares.
CELLS = [[[(NO_IMPACT, 1.0)], [(orbit(1, 2), 0.75), (NO_IMPACT, 0.25)], [(NO_IMPACT, 0.75), (orbit(1, 2), 0.25)]],
         [[(CHAOTIC, 0.5), (orbit(1, 1), 0.25), (NO_IMPACT, 0.25)], [(orbit(1, 1), 1.0)], []]]
KICKS = [[[], [0.5], [np.nan, 0.125]], [[np.nan, np.nan], [np.nan], []]]


def write_attractors(path, shares=None, kicks=True, cells=CELLS, **attributes):
    """These cells, two rows of three, with 4 slots; [start] ends on the first attractor of each."""
    slots = np.full((4, 2, 3, 3), EMPTY)
    share, kick = np.zeros((4, 2, 3)), np.full((4, 2, 3), np.nan)
    for row, column in np.ndindex(2, 3):
        for slot, (label, part) in enumerate(cells[row][column]):
            slots[slot, row, column], share[slot, row, column] = label, part
        kick[: len(KICKS[row][column]), row, column] = KICKS[row][column]
    first = [[cell[0][0] if cell else MISSING for cell in row] for row in cells]
    write_map(path, first, **attributes)
    with SealedFile(path, "r+") as file:
        file.create_dataset("attractor", data=np.arange(4, dtype="i4")).make_scale("attractor")
        count = np.array([[len(cell) or -1 for cell in row] for row in cells], dtype="i4")
        found = {"attractors": count, "start_attractor": np.minimum(count - 1, 0).astype("i4"),
                 "attractor_regime": slots[..., 0].astype("i1"), "attractor_impacts": slots[..., 1].astype("i4"),
                 "attractor_period": slots[..., 2].astype("i4"), "attractor_peak_force_ratio": kick,
                 "basin_share": share if shares is None else shares}
        if kicks:
            found |= {"critical_kick": kick, "critical_kick_tried": np.where(slots[..., 0] == 1, 4.5, np.nan)}
        for name, values in found.items():
            dataset = file.create_dataset(name, data=values)
            for index, scale in enumerate(("attractor", "gap_ratio", "frequency_ratio")[-values.ndim:]):
                dataset.dims[index].attach_scale(file[scale])
    return path
