"""Basin maps: colours by attractor and by impact, the legend, and the marks of attractors."""

import numpy as np
import pytest
from peterka.plotting import axes, style
from peterka.plotting.figures import figure_of
from peterka.maps import basin_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import CHAOTIC, MISSING, NO_IMPACT, SUSTAINED, UNRESOLVED, Drawn, colour_named, orbit, write_basin

pytestmark = pytest.mark.thorough

CELLS = [
    [orbit(1, 1), orbit(1, 1), orbit(1, 1), orbit(1, 2)],
    [orbit(1, 1), orbit(1, 1), orbit(1, 1), orbit(1, 2)],
    [NO_IMPACT, NO_IMPACT, CHAOTIC, CHAOTIC],
    [NO_IMPACT, NO_IMPACT, UNRESOLVED, SUSTAINED],
]
ATTRACTOR = [[1, 1, 2, 3], [1, 1, 2, 3], [0, 0, 4, 4], [0, 0, -1, -1]]


def row(regime, impacts, period, force, cells, displacement=0.5, velocity=-1.0):
    return dict(regime=regime, impacts=impacts, period=period, peak_force_ratio=force, cells=cells,
                orbit_displacement=displacement, orbit_velocity=velocity)


TABLE = [
    row(0, 0, 1, 0.0, 4), row(1, 1, 1, 41.25, 4), row(1, 1, 1, 20.0, 2), row(1, 1, 2, 60.0, 2), row(2, 0, 0, 9.0, 2),
]


@pytest.fixture
def basin(tmp_path):
    with PeterkaFile(write_basin(tmp_path / "a.h5", CELLS, TABLE, ATTRACTOR)) as file:
        yield file


def test_attractors_have_the_colours_of_their_class(basin, tmp_path):
    drawn = Drawn(basin_map.draw_attractors(basin), tmp_path / "a.png")
    expected = {(0, 0): "1/1", (0, 3): "1/2", (2, 0): "no impact", (2, 3): "chaotic", (3, 2): "unresolved",
                (3, 3): "sustained contact"}
    for (line, column), label in expected.items():
        assert drawn.colour_of(basin, line, column) == colour_named(label), label


def test_a_second_attractor_of_a_class_has_its_own_shade(basin, tmp_path):
    drawn = Drawn(basin_map.draw_attractors(basin), tmp_path / "a.png")
    second = drawn.colour_of(basin, 0, 2)
    assert second == "#EAAE80"  # half-way from 1/1 to white
    assert second not in (drawn.colour_of(basin, 0, 0), drawn.colour_of(basin, 0, 3))


def test_the_legend_names_attractors_largest_first(basin, tmp_path):
    texts = Drawn(basin_map.draw_attractors(basin), tmp_path / "a.png").legend_texts()
    assert texts[:4] == [
        "no impact (25.0 %)",
        r"$z$ = 1/1, $F/(m\,g)$ = 41.25 (25.0 %)",
        r"$z$ = 1/1, $F/(m\,g)$ = 20 (12.5 %)",
        r"$z$ = 1/2, $F/(m\,g)$ = 60 (12.5 %)",
    ]
    assert texts[4] == r"chaotic, $F/(m\,g)$ = 9 of one start (12.5 %)"
    assert texts[5:7] == ["sustained contact (6.2 %)", "unresolved (6.2 %)"]
    phase = r"a point of its attractor at forcing phase 0:" "\n" r"$x = u$, $\dot{x} = \dot{u} + A_0\Omega$, $A_0\Omega/(A_0\omega)$ = 1.8"
    assert texts[7:] == [phase, "stop at $t$ = 0: $x$ = gap"]


def test_two_attractors_of_a_class_never_read_the_same(tmp_path):
    table = [row(1, 1, 1, force, 4) for force in (41.2512, 41.2533, 41.25)] + [row(1, 1, 2, 41.25, 4)]
    with PeterkaFile(write_basin(tmp_path / "a.h5", [[orbit(1, 1)] * 4] * 3 + [[orbit(1, 2)] * 4], table,
                                 np.arange(4).repeat(4).reshape(4, 4))) as file:
        texts = Drawn(basin_map.draw_attractors(file), tmp_path / "a.png").legend_texts()
    assert [text.split("= ")[2].split(" (")[0] for text in texts[:4]] == ["41.251", "41.253", "41.25", "41.25"]


