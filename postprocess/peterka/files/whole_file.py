"""Files that appear under their name only when complete: no partial file passes for a whole one, nothing is written through
a link, and concurrent programs do not write to the same file."""

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

LONGEST_STEM = 100  # characters of the name kept in an unfinished file's name, since name lengths are limited


@contextmanager
def written_whole(path: Path, mode: str = "w", **options: Any) -> Iterator[IO[Any]]:
    """Opens a new file beside `path`, with the options of open(), and renames it if the block ends without an exception."""
    unfinished = path.with_name(f".{path.name[:LONGEST_STEM]}.{secrets.token_hex(4)}.unfinished")
    try:
        descriptor = os.open(unfinished, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
    except OSError as error:
        raise type(error)(error.errno, error.strerror, str(path)) from error
    try:
        with open(descriptor, mode, **options) as out:
            yield out
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Writes a whole text in UTF-8."""
    with written_whole(path, encoding="utf-8") as out:
        out.write(text)
