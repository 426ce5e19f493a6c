"""What a map file holds, for comparing two of them."""

import h5py


def datasets(path):
    """Name -> (type, shape, bytes) of every dataset outside /run, which alone may differ between two runs."""
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
