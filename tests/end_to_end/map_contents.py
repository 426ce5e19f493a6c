"""Contents of a map file, for comparison with another."""

import h5py
import numpy as np

TILE = 16  # rows and columns


def datasets(path):
    """Name -> (type, shape, bytes) of every dataset except /run, which may differ between runs."""
    found = {}

    def collect(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("run/"):
            value = item[()]
            found[name] = (str(item.dtype), item.shape, value if isinstance(value, bytes) else value.tobytes())

    with h5py.File(path, "r") as file:
        file.visititems(collect)
    return found


def assert_same_map(path, expected):
    one, other = datasets(path), datasets(expected)
    assert one.keys() == other.keys()
    assert [name for name in one if one[name] != other[name]] == []


def done_tiles(path):
    with h5py.File(path, "r") as file:
        return int((file["tiles/done"][()] == 1).sum())


def tile_count(path):
    with h5py.File(path, "r") as file:
        return file["tiles/done"].size


def tile_of_cells(file):
    """Tile index of each cell; for a sweep the branch, with [starts] the gap."""
    rows, columns = file["regime"].shape
    if "direction" in file:
        return np.repeat(np.arange(rows)[:, None] // (rows // file["tiles/done"].size), columns, axis=1)
    across = -(-columns // TILE)
    return np.arange(rows)[:, None] // TILE * across + np.arange(columns) // TILE


def cell_fields(file):
    """Names of the datasets stored per cell, with one or several numbers."""
    cells = file["regime"].shape
    return [name for name in file if isinstance(file[name], h5py.Dataset) and file[name].shape[:2] == cells]


def slots_of(file):
    """Names of the datasets stored per attractor of a cell of a map with [starts], or per outcome of its drawn rigs."""
    shapes = [file[name].shape for name in ("basin_share", "outcome_probability") if name in file and "direction" not in file]
    return [name for name in file if isinstance(file[name], h5py.Dataset) and file[name].shape in shapes]


def own_slots(file):
    """{name: values} of the slots found by the cell's own starts or rigs, 0 in all others: a map's contents before it receives
    further known motions (for tests with room for all)."""
    share_of = {name: "outcome_probability" if name.startswith("outcome") else "basin_share" for name in slots_of(file)}
    return {name: np.where(file[share][()] > 0, file[name][()], 0) for name, share in share_of.items()}


def wrong_tiles(path, expected):
    """Number of tiles marked as done that differ from those of the finished map `expected` in what their cells found."""
    with h5py.File(path, "r") as file, h5py.File(expected, "r") as whole:
        tile = tile_of_cells(file)
        differs = np.zeros(tile.shape, dtype=bool)
        ours, theirs = own_slots(file), own_slots(whole)
        for name in ours:
            differs |= (ours[name] != theirs[name]).any(axis=0) & ~np.isnan(theirs[name]).any(axis=0)
        for name in cell_fields(whole):
            one, other = (array[name][()][..., None].view(np.uint8).reshape(*tile.shape, -1) for array in (file, whole))
            differs |= (one != other).any(axis=-1)
        done = file["tiles/done"][()] == 1
        return len(np.unique(tile[differs & done[tile]]))


def take_out(path, tiles):
    """Resets the map to a state in which these tiles are not computed."""
    with h5py.File(path, "r+") as file:
        cells = np.isin(tile_of_cells(file), tiles)
        for name in cell_fields(file):
            values = file[name][()]
            values[cells] = 77
            file[name][...] = values
        for name in slots_of(file):
            values = file[name][()]
            values[:, cells] = 77
            file[name][...] = values
        file["tiles/done"][sorted(tiles)] = 0
        file["summary/finished"][()] = 0
