"""What the parts share: the helpers of the end-to-end tests, and the rows of the table."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "end_to_end"))


def row(fault, tried, what_happened):
    """A row of the table in README.md."""
    print(f"{fault}: tried {tried} times: {what_happened}", flush=True)
    with open(os.environ["ENDURANCE_ROWS"], "a") as rows:
        rows.write(f"{fault} | {tried} | {what_happened}\n")


def skip(reason):
    print(f"skipped: {reason}", flush=True)
    sys.exit(77)
