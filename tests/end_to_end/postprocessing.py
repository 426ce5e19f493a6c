"""The programs of postprocess/, called in this process: a start of Python with matplotlib takes longer than most pictures.
That they start as programs of their own is seen by test_operating_point.py, test_pictures_of_lengths.py and test_axes.py."""

import contextlib
import importlib
import io
import os
import sys
from pathlib import Path
from unittest import mock

import launch

POSTPROCESS = Path(__file__).resolve().parents[2] / "postprocess"
sys.path.insert(0, str(POSTPROCESS))


def program(name, folder, *arguments, code=0):
    """What it prints in this folder: on stdout, or on stderr where it is to end with another code than 0."""
    out, err = io.StringIO(), io.StringIO()
    with (contextlib.chdir(folder), mock.patch.object(sys, "argv", [f"{name}.py", *map(str, arguments)]),
          mock.patch.dict(os.environ, launch.ENVIRONMENT | launch.ALONE), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err)):
        try:
            ended = importlib.import_module(name).main()
        except SystemExit as stop:
            ended = stop.code
    assert (ended or 0) == code, err.getvalue()
    return err.getvalue() if code else out.getvalue()
