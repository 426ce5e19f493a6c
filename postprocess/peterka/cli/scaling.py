"""Parallel efficiency of a map on any number of ranks, from the seconds per tile that its file stores.

    scaling.py FILE.h5 [--measured FILE.h5 ...] [--cells 1e6,1e8,1e10] [--ranks 100000]
               [--service US] [--latency US] [--look US] [--remedies] [--output-dir DIR] [--formats png,pdf]

Deals the tiles again as the program does, event by event: to 1 up to --ranks ranks, for the map's plane at the
resolution of each of --cells, and draws STEM_scaling. --measured are files of the same plane: each is drawn against
the one of as many cells that was computed on one rank. --remedies tells what longer runs, or groups of ranks with a
dealer each, would give where one dealer is too slow. The defaults of --service (rank 0's time for one run) and
--latency (of a message) were measured on 2 cores with tests/benchmark/deal_rate; measure them on your machine.
Exit codes: 0 done; 2 a file cannot be read, or bad arguments; 3 a picture cannot be written.
"""

import argparse
from collections.abc import Callable
from pathlib import Path

from ..errors import PeterkaFileError
from .command_line import (
    BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, complain_of_folder, exit_code, save_all,
    tell,
)
from ..scaling import efficiency, remedies
from ..scaling.dealing import Machine
from ..scaling.run_record import read_record

LEAST_CELLS, MOST_CELLS, MOST_RANKS = 256, 10**11, 10**6  # more than that takes hours, and many GB


def main() -> int:
    """peterka-scaling; the exit code."""
    return exit_code(_scaling())


def _scaling() -> int:
    arguments = read_arguments()
    machine = Machine(1e-6 * arguments.service, 1e-6 * arguments.latency, 1e-6 * arguments.look)
    try:
        record = read_record(arguments.file)
        measured, alone = efficiency.measured_efficiency([read_record(path) for path in arguments.measured])
    except PeterkaFileError as refusal:
        complain(refusal)
        return BAD_INPUT
    for lonely in alone:
        complain(f"{lonely.path} is left out: no file of as many cells was computed on one rank")
    ranks = efficiency.ranks_up_to(arguments.ranks)
    curves = [efficiency.curve(record, cells, ranks, machine) for cells in arguments.cells]
    tell(efficiency.text(curves, machine))
    if arguments.remedies:
        tell(remedies.text(record, curves, machine))
    try:
        figure = efficiency.draw(record, curves, measured, machine)
        save_all(figure, arguments.output_dir, f"{arguments.file.stem}_scaling", arguments.formats)
    except OSError as error:
        complain_of_folder(arguments.output_dir, error)
        return BAD_OUTPUT
    return DONE


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("file", metavar="FILE.h5", type=Path)
    parser.add_argument("--measured", metavar="FILE.h5", nargs="+", type=Path, default=[])
    parser.add_argument("--cells", type=read_cells, default="1e6,1e8,1e10", help="default: 1e6,1e8,1e10")
    parser.add_argument("--ranks", type=whole_number(1, MOST_RANKS), default=100000, help="default: 100000")
    for name, default, what in (("service", 3.0, "rank 0's time for one run"), ("latency", 2.0, "time of a message"),
                                ("look", 500.0, "between two looks for messages of a rank 0 that computes, too")):
        parser.add_argument(f"--{name}", metavar="US", type=microseconds, default=default,
                            help=f"{what} [µs], default: {default:g}")
    parser.add_argument("--remedies", action="store_true", help="compare ways out where rank 0 is too slow")
    parser.add_picture_arguments()
    return parser.parse_args()


def read_cells(text: str) -> list[int]:
    """The numbers of cells that an argument lists."""
    return [whole_number(LEAST_CELLS, MOST_CELLS)(word) for word in text.split(",")]


def whole_number(least: float, most: float) -> Callable[[str], int]:
    """Reads an argument that is a whole number from least to most."""
    def read(text: str) -> int:
        number = number_in(text)
        if not least <= number <= most or number != int(number):
            raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from {least} to {most:.0e}")
        return int(number)

    return read


def microseconds(text: str) -> float:
    """The time [µs] that an argument says."""
    number = number_in(text)
    if not 0 < number < 1e6:
        raise argparse.ArgumentTypeError(f"'{text}' is not a time in microseconds between 0 and 1e6")
    return number


def number_in(text: str) -> float:
    """NaN for what is no number."""
    try:
        return float(text)
    except ValueError:
        return float("nan")
