"""Pictures of maps with [starts]: number of attractors, the most frequent one, shares and kicks, in the cells where they belong."""

import numpy as np
import pytest
from attractor_samples import write_attractors
from matplotlib import colormaps
from matplotlib.colors import to_hex
from matplotlib.text import Text
from peterka.errors import PeterkaFileError
from peterka.maps import attractor_maps
from peterka.maps.map_file import PeterkaFile
from peterka.pictures import pictures_of
from peterka.plotting.figures import figure_of
from picture_samples import NO_IMPACT, UNRESOLVED, Drawn, colour_named, orbit, write_map
from picture_texts import drawn_texts, faults_of_layout
from sealing import SealedFile

pytestmark = pytest.mark.thorough


def seen(file, figure, folder):
    drawn = Drawn(figure, folder / "a.png")
    return [[drawn.colour_of(file, row, column) for column in range(3)] for row in range(2)], drawn


def shade(share):
    return to_hex(colormaps["viridis"](float(share))).upper()


def test_numbers_have_shades_that_darken(tmp_path):
    with PeterkaFile(write_attractors(tmp_path / "a.h5")) as file:
        colours, drawn = seen(file, attractor_maps.draw_number(file), tmp_path)
    one, two, three = attractor_maps.NUMBER_COLOURS[2:5]
    assert colours[0] == [one, two, two]
    assert colours[1][:2] == [three, one]
    assert drawn.legend_texts() == ["not computed yet (16.7 %)", "1 (33.3 %)", "2 (33.3 %)", "3 (16.7 %)"]
    heads = [ax.get_legend().get_title().get_text() for ax in drawn.figure.axes if ax.get_legend()]
    assert heads == ["known attractors of a cell (share of the map)"]  # the summary counts those on which starts end


UNSETTLED = [[[(UNRESOLVED, 1.0)], [(orbit(1, 2), 0.5), (UNRESOLVED, 0.5)], [(orbit(1, 2), 0.75), (UNRESOLVED, 0.25)]],
             [[(NO_IMPACT, 0.875), (UNRESOLVED, 0.125)], [(orbit(1, 1), 1.0)], []]]


def test_starts_without_a_result_are_no_attractor_and_no_motion_without_impacts(tmp_path):
    with PeterkaFile(write_attractors(tmp_path / "a.h5", cells=UNSETTLED, kicks=False)) as file:
        colours, drawn = seen(file, attractor_maps.draw_number(file), tmp_path)
        assert colours[0] == [colour_named("unresolved"), *attractor_maps.NUMBER_COLOURS[2:3] * 2]
        assert drawn.legend_texts() == ["not computed yet (16.7 %)", "none (16.7 %)", "1 (66.7 %)"]
        colours, drawn = seen(file, attractor_maps.draw_impacting(file), tmp_path)
        assert colours[0] == [*[attractor_maps.LACKING_COLOUR] * 2, shade(0.75)] and colours[1][:2] == [shade(0.0), shade(1.0)]
        assert "half or more unresolved" in drawn.legend_texts()
        title = " ".join(drawn.figure._suptitle.get_text().split())
        assert title.endswith("unresolved starts count as ones without impacts: up to 25.0 % in a cell")


FEW_KEPT = [[[(NO_IMPACT, 0.75)], [(orbit(1, 2), 0.5)], [(orbit(1, 2), 1.0)]], [[(NO_IMPACT, 1.0)], [(orbit(1, 1), 1.0)], []]]


def test_starts_on_attractors_that_are_not_kept_are_told(tmp_path):
    """A share of starts with impacts was 0 where a cell kept one attractor alone, the one without."""
    with PeterkaFile(write_attractors(tmp_path / "a.h5", cells=FEW_KEPT, kicks=False)) as file:
        colours, drawn = seen(file, attractor_maps.draw_impacting(file), tmp_path)
    assert colours[0] == [shade(0.0), attractor_maps.LACKING_COLOUR, shade(1.0)]
    assert "half or more unresolved or not kept" in drawn.legend_texts()
    title = " ".join(drawn.figure._suptitle.get_text().split())
    assert title.endswith("starts on attractors that aren't kept count as ones without impacts: up to 25.0 % in a cell")


