"""Optional quantities of a map or basin: a picture for each one in the file, units, cells without a value."""

import matplotlib
import numpy as np
import pytest
from colour_distance import deuteranope_sight, difference, normal_sight
from matplotlib.colors import to_hex
from peterka.plotting import units
from peterka.plotting.figures import figure_of
from peterka.maps import field_map, force_map, quantity_map
from peterka.maps.map_file import QUANTITIES, PeterkaFile
from picture_samples import (
    CHAOTIC, FAILED, MISSING, NO_IMPACT, PLAIN, SUSTAINED, UNRESOLVED, Drawn, colour_named, orbit, write_basin,
    write_map,
)
from sealing import SealedFile

pytestmark = pytest.mark.thorough

NAN = np.nan
CELLS = [
    [orbit(1, 1), orbit(1, 2), CHAOTIC, orbit(7, 3)],
    [NO_IMPACT, SUSTAINED, UNRESOLVED, FAILED],
    [orbit(1, 1), orbit(1, 1), orbit(1, 1), orbit(1, 1)],
]
SPEEDS = [[0.1, 0.2, 0.3, NAN], [NAN, NAN, 9.0, NAN], [0.4, 0.0, 0.1, 0.1]]


def colour_of_value(share):
    return to_hex(matplotlib.colormaps[field_map.COLOURS](share)).upper()


def drawn_from(path, name, picture):
    with PeterkaFile(path) as file:
        drawn = Drawn(quantity_map.draw(file, name=name), picture)
        return drawn, {(row, column): drawn.colour_of(file, row, column)
                       for row in range(file.shape[0]) for column in range(file.shape[1])}


def test_values_and_their_absence_have_their_colours(tmp_path):
    path = write_map(tmp_path / "a.h5", CELLS, fields={"impact_speed": SPEEDS})
    drawn, seen = drawn_from(path, "impact_speed", tmp_path / "a.png")
    for place, share in {(0, 0): 0.25, (0, 1): 0.5, (0, 2): 0.75, (2, 1): 0}.items():
        assert seen[place] == colour_of_value(share)
    assert seen[0, 3] == field_map.NO_VALUE_COLOUR
    for column, label in enumerate(["no impact", "sustained contact", "unresolved", "failed"]):
        assert seen[1, column] == colour_named(label), "what is no proved impact shows no value, even if it has one"
    assert drawn.legend_texts() == ["no impact", "sustained contact", "unresolved", "failed", "no value"]
    assert drawn.map_texts() == ["max 400 mm/s, on the map's border"]
    assert drawn.figure.axes[1].get_xlabel() == "largest impact speed (mm/s)"


def test_displacement_is_drawn_without_impacts_too(tmp_path):
    path = write_map(tmp_path / "a.h5", CELLS, fields={"max_displacement": np.full((3, 4), 2e-3)})
    drawn, seen = drawn_from(path, "max_displacement", tmp_path / "a.png")
    assert seen[1, 0] == seen[1, 1] == seen[0, 0] == colour_of_value(1.0)
    assert drawn.legend_texts() == ["unresolved", "failed"] and drawn.map_texts() == ["max 2 mm, on the map's border"]


def test_a_quantity_that_only_the_file_knows_is_drawn_in_its_own_words_and_unit(tmp_path):
    path = write_map(tmp_path / "a.h5", CELLS, fields={"impact_work": SPEEDS, "some_ratio": SPEEDS})
    with SealedFile(path, "r+") as file:
        file["impact_work"].attrs["units"] = "J"
        file["impact_work"].attrs["long_name"] = "work of an impact"
        file["some_ratio"].attrs["units"] = "1"
    with PeterkaFile(path) as file:
        assert file.quantities == ["impact_work"]
    drawn, _ = drawn_from(path, "impact_work", tmp_path / "a.png")
    assert drawn.figure.axes[1].get_xlabel() == "work of an impact (mJ)"


def test_what_is_not_computed_stays_open(tmp_path):
    path = write_map(tmp_path / "a.h5", [[orbit(1, 1)] * 2, [MISSING] * 2], fields={"impulse": [[2.0] * 2, [NAN] * 2]})
    drawn, _ = drawn_from(path, "impulse", tmp_path / "a.png")
    assert drawn.legend_texts() == ["not computed yet"]


