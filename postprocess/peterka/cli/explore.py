"""Writes a map, over any axes, a basin, a sweep or a file of curves as one page of HTML with the program's own engine inside.

    explore.py FILE.h5 [--output FILE.html] [--layers NAME,NAME,...] [--every N]

Open the page in a browser, from disk: it needs no server and no network. Point at a cell for its values; click it and
the engine solves it at once: motion, force, phase plane, what verifies its z. Sliders change the rig and the map is
computed again while they move. Of a sweep the page shows the branches, and with [starts] the other attractors: a click on a
point gives its motion. Of curves it shows these over their coarse map: a click on one gives, a small step to either side, the
motion that ends or changes there and what becomes of it. All fields of a map of up to a million cells are in the page, to the last bit; of a
larger one z and peak force, to so many digits that the page stays below 10 MB, or those that --layers names. --every 4
takes each 4th row and column of a map of more than 16,777,216 cells.
The engine is built when it is first needed, which takes a minute and shows how far it is, and kept in build/page. Without the compiler for it
(packages: src/page/packages.sh) the page shows the map and its values, and says what is missing.
Exit codes: 0 done; 2 a file cannot be shown, or bad arguments; 3 the page cannot be written.
"""

import argparse
import sys
from pathlib import Path

from ..errors import PeterkaFileError
from ..files.opened import OpenedFile
from ..files.whole_file import write_text
from ..maps.map_file import PeterkaFile
from ..page.engine import NoEngine, is_to_be_built
from ..page.engine import path as path_of_engine
from ..page.layers import MOST_CELLS
from ..page.page import page
from ..pictures import open_file
from .command_line import (
    BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, exit_code, tell, tell_if_unfinished,
)
from ..sweeps.sweep_file import SweepFile

SHOWN = ("map", "basin", "sweep", "curves")  # kinds of files


def main() -> int:
    """peterka-explore; the exit code."""
    return exit_code(_explore())


def _explore() -> int:
    arguments = read_arguments()
    output = arguments.output or Path(arguments.file.with_suffix(".html").name)
    try:
        with open_file(arguments.file) as file:
            shown = explorable(file, arguments.every)
            tell_if_unfinished(file)
            if is_to_be_built():
                build_engine()
            text, notes = page(shown, arguments.every, arguments.layers)
    except PeterkaFileError as refusal:
        complain(refusal)
        return BAD_INPUT
    for note in notes:
        tell(note)
    try:
        write_text(output, text)
    except OSError as error:
        complain(f"cannot write {output}: {error.strerror or error}")
        return BAD_OUTPUT
    tell(output)
    return DONE


def build_engine() -> None:
    """Builds the page's engine ahead, and shows how far that is; where it can't be built, the page will say why."""
    complain("building the page's engine, about a minute, once")
    try:
        path_of_engine(progress=show_progress)
    except NoEngine:
        pass


def show_progress(done: int, total: int) -> None:
    """On a terminal one line that is written again and again, else a line at each quarter."""
    if sys.stderr is None:
        return
    text = f"{done} of {total} sources compiled{', linking' * (done == total)}"
    if sys.stderr.isatty():
        print(f"\r{text}", end="\n" if done == total else "", file=sys.stderr, flush=True)
    elif 4 * done // total > 4 * (done - 1) // total:
        complain(text)


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("file", metavar="FILE.h5", type=Path)
    parser.add_argument("--output", metavar="FILE.html", type=Path, help="default: the file's stem, in this folder")
    parser.add_argument("--layers", metavar="NAME,...", type=lambda text: text.split(","), help="datasets to show")
    parser.add_argument("--every", metavar="N", type=read_step, default=1, help="each N-th row and column; default: 1")
    return parser.parse_args()


def read_step(text: str) -> int:
    """The step along rows and columns that an argument says."""
    if not (text.isascii() and text.isdigit() and 0 < int(text) < 10**5):
        raise argparse.ArgumentTypeError(f"'{text}' is not a step along rows and columns")
    return int(text)


def explorable(file: OpenedFile, every: int) -> PeterkaFile | SweepFile:
    """The file, where a page can show it, or each `every`-th row and column of its cells; else PeterkaFileError."""
    if isinstance(file, SweepFile):
        if every > 1:
            raise file.refusal("is a sweep, of which a page shows every point; --every takes rows and columns of cells")
        if len(file.values) < 2:
            raise file.refusal("is a sweep of one point, through which no branch can be drawn; a trace shows its motion")
        return file
    if not isinstance(file, PeterkaFile):
        raise file.refusal(f"is of kind {file.kind}; explore.py shows {', '.join(SHOWN[:-1])} and {SHOWN[-1]} files, draw.py draws "
                           "this one")
    rows, columns = (-(-size // every) for size in file.shape)
    if rows * columns > MOST_CELLS:
        step = next(n for n in range(2, 10**5) if -(-file.shape[0] // n) * -(-file.shape[1] // n) <= MOST_CELLS)
        raise file.refusal(f"has {rows * columns:,} cells, a page holds {MOST_CELLS:,}; --every {step} takes a part")
    if min(file.shape) < 2:
        of = " and ".join(f"{size:,} {name}{'s' * (size != 1)}" for size, name in zip(file.shape, ("row", "column")))
        raise file.refusal(f"has {of}; a page shows planes of two or more of both, draw.py draws this one")
    if min(rows, columns) < 2:
        raise file.refusal(f"has too few rows or columns for --every {every}")
    return file
