"""Writes the results page (Markdown) from files of studies and maps.

    results.py FILE.h5 [FILE.h5 ...] --page PAGE.md --pictures DIR

The pictures of the studies must lie in DIR, where draw.py put them; those that the page shows are copied beside it.
Exit codes: 0 done; 2 a file cannot be read; 3 the page cannot be written.
"""

import shutil
from contextlib import ExitStack
from pathlib import Path

from .. import results_page
from ..errors import PeterkaFileError
from ..files.whole_file import write_text
from ..pictures import open_file
from .command_line import BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, exit_code


def main() -> int:
    """peterka-results; the exit code."""
    return exit_code(_results())


def _results() -> int:
    parser = OneLineParser(__doc__)
    parser.add_argument("files", metavar="FILE.h5", nargs="+", type=Path)
    parser.add_argument("--page", metavar="PAGE.md", type=Path, required=True)
    parser.add_argument("--pictures", metavar="DIR", type=Path, required=True)
    arguments = parser.parse_args()
    try:
        with ExitStack() as stack:
            files = [stack.enter_context(open_file(path)) for path in arguments.files]
            text, pictures = results_page.page(files), results_page.pictures(files)
        write(text, pictures, arguments.page, arguments.pictures)
    except PeterkaFileError as refusal:
        complain(refusal)
        return BAD_INPUT
    except OSError as error:
        complain(f"cannot write the page: {error.filename}: {error.strerror or error}")
        return BAD_OUTPUT
    return DONE


def write(text: str, pictures: list[str], page: Path, folder: Path) -> None:
    """The page, with its pictures, which lie in the folder, beside it."""
    page.parent.mkdir(parents=True, exist_ok=True)
    for name in pictures:
        shutil.copyfile(folder / name, page.parent / name)
    write_text(page, text)
