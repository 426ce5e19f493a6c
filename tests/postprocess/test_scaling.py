"""The scaling study: hand-checked replays, conservation, refined planes, the picture, the program's words."""

import subprocess
import sys
from itertools import pairwise

import matplotlib.image
import numpy as np
import pytest
from conftest import POSTPROCESS
from peterka.look import axes
from peterka.scaling import efficiency, remedies, tile_costs
from peterka.scaling.dealing import Machine, Replay, deal_size, replay, typical
from peterka.scaling.run_record import read_record
from peterka.scaling.tile_costs import DealOrder, TileCosts, tiles_of, whole_tiles
from picture_samples import write_map
from sealing import SealedFile

AT_ONCE = Machine(service=0.0, latency=0.0, look=1e-3)
REAL = Machine(service=3e-6, latency=2e-6, look=1e-4)


def one_by_one(_remaining, _tiles, _ranks):
    return 1


def uneven(rows=8, columns=8, seed=2):
    return 1e-3 * (0.2 + np.random.default_rng(seed).exponential(1.0, (rows, columns)))


def write_run(path, side=64, tile_seconds=None, ranks=1, seconds=1.0):
    """A map file of side x side cells with the record of its run."""
    write_map(path, np.zeros((side, side, 3), int).tolist())
    count = tiles_of((side, side))[0] ** 2
    with SealedFile(path, "r+") as file:
        file["run/tile_seconds"] = np.full(count, 1e-3) if tile_seconds is None else np.array(tile_seconds, float)
        file["run/ranks"] = np.int32(ranks)
        file["run/solve_seconds"] = float(seconds)
    return path


def test_one_rank_takes_the_sum_of_all_tiles():
    costs = TileCosts(uneven())
    alone = replay(costs, 1, REAL)
    assert alone.seconds == pytest.approx(uneven().sum(), rel=1e-12) and alone.runs == 0
    assert alone.efficiency == pytest.approx(1, rel=1e-12)


def test_a_little_case_done_by_hand():
    # Tiles that are dealt one by one to two ranks, and take 4, 2, 3, 1, 5 s in their turns: every third one in a circle
    # of five. A message takes 0.25 s, rank 0 needs 0.5 s for a request and looks every second.
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
    # Two tiles in hand, tiles of 3 s, one at a time: rank 1 asks at 0, has its first one at 0 and asks again, its
    # second one at 0 and asks when the first one is done. Rank 0 begins to compute only then, with what is left.
    costs = TileCosts([[3.0] * 6])
    done = replay(costs, 2, Machine(service=0.0, latency=0.0, look=1.0, in_hand=2), one_by_one)
    assert (done.seconds, done.runs) == (9.0, 3)


def test_long_runs_are_asked_for_when_the_last_tile_comes_to_hand():
    # Runs of 3 tiles of 1 s, two in hand. Rank 1 takes the last tile of its run at 1, when its first one is done, and
    # asks; rank 0 is then done with tile 3 and has 4 and 5 in hand. It deals tiles 6 to 8, and takes the last ones.
    remained = []

    def size(remaining, _tiles, _ranks):
        remained.append(remaining)
        return 3

    done = replay(TileCosts([[1.0] * 12]), 2, Machine(service=0.0, latency=0.0, look=1.0, in_hand=2), size)
    assert remained == [12, 6] and done.seconds == 6.0


def test_requests_wait_in_line():
    # Three workers ask at 0, and rank 0 serves one after the other, 1 s each. Rank 1 begins its tile of 8 s at 1 and asks
    # at once, before rank 0 comes to compute: the last tile is dealt at 4 and begun at 9.
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


def test_tiles_cut_off_by_the_border_count_as_whole_ones():
    shape = (20, 40)  # 2 x 3 tiles; the last column has 8 cells, the upper row 4
    cells = np.outer([16, 4], [16, 16, 8])
    assert whole_tiles(1e-6 * cells.ravel(), shape) == pytest.approx(np.full((2, 3), 256e-6))


def test_measured_runs_are_compared_with_one_rank_of_as_many_cells(tmp_path):
    records = [read_record(write_run(tmp_path / f"{number}.h5", side, ranks=ranks, seconds=seconds))
               for number, (side, ranks, seconds) in enumerate([(64, 1, 8.0), (64, 2, 5.0), (32, 2, 1.0)])]
    points, alone = efficiency.measured_efficiency(records)
    assert [(point.ranks, point.efficiency) for point in points] == [(1, 1.0), (2, 0.8)]
    assert [record.path for record in alone] == [str(tmp_path / "2.h5")]


def test_groups_with_a_dealer_each_help_where_one_is_too_slow(tmp_path):
    record = read_record(write_run(tmp_path / "a.h5", side=256, tile_seconds=uneven(16, 16).ravel()))
    slow = Machine(service=5e-5, latency=2e-6, look=1e-4)
    one = efficiency.curve(record, 4000**2, [1, 500], slow)
    found = remedies.remedies(record, one.tiles, one.replays[1], slow)
    assert found.present < 0.5 * found.groups and found.group_size in remedies.GROUP_SIZES
    assert found.present < found.floor < 1
    lines = remedies.text(record, [one], slow).splitlines()
    assert len(lines) == 2 and f"{100 * found.groups:.1f} % of {found.group_size} ranks" in lines[1]
    fast = efficiency.curve(record, 4000**2, [1, 5], REAL)
    assert remedies.text(record, [fast], REAL) == "Rank 0 is fast enough everywhere."


