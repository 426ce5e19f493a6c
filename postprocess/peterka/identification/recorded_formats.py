"""Recordings that are no texts: MATLAB's .mat (versions 4 to 7.2) and WAV, read by scipy.

The columns of a .mat file are its vectors of one length, or those of its only matrix, which have no names. Those of a WAV file are its
channels, in shares of full scale; its header gives the sample rate. Files of measuring systems that need a library of their own
are refused in words.
"""

import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy.io
from numpy.typing import NDArray
from scipy.io import wavfile

from ..arrays import Reals
from ..errors import PeterkaFileError

BLOCK_ROWS = 2**18
LARGEST_MATLAB = 2**31  # bytes of its numbers, which are read at once
FOREIGN = {".uff": "UFF 58", ".unv": "UFF 58", ".tdms": "TDMS", ".mf4": "MDF", ".xlsx": "Excel"}


@dataclass(frozen=True)
class Sheet:
    """Columns of numbers: `names` of them, empty if they have none; `width`; `rate` [Hz] if the file tells it; `values` gives the rows
    between two as an array (rows, width)."""

    path: Path
    names: tuple[str, ...]
    width: int
    count: int
    rate: float | None
    values: Callable[[int, int], Reals]

    def refusal(self, reason: str, line: int | None = None) -> PeterkaFileError:
        """The exception to raise; such files have no lines."""
        return PeterkaFileError(f"{self.path} {reason}")

    def blocks(self) -> Iterator[Reals]:
        """The rows, block by block."""
        for first in range(0, self.count, BLOCK_ROWS):
            yield self.values(first, min(self.count, first + BLOCK_ROWS))


def read_sheet(path: Path) -> Sheet | None:
    """The Sheet of a file, None if its name isn't that of such a format. Raises PeterkaFileError for an unusable one."""
    suffix = path.suffix.lower()
    if suffix in FOREIGN:
        raise PeterkaFileError(f"{path} is a file of {FOREIGN[suffix]}, which isn't read here; export it as CSV, .mat or WAV")
    reader = {".mat": _matlab, ".wav": _wav}.get(suffix)
    if reader is None:
        return None
    try:
        with open(path, "rb"):
            pass
    except OSError as error:
        raise PeterkaFileError(f"{path} cannot be read: {error.strerror or error}") from error
    try:
        return reader(path)
    except PeterkaFileError:
        raise
    except NotImplementedError:
        raise PeterkaFileError(f"{path} is of MATLAB's version 7.3; save it with -v7, or as CSV") from None
    except Exception as error:  # scipy's readers raise what they meet in a damaged file
        raise PeterkaFileError(f"{path} can't be read as {suffix[1:]}: {type(error).__name__}; it may be damaged") from error


def _matlab(path: Path) -> Sheet:
    shapes = {name: (shape, kind) for name, shape, kind in scipy.io.whosmat(path)}
    size = sum(8 * int(np.prod(shape)) for shape, _ in shapes.values())
    if size > LARGEST_MATLAB:
        raise PeterkaFileError(f"{path} has {size / 2**30:.3g} GB of numbers, which are read at once; save a part of it, or CSV")
    numeric = [name for name, (shape, kind) in shapes.items() if kind.startswith(("double", "single", "int", "uint")) and len(shape) == 2]
    vectors = [name for name in numeric if min(shapes[name][0]) == 1 and max(shapes[name][0]) > 1]
    matrices = [name for name in numeric if min(shapes[name][0]) > 1]
    told = ", ".join(f"{name} {'x'.join(map(str, shape))} {kind}" for name, (shape, kind) in list(shapes.items())[:10]) or "nothing"
    if vectors:
        counts = {max(shapes[name][0]) for name in vectors}
        if len(counts) > 1:
            raise PeterkaFileError(f"{path} has vectors of several lengths: {told}; save those of one recording")
        read = _loaded(path, vectors)
        columns = [_real(path, name, read[name]).ravel() for name in vectors]
        return Sheet(path, tuple(vectors), len(columns), len(columns[0]), None,
                     lambda first, last: np.transpose([column[first:last] for column in columns]).astype(float))
    if len(matrices) != 1:
        raise PeterkaFileError(f"{path} needs one vector for each signal, named as the columns of a table, or one matrix of them; "
                               f"it has {told}")
    table = _real(path, matrices[0], _loaded(path, matrices)[matrices[0]])
    table = table if table.shape[0] >= table.shape[1] else table.T
    return Sheet(path, (), table.shape[1], table.shape[0], None, lambda first, last: np.asarray(table[first:last], dtype=float))


def _loaded(path: Path, names: list[str]) -> dict[str, Any]:
    read: dict[str, Any] = scipy.io.loadmat(path, variable_names=names)
    return read


def _real(path: Path, name: str, values: NDArray[Any]) -> NDArray[Any]:
    if np.iscomplexobj(values):
        raise PeterkaFileError(f"{path} has complex numbers in {name}; a recording has real ones")
    return values


def _wav(path: Path) -> Sheet:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", wavfile.WavFileWarning)  # of chunks that aren't samples
        try:
            rate, samples = wavfile.read(path, mmap=True)
        except ValueError:  # samples of 24 bits can't be mapped
            rate, samples = wavfile.read(path)
    table = samples.reshape(len(samples), -1)
    middle, full = {"u": (128.0, 128.0), "i": (0.0, 2.0 ** (8 * table.dtype.itemsize - 1))}.get(table.dtype.kind, (0.0, 1.0))
    if not rate > 0 or not len(table):
        raise PeterkaFileError(f"{path} has {len(table)} samples at {rate} Hz")

    def values(first: int, last: int) -> Reals:
        rows: Reals = (np.asarray(table[first:last], dtype=float) - middle) / full
        return rows

    return Sheet(path, (), table.shape[1], len(table), float(rate), values)
