"""The replay of dealing tiles to ranks: by hand, conserved quantities, refined planes; and the dealing order."""

from itertools import pairwise

import numpy as np
import pytest
from peterka.scaling import tile_costs
from peterka.scaling.dealing import Machine, deal_size, replay, typical
from peterka.scaling.tile_costs import DealOrder, TileCosts, tiles_of
from scaling_samples import REAL, uneven

AT_ONCE = Machine(service=0.0, latency=0.0, look=1e-3)


def one_by_one(_remaining, _tiles, _ranks):
    return 1


def test_one_rank_takes_the_sum_of_all_tiles():
    costs = TileCosts(uneven())
    alone = replay(costs, 1, REAL)
    assert alone.seconds == pytest.approx(uneven().sum(), rel=1e-12) and alone.runs == 0
    assert alone.efficiency == pytest.approx(1, rel=1e-12)


def test_a_little_case_done_by_hand():
    # Tiles are dealt one by one to two ranks, and take 4, 2, 3, 1, 5 s in dealing order: every third one, cyclically, of
    # five. A message takes 0.25 s, rank 0 needs 0.5 s per request and polls every second.
    #   0.00 rank 1 asks; rank 0 begins turn 0 (4 s), looks at 1.00, and serves until 1.50: 3 s of its tile are left
    #   1.75 rank 1 has turn 1, begins it (it is also its last) and asks at once; rank 0 has that at 2.00
    #   2.50 rank 0's next look (2 s left); it serves until 3.00; rank 1 has turn 2 at 3.25, is free at 3.75, begins it
    #        then and asks; rank 0 has that at 4.00 and looks at 4.00 (1 s left); it serves until 4.50
    #   6.75 rank 1, free of turn 2, begins turn 3 and asks; rank 0 has that at 7.00
    #   5.50 rank 0 is done with turn 0, takes turn 4, the last one, until 10.50
    costs = TileCosts([[4.0, 3.0, 5.0, 2.0, 1.0]])
    done = replay(costs, 2, Machine(service=0.5, latency=0.25, look=1.0, in_hand=1), one_by_one)
    assert (done.seconds, done.runs) == (10.5, 3)
    assert done.efficiency == 15 / 21


def test_a_rank_with_room_asks_again_at_once():
    # Two tiles in hand, tiles of 3 s, one at a time: rank 1 requests at 0, has its first one at 0 and requests again, has
    # its second one at 0 and requests when the first is done. Rank 0 begins to compute only then, with the rest.
    costs = TileCosts([[3.0] * 6])
    done = replay(costs, 2, Machine(service=0.0, latency=0.0, look=1.0, in_hand=2), one_by_one)
    assert (done.seconds, done.runs) == (9.0, 3)


def test_long_runs_are_asked_for_when_the_last_tile_comes_to_hand():
    # Runs of 3 tiles of 1 s, two in hand. Rank 1 takes the last tile of its run at 1, when its first is done, and requests;
    # rank 0 has then finished tile 3 and has 4 and 5 in hand. It deals tiles 6 to 8, and takes the last ones.
    remained = []

    def size(remaining, _tiles, _ranks):
        remained.append(remaining)
        return 3

    done = replay(TileCosts([[1.0] * 12]), 2, Machine(service=0.0, latency=0.0, look=1.0, in_hand=2), size)
    assert remained == [12, 6] and done.seconds == 6.0


def test_requests_wait_in_line():
    # Three workers request at 0, and rank 0 serves one after the other, 1 s each. Rank 1 begins its tile of 8 s at 1 and
    # requests at once, before rank 0 starts to compute: the last tile is dealt at 4 and begun at 9.
    costs = TileCosts([[8.0, 8.0, 8.0, 8.0]])
    done = replay(costs, 4, Machine(service=1.0, latency=0.0, look=1.0, in_hand=1), one_by_one)
    assert (done.seconds, done.runs) == (17.0, 4)


@pytest.mark.parametrize("ranks", [1, 2, 3, 7, 40, 200])
@pytest.mark.parametrize("cells", [64**2, 300**2])
def test_every_tile_is_dealt_once_and_nobody_is_faster_than_the_work(ranks, cells):
    side = round(cells**0.5)
    costs = TileCosts(uneven(), tiles_of((side, side)))
    dealt = []

    def size(remaining, tiles, everyone):
        dealt.append((tiles - remaining, deal_size(remaining, tiles, everyone)))
        return dealt[-1][1]

    done = replay(costs, ranks, REAL, size)
    assert len(dealt) == done.runs
    assert all(first + length <= after for (first, length), (after, _) in pairwise(dealt)), "no tile twice"
    assert all(length >= 1 and first + length <= costs.count for first, length in dealt)
    assert 0 < done.efficiency <= 1 + 1e-12
    assert done.seconds >= max(costs.total / ranks, costs.dearest) * (1 - 1e-12)


