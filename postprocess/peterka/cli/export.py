"""Writes the cells of maps and basins, the points of sweeps, and traces for other programs, with force in N and axes in Hz, mm and m/s.

    export.py FILE.h5 [FILE.h5 ...] [--as csv,vtk,mat] [--output-dir DIR]

csv: STEM.csv, a line for each cell, an empty cell where there is no number; of a sweep, csv alone, a line for each point of each branch
(branch from 0, direction, gap, frequency, ...); of a trace, csv alone, too: STEM.csv, a line for each sample of its motion, and STEM_impacts,
STEM_impact, STEM_spectrum and STEM_impact_spectrum as far as it has them. vtk: STEM.vtk, a rectilinear grid for ParaView.
mat: STEM.mat for MATLAB, arrays on [rows][columns]. Units are in the names (_n: N, _n_s: N s, _w: W, _n_per_mm: N per mm, _ratio:
over the hammer's weight, A0, A0*omega or omega); others have the file's unit, or are pure numbers, as elasticities (_by_: % per %). What isn't one number of each
cell is left out, and told. Codes (regime, status, engine, ...) are words in CSV, else numbers as in the file (-128: not computed yet).
Exit codes: 0 done; 2 a file cannot be read, or bad arguments; 3 an export cannot be written.
"""

import argparse
from pathlib import Path

from ..export.formats import export, left_out_in_words, read_formats
from ..errors import PeterkaFileError
from ..pictures import open_file
from .command_line import (
    BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, claim, complain, complain_of_folder, exit_code, tell, tell_if_unfinished,
)


def main() -> int:
    """peterka-export; the exit code."""
    return exit_code(_export())


def _export() -> int:
    arguments = read_arguments()
    outcome = DONE
    for path in arguments.files:
        try:
            with open_file(path) as file:
                tell_if_unfinished(file)
                for written in export(file, arguments.output_dir, arguments.formats, claim):
                    tell(written)
                for line in left_out_in_words(file):
                    tell(line)
        except PeterkaFileError as refusal:
            complain(refusal)
            outcome = BAD_INPUT
        except OSError as error:
            complain_of_folder(arguments.output_dir, error)
            return BAD_OUTPUT
    return outcome


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("files", metavar="FILE.h5", nargs="+", type=Path)
    parser.add_argument("--as", dest="formats", metavar="FORMAT,...", type=read_formats, default=["csv"], help="default: csv")
    parser.add_argument("--output-dir", metavar="DIR", type=Path, default=Path("."), help="default: this folder")
    arguments = parser.parse_args()
    parser.refuse_equal_stems(arguments.files, "exports")
    return arguments
