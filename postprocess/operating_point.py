#!/usr/bin/env python3
"""peterka-operating-point without an installation: peterka/cli/operating_point.py."""

import sys

import peterka.cli.interpreter  # noqa: F401, I001: goes on with a Python that has the packages

from peterka.cli.operating_point import main

if __name__ == "__main__":
    sys.exit(main())
