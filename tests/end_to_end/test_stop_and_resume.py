"""A run that is stopped or killed leaves a file that the same command resumes to the same result."""

import fcntl
import os
import random
import re
import shutil
import signal
import subprocess

import h5py
import pytest

import jobs
import kills
import launch
import map_contents
import uncertain_rigs


def run_to_the_end(folder, *arguments, ranks=None, seconds=None):
    """Repeats the same command while it reports an early stop; returns the number of such stops.

    With `seconds`, each run gets 1.5 times the limit of the previous one, so that one suffices even on a busy machine.
    """
    for stops in range(60):
        limit = [] if seconds is None else ["--max-wall", seconds * 1.5**stops]
        finished = launch.run("run", "job.toml", *limit, *arguments, cwd=folder, ranks=ranks)
        if finished.returncode != 5:
            assert finished.returncode == 0, finished.stderr
            return stops
    raise AssertionError("never came to an end")


def test_no_time_at_all_stops_before_the_first_cell(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    finished = launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path)
    assert finished.returncode == 5
    assert map_contents.done_tiles(tmp_path / "job.h5") == 0
    said = [line for line in launch.messages(finished) if "stopped early" in line]
    assert len(said) == 1
    assert "--max-wall" in said[0] and "the same command goes on" in said[0]


def test_after_fresh_the_way_on_is_without_it(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    finished = launch.run("run", "job.toml", "--fresh", "--max-wall", "1e-9", cwd=tmp_path)
    assert "without --fresh" in finished.stderr


@pytest.mark.thorough
@pytest.mark.parametrize("ranks", [None, 3])
def test_many_short_runs_make_the_same_file_as_one(tmp_path, larger_map_file, ranks):
    jobs.write(tmp_path, jobs.larger_map())
    assert launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path, ranks=ranks).returncode == 5
    run_to_the_end(tmp_path, "--quiet", ranks=ranks, seconds=0.2)
    map_contents.assert_same_map(tmp_path / "job.h5", larger_map_file)


def test_a_stopped_run_shows_the_whole_map_in_part(tmp_path):
    jobs.write(tmp_path, jobs.larger_map())
    seconds, done = 0.1, 0
    while done < 60:  # of 400
        assert launch.run("run", "job.toml", "--max-wall", seconds, cwd=tmp_path).returncode == 5
        seconds, done = 1.2 * seconds, map_contents.done_tiles(tmp_path / "job.h5")
    with h5py.File(tmp_path / "job.h5") as file:
        tiles = file["tiles/done"][()].reshape(20, 20) == 1
    blocks = tiles.reshape(4, 5, 4, 5).any(axis=(1, 3))
    assert blocks.all(), tiles.astype(int)


def start_and_wait_for_work(folder, ranks):
    jobs.write(folder, jobs.larger_map())
    process = launch.start("run", "job.toml", cwd=folder, ranks=ranks)
    assert "cells to compute" in process.stderr.readline()
    return process


@pytest.mark.parametrize("ranks", [None, 3])
def test_usr1_stops_all_ranks_and_the_run_goes_on(tmp_path, larger_map_file, ranks):
    process = start_and_wait_for_work(tmp_path, ranks)
    process.send_signal(signal.SIGUSR1)
    _, errors = process.communicate(timeout=launch.HANGING)
    assert process.returncode == 5, errors
    assert "SIGUSR1" in errors
    assert map_contents.done_tiles(tmp_path / "job.h5") < map_contents.tile_count(tmp_path / "job.h5")
    assert run_to_the_end(tmp_path, "--quiet", ranks=ranks) == 0
    map_contents.assert_same_map(tmp_path / "job.h5", larger_map_file)


@pytest.mark.parametrize("name", ["SIGTERM", "SIGINT"])
def test_other_signals_stop_a_program_of_its_own(tmp_path, name):
    process = start_and_wait_for_work(tmp_path, ranks=None)
    process.send_signal(getattr(signal, name))
    _, errors = process.communicate(timeout=launch.HANGING)
    assert process.returncode == 5, errors
    assert name in errors


def test_ctrl_c_under_mpirun_says_what_happened_and_how_to_go_on(tmp_path):
    """mpirun turns it into SIGTERM, that of Open MPI 4 about two seconds later, and ends with its own code; that of Open MPI
    5 no longer forwards the ranks' output."""
    jobs.write(tmp_path, jobs.small_map(columns=1500, rows=1500))
    process = launch.start("run", "job.toml", cwd=tmp_path, ranks=2)
    assert "cells to compute" in process.stderr.readline()
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=launch.HANGING)
    said = [line for line in errors.splitlines() if line.startswith("peterka: stopped early")]
    if launch.hands_on_last_words():
        assert len(said) == 1, errors
        assert "what is finished is kept, and the same command goes on from job.h5" in said[0]
    if "mpich" not in launch.MPIEXEC:
        assert process.returncode not in (0, 5)
    if "mpich" not in launch.MPIEXEC and launch.hands_on_last_words():
        assert re.search("SIGTERM from mpi(run|exec), which sends it upon Ctrl-C, too, and ends with its own exit code",
                         said[0]), said
    assert 0 < map_contents.done_tiles(tmp_path / "job.h5") < map_contents.tile_count(tmp_path / "job.h5")


