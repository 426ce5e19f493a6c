#!/usr/bin/env python3
"""peterka-check-proofs without an installation: peterka/cli/check_proofs.py."""

import sys

import peterka.cli.interpreter  # noqa: F401, I001: goes on with a Python that has the packages

from peterka.cli.check_proofs import main

if __name__ == "__main__":
    sys.exit(main())