def test_two_attractors_of_a_class_on_a_rigid_stop_are_told_apart_by_their_orbits(tmp_path):
    table = [row(1, 1, 1, np.nan, 8, displacement=-1.5), row(1, 1, 1, np.nan, 4, displacement=-1.50003), row(1, 1, 2, np.nan, 4)]
    cells, numbers = [[orbit(1, 1)] * 4] * 3 + [[orbit(1, 2)] * 4], [[0] * 4, [0] * 4, [1] * 4, [2] * 4]
    path = write_basin(tmp_path / "a.h5", cells, table, numbers)
    with PeterkaFile(path) as file:
        texts = Drawn(basin_map.draw_attractors(file), tmp_path / "a.png").legend_texts()
    assert texts[:3] == ["$z$ = 1/1, $u/A_0$ = -1.5 (50.0 %)", "$z$ = 1/1, $u/A_0$ = -1.50003 (25.0 %)", "$z$ = 1/2 (25.0 %)"]
    path = write_basin(tmp_path / "b.h5", cells, table, numbers, natural_frequency_hz=5.25, cart_amplitude_m=0.89e-3)
    with PeterkaFile(path) as file, style.using(units="si"):
        texts = Drawn(basin_map.draw_attractors(file), tmp_path / "b.png").legend_texts()
    assert texts[:2] == ["$z$ = 1/1, $u$ = -1.335 mm (50.0 %)", "$z$ = 1/1, $u$ = -1.33503 mm (25.0 %)"]


def test_attractors_are_marked_where_a_start_would_lie_on_them(basin, tmp_path):
    # At phase 0 the cart moves at A0 Omega: the relative velocity -1 corresponds to a start of -1 + 1.8.
    marks = Drawn(basin_map.draw_attractors(basin), tmp_path / "a.png").map_axes.lines
    stop, *marks = marks
    assert stop.get_xdata() == [1.6, 1.6]
    assert len(marks) == 4, "all but the chaotic one"
    for mark in marks:
        assert np.ravel(mark.get_data()) == pytest.approx([0.5, 0.8])


def test_a_mark_outside_the_picture_does_not_widen_it(tmp_path):
    table = [row(0, 0, 1, 0.0, 16, displacement=100.0)]
    with PeterkaFile(write_basin(tmp_path / "a.h5", [[NO_IMPACT] * 4] * 4, table, np.zeros((4, 4)))) as file:
        drawn = Drawn(basin_map.draw_attractors(file), tmp_path / "a.png")
    assert drawn.map_axes.get_xlim() == pytest.approx((-4, 4))
    assert drawn.legend_texts()[1:] == ["1 attractor lies outside the picture", "stop at $t$ = 0: $x$ = gap"]


@pytest.mark.parametrize("displacement, told", [(100.0, "1 point lies outside the picture"), (0.0, "a point of its attractor at forcing phase 0")])
def test_of_an_orbit_of_several_cycles_one_point_is_known(tmp_path, displacement, told):
    """That it lies outside says nothing of the others."""
    table = [row(1, 4, 8, 20.0, 16, displacement=displacement)]
    with PeterkaFile(write_basin(tmp_path / "a.h5", [[orbit(4, 8)] * 4] * 4, table, np.zeros((4, 4)))) as file:
        texts = Drawn(basin_map.draw_attractors(file), tmp_path / "a.png").legend_texts()
    assert any(text.startswith(told) for text in texts) and not any("attractor lies" in text or "its attractor," in text for text in texts)


def test_scales_in_mm_and_metres_a_second_follow_the_file(basin, tmp_path):
    assert figure_of(basin_map.draw_attractors(basin)).axes[0].child_axes == []
    path = write_basin(tmp_path / "b.h5", CELLS, TABLE, ATTRACTOR, natural_frequency_hz=5.25, cart_amplitude_m=0.89e-3)
    with PeterkaFile(path) as file:
        drawn = Drawn(basin_map.draw_attractors(file), tmp_path / "b.png")
    top, right = drawn.map_axes.child_axes
    assert (top.get_xlabel(), right.get_ylabel()) == ("$x$ (mm)", r"$\dot{x}$ (m/s)")
    assert top.get_xlim() == pytest.approx(np.multiply(drawn.map_axes.get_xlim(), 0.89))
    assert right.get_ylim() == pytest.approx(np.multiply(drawn.map_axes.get_ylim(), 0.89e-3 * 2 * np.pi * 5.25))


def test_a_stop_outside_the_picture_has_no_line(tmp_path):
    with PeterkaFile(write_basin(tmp_path / "a.h5", CELLS, TABLE, ATTRACTOR, gap_ratio=4.5)) as file:
        drawn = Drawn(basin_map.draw_attractors(file), tmp_path / "a.png")
    assert "stop at $t$ = 0: $x$ = gap" not in drawn.legend_texts()


def test_before_the_table_is_written_classes_are_drawn(tmp_path):
    cells = [*CELLS[:3], [MISSING] * 4]
    with PeterkaFile(write_basin(tmp_path / "a.h5", cells)) as file:
        drawn = Drawn(basin_map.draw_attractors(file), tmp_path / "a.png")
        assert drawn.colour_of(file, 0, 0) == colour_named("1/1")
    assert drawn.map_texts() == ["incomplete: 75.0 % computed"]
    assert "1/1 (37.5 %)" in drawn.legend_texts()