@pytest.mark.parametrize("ranks", [None, 3])
def test_a_run_with_a_killed_rank_ends_and_goes_on(tmp_path, larger_map_file, ranks):
    process = start_and_wait_for_work(tmp_path, ranks)
    os.kill(launch.computing(process)[-1], signal.SIGKILL)
    process.communicate(timeout=launch.HANGING)
    assert process.returncode != 0
    assert run_to_the_end(tmp_path, "--quiet") == 0
    map_contents.assert_same_map(tmp_path / "job.h5", larger_map_file)


@pytest.mark.thorough
def test_kills_at_random_moments_lose_nothing(tmp_path, medium_map_file):
    """tests/endurance.sh kills some hundred more."""
    jobs.write(tmp_path, jobs.medium_map())
    toll = kills.campaign(tmp_path, medium_map_file, 10, random.Random(1), longest=0.3)
    assert toll.harm == 0, toll


@pytest.mark.thorough
def test_kills_lose_nothing_of_the_outcomes_of_drawn_rigs(tmp_path):
    job = uncertain_rigs.small_map(rigs=20, columns=64, rows=64)
    whole, _ = uncertain_rigs.compute(tmp_path, job, "--quiet", ranks=2)
    whole = whole.rename(tmp_path / "whole.h5")
    spoilt = shutil.copy(whole, tmp_path / "spoilt.h5")
    with h5py.File(spoilt, "r+") as file:
        file["outcome_period"][0, 20, 39] += 1  # would be seen
    assert map_contents.wrong_tiles(spoilt, whole) == 1
    toll = kills.campaign(tmp_path, whole, 6, random.Random(1), longest=0.4)
    assert toll.harm == 0, toll


def test_a_wrong_tile_would_be_seen(tmp_path, small_map_file):
    """Validates the test above."""
    path = shutil.copy(small_map_file, tmp_path)
    assert map_contents.wrong_tiles(path, small_map_file) == 0
    with h5py.File(path, "r+") as file:
        file["cycles"][20, 39] += 1
        file["peak_force_ratio"][34, 0] = 1e9
    assert map_contents.wrong_tiles(path, small_map_file) == 2
    with h5py.File(path, "r+") as file:
        file["tiles/done"][5] = 0
    assert map_contents.wrong_tiles(path, small_map_file) == 1


def test_more_or_fewer_ranks_may_go_on(tmp_path, larger_map_file):
    jobs.write(tmp_path, jobs.larger_map())
    launch.run("run", "job.toml", "--max-wall", "0.3", cwd=tmp_path, ranks=4)
    assert run_to_the_end(tmp_path, "--quiet", ranks=2) == 0
    map_contents.assert_same_map(tmp_path / "job.h5", larger_map_file)


def damage(path, tile):
    """Changes one stored number and unmarks the file as finished: as if a run had broken off, badly."""
    with h5py.File(path, "r+") as file:
        assert file["tiles/done"][tile] == 1
        file["cycles"][0, 0] += 1
        file["summary/finished"][()] = 0


@pytest.mark.parametrize("ranks", [None, 3])
def test_a_damaged_tile_is_computed_again(tmp_path, small_map_file, ranks):
    jobs.write(tmp_path, jobs.small_map())
    shutil.copy(small_map_file, tmp_path / "job.h5")
    damage(tmp_path / "job.h5", tile=0)
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    assert any("damaged" in line for line in launch.messages(finished))
    map_contents.assert_same_map(tmp_path / "job.h5", small_map_file)


def test_a_complete_file_is_left_alone(tmp_path, small_map_file):
    jobs.write(tmp_path, jobs.small_map())
    shutil.copy(small_map_file, tmp_path / "job.h5")
    before = (tmp_path / "job.h5").read_bytes()
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    assert "job.h5 is complete" in finished.stdout
    assert (tmp_path / "job.h5").read_bytes() == before


@pytest.mark.parametrize("ranks", [None, 2])
def test_more_failed_cells_than_allowed(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_map(columns=8, rows=8))
    impossible = ["--set", "contact.damping_ns_per_m=1e30"]  # no cell can be followed through such a contact
    for _ in ("computed", "shown again"):
        finished = launch.run("run", "job.toml", *impossible, cwd=tmp_path, ranks=ranks)
        assert finished.returncode == 4
        assert "too many contacts in one cycle" in finished.stdout
    with h5py.File(tmp_path / "job.h5") as file:
        failed = int((file["regime"][:] == 5).sum())
    assert failed > 0
    assert len([line for line in launch.messages(finished) if f"{failed} cells failed" in line]) == 1
    allowed = ["--set", f"limits.failed_cells={failed}"]
    assert launch.run("run", "job.toml", *impossible, *allowed, cwd=tmp_path).returncode == 0


