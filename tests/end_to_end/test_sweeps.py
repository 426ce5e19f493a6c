"""Sweeps: the same file at any number of ranks and after any interruption, and a summary of the findings."""

import os
import re
import shutil
import signal

import h5py
import numpy as np
import pytest

import jobs
import launch
import map_contents


@pytest.mark.parametrize("ranks", [1, 2, 3])
def test_a_sweep_is_the_same_at_any_number_of_ranks(tmp_path, small_sweep_file, ranks):
    jobs.write(tmp_path, jobs.small_sweep())
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", small_sweep_file)


def long_sweep():
    """Six branches that take a second or so each."""
    return jobs.small_sweep(points=4001)


@pytest.fixture(scope="module")
def long_sweep_file(tmp_path_factory):
    folder = tmp_path_factory.mktemp("long_sweep")
    jobs.write(folder, long_sweep())
    assert launch.run("run", "job.toml", "--quiet", cwd=folder, ranks=2).returncode == 0
    return folder / "job.h5"


def test_a_killed_sweep_goes_on_to_the_same_end(tmp_path, long_sweep_file):
    jobs.write(tmp_path, long_sweep())
    process = launch.start("run", "job.toml", cwd=tmp_path)
    assert "cells to compute" in process.stderr.readline()
    os.kill(process.pid, signal.SIGKILL)
    process.communicate(timeout=launch.HANGING)
    assert map_contents.done_tiles(tmp_path / "job.h5") < 6
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=3).returncode == 0
    map_contents.assert_same_map(tmp_path / "job.h5", long_sweep_file)


def test_a_stop_in_the_middle_of_a_branch_drops_it(tmp_path, long_sweep_file):
    jobs.write(tmp_path, long_sweep())
    process = launch.start("run", "job.toml", cwd=tmp_path)
    assert "cells to compute" in process.stderr.readline()
    process.send_signal(signal.SIGUSR1)
    _, errors = process.communicate(timeout=launch.HANGING)
    assert process.returncode == 5, errors
    assert map_contents.done_tiles(tmp_path / "job.h5") < 6
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=2).returncode == 0
    map_contents.assert_same_map(tmp_path / "job.h5", long_sweep_file)


@pytest.mark.parametrize("missing", [[4], [0, 1, 3, 5]])
def test_a_half_done_sweep_is_completed(tmp_path, small_sweep_file, missing):
    jobs.write(tmp_path, jobs.small_sweep())
    path = shutil.copy(small_sweep_file, tmp_path / "job.h5")
    map_contents.take_out(path, missing)
    assert map_contents.wrong_tiles(path, small_sweep_file) == 0  # tiles marked as done are still correct
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=3)
    assert finished.returncode == 0, finished.stderr
    there = 6 - len(missing)
    assert f"{41 * len(missing)} cells to compute, {41 * there} already in the file" in finished.stderr
    map_contents.assert_same_map(path, small_sweep_file)


@pytest.mark.parametrize("name", ["peak_force_ratio", "stroboscopic_displacement"])
def test_a_damaged_branch_is_computed_again(tmp_path, small_sweep_file, name):
    jobs.write(tmp_path, jobs.small_sweep())
    shutil.copy(small_sweep_file, tmp_path / "job.h5")
    with h5py.File(tmp_path / "job.h5", "r+") as file:
        first = file[name][(2, 3) + (0,) * (file[name].ndim - 2)]
        file[name][(2, 3) + (0,) * (file[name].ndim - 2)] = first + 1
        file["summary/finished"][()] = 0
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0 and "1 tiles are damaged" in finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", small_sweep_file)


