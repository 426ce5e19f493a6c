"""Duration of impacts that end: classes of the last impact, and what a short run would mistake for an attractor."""

import pytest
from peterka.maps import basin_map, last_impact
from peterka.maps.map_file import PeterkaFile
from picture_samples import CHAOTIC, FAILED, MISSING, NO_IMPACT, SUSTAINED, UNRESOLVED, Drawn, colour_named, orbit, write_basin, write_map

pytestmark = pytest.mark.thorough

CELLS = [[NO_IMPACT, NO_IMPACT, NO_IMPACT, NO_IMPACT], [NO_IMPACT, orbit(1, 1), CHAOTIC, UNRESOLVED],
         [FAILED, MISSING, NO_IMPACT, NO_IMPACT]]
LAST = [[0, 1, 30, 31], [300, -1, -1, -1], [-1, -1, 301, 20000]]


def test_each_class_of_last_impacts_has_its_colour_and_share(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5", CELLS, fields={"last_impact": LAST})) as file:
        drawn = Drawn(last_impact.draw(file), tmp_path / "a.png")
        seen = [[drawn.colour_of(file, row, column) for column in range(4)] for row in range(2)]
        assert drawn.colour_of(file, 2, 3) == last_impact.SHADES[-1]
    shades = last_impact.SHADES
    assert seen[0] == [shades[0], shades[1], shades[1], shades[2]]
    assert seen[1] == [shades[3], *[last_impact.COLOURS[last_impact.GOES_ON]] * 2, last_impact.COLOURS[last_impact.UNDECIDED]]
    assert drawn.legend_texts() == [
        "none at all (8.3 %)", "1 to 30 (16.7 %)", "31 to 100 (8.3 %)", "101 to 300 (8.3 %)",
        "301 to 1000 (8.3 %)", "more than 10000 (8.3 %)", "impacts go on (16.7 %)", "undecided (16.7 %)",
        "not computed yet (8.3 %)"]


def test_a_stop_that_is_pressed_for_ever_has_no_impacts_that_go_on(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5", [[SUSTAINED, SUSTAINED], [orbit(1, 1), NO_IMPACT]], fields={"last_impact": [[-1, 7], [-1, 0]]})) as file:
        drawn = Drawn(last_impact.draw(file), tmp_path / "a.png")
        assert drawn.colour_of(file, 0, 0) == colour_named("sustained contact")
    assert drawn.legend_texts() == ["none at all (25.0 %)", "1 to 30 (25.0 %)", "impacts go on (25.0 %)", "sustained contact (25.0 %)"]


def test_a_cell_that_was_filled_is_not_undecided(tmp_path):
    """It had no run, and so no last impact; 16 % of a map were told to be undecided where 0.2 % were."""
    computed = [[1, 0, 0, 1], [1, 0, 1, 1], [1, 1, 1, 0]]
    last = [[0, -1, -1, 31], [300, -1, -1, -1], [-1, -1, 301, -1]]
    with PeterkaFile(write_map(tmp_path / "a.h5", CELLS, fields={"last_impact": last, "computed": computed})) as file:
        drawn = Drawn(last_impact.draw(file), tmp_path / "a.png")
        seen = [drawn.colour_of(file, 0, 1), drawn.colour_of(file, 2, 3), drawn.colour_of(file, 1, 1), drawn.colour_of(file, 1, 3)]
    of = last_impact.COLOURS
    assert seen == [of[last_impact.FILLED], of[last_impact.FILLED], of[last_impact.GOES_ON], of[last_impact.UNDECIDED]]
    assert "no impact, filled: without a run (25.0 %)" in drawn.legend_texts() and "undecided (16.7 %)" in drawn.legend_texts()


def test_a_short_run_sees_impacts_that_end_later(tmp_path):
    with PeterkaFile(write_basin(tmp_path / "a.h5", CELLS, fields={"last_impact": LAST})) as file:
        for cycles, share in ((29, "58.3 %"), (30, "50.0 %"), (300, "33.3 %"), (20000, "16.7 %")):
            drawn = Drawn(basin_map.draw_impact_after(file, cycles=cycles), tmp_path / "a.png")
            assert f"impact after {cycles} cycles ({share})" in drawn.legend_texts()
        assert drawn.colour_of(file, 2, 3) == basin_map.NO_IMPACT_COLOUR


@pytest.mark.parametrize("kind", ["map", "basin"])
def test_only_files_with_the_field_give_the_pictures(tmp_path, draw, kind):
    write = write_map if kind == "map" else write_basin
    pictures = draw(write(tmp_path / "with.h5", CELLS, fields={"last_impact": LAST}), "--formats", "png", "--after",
                    "40").pictures
    assert "with_last_impact.png" in pictures
    assert ("with_impact_after_40.png" in pictures) == (kind == "basin")
    pictures = draw(write(tmp_path / "without.h5", CELLS), "--formats", "png").pictures
    assert not any(name.startswith("without") and ("last" in name or "after" in name) for name in pictures)


def test_other_numbers_of_cycles_are_refused(tmp_path, draw):
    outcome = draw(write_map(tmp_path / "a.h5"), "--after", "-3")
    assert outcome.code == 2 and "'-3' is not a number of forcing cycles" in outcome.stderr