def test_a_damaged_finished_map_is_not_shown(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    with h5py.File(tmp_path / "job.h5", "r+") as file:
        file["peak_force_ratio"][0, 20] = 1e9
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3
    assert "damaged" in finished.stderr and "--fresh" in finished.stderr
    assert finished.stdout == ""


@pytest.mark.parametrize("log", ["/dev/full", "closed"])
def test_a_log_that_cannot_be_written_does_not_end_the_run(tmp_path, log):
    jobs.write(tmp_path, jobs.small_map())
    redirection = "2>&-" if log == "closed" else f"2>{log}"
    command = f"'{launch.BINARY}' run job.toml {redirection}"
    finished = subprocess.run(["sh", "-c", command], cwd=tmp_path, stdin=subprocess.DEVNULL, capture_output=True)
    assert finished.returncode == 0


def test_a_run_holds_the_lock_of_its_file_until_its_end(tmp_path):
    first = start_and_wait_for_work(tmp_path, ranks=2)
    with open(tmp_path / "job.h5.peterka-lock") as lock, pytest.raises(BlockingIOError):
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    first.communicate(timeout=launch.HANGING)
    assert first.returncode == 0
    assert not (tmp_path / "job.h5.peterka-lock").exists()


@pytest.mark.thorough
@pytest.mark.parametrize("fresh", [[], ["--fresh"]])
def test_a_file_that_another_run_writes_is_not_entered(tmp_path, fresh):
    jobs.write(tmp_path, jobs.small_map())
    with open(tmp_path / "job.h5.peterka-lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        finished = launch.run("run", "job.toml", *fresh, cwd=tmp_path)
    assert finished.returncode == 3
    assert "job.h5: is being written by another run" in finished.stderr
    assert not (tmp_path / "job.h5").exists()


# A hammer of 1e-20 kg rings on the stop: one forcing cycle takes minutes.
ENDLESS = ["--set", "hammer.mass_kg=1e-20", "--set", "hammer.cubic_stiffness_n_per_m3=238.23"]
# A trace of it gives up at once, as forces are noise; this one rings in each contact, for a second and a half a cycle.
RINGS = ["--set", "hammer.mass_kg=1e-16", "--set", "contact.damping_ns_per_m=0", *ENDLESS[2:]]
SLOW = {
    "map": jobs.small_map(columns=32, rows=32),
    "basin": jobs.small_basin(points=32),
    "sweep": jobs.small_sweep(points=41),
    "trace": jobs.trace(0.5),
    "study": jobs.small_precision_study(),
    "curves": jobs.small_curves(),
    "map with starts": jobs.small_map(columns=32, rows=32) + "[starts]\ncount = 16\n",
}


@pytest.mark.parametrize("kind", SLOW)
def test_a_cycle_that_takes_minutes_is_left_in_its_middle(tmp_path, kind):
    jobs.write(tmp_path, SLOW[kind])
    finished = launch.run("run", "job.toml", "--max-wall", "1", *(RINGS if kind == "trace" else ENDLESS), cwd=tmp_path)
    assert finished.returncode == 5, finished.stderr
    assert sum("stopped early" in line for line in finished.stderr.splitlines()) == 1


@pytest.mark.parametrize("ranks", [None, 3])
def test_a_pass_over_a_finished_map_stops_too(tmp_path, larger_map_file, ranks):
    jobs.write(tmp_path, jobs.larger_map())
    shutil.copy(larger_map_file, tmp_path / "job.h5")
    finished = launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 5 and finished.stdout == ""
    assert len([line for line in launch.messages(finished) if "stopped early" in line and "it is complete" in line]) == 1
    map_contents.assert_same_map(tmp_path / "job.h5", larger_map_file)


def test_statistics_and_attractors_stop_and_are_made_by_the_next_run(tmp_path):
    """All tiles are there; only the products of a pass over them are missing."""
    jobs.write(tmp_path, jobs.small_basin())
    assert launch.run("run", "job.toml", "--output", "right.h5", cwd=tmp_path).returncode == 0
    shutil.copy(tmp_path / "right.h5", tmp_path / "job.h5")
    with h5py.File(tmp_path / "job.h5", "r+") as file:
        file["summary/finished"][()] = 0
        file["summary/checksum"][()] = 0
    finished = launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path)
    assert finished.returncode == 5 and "the same command goes on" in finished.stderr
    assert launch.run("run", "job.toml", cwd=tmp_path).returncode == 0
    map_contents.assert_same_map(tmp_path / "job.h5", tmp_path / "right.h5")
