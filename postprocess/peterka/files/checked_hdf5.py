"""Reads single items of an untrusted HDF5 file.

Sizes and types are checked before anything is read, and links and data in other files are refused (own_objects.py), so a
file can neither request arbitrary memory nor make this program read other files. Before HDF5 opens it, its raw bytes are
compared with their checksum (raw_bytes.py); verify() compares the whole file with its checksums. Every refusal is a
PeterkaFileError whose message is one sentence with the file's name.
"""

import os
import re
from functools import cached_property
from pathlib import Path
from typing import Any, BinaryIO, Protocol, TypeGuard

# A run may still be writing the file; readers must neither be blocked by a lock nor block the run.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

from ..arrays import Integers
from ..errors import PeterkaFileError
from . import own_objects, raw_bytes, seal
from .harmless import harmless

MAX_CHUNK_BYTES = 2**28  # HDF5 reads whole chunks
NUMBERS = "iuf"
OF_SCALES = ("CLASS", "NAME", "_Netcdf4Dimid")  # attributes of HDF5's dimension scales
INTEGER, REAL = "i", "f"  # kinds of numpy types; no unsigned dataset of the program is ever shown
LARGEST = 1e100  # bound on any number shown: sums and products of larger ones overflow
MAX_TEXT = 20000
_WORD = re.compile(r"[A-Za-z0-9_.+-]{1,60}")
_ERRORS = (OSError, RuntimeError, KeyError, ValueError, TypeError)  # raised by h5py for damaged files


class Content(Protocol):
    """The source the readers use: a file, or a dataset in its place. Members are documented at CheckedFile."""

    path: Path
    may_be_part: bool

    @property
    def is_finished(self) -> bool: ...

    def refusal(self, reason: str) -> PeterkaFileError: ...

    def attribute(self, name: str, of: str = "/") -> str | int | float | None: ...

    def names(self) -> list[str]: ...

    def has(self, name: str) -> bool: ...

    def dataset(self, name: str, shape: tuple[int, ...] | None, kinds: str) -> Any: ...

    def values(self, name: str, rows: Any) -> Any: ...

    def words(self, name: str) -> dict[int, str]: ...

    def text(self, name: str) -> list[str]: ...


