"""Writes the manual page of the program, which is what it tells with --help.

usage: manual.py PROGRAM PAGE
"""

import subprocess
import sys
from pathlib import Path


def told(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def verbatim(text):
    """As it is: no line of roff begins with a dot or a quote, and a backslash stands for itself."""
    lines = text.rstrip("\n").replace("\\", "\\e").replace("-", "\\-").split("\n")
    return ".nf\n" + "".join(f"\\&{line}\n" if line[:1] in (".", "'") else f"{line}\n" for line in lines) + ".fi\n"


def main():
    program, page = sys.argv[1], Path(sys.argv[2])
    version = told(program, "--version").split()[1]
    sections = {"DESCRIPTION": [], "RUN": ["run"], "CHECK": ["check"]}
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text(
        f'.TH PETERKA 1 "" "peterka {version}"\n.SH NAME\npeterka \\- maps of a hammer that strikes a stop inside a vibrating cart\n'
        + "".join(f".SH {name}\n{verbatim(told(program, *command, '--help'))}" for name, command in sections.items())
        + ".SH SEE ALSO\nEach of peterka\\-draw, peterka\\-explore, peterka\\-compare, peterka\\-export, peterka\\-operating\\-point and "
          "peterka\\-identify tells its use with \\-\\-help.\n", encoding="utf-8")


if __name__ == "__main__":
    main()
