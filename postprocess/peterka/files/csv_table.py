"""A table from an untrusted CSV file: a header line with the names of its columns, then one line per row.

The separator is the comma, the semicolon or the tab, whichever the header uses; with semicolons or tabs numbers may have
decimal commas. Empty lines and lines that begin with # are skipped. Unreadable input raises PeterkaFileError.
"""

import csv
import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from ..errors import PeterkaFileError
from .harmless import harmless
from .nearest import instead_of

SEPARATORS = (";", "\t", ",")
LONGEST_LINE = 10_000
LONGEST_HEAD = 1_000  # lines before the header


@dataclass(frozen=True)
class CsvTable:
    """`rows`: (line number, {column: text}), at least one."""

    path: Path
    names: tuple[str, ...]
    rows: list[tuple[int, dict[str, str]]]
    decimal_commas: bool

    def refusal(self, reason: str, line: int | None = None) -> PeterkaFileError:
        """The exception to raise, with the message 'FILE:line reason'."""
        return PeterkaFileError(f"{self.path}{'' if line is None else f':{line}'} {reason}")

    def number(self, line: int, cells: dict[str, str], name: str) -> float | None:
        """The finite number in a cell; None if the cell is empty."""
        text = cells[name].strip()
        if not text:
            return None
        try:
            number = float(text.replace(",", ".") if self.decimal_commas else text)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise self.refusal(f"has '{harmless(text, 40)}' as {name}; a number is needed", line)
        return number


def read_csv_table(path: Path, known: Collection[str], what: str, largest_bytes: int) -> CsvTable:
    """The table of a file; `known` are the permitted column names, `what` describes the rows in messages."""
    text = _text(path, what, largest_bytes)
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1)
             if line.strip() and not line.startswith("#")]
    if len(lines) < 2:
        raise PeterkaFileError(f"{path} has no {what}; it needs a line with the names of its columns and one for each of them")
    separator = next((mark for mark in SEPARATORS if mark in lines[0][1]), ",")
    try:
        cells = list(csv.reader([line for _, line in lines], delimiter=separator))
    except csv.Error as error:
        raise PeterkaFileError(f"{path} is no list of {what}: {error}") from error
    names = tuple(name.strip() for name in cells[0])
    _check_names(path, names, known)
    for (number, _), row in zip(lines[1:], cells[1:]):
        if len(row) != len(names):
            raise PeterkaFileError(f"{path}:{number} has {len(row)} cells, and its first line names {len(names)} columns")
    rows = [(number, dict(zip(names, row))) for (number, _), row in zip(lines[1:], cells[1:])]
    return CsvTable(path, names, rows, separator != ",")


def column_names(path: Path) -> list[str]:
    """The column names of the file's first line, unchecked."""
    try:
        with open(path, encoding="utf-8-sig", errors="replace") as file:
            # An endless file may have no line end, or only empty lines.
            lines = islice(iter(lambda: file.readline(LONGEST_LINE), ""), LONGEST_HEAD)
            first = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    except OSError as error:
        raise PeterkaFileError(f"{path} cannot be read: {error.strerror or error}") from error
    separator = next((mark for mark in SEPARATORS if mark in first), ",")
    return [name.strip() for name in first.split(separator)]


def _text(path: Path, what: str, largest_bytes: int) -> str:
    try:
        with open(path, "rb") as file:
            content = file.read(largest_bytes + 1)
        if len(content) > largest_bytes:
            raise PeterkaFileError(f"{path} is too large for a list of {what}")
        return content.decode("utf-8-sig")
    except OSError as error:
        raise PeterkaFileError(f"{path} cannot be read: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise PeterkaFileError(f"{path} is not a text in UTF-8; save it as CSV") from error


def _check_names(path: Path, names: Sequence[str], known: Collection[str]) -> None:
    for name in names:
        if name not in known:
            raise PeterkaFileError(f"{path} has the unknown column {instead_of([name], known, 'it may have')}")
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise PeterkaFileError(f"{path} has {min(twice)} twice; each quantity has one column")
