"""A map with certificates: which cells are proved, and why others are not."""

import h5py
import numpy as np
import pytest
from peterka.maps import proved_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import CHAOTIC, MISSING, NO_IMPACT, Drawn, orbit, write_map
from starts_samples import add_starts

pytestmark = pytest.mark.thorough

CELLS = [[orbit(1, 1)] * 4, [NO_IMPACT] * 4, [CHAOTIC, orbit(1, 2), NO_IMPACT, MISSING]]
CERTIFIED = [[1, -3, 1, 1], [2, 2, 2, 2], [0, -6, 0, -128]]


def test_each_verdict_has_its_colour_and_share(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5", CELLS, fields={"certified": CERTIFIED})) as file:
        drawn = Drawn(proved_map.draw(file), tmp_path / "a.png")
        for row in range(2):
            for column in range(4):
                assert drawn.colour_of(file, row, column) == proved_map.VERDICTS[CERTIFIED[row][column]][1]
        assert drawn.colour_of(file, 2, 0) == proved_map.VERDICTS[proved_map.UNSETTLED][1]
        assert drawn.colour_of(file, 2, 2) == proved_map.VERDICTS[0][1]
    assert drawn.legend_texts() == [
        "proved, and that the start leads there (33.3 %)", "proved (25.0 %)", "no orbit found (8.3 %)", "near a grazing (8.3 %)",
        "not tried (8.3 %)", "no motion that settles (8.3 %)", "not computed yet (8.3 %)"]


def test_only_a_map_with_certificates_gives_the_picture(tmp_path, draw):
    proved = write_map(tmp_path / "proved.h5", fields={"certified": np.ones((4, 4))})
    assert "proved_proved.png" in draw(proved, "--formats", "png").pictures
    plain = write_map(tmp_path / "plain.h5")
    assert not any("plain_proved" in name for name in draw(plain, "--formats", "png").pictures)


SLOTS = [  # of one row: two proved; the second one not; the first one not; no motion that settles beside a proved one, and alone; not tried
    [(1, 1, 1), (1, 1, 1), (1, 1, 1), (2, 0, 0), (2, 0, 0), (1, 1, 1), (-128, 0, 0)],
    [(0, 0, 1), (1, 1, 2), (1, 1, 2), (1, 1, 2), (-128, 0, 0), (0, 0, 1), (-128, 0, 0)]]
OF_SLOTS = [[1, 1, -3, 0, 0, -128, -128], [1, -6, -6, 1, -128, -128, -128]]


def with_slots(path, certified=OF_SLOTS):
    cells = [[MISSING if slot[0] == -128 else NO_IMPACT for slot in SLOTS[0]]]
    write_map(path, cells)
    with h5py.File(path, "r+") as file:
        file["attractor_certified"] = np.array(certified, dtype="i1")[:, None, :]
    places = np.ones((2, 1, len(SLOTS[0])))
    return add_starts(path, [[slots] for slots in SLOTS], places / 2, places, places[0] * 0)


def test_all_attractors_of_a_cell_are_proved_or_the_reason_is_told_for_the_largest_that_is_not(tmp_path):
    with PeterkaFile(with_slots(tmp_path / "a.h5")) as file:
        drawn = Drawn(proved_map.draw_attractors(file), tmp_path / "a.png")
        for column, number in enumerate([1, -6, -3, 1, proved_map.UNSETTLED, 0, -128]):
            assert drawn.colour_of(file, 0, column) == proved_map.VERDICTS[number][1], column
    assert "what is proved of the attractors that settle" in drawn.figure._suptitle.get_text()


def test_only_a_map_with_certified_attractors_gives_their_picture(tmp_path, draw):
    assert "a_proved_attractors.png" in draw(with_slots(tmp_path / "a.h5"), "--formats", "png").pictures
    wrong = draw(with_slots(tmp_path / "b.h5", np.full((2, 7), 3)))
    assert wrong.code == 2 and "has an attractor_certified that is no verdict from -8 to 2" in wrong.stderr


def test_an_unknown_verdict_is_refused(tmp_path, draw):
    outcome = draw(write_map(tmp_path / "a.h5", fields={"certified": np.full((4, 4), 3)}))
    assert outcome.code == 2 and "has a certified that is no verdict from -8 to 2" in outcome.stderr
