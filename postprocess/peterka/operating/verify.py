"""Recomputes the box around a place with the program itself: the map's job on a finer grid, with the same starts."""

import os
import re
import subprocess
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..files.whole_file import write_text
from ..maps.map_file import Axis, PeterkaFile
from .admitted import ANY, JOB, Quantity, admitted, quantity_of, read_code
from .drift import Reach
from .places import Place
from .words import on_axis

FINER, FEWEST, MOST = 4, 17, 129  # points per step of the map, and along a side
ROUNDING = 1e-6  # of a value: both grids contain the box' corners, but their coordinates differ in the last bits
# The gaps at which borders are told may lie outside the box.
OF_THE_WHOLE_MAP = re.compile(r"^\[curves\]\n.*?(?=^\[|\Z)", re.MULTILINE | re.DOTALL)
BINARY = Path(__file__).resolve().parents[3] / "build" / "peterka"


class NotVerified(Exception):
    """The program did not compute the box; the message gives the reason."""


@dataclass(frozen=True)
class Verified:
    """`cells` of the finer box; the number of them with `another` regime or none from the admitted starts; the smallest
    value of the others and its place (row, column) [in the unit of the Quantity, numbers of the map's axes]; NaN if none has a value; the
    admitted `starts`."""

    cells: int
    another: int
    worst: float
    at: tuple[float, float]
    starts: str | float = JOB

    def holds(self, place: Place) -> bool:
        """Whether a Place is as good here as predicted, up to rounding."""
        return self.another == 0 and self.worst >= place.worst * (1 - ROUNDING)


def verify(file: PeterkaFile, place: Place, reaches: tuple[Reach, Reach], starts: str | float, quantity: Quantity,
           folder: Path, ranks: int = 1, binary: Path | None = None) -> Verified:
    """The Verified of a Place; its job and file are written to `folder`."""
    paths = axis_paths(file, file.data.attribute("job"))
    sizes = {}
    for name, axis, along, at in (("columns", file.columns, reaches[1], place.column),
                                  ("rows", file.rows, reaches[0], place.row)):
        sizes[paths[name]] = finer(axis, along.width, at)
    box = compute(file, sizes, {"uncertainty.rigs": 0} if file.outcome_slots else {}, folder / f"{file.path.stem}_box", ranks, binary)
    with PeterkaFile(box) as within:
        found = quantity_of(within, quantity.name).of(admitted(within, starts, quantity.name))
        same = np.array([[read_code(code) == place.orbit for code in row] for row in found.code])
        values = np.where(same, found.value, np.nan)
        another = int(np.sum(~np.isfinite(values)))
        if another == values.size:
            return Verified(values.size, another, np.nan, (np.nan, np.nan), starts)
        row, column = (int(n) for n in np.unravel_index(np.nanargmin(values), values.shape))
        return Verified(values.size, another, float(values[row, column]), (_in_numbers_of(file.rows, within.rows, row), _in_numbers_of(
            file.columns, within.columns, column)), starts)


def compute(file: PeterkaFile, sizes: Mapping[str, tuple[float, float, int]], changes: Mapping[str, object], output: Path,
            ranks: int, binary: Path | None) -> Path:
    """The file that the program computes of a map's job over other axes, {path: (from, to, points)}, with these changes of its keys:
    `output` with the suffix .h5, beside its job."""
    output.parent.mkdir(parents=True, exist_ok=True)
    job, box = output.with_name(f"{output.name}.toml"), output.with_name(f"{output.name}.h5")
    write_text(job, OF_THE_WHOLE_MAP.sub("", str(file.data.attribute("job"))))
    _run(job, box, sizes, changes, file, ranks, binary)
    return box


