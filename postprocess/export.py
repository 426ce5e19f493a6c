#!/usr/bin/env python3
"""peterka-export without an installation: peterka/cli/export.py."""

import sys

import peterka.cli.interpreter  # noqa: F401, I001: goes on with a Python that has the packages

from peterka.cli.export import main

if __name__ == "__main__":
    sys.exit(main())