def test_the_likeliest_attractor_has_the_colour_of_its_class(tmp_path):
    with PeterkaFile(write_attractors(tmp_path / "a.h5")) as file:
        colours, _ = seen(file, attractor_maps.draw_largest(file), tmp_path)
    assert colours[0] == [colour_named("no impact"), colour_named("1/2"), colour_named("no impact")]
    assert colours[1][:2] == [colour_named("chaotic"), colour_named("1/1")]


@pytest.mark.parametrize("name, shares", [
    ("attractors_impact", [[0, 0.75, 0.25], [0.75, 1]]), ("share_1_2", [[0, 0.75, 0.25], [0, 0]]),
    ("share_1_1", [[0, 0, 0], [0.25, 1]]), ("share_no_impact", [[1, 0.25, 0.75], [0.25, 0]]),
    ("share_chaotic", [[0, 0, 0], [0.5, 0]])])
def test_shares_are_those_of_the_cells(tmp_path, name, shares):
    with PeterkaFile(write_attractors(tmp_path / "a.h5")) as file:
        colours, _ = seen(file, pictures_of(file)[name](file), tmp_path)
    assert colours[0] == [shade(share) for share in shares[0]]
    assert colours[1][:2] == [shade(share) for share in shares[1]]


def test_a_share_says_where_starts_end(tmp_path):
    with PeterkaFile(write_attractors(tmp_path / "a.h5")) as file:
        words = [[text.get_text() for text in figure_of(pictures_of(file)[f"share_{name}"](file)).findobj(Text)]
                 for name in ("1_1", "chaotic", "no_impact")]
    for found, told in zip(words, ("in $z = 1/1$", "in chaos", "without impacts")):
        assert f"share of starts that end {told}" in found


def test_the_kick_is_that_of_the_likeliest_orbit(tmp_path):
    with PeterkaFile(write_attractors(tmp_path / "a.h5")) as file:
        colours, _ = seen(file, attractor_maps.draw_kick(file), tmp_path)
    assert colours[0][1:] == [shade(1), shade(0.25)]  # 0.5 and 0.125 m/s; the scale ends at the largest


def test_a_scale_has_an_arrow_only_where_kicks_are_beyond_it(tmp_path):
    path = write_map(tmp_path / "a.h5", [[orbit(1, 1)] * 40] * 40)
    kicks = np.full((40, 40), 0.25)
    with SealedFile(path, "r+") as file:
        file["critical_kick"], file["critical_kick_tried"] = kicks, kicks
    for largest, arrow in ((0.25, "neither"), (9.0, "max")):
        with SealedFile(path, "r+") as file:
            file["critical_kick"][0, 0] = largest
        with PeterkaFile(path) as file:
            bars = [ax._colorbar for ax in attractor_maps.draw_kick(file).figure.axes if hasattr(ax, "_colorbar")]
        assert [bar.extend for bar in bars] == [arrow]


def test_a_kick_that_was_not_found_says_whether_another_motion_is_known(tmp_path):
    with PeterkaFile(write_attractors(tmp_path / "a.h5")) as file:
        colours, drawn = seen(file, attractor_maps.draw_kick(file), tmp_path)
    kinds = attractor_maps.KIND_COLOURS
    assert colours[0][0] == kinds[attractor_maps.NO_ORBIT]
    assert colours[1][:2] == [kinds[attractor_maps.NONE_FOUND], kinds[attractor_maps.ALONE]]
    assert drawn.legend_texts() == ["no orbit", "one motion alone known, no kick up to 4.5 m/s",
                                    "no kick found up to 4.5 m/s", "not computed yet"]


def test_an_orbit_that_was_filled_was_not_kicked(tmp_path):
    path = write_map(tmp_path / "a.h5", [[orbit(1, 1)] * 3, [NO_IMPACT] * 3])
    with SealedFile(path, "r+") as file:
        file["computed"] = np.array([[1, 0, 1], [1, 0, 1]], dtype=np.int8)
        file["critical_kick"] = np.array([[0.25, np.nan, np.nan], [np.nan] * 3])
        file["critical_kick_tried"] = np.array([[0.25, np.nan, 4.5], [np.nan] * 3])
    with PeterkaFile(path) as file:
        colours, drawn = seen(file, attractor_maps.draw_kick(file), tmp_path)
    kinds = attractor_maps.KIND_COLOURS
    assert colours[0][1:] == [kinds[attractor_maps.FILLED], kinds[attractor_maps.NONE_FOUND]] and colours[1] == [kinds[attractor_maps.NO_ORBIT]] * 3
    assert drawn.legend_texts() == ["no orbit", "no kick found up to 4.5 m/s", "filled from the cells around: not kicked"]


