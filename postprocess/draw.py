#!/usr/bin/env python3
"""peterka-draw without an installation: peterka/cli/draw.py."""

import sys

import peterka.cli.interpreter  # noqa: F401, I001: goes on with a Python that has the packages

from peterka.cli.draw import main

if __name__ == "__main__":
    sys.exit(main())
