"""Puts the rows of one part into the table of a page, in place of those that the part put there before; where only some kinds
of files were wanted (PETERKA_ENDURANCE_KINDS), in place of those of the same fault, which stands before the colon.

usage: table.py PAGE PART ROWS_FILE
"""

import os
import sys
from datetime import date
from pathlib import Path

BEGIN = "<!-- tests/endurance.sh writes this table -->\n"
END = "<!-- end of the table -->\n"
HEAD = "| part | fault | tried | what happened | on |\n|---|---|---|---|---|\n"


def cells(row):
    return [cell.strip() for cell in row.strip().strip("|").split("|")]


def is_replaced(old, new):
    if not os.environ.get("PETERKA_ENDURANCE_KINDS"):
        return True
    return old[1].split(":")[0] in {row[1].split(":")[0] for row in new}


def with_rows(page, part, rows):
    before, rest = page.split(BEGIN)
    table, after = rest.split(END)
    kept = [cells(row) for row in table.splitlines()[2:]]
    new = [[part, *cells(row), date.today().isoformat()] for row in rows]
    table = sorted([row for row in kept if row[0] != part or not is_replaced(row, new)] + new, key=lambda row: row[0])
    return before + BEGIN + HEAD + "".join(f"| {' | '.join(row)} |\n" for row in table) + END + after


def main(page_file, part, rows_file):
    page = Path(page_file)
    page.write_text(with_rows(page.read_text(), part, Path(rows_file).read_text().splitlines()))


if __name__ == "__main__":
    main(*sys.argv[1:])
