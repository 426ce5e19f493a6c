#!/usr/bin/python3
"""Each place that allocates memory in a small run of each kind, identified by its call stack, fails: the first time, and the
last. Covers the program's own allocations, then those of HDF5, Open MPI and SUNDIALS.

    PETERKA_ENDURANCE_STRIDE=10 tests/endurance.sh memory_faults         only every tenth place
    PETERKA_ENDURANCE_KINDS=sweep,trace tests/endurance.sh memory_faults   only these; the table keeps the rows of the others
"""

import os
import sys
import tempfile
from collections import Counter
from pathlib import Path

import parts
import memory_faults

STRIDE = int(os.environ.get("PETERKA_ENDURANCE_STRIDE", "1"))


def main():
    problems = []
    for name in filter(parts.is_wanted, memory_faults.KINDS):
        tried, ends, wrong = Counter(), Counter(), []
        with tempfile.TemporaryDirectory() as folder:
            kind = memory_faults.Kind(name, Path(folder))
            for owner in memory_faults.OWNERS:
                for number in sorted({number for place in kind.places(owner)[::STRIDE] for number in place}):
                    tried[owner] += 1
                    ended, problem = kind.fails(owner, number)
                    ends[f"{owner} {ended}" if ended == "crashed" else ended] += 1
                    if problem:
                        print(problem, flush=True)
                        wrong.append(problem)
        problems += wrong
        outcome = f"**{len(wrong)} times not as it should be**" if wrong else (
            "the right file, or words and the right file from the next run: " + ", ".join(f"{end} {count}" for end, count in
                                                                                          sorted(ends.items())))
        parts.row(f"an allocation fails ({name}): " + ", ".join(f"{owner} {count}" for owner, count in tried.items()),
                  sum(tried.values()), outcome)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
