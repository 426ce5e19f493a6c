"""Verifies the checksum of a file's raw bytes before HDF5 opens it, because HDF5 trusts the texts and references it reads.

src/map_file/raw_bytes.hpp describes the record, the last bytes of a file. Files of layout 2 have none, and a file rewritten
by another program has it elsewhere: such files are first opened in a separate process (trial.py).
"""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import BinaryIO

try:
    import xxhash
except ImportError:  # reported when a file is checked
    xxhash = None  # type: ignore[assignment]

RECORD_SIZE = 4096  # bytes
TITLE = b"peterka bytes 1, XXH3 "
FIRST_LINE = len(TITLE) + 16 + 1
AT_ONCE = 2**20  # bytes
LOST_RECORD = 1  # exit code of trial.py
MOST_SECONDS = 30  # limit for a trial, including start-up
BROKEN = "is damaged: its bytes are not what was written (wrong checksum); compute it again"
_RANGES = re.compile(rb"(?:[0-9]{1,19} [0-9]{1,19}\n)+")


def fault_of(path: Path) -> str | None:
    """Why HDF5 must not open the file, without its name; None if it may. Raises OSError."""
    if xxhash is None:
        return "can't be verified without the Python module xxhash (Debian: apt-get install python3-xxhash)"
    with open(path, "rb") as raw:
        sound = are_sound(raw)
    if sound is None:
        return _fault_in_trial(path)
    return None if sound else BROKEN


def are_sound(raw: BinaryIO) -> bool | None:
    """Whether the bytes match the record; None if there is no record at the end."""
    size = os.fstat(raw.fileno()).st_size
    record = _read(raw, max(size - RECORD_SIZE, 0), RECORD_SIZE)
    if size < RECORD_SIZE or not record.startswith(TITLE):
        return None
    lines = record[FIRST_LINE:]
    ranges = _ranges_in(lines, size)
    return ranges is not None and record[:FIRST_LINE] == first_line(raw, lines, ranges)


def first_line(raw: BinaryIO, lines: bytes, ranges: list[tuple[int, int]]) -> bytes:
    """Checksum of a record with these lines, to its end, and the ranges that they describe."""
    total, at = xxhash.xxh3_64(lines), 0
    for begin, end in ranges:
        while at < begin:
            piece = _read(raw, at, min(AT_ONCE, begin - at))
            total.update(piece)
            at += len(piece)
        at = end
    return TITLE + f"{total.intdigest():016x}\n".encode()


def _ranges_in(lines: bytes, size: int) -> list[tuple[int, int]] | None:
    """The ranges, ascending, disjoint, the record itself in the last one; None if they are not."""
    text = lines.rstrip(b"\0")
    if not _RANGES.fullmatch(text):
        return None
    numbers = [int(word) for word in text.split()]
    in_order = all(low < high for low, high in zip(numbers, numbers[1:]))
    return list(zip(numbers[::2], numbers[1::2])) if in_order and numbers[-2] <= size - RECORD_SIZE < numbers[-1] == size else None


def _read(raw: BinaryIO, offset: int, size: int) -> bytes:
    raw.seek(offset)
    data = raw.read(size)
    if not data and size:
        raise OSError("is cut short")
    return data


def _fault_in_trial(path: Path) -> str | None:
    paths = os.pathsep.join(filter(None, [str(Path(__file__).parents[2]), os.environ.get("PYTHONPATH")]))
    try:
        trial = subprocess.run([sys.executable, "-m", f"{__package__}.trial", str(path.resolve())], timeout=MOST_SECONDS,
                               env=os.environ | {"PYTHONPATH": paths}, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    except subprocess.TimeoutExpired:
        return "is damaged: HDF5 doesn't get through it"
    if trial.returncode == LOST_RECORD:
        return "is damaged: the record of its bytes, at its end, is none (wrong checksum); compute it again"
    return None if trial.returncode == 0 else "is damaged: HDF5 breaks down over it"
