"""Curves to be laid over a map of the same rig and the same axes, in either unit of each, columns and rows in either order."""

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import PeterkaFileError
from ..files.opened import OpenedFile
from ..plotting.coordinates import called
from .curves_file import CurvesFile, Lines, Special, differing, rig_of
from .map_file import PeterkaFile

SAME_PLACE = 1e-9  # relative: a frequency or gap that all cells share, in either unit


def read_lines(path: Path, file: OpenedFile) -> Lines:
    """The curves of a file, on the axes of a map. Raises PeterkaFileError where they are of another rig, place or plane."""
    if not isinstance(file, PeterkaFile) or file.kind != "map":
        raise PeterkaFileError(f"{file.path} is of kind {file.kind}; curves are laid over a map, or over a sweep of frequencies")
    with CurvesFile(path) as curves:
        names = curves.columns.name, curves.rows.name
        if {*names} != {file.columns.name, file.rows.name}:
            raise PeterkaFileError(f"{path} has curves over {_axes(curves)}, and {file.path} is a map over {_axes(file)}")
        if rig_of(curves) != rig_of(file) or not _is_same_place(curves, file):
            raise PeterkaFileError(f"{path} has the curves of another rig or operating point than {file.path}{differing(curves, file)}")
        lines = curves.lines
    if names[0] == file.columns.name:
        return lines
    return Lines([replace(curve, columns=curve.rows, rows=curve.columns) for curve in lines.curves],
                 [Special(special.kind, special.row, special.column) for special in lines.specials])


def _axes(file: PeterkaFile) -> str:
    return f"{called(file, file.columns)} and {called(file, file.rows)}"


def _is_same_place(first: PeterkaFile, second: PeterkaFile) -> bool:
    """Whether the frequency and the gap that all cells share are the same."""
    for name in ("frequency_ratio", "gap_ratio"):
        one, other = first.number(name), second.number(name)
        if one is None or other is None:
            return _place(first) == _place(second)
        if not np.isclose(one, other, rtol=SAME_PLACE, atol=0):
            return False
    return True


def _place(file: PeterkaFile) -> object:
    """That table of the job; none where the axes vary both."""
    text = file.data.attribute("job")
    return tomllib.loads(text if isinstance(text, str) else "").get("operating_point")
