"""Rules of a line or two that no picture or page shows: arguments at the ends of their range, labels of nothing."""

import argparse

import numpy as np
import pytest
from matplotlib.figure import Figure
from peterka import backend
from peterka.cli import explore
from peterka.errors import PeterkaFileError
from peterka.maps import common_plane
from peterka.pictures import open_file
from peterka.plotting.linear_ticks import letters, numbers
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
