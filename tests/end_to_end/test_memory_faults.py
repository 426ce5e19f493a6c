"""Memory exhaustion at one allocation, in a small run of each kind: a sample of tests/endurance/memory_faults.py."""

import pytest

import memory_faults

pytestmark = pytest.mark.thorough


@pytest.fixture(scope="module", params=["map with starts", "trace"])
def kind(request, tmp_path_factory):
    return memory_faults.Kind(request.param, tmp_path_factory.mktemp(request.param))


def test_an_allocation_that_fails_leaves_the_right_file_or_says_so(kind):
    """The program's own allocations, including the first ones, before main()."""
    places = [first for first, _ in kind.places("program")]
    assert len(places) > 500  # a library that is not loaded would count none
    tried = [kind.fails("program", places[len(places) * part // 6]) for part in range(6)]
    assert [problem for _, problem in tried if problem] == []
    assert sum(ended == "said so" for ended, _ in tried) >= 4
