"""Writes the claims report of the paper, claims.md and claims.html, from a folder that jobs/paper.sh filled.

    claims.py FOLDER [--page DIR]

Reads FOLDER/*.h5, those of drawn rigs in FOLDER/rigs/NUMBER, and FOLDER/pictures, and writes into DIR (default: FOLDER) the page as claims.md, with its pictures in
pictures/, and as claims.html in one file. A claim whose file is missing is listed as not computed.
Exit codes: 0 done, whatever the verdicts; 2 a file cannot be read; 3 the page cannot be written.
"""

import argparse
import shutil
from collections.abc import Iterator
from pathlib import Path

from ..claims import starts_picture
from ..claims.claims import all_claims
from ..claims.drawn_rigs import agreements, drawn_rig
from ..claims.folder import Folder
from ..claims.html import html
from ..claims.markdown import markdown
from ..claims.page import Block, Pictures, blocks
from ..claims.record import Claim
from ..claims.sensitivity import rows
from ..errors import PeterkaFileError
from ..files.whole_file import write_text
from ..plotting import axes
from ..maps.map_file import PeterkaFile
from .command_line import BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, exit_code, tell


def main() -> int:
    """peterka-claims; the exit code."""
    return exit_code(_claims())


def _claims() -> int:
    arguments = read_arguments()
    folder = Folder(arguments.folder)
    page = arguments.page or arguments.folder
    try:
        draw_starts(folder)
        groups = all_claims(folder)
        text = blocks(groups, rows(folder), folder.picture, agreements(claims_of_rigs(arguments.folder)))
        write(text, folder.path / "pictures", page)
    except PeterkaFileError as refusal:
        complain(refusal)
        return BAD_INPUT
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:  # each file is sound, and what they say isn't
        complain(f"the files of {folder.path} make no sense together ({type(error).__name__}: {error}); compute them again "
                 "with jobs/paper.sh")
        return BAD_INPUT
    except OSError as error:
        complain(f"cannot write the page: {error.filename}: {error.strerror or error}")
        return BAD_OUTPUT
    for title, claims in groups:
        tell(title)
        for claim in claims:
            tell(f"  {claim.verdict:<12}  {claim.key}")
    for name in ("claims.md", "claims.html"):
        tell(page / name)
    return DONE


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("folder", metavar="FOLDER", type=Path)
    parser.add_argument("--page", metavar="DIR", type=Path)
    arguments = parser.parse_args()
    if not arguments.folder.is_dir():
        parser.error(f"{arguments.folder} is no folder")
    return arguments


def claims_of_rigs(path: Path) -> Iterator[list[Claim]]:
    """The claims by the files of each drawn rig, of which FOLDER/rigs has a folder by its number."""
    for rig in sorted(each for each in path.glob("rigs/*") if each.name.isdigit()):
        folder = Folder(rig, drawn_rig(int(rig.name)).gap_mm)
        yield [claim for _, group in all_claims(folder) for claim in group]


def draw_starts(folder: Folder) -> None:
    """Draws what depends on the start, where the files for it are there."""
    planes = folder.planes("starts/start_")
    if len(planes) > 1:
        (folder.path / "pictures").mkdir(exist_ok=True)
        with PeterkaFile(planes[0].path) as file:
            axes.save(starts_picture.draw(file, planes), folder.path / "pictures" / "starts_170mm.png")


def write(text: list[Block], pictures: Path, page: Path) -> None:
    """Both pages into the folder `page`, with the pictures that they show."""
    (page / "pictures").mkdir(parents=True, exist_ok=True)
    for block in text:
        for name in block.names if isinstance(block, Pictures) else ():
            if (page / "pictures").resolve() != pictures.resolve():
                shutil.copyfile(pictures / f"{name}.png", page / "pictures" / f"{name}.png")
    write_text(page / "claims.md", markdown(text, "pictures"))
    write_text(page / "claims.html", html(text, pictures))
