"""Cells of a map or a basin written as CSV, VTK (legacy, binary, a rectilinear grid) or a MATLAB file (version 5), and the points of a sweep
and the tables of a trace as CSV."""

import argparse
import csv
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from ..arrays import Mask, Reals
from ..files.opened import OpenedFile
from ..files.regimes import NOT_COMPUTED
from ..files.whole_file import written_whole
from ..maps.map_file import PeterkaFile
from ..sweeps.sweep_file import SweepFile
from ..traces.trace_file import TraceFile
from .cells import NO_COUNT, OF_FOLLOWED, Field, Side, bands, fields_of, left_out, sides_of
from .traces import TraceTable, tables_of

LARGEST_MATLAB = 2**31 - 1  # bytes of a variable
MOST_NAMED = 12


def write_csv(file: PeterkaFile, path: Path) -> None:
    """One line per cell, row by row; an axis in units is followed by its ratio. Numbers round-trip exactly."""
    fields, (rows, columns) = fields_of(file), sides_of(file)
    sides = [(columns, 1), (rows, 0)]
    heads = [name for side, _ in sides for name in dict.fromkeys([side.name, side.ratio_name])]
    with written_whole(path, "w", newline="", encoding="utf-8") as out:
        table = csv.writer(out)
        table.writerow([*heads, *(field.name for field in fields)])
        for first, band in bands(file, fields):
            for row in range(len(band[fields[0].name])):
                done = band["regime"][row] != NOT_COMPUTED
                values = [_texts(field, band[field.name][row], done) for field in fields]
                for column, cells in enumerate(zip(*values)):
                    places = {0: first + row, 1: column}
                    table.writerow([*(_number(numbers[places[which]]) for side, which in sides
                                      for numbers in _once(side)), *cells])


def write_csv_of_sweep(file: SweepFile, path: Path) -> None:
    """One line per point, branch by branch: the branch's number from 0, its direction and gap, the point's place, and the fields of a
    map's cells. Numbers round-trip exactly."""
    fields, (gaps, points) = fields_of(file), sides_of(file)
    heads = [name for side in (gaps, points) for name in dict.fromkeys([side.name, side.ratio_name])]
    with written_whole(path, "w", newline="", encoding="utf-8") as out:
        table = csv.writer(out)
        table.writerow(["branch", "direction", *heads, *(field.name for field in fields)])
        for branch in file.branches:
            own = [str(branch.row), branch.direction, *(_number(numbers[branch.row]) for numbers in _once(gaps))]
            cells = {name: file.data.values(name, branch.row) for field in fields for name in field.datasets}
            done = cells["regime"] != NOT_COMPUTED
            texts = [_texts(field, field.values(cells, branch.row), done) for field in fields]
            for point, values in enumerate(zip(*texts)):
                table.writerow([*own, *(_number(numbers[point]) for numbers in _once(points)), *values])


def write_csv_of_trace(table: TraceTable, path: Path) -> None:
    """One line per sample, impact or frequency. Numbers round-trip exactly."""
    with written_whole(path, "w", newline="", encoding="utf-8") as out:
        lines = csv.writer(out)
        lines.writerow(table.columns)
        lines.writerows(map(_number, numbers) for numbers in zip(*(values.tolist() for values in table.columns.values())))


def write_vtk(file: PeterkaFile, path: Path) -> None:
    """Points are the cell centres, in the axes' units; each field is a data array."""
    fields, (rows, columns) = fields_of(file), sides_of(file)
    with written_whole(path, "wb") as out:
        title = file.title.encode("ascii", "replace").decode()[:200]
        out.write(f"# vtk DataFile Version 3.0\n{title}\nBINARY\nDATASET RECTILINEAR_GRID\nDIMENSIONS "
                  f"{len(columns.values)} {len(rows.values)} 1\n".encode())
        for letter, values in (("X", columns.values), ("Y", rows.values), ("Z", np.zeros(1))):
            out.write(f"{letter}_COORDINATES {len(values)} double\n".encode() + _big_endian(values, float) + b"\n")
        out.write(f"POINT_DATA {len(rows.values) * len(columns.values)}\n".encode())
        for field in fields:
            kind, name = (np.int32, "int") if field.whole else (float, "double")
            out.write(f"SCALARS {field.name} {name} 1\nLOOKUP_TABLE default\n".encode())
            for _, band in bands(file, [field]):
                out.write(_big_endian(band[field.name], kind))
            out.write(b"\n")


