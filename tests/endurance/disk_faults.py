#!/usr/bin/python3
"""Each call to the system fails once in a small run of each kind: every write, read, fsync, ftruncate, fallocate, rename
and unlink of its files, by the errors of disk_faults.HOWS in turn (all of them where a run makes few calls).

    PETERKA_ENDURANCE_STRIDE=10 tests/endurance.sh disk_faults            only every tenth, where there are many
    PETERKA_ENDURANCE_KINDS=sweep,trace tests/endurance.sh disk_faults   only these; the table keeps the rows of the others
"""

import os
import sys
import tempfile
from collections import Counter
from pathlib import Path

import parts
import disk_faults

STRIDE = int(os.environ.get("PETERKA_ENDURANCE_STRIDE", "1"))
FEW = 20  # calls of a kind: then each is tested with every error


def faults(kind):
    """(call, number, how), all of them."""
    turn = 0
    for call in disk_faults.CALLS:
        hows = [how for how in disk_faults.HOWS if how != "short" or call in ("write", "read")]
        for number in range(1, kind.calls[call] + 1):
            if kind.calls[call] <= FEW:
                yield from ((call, number, how) for how in hows)
                continue
            turn += 1
            if turn % STRIDE == 0:
                yield call, number, hows[turn // STRIDE % len(hows)]


def main():
    problems = []
    for name in filter(parts.is_wanted, disk_faults.KINDS):
        with tempfile.TemporaryDirectory() as folder:
            kind = disk_faults.Kind(name, Path(folder))
            tried = Counter()
            for call, number, how in faults(kind):
                tried[call] += 1
                problem = kind.fails(call, number, how)
                if problem:
                    print(problem, flush=True)
                    problems.append(problem)
        calls = ", ".join(f"{call} {count}" for call, count in tried.items())
        wrong = [problem for problem in problems if problem.startswith(name + ",")]
        outcome = f"**{len(wrong)} times not as it should be**" if wrong else (
            "the right file, or exit 3 with path and cause and the right file from the next run; no signal, no wrong file")
        parts.row(f"a call fails once ({name}): {calls}", sum(tried.values()), outcome)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
