"""Softening springs throw the hammer out of their well: such an end counts wherever motions end elsewhere. Numbers to compare with
are of another integrator (Taylor series of order 22 with event location)."""

import re

import h5py
import pytest

import jobs
import launch

pytestmark = pytest.mark.thorough

RIG = """schema = 1
kind = "map"
title = "softening"
[hammer]
mass_kg = 0.23
natural_frequency_hz = 8.69
damping_ratio = 0.06
cubic_stiffness_n_per_m3 = -8370225.955567086
cubic = "relative"
[cart]
amplitude_m = 0.00128
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 1305212.3888451064
damping_ns_per_m = 521.8485554923045
[solver]
omit_tolerance = 0
[steady_state]
max_cycles = 600
[limits]
failed_cells = 5
"""
CELL = RIG + jobs.axis("frequency_ratio", 1.6, 1.6, 1) + jobs.axis("gap_ratio", 0.3, 0.3, 1)


def run(folder, more):
    jobs.write(folder, CELL + more)
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        return {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}, finished.stdout


# There, at phase 0.6406, 124.4 mm/s away from the stop lead back, 127.2 throw it out within 3 cycles.
def test_a_kick_that_throws_the_hammer_out_ends_elsewhere(tmp_path):
    cell, summary = run(tmp_path, '[output]\nfields = ["orbit", "critical_kick"]\n')
    assert 0.12 < cell["critical_kick"][0, 0] < 0.1273
    assert cell["critical_kick_direction"][0, 0] == -1
    assert cell["critical_kick_phase"][0, 0] == pytest.approx(0.63, abs=0.04)
    assert "a kick leads elsewhere, the smallest one found 127 mm/s" in summary


# Of 600 random starts there 35 % leave.
def test_starts_that_leave_are_told(tmp_path):
    starts = "[starts]\ncount = 200\ndisplacement_ratio = [-9.0, 0.3]\nvelocity_ratio = [-8.0, 8.0]\n"
    cell, summary = run(tmp_path, starts)
    share = float(re.search(r"\(failed\): in 100\.0 % of the cells,\n  up to ([\d.]+) % of a cell's starts\n", summary)[1])
    assert share == pytest.approx(35.3, abs=3 * 100 * (0.35 * 0.65 / 200 + 0.35 * 0.65 / 600) ** 0.5)
    assert "attractors on which they end: 1: 100.0 %" in summary
    assert cell["attractors"][0, 0] == 2


# 24 motions there lived for 73 cycles in the mean, 5.25 s.
def test_a_disturbed_motion_that_is_thrown_out_has_lived(tmp_path):
    noise = "[noise]\nacceleration_m_s2_per_sqrt_hz = 0.5112372319185655\ncycles = 50000\n"
    cell, summary = run(tmp_path, noise)
    life, error = cell["mean_life_s"][0, 0], cell["mean_life_error_s"][0, 0]
    assert life == pytest.approx(5.25, abs=3 * ((5.25**2 / 24) + error**2) ** 0.5)
    assert error < 0.25 * life
    assert "seen to end; the shortest mean life is" in summary
