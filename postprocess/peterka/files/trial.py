"""Lets HDF5 read everything it will read of a file without a raw-byte checksum: headers, attributes, scales.

Runs as a separate program, because HDF5 may crash or hang; raw_bytes.py starts it and examines how it ends.
"""

import os
import resource
import sys

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py

from . import own_objects, seal
from .raw_bytes import LOST_RECORD

MOST_SECONDS = 5  # of CPU time; all headers and texts take milliseconds


def _try_to_read(path: str) -> int:
    size = os.path.getsize(path)
    with h5py.File(path, "r") as file, open(path, "rb") as raw, own_objects.bounded_memory(size):
        storages = own_objects.storages(file, size)
        record = storages.get(seal.RECORD)
        # another program would have moved it
        if record is not None and record.begin + record.size == size:
            return LOST_RECORD
        seal.seal_of(file, raw, storages, whole=False)
    return 0


def main() -> int:
    """Returns LOST_RECORD, or 0 for any file that HDF5 survives, sound or not: soundness is checked when the file is read."""
    used = sum(resource.getrusage(resource.RUSAGE_SELF)[:2])
    resource.setrlimit(resource.RLIMIT_CPU, (int(used) + MOST_SECONDS,) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        return _try_to_read(sys.argv[1])
    except (Exception, MemoryError):
        return 0


if __name__ == "__main__":
    os._exit(main())
