"""What the programs share on the command line."""

import os
import pty
import subprocess
import sys
from pathlib import Path

POSTPROCESS = Path(__file__).parents[2] / "postprocess"
WORK = """
import sys
from peterka.cli.command_line import working
with working("release.csv"):
    sys.stdin.readline()
"""


def begin(stderr):
    return subprocess.Popen([sys.executable, "-c", WORK], cwd=POSTPROCESS, stdin=subprocess.PIPE, stderr=stderr, text=True)


def read(terminal):
    try:
        return os.read(terminal, 1000).decode()
    except OSError:  # its last user has left
        return ""


def test_long_work_says_on_a_terminal_how_long_it_takes():
    ours, theirs = pty.openpty()
    process = begin(theirs)
    os.close(theirs)
    shown = ""
    while "2 s" not in shown:
        piece = read(ours)
        assert piece, shown
        shown += piece
    assert shown == "\rrelease.csv: 1 s\rrelease.csv: 2 s"
    process.stdin.write("\n")
    process.stdin.close()
    rest = "".join(iter(lambda: read(ours), ""))
    assert process.wait() == 0
    assert rest.endswith("\r\x1b[K") and rest.strip("\r\x1b[K") in ("", "release.csv: 3 s")
    os.close(ours)


def test_elsewhere_it_says_nothing():
    process = begin(subprocess.PIPE)
    assert process.communicate("\n")[1] == ""
    assert process.returncode == 0
