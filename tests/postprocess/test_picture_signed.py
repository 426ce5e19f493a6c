"""Values of either sign: in the grey palette, too, a reader can tell which is which, and how large each is."""

import io

import matplotlib.image
import numpy as np
import pytest
from colour_distance import lightness
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_hex
from peterka.maps import comparison, comparison_map
from peterka.maps.elasticity_map import draw
from peterka.maps.map_file import PeterkaFile
from peterka.plotting import style
from picture_samples import orbit, write_map
from test_picture_elasticity import STIFFNESS, sample

pytestmark = pytest.mark.thorough

ROWS, COLUMNS = 8, 12


def pixels_of(figure):
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=300)
    buffer.seek(0)
    return np.rint(matplotlib.image.imread(buffer)[..., :3] * 255).astype(int)


def light_within(figure, ax, across, up):
    """Lightness of each pixel of a part of the Axes, given in their own shares from 0 to 1."""
    pixels = pixels_of(figure)
    height, width = pixels.shape[:2]
    (x0, y0), (x1, y1) = figure.transFigure.inverted().transform(ax.transAxes.transform(np.transpose([across, up])))
    part = pixels[int((1 - y1) * height):int((1 - y0) * height), int(x0 * width):int(x1 * width)]
    return np.array([lightness(to_hex(pixel / 255).upper()) for pixel in np.unique(part.reshape(-1, 3), axis=0)]), part


def grey_elasticities(folder, size):
    """The left half of a map has -size, its right half +size, in all cells with an orbit."""
    signs = np.where(np.arange(32) < 16, -1.0, 1.0)[None, :] * np.ones((24, 1))
    path = sample(folder, **{STIFFNESS: size * signs})
    with style.using(palette="grey"), PeterkaFile(path) as file:
        return draw(file, number=STIFFNESS)


def test_in_grey_values_below_0_have_strokes_and_those_above_none(tmp_path):
    ax = grey_elasticities(tmp_path, 1.0)
    below, part = light_within(ax.figure, ax, (0.1, 0.3), (0.05, 0.2))
    above, _ = light_within(ax.figure, ax, (0.6, 0.8), (0.05, 0.2))
    assert np.ptp(below) > 30 and np.ptp(above) < 3
    is_stroke = (part.mean(axis=2) > part.min() + 40).mean(axis=1)  # strokes are level, as a minus sign is
    assert (is_stroke > 0.95).any() and (is_stroke < 0.05).any()


def test_in_grey_lightness_is_the_size_whatever_the_sign(tmp_path):
    """Strokes or not, the ground of -1 and +1 is equally dark."""
    ax = grey_elasticities(tmp_path, 1.0)
    below, above = (light_within(ax.figure, ax, across, (0.05, 0.2))[0] for across in ((0.1, 0.3), (0.6, 0.8)))
    assert below.min() == pytest.approx(above.min(), abs=1)


def test_the_legend_and_the_colour_bar_show_what_strokes_mean(tmp_path):
    ax = grey_elasticities(tmp_path, 1.0)
    entries = {text.get_text(): patch.get_hatch() for one in ax.figure.axes if one.get_legend()
               for text, patch in zip(one.get_legend().get_texts(), one.get_legend().get_patches())}
    assert entries["below 0"] and not entries["no elasticity"]
    bar = next(one for one in ax.figure.axes if "% per %" in one.get_xlabel())
    left, right = (light_within(ax.figure, bar, across, (0.1, 0.9))[1].mean(axis=2) for across in ((0.05, 0.25), (0.75, 0.95)))
    assert np.ptp(left, axis=0).min() > 60 and np.ptp(right, axis=0).max() < 5  # from line to line


def test_strokes_are_one_image_of_a_drawing_and_not_a_path_for_each_piece(tmp_path):
    ax = grey_elasticities(tmp_path, 1.0)
    planes = [mesh for mesh in ax.collections if isinstance(mesh, QuadMesh)]
    assert len(planes) > 1 and all(mesh.get_rasterized() for mesh in planes)


def test_in_colour_there_are_no_strokes(tmp_path):
    with PeterkaFile(sample(tmp_path, **{STIFFNESS: -1.0})) as file:
        ax = draw(file, number=STIFFNESS)
    assert not any(text.get_text() == "below 0" for one in ax.figure.axes if one.get_legend() for text in one.get_legend().get_texts())
    assert np.ptp(light_within(ax.figure, ax, (0.1, 0.3), (0.05, 0.2))[0]) < 3


def test_in_grey_weaker_and_stronger_forces_differ(tmp_path):
    cells = [[orbit(1, 1)] * COLUMNS] * ROWS
    forces = np.full((ROWS, COLUMNS), 10.0)
    changed = forces * np.where(np.arange(COLUMNS) < COLUMNS // 2, 0.8, 1.25)
    paths = write_map(tmp_path / "a.h5", cells, forces=forces), write_map(tmp_path / "b.h5", cells, forces=changed)
    with style.using(palette="grey"), PeterkaFile(paths[0]) as a, PeterkaFile(paths[1]) as b:
        figure = comparison_map.draw(a, b, comparison.compare(a, b))
    weaker, stronger = (light_within(figure, figure.axes[0], across, (0.4, 0.6))[0] for across in ((0.1, 0.3), (0.7, 0.9)))
    assert np.ptp(weaker) > 30 and np.ptp(stronger) < 3 and weaker.min() == pytest.approx(stronger.min(), abs=1)
    assert any(text.get_text() == "B weaker than A" for one in figure.axes if one.get_legend() for text in one.get_legend().get_texts())
