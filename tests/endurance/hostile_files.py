#!/usr/bin/python3
"""Every program of postprocess on files of every kind with one item changed, one after the other: it draws, or it gives the
reason in one line, with exit code 2 or 3. Pictures are discarded."""

import contextlib
import importlib
import io
import os
import shutil
import sys
import tempfile
import traceback
from pathlib import Path

from parts import row

os.environ["HDF5_USE_FILE_LOCKING"] = "FALSE"
TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS / "postprocess"), str(TESTS.parent / "postprocess")]

import hostile_files  # noqa: E402
from peterka.plotting import axes  # noqa: E402

PICTURES = ["--output-dir", "out", "--formats", "png"]


def draw_and_throw_away(figure, path):
    figure.savefig(io.BytesIO(), format="png", dpi=30)
    path.write_bytes(b"x")


def programs(kind, path):
    """(name, arguments) of all programs that read such a file."""
    yield "draw", [path, *PICTURES]
    if kind == "map with starts":
        yield "operating_point", [path, "--hz", "0.5", "--mm", "0.1", *PICTURES]
    if kind == "map of uncertain rigs":
        yield "operating_point", [path, "--hz", "0.5", "--mm", "0.1", "--risk", "0.5", *PICTURES]
    if kind in ("map", "basin"):
        yield "compare", [path, f"{kind}_sound.h5", *PICTURES]
    if kind == "map":
        yield "scaling", [path, "--cells", "1e4", "--ranks", "10", *PICTURES]
    if kind in ("map", "precision", "labels", "stability"):
        yield "results", [path, "--page", "page.md", "--pictures", "out"]
    if kind in hostile_files.CLAIMED:
        shutil.rmtree("claims", ignore_errors=True)
        for name in hostile_files.CLAIMED[kind]:
            (Path("claims") / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, Path("claims") / name)
        yield "claims", ["claims"]


def fault_of(name, arguments):
    """The fault in the program's reaction; None if there is none."""
    sys.argv = [f"{name}.py", *map(str, arguments)]
    out, errors = io.StringIO(), io.StringIO()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            code = importlib.import_module(name).main()
    except SystemExit as stop:
        code = stop.code
    except Exception:  # any exception is a fault
        return traceback.format_exc(limit=-2)
    said = errors.getvalue()
    if code not in (0, 2, 3) or (code != 0 and said.count("\n") != 1):
        return f"exit code {code}: {said[:300]}"
    strange = [letter for letter in out.getvalue() + said if not letter.isprintable() and letter != "\n"]
    return f"prints {strange[:5]}" if strange else None


def main():
    axes.save = draw_and_throw_away
    faults, tried, files = 0, 0, 0
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for kind in hostile_files.KINDS:
            for what, path in hostile_files.hostile_files(kind, Path()):
                files += 1
                for name, arguments in programs(kind, path):
                    tried += 1
                    fault = fault_of(name, arguments)
                    if fault:
                        faults += 1
                        print(f"{name}.py, {kind}, {what}: {fault}", flush=True)
    row("files of every kind with one thing changed to what nobody computes, read by all programs of postprocess", files,
        f"{tried - faults} of {tried} runs draw or say in one line why not")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
