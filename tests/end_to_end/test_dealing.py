"""The dealing of tiles alone, with artificial work: none lost, none dealt twice, and all ranks end together."""

import re

import pytest

import launch

pytestmark = pytest.mark.thorough

RANKS = [None, 1, 2, 4, 7]


def check(folder, *task, ranks):
    return launch.run(*task, cwd=folder, ranks=ranks, binary=launch.DEALING_CHECK)


def outcome(finished):
    numbers = re.findall(r"\d+", finished.stdout)
    assert len(numbers) == 5, finished.stdout + finished.stderr
    return dict(zip(["finished", "solved", "twice", "progress", "largest_share"], map(int, numbers)))


@pytest.mark.parametrize("ranks", RANKS)
@pytest.mark.parametrize("tiles", [0, 1, 5, 300])
def test_every_tile_is_solved_once(tmp_path, ranks, tiles):
    finished = check(tmp_path, tiles, "deal", ranks=ranks)
    result = outcome(finished)
    assert finished.returncode == 0
    assert (result["finished"], result["solved"], result["twice"]) == (1, tiles, 0)
    assert result["progress"] == 256 * tiles


@pytest.mark.parametrize("ranks", RANKS)
def test_holes_stay_holes(tmp_path, ranks):
    result = outcome(check(tmp_path, 300, "holes", ranks=ranks))
    assert (result["finished"], result["solved"], result["twice"]) == (1, 300 - 43, 0)


@pytest.mark.parametrize("ranks", RANKS)
@pytest.mark.parametrize("tasks", [0, 1, 23, 400])
def test_every_rank_has_the_numbers_of_all_tasks(tmp_path, ranks, tasks):
    finished = check(tmp_path, tasks, "numbers", ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    assert finished.stdout == f"{ranks or 1} of {ranks or 1} ranks have all numbers, {tasks} told\n"


def test_long_runs_are_counted_and_no_rank_takes_it_all(tmp_path):
    result = outcome(check(tmp_path, 2000, "deal", ranks=2))
    assert (result["finished"], result["progress"]) == (1, 256 * 2000)
    assert result["largest_share"] < 1800


@pytest.mark.parametrize("ranks, rank", [(None, 0), (2, 0), (2, 1), (7, 6)])
def test_one_rank_that_stops_stops_all(tmp_path, ranks, rank):
    finished = check(tmp_path, 3000, "stop", rank, ranks=ranks)
    result = outcome(finished)
    assert finished.returncode == 5
    assert result["finished"] == 0
    assert 2 <= result["solved"] < 3000
    assert result["progress"] == 256 * result["solved"]


@pytest.mark.parametrize("ranks, rank", [(None, 0), (2, 0), (2, 1), (7, 6)])
def test_one_rank_that_fails_ends_all(tmp_path, ranks, rank):
    finished = check(tmp_path, 3000, "fail", rank, ranks=ranks)
    assert finished.returncode == 3
    assert launch.messages(finished) == [f"peterka: the disk of rank {rank} is full"]
    assert finished.stdout == ""


def test_a_failure_of_all_is_told_once(tmp_path):
    finished = check(tmp_path, 3000, "fail-everywhere", ranks=4)
    assert finished.returncode == 3
    assert launch.messages(finished) == ["peterka: the disk of rank 0 is full"]


@pytest.mark.parametrize("ranks", [None, 1, 4])
def test_a_failure_before_the_work_lets_all_leave_in_order(tmp_path, ranks):
    finished = check(tmp_path, 10, "fail-on-root", ranks=ranks)
    assert finished.returncode == 2
    assert launch.messages(finished) == ["peterka: the job is bad"]
    assert "MPI_ABORT" not in finished.stderr
