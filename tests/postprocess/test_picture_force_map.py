"""Force maps: the cells that carry a force, their colours, the mark of the largest, the scale in newtons."""

import matplotlib
import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.text import Text
from peterka.plotting.figures import figure_of
from peterka.maps import field_map, force_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import (
    CHAOTIC, FAILED, MISSING, NO_IMPACT, PLAIN, UNRESOLVED, Drawn, colour_named, orbit, write_map,
)

pytestmark = pytest.mark.thorough


def colour_of_force(force, top):
    return to_hex(matplotlib.colormaps[field_map.COLOURS](force / top)).upper()


def test_only_single_impact_cells_carry_a_force(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5")) as file:
        drawn = Drawn(force_map.draw_single_impact(file), tmp_path / "a.png")
        assert drawn.colour_of(file, 1, 1) == colour_of_force(11.1, 12.0)
        assert drawn.colour_of(file, 0, 0) == colour_of_force(10.0, 12.0)
        for row, column in ((0, 2), (0, 3), (1, 2), (3, 3)):  # 2/2, 1/2, chaotic, no impact
            assert drawn.colour_of(file, row, column) == field_map.OTHER_COLOUR
    assert drawn.legend_texts() == ["any other regime"]


def test_all_impacts_carry_a_force(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5")) as file:
        drawn = Drawn(force_map.draw_all_impacts(file), tmp_path / "a.png")
        for row, column, force in ((0, 2, 10.2), (0, 3, 10.3), (1, 2, 11.2), (1, 1, 11.1)):
            assert drawn.colour_of(file, row, column) == colour_of_force(force, 12.0)
        assert drawn.colour_of(file, 3, 3) == colour_named("no impact")
    assert drawn.legend_texts() == ["no impact"]


def test_cells_without_a_proof_keep_their_own_colour(tmp_path):
    cells = [[orbit(1, 1), UNRESOLVED], [FAILED, MISSING]]
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, hammer_mass_kg=np.nan)) as file:
        drawn = Drawn(force_map.draw_all_impacts(file), tmp_path / "a.png")
        assert drawn.colour_of(file, 0, 1) == colour_named("unresolved")
        assert drawn.colour_of(file, 1, 0) == colour_named("failed")
    assert drawn.legend_texts() == ["unresolved", "failed", "not computed yet"]


def test_the_largest_force_is_marked_with_its_value(tmp_path):
    forces = np.full((4, 4), 10.0)
    forces[1, 0], forces[0, 3] = 12.5, 40.0  # z = 1/1, and a larger one for 1/2
    with PeterkaFile(write_map(tmp_path / "a.h5", forces=forces)) as file:
        single, every = figure_of(force_map.draw_single_impact(file)).axes[0], figure_of(force_map.draw_all_impacts(file)).axes[0]
    assert [text.get_text() for text in single.texts] == ["max 12.5 (36.53 N), on the map's border"]
    assert [float(value[0]) for value in single.lines[0].get_data()] == [1.0, 1.0]  # Omega/omega, gap/A0
    assert [text.get_text() for text in every.texts] == ["max 40 (116.9 N), on the map's border"]
    assert [float(value[0]) for value in every.lines[0].get_data()] == [4.0, 0.0]


def test_the_largest_force_leads_with_the_unit_of_the_job(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5", forces=np.full((4, 4), 12.5), job="[axes.frequency_hz]\nfrom = 4.5\n")) as file:
        told = [figure_of(force_map.draw_all_impacts(file, units=units)).axes[0].texts[0].get_text() for units in ("both", "si", "ratio")]
    assert [words.partition(",")[0] for words in told] == ["max 36.53 N (12.5)", "max 36.53 N", "max 12.5"]


def test_the_scale_in_newtons_needs_a_mass(tmp_path):
    def bar_of(path):
        with PeterkaFile(path) as file:
            drawn = Drawn(force_map.draw_single_impact(file), tmp_path / "a.png")
        return drawn.figure.axes[1]

    bar = bar_of(write_map(tmp_path / "a.h5"))
    newtons = next(ax for ax in bar.child_axes if "N" in ax.get_xlabel())
    assert newtons.get_xlim()[1] == pytest.approx(12.0 * 0.298 * 9.80665)
    without = bar_of(write_map(tmp_path / "b.h5", hammer_mass_kg=np.inf))
    assert not any("N" in ax.get_xlabel() for ax in without.child_axes)


def test_a_single_spike_does_not_flatten_the_scale(tmp_path):
    cells = [[CHAOTIC] * 40] * 40
    forces = np.full((40, 40), 10.0)
    forces[7, 7] = 1000.0
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, forces=forces)) as file:
        drawn = Drawn(force_map.draw_all_impacts(file), tmp_path / "a.png")
    assert drawn.map_axes.collections[-1].get_clim()[1] == pytest.approx(10.0)
    assert drawn.map_texts() == ["max 1000 (2.922 kN)"]


def test_no_dark_colour_shows_between_the_letters_of_a_note(tmp_path):
    forces = np.full((40, 40), 10.0)
    forces[20, 20] = 1000.0
    with PeterkaFile(write_map(tmp_path / "a.h5", [[orbit(1, 1)] * 40] * 40, forces=forces)) as file:
        drawn = Drawn(force_map.draw_all_impacts(file, limits=(0, 1000)), tmp_path / "a.png")
    note = drawn.map_axes.texts[0]
    assert note.get_text().startswith("max 1000")
    box = drawn.figure.transFigure.inverted().transform_bbox(Text.get_window_extent(note))
    height, width = drawn.pixels.shape[:2]
    low, high = (1 - share for share in (box.y0 + 0.4 * box.height, box.y0 + 0.6 * box.height))  # through the small letters
    within = drawn.pixels[int(high * height):int(low * height), int(box.x0 * width):int(box.x1 * width)]
    dark = np.all(within == matplotlib.colors.to_rgba_array(colour_of_force(10, 1000))[0, :3] * 255, axis=-1)
    assert within.size and dark.mean() < 0.1


def test_no_picture_without_a_force(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5", [[NO_IMPACT] * 4] * 4)) as file:
        assert force_map.draw_single_impact(file) is None
        assert force_map.draw_all_impacts(file) is None
    with PeterkaFile(write_map(tmp_path / "b.h5", PLAIN, forces=np.full((4, 4), np.inf))) as file:
        assert force_map.draw_all_impacts(file) is None
