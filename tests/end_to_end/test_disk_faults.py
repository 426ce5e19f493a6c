"""Disks that fail at one call, in a small run of each way to write a file: a sample of tests/endurance/disk_faults.py."""

import pytest

import disk_faults

pytestmark = pytest.mark.thorough


# The others write as one of these does.
WRITERS = [kind for kind in disk_faults.KINDS if kind not in ("curves with distances", "sweep with starts", "map of uncertain rigs")]


@pytest.fixture(scope="module", params=WRITERS)
def kind(request, tmp_path_factory):
    return disk_faults.Kind(request.param, tmp_path_factory.mktemp(request.param))


def spread(count, most):
    """At most `most` numbers from 1 to count, including the first and the last."""
    if count <= most:
        return range(1, count + 1)
    if most == 1:
        return [count]
    return sorted({1 + round(i * (count - 1) / (most - 1)) for i in range(most)})


FAULTS = [("write", "EIO", 2), ("write", "persistent ENOSPC", 3), ("write", "short", 2), ("read", "EIO", 4),
          ("fsync", "EIO", 1), ("allocate", "EDQUOT", 1), ("rename", "EIO", 1)]


@pytest.mark.parametrize("call, how, most", FAULTS)
def test_a_call_that_fails_leaves_the_right_file_or_says_so(kind, call, how, most):
    tried = [kind.fails(call, number, how) for number in spread(kind.calls[call], most)]
    assert [problem for problem in tried if problem] == []


def test_every_kind_of_call_is_met(kind):
    """A library that is not loaded would make nothing fail."""
    whole = kind.name in ("curves", "trace", "study")
    least = {"write": 2, "read": 1, "fsync": 1, "rename": 1} if whole else {"write": 50, "read": 200, "fsync": 2, "allocate": 1}
    assert {call: number for call, number in least.items() if kind.calls[call] < number} == {}


def test_a_read_that_fails_while_attractors_are_numbered(tmp_path):
    """Open MPI reports success; cells of zeros would then be separate attractors, in a file marked as finished."""
    basin = disk_faults.Kind("basin", tmp_path)
    reads = basin.calls["read"]
    tried = [basin.fails("read", reads * part // 16, "EIO") for part in range(9, 15)]
    assert [problem for problem in tried if problem] == []


def test_one_of_two_ranks_meets_it(tmp_path):
    basin = disk_faults.Kind("basin", tmp_path)
    tried = [basin.fails(call, number, how, ranks=2, rank=1)
             for call, number, how in (("read", 100, "EIO"), ("read", 170, "EIO"), ("write", 80, "persistent ENOSPC"))]
    assert [problem for problem in tried if problem] == []


def test_the_last_write_of_two_ranks_fails(tmp_path):
    """If the call were HDF5's during closing, HDF5's ranks would wait for each other in different places."""
    kind = disk_faults.Kind("map with starts", tmp_path)
    kind.begin_with_what_is_left_after("fsync", kind.calls["fsync"] - 3, "EIO")  # all tiles, because their distribution is random
    at_root = {"ranks": 2, "rank": 0}
    assert kind.fails("write", kind.count("write", **at_root), "EIO", **at_root) == ""
