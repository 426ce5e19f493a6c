"""The Peterka map: right colour at the right place, only occurring classes in the legend, second scales, notice."""

import numpy as np
import pytest
from peterka.plotting import axes
from peterka.plotting.classes import CLASSES, SECOND_COLOURS, classify
from peterka.plotting.figures import figure_of
from peterka.maps import peterka_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import ALL_CLASSES, CHAOTIC, MISSING, PLAIN, Drawn, colour_named, write_map


def labels_of(cells):
    return [[CLASSES[index].label for index in row] for row in classify(*np.moveaxis(np.array(cells), -1, 0))]


@pytest.mark.parametrize("cells", [PLAIN, ALL_CLASSES])
def test_each_cell_has_the_colour_of_its_class(tmp_path, cells):
    with PeterkaFile(write_map(tmp_path / "a.h5", cells)) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
        for row, line in enumerate(labels_of(cells)):
            for column, label in enumerate(line):
                if label != "not computed yet":
                    assert drawn.colour_of(file, row, column) == colour_named(label), (row, column, label)


def test_legend_has_the_classes_that_occur_and_their_shares(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5")) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
    assert drawn.legend_texts() == [
        "1/1 (31.2 %)", "2/2 (6.2 %)", "1/2 (12.5 %)", "no impact (43.8 %)", "chaotic (6.2 %)",
    ]


@pytest.mark.parametrize("cycles, label", [
    ({(0, 0): 9, (1, 2): 1500, (2, 0): 20000}, "chaotic for 1,500–20,000 cycles (12.5 %)"),
    ({(1, 2): 1500, (2, 0): 1500}, "chaotic for 1,500 cycles (12.5 %)"),
    ({(1, 2): 1500, (2, 0): 0}, "chaotic for 1,500 cycles (12.5 %)"),  # filled cells were not observed
    ({(0, 0): 9}, "chaotic (12.5 %)"),
])
def test_legend_says_for_how_many_cycles_chaos_was_observed(tmp_path, cycles, label):
    cells = [PLAIN[0], PLAIN[1], [CHAOTIC, *PLAIN[2][1:]], PLAIN[3]]  # chaos at (1, 2) and (2, 0)
    observed = [[cycles.get((row, column), 0) for column in range(4)] for row in range(4)]
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, fields={"observed_cycles": observed})) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
    assert [text for text in drawn.legend_texts() if text.startswith("chaotic")] == [label]


def test_legend_of_a_map_with_every_class(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5", ALL_CLASSES)) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
        inside = drawn.figure.bbox
        for ax in drawn.figure.axes:
            if ax.get_legend():
                box = ax.get_legend().get_window_extent()
                assert inside.x0 <= box.x0 and box.x1 <= inside.x1 and inside.y0 <= box.y0, "legend leaves the picture"
    assert sorted(text.split(" (")[0] for text in drawn.legend_texts()) == sorted(entry.label for entry in CLASSES if entry.colour not in SECOND_COLOURS)


def test_large_areas_carry_their_name(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5")) as file:
        figure = figure_of(peterka_map.draw(file))
    assert {text.get_text() for text in figure.axes[0].texts} >= {"1/1", "1/2", "no impact"}


def test_second_scales_follow_the_file(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5")) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
    top, right = drawn.map_axes.child_axes
    assert top.get_xlim() == pytest.approx(np.multiply(drawn.map_axes.get_xlim(), 4.5))
    assert right.get_ylim() == pytest.approx(np.multiply(drawn.map_axes.get_ylim(), 0.89))
    assert "Hz" in top.get_xlabel() and "mm" in right.get_ylabel()


def test_no_second_scales_without_the_rig(tmp_path):
    path = write_map(tmp_path / "a.h5", natural_frequency_hz=np.nan, cart_amplitude_m=-1.0)
    with PeterkaFile(path) as file:
        assert figure_of(peterka_map.draw(file)).axes[0].child_axes == []


def test_cells_of_a_logarithmic_axis_meet_at_geometric_means(tmp_path):
    cells = [[(1, 1, 1), (1, 1, 1), (1, 1, 2), (1, 1, 2)]] * 4
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, frequency_ratio=[0.5, 1.0, 2.0, 4.0])) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
        assert drawn.map_axes.get_xscale() == "log"
        assert file.columns.edges == pytest.approx([2**-1.5, 2**-0.5, 2**0.5, 2**1.5, 2**2.5])
    assert drawn.colour_at(1.38, 0.1) == colour_named("1/1")
    assert drawn.colour_at(1.45, 0.1) == colour_named("1/2")  # the arithmetic mean would be 1.5


@pytest.mark.parametrize("points", [2, 3, 4])
def test_coarse_maps_show_no_frequency_below_zero(tmp_path, points):
    cells = [[(1, 1, 1)] * points] * 4
    with PeterkaFile(write_map(tmp_path / "a.h5", cells, frequency_ratio=np.linspace(0.5, 4.5, points))) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
        assert drawn.map_axes.get_xlim()[0] == 0
        assert drawn.colour_at(0.05, 0.1) == colour_named("1/1"), "the first cell reaches down to 0"


def test_incomplete_map_says_so_and_leaves_cells_open(tmp_path):
    cells = [PLAIN[0], PLAIN[1], PLAIN[2], [MISSING] * 4]
    with PeterkaFile(write_map(tmp_path / "a.h5", cells)) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
        patch = {drawn.colour_at(x, 2.7) for x in np.linspace(3.1, 4.4, 200)}
    assert "incomplete: 75.0 % computed" in drawn.map_texts()
    assert "not computed yet (25.0 %)" in drawn.legend_texts()
    assert "#FFFFFF" in patch and len(patch) > 1, "a hatch has lines on white"


def test_complete_map_has_no_notice(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5")) as file:
        assert not any("incomplete" in text.get_text() for text in figure_of(peterka_map.draw(file)).axes[0].texts)


@pytest.mark.parametrize("attributes, present", [
    ({"damping_ratio": 0.01}, True), ({}, False), ({"damping_ratio": "x"}, False),
])
def test_edge_of_no_impact_is_drawn_only_with_a_damping_ratio(tmp_path, attributes, present):
    with PeterkaFile(write_map(tmp_path / "a.h5", **attributes)) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
    assert ("free swing grazes the stop" in drawn.legend_texts()) == present
    assert len(drawn.map_axes.lines) == present


def test_edge_of_no_impact_is_the_amplitude_of_the_free_hammer():
    assert peterka_map.edge_of_no_impact(2.0, 0.0) == pytest.approx(4 / 3)
    assert peterka_map.edge_of_no_impact(1.0, 0.02) == pytest.approx(25)  # 1/(2 zeta)


def test_a_title_is_not_mathematics(tmp_path):
    with PeterkaFile(write_map(tmp_path / "a.h5", title="costs $5\n\x07 and x_1^$")) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
    assert drawn.figure._suptitle.get_text() == r"costs $5\n\x07 and x_1^$"


@pytest.mark.parametrize("share, text", [
    (0, "0.0 %"), (1, "100.0 %"), (0.204, "20.4 %"), (1e-7, "< 0.05 %"), (1 - 1e-7, "> 99.95 %"), (7e-4, "0.1 %"), (0.9994, "99.9 %"),
])
def test_percent(share, text):
    assert axes.percent(share) == text


def test_almost_complete_is_not_called_complete():
    class File:
        computed = 1 - 1e-9
        is_complete = False

    assert axes.incomplete_text(File) == "incomplete: 99.9 % computed"
