"""What the programs share on the command line."""

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from peterka.cli import command_line
from peterka.errors import PeterkaFileError

POSTPROCESS = Path(__file__).parents[2] / "postprocess"
WORK = """
import sys
from peterka.cli.command_line import working
with working(sys.argv[1]):
    sys.exit(int(sys.stdin.readline()))
"""


def begin(stderr, name="release.csv", columns="80"):
    return subprocess.Popen([sys.executable, "-c", WORK, name], cwd=POSTPROCESS, stdin=subprocess.PIPE, stderr=stderr, text=True,
                            env=os.environ | {"COLUMNS": columns})


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
    process.stdin.write("3\n")  # an exception ends it, too
    process.stdin.close()
    rest = "".join(iter(lambda: read(ours), ""))
    assert process.wait() == 3
    assert rest.endswith("\r\x1b[K") and rest.strip("\r\x1b[K") in ("", "release.csv: 3 s")
    os.close(ours)


def test_of_a_long_name_the_end_is_shown_in_one_row():
    ours, theirs = pty.openpty()
    process = begin(theirs, "folder/" * 30 + "a.csv", columns="24")
    os.close(theirs)
    assert read(ours) == "\r" + ("folder/" * 30 + "a.csv: 1 s")[-23:]
    process.communicate("0\n")
    assert process.returncode == 0
    os.close(ours)


def test_elsewhere_it_says_nothing():
    process = begin(subprocess.PIPE)
    assert process.communicate("0\n")[1] == ""
    assert process.returncode == 0


def test_no_picture_replaces_another_of_the_same_call(tmp_path):
    """As those of a basin b.h5, b_basin_impact, and of a trace b_basin.h5; the next call may."""
    command_line.OneLineParser("")
    command_line.save_all(Figure(), tmp_path, "b_basin_impact", ["png", "pdf"])
    first = (tmp_path / "b_basin_impact.png").read_bytes()
    with pytest.raises(PeterkaFileError, match="b_basin_impact.png is written already, of another of these files"):
        command_line.save_all(Figure((1, 1)), tmp_path, "b_basin_impact", ["png"])
    assert (tmp_path / "b_basin_impact.png").read_bytes() == first
    command_line.OneLineParser("")
    command_line.save_all(Figure((1, 1)), tmp_path, "b_basin_impact", ["png"])
    assert (tmp_path / "b_basin_impact.png").read_bytes() != first


@pytest.mark.parametrize("names", ["png,png", "png,pdf,png"])
def test_a_format_named_twice_is_written_once(names):
    assert command_line.read_formats(names) == list(dict.fromkeys(names.split(",")))
