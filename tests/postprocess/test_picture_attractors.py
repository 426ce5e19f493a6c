"""Pictures of maps with [starts]: how many attractors, which is likeliest, shares and kicks, in the cells where they belong."""

import numpy as np
import pytest
from attractor_samples import write_attractors
from matplotlib import colormaps
from matplotlib.colors import to_hex
from peterka.files.opened import NotDrawable
from peterka.maps import attractor_maps
from peterka.maps.map_file import PeterkaFile
from peterka.pictures import pictures_of
from picture_samples import Drawn, colour_named, write_map


def seen(file, figure, folder):
    drawn = Drawn(figure, folder / "a.png")
    return [[drawn.colour_of(file, row, column) for column in range(3)] for row in range(2)], drawn


def shade(share):
    return to_hex(colormaps["viridis"](float(share))).upper()


def test_numbers_have_shades_that_darken(tmp_path):
    with PeterkaFile(write_attractors(tmp_path / "a.h5")) as file:
        colours, drawn = seen(file, attractor_maps.draw_number(file), tmp_path)
    one, two, three = attractor_maps.NUMBER_COLOURS[1:4]
    assert colours[0] == [one, two, two]
    assert colours[1][:2] == [three, one]
    assert drawn.legend_texts() == ["not computed yet (16.7 %)", "1 (33.3 %)", "2 (33.3 %)", "3 (16.7 %)"]


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


def test_the_kick_is_that_of_the_likeliest_orbit(tmp_path):
    with PeterkaFile(write_attractors(tmp_path / "a.h5")) as file:
        colours, drawn = seen(file, attractor_maps.draw_kick(file), tmp_path)
    assert colours[0][0] == colours[1][2] or "not computed yet" in drawn.legend_texts()
    order = [colours[0][2], colours[1][0], colours[0][1], colours[1][1]]  # 0.125, 0.25, 0.5, 1 m/s
    lightness = [sum(int(colour[i: i + 2], 16) for i in (1, 3, 5)) for colour in order]
    assert lightness == sorted(lightness) and len(set(order)) == 4


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
    with PeterkaFile(write_attractors(tmp_path / "a.h5", shares)) as file, pytest.raises(NotDrawable, match="no share"):
        attractor_maps.commonest(file)
