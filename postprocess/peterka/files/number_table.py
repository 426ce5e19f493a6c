"""Reads large tables of numbers from untrusted text, block by block, as data loggers write them.

Lines before the table are skipped: it begins at the line of names that the caller recognises, or at the first of several lines that
hold numbers alone, as many in each. A line of units may follow that of names. Separators are those of csv_table, or spaces; unless
commas separate, numbers may have decimal commas. Empty cells, NaN and "-" or "--" are missing numbers.
"""

import csv
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..arrays import Reals
from ..errors import PeterkaFileError
from .csv_table import LONGEST_HEAD, LONGEST_LINE, SEPARATORS
from .harmless import harmless

BLOCK_BYTES = 2**22
ALIKE = 3  # lines of numbers with which a table without recognised names begins
MISSING = ("", "nan", "-", "--")
_EMPTY_CELL = {mark: re.compile(rf"(?m)(^|{re.escape(mark)})[ ]*(?={re.escape(mark)}|$)") for mark in SEPARATORS}


@dataclass(frozen=True)
class Heading:
    """`names`: cells of the line above the numbers, empty if there is none; `units`: cells of a line of units between; `width`: cells
    of a line of numbers; `first`: number of the first line of numbers; `separator`: one of SEPARATORS, or a space."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    width: int
    first: int
    separator: str

    @property
    def decimal_commas(self) -> bool:
        """Whether a comma in a number is decimal."""
        return self.separator != ","


class NumberTable:
    """A text file of numbers; `blocks` may be read once. `is_name` and `is_unit` tell which cells are names of columns and units.
    Raises PeterkaFileError for what is no such file."""

    def __init__(self, path: Path, what: str, is_name: Callable[[str], bool], is_unit: Callable[[str], bool]) -> None:
        self.path, self.what = path, what
        try:
            self._file: BinaryIO = open(path, "rb")  # noqa: SIM115 - closed by blocks()
            self._head = self._first_lines()
        except OSError as error:
            raise PeterkaFileError(f"{path} cannot be read: {error.strerror or error}") from error
        self.heading = self._found(is_name, is_unit)

    def refusal(self, reason: str, line: int | None = None) -> PeterkaFileError:
        """The exception to raise, with the message 'FILE:line reason'."""
        return PeterkaFileError(f"{self.path}{'' if line is None else f':{line}'} {reason}")

    def blocks(self, names: tuple[str, ...]) -> Iterator[tuple[Reals, Callable[[int], int]]]:
        """(numbers (rows, width), NaN where missing; function that gives the line of a row) of one block after another; `names` of the
        columns in messages."""
        with self._file:
            line, rest = self.heading.first, b"\n".join(self._head[self.heading.first - 1:])
            try:
                while True:
                    block = self._file.read(BLOCK_BYTES)
                    text = rest + block.replace(b"\r", b"")
                    end = text.rfind(b"\n") + 1 if block else len(text)
                    rest = text[end:]
                    if len(rest) > LONGEST_LINE:
                        raise self.refusal(f"is too large for a list of {self.what}: a line of it has more than {LONGEST_LINE} characters")
                    if text[:end].strip():
                        yield self._numbers(text[:end], line, names), _Lines(text[:end], line)
                    line += text.count(b"\n", 0, end)
                    if not block:
                        return
            except OSError as error:
                raise PeterkaFileError(f"{self.path} cannot be read: {error.strerror or error}") from error

    def _first_lines(self) -> list[bytes]:
        lines: list[bytes] = []
        size = 0
        while len(lines) < LONGEST_HEAD + ALIKE:
            line = self._file.readline(LONGEST_LINE + 1)
            if not line:
                break
            if len(line) > LONGEST_LINE:
                raise self.refusal(f"is too large for a list of {self.what}: a line of it has more than {LONGEST_LINE} characters")
            size += len(line)
            lines.append(line.rstrip(b"\r\n"))
        if lines and lines[0].startswith((b"\xff\xfe", b"\xfe\xff")):
            raise self.refusal("is a text in UTF-16; save it in UTF-8")
        if any(b"\0" in line for line in lines):
            raise self.refusal("is not a text; save it as CSV")
        return [*lines, b""] if len(lines) == LONGEST_HEAD + ALIKE else lines

    def _found(self, is_name: Callable[[str], bool], is_unit: Callable[[str], bool]) -> Heading:
        texts = [decoded(line) for line in self._head]
        numeric = next((at for at in range(len(texts)) if _begins(texts, at)), None)
        for at, text in enumerate(texts[:numeric]):
            cells, separator = _cells(text.lstrip("# "))
            if cells and all(is_name(cell) for cell in cells if cell):
                unit_line = at + 1 < len(texts) and _all(_split(texts[at + 1], separator), is_unit)
                first = at + 1 + unit_line
                return self._heading(cells, _split(texts[at + 1], separator) if unit_line else [], first, separator, texts)
        if numeric is None:
            raise self.refusal(f"has no {self.what}; it needs a line with the names of its columns and one for each of them")
        separator = _separator(texts[numeric])
        above = [at for at in range(numeric) if texts[at].strip()]
        units: list[str] = []
        names = _split(texts[above[-1]].lstrip("# "), separator) if above else []
        if names and _all(names, is_unit) and len(above) > 1:
            units, names = names, _split(texts[above[-2]].lstrip("# "), separator)
        width = len(_split(texts[numeric], separator))
        return self._heading(names if len(names) == width else [], units, numeric, separator, texts)

    def _heading(self, names: Sequence[str], units: Sequence[str], first: int, separator: str, texts: Sequence[str]) -> Heading:
        rows = [text for text in texts[first:] if _is_row(text)]
        if not rows:
            raise self.refusal(f"has no {self.what}; it needs a line with the names of its columns and one for each of them")
        if not names or len(names) == 1:
            separator = _separator(rows[0])
        width = len(names) or len(_split(rows[0], separator))
        return Heading(tuple(names), tuple(units), width, first + 1, separator)

    def _numbers(self, block: bytes, line: int, names: Sequence[str]) -> Reals:
        heading, separator = self.heading, self.heading.separator
        try:
            text = block.decode("ascii")
            if '"' in text or "#" in text:
                raise ValueError
            if heading.decimal_commas:
                text = text.replace(",", ".")
            if separator != " ":
                text = "\n".join(row for row in text.split("\n") if row.strip())
                text = _EMPTY_CELL[separator].sub(r"\1nan", text)
            found = np.loadtxt(text.split("\n"), delimiter=None if separator == " " else separator, ndmin=2, comments=None)
            if found.shape[1] == heading.width and not np.isinf(found).any():
                return found
        except ValueError:  # of UnicodeDecodeError, too
            pass
        return self._one_by_one(block, line, names)

    def _one_by_one(self, block: bytes, line: int, names: Sequence[str]) -> Reals:
        rows = []
        for number, text in enumerate(decoded(block).split("\n"), line):
            if not _is_row(text):
                continue
            cells = _split(text, self.heading.separator)
            if len(cells) != self.heading.width:
                commas = "; decimal commas need semicolons, tabs or spaces between columns" * (
                    len(cells) > self.heading.width and self.heading.separator == ",")
                raise self.refusal(f"has {len(cells)} cells, and {_columns(self.heading)}{commas}", number)
            rows.append([self._number(cell, name, number) for cell, name in zip(cells, names)])
        return np.array(rows, dtype=float).reshape(-1, self.heading.width)

    def _number(self, cell: str, name: str, line: int) -> float:
        if cell.lower() in MISSING:
            return math.nan
        try:
            number = _float(cell, self.heading.decimal_commas)
        except ValueError:
            number = math.inf
        if not math.isfinite(number):
            raise self.refusal(f"has '{harmless(cell, 40)}' as {harmless(name, 40)}; a number is needed", line)
        return number


@dataclass(frozen=True)
class _Lines:
    """Gives the line of a row of a block."""

    block: bytes
    first: int

    def __call__(self, row: int) -> int:
        lines = [number for number, text in enumerate(decoded(self.block).split("\n"), self.first) if _is_row(text)]
        return lines[row]


def decoded(line: bytes) -> str:
    """The text of a line in UTF-8, or else in Latin-1, as loggers write m/s²."""
    try:
        return line.decode("utf-8-sig")
    except UnicodeDecodeError:
        return line.decode("latin-1")


def _is_row(text: str) -> bool:
    return bool(text.strip()) and not text.startswith("#")


def _float(cell: str, decimal_commas: bool) -> float:
    if "_" in cell:
        raise ValueError  # Python's own way of writing numbers
    return float(cell.replace(",", ".") if decimal_commas else cell)


def _split(text: str, separator: str) -> list[str]:
    if separator == " ":
        return text.split()
    try:
        cells: list[str] = next(csv.reader([text], delimiter=separator, skipinitialspace=True), [])
    except csv.Error:
        return []
    return [cell.strip() for cell in cells]


def _cells(text: str) -> tuple[list[str], str]:
    """(cells, separator) of a line of names."""
    separator = next((mark for mark in SEPARATORS if mark in text), ",")
    return _split(text, separator), separator


def _separator(text: str) -> str:
    """The separator by which a line falls into numbers; a comma if none does."""
    return next((mark for mark in (*SEPARATORS, " ") if mark in text.strip() and _are_numbers(_split(text, mark), mark)), ",")


def _are_numbers(cells: Sequence[str], separator: str) -> bool:
    try:
        return bool(np.isfinite([_float(cell, separator != ",") for cell in cells if cell.lower() not in MISSING]).sum() > 0)
    except ValueError:
        return False


def _begins(texts: Sequence[str], at: int) -> bool:
    """Whether a table of numbers begins with this line."""
    if not _is_row(texts[at]):
        return False
    separator = _separator(texts[at])
    rows = [_split(text, separator) for text in texts[at:at + ALIKE] if text.strip()]
    return all(len(row) == len(rows[0]) and _are_numbers(row, separator) for row in rows)


def _all(cells: Sequence[str], fits: Callable[[str], bool]) -> bool:
    return any(cells) and all(fits(cell) for cell in cells if cell)


def _columns(heading: Heading) -> str:
    if heading.names:
        return f"its first line names {len(heading.names)} columns"
    return f"the first line of numbers has {heading.width}"