def test_with_many_tiles_all_ranks_finish_together():
    done = replay(TileCosts(uneven(16, 16), (625, 625)), 50, AT_ONCE)
    assert done.efficiency > 0.99


def test_a_slow_rank_0_limits_all():
    costs = TileCosts(np.full((50, 50), 1e-3))
    done = replay(costs, 1000, Machine(service=1e-3, latency=0.0, look=1e-4), one_by_one)
    assert done.seconds == pytest.approx(costs.count * 1e-3, rel=0.01), "a tile a service"


def test_run_lengths_are_those_of_the_program():
    """The same numbers as in tests/unit/parallel_tile_pool.cpp."""
    assert [deal_size(*case) for case in ((16000, 16000, 10), (10000, 16000, 10), (1000, 1000, 1000))] == [100, 100, 1]
    assert [deal_size(*case) for case in ((1000, 16000, 10), (1001, 16000, 10), (100, 16000, 1))] == [50, 51, 50]
    assert [deal_size(*case) for case in ((1, 16000, 7), (13, 16000, 7), (1, 1, 1))] == [1, 1, 1]


def dealt(rows, columns, ranks, turns):
    row, column = DealOrder(rows, columns, ranks).places(np.array(turns))
    return (row * columns + column).tolist()


def test_the_order_of_dealing_is_that_of_the_program():
    """The same numbers as in tests/unit/parallel_tile_pool.cpp."""
    assert dealt(64, 64, 3, range(4)) == [0, 3111, 2126, 1141]
    assert dealt(5, 6, 1, range(4)) == [0, 17, 4, 21]
    assert dealt(64, 62, 1, range(14, 18)) == [188, 189, 3020, 3021]
    assert dealt(64, 62, 1, range(3072, 3076)) == [992, 3211, 1626, 2833]


@pytest.mark.parametrize("grid", [(1, 1, 1), (3, 1, 1), (20, 20, 4), (61, 59, 1), (7001, 1, 2)])
def test_every_tile_has_one_turn(grid):
    assert sorted(dealt(*grid, range(DealOrder(*grid).turns))) == list(range(grid[0] * grid[1]))


def test_a_finer_grid_keeps_every_place_at_its_cost():
    seconds = uneven(4, 6)
    fine = TileCosts(seconds, (12, 12))
    blocks = np.kron(seconds, np.ones((3, 2)))
    before = np.concatenate([[0], np.cumsum(blocks.ravel()[dealt(12, 12, 1, range(144))])])
    assert fine.count == blocks.size and fine.total == pytest.approx(blocks.sum(), rel=1e-12)
    assert [fine.before(tile) for tile in range(fine.count + 1)] == pytest.approx(before, rel=1e-12)
    assert [fine.turn_after(seconds) for seconds in (0, before[5], before[5] + 1e-9, 1e9)] == [1, 6, 6, fine.count + 1]
    assert TileCosts(seconds, (5, 7)).count == 35, "sizes need not be multiples"


def test_a_grid_larger_than_a_piece_is_whole(monkeypatch):
    whole = TileCosts(uneven(4, 6), (61, 59))
    monkeypatch.setattr(tile_costs, "PIECE", 25)
    pieces = TileCosts(uneven(4, 6), (61, 59))
    assert [pieces.before(turn) for turn in range(3600)] == pytest.approx([whole.before(turn) for turn in range(3600)])


CHANCE = 1e-3 * (0.2 + np.random.default_rng(5).exponential(1.0, (40, 40)) ** 2)  # some tiles are expensive


def lead_of_a_slow_rank_0(one_replay):
    """The largest excess of its efficiency over that of a rank 0 that answers without delay, which can only be due to chance."""
    costs = TileCosts(CHANCE)
    slow, at_once = Machine(3e-6, 2e-6, 5e-4), Machine(0.0, 2e-6, 5e-4)
    return max(one_replay(costs, ranks, slow).efficiency / one_replay(costs, ranks, at_once).efficiency - 1
               for ranks in (20, 30, 40, 50, 60, 80))


def test_chance_does_not_make_a_slow_rank_0_the_better_one():
    assert lead_of_a_slow_rank_0(replay) > 0.04, "one replay is one throw of dice"
    assert lead_of_a_slow_rank_0(typical) < 0.02


def test_a_mean_of_replays_tells_how_they_scatter():
    costs = TileCosts(CHANCE)
    mean = typical(costs, 50, REAL)
    assert 0.002 < mean.scatter < 0.2 and mean.work == costs.total
    assert typical(costs, 50, REAL) == mean
    assert typical(costs, 1, REAL).scatter == 0
    assert mean.efficiency == pytest.approx(replay(costs, 50, REAL).efficiency, abs=4 * mean.scatter)
