"""Two files cell by cell: numbers that can be counted by hand, the picture's colours, and what is refused."""

import h5py
import matplotlib.image
import numpy as np
import pytest
from peterka_pictures import comparison, comparison_map
from peterka_pictures.read import PeterkaFile
from picture_samples import CHAOTIC, MISSING, NO_IMPACT, PLAIN, Drawn, orbit, write_basin, write_map

FORCES = [[10.0, 10, 10, 10], [10, 10, 10, 10], [10, 0, 0, 0], [0, 0, 0, 0]]


@pytest.fixture
def run_compare(run_program):
    """Calls compare.py in tmp_path: (code, stdout, stderr)."""
    return lambda *arguments: run_program("compare", *arguments, "--formats", "png")


def changed(cells, **changes):
    """`changes`: r0c1=label and so on."""
    copy = [list(row) for row in cells]
    for place, label in changes.items():
        copy[int(place[1])][int(place[3])] = label
    return copy


@pytest.fixture
def pair(tmp_path):
    """A map, and one with another regime, another z, a missing cell, and forces off by 5 % and 50 %."""
    forces = np.array(FORCES)
    forces[0, 0], forces[0, 1] = 10.5, 20
    other = changed(PLAIN, r3c3=CHAOTIC, r0c2=orbit(1, 1), r3c0=MISSING)
    return (write_map(tmp_path / "a.h5", PLAIN, forces=FORCES), write_map(tmp_path / "b.h5", other, forces=forces))


def test_counts_moves_and_forces(pair):
    with PeterkaFile(pair[0]) as a, PeterkaFile(pair[1]) as b:
        found = comparison.compare(a, b)
    assert (found.cells, found.same_regime, found.same_label) == (15, 14, 13)
    assert found.moves == {("no impact", "chaotic"): 1, ("2/2", "1/1"): 1}
    assert sorted(found.differences()) == pytest.approx([0, 0, 0, 0, 0, 1 - 10 / 10.5, 0.5])
    assert found.place[np.argmax(found.differences())].tolist() == [0, 1]
    assert found.scale == 1


def test_rigs_whose_forces_differ_by_a_factor(tmp_path):
    first = write_map(tmp_path / "a.h5", PLAIN, forces=FORCES)
    second = write_map(tmp_path / "b.h5", PLAIN, forces=1.25 * np.array(FORCES), natural_frequency_hz=5.25)
    with PeterkaFile(first) as a, PeterkaFile(second) as b:
        found = comparison.compare(a, b)
        told = comparison.text(a, b, found)
        drawn = Drawn(comparison_map.draw(a, b, found), tmp_path / "picture.png")
    assert found.scale == 1.25 and found.differences(found.scale).max() < 1e-12
    assert "B's are 1.25 times A's" in told and "divided by that" in told
    assert drawn.legend_texts() == ["same z, peak force/1.25 within 1 % (100.0 %)"]


def test_the_picture_tells_each_kind_of_difference(pair, tmp_path):
    with PeterkaFile(pair[0]) as a, PeterkaFile(pair[1]) as b:
        drawn = Drawn(comparison_map.draw(a, b, comparison.compare(a, b)), tmp_path / "picture.png")
        colours = {place: drawn.colour_of(a, *place) for place in [(0, 0), (0, 1), (0, 2), (3, 3), (1, 0)]}
    kinds = comparison_map
    assert colours == {
        place: kinds.COLOURS[kind] for place, kind in {
            (0, 0): kinds.FORCE, (0, 1): kinds.MUCH_FORCE, (0, 2): kinds.ORBIT, (3, 3): kinds.REGIME,
            (1, 0): kinds.SAME}.items()
    }
    assert len(drawn.legend_texts()) == 6


def test_the_program_tells_and_draws(pair, tmp_path, run_compare):
    code, told, complaint = run_compare("a.h5", "b.h5")
    assert (code, complaint) == (0, "")
    assert "same regime and z           13    86.667 %" in told and "2/2 -> 1/1" in told
    assert "at most, at frequency_ratio 2, gap_ratio 0" in told
    assert matplotlib.image.imread(tmp_path / "pictures" / "a_against_b.png").shape[1] == 1110


def test_files_without_a_common_force_or_cell(tmp_path, run_compare):
    write_map(tmp_path / "quiet.h5", [[NO_IMPACT] * 4] * 4)
    write_map(tmp_path / "empty.h5", [[MISSING] * 4] * 4)
    assert "No peak force to compare." in run_compare("quiet.h5", "quiet.h5")[1]
    code, told, _ = run_compare("quiet.h5", "empty.h5")
    assert code == 0 and "0 cells that both files hold" in told


def test_other_planes_are_refused_in_one_line(pair, tmp_path, run_compare):
    write_map(tmp_path / "shifted.h5", frequency_ratio=[1, 2, 3, 4.001])
    write_map(tmp_path / "wide.h5", [row + row for row in PLAIN])
    write_basin(tmp_path / "basin.h5")
    for name, words in (("shifted.h5", "4 points of frequency_ratio from 1 to 4.001, and"),
                        ("wide.h5", "8 points of frequency_ratio from 1 to 4, and"),
                        ("basin.h5", "is a basin and a.h5 a map"), ("none.h5", "does not exist")):
        code, _, complaint = run_compare("a.h5", name)
        assert code == 2 and words in complaint, complaint
        assert complaint.startswith("compare.py: ") and complaint.count("\n") == 1
    (tmp_path / "file").touch()
    code, _, complaint = run_compare("a.h5", "b.h5", "--output-dir", "file/pictures")
    assert code == 3 and "cannot write into" in complaint


def test_basins_of_two_places_can_be_compared(tmp_path, run_compare):
    write_basin(tmp_path / "a.h5")
    write_basin(tmp_path / "b.h5", changed(PLAIN, r0c0=NO_IMPACT), gap_ratio=1.7)
    with h5py.File(tmp_path / "b.h5") as file:
        assert file.attrs["gap_ratio"] == 1.7
    code, told, _ = run_compare("a.h5", "b.h5")
    assert code == 0 and "1/1 -> no impact" in told
