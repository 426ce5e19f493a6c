"""Shared by the programs: exit codes, arguments, output, and writing pictures into a folder."""

import argparse
import errno
import os
import re
import shutil
import sys
import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any, ClassVar, NoReturn

from matplotlib.figure import Figure

from ..errors import PeterkaFileError
from ..files.harmless import harmless
from ..files.opened import OpenedFile
from ..plotting import axes

FORMATS = ("png", "pdf", "svg")
DEFAULT_FORMATS = "png,pdf"
DONE, BAD_INPUT, BAD_OUTPUT = 0, 2, 3
LONGEST_COMPLAINT = 2000  # letters


class OneLineParser(argparse.ArgumentParser):
    """Shows `description` verbatim; reports errors in one line."""

    def __init__(self, description: str | None) -> None:
        super().__init__(description=_as_installed(description), formatter_class=argparse.RawDescriptionHelpFormatter)
        _Output.written.clear()  # a call of its own, as where one process makes several

    def parse_known_args(self, args: Sequence[str] | None = None, namespace: Any = None) -> Any:
        """Takes "--zoom -2,1" for "--zoom=-2,1": argparse would take -2,1 for an option."""
        words: list[str] = []
        for word in sys.argv[1:] if args is None else args:
            follows_option = bool(words) and words[-1].startswith("--") and "=" not in words[-1]
            if follows_option and re.match(r"-\.?\d[^-]*,", word):
                words[-1] += f"={word}"
            else:
                words.append(word)
        return super().parse_known_args(words, namespace)

    def error(self, message: str) -> NoReturn:
        """Ends the program with exit code 2."""
        self.exit(BAD_INPUT, f"{self.prog}: {harmless(message, LONGEST_COMPLAINT)}; --help shows the arguments\n")

    def print_help(self, file: IO[str] | None = None) -> None:
        """Prints as tell() does."""
        tell(self.format_help().rstrip("\n"))

    def exit(self, status: int = DONE, message: str | None = None) -> NoReturn:
        """Ends the program."""
        super().exit(exit_code(status), message)

    def refuse_equal_stems(self, files: Iterable[Path], outputs: str) -> None:
        """Ends the program if the outputs of two files would have one name."""
        stems = [path.stem for path in files]
        if len(set(stems)) < len(stems):
            self.error(f"two of the files have the same name, so their {outputs} would overwrite each other")

    def add_picture_arguments(self) -> None:
        """Adds --output-dir and --formats."""
        self.add_argument("--output-dir", metavar="DIR", type=Path, default=Path("pictures"), help="default: pictures")
        self.add_argument("--formats", "--format", default=DEFAULT_FORMATS, type=read_formats, help=f"some of {', '.join(FORMATS)}; default: {DEFAULT_FORMATS}")


def _as_installed(text: str | None) -> str | None:
    """In a text, `draw.py` becomes peterka-draw if this is an installed program; so does each program of this folder."""
    if text is None or not Path(sys.argv[0]).name.startswith("peterka-"):
        return text
    programs = "|".join(re.escape(path.stem) for path in Path(__file__).parent.glob("*.py"))
    return re.sub(rf"\b({programs})\.py\b", lambda named: f"peterka-{named[1].replace('_', '-')}", text)


def read_formats(text: str) -> list[str]:
    """The list of picture formats that an argument names."""
    formats = text.split(",")
    if not set(formats) <= set(FORMATS):
        raise argparse.ArgumentTypeError(f"'{text}' is not a list of {' and '.join(FORMATS)}")
    return list(dict.fromkeys(formats))


class _Output:
    lost = False  # whether any output could not be printed
    written: ClassVar[set[Path]] = set()


def tell_if_unfinished(file: OpenedFile) -> None:
    """Prints what share of a file is computed, where it isn't complete."""
    if not file.is_complete:
        tell(f"{file.path}: {axes.incomplete_text(file)}")


def tell(line: object) -> None:
    """Prints a line. A reader that stops early (draw.py ... | head) still gets all pictures. Any other failure to print is
    reported, all pictures are still made, and exit_code() reflects it."""
    try:
        if sys.stdout is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        print("\n".join(harmless(part, None) for part in str(line).split("\n")), flush=True)
    except BrokenPipeError:
        _drop_stdout()
    except OSError as error:
        if not _Output.lost:
            complain(f"standard output cannot be written: {error.strerror}; files are written nevertheless")
        _Output.lost = True
        _drop_stdout()


def _drop_stdout() -> None:
    if sys.stdout is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextmanager
def working(on: object) -> Iterator[None]:
    """While its body runs, a line on a terminal says on what, and for how many seconds; it is gone afterwards."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield
        return
    terminal, done, begin = sys.stderr, threading.Event(), time.monotonic()

    def write(text: str) -> None:
        with suppress(OSError):
            terminal.write(text)
            terminal.flush()

    def count() -> None:
        while not done.wait(1):
            words = f"{harmless(str(on), LONGEST_COMPLAINT)}: {time.monotonic() - begin:.0f} s"
            write(f"\r{words[1 - shutil.get_terminal_size().columns:]}")  # one row of it

    thread = threading.Thread(target=count, daemon=True)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()
        write("\r\x1b[K")


def exit_code(outcome: int) -> int:
    """The program's exit code for this outcome."""
    return BAD_OUTPUT if _Output.lost and outcome == DONE else outcome


def complain(message: object) -> None:
    """One line to stderr, prefixed with the program's name."""
    try:
        print(f"{Path(sys.argv[0]).name}: {harmless(' '.join(str(message).split()), LONGEST_COMPLAINT)}", file=sys.stderr)
    except OSError:
        pass  # stderr is closed; the exit code still reports it


def complain_of_folder(folder: Path, error: OSError) -> None:
    """Reports a folder that cannot be written, in one line."""
    complain(f"cannot write into {folder}: {error.strerror or error}")


def claim(path: Path) -> Path:
    """The path of an output; raises PeterkaFileError where this call has written one there already, which a second would replace."""
    if path in _Output.written:
        raise PeterkaFileError(f"{path} is written already, of another of these files; give the two in calls of their own, each with its --output-dir")
    _Output.written.add(path)
    return path


def save_all(figure: Figure, folder: Path, name: str, formats: Iterable[str]) -> None:
    """Writes the picture in each format into a folder, creating it if missing, and prints the paths."""
    folder.mkdir(parents=True, exist_ok=True)
    for suffix in formats:
        picture = claim(folder / f"{name}.{suffix}")
        axes.save(figure, picture)
        tell(picture)
