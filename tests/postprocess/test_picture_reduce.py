"""Large maps: reduction of a block of cells, and agreement between bands of rows and the whole map."""

import numpy as np
import pytest
from peterka.plotting.classes import CLASSES, INDEX, classify
from peterka.maps import map_file, reduce
from peterka.maps.map_file import PeterkaFile
from picture_samples import ALL_CLASSES, NO_IMPACT, orbit, write_map

NAMES = ["regime", "impacts", "period"]


def force_picture(file, limit):
    return reduce.field_picture(file, "peak_force_ratio", lambda regime, p, q: regime == 1, limit)


def test_a_block_gets_the_class_of_most_of_its_cells():
    labels = np.array([[1, 1, 9, 9, 5], [3, 1, 9, 2, 5], [4, 7, 6, 6, 8]])
    assert reduce.majority(labels, 2, 10).tolist() == [[1, 9, 5], [4, 6, 8]]  # 4 and 7: a tie, the first in the table


def test_classes_are_never_averaged():
    ends = np.array([[0, 20], [20, 0]])
    assert reduce.majority(ends, 2, 21).tolist() == [[0]]


def test_a_block_gets_its_largest_force():
    nan = np.nan
    forces = np.array([[1.0, nan, nan], [2.0, nan, 3.0], [nan, 5.0, nan]])
    assert reduce.largest(forces, 2) == pytest.approx(np.array([[2.0, 3.0], [5.0, nan]]), nan_ok=True)


@pytest.mark.parametrize("points, limit, block", [(2000, 2000, 1), (2001, 2000, 2), (8192, 2000, 5), (4, 2000, 1)])
def test_block_size(points, limit, block):
    assert reduce.block_size((points, 3), limit) == block


def test_bands_give_what_the_whole_map_gives(tmp_path, monkeypatch):
    cells = np.tile(np.array(ALL_CLASSES), (5, 3, 1))  # 20 rows, 18 columns
    with PeterkaFile(write_map(tmp_path / "a.h5", cells)) as file:
        whole, counts = reduce.class_picture(file, NAMES, classify, len(CLASSES), limit=7)
        force, peak, lacking = force_picture(file, limit=7)
        monkeypatch.setattr(map_file, "BAND_CELLS", 60)
        sizes = [band["regime"].shape[0] for _, band in file.bands(NAMES, 3)]
        assert len(sizes) > 3 and all(size * 18 <= 60 for size in sizes)
        banded, banded_counts = reduce.class_picture(file, NAMES, classify, len(CLASSES), limit=7)
        banded_force, banded_peak, banded_lacking = force_picture(file, limit=7)
    assert whole.image.shape == (7, 6)
    assert np.array_equal(whole.image, banded.image) and np.array_equal(counts, banded_counts)
    assert np.array_equal(force.image, banded_force.image, equal_nan=True)
    assert peak == banded_peak and lacking == banded_lacking == 0


def test_shares_and_peak_come_from_all_cells(tmp_path):
    cells = np.array([[NO_IMPACT] * 9] * 9)
    cells[4, 4] = orbit(1, 1)  # outvoted in its block
    forces = np.zeros((9, 9))
    forces[4, 4] = 77.0
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, forces=forces)) as file:
        reduced, counts = reduce.class_picture(file, NAMES, classify, len(CLASSES), limit=3)
        force, peak, _ = force_picture(file, limit=3)
        assert (peak.value, peak.row_value, peak.column_value) == (77.0, file.rows.values[4], file.columns.values[4])
    assert force.image[1, 1] == 77.0 and np.isnan(force.image).sum() == 8
    assert np.all(reduced.image == INDEX["no impact"]) and counts[INDEX["1/1"]] == 1
    assert reduced.row_edges == pytest.approx([-0.1875, 0.9375, 2.0625, 3.1875])


def test_cells_that_lack_their_value_are_counted(tmp_path):
    cells = [[orbit(1, 1)] * 4, [NO_IMPACT] * 4]
    forces = [[1.0, np.nan, np.inf, 4.0], [np.nan] * 4]
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, forces=forces)) as file:
        assert force_picture(file, limit=10)[2] == 2
