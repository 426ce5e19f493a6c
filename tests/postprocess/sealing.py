"""Sample files are sealed when they are closed, as a stranger would who knows how: what is in them must be judged."""

import h5py
import numpy as np
from peterka.files import own_objects, seal

SPOILT = (own_objects.NotOwn, seal.Broken, OSError, RuntimeError, KeyError, ValueError, TypeError)


class SealedFile(h5py.File):
    """h5py.File for writing."""

    def __exit__(self, *problem):
        path = self.filename
        super().__exit__(*problem)
        if problem[0] is None:
            seal_file(path)


def seal_file(path):
    """Writes the seal; a file that can't have one stays without."""
    try:
        with h5py.File(path, "r+") as file:
            group = file.require_group("summary")
            for name, kind in (("finished", np.int8), ("checksum", np.uint64)):
                if name not in group:
                    group.create_dataset(name, data=kind(1))
        with h5py.File(path, "r") as file, open(path, "rb") as raw:
            value = seal.seal_of(file, raw, own_objects.storages(file, path_size(raw)))
        with h5py.File(path, "r+") as file:
            if file["summary/checksum"].dtype == np.uint64:  # else it is what is wrong with the file
                file["summary/checksum"][()] = value
    except SPOILT:
        pass


def path_size(raw):
    return raw.seek(0, 2)
