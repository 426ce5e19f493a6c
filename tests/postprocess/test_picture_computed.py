"""A refined map: which cells are computed."""

import numpy as np
import pytest
from peterka.maps import computed_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import MISSING, NO_IMPACT, Drawn, orbit, write_map

pytestmark = pytest.mark.thorough

CELLS = [[orbit(1, 1)] * 4, [NO_IMPACT] * 4, [NO_IMPACT] * 3 + [MISSING]]
COMPUTED = [[1, 0, 1, 0], [0, 0, 0, 0], [1, 0, 0, -128]]


def test_computed_filled_and_missing_cells_have_their_colours_and_shares(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5", CELLS, fields={"computed": COMPUTED})) as file:
        drawn = Drawn(computed_map.draw(file), tmp_path / "a.png")
        for row in range(2):
            for column in range(4):
                assert drawn.colour_of(file, row, column) == computed_map.COLOURS[COMPUTED[row][column]]
    assert drawn.legend_texts() == ["computed (25.0 %)", "filled (66.7 %)", "not computed yet (8.3 %)"]


def test_only_a_refined_map_gives_the_picture(tmp_path, draw):
    refined = write_map(tmp_path / "refined.h5", fields={"computed": np.ones((4, 4))})
    assert "refined_computed.png" in draw(refined, "--formats", "png").pictures
    plain = write_map(tmp_path / "plain.h5")
    assert not any("plain_computed" in name for name in draw(plain, "--formats", "png").pictures)


def test_nonsense_is_refused(tmp_path, draw):
    outcome = draw(write_map(tmp_path / "a.h5", fields={"computed": np.full((4, 4), 3)}))
    assert outcome.code == 2 and "has a computed that is neither 0 nor 1" in outcome.stderr
