"""Verifies that a file is unchanged since it was written: the checksums of its tiles, and its seal over everything else.

The seal, /summary/checksum, is the XXH3 (64 bits) of the byte sequence described in src/map_file/seal.hpp. An unfinished
file has none; then /summary/frame covers its attributes and coordinates.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, BinaryIO

import h5py
import numpy as np
from numpy.typing import NDArray

from .own_objects import Storage

try:
    import xxhash
except ImportError:  # reported when a file is verified
    xxhash = None  # type: ignore[assignment]

SEAL, FRAME, FINISHED = "/summary/checksum", "/summary/frame", "/summary/finished"
RECORD = "/summary/bytes"  # of raw_bytes.py, which carries its own checksum
ATTRACTOR, RUN = "/attractor", "/run"
TOLD_BY_SCALES = {"DIMENSION_LIST", "REFERENCE_LIST"}
AT_ONCE = 2**22  # bytes


class Broken(Exception):
    """The reason for refusal, without the file's name."""


def verify(file: h5py.File, raw: BinaryIO, storages: Mapping[str, Storage | None]) -> None:
    """`raw`: the open file of the same bytes; `storages`: from own_objects. Raises Broken."""
    if xxhash is None:
        raise Broken("can't be verified without the Python module xxhash (Debian: apt-get install python3-xxhash)")
    finished = is_finished(file, storages)
    place = SEAL if finished else FRAME
    if place not in storages or file[place].dtype != np.uint64 or file[place].shape != ():
        raise Broken("is damaged: it has no checksum of what lies outside its cells")
    if int(file[place][()]) != seal_of(file, raw, storages, whole=finished):
        raise Broken("is damaged: something in it is not what was written (wrong checksum); compute it again")
    _verify_tiles(file, raw, storages)


def is_finished(file: h5py.File, storages: Mapping[str, Storage | None]) -> bool:
    """Whether the run that writes the file has finished it."""
    return bool(FINISHED in storages and file[FINISHED].shape == () and file[FINISHED][()] == 1)


def seal_of(file: h5py.File, raw: BinaryIO, storages: Mapping[str, Storage | None], whole: bool = True) -> int:
    """Checksum of the whole file, or of its frame, which omits the data of all datasets except coordinates."""
    total = xxhash.xxh3_64()
    for path in storages:  # in the order of the seal
        if path == RUN or path.startswith(RUN + "/"):
            continue
        item, storage = file[path], storages[path]
        _add_object(total, item, path, storage)
        is_coordinate = storage is not None and len(item.shape) == 1 and path.count("/") == 1
        if storage is not None and path not in (SEAL, FINISHED, RECORD) and (whole or is_coordinate):
            _add_data(total, path, raw, storage)
    return total.intdigest()


def tile_checksums(file: h5py.File, raw: BinaryIO, storages: Mapping[str, Storage | None]) -> NDArray[np.uint64]:
    """Checksums of all tiles, in their order; none if nothing is stored in tiles."""
    if not any(_is_in_tiles(path, storages) for path in storages):
        return np.zeros(0, np.uint64)
    fields: list[Any] = [storages["/" + name] for name in _names_as_made(file) if _is_in_tiles("/" + name, storages)]
    if any((field.shape[:2], field.chunk[:2]) != (fields[0].shape[:2], fields[0].chunk[:2]) for field in fields):
        raise Broken("is damaged: its tiles are not of one size")
    return np.array([xxhash.xxh3_64_intdigest(tile) for tile in _tiles(raw, fields)], np.uint64)


def _verify_tiles(file: h5py.File, raw: BinaryIO, storages: Mapping[str, Storage | None]) -> None:
    checksums = tile_checksums(file, raw, storages)
    if not len(checksums):
        return
    stored = {}
    for name, kind in (("done", np.int8), ("checksum", np.uint64)):
        if f"/tiles/{name}" not in storages or file[f"tiles/{name}"].dtype != kind:
            raise Broken(f"is damaged: it has no dataset tiles/{name}")
        stored[name] = file[f"tiles/{name}"][()]
        if stored[name].shape != checksums.shape:
            raise Broken(f"has tiles/{name} of shape {stored[name].shape} instead of {checksums.shape}")
    wrong = int(np.sum((stored["done"] == 1) & (stored["checksum"] != checksums)))
    if wrong:
        raise Broken(f"is damaged: {wrong} of its tiles are not what was written (wrong checksum); compute it again")


def _is_in_tiles(path: str, storages: Mapping[str, Storage | None]) -> bool:
    storage = storages.get(path)
    return storage is not None and storage.chunk is not None and path.count("/") == 1 and path != ATTRACTOR


