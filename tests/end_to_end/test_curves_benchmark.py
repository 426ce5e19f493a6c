"""tests/benchmark/curves.py: a small run reports each kind and period, and errors against a closed form."""

import os
import re
import subprocess
import sys
from pathlib import Path

import launch
import pytest

pytestmark = pytest.mark.thorough

FOLDER = Path(__file__).resolve().parents[1] / "benchmark"


def test_curves_are_as_exact_as_their_page_says(tmp_path):
    build = tmp_path / "build"
    build.mkdir()
    (build / "peterka").symlink_to(launch.BINARY)
    page = tmp_path / "page" / "curves.md"
    done = subprocess.run([sys.executable, FOLDER / "curves.py", "--build", build, "--results", tmp_path, "--page", page, "--quick"],
                          capture_output=True, text=True, timeout=300, check=False, env=os.environ | launch.ENVIRONMENT)
    assert done.returncode == 0, done.stderr
    text = page.read_text(encoding="utf-8")
    rows = [row.strip("|").split("|") for row in re.findall(r"^\|.*\|$", text, re.MULTILINE)][2:]
    numbers = {row[0].strip(): [float(word.replace(",", "")) for word in row[1:]] for row in rows}
    for part in (("fold", "period doubling", "grazing"), ("q = 1", "q = 2", "q = 3", "q = 4")):
        assert sum(numbers[name][1] for name in part) == numbers["all"][1] > 1000
    assert all(speed > 0 and median <= most <= largest <= 1e-11 for _, _, speed, median, most, largest in numbers.values())
    median, largest = (float(word) for word in re.findall(r"off by ([\d.e-]+) .*? and ([\d.e-]+) ", text)[0])
    assert median <= largest < 1e-12
