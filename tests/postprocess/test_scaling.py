"""The scaling study: measured runs, remedies where rank 0 is too slow, the picture, the program's output."""

import subprocess
import sys

import matplotlib.image
import numpy as np
import pytest
from conftest import POSTPROCESS
from peterka.plotting import axes
from peterka.scaling import efficiency, remedies
from peterka.scaling.dealing import Machine, Replay
from peterka.scaling.run_record import read_record
from peterka.scaling.tile_costs import whole_tiles
from picture_samples import write_map
from scaling_samples import REAL, uneven, write_run


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
    """Calls scaling.py in tmp_path: (code, stdout, stderr)."""
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


@pytest.mark.parametrize("real, ideal, words", [
    ((1.0, 0.95, 0.8), (1.0, 0.96, 0.91), "10 ranks, and up to 100 if rank 0 answered without delay"),
    ((1.0, 0.95, 0.92), (1.0, 0.94, 0.89), "100 ranks; rank 0 is not what limits it"),
    ((1.0, 0.85, 0.8), (1.0, 0.85, 0.8), "1 rank; rank 0 is not what limits it"),
])
def test_the_ideal_is_never_told_to_be_worse(real, ideal, words):
    def replays(efficiencies):
        return [Replay(ranks, 1 / (ranks * efficiency), 1.0, 0) for ranks, efficiency in zip((1, 10, 100), efficiencies)]

    assert efficiency.well_used(efficiency.Curve(256, (1, 1), replays(real), replays(ideal))) == words
