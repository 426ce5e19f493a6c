"""What the programs share: exit codes, arguments, what they print, and pictures put into a folder."""

import argparse
import os
import sys
from pathlib import Path

from . import axes

FORMATS = ("png", "pdf")
DONE, BAD_INPUT, BAD_OUTPUT = 0, 2, 3


class OneLineParser(argparse.ArgumentParser):
    """Shows `description` as it is written; tells what is wrong in one line."""

    def __init__(self, description):
        super().__init__(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message):
        self.exit(BAD_INPUT, f"{self.prog}: {message}; --help shows the arguments\n")

    def add_picture_arguments(self):
        """--output-dir and --formats."""
        self.add_argument("--output-dir", metavar="DIR", type=Path, default=Path("pictures"), help="default: pictures")
        self.add_argument("--formats", default=",".join(FORMATS), type=read_formats, help="default: png,pdf")


def read_formats(text):
    formats = text.split(",")
    if not set(formats) <= set(FORMATS):
        raise argparse.ArgumentTypeError(f"'{text}' is not a list of {' and '.join(FORMATS)}")
    return formats


def tell(line):
    """Prints a line; who reads the list only in part (draw.py ... | head) gets all pictures nevertheless."""
    try:
        print(line, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def complain(message):
    """One line to stderr, after the program's name."""
    print(f"{Path(sys.argv[0]).name}: {' '.join(str(message).split())}", file=sys.stderr)


def complain_of_folder(folder, error):
    complain(f"cannot write into {folder}: {error.strerror or error}")


def save_all(figure, folder, name, formats):
    """Writes the picture in each format into a folder, made where it is missing, and tells where."""
    folder.mkdir(parents=True, exist_ok=True)
    for suffix in formats:
        picture = folder / f"{name}.{suffix}"
        axes.save(figure, picture)
        tell(picture)
