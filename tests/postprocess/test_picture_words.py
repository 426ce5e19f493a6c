"""What every picture has: the file's title, the operating point, a word at each axis, a grid where values are read off. And the sketch."""

import numpy as np
import pytest
from curves_samples import write_curves
from matplotlib.patches import FancyArrowPatch, Rectangle
from peterka import rig_sketch
from peterka.pictures import open_file, pictures_of
from peterka.plotting.figures import figure_of
from picture_samples import PLAIN, orbit, write_basin, write_map
from study_samples import write_labels, write_stability, write_work_precision
from sweep_samples import write_sweep
from trace_samples import write_trace

pytestmark = pytest.mark.thorough

TITLE = "What this file is called"


def basin(path, **attributes):
    table = [dict(regime=1, impacts=1, period=1, peak_force_ratio=5.0, cells=5, orbit_displacement=0.1, orbit_velocity=-1.0)]
    cells = np.broadcast_to(orbit(1, 1), (4, 4, 3))
    return write_basin(path, cells, table, np.zeros((4, 4), int), frequency_ratio=1.8, gap_ratio=0.5, **attributes)


WRITERS = [write_map, basin, write_sweep, write_trace, write_work_precision, write_labels, write_stability, write_curves]
OF_PLANES = (write_map, basin, write_curves)


def has_values(ax):
    return ax.axison and (ax.lines or ax.collections or ax.images)


@pytest.mark.parametrize("write", WRITERS, ids=lambda write: write.__name__)
def test_titles_axes_and_grids(tmp_path, write):
    options = {"fields": {"impact_speed": np.ones(np.shape(PLAIN)[:2])}} if write is write_map else {}
    path = write(tmp_path / "a.h5", title=TITLE, **options)
    with open_file(path) as file:
        for name, draw in pictures_of(file).items():
            drawn = draw(file)
            if drawn is None:
                continue
            figure = figure_of(drawn)
            figure.draw_without_rendering()
            title, *others = figure._suptitle.get_text().split("\n")
            assert title == TITLE, name
            assert others or write not in (basin, write_trace), name
            axes = [ax for ax in figure.axes if has_values(ax)]
            above = {ax for ax in axes for other in axes if other.bbox.y1 <= ax.bbox.y0 and other.bbox.x0 < ax.bbox.x1 and ax.bbox.x0 < other.bbox.x1}
            for ax in axes if write is not write_stability else ():  # whose first panel has the names of methods
                scales = [ax, *ax.child_axes]
                assert ax in above or any(scale.get_xlabel() for scale in scales), name
                assert not ax.get_yticklabels() or any(scale.get_ylabel() for scale in scales), name
            if write not in OF_PLANES:
                gridded = [ax for ax in axes if any(line.get_visible() for line in (ax.xaxis.get_gridlines()[0], ax.yaxis.get_gridlines()[0]))]
                assert gridded == [ax for ax in axes if ax.lines], name


def parts(figure):
    (ax,) = figure.axes
    boxes = [patch.get_bbox() for patch in ax.patches if isinstance(patch, Rectangle)]
    return ax, boxes[:3], boxes[3]  # floor, wall and stop; the hammer