def _names_as_made(file: h5py.File) -> list[str]:
    names, root = [], file["/"]
    root.id.links.iterate(lambda name: names.append(name.decode()), idx_type=h5py.h5.INDEX_CRT_ORDER)
    return names


def _tiles(raw: BinaryIO, fields: Sequence[Storage]) -> Iterator[bytes]:
    """The bytes of each tile, field after field, row by row."""
    down, across = fields[0].grid
    for row in range(down):
        spans = [_row_of_chunks(raw, field, row) for field in fields]
        for column in range(across):
            yield b"".join(_cropped(field, span, row, column) for field, span in zip(fields, spans))


def _row_of_chunks(raw: BinaryIO, field: Storage, row: int) -> NDArray[np.uint8]:
    assert field.chunk is not None
    size = field.size // field.grid[0]
    data = _read(raw, field.begin + row * size, size)
    return np.frombuffer(data, np.uint8).reshape(field.grid[1], field.chunk[0], -1)


def _cropped(field: Storage, span: NDArray[np.uint8], row: int, column: int) -> bytes:
    assert field.shape is not None and field.chunk is not None
    rows, columns = (min(step, side - at * step) for side, step, at in zip(field.shape, field.chunk, (row, column)))
    if field.stacked:
        planes = span[column].reshape(field.chunk[2], field.chunk[0], -1)
        data: bytes = planes[:, :rows, : columns * field.value_bytes].tobytes()
        return data
    return span[column, :rows, : columns * field.chunk[2] * field.value_bytes].tobytes()


def _read(raw: BinaryIO, offset: int, size: int) -> bytes:
    raw.seek(offset)
    data = raw.read(size)
    if len(data) != size:
        raise Broken("is cut short")
    return data


def _number(value: int) -> bytes:
    return int(value).to_bytes(8, "little")


def _text(value: bytes | str) -> bytes:
    data = value if isinstance(value, bytes) else value.encode("utf-8", "surrogateescape")
    return _number(len(data)) + data


def _shape(sides: Sequence[int]) -> bytes:
    return _number(len(sides)) + b"".join(map(_number, sides))


def _kind(type_id: h5py.h5t.TypeID) -> str:
    """The type's name as in the seal; raises Broken for types that no file of peterka contains."""
    size = type_id.get_size()
    if isinstance(type_id, h5py.h5t.TypeStringID):
        return "text" if type_id.is_variable_str() else f"S{size}"
    if size <= 8 and (size == 1 or isinstance(type_id, (h5py.h5t.TypeIntegerID, h5py.h5t.TypeFloatID))
                      and type_id.get_order() == h5py.h5t.ORDER_LE):
        if isinstance(type_id, h5py.h5t.TypeFloatID):
            return f"f{size}"
        if isinstance(type_id, h5py.h5t.TypeIntegerID):
            return f"{'iu'[type_id.get_sign() == h5py.h5t.SGN_NONE]}{size}"
    raise Broken("has a type that no file of peterka has")


def _add_object(total: xxhash.xxh3_64, item: h5py.Group | h5py.Dataset, path: str, storage: Storage | None) -> None:
    total.update(_text("group" if storage is None else "dataset") + _text(path))
    names = sorted(name.encode() for name in item.attrs if name not in TOLD_BY_SCALES)
    total.update(_number(len(names)))
    for name in names:
        _add_attribute(total, h5py.h5a.open(item.id, name), name)
    if storage is None:
        return
    total.update(_text(_kind(item.id.get_type())) + _shape(item.shape))
    for dimension in item.dims:
        scales = dimension.values()
        if any(scale.name is None for scale in scales):
            raise Broken("has a coordinate that is in none of its groups")
        total.update(_number(len(scales)) + b"".join(_text(scale.name) for scale in scales))


def _add_attribute(total: xxhash.xxh3_64, attribute: h5py.h5a.AttrID, name: bytes) -> None:
    kind = _kind(attribute.get_type())
    total.update(_text(name) + _text(kind) + _shape(attribute.shape))
    if kind != "text":
        value = np.empty(attribute.shape, attribute.dtype)
        attribute.read(value)
        total.update(value.tobytes())
        return
    if int(np.prod(attribute.shape)) != 1:
        raise Broken("has a list of texts as attribute")
    value = np.empty(attribute.shape, attribute.dtype)
    attribute.read(value)
    text = value.ravel()[0]
    total.update(_text(text if isinstance(text, (bytes, str)) else b""))


def _add_data(total: xxhash.xxh3_64, path: str, raw: BinaryIO, storage: Storage) -> None:
    if storage.chunk is not None:
        if path == ATTRACTOR:
            for tile in _tiles(raw, [storage]):
                total.update(tile)
        return
    for done in range(0, storage.size, AT_ONCE):
        total.update(_read(raw, storage.begin + done, min(AT_ONCE, storage.size - done)))
