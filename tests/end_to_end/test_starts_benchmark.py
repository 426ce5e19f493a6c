"""tests/benchmark/starts.py: its arithmetic on simple cells, and a small run of it."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import launch

pytestmark = pytest.mark.thorough

FOLDER = Path(__file__).resolve().parents[1] / "benchmark"
sys.path.insert(0, str(FOLDER))

import starts  # noqa: E402

ONE, HALF, QUIET = (1, 1, 1), (1, 1, 2), (0, 0, 1)


def test_errors_and_what_random_starts_would_err():
    truth = starts.Found([{ONE: 0.5, QUIET: 0.5}, {QUIET: 1.0}, {HALF: 0.9, QUIET: 0.1}], 0, 0)
    found = starts.Found([{ONE: 0.75, QUIET: 0.25}, {QUIET: 1.0}, {HALF: 1.0}], 3 * 4 * 50, 6.0)
    row = starts.row_of(4, found, truth)
    assert (row.seconds, row.cycles) == (2.0, 50.0)
    assert row.error == pytest.approx(((2 * 0.25**2 + 2 * 0.1**2) / 4)**0.5)  # the cell with one attractor contributes nothing
    assert row.bound == pytest.approx(((2 * 0.5**2 + 2 * 0.09) / 4 / 4)**0.5)
    assert row.largest == 0.25 and row.found == 0.75
    assert row.attractors == pytest.approx(4 / 3)
    assert row.expected == pytest.approx((2 * (1 - 0.5**4) + 1 - 0.1**4 + 1 - 0.9**4) / 4)


def test_starts_err_less_than_random_ones(tmp_path):
    build = tmp_path / "build"
    build.mkdir()
    (build / "peterka").symlink_to(launch.BINARY)
    page = tmp_path / "starts.md"
    done = subprocess.run([sys.executable, FOLDER / "starts.py", "--build", build, "--results", tmp_path, "--page", page, "--quick"],
                          capture_output=True, text=True, timeout=300, check=False, env=os.environ | launch.ENVIRONMENT)
    assert done.returncode == 0, done.stderr
    rows = re.findall(r"^\| (\d+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) ", page.read_text(encoding="utf-8"), re.MULTILINE)
    assert [int(row[0]) for row in rows] == list(starts.COUNTS)
    errors, bounds = ([float(row[n]) for row in rows] for n in (3, 4))
    assert all(error < bound for error, bound in zip(errors, bounds))
    assert errors[-1] < 0.1 * errors[0]
    assert page.with_suffix(".png").stat().st_size > 5000
