"""Rules of a line or two that no picture or page shows: arguments at the ends of their range, labels of nothing."""

import argparse

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure
from peterka import backend
from peterka.cli import explore
from peterka.errors import PeterkaFileError
from peterka.identification.columns import UNITS
from peterka.maps import common_plane
from peterka.pictures import open_file
from peterka.plotting import frames, notes, style
from peterka.plotting.linear_ticks import LinearNumbers, LinearTicks, letters, numbers
from peterka.studies import methods
from peterka.sweeps import sweep_panels
from picture_samples import write_map
from sweep_samples import write_sweep


@pytest.mark.parametrize("text, step", [("1", 1), ("7", 7), ("99999", 99999)])
def test_a_step_along_rows_and_columns_is_taken(text, step):
    assert explore.read_step(text) == step


@pytest.mark.parametrize("text", ["0", "100000", "-1", "1.5", "", "two", "\N{SUPERSCRIPT TWO}"])
def test_another_step_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError):
        explore.read_step(text)


@pytest.mark.parametrize("values, labels", [
    ([0.0, 0.0], ["0", "0"]), ([], []), ([0.0, 0.5, 1.0], ["0.0", "0.5", "1.0"]), ([-2.0, 0.0, 2.0], ["\N{MINUS SIGN}2", "0", "2"]),
    ([0.0, 2e-9, 4e-9], ["0", r"$2\cdot10^{-9}$", r"$4\cdot10^{-9}$"])])
def test_labels_of_an_axis(values, labels):
    assert numbers(np.array(values)) == labels


def test_a_power_of_ten_takes_less_than_its_digits():
    assert letters("123") == 3
    assert letters(r"$2\cdot10^{-9}$") == pytest.approx(1 + 3 + 0.7 * 2)


@pytest.mark.parametrize("low, high", [(0, 1e9), (1e6, 1e6 + 1), (-1e-7, 1e-7)])
def test_labels_of_an_axis_need_no_summand_or_factor_at_its_end(low, high):
    axis = Figure().subplots().xaxis
    axis.axes.set_xlim(low, high)
    axis.set(major_locator=LinearTicks(), major_formatter=LinearNumbers())
    axis.figure.draw_without_rendering()
    assert axis.get_offset_text().get_text() == "" and len({text.get_text() for text in axis.get_ticklabels()}) > 1


@pytest.mark.parametrize("height", np.linspace(0.15, 0.8, 14))
def test_ticks_below_0_are_those_above_it_in_a_mirror(height):
    """On an upright axis, whose labels are equally high; ticks at its very ends count like others."""
    def ticks(low, high):
        ax = Figure().add_axes((0, 0, 1, height / 4.8), ylim=(low, high))  # in
        ax.yaxis.set_major_locator(LinearTicks())
        return ax.yaxis.get_majorticklocs()

    assert list(ticks(-10, 0)) == list(-ticks(0, 10)[::-1])


def test_a_legend_has_as_many_columns_as_find_room_when_it_is_drawn():
    """Three entries in a row are as wide as matplotlib then makes them, beside a little air."""
    with style.using():
        handles = [frames.legend_patch(text, "black") for text in ("first", "the second one", "third")]
        figure = plt.figure(figsize=(6, 1))
        frames.write_legend(figure.add_axes((0, 0, 1, 1)), handles, 3, None, frames.PATCH)
        figure.draw_without_rendering()
        drawn = figure.axes[0].get_legend().get_window_extent().width / figure.dpi
        plt.close(figure)
        assert [frames.columns_that_fit(handles, 3, drawn + air, frames.PATCH) for air in (0.2, 0.0)] == [3, 2]


def test_legends_take_nothing_from_the_height_of_a_map():
    with style.using():
        handles = [frames.legend_patch(text, "black") for text in "abcd"]
        heights = []
        for legends in ([], [(handles, 4, None)], [(handles, 2, "a title"), (handles, 1, None), (handles, 2, None)]):
            figure, ax, _ = frames.stack(5.2, np.zeros((4, 4)), legends)
            figure.draw_without_rendering()
            heights.append(ax.get_window_extent().height / figure.dpi)
    assert heights[0] < heights[1] < heights[2] < 1.2 * heights[0]