def test_branches_hold_their_motions(small_sweep_file):
    with h5py.File(small_sweep_file) as file:
        assert file["gap_ratio"][:].tolist() == [0, 0, 1.5, 1.5, 2.5, 2.5]
        assert file["direction"][:].tolist() == [0, 1, 0, 1, 0, 1]
        periodic = file["regime"][:] == 1
        stored = np.isfinite(file["stroboscopic_displacement"][:]).sum(axis=2)
        touches = np.isfinite(file["impact_velocity"][:]).sum(axis=2)
        assert (stored[periodic] == np.minimum(file["period"][:][periodic], 8)).all()
        assert (touches[periodic] == np.minimum(file["impacts"][:][periodic], 8)).all()
        assert (touches[file["regime"][:] == 0] == 0).all()
        # no jump at gap 0; at 1.5 from z = 1/1 to no impact after 1.862 going up, and back before 1.732 going down
        frequency = file["frequency_ratio"][:]
        landed = [frequency[row == 1].round(2).tolist() for row in file["jump"][:]]
        assert landed[:2] == [[], []]
        assert landed[2] == [0.8, 1.9] and landed[3] == [0.7, 1.75, 2.05]


def test_the_summary_tells_what_a_sweep_shows(tmp_path):
    jobs.write(tmp_path, jobs.small_sweep())
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0
    for words in ["246 cells: 41 by 6 excitation frequencies and branches", "Gap/A0 1.5 (1.335 mm)", "impact resonance",
                  "jumps", "hysteresis", "up 1/1, down no impact", "Sweep file job.h5"]:
        assert words in finished.stdout, finished.stdout


