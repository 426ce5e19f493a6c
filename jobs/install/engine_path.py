"""Prints where the engine of explore.py's page is, after compiling it if it is missing.

usage: engine_path.py POSTPROCESS_FOLDER
"""

import sys

sys.path.insert(0, sys.argv[1])

import peterka.cli.interpreter  # noqa: E402, F401, I001: goes on with a Python that has the packages

from peterka.page import engine  # noqa: E402

try:
    print(engine.path(), end="")
except engine.NoEngine as reason:
    sys.exit(str(reason))
