"""Sample files are sealed on closing, as a knowledgeable attacker would: their contents themselves must be checked."""

from contextlib import suppress
from pathlib import Path

import h5py
import numpy as np
from peterka.files import own_objects, raw_bytes, seal

SPOILT = (own_objects.NotOwn, seal.Broken, OSError, RuntimeError, KeyError, ValueError, TypeError)


class SealedFile(h5py.File):
    """h5py.File for writing."""

    def __exit__(self, *problem):
        path = self.filename
        super().__exit__(*problem)
        if problem[0] is None:
            seal_file(path)


def seal_file(path):
    """Writes the seal and the record of bytes; a file that cannot have one remains without."""
    with suppress(*SPOILT):
        write_seal(path)
    with suppress(*SPOILT):
        write_record(path)


def write_seal(path):
    """Seals the contents."""
    with h5py.File(path, "r+") as file:
        group = file.require_group("summary")
        for name, kind in (("finished", np.int8), ("checksum", np.uint64)):
            if name not in group:
                group.create_dataset(name, data=kind(1))
        if "bytes" not in group:
            group.create_dataset("bytes", data=no_record())
    with h5py.File(path, "r") as file, open(path, "rb") as raw:
        value = seal.seal_of(file, raw, own_objects.storages(file, path_size(raw)))
    with h5py.File(path, "r+") as file:
        if file["summary/checksum"].dtype == np.uint64:  # otherwise the checksum itself is the fault
            file["summary/checksum"][()] = value


def unfinish(path):
    """As a run leaves it that has all cells, but not what follows them."""
    with h5py.File(path, "r+") as file:
        file["summary/finished"][()] = 0
        file["summary"].create_dataset("frame", data=np.uint64(0))
    with h5py.File(path, "r") as file, open(path, "rb") as raw:
        value = seal.seal_of(file, raw, own_objects.storages(file, path_size(raw)), whole=False)
    with h5py.File(path, "r+") as file:
        file["summary/frame"][()] = value
    write_record(path)


def write_record(path):
    """Checksum over all bytes except the record itself, which becomes the end of the file."""
    with h5py.File(path, "r+") as file:
        if "summary/bytes" in file:
            del file["summary/bytes"]
    with h5py.File(path, "r+") as file:  # reopened, HDF5 knows of no hole to place it in
        place = file.create_dataset("summary/bytes", data=no_record()).id.get_offset()
    assert place + raw_bytes.RECORD_SIZE == Path(path).stat().st_size
    renew_record(path)


def renew_record(path):
    """For a file whose bytes were changed: its ranges stay; without ranges, all but the record itself is summed."""
    with open(path, "r+b") as raw:
        size = path_size(raw)
        place = size - raw_bytes.RECORD_SIZE
        raw.seek(place)
        record = raw.read()
        lines = f"{place} {size}\n".encode().ljust(raw_bytes.RECORD_SIZE - raw_bytes.FIRST_LINE, b"\0")
        if record.startswith(raw_bytes.TITLE):
            lines = record[raw_bytes.FIRST_LINE:]
        numbers = [int(word) for word in lines.rstrip(b"\0").split()]
        first = raw_bytes.first_line(raw, lines, list(zip(numbers[::2], numbers[1::2])))
        raw.seek(place)
        raw.write(first + lines)


def no_record():
    return np.array(b"", f"S{raw_bytes.RECORD_SIZE}")


def path_size(raw):
    return raw.seek(0, 2)