def test_many_attractors_share_one_colour(tmp_path):
    table = [row(1, 1, 1, 10.0 + n, 30 - n) for n in range(30)]
    numbers = np.arange(36).reshape(6, 6) % 30
    with PeterkaFile(write_basin(tmp_path / "a.h5", [[orbit(1, 1)] * 6] * 6, table, numbers)) as file:
        drawn = Drawn(basin_map.draw_attractors(file), tmp_path / "a.png")
        assert drawn.colour_of(file, 4, 5) == basin_map.OTHER_COLOUR
    assert len(drawn.legend_texts()) == basin_map.NAMED_ATTRACTORS + 3
    assert "other attractors (27.8 %)" in drawn.legend_texts()


def test_two_colours(basin, tmp_path):
    drawn = Drawn(basin_map.draw_impact(basin), tmp_path / "a.png")
    for line, column in ((0, 0), (0, 2), (0, 3), (2, 2)):  # both 1/1, 1/2, chaotic
        assert drawn.colour_of(basin, line, column) == "#0072B2"
    assert drawn.colour_of(basin, 3, 0) == basin_map.NO_IMPACT_COLOUR
    assert drawn.colour_of(basin, 3, 2) == colour_named("unresolved")
    assert drawn.legend_texts() == [
        "impact (62.5 %)", "no impact (25.0 %)", "sustained contact (6.2 %)", "unresolved (6.2 %)",
        "stop at $t$ = 0: $x$ = gap",
    ]


def test_the_operating_point_is_in_the_title(basin):
    assert figure_of(basin_map.draw_impact(basin))._suptitle.get_text() == "Sample\nΩ/ω = 1.8, gap/A₀ = 1.6"


@pytest.mark.parametrize("damping, gap, cells, told", [
    (0.01, 1.6, [[orbit(1, 1)] * 4] * 4, True),  # the free amplitude is 1.446 at 1.8 times the natural frequency
    (0.01, 1.4, [[orbit(1, 1)] * 4] * 4, False), (0.01, 1.6, CELLS, False), (None, 1.6, [[orbit(1, 1)] * 4] * 4, False)])
def test_a_motion_without_impact_that_no_start_found_is_told(tmp_path, damping, gap, cells, told):
    more = {} if damping is None else {"damping_ratio": damping}
    with PeterkaFile(write_basin(tmp_path / "a.h5", cells, TABLE[1:2], gap_ratio=gap, **more)) as file:
        texts = Drawn(basin_map.draw_attractors(file), tmp_path / "a.png").legend_texts()
    assert ("a motion without impact exists, too:\nnone of these starts ends on it" in texts) == told


@pytest.mark.parametrize("place, units, words", [
    ("frequency_hz = 8.1\ngap_ratio = 1.6", "both", "frequency = 8.1 Hz, gap/A₀ = 1.6"),
    ("frequency_ratio = 1.8\ngap_m = 1.424e-3", "both", "Ω/ω = 1.8, gap = 1.424 mm"),
    ("frequency_hz = 8.1\ngap_m = 1.424e-3", "ratio", "Ω/ω = 1.8, gap/A₀ = 1.6"),
])
def test_the_title_has_the_place_in_the_units_of_the_job(tmp_path, place, units, words):
    path = write_basin(tmp_path / "a.h5", frequency_ratio=1.8, gap_ratio=1.6, natural_frequency_hz=4.5, cart_amplitude_m=0.89e-3,
                       job=f"schema = 1\n[operating_point]\n{place}\n")
    with PeterkaFile(path) as file, style.using(units=units):
        assert axes.operating_point(file) == words


@pytest.mark.parametrize("units, told", [("si", "$A_0\\Omega$ = 45.3 mm/s"), ("ratio", "$A_0\\Omega/(A_0\\omega)$ = 1.8")])
def test_the_legend_tells_how_an_attractor_of_the_summary_is_found_in_the_picture(tmp_path, units, told):
    """The summary has it relative to the cart, the picture over ground; with 4.5 Hz and 0.89 mm, A0 Omega is 0.0453 m/s."""
    path = write_basin(tmp_path / "a.h5", attractors=[row(1, 1, 1, 60.0, 16)], attractor=np.zeros((4, 4), dtype=int),
                       natural_frequency_hz=4.5, cart_amplitude_m=0.89e-3)
    with PeterkaFile(path) as file:
        figure = figure_of(basin_map.draw_attractors(file, units=units))
    words = [text.get_text() for ax in figure.axes if ax.get_legend() for text in ax.get_legend().get_texts()]
    assert any("$x = u$, $\\dot{x} = \\dot{u} + A_0\\Omega$" in word and told in word for word in words), words