@pytest.mark.parametrize("across, up, horizontal, vertical", [
    (0.2, 0.2, "left", "bottom"), (0.8, 0.2, "right", "bottom"), (0.2, 0.8, "left", "top"), (0.8, 0.8, "right", "top"),
    (0.5, 0.5, "right", "top")])
def test_a_note_stands_on_the_side_with_more_room_and_in_the_very_middle_below_on_the_left(across, up, horizontal, vertical):
    ax = Figure(figsize=(4, 4), dpi=100).add_axes((0, 0, 1, 1))
    notes.write_beside(ax, across, up, "best")
    note, = ax.texts
    assert (note.get_ha(), note.get_va()) == (horizontal, vertical)


def test_a_method_with_one_point_has_its_band_as_a_line_like_others():
    ax = Figure().subplots()
    methods.draw_points(ax, np.array([1.0]), np.array([2.0]), "exact", np.array([1.0]), np.array([3.0]))
    methods.draw_points(ax, np.array([1.0, 2.0]), np.array([2.0, 2.0]), "exact")
    band, = ax.collections
    assert band.get_segments()[0].tolist() == [[1, 1], [1, 3]]
    assert list(band.get_linewidths()) == [line.get_linewidth() for line in ax.lines if len(line.get_xdata()) == 2]


@pytest.mark.parametrize("quantity, base", [("time", "s"), ("force", "N"), ("acceleration", "m/s2"), ("displacement", "m")])
def test_prefixes_of_units_are_powers_of_ten(quantity, base):
    powers = {"k": 1e3, "": 1.0, "c": 1e-2, "m": 1e-3, "u": 1e-6, "µ": 1e-6}
    prefixed = {unit: unit.removesuffix(base) for unit in UNITS[quantity] if unit.endswith(base)}
    assert {unit: UNITS[quantity][unit] for unit in prefixed} == {unit: powers[prefix] for unit, prefix in prefixed.items()}


def test_a_page_takes_each_nth_row_and_column_as_long_as_two_are_left(tmp_path, monkeypatch):
    with open_file(write_map(tmp_path / "a.h5")) as file:  # 4 x 4
        assert explore.explorable(file, 1) is file and explore.explorable(file, 3) is file
        with pytest.raises(PeterkaFileError, match="too few rows or columns for --every 4"):
            explore.explorable(file, 4)
        monkeypatch.setattr(explore, "MOST_CELLS", 15)
        with pytest.raises(PeterkaFileError, match="has 16 cells, a page holds 15; --every 2 takes a part"):
            explore.explorable(file, 1)
        monkeypatch.setattr(explore, "MOST_CELLS", 16)
        assert explore.explorable(file, 1) is file


def test_a_page_shows_every_point_of_a_sweep(tmp_path):
    with open_file(write_sweep(tmp_path / "a.h5")) as file:
        assert explore.explorable(file, 1) is file
        with pytest.raises(PeterkaFileError, match="a page shows every point"):
            explore.explorable(file, 2)


@pytest.mark.parametrize("fine", [[2.0], [0.0, 1.0, 3.0, 3.5], [-5.0, 20.0]])
def test_of_the_values_of_one_file_the_nearest_to_each_of_another(fine):
    coarse = np.linspace(-1, 5, 23)
    found = common_plane._nearest(np.array(fine), coarse)
    assert np.array_equal(np.abs(np.array(fine)[found] - coarse), np.abs(np.subtract.outer(fine, coarse)).min(axis=0))


@pytest.mark.parametrize("scale, heights", [("linear", [2.0, 4.0, 6.0]), ("log", [2.0, 2 * 3**0.5, 6.0])])
def test_heights_at_shares_of_a_panel(scale, heights):
    ax = Figure().subplots()
    ax.set(yscale=scale, ylim=(2, 6))
    assert [sweep_panels._at_share(ax, share) for share in (0, 0.5, 1)] == pytest.approx(heights)


def test_no_file_is_taken_for_one_of_peterka_unasked():
    assert backend.PeterkaBackend().guess_can_open("a.h5") is False
