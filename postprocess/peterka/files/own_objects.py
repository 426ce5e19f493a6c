"""Inspects an untrusted HDF5 file before any data are read: every object must
have exactly one plain link, every dataset its own storage inside the file.

Thus a file cannot request more memory than its own length, nor make this program read other files.
"""

import os
import resource
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import h5py
import numpy as np

# Planes of cells, one per attractor slot; all other datasets store a cell's values contiguously.
STACKED = {"attractor_regime", "attractor_impacts", "attractor_period", "attractor_peak_force_ratio", "basin_share",
           "critical_kick", "critical_kick_phase", "critical_kick_tried", "critical_kick_direction", "critical_kick_lower", "attractor_status",
           "attractor_orbit_displacement", "attractor_orbit_velocity", "attractor_certified", "attractor_peak_force_lower_ratio",
           "attractor_peak_force_upper_ratio", "attractor_impact_speed_lower", "attractor_impact_speed_upper", "attractor_stability_margin", "mean_life_s", "mean_life_error_s", "mean_life_least_s", "outcome_regime", "outcome_impacts",
           "outcome_period", "outcome_probability"}
SPARE = 2**28  # bytes allowed for reading small items, beyond the file's own length


class NotOwn(Exception):
    """The reason for refusal, without the file's name."""


@dataclass(frozen=True)
class Storage:
    """Location of a dataset's numbers in the file: contiguous, or chunk after chunk if chunked.

    `shape`, `chunk`: (rows, columns, values per cell), None if not chunked.
    `stacked`: a chunk is stored plane after plane, not cell after cell."""

    begin: int
    size: int
    value_bytes: int
    shape: tuple[int, ...] | None = None
    chunk: tuple[int, ...] | None = None
    stacked: bool = False

    @property
    def grid(self) -> tuple[int, ...]:
        """Numbers of chunks along rows and columns of a chunked dataset."""
        assert self.shape is not None and self.chunk is not None
        return tuple(-(-side // step) for side, step in zip(self.shape[:2], self.chunk[:2]))


@contextmanager
def bounded_memory(file_size: int) -> Iterator[None]:
    """Caps memory while attributes are read: a variable-length text states its own length, and HDF5 allocates that much unchecked."""
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    with open("/proc/self/statm", encoding="ascii") as pages:
        limit = int(pages.read().split()[0]) * os.sysconf("SC_PAGE_SIZE") + 2 * file_size + SPARE
    if soft != resource.RLIM_INFINITY:
        limit = min(limit, soft)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def storages(file: h5py.File, file_size: int) -> dict[str, Storage | None]:
    """{path: Storage, or None for a group} of all objects, each group
    before its members, in bytewise order of the names. Raises NotOwn."""
    found: dict[str, Storage | None] = {"/": None}
    addresses = {_address(file["/"])}
    _walk(file["/"], "", found, addresses, file_size)
    end, last = 1, ""  # the file begins with its superblock
    stored = [(path, storage) for path, storage in found.items() if storage and storage.size]
    for path, storage in sorted(stored, key=lambda item: item[1].begin):
        if storage.begin < end or storage.begin + storage.size > file_size:
            raise NotOwn(f"keeps {path.lstrip('/')} where {last or 'nothing of it'} lies")
        end, last = storage.begin + storage.size, path.lstrip("/")
    return found


def _walk(group: h5py.Group, path: str, found: dict[str, Storage | None], addresses: set[int], file_size: int) -> None:
    _check_attributes(group, path or "/", file_size)
    for name in sorted(_texts(group, path), key=lambda text: text.encode("utf-8", "surrogateescape")):
        child = f"{path}/{name}"
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise NotOwn(f"has no dataset {child[1:]} of its own, but a link")
        item = group[name]
        if _address(item) in addresses:
            raise NotOwn(f"has two names for one object, {child[1:]}")
        addresses.add(_address(item))
        if isinstance(item, h5py.Group):
            found[child] = None
            _walk(item, child, found, addresses, file_size)
        elif isinstance(item, h5py.Dataset):
            found[child] = _storage(item, child[1:], file_size)
            _check_attributes(item, child, file_size)
        else:
            raise NotOwn(f"has {child[1:]}, which is neither a group nor a dataset")


def _texts(names: Iterable[Any], path: str) -> list[str]:
    """The names as a list; h5py returns bytes for invalid UTF-8."""
    found = list(names)
    if not all(isinstance(name, str) for name in found):
        raise NotOwn(f"has a name in {path or '/'} that is no text")
    return found


def _address(item: h5py.Group | h5py.Dataset) -> int:
    return int(h5py.h5o.get_info(item.id).addr)


def _check_attributes(item: h5py.Group | h5py.Dataset, path: str, file_size: int) -> None:
    for name in _texts(item.attrs, path):
        attribute = h5py.h5a.open(item.id, name.encode())
        count = int(np.prod(attribute.shape, dtype=float))
        if max(attribute.get_storage_size(), count * attribute.get_type().get_size()) > file_size:
            raise NotOwn(f"has attributes of {path} that are larger than itself")


def _storage(dataset: h5py.Dataset, name: str, file_size: int) -> Storage:
    creation = dataset.id.get_create_plist()
    if dataset.is_virtual or dataset.external:
        raise NotOwn(f"keeps {name} in another file")
    size = dataset.id.get_storage_size()
    value_bytes = dataset.id.get_type().get_size()
    layout = creation.get_layout()
    wanted = float(value_bytes) * np.prod(dataset.shape or (1,), dtype=float)
    if creation.get_nfilters() or layout not in (h5py.h5d.CONTIGUOUS, h5py.h5d.CHUNKED) or dataset.shape is None:
        raise NotOwn(f"keeps {name} in a way that no file of peterka has")
    if size > file_size or wanted > size:
        raise NotOwn(f"is too short for what it says of {name}")
    if layout == h5py.h5d.CONTIGUOUS:
        return Storage(dataset.id.get_offset() or 0, size, value_bytes)
    return _chunked(dataset, name, size, value_bytes)


def _chunked(dataset: h5py.Dataset, name: str, size: int, value_bytes: int) -> Storage:
    shape, chunk = ((*sides, 1)[:3] if len(sides) > 1 else (1, sides[0], 1) for sides in (dataset.shape, dataset.chunks))
    stacked = name in STACKED and len(dataset.shape) == 3
    if stacked:
        shape, chunk = ((*sides[1:], sides[0]) for sides in (shape, chunk))
    storage = Storage(0, size, value_bytes, shape, chunk, stacked)
    chunk_bytes = value_bytes * chunk[0] * chunk[1] * chunk[2]
    count = storage.grid[0] * storage.grid[1]
    last = tuple((side - 1) // step * step for side, step in zip(dataset.shape, dataset.chunks))
    first = dataset.id.get_chunk_info_by_coord((0,) * len(dataset.shape))
    end = dataset.id.get_chunk_info_by_coord(last)
    in_order = first.byte_offset is not None and end.byte_offset == first.byte_offset + (count - 1) * chunk_bytes
    if len(dataset.shape) > 3 or chunk[2] != shape[2] or size != count * chunk_bytes or not in_order:
        raise NotOwn(f"keeps {name} in chunks that no file of peterka has")
    return Storage(first.byte_offset, size, value_bytes, shape, chunk, stacked)
