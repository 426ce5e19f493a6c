"""Has HDF5 read all that it will read of a file without a checksum over its raw bytes: headers, attributes, scales.

A program of its own, which HDF5 may crash or keep for ever: raw_bytes.py runs it and looks at how it ends.
"""

import os
import resource
import sys

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py

from . import own_objects, seal
from .raw_bytes import LOST_RECORD

MOST_SECONDS = 5  # of the processor; all headers and texts take milliseconds


def _try_to_read(path):
    size = os.path.getsize(path)
    with h5py.File(path, "r") as file, open(path, "rb") as raw, own_objects.bounded_memory(size):
        storages = own_objects.storages(file, size)
        record = storages.get(seal.RECORD)
        # another program would have put it elsewhere
        if record is not None and record.begin + record.size == size:
            return LOST_RECORD
        seal.seal_of(file, raw, storages, whole=False)
    return 0


def main() -> int:
    """LOST_RECORD, or 0 for whatever HDF5 gets through, sound or not: that is told where the file is read in earnest."""
    used = sum(resource.getrusage(resource.RUSAGE_SELF)[:2])
    resource.setrlimit(resource.RLIMIT_CPU, (int(used) + MOST_SECONDS,) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        return _try_to_read(sys.argv[1])
    except (Exception, MemoryError):
        return 0


if __name__ == "__main__":
    os._exit(main())