class CheckedFile:
    """An open HDF5 file without external objects; call close() after use."""

    may_be_part = False  # whether it may be a part of a file
    _raw: BinaryIO | None = None

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self._file = self._open()
        try:
            self._raw = open(self.path, "rb")  # noqa: SIM115 - closed with the file
            self._size = os.fstat(self._raw.fileno()).st_size
            self._storages = self._own_storages()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Closes the file; no further reads."""
        self._file.close()
        if self._raw:
            self._raw.close()

    def verify(self) -> None:
        """Reads the file once and compares it with its checksums."""
        assert self._raw is not None
        try:
            with own_objects.bounded_memory(self._size):
                seal.verify(self._file, self._raw, self._storages)
        except seal.Broken as broken:
            raise self.refusal(str(broken)) from broken
        except (*_ERRORS, MemoryError) as error:
            raise self.refusal(f"is damaged ({_first_line(error)})") from error

    @cached_property
    def is_finished(self) -> bool:
        """Whether the run that writes it has finished it."""
        try:
            return seal.is_finished(self._file, self._storages)
        except _ERRORS as error:
            raise self.refusal(f"is damaged ({_first_line(error)})") from error

    def refusal(self, reason: str) -> PeterkaFileError:
        """The exception to raise, with the message 'FILE reason'."""
        return PeterkaFileError(f"{self.path} {reason}")

    def attribute(self, name: str, of: str = "/") -> str | int | float | None:
        """A scalar attribute of the root, or of a dataset already checked, as str, int or float; None if absent or of any other type."""
        try:
            with own_objects.bounded_memory(self._size):
                value = self._file[of].attrs.get(name)
        except (*_ERRORS, MemoryError):
            return None
        if isinstance(value, np.ndarray) and value.size == 1:
            value = value.reshape(())[()]
        if isinstance(value, bytes):
            value = value.decode("utf-8", "replace")
        if isinstance(value, str):  # h5py turns invalid UTF-8 into surrogates, which cannot be written
            value = value.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
        return value if isinstance(value, str) or is_number(value) else None

    def numbers(self) -> dict[str, h5py.Dataset]:
        """All numeric datasets, with their groups' names as prefix: {name: dataset}."""
        names = [path.lstrip("/") for path, storage in self._storages.items() if storage is not None]
        return {name: self.dataset(name, None, NUMBERS) for name in names if self._own(name).dtype.kind in NUMBERS}

    def attributes(self, of: str = "/") -> dict[str, Any]:
        """{name: value} of the plain attributes of the root or a dataset: texts, numbers, and lists of numbers."""
        try:
            with own_objects.bounded_memory(self._size):
                found = dict(self._file[of].attrs)
        except (*_ERRORS, MemoryError) as error:
            raise self.refusal(f"is damaged: attributes cannot be read ({_first_line(error)})") from error
        lists = {name: value for name, value in found.items()
                 if isinstance(value, np.ndarray) and value.dtype.kind in NUMBERS and value.ndim == 1}
        plain = {name: self.attribute(name, of) for name in found}
        return lists | {name: value for name, value in plain.items() if value is not None and name not in OF_SCALES}

    def names(self) -> list[str]:
        """Names of all objects at the root."""
        try:
            return sorted(self._file)
        except _ERRORS:
            return []

    def has(self, name: str) -> bool:
        """Whether an object of this name exists; dataset() then checks whether it may be read."""
        try:
            return name in self._file
        except _ERRORS:
            return False

    def dataset(self, name: str, shape: tuple[int, ...] | None, kinds: str) -> h5py.Dataset:
        """The dataset `name`, of this shape (None: any) and of one of these
        kinds of numbers, stored in this file. Raises PeterkaFileError otherwise."""
        try:
            dataset = self._own(name)
            if dataset.dtype.kind not in kinds:
                raise self.refusal(f"has {name} of type {dataset.dtype}")
            if shape is not None and dataset.shape != shape:
                raise self.refusal(f"has {name} of shape {dataset.shape} instead of {shape}")
            if np.prod(dataset.chunks or (1,), dtype=float) * dataset.dtype.itemsize > MAX_CHUNK_BYTES:
                raise self.refusal(f"keeps {name} in chunks that are too large to read")
            return dataset
        except _ERRORS as error:
            raise self.refusal(f"is damaged: {name} cannot be opened ({_first_line(error)})") from error

    def values(self, name: str, rows: Any) -> Any:
        """These rows (a slice, or () for a scalar) of a dataset already checked."""
        try:
            values = self._file[name][rows]
        except (*_ERRORS, MemoryError) as error:
            raise self.refusal(f"is damaged: {name} cannot be read ({_first_line(error)})") from error
        check_range(self, name, values)
        return values

    def words(self, name: str) -> dict[int, str]:
        """{number: word} of a dataset of flags already checked, from its flag_values and flag_meanings."""
        try:
            with own_objects.bounded_memory(self._size):
                numbers = np.ravel(self._file[name].attrs.get("flag_values", ()))
        except (*_ERRORS, MemoryError):
            numbers = np.array([])
        return meanings(self, name, numbers)

    def text(self, name: str) -> list[str]:
        """The printable lines of a scalar text; empty if there is no such text."""
        try:
            dataset = self._own(name)
            value = dataset[()] if dataset.shape == () and dataset.dtype.kind == "S" else b""
        except (PeterkaFileError, *_ERRORS):
            return []
        text = value.decode("utf-8", "replace") if isinstance(value, bytes) else ""
        return [harmless(line, None) for line in text[:MAX_TEXT].splitlines() if line.strip()]

    def _own(self, name: str) -> h5py.Dataset:
        if self._storages.get(f"/{name}") is not None:
            return self._file[name]
        raise self.refusal(f"has no dataset {name}")

    def _own_storages(self) -> dict[str, own_objects.Storage | None]:
        try:
            return own_objects.storages(self._file, self._size)
        except own_objects.NotOwn as reason:
            raise self.refusal(str(reason)) from reason
        except (*_ERRORS, RecursionError) as error:
            raise self.refusal(f"is damaged ({_first_line(error)})") from error

    def _open(self) -> h5py.File:
        if not self.path.exists():
            raise self.refusal("does not exist")
        if self.path.is_dir():
            raise self.refusal("is a directory; a map file (.h5) is needed")
        if not self.path.is_file():
            raise self.refusal("is not a regular file")
        try:
            if fault := raw_bytes.fault_of(self.path):
                raise self.refusal(fault)
            return h5py.File(self.path, "r")
        except PermissionError as error:
            raise self.refusal("may not be read (permission denied)") from error
        except _ERRORS as error:
            raise self.refusal("is cut short" if "truncated" in str(error) else "is not an HDF5 file") from error


def check_range(data: Content, name: str, values: Any) -> None:
    """Refuses numbers from `data` outside the range that this program writes."""
    if values.dtype.kind in REAL and np.any(np.isfinite(values) & (np.abs(values) > LARGEST)):
        raise data.refusal(f"has a {name} beyond {LARGEST:g}, which is no number of this program")


def meanings(data: Content, name: str, numbers: Integers) -> dict[int, str]:
    """{number: word} of a dataset of flags in `data`, from its flag_values and flag_meanings."""
    text = data.attribute("flag_meanings", name)
    words = text.split() if isinstance(text, str) else []
    if not words or len(words) != len(numbers) or numbers.dtype.kind not in INTEGER:
        raise data.refusal(f"doesn't say what the numbers of {name} mean")
    strange = [word for word in words if not _WORD.fullmatch(word)]
    if strange:
        raise data.refusal(f"has {shown(strange[0])} among the meanings of {name}")
    return dict(zip(numbers.tolist(), words))


def is_number(value: object) -> TypeGuard[int | float]:
    """Whether a value is a single number of numpy or Python; booleans are not numbers here."""
    return isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)


def shown(value: object) -> str:
    """A value from the file, shortened to one line for a message."""
    plain = value.tolist() if isinstance(value, (np.generic, np.ndarray)) else value  # numpy 2 would print the type name
    return re.sub(r"\s+", " ", repr(plain))[:60]


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0][:120]