def test_places_that_are_close_are_told_apart(tmp_path):
    """Between 11.2 and 11.3 Hz four digits give neighbouring points one name."""
    jobs.write(tmp_path, jobs.small_sweep(points=101, gaps="[1.5]"))
    finished = launch.run("run", "job.toml", "--set", "axes.frequency_ratio.from=2.48", "--set", "axes.frequency_ratio.to=2.5",
                          cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    spans = re.findall(r"([\d.]+) \([\d.]+ Hz\) to ([\d.]+) \([\d.]+ Hz\)", finished.stdout)
    assert spans and all(first != last for first, last in spans), finished.stdout


def test_check_prints_branches_and_the_files_size(tmp_path, small_sweep_file):
    jobs.write(tmp_path, jobs.small_sweep())
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 0
    assert "cells    246: 41 of frequency_ratio by 6 of branch" in checked.stdout
    assert "3    gap/A0 1.5 (1.335 mm), down" in checked.stdout
    foretold = float(checked.stdout.split("job.h5, ")[1].split(" kB")[0]) * 1000
    assert 0 <= foretold + 100 - small_sweep_file.stat().st_size < 20_000
    assert sorted(path.name for path in tmp_path.iterdir()) == ["job.toml"]


def test_one_direction_alone_and_fields_on_request(tmp_path):
    jobs.write(tmp_path, jobs.small_sweep(points=5, direction="independent") + '[output]\nfields = ["multiplier"]\n')
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    with h5py.File(tmp_path / "job.h5") as file:
        assert file["direction"][:].tolist() == [2, 2, 2]
        assert file["multiplier"].shape == (3, 5)
        assert file["stroboscopic_velocity"].shape == (3, 5, 8)


def test_jumps_on_a_rigid_stop_are_those_of_its_impact_speed(tmp_path):
    """It has no peak force; whether the speed is stored makes no difference to where the jumps are."""
    marks, said = {}, {}
    for name, fields in (("with", '[output]\nfields = ["impact_speed"]\n'), ("without", "")):
        jobs.write(tmp_path, jobs.with_rigid_stop(jobs.small_sweep(points=81)) + fields, f"{name}.toml")
        finished = launch.run("run", f"{name}.toml", cwd=tmp_path)
        assert finished.returncode == 0, finished.stderr
        said[name] = finished.stdout
        with h5py.File(tmp_path / f"{name}.h5") as sweep:
            marks[name] = sweep["jump"][()]
            if name == "with":
                speed, regime, down = sweep["impact_speed"][()], sweep["regime"][()], sweep["direction"][()] == 1
    assert np.array_equal(marks["with"], marks["without"]) and np.any(marks["with"])
    for row in range(len(speed)):
        change = np.abs(np.diff(speed[row]))
        jumps = np.flatnonzero(marks["with"][row]) - (0 if down[row] else 1)  # step between a point and the next one
        assert np.all(change[jumps] > np.max(speed[row]) / 20)
        settled = np.isin(regime[row], [0, 1])
        lonely = [step for step in np.flatnonzero(change > 0.3 * np.max(speed[row]))
                  if settled[max(step - 4, 0):step + 6].all() and np.sort(change[max(step - 4, 0):step + 5])[-2] < change[step] / 5]
        assert set(lonely) <= set(jumps), (row, lonely, jumps)
    line = next(line for line in said["with"].splitlines() if "jumps" in line and "from" in line)
    assert "m/s)" in line or "(0 m/s)" in line, line
    assert "not looked for" not in said["without"] and " N)" not in line


SHORT = """
schema = 1
kind = "sweep"
title = "jumps"
hammer = {{ mass_kg = {mass}, natural_frequency_hz = {frequency}, damping_ratio = {damping} }}
cart = {{ amplitude_m = {amplitude} }}
contact = {{ {contact} }}
{axes}
{table}direction = "both"
"""
AT_THE_END_OF_ONE_TO_ONE = SHORT.format(
    mass=0.026956780316263303, frequency=91.5466686315967, damping=0.33349408866349156, amplitude=0.0010481726027248997,
    contact='law = "kelvin_voigt", stiffness_n_per_m = 239080517.99853033, damping_ns_per_m = 4371.270871173238',
    axes="operating_point = { frequency_ratio = 1.0890477694361473 }\naxes = { gap_ratio = { from = 0.0, to = 3.0, points = 200 } }",
    table="[sweep]\n")
IN_BOTH_DIRECTIONS = SHORT.format(
    mass=9.554784443245921, frequency=96.05453625360211, damping=0.02627300980762227, amplitude=0.0015601553022052009,
    contact='law = "kelvin_voigt", stiffness_n_per_m = 618411463.130419, damping_ns_per_m = 25728.45330440762',
    axes="axes = { frequency_ratio = { from = 0.5, to = 4.0, points = 150 } }", table="[sweep]\ngap_ratio = [0.2593707282862796]\n")
STEEP_BUT_CONTINUOUS = SHORT.format(
    mass=0.13064352033348822, frequency=2.5458020047238885, damping=0.01, amplitude=0.00020175194053459136,
    contact='law = "restitution", coefficient = 0.11273362834652521',
    axes="operating_point = { gap_ratio = 0.6558523100259113 }\naxes = { frequency_ratio = { from = 0.5, to = 4.0, points = 400 } }",
    table='[output]\nfields = ["impact_speed"]\n[sweep]\n')


@pytest.mark.parametrize("text, up, down", [(AT_THE_END_OF_ONE_TO_ONE, [107], [104]), (IN_BOTH_DIRECTIONS, [101], [99]),
                                            (STEEP_BUT_CONTINUOUS, [], [])], ids=["end of 1/1", "both directions", "continuous"])
def test_where_a_fold_ends_a_steep_way_there_is_a_jump(tmp_path, text, up, down):
    """Each is one step of a sweep a hundred times finer, by another integrator, too; what begins like a square root is in many."""
    for folder, more in (("plain", ""), ("proved", '[certificate]\ncells = "all"\nstarts = true\n')):
        (tmp_path / folder).mkdir()
        jobs.write(tmp_path / folder, text + more)
        finished = launch.run("run", "job.toml", cwd=tmp_path / folder)
        assert finished.returncode == 0, finished.stderr
        with h5py.File(tmp_path / folder / "job.h5") as file:
            assert [np.flatnonzero(branch).tolist() for branch in file["jump"][()]] == [up, down]
