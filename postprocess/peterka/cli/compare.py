"""Compares two map files, or two basins, cell by cell: where regime, z = p/q and peak force differ (of rigid stops, impact speed).

    compare.py A.h5 B.h5 [--units both|si|ratio] [--palette colour|grey] [--width MM] [--output-dir DIR] [--formats png,pdf]

Prints the keys of the jobs that differ, counts, the labels that differ, and B's peak force or impact speed over A's; draws A_against_B.
Rig, start and solver may differ. Where the grids differ, the points of the coarser one that the other has are compared.
Exit codes: 0 done, whether or not they differ; 2 a file cannot be read, or they have no two common points along an axis;
3 a picture cannot be written.
"""

import argparse
from pathlib import Path

from ..errors import PeterkaFileError
from ..maps import comparison, comparison_map
from ..maps.map_file import PeterkaFile
from ..plotting.style import using
from .command_line import (
    BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, complain_of_folder, exit_code, save_all,
    tell, tell_if_unfinished,
)
from .picture_options import add_look_arguments, check_style, style_of


def main() -> int:
    """peterka-compare; the exit code."""
    return exit_code(_compare())


def _compare() -> int:
    arguments = read_arguments()
    try:
        with PeterkaFile(arguments.first) as first, PeterkaFile(arguments.second) as second, using(**style_of(arguments)):
            for file in (first, second):
                tell_if_unfinished(file)
            found = comparison.compare(first, second)
            tell(comparison.text(first, second, found))
            figure = comparison_map.draw(first, second, found)
    except PeterkaFileError as refusal:
        complain(refusal)
        return BAD_INPUT
    try:
        name = f"{arguments.first.stem}_against_{arguments.second.stem}"
        save_all(figure, arguments.output_dir, name, arguments.formats)
    except OSError as error:
        complain_of_folder(arguments.output_dir, error)
        return BAD_OUTPUT
    return DONE


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("first", metavar="A.h5", type=Path)
    parser.add_argument("second", metavar="B.h5", type=Path)
    parser.add_picture_arguments()
    add_look_arguments(parser)
    arguments = parser.parse_args()
    check_style(parser, arguments)
    return arguments
