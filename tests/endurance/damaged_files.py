#!/usr/bin/python3
"""Finished files of eight kinds, damaged by the thousand, read by peterka.open, draw.py, explore.py and run: single bits
anywhere and in headers, sizes and texts; sectors zeroed, repeated and swapped; ends cut off at each 512 bytes.

    PETERKA_ENDURANCE_FILES=2500 tests/endurance.sh damaged_files           so many of each kind; `run` reads each tenth
    PETERKA_ENDURANCE_KINDS="sweep,map with starts" tests/endurance.sh ...   only these; the table keeps the rows of the others
"""

import os
import random
import sys
import tempfile
from collections import Counter
from pathlib import Path

import h5py

import parts
import damaged_files

FILES = int(os.environ.get("PETERKA_ENDURANCE_FILES", "2500"))
RUN_EACH = int(os.environ.get("PETERKA_ENDURANCE_RUN_EACH", "10"))


def main():
    all_wrong = 0
    for number, kind in enumerate(damaged_files.KINDS):
        if not parts.is_wanted(kind):
            continue
        came, by_run, wrong = Counter(), Counter(), []
        with tempfile.TemporaryDirectory() as folder:
            readers = damaged_files.Readers(Path(folder), kind)
            for count, damage in enumerate(damaged_files.damages(readers.content, FILES, random.Random(number))):
                for reader, counted in ((readers.by_python, came), *([(readers.by_run, by_run)] * (count % RUN_EACH == 0))):
                    outcome, what = reader(damage)
                    counted[outcome] += 1
                    if outcome == "wrong":
                        print(f"{kind}, {damage.what}: {what}", flush=True)
                        wrong.append(what)
        all_wrong += len(wrong)
        said = f"**{len(wrong)} times wrong: {', '.join(sorted(set(wrong)))[:200]}**" if wrong else (
            "0 signals, 0 hangs over 10 s, 0 gigabytes taken, 0 shown as sound")
        parts.row(f"damaged bytes ({kind}): peterka.open, draw.py, explore.py {sum(came.values())}, run {sum(by_run.values())} "
                  f"(HDF5 {h5py.version.hdf5_version})", sum(came.values()) + sum(by_run.values()),
                  f"{said}; {came['refused'] + by_run['refused']} refused, {came['unread'] + by_run['unread']} shown as they "
                  "were: /run, or room that nobody reads")
    return 1 if all_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
