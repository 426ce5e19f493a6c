"""tests/benchmark/laws.py: every kind of job runs, and ratios are those of the rounds."""

import sys
from pathlib import Path

import h5py
import launch
import numpy as np
import pytest

pytestmark = pytest.mark.thorough

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "benchmark"))
import laws  # noqa: E402
from bench import Bench  # noqa: E402


@pytest.fixture(name="bench")
def of_this_program(tmp_path, monkeypatch):
    (tmp_path / "build").mkdir()
    (tmp_path / "build" / "peterka").symlink_to(launch.BINARY)
    for name, value in launch.ENVIRONMENT.items():
        monkeypatch.setenv(name, value)
    return Bench(tmp_path / "build", tmp_path / "results")


def test_each_kind_of_job_runs_and_is_counted(bench):
    every = laws.kinds(points=12, few=3)
    for name, kind in every.items():
        cost = laws.cost(bench, name, kind)
        with h5py.File(next(bench.results.glob(f"laws_{name.replace(' ', '_')}.h5"))) as file:
            cells = 9 * 64 if "starts" in name else 144
            assert cost.cycles == pytest.approx(np.sum(file["cycles"][()]) / cells)
            assert cost.time > 0


def test_ratios_are_medians_of_rounds_that_belong_together():
    def costs(*times, cycles=1.0):
        return [laws.Cost(time, cycles) for time in times]
    rows = laws.rows_of({"rigid": costs(2.0, 9.0, 8.0), "linear": costs(1.0, 3.0, 2.0), "plane": costs(10.0, 20.0, 30.0, cycles=10),
                         "stiffness": costs(6.0, 6.0, 6.0, cycles=2), "damping": costs(1.0, 2.0, 3.0, cycles=2),
                         "starts": costs(4.0, 4.0, 4.0), "rigid starts": costs(2.0, 3.0, 5.0)})
    assert [row[1:] for row in rows] == [["3.00", "2.00 to 4.00", "1.2"], ["1.50", "1.00 to 3.00", "2"],
                                         ["0.50", "0.50 to 0.50", "1.5"], ["0.75", "0.50 to 1.25", "1.5"]]
