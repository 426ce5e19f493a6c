"""Legends name no line that isn't there; words beside a scale around 0 tell how many cells lie beyond it."""

import numpy as np
import pytest
from peterka.maps import elasticity_map, peterka_map, uncertain_map
from peterka.maps.map_file import PeterkaFile
from peterka.plotting.figures import figure_of
from picture_samples import write_map
from test_picture_elasticity import STIFFNESS, ramp, sample
from uncertain_samples import write_uncertain

ROWS, COLUMNS = 24, 32


def legend_texts(drawn):
    return [text.get_text() for ax in figure_of(drawn).axes if ax.get_legend() for text in ax.get_legend().get_texts()]


def shares_of(likely):
    """Of 1/1 and of no impact; no other motion occurs."""
    zero = np.zeros((ROWS, COLUMNS))
    return np.stack([zero + likely, 1 - (zero + likely), zero, zero])


@pytest.mark.parametrize("frequencies, gaps, seen", [
    ((0.1, 0.3), (2, 3), False), ((1.0, 4.0), (-3, -2), False), ((1.0, 4.0), (0, 3), True), ((1.2, 1.3), (2, 3), True)])
def test_the_swing_that_grazes_is_named_where_its_line_is_seen(tmp_path, frequencies, gaps, seen):
    path = write_map(tmp_path / "a.h5", frequency_ratio=np.linspace(*frequencies, 4), gap_ratio=np.linspace(*gaps, 4), damping_ratio=0.01)
    with PeterkaFile(path) as file:
        drawn = peterka_map.draw(file)
    assert ("free swing grazes the stop" in legend_texts(drawn)) == seen
    assert len(drawn.lines) == seen


@pytest.mark.parametrize("likely, levels", [(1.0, []), (np.linspace(0.3, 0.8, COLUMNS), ["0.5"]), (np.linspace(0.3, 1.0, COLUMNS), ["0.5", "0.9", "0.95"])])
def test_probabilities_are_named_where_their_lines_are_seen(tmp_path, likely, levels):
    with PeterkaFile(write_uncertain(tmp_path / "a.h5", shares=shares_of(likely))) as file:
        probability = uncertain_map.draw_probability(file, probability="1/1")
        commonest = uncertain_map.draw_commonest(file)
    assert [text for text in legend_texts(probability) if text.startswith("probability")] == [f"probability {level}" for level in levels]
    assert any("ticks" in text for text in legend_texts(commonest)) == ("0.95" in levels)


def test_one_row_has_no_line_of_a_probability(tmp_path):
    shares = shares_of(np.linspace(0.0, 1.0, COLUMNS))[:, :1]
    with PeterkaFile(write_uncertain(tmp_path / "a.h5", rows=1, shares=shares)) as file:
        assert not any("probability" in text for text in legend_texts(uncertain_map.draw_probability(file, probability="1/1")))


@pytest.mark.parametrize("limits", [None, (-5.0, 5.0), (-0.5, 1.0)])
def test_a_scale_around_0_tells_how_many_cells_lie_beyond(tmp_path, limits):
    with PeterkaFile(sample(tmp_path, **{STIFFNESS: ramp()})) as file:
        ax = elasticity_map.draw(file, number=STIFFNESS, limits=limits)
    mesh, bar = ax.collections[-1], next(each for each in ax.figure.axes if "% per %" in each.get_xlabel())
    values = np.ma.compressed(mesh.get_array())
    low, high = bar.get_xlim()
    beyond = 100 * np.mean((values < low) | (values > high))
    assert bar.get_title() == (f"{beyond:.1f} % of these cells beyond the scale" if beyond else "")
    assert bool(beyond) == (limits != (-5.0, 5.0))
