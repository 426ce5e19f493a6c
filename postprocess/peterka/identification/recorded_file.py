"""Reads recordings from tables as text, .mat and WAV files; `columns` describes their columns, `recorded_formats` files that are no text.

Numbers go block by block into unnamed temporary files, so that memory stays bounded however long a recording is: what is short is then
held in memory, what is long mapped from there.
"""

import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import IO

import numpy as np

from ..arrays import Integers, Reals
from ..errors import PeterkaFileError
from ..files.number_table import NumberTable
from .columns import SIGNALS, TIMES, Column, Layout, columns_of, is_name, is_unit
from .recorded_formats import Sheet, read_sheet
from .recording import AT_ONCE, Recording, UnevenTimes, even_times

HELD = 2_000_000  # samples of a column that are held in memory
MOST_SAMPLES = 2**28
Blocks = Iterator[tuple[Reals, Callable[[int], int] | None]]


def read_recording(path: Path, begin: float | None, end: float | None, layout: Layout = Layout()) -> Recording:
    """The Recording of a file between the times begin and end [s] (None: unbounded). Raises PeterkaFileError for an unusable file."""
    sheet = read_sheet(path)
    table: Sheet | NumberTable = sheet or NumberTable(path, "samples", is_name, is_unit)
    try:
        columns, rate = _columns(table, layout)
    except ValueError as reason:
        raise table.refusal(str(reason)) from None
    if isinstance(table, Sheet):
        blocks: Blocks = ((rows, None) for rows in table.blocks())
    else:
        blocks = table.blocks(_names(table, columns))
    numbers = _spooled(table, blocks, columns)
    time = numbers.pop("time", None)
    if rate is not None:
        return Recording(path, 0.0, 1 / rate, numbers).cut(begin, end)
    if time is None:
        raise table.refusal("has no samples")
    try:
        times = even_times(time)
    except UnevenTimes as reason:
        raise table.refusal(f"has times that don't ascend evenly{reason}; record at one sample rate") from None
    if times.count > len(time):
        numbers = {name: _with_gaps(values, times.places(time), times.count) for name, values in numbers.items()}
    return Recording(path, times.begin, times.step, numbers).cut(begin, end)


def _columns(table: NumberTable | Sheet, layout: Layout) -> tuple[list[Column | None], float | None]:
    """(Columns, sample rate [Hz] or None) of a table. Raises ValueError with the reason."""
    if isinstance(table, Sheet):
        names, width, rate = table.names, table.width, layout.rate or table.rate
        if table.rate and layout.rate:
            raise ValueError(f"has its own rate, {table.rate:g} Hz, so that --rate-hz doesn't apply")
        if table.rate and layout.columns is not None and (named := [name for name in layout.columns if name != "-"]):
            unscaled = [name for name in named if name.split("[")[0].strip() not in layout.scale]
            if unscaled:
                name = unscaled[0].split("[")[0].strip()
                raise ValueError(f"has shares of full scale; --scale {name}=FACTOR says what full scale is in SI, or in V with --sensitivity and "
                                 f"--columns '{name}[V]'")
    else:
        names, width, rate = table.heading.names, table.heading.width, layout.rate
    columns = columns_of(names, () if isinstance(table, Sheet) else table.heading.units, width, layout)
    told = list(names if layout.columns is None else layout.columns)
    clocks = [name for name, column in zip(told, columns) if column and column.quantity == "time"]
    signals = [name for name, column in zip(told, columns) if column and column.quantity != "time"]
    if rate is not None and clocks:
        raise ValueError(f"has {' and '.join(clocks)} and a sample rate; leave out one of them")
    if rate is None and len(clocks) != 1:
        raise ValueError(f"has {' and '.join(clocks) or 'no time'}; it needs one column of {' or '.join(TIMES)}"
                         + ", or --rate-hz" * (not clocks))
    quantities = [column.quantity for column in columns if column]
    twice = [name for name in signals if signals.count(name) > 1]
    if twice:
        raise ValueError(f"has {min(twice)} twice; each quantity has one column")
    if not signals or len(set(quantities)) < len(quantities):
        raise ValueError(f"has {' and '.join(signals) or 'no signal'}; it needs one column of each kind at most, of {', '.join(SIGNALS)}")
    return columns, rate


def _names(table: NumberTable | Sheet, columns: Sequence[Column | None]) -> tuple[str, ...]:
    names = table.names if isinstance(table, Sheet) else table.heading.names
    if names:
        return names
    return tuple(column.quantity if column else "a number" for column in columns)


def _spooled(table: Sheet | NumberTable, blocks: Blocks, columns: list[Column | None]) -> dict[str, Reals]:
    """{quantity: SI values (samples,)}, NaN where missing; of time none is missing."""
    kept = [(at, column) for at, column in enumerate(columns) if column]
    try:
        with ExitStack() as files:
            spools = {column.quantity: files.enter_context(tempfile.TemporaryFile()) for _, column in kept}
            count = _spool(table, blocks, columns, spools)
            found = {quantity: _reopened(spool, count) for quantity, spool in spools.items()}
    except OSError as error:
        raise PeterkaFileError(f"{table.path} can't be kept in {tempfile.gettempdir()} while it is read: {error.strerror or error}; "
                               "TMPDIR names another folder") from error
    return found


def _spool(table: NumberTable | Sheet, blocks: Blocks, columns: Sequence[Column | None],
           spools: Mapping[str, IO[bytes]]) -> int:
    """Writes the columns in SI; returns the number of samples."""
    count = 0
    for rows, line_of in blocks:
        for at, column in enumerate(columns):
            if column is None:
                continue
            values = column.factor * rows[:, at]
            if column.quantity == "time" and np.isnan(values).any():
                row = int(np.argmax(np.isnan(values)))
                raise table.refusal(f"has no {_names(table, columns)[at]}; every sample needs one", line_of(row) if line_of else None)
            spools[column.quantity].write(values.tobytes())
        count += len(rows)
        if count > MOST_SAMPLES:
            raise table.refusal(f"is too large: it has more than {MOST_SAMPLES} samples; cut it into files")
    return count


def _reopened(spool: IO[bytes], count: int) -> Reals:
    spool.flush()
    if count > HELD:
        return np.memmap(spool, dtype=float, mode="r+", shape=(count,))
    spool.seek(0)
    return np.frombuffer(bytearray(spool.read()), dtype=float)


def _with_gaps(values: Reals, places: Iterator[tuple[int, Integers]], count: int) -> Reals:
    """The values at their places, NaN between them."""
    with tempfile.TemporaryFile() as spool:
        try:
            for first in range(0, count, AT_ONCE):
                spool.write(np.full(min(AT_ONCE, count - first), np.nan).tobytes())
            found = _reopened(spool, count)
        except OSError as error:
            raise PeterkaFileError(f"a recording with gaps can't be kept in {tempfile.gettempdir()}: {error.strerror or error}") from error
    for first, inside in places:
        found[inside] = values[first:first + len(inside)]
    return found