def write_matlab(file: PeterkaFile, path: Path) -> None:
    """Arrays on [rows][columns], the axes' values by name, and `title`."""
    if 8 * file.shape[0] * file.shape[1] > LARGEST_MATLAB:
        raise file.refusal("is too large for a MATLAB file, whose variables have 2 GB at most; export it as vtk")
    fields, sides = fields_of(file), sides_of(file)
    pieces = [band for _, band in bands(file, fields)]
    variables = {field.name: np.concatenate([piece[field.name] for piece in pieces]) for field in fields}
    for side in sides:
        variables |= {side.name: side.values, side.ratio_name: side.ratios}
    from scipy.io import savemat  # slow to load and rarely requested

    with written_whole(path, "wb") as out:
        savemat(out, variables | {"title": file.title}, oned_as="row", long_field_names=True)


FORMATS = {"csv": write_csv, "vtk": write_vtk, "mat": write_matlab}


def read_formats(text: str) -> list[str]:
    """The list of formats that an argument names."""
    formats = text.split(",")
    if not set(formats) <= set(FORMATS):
        raise argparse.ArgumentTypeError(f"'{text}' is not a list of {', '.join(FORMATS)}")
    return list(dict.fromkeys(formats))


def export(file: OpenedFile, folder: Path, formats: Iterable[str], claim: Callable[[Path], Path] = lambda path: path) -> Iterator[Path]:
    """Writes an open map, basin or coarse map of curves in each format, and a sweep or a trace as CSV, into a folder, creating it if
    missing; yields the paths written. `claim` is asked for each before it is written, and may refuse."""
    formats = list(formats)
    if isinstance(file, (SweepFile, TraceFile)):
        what = "sweep, whose points" if isinstance(file, SweepFile) else "trace, whose samples"
        if formats != ["csv"]:
            raise file.refusal(f"is a {what} are exported as csv alone; {', '.join(name for name in formats if name != 'csv')} "
                               "takes the cells of maps, basins and curves: use --as csv")
    elif not isinstance(file, PeterkaFile):
        raise file.refusal(f"is a {file.kind}; the cells of maps, basins and curves, the points of sweeps, and traces are exported, others are read by xarray")
    folder.mkdir(parents=True, exist_ok=True)

    def named(end: str) -> Path:
        return claim(folder / f"{file.path.stem}{end}")

    if isinstance(file, TraceFile):
        for table in tables_of(file):
            path = named(f"{table.part and '_'}{table.part}.csv")
            write_csv_of_trace(table, path)
            yield path
    elif isinstance(file, SweepFile):
        path = named(".csv")
        write_csv_of_sweep(file, path)
        yield path
    elif isinstance(file, PeterkaFile):
        for name in formats:
            path = named(f".{name}")
            FORMATS[name](file, path)
            yield path


def left_out_in_words(file: OpenedFile) -> list[str]:
    """A line on what of a file is in no export; none where that is nothing."""
    names = left_out(file) if isinstance(file, (PeterkaFile, SweepFile)) else []
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return [f"{file.path}: not one number of each {'point' if isinstance(file, SweepFile) else 'cell'}, and so left out: {', '.join(names[:MOST_NAMED])}{more}; xarray and "
            "peterka.open read them from the file"] if names else []


def _once(side: Side) -> list[Reals]:
    """Values and ratios; ratios alone if the file does not give the units."""
    return [side.values] if side.name == side.ratio_name else [side.values, side.ratios]


def _texts(field: Field, values: NDArray[Any], done: Mask) -> list[str]:
    """`done`: of the cells that are computed; counts of the others are no numbers, and no status is theirs."""
    if field.words:
        told = done if field.dataset in OF_FOLLOWED else np.ones_like(done)
        return ["" if value == NO_COUNT or not is_told else field.words.get(value, str(value)) for value, is_told in zip(values.tolist(), told)]
    if field.whole:
        return [str(value) if is_done and value != NO_COUNT else "" for value, is_done in zip(values.tolist(), done)]
    return [_number(value) for value in values.tolist()]


def _number(value: float) -> str:
    return "" if np.isnan(value) else repr(float(value))


def _big_endian(values: NDArray[Any], kind: DTypeLike) -> bytes:
    return np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder(">")).tobytes()
