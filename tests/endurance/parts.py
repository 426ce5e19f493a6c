"""Shared by the parts: the helpers of the end-to-end tests, and the rows of the table."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "end_to_end"))

PART = Path(sys.argv[0])
if "ENDURANCE_ROWS" not in os.environ or len(sys.argv) > 1:
    print(f"{PART.name}: this is a part of tests/endurance.sh, without arguments: tests/endurance.sh {PART.stem}",
          file=sys.stderr)
    sys.exit(2)


def is_wanted(kind):
    """Whether a part that iterates over kinds of files includes this one: all, or those of PETERKA_ENDURANCE_KINDS."""
    wanted = os.environ.get("PETERKA_ENDURANCE_KINDS", "")
    return not wanted or kind in wanted.split(",")


def row(fault, tried, what_happened):
    """A row of the table in tests/README.md."""
    print(f"{fault}: tried {tried} times: {what_happened}", flush=True)
    with open(os.environ["ENDURANCE_ROWS"], "a") as rows:
        rows.write(f"{fault} | {tried} | {what_happened}\n")


def skip(reason):
    print(f"skipped: {reason}", flush=True)
    sys.exit(77)