def axis_paths(file: PeterkaFile, text: object) -> dict[str, str]:
    """{"rows", "columns": the axis' table in the job}; a job's first axis is that of the columns."""
    try:
        found = list(_tables(tomllib.loads(text)["axes"], "axes"))  # type: ignore[arg-type]  # non-text: refused below
    except (tomllib.TOMLDecodeError, KeyError, TypeError, AttributeError) as error:
        raise file.refusal(f"holds no job that can be read ({type(error).__name__})") from error
    by_name = {_coordinate(path): path for path in found}
    try:
        return {"columns": by_name[file.columns.stored], "rows": by_name[file.rows.stored]}
    except KeyError as error:
        raise file.refusal(f"has no axis {error} in its job") from error


def text_of(file: PeterkaFile, place: Place, found: Verified, quantity: Quantity) -> str:
    """The result for the finer box, in words."""
    worst, unit = found.worst, quantity.unit
    alone = "the place, computed again," if found.cells == 1 else ""
    if found.another:
        have = f"{alone} has" if alone else f"{found.another} of {found.cells} cells of the finer box have"
        or_else = {ANY: ", or more than one", JOB: ""}.get(found.starts) if isinstance(found.starts, str) else (
            f", or this one from fewer than {100 * found.starts:.4g} % of the starts")
        return f"it doesn't hold: {have} another regime{or_else}"
    share = round(100 * (found.worst / place.worst - 1), 4) + 0.0  # no -0
    if found.holds(place):
        where = "" if alone else f" in all {found.cells} cells of the finer box"
        return f"it holds{where}: {alone or 'the worst'} has {worst:.4g} {unit} ({share:+.2g} %)"
    return (f"it falls short by {-share:.3g} %: {alone or f'of {found.cells} cells of the finer box, all of the same regime, the worst'} "
            f"has {worst:.4g} {unit}, at {on_axis(file, file.columns, found.at[1], 6)}, "
            f"{on_axis(file, file.rows, found.at[0], 6)}")


def _tables(table: Mapping[str, Any], path: str) -> Iterator[str]:
    for name, value in table.items():
        if isinstance(value, dict):
            if "points" in value:
                yield f"{path}.{name}"
            else:
                yield from _tables(value, f"{path}.{name}")


def _coordinate(path: str) -> str:
    """The file's name of a job axis: axes.contact.damping_ns_per_m is contact_damping_ns_per_m."""
    return "_".join(path.split(".")[1:])


def finer(axis: Axis, width: float, at: int) -> tuple[float, float, int]:
    """(from, to, points) of the box of this half-width around a place, in the numbers of the job; a single point where that is 0."""
    points = int(np.clip(2 * round(FINER * width / float(np.diff(axis.values).min())) + 1, FEWEST, MOST)) if width else 1
    return (axis.values[at] - width) * axis.unit, (axis.values[at] + width) * axis.unit, points


def _in_numbers_of(axis: Axis, finer_axis: Axis, at: int) -> float:
    """A value of a finer axis as that of the map shows it: a scale that the map's cells don't share may be common to the box's."""
    return float(finer_axis.values[at] * finer_axis.unit / axis.unit)


def _run(job: Path, box: Path, sizes: Mapping[str, tuple[float, float, int]], more: Mapping[str, object], file: PeterkaFile, ranks: int,
         binary: Path | None) -> None:
    program = Path(binary or os.environ.get("PETERKA_BINARY") or BINARY)
    launcher = [] if ranks == 1 else [os.environ.get("MPIEXEC", "mpirun"), "-n", str(ranks)]
    changes: dict[str, object] = {"audit.cells": 0, "refine.levels": 0, **more}
    for path, (first, last, points) in sizes.items():
        changes |= {f"{path}.from": repr(float(first)), f"{path}.to": repr(float(last)), f"{path}.points": points,
                    f"{path}.scale": "linear"}
    command = [*launcher, str(program), "run", str(job), "--output", str(box), "--fresh", "--quiet"]
    command += [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    except OSError as error:
        raise NotVerified(f"{program} cannot be started ({error.strerror}); build it, or name it with --peterka") from error
    if done.returncode not in (0, 4):
        told = [line for line in done.stderr.splitlines() if line.strip()]
        raise NotVerified(f"the box of {file.path} was not computed: {' '.join(told)[-600:] or f'exit code {done.returncode}'}")
