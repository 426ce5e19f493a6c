"""Pictures of curves: each kind by its own line, special points by letters, p/q at the curves, in the right place."""

import numpy as np
import pytest
from curves_samples import LINES, write_curves
from peterka.files.opened import NotDrawable
from peterka.look import axes, style
from peterka.maps import curves_map
from peterka.maps.curves_file import CurvesFile
from peterka.pictures import open_file, pictures_of


def drawn(path, picture, tmp_path):
    with CurvesFile(path) as file, style.using():
        ax = picture(file)
        if ax is None:
            return None
        axes.save(axes.figure_of(ax), tmp_path / "a.png")
    return axes.figure_of(ax)


def legend_words(figure):
    return [text.get_text() for ax in figure.axes if ax.get_legend() for text in ax.get_legend().get_texts()]


@pytest.mark.parametrize("picture", [curves_map.draw, curves_map.draw_over_map])
def test_each_kind_has_its_line(tmp_path, picture):
    figure = drawn(write_curves(tmp_path / "c.h5"), picture, tmp_path)
    lines = [line for line in figure.axes[0].lines if len(line.get_xdata()) == 3]
    for line, (*_, points) in zip(lines, LINES, strict=True):
        assert np.allclose(line.get_xydata(), points)
    assert len({line.get_linestyle() if line.get_linestyle() == "-" else str(line._unscaled_dash_pattern)
                for line in lines}) == 3
    assert len({line.get_color() for line in lines}) == 3


def test_the_legend_tells_only_what_is_there(tmp_path):
    words = legend_words(drawn(write_curves(tmp_path / "c.h5"), curves_map.draw, tmp_path))
    assert words == ["fold: the orbit is born or ends", "period doubling", "grazing: an impact is gained or lost",
                     "fold with grazing", "cusp: two folds meet"]
    alone = write_curves(tmp_path / "d.h5", LINES[:1], [])
    assert legend_words(drawn(alone, curves_map.draw, tmp_path)) == ["fold: the orbit is born or ends"]


def test_orbits_and_special_points_are_named(tmp_path):
    figure = drawn(write_curves(tmp_path / "c.h5"), curves_map.draw_over_map, tmp_path)
    assert {"1/1", "1/2", "3/2", "F", "C"} <= {text.get_text() for text in figure.axes[0].texts}


def test_only_the_picture_over_the_map_has_its_cells(tmp_path):
    path = write_curves(tmp_path / "c.h5")
    assert not drawn(path, curves_map.draw, tmp_path).axes[0].collections
    assert drawn(path, curves_map.draw_over_map, tmp_path).axes[0].collections


def test_a_file_without_curves_gives_no_picture(tmp_path):
    assert drawn(write_curves(tmp_path / "c.h5", [], []), curves_map.draw, tmp_path) is None


def test_the_program_of_pictures_knows_the_kind(tmp_path):
    with open_file(write_curves(tmp_path / "c.h5")) as file:
        assert list(pictures_of(file)) == ["curves", "curves_over_map"]


@pytest.mark.parametrize("line", [(3, 1, 1, [(1.0, 1.0)]), (0, -1, 1, [(1.0, 1.0)]), (0, 1, 0, [(1.0, 1.0)]),
                                  (0, 1, 1, [(np.nan, 1.0)])])
def test_a_curve_that_cannot_be_is_refused(tmp_path, line):
    with pytest.raises(NotDrawable):
        CurvesFile(write_curves(tmp_path / "c.h5", [*LINES, line]))
