"""Logarithmic axes: labels do not overlap, are round, and exist for every range."""

import numpy as np
import pytest
from peterka.plotting.log_ticks import LogNumbers, LogTicks
from peterka.maps import peterka_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import Drawn, orbit, write_map

pytestmark = pytest.mark.thorough

RANGES = [(0.5, 4.5), (0.01, 50), (1e-3, 1e3), (2.1, 2.9), (1e-9, 1e12), (0.9, 1.1), (100, 1e15), (3e-7, 2e-5)]


@pytest.mark.parametrize("low, high", RANGES)
def test_labels_on_all_four_sides_stand_apart(tmp_path, low, high):
    values = np.geomspace(low, high, 8)
    with PeterkaFile(write_map(tmp_path / "a.h5", [[orbit(1, 1)] * 8] * 8, values, values)) as file:
        drawn = Drawn(peterka_map.draw(file), tmp_path / "a.png")
    top, right = drawn.map_axes.child_axes
    for axis in (drawn.map_axes.xaxis, drawn.map_axes.yaxis, top.xaxis, right.yaxis):
        lower, upper = sorted(axis.get_view_interval())
        placed = zip(axis.get_majorticklocs(), axis.get_ticklabels())
        shown = [label for tick, label in placed if lower <= tick <= upper]
        boxes = [label.get_window_extent() for label in shown]
        assert len(boxes) >= 2, axis
        for first, second in zip(boxes, boxes[1:]):
            assert not first.padded(1).overlaps(second), [label.get_text() for label in shown]


def test_one_two_five_where_there_is_room():
    assert LogTicks().tick_values(0.45, 5.1) == pytest.approx([0.5, 1, 2, 5])
    assert LogTicks().tick_values(1e-3, 1e3) == pytest.approx([1e-3, 1e-2, 0.1, 1, 10, 100, 1000])


def test_a_narrow_range_has_even_ticks_inside_it():
    assert LogTicks().tick_values(1.2e-5, 1.9e-5) == pytest.approx([1.2e-5, 1.4e-5, 1.6e-5, 1.8e-5])
    assert LogTicks().tick_values(3e-5, 9.9e-5).min() > 0


def test_an_axis_without_a_positive_range_has_no_ticks():
    assert len(LogTicks().tick_values(0, 1)) == 0 and len(LogTicks().tick_values(np.nan, 1)) == 0


@pytest.mark.parametrize("ticks, texts", [
    ([0.05, 1, 2000], ["0.05", "1", "2000"]),
    ([1e-6, 1e-3, 1], ["$10^{-6}$", "$10^{-3}$", "$10^{0}$"]),
    ([2e-7, 5e-7], [r"$2\cdot10^{-7}$", r"$5\cdot10^{-7}$"]),
])
def test_labels_of_one_axis_are_written_alike(ticks, texts):
    assert LogNumbers().format_ticks(ticks) == texts