def test_ranks_are_round_numbers():
    assert efficiency.ranks_up_to(100) == [1, 2, 5, 10, 20, 50, 100]
    assert efficiency.ranks_up_to(64) == [1, 2, 5, 10, 20, 50, 64] and efficiency.ranks_up_to(1) == [1]


def test_the_picture_shows_the_replays_and_what_was_measured(tmp_path):
    record = read_record(write_run(tmp_path / "a.h5", tile_seconds=uneven(4, 4).ravel()))
    curves = [efficiency.curve(record, cells, [1, 2, 5, 10, 100], REAL) for cells in (record.cells, 10**5, 10**6)]
    measured = [efficiency.Measured(record.cells, 2, 1.0, 0.97)]
    figure = efficiency.draw(record, curves, measured, REAL)
    axes.save(figure, tmp_path / "a.png")
    ax = figure.axes[0]
    drawn = {tuple(line.get_ydata()) for line in ax.lines}
    for one in curves:
        assert tuple(100 * real.efficiency for real in one.replays) in drawn
        assert tuple(100 * ideal.efficiency for ideal in one.ideal) in drawn
    assert (97.0,) in drawn
    assert "ranks" in ax.get_xlabel() and "%" in ax.get_ylabel() and ax.get_xscale() == "log"
    solid = [line for line in ax.lines if line.get_linestyle() == "-"]
    assert len({line.get_marker() for line in solid}) == len(curves), "in grey the marker tells"
    legend = [text.get_text() for text in figure.axes[-1].get_legend().get_texts()]
    assert legend == ["$4.1\\cdot10^{3}$ cells", "$10^{5}$ cells", "$10^{6}$ cells", "rank 0 answers without delay", "measured"]
    assert "330 000 runs a second" in " ".join(figure._suptitle.get_text().split())
    box, page = figure.axes[-1].get_legend().get_window_extent(), figure.bbox
    assert page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0


@pytest.fixture
def run_scaling(run_program):
    """Calls efficiency.py in tmp_path: (code, stdout, stderr)."""
    return lambda *arguments: run_program("scaling", *arguments)


def test_the_program_prints_a_table_and_draws(tmp_path):
    write_run(tmp_path / "one.h5", tile_seconds=uneven(4, 4).ravel(), seconds=2.0)
    write_run(tmp_path / "two.h5", ranks=2, seconds=1.1)
    command = [POSTPROCESS / "scaling.py", "one.h5", "--measured", "one.h5", "two.h5", "--cells", "4096,1e6",
               "--ranks", "50", "--formats", "png"]
    done = subprocess.run([sys.executable, *command], cwd=tmp_path, capture_output=True, text=True, timeout=300,
                          check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "1e+06 cells: 90 % efficiency up to 50 ranks" in done.stdout
    assert matplotlib.image.imread(tmp_path / "pictures" / "one_scaling.png").shape[1] == 1110


def test_what_cannot_be_studied_is_told_in_one_line(tmp_path, run_scaling):
    write_run(tmp_path / "unfinished.h5", tile_seconds=[np.nan] * 16)
    write_run(tmp_path / "good.h5")
    write_map(tmp_path / "plain.h5")
    for arguments, words in (
        (["unfinished.h5"], "lacks the times of some tiles"),
        (["plain.h5"], "has no dataset run/tile_seconds"),
        (["nothing.h5"], "does not exist"),
        (["good.h5", "--cells", "1e6,many"], "'many' is not a whole number"),
        (["good.h5", "--cells", "inf"], "'inf' is not a whole number"),
        (["good.h5", "--service", "0"], "'0' is not a time in microseconds"),
    ):
        code, _, complaint = run_scaling(*arguments)
        assert code == 2 and words in complaint, complaint
        assert complaint.startswith("scaling.py: ") and complaint.count("\n") == 1


def test_a_picture_that_cannot_be_written_is_told(tmp_path, run_scaling):
    write_run(tmp_path / "good.h5")
    (tmp_path / "file").touch()
    code, _, complaint = run_scaling("good.h5", "--cells", "1e4", "--ranks", "2", "--output-dir", "file/pictures")
    assert code == 3 and "cannot write into file/pictures" in complaint


def test_a_measured_file_without_its_like_on_one_rank_is_left_out(tmp_path, run_scaling):
    write_run(tmp_path / "good.h5")
    lonely = write_run(tmp_path / "lonely.h5", ranks=2)
    code, _, complaint = run_scaling("good.h5", "--cells", "1e4", "--ranks", "2", "--measured", lonely)
    assert code == 0 and "lonely.h5 is left out" in complaint


CHANCE = 1e-3 * (0.2 + np.random.default_rng(5).exponential(1.0, (40, 40)) ** 2)  # some tiles are dear


def lead_of_a_slow_rank_0(one_replay):
    """By how much more efficient it is at most than one that answers without delay: which it can only be by chance."""
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


@pytest.mark.parametrize("real, ideal, words", [
    ((1.0, 0.95, 0.8), (1.0, 0.96, 0.91), "10 ranks, and up to 100 if rank 0 served at once"),
    ((1.0, 0.95, 0.92), (1.0, 0.94, 0.89), "100 ranks; rank 0 is not what limits it"),
    ((1.0, 0.85, 0.8), (1.0, 0.85, 0.8), "1 rank; rank 0 is not what limits it"),
])
def test_the_ideal_is_never_told_to_be_worse(real, ideal, words):
    def replays(efficiencies):
        return [Replay(ranks, 1 / (ranks * efficiency), 1.0, 0) for ranks, efficiency in zip((1, 10, 100), efficiencies)]

    assert efficiency.well_used(efficiency.Curve(256, (1, 1), replays(real), replays(ideal))) == words