def test_values_of_zero_have_a_scale(tmp_path):
    path = write_map(tmp_path / "a.h5", fields={"contact_time": np.zeros((4, 4))})
    drawn, seen = drawn_from(path, "contact_time", tmp_path / "a.png")
    assert seen[0, 0] == colour_of_value(0) and drawn.figure.axes[1].get_xlim() == (0, 1)
    assert drawn.map_texts() == ["max 0 s, on the map's border"]


def test_colours_without_a_value_are_none_of_the_scale():
    scale = [to_hex(matplotlib.colormaps[field_map.COLOURS](share)) for share in np.linspace(0, 1, 101)]
    flat = [field_map.NO_VALUE_COLOUR, field_map.OTHER_COLOUR, *map(colour_named, field_map.WITHOUT_IMPACTS[2:])]
    for colour in flat:
        for sight in (normal_sight, deuteranope_sight):
            assert min(difference(sight(colour), sight(value)) for value in scale) > 9, colour
    assert difference(normal_sight(field_map.NO_VALUE_COLOUR), normal_sight(field_map.OTHER_COLOUR)) > 14


def test_a_rigid_stop_gives_its_other_numbers_instead_of_an_empty_force_map(tmp_path, draw):
    forces = [[NAN, NAN, NAN, NAN], [0.0, 1.0, NAN, NAN], [NAN] * 4]
    path = write_map(tmp_path / "rigid.h5", CELLS, forces=forces, fields={
        "impact_speed": SPEEDS, "impulse": SPEEDS, "contact_power_w": SPEEDS,
    })
    outcome = draw(path, "--formats", "png")
    assert outcome.pictures == [f"rigid_{name}.png" for name in ("contact_power_w", "impact_speed", "impulse", "map")]
    assert f"{path}: no value to draw, force_all is left out" in outcome.stdout


def test_forces_that_some_impacts_lack_are_told(tmp_path):
    forces = np.full((4, 4), 10.0)
    forces[0, 0], forces[2, 0] = NAN, 11.0  # its note is placed elsewhere
    with PeterkaFile(write_map(tmp_path / "a.h5", forces=forces)) as file:
        for picture in (force_map.draw_single_impact, force_map.draw_all_impacts):
            drawn = Drawn(picture(file), tmp_path / "a.png")
            assert drawn.colour_of(file, 0, 0) == field_map.NO_VALUE_COLOUR
            assert "no value" in drawn.legend_texts()


def test_a_basin_gives_its_numbers_over_starts(tmp_path, draw):
    path = write_basin(tmp_path / "starts.h5", fields={"impulse": np.full((4, 4), 0.02)})
    outcome = draw(path, "--formats", "png")
    assert outcome.pictures == ["starts_basin.png", "starts_basin_impact.png", "starts_impulse.png"]
    with PeterkaFile(path) as file:
        figure = figure_of(quantity_map.draw(file, name="impulse"))
    assert figure.axes[0].child_axes == [] and "gap/A₀ = 1.6" in figure._suptitle.get_text()


@pytest.mark.parametrize("largest, shown", [
    (2.0, (1, "s")), (0.5, (1e3, "ms")), (3e-5, (1e6, "µs")), (1e-12, (1e9, "ns")), (4e3, (1e-3, "ks")), (0, (1, "s")),
])
def test_prefixes(largest, shown):
    factor, unit = units.with_prefix(largest, "s")
    assert (pytest.approx(factor), unit) == shown


@pytest.mark.parametrize("value, shown", [
    (2714.2, "2.714 kN"), (375.1, "375.1 N"), (999.96, "1 kN"), (0.0123, "12.3 mN"), (0, "0 N"), (3.32e12, "3.32 TN"),
    (3.32e18, "3.32e+06 TN"), (1086, "1.086 kN"),
])
def test_amounts_never_need_an_exponent_that_a_prefix_has(value, shown):
    assert units.amount(value, "N") == shown
    assert units.number(10856) == "10860" and units.number(41.253) == "41.25" and units.number(1e9) == "1e+09"


@pytest.mark.parametrize("name", QUANTITIES)
def test_a_number_in_another_unit_is_refused(tmp_path, draw, name):
    path = write_map(tmp_path / "a.h5", fields={name: np.ones((4, 4))})
    assert draw(path, "--formats", "png").code == 0
    with SealedFile(path, "r+") as file:
        file[name].attrs["units"] = "lbf\ns"
    outcome = draw(path)
    assert outcome.code == 2 and f"has {name} in 'lbf\\ns' instead of" in outcome.stderr
    assert outcome.stderr.count("\n") == 1
    with SealedFile(path, "r+") as file:
        del file[name]
        file[name] = np.ones((4, 5))
    assert "of shape (4, 5)" in draw(path).stderr