def test_in_the_sketch_springs_and_dampers_join_what_they_should():
    """The wall with the hammer, and the stop with a plate beyond the gap; x grows to the right."""
    ax, (floor, wall, stop), hammer = parts(rig_sketch.draw())
    assert wall.x1 < hammer.x0 < hammer.x1 < stop.x0 and floor.y1 == wall.y0 == stop.y0 < hammer.y0
    assert floor.x0 == wall.x0 and floor.x1 == pytest.approx(stop.x1) and hammer.y1 < wall.y1 == stop.y1
    lines = [np.transpose(line.get_data()) for line in ax.lines]
    (plate,) = [line for line in lines if len(line) == 2 and line[0, 0] == line[1, 0] and np.ptp(line[:, 1]) == pytest.approx(hammer.height)]
    touched = plate[0, 0]
    assert hammer.x1 < touched < stop.x0 and sorted(plate[:, 1]) == pytest.approx([hammer.y0, hammer.y1])
    springs = [line for line in lines if len(line) == 15]
    assert sorted((line[0, 0], line[-1, 0]) for line in springs) == pytest.approx([(wall.x1, hammer.x0), (touched, stop.x0)])
    for line in springs:
        assert np.all(np.diff(line[:, 0]) > 0) and line[0, 1] == line[-1, 1] and hammer.y0 < line[:, 1].min() < line[:, 1].max() < hammer.y1
        turned = line[2:-2, 1] - line[0, 1]
        assert np.all(turned[1:] == pytest.approx(-turned[:-1])) and turned[0] != 0
    cups = [line for line in lines if len(line) == 4]
    for cup, (low, high) in zip(sorted(cups, key=lambda line: line[0, 0]), [(wall.x1, hammer.x0), (touched, stop.x0)], strict=True):
        assert low < cup[0, 0] == cup[3, 0] < (low + high) / 2 < cup[1, 0] == cup[2, 0] < high and cup[0, 1] == cup[1, 1] < cup[2, 1] == cup[3, 1]
        middle = (cup[0, 1] + cup[2, 1]) / 2
        rods = [line for line in lines if len(line) == 2 and line[0, 1] == line[1, 1] == pytest.approx(middle) and low <= line[0, 0] < line[1, 0] <= high]
        assert sorted((rod[0, 0], rod[1, 0]) for rod in rods) == pytest.approx([(low, (low + high) / 2), (cup[1, 0], high)])
        (piston,) = [line for line in lines if len(line) == 2 and line[0, 0] == line[1, 0] == (low + high) / 2]
        assert cup[0, 1] < piston[0, 1] < middle < piston[1, 1] < cup[2, 1]
    wheels = [line for line in lines if len(line) == 1]
    (ground,) = [line for line in lines if len(line) == 2 and line[0, 1] == line[1, 1] < floor.y0]
    assert len(wheels) == 2 and all(floor.x0 < wheel[0, 0] < floor.x1 and ground[0, 1] < wheel[0, 1] < floor.y0 for wheel in wheels)
    assert ground[0, 0] < floor.x0 and floor.x1 < ground[1, 0]


def test_in_the_sketch_arrows_point_where_numbers_are_positive():
    """x from the hammer's middle and y from the wall's to the right, the force from the hammer's face to the left, and the gap from that
    face to the plate, with a line up from what an arrow measures."""
    ax, (_, wall, stop), hammer = parts(rig_sketch.draw())
    arrows = [(*patch._posA_posB[0], *patch._posA_posB[1]) for patch in ax.patches if isinstance(patch, FancyArrowPatch)]
    (gap, x, y, force) = arrows
    words = {text.get_text(): text.get_position() for text in ax.texts}
    assert gap[0] == hammer.x1 < gap[2] < stop.x0 and hammer.y1 < gap[1] == gap[3] < words["gap (at $u=0$)"][1]
    assert words["gap (at $u=0$)"][0] == pytest.approx((gap[0] + gap[2]) / 2)
    assert (x[0], y[0], force[0]) == pytest.approx(((hammer.x0 + hammer.x1) / 2, (wall.x0 + wall.x1) / 2, hammer.x1))
    assert x[2] - x[0] == pytest.approx(1) and y[2] - y[0] == pytest.approx(1) and force[2] < force[0] and wall.y1 < x[1] == x[3] == y[1]
    for name, arrow in (("$x$: hammer, seen from the ground", x), (r"$y=A_0\,\sin\,\Omega t$: cart", y)):
        assert words[name][0] == arrow[0] and arrow[1] < words[name][1] < arrow[1] + 0.5, name  # above the arrow, from its beginning on
    feet = [np.transpose(line.get_data()) for line in ax.lines if line.get_linestyle() == "--"]
    assert [(foot[0, 0], foot[0, 1]) for foot in feet] == pytest.approx([(x[0], hammer.y1), (y[0], wall.y1)]) and all(foot[1, 1] > x[1] for foot in feet)
    inside = words["hammer $m$"]
    assert inside == pytest.approx(((hammer.x0 + hammer.x1) / 2, (hammer.y0 + hammer.y1) / 2))
    assert [words[name][0] for name in (r"$k,\ k_3$", "$c$", "$k_i$", "$c_i$")] == pytest.approx(
        [(wall.x1 + hammer.x0) / 2, (wall.x1 + hammer.x0) / 2, (gap[2] + stop.x0) / 2, (gap[2] + stop.x0) / 2])
    assert words[r"$k,\ k_3$"][1] > words["$c$"][1] and words["stop"][0] == pytest.approx((stop.x0 + stop.x1) / 2) and words["stop"][1] > stop.y1
