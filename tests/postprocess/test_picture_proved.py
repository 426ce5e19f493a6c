"""A map with certificates: which cells are proved, and why others are not."""

import numpy as np
from peterka.maps import proved_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import CHAOTIC, MISSING, NO_IMPACT, Drawn, orbit, write_map

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


def test_an_unknown_verdict_is_refused(tmp_path, draw):
    outcome = draw(write_map(tmp_path / "a.h5", fields={"certified": np.full((4, 4), 3)}))
    assert outcome.code == 2 and "has a certified that is no verdict from -8 to 2" in outcome.stderr