def test_in_a_basin_no_start_is_marked_as_the_one_of_the_largest_value(tmp_path):
    """All starts of an orbit share it."""
    with PeterkaFile(write_basin(tmp_path / "a.h5", fields={"impulse": np.full((4, 4), 0.02)})) as file:
        ax = figure_of(quantity_map.draw(file, name="impulse")).axes[0]
    assert not len(ax.texts) and not len(ax.lines)


def test_chatter_is_dotted_and_in_the_legend(tmp_path, draw):
    chatter = np.zeros((4, 4))
    chatter[1, :2], chatter[3, 3] = 1, -128
    path = write_map(tmp_path / "a.h5", PLAIN, fields={"chatter": chatter})
    from peterka.maps import peterka_map

    with PeterkaFile(path) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
        own = [drawn.colour_at(x, 1.05) for x in np.linspace(0.7, 1.3, 60)]
        other = {drawn.colour_at(x, 0.05) for x in np.linspace(0.7, 1.3, 60)}
        dots = drawn.map_axes.lines[0].get_xydata()
    assert other == {colour_named("1/1")}
    assert own.count(colour_named("1/1")) > 40, "no stripes: the class keeps its colour but for dots"
    assert sorted(map(tuple, dots.tolist())) == [(1.0, 1.0), (2.0, 1.0)]
    assert "chatter (12.5 %)" in drawn.legend_texts()
    without = write_map(tmp_path / "b.h5", PLAIN, fields={"chatter": np.zeros((4, 4))})
    with PeterkaFile(without) as file:
        assert not any("chatter" in text for text in Drawn(peterka_map.draw(file), tmp_path / "b.png").legend_texts())
    outcome = draw(write_map(tmp_path / "c.h5", PLAIN, fields={"chatter": np.full((4, 4), 2)}))
    assert outcome.code == 2 and "neither 0 nor 1" in outcome.stderr


def test_a_few_long_contacts_leave_the_others_their_colours(tmp_path):
    """Eleven of twelve cells lie between 1.5 and 2 ms, one lasts 30 ms: the scale is that of the others, and says what lies beyond it."""
    cells, times = [[orbit(1, 1)] * 20] * 20, np.linspace(1.5e-3, 2e-3, 400)
    times[::12] = 30e-3
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, fields={"contact_time": times.reshape(20, 20)})) as file:
        ax = quantity_map.draw(file, name="contact_time")
    mesh = next(one for one in ax.collections if getattr(one, "norm", None) and one.get_array() is not None and one.norm.vmax < 10)
    assert 1.4 < mesh.norm.vmin < 1.6 and 1.9 < mesh.norm.vmax < 2.1
    bar = next(one for one in ax.figure.axes if "longest contact" in one.get_xlabel())
    assert "10.0 % of these cells above the scale" in bar.get_xlabel().replace("\n", " ") and bar._colorbar.extend == "both"


def test_a_peak_in_a_few_cells_stays_on_a_scale_from_0(tmp_path):
    """A resonance is what such a picture is for."""
    cells, impulses = [[orbit(1, 1)] * 20] * 20, np.linspace(0.1, 0.2, 400)
    impulses[::12] = 3.0
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, fields={"impulse": impulses.reshape(20, 20)})) as file:
        ax = quantity_map.draw(file, name="impulse")
    norms = [one.norm for one in ax.collections if getattr(one, "norm", None) and one.get_array() is not None]
    assert max(norm.vmax for norm in norms) >= 3.0
    assert not any("above the scale" in one.get_xlabel() for one in ax.figure.axes)


def test_an_even_spread_keeps_the_whole_scale(tmp_path):
    cells, times = [[orbit(1, 1)] * 20] * 20, np.linspace(0.1, 3.0, 400).reshape(20, 20)
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, fields={"impulse": times})) as file:
        ax = quantity_map.draw(file, name="impulse")
    assert [one.get_xlabel() for one in ax.figure.axes if "impulse" in one.get_xlabel()] == ["largest impulse of an impact (N s)"]
    assert ax.collections[-1].norm.vmax == 3.0