def test_words_about_small_kicks_stay_on_the_canvas(tmp_path, monkeypatch):
    path = write_attractors(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        tried = file["critical_kick_tried"][()]
        none = np.flatnonzero(np.isfinite(tried) & np.isnan(file["critical_kick"][()]))
        tried.flat[none] *= 2.7e-5
        tried.flat[none[0]] *= 1e6
        file["critical_kick_tried"][...] = tried
    with PeterkaFile(path) as file:
        figure = attractor_maps.draw_kick(file).figure
    assert faults_of_layout(figure, monkeypatch) == []
    assert "one motion alone known, no kick up to 0.000121–122 m/s" in [text for text, _ in drawn_texts(figure, monkeypatch)]


def test_a_map_without_starts_has_the_kicks_of_its_cells(tmp_path):
    path = write_map(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        kick = np.full((4, 4), np.nan)
        kick[0, 0] = 0.25
        for name, values in (("critical_kick", kick), ("critical_kick_tried", np.where(file["regime"][()] == 1, 4.5, np.nan))):
            file[name] = values
    with PeterkaFile(path) as file:
        drawn = Drawn(attractor_maps.draw_kick(file), tmp_path / "a.png")
        assert drawn.colour_of(file, 0, 0) == shade(1)
        assert drawn.colour_of(file, 0, 1) == attractor_maps.KIND_COLOURS[attractor_maps.NONE_FOUND]
    assert drawn.legend_texts() == ["no orbit", "no kick found up to 4.5 m/s"]


def test_the_lower_bound_of_a_kick_has_no_picture_of_its_own(tmp_path):
    """It bounds the kick, as those of proved impact speeds do; another speed is a quantity to draw."""
    path = write_map(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        for name in ("critical_kick", "critical_kick_tried", "critical_kick_lower", "other_speed"):
            file[name] = np.full((4, 4), 0.25)
            file[name].attrs["units"] = "m/s"
    with PeterkaFile(path) as file:
        names = set(pictures_of(file))
        assert file.quantities == ["other_speed"]
    assert "kick" in names and not any("critical" in name for name in names)


def test_draw_makes_them_where_a_file_has_starts(tmp_path, draw):
    with_starts = draw(write_attractors(tmp_path / "a.h5"), "--formats", "png").pictures
    assert {f"a_{name}.png" for name in ("attractors", "attractors_largest", "attractors_impact", "share_1_2", "kick")} <= set(
        with_starts)
    plain = draw(write_map(tmp_path / "b.h5"), "--formats", "png").pictures
    assert not [name for name in plain if name.startswith("b_attractors")]
    assert "c_kick.png" not in draw(write_attractors(tmp_path / "c.h5", kicks=False), "--formats", "png").pictures


def test_a_share_that_is_none_is_refused(tmp_path):
    shares = np.zeros((4, 2, 3))
    shares[0] = 1.5
    with PeterkaFile(write_attractors(tmp_path / "a.h5", shares)) as file, pytest.raises(PeterkaFileError, match="no share"):
        attractor_maps.commonest(file)


def test_what_is_known_without_a_start_counts(tmp_path):
    """A cell whose starts all end on one orbit, but with another known motion, does not count as having one motion only."""
    path = write_attractors(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        place = 1, 1, 1  # besides the single attractor of the middle cell
        file["attractor_regime"][place], file["attractor_impacts"][place], file["attractor_period"][place] = orbit(1, 2)
    with PeterkaFile(path) as file:
        number = Drawn(attractor_maps.draw_number(file), tmp_path / "number.png")
        kick = Drawn(attractor_maps.draw_kick(file), tmp_path / "kick.png")
    assert "1 (16.7 %)" in number.legend_texts() and "2 (50.0 %)" in number.legend_texts(), number.legend_texts()
    assert not any("one motion alone" in text for text in kick.legend_texts())
