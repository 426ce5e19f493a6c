"""Pictures of studies: numbers at the right place, every method distinguishable, missing results left open."""

from itertools import combinations

import matplotlib.image
import numpy as np
import pytest
from colour_distance import deuteranope_sight, difference, lightness, normal_sight
from peterka.plotting import axes
from peterka.plotting.figures import figure_of
from peterka.studies import labels, methods, stability, study_words, work_precision
from peterka.studies.study_file import StudyFile
from study_samples import (
    ENGINES, METHODS, SCENES, sample_runs, write_labels, write_stability, write_work_precision,
)
from sealing import SealedFile

pytestmark = pytest.mark.thorough

NAN = np.nan
DONE = ["done"] * 3


def drawn(path, picture, tmp_path):
    with StudyFile(path) as file:
        figure = figure_of(picture(file))
    axes.save(figure, tmp_path / "a.png")
    return figure


def texts_of(ax):
    return [text.get_text() for text in ax.texts]


def first_points(ax):
    return {(float(line.get_xdata()[0]), float(line.get_ydata()[0])) for line in ax.lines}


def squares_of(figure):
    """(scene, engine) -> text in the square."""
    texts = figure.axes[0].texts
    return {(int(text.get_position()[1]), int(text.get_position()[0])): text.get_text() for text in texts}


def grey_at(figure, picture, x, y):
    pixels = np.rint(matplotlib.image.imread(picture)[..., :3] * 255).astype(int)
    place = figure.axes[0].transData.transform((x, y))
    across, up = figure.transFigure.inverted().transform(place)
    return "#%02X%02X%02X" % tuple(pixels[int((1 - up) * pixels.shape[0]), int(across * pixels.shape[1])])


def test_a_point_is_the_median_over_the_cells(tmp_path):
    runs = [
        ("cvode_adams", 1e-6, [1e-7, 3e-7, 2e-7], [3e-6, 1e-6, 2e-6], DONE),
        ("cvode_adams", 1e-3, [1e-4, 0.9, 3e-4], [1e-6, 5.0, 3e-6], ["done", "other_orbit", "done"]),
        ("exact", 0, [0, 1e-15, 0], [1e-7] * 3, DONE),
        ("split", 1e-3, [NAN] * 3, [NAN] * 3, ["failed"] * 3),
    ]
    with StudyFile(write_work_precision(tmp_path / "a.h5", runs)) as file:
        slow, fast = sorted(work_precision.points_of(file.table, "cvode_adams"), key=lambda point: point.setting)
        exact, = work_precision.points_of(file.table, "exact")
        assert work_precision.points_of(file.table, "split") == []
    assert (slow.seconds, slow.error, slow.smallest, slow.largest) == pytest.approx((2e-6, 2e-7, 1e-7, 3e-7))
    assert (fast.seconds, fast.error, fast.done, fast.cells) == (2e-6, pytest.approx(2e-4), 2, 3)
    assert (exact.error, exact.largest) == (0, 1e-15)


def test_lines_are_in_microseconds_on_logarithmic_axes(tmp_path):
    runs = [("rk4_with_events", 100, [1e-4] * 3, [2e-6] * 3, DONE), ("exact", 0, [0] * 3, [1e-6] * 3, DONE)]
    ax = drawn(write_work_precision(tmp_path / "a.h5", runs), work_precision.draw, tmp_path).axes[0]
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    assert first_points(ax) == {(2.0, 1e-4), (1.0, work_precision.SMALLEST_ERROR)}, "an error of 0 has a place, too"
    assert "µs" in ax.get_xlabel() and "peak force" in ax.get_ylabel()


def test_the_legend_has_the_methods_that_have_points(tmp_path):
    figure = drawn(write_work_precision(tmp_path / "a.h5"), work_precision.draw, tmp_path)
    legend = figure.axes[-1].get_legend()
    names = [text.get_text() for text in legend.get_texts()]
    assert names == [*(methods.look(name).name for name in methods.methods_in_order(METHODS)), "hollow: not all cells"]
    box, page = legend.get_window_extent(), figure.bbox
    assert page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0
    complete = [run for run in sample_runs() if "other_orbit" not in run[4]]
    figure = drawn(write_work_precision(tmp_path / "b.h5", complete), work_precision.draw, tmp_path)
    assert not any("hollow" in text.get_text() for text in figure.axes[-1].get_legend().get_texts())


def test_no_picture_without_a_run_that_came_through(tmp_path, draw):
    runs = [("exact", 0, [NAN] * 3, [NAN] * 3, ["failed"] * 3)]
    outcome = draw(write_work_precision(tmp_path / "a.h5", runs))
    assert (outcome.code, outcome.pictures) == (0, []) and "work_precision is left out" in outcome.stdout


def test_lines_follow_the_settings_even_where_times_scatter(tmp_path):
    runs = [("split", tolerance, [tolerance] * 3, [seconds] * 3, DONE)
            for tolerance, seconds in ((1e-9, 2e-6), (1e-3, 3e-6), (1e-6, 1e-6))]
    runs += [("rk4_with_events", steps, [1 / steps] * 3, [1e-6] * 3, DONE) for steps in (4000, 500)]
    with StudyFile(write_work_precision(tmp_path / "a.h5", runs)) as file:
        settings = {name: [point.setting for point in work_precision.points_of(file.table, name)]
                    for name in ("split", "rk4_with_events")}
    assert settings == {"split": [1e-3, 1e-6, 1e-9], "rk4_with_events": [500, 4000]}


@pytest.mark.parametrize("method", METHODS)
def test_a_point_that_stands_for_some_cells_is_hollow(tmp_path, method):
    runs = [(method, 1e-3, [1e-4, 1e-4, NAN], [1e-6] * 3, ["done", "done", "failed"]),
            (method, 1e-6, [1e-7] * 3, [2e-6] * 3, DONE)]
    ax = drawn(write_work_precision(tmp_path / "a.h5", runs), work_precision.draw, tmp_path).axes[0]
    faces = {float(line.get_xdata()[0]): line.get_markerfacecolor() for line in ax.lines if len(line.get_xdata()) == 1}
    assert faces == {1.0: "white", 2.0: methods.look(method).colour}
    assert methods.look(method).marker not in "x+.,|_1234", "a marker without an inside cannot be hollow"


def test_methods_have_their_own_colour_and_marker():
    looks = [methods.look(name) for name in METHODS]
    assert len({look.marker for look in looks}) == len(METHODS), "in grey the marker tells"
    for first, second in combinations(looks, 2):
        assert difference(normal_sight(first.colour), normal_sight(second.colour)) > 12, (first, second)
        assert difference(deuteranope_sight(first.colour), deuteranope_sight(second.colour)) > 9, (first, second)
    assert methods.look("new_method").name == "new method"


def test_labels_shares_and_times(tmp_path):
    runs = [("exact", 0, 0.0, 0.01, 2e-5), ("cvode_adams", 1e-3, 0.125, 0.0, 1e-3), ("split", 1e-3, NAN, NAN, NAN)]
    figure = drawn(write_labels(tmp_path / "a.h5", runs, cells=1000), labels.draw, tmp_path)
    changed, unproved = figure.axes[:2]
    assert first_points(changed) == {(0.02, 0.0), (1.0, 12.5)}
    assert first_points(unproved) == {(0.02, 1.0), (1.0, 0.0)}
    assert changed.get_ylim()[0] < 0 < 12.5 < changed.get_ylim()[1]
    assert "incomplete: 66.6 % computed" in figure._suptitle.get_text() and "1000 cells" in figure._suptitle.get_text()


@pytest.mark.parametrize("share", [0.0, 0.004, 1.0])
def test_shares_have_a_scale_whatever_they_are(tmp_path, share):
    runs = [("exact", 0, share, share, 2e-5)]
    ax = drawn(write_labels(tmp_path / "a.h5", runs, cells=576), labels.draw, tmp_path).axes[0]
    low, high = ax.get_ylim()
    ticks = [tick for tick in ax.get_yticks() if low <= tick <= high]
    assert ticks[0] == 0 and len(ticks) >= 3 and ticks[-1] <= 100


def test_squares_have_the_colour_and_the_mark_of_their_outcome(tmp_path):
    figure = drawn(write_stability(tmp_path / "a.h5"), stability.draw, tmp_path)
    marks = squares_of(figure)
    names = dict(zip("aswn", stability.OUTCOMES))
    for row, letters in enumerate(SCENES.values()):
        for column, letter in enumerate(letters):
            outcome = stability.OUTCOMES[names[letter]]
            assert grey_at(figure, tmp_path / "a.png", column + 0.1, row + 0.2) == outcome.colour.upper()
            if letter != "s":
                assert marks[row, column] == outcome.mark
    assert marks[1, 2] == "not finite" and marks[3, 0] == "not finite" and marks[3, 2] == "budget"
    assert [label.get_text() for label in figure.axes[0].get_xticklabels()] == ENGINES
    assert figure.axes[0].get_yticklabels()[4].get_text() == "gap at rounding out of reach"


def test_texts_stay_in_their_squares(tmp_path):
    figure = drawn(write_stability(tmp_path / "a.h5", {"a": "ssss", "b": "ssss"}), stability.draw, tmp_path)
    ax = figure.axes[0]
    for text in ax.texts:
        box = text.get_window_extent().transformed(ax.transData.inverted())
        column = int(text.get_position()[0])
        assert column < box.x0 and box.x1 < column + 1, text.get_text()


def test_outcomes_differ_in_grey():
    light = sorted(lightness(outcome.colour) for outcome in stability.OUTCOMES.values())
    assert light[1] - light[0] > 30, "wrong is far darker than all the others"
    assert len({outcome.mark for outcome in stability.OUTCOMES.values()}) == len(stability.OUTCOMES)


def test_what_is_not_computed_is_open(tmp_path):
    figure = drawn(write_stability(tmp_path / "a.h5", {"a": "a-aa", "b": "aaaa"}), stability.draw, tmp_path)
    assert (0, 1) not in squares_of(figure)
    assert "incomplete: 87.5 % computed" in figure._suptitle.get_text()
    assert "not computed yet" in [text.get_text() for text in figure.axes[-1].get_legend().get_texts()]


def test_the_slope_of_the_rigid_limit(tmp_path):
    figure = drawn(write_stability(tmp_path / "a.h5", slope=-0.47), stability.draw, tmp_path)
    assert texts_of(figure.axes[2]) == ["slope −0.470\nin theory −0.5"]
    assert stability.fitted_slope(np.array([1.0, 10, 100]), np.array([0, 2.0, NAN])) is None
    bent = stability.fitted_slope(np.array([1.0, 10, 100, 1000]), np.array([50.0, 9.0, -1.0, -0.1]))
    assert bent == pytest.approx((-1, np.log(100))), "soft stops are not in the limit yet"
    figure = drawn(write_stability(tmp_path / "b.h5", rungs=1), stability.draw, tmp_path)
    assert texts_of(figure.axes[2]) == ["not measured"]


@pytest.mark.parametrize("word, name", [
    ("frequency_0_01", "frequency 0.01"), ("stiffness_1e2", "stiffness 1e2"), ("gap_0_grazing", "gap 0 grazing"),
])
def test_names_of_scenes(word, name):
    assert stability.scene_name(word) == name


def test_draw_gives_a_picture_of_each_topic(tmp_path, draw):
    outcome = draw(write_work_precision(tmp_path / "a.h5"), write_labels(tmp_path / "b.h5"),
                   write_stability(tmp_path / "c.h5"))
    assert (outcome.code, outcome.stderr) == (0, "")
    assert outcome.pictures == [f"{name}.{suffix}" for name in ("a_work_precision", "b_labels", "c_stability")
                                for suffix in ("pdf", "png")]


def changed(path, name, change):
    with SealedFile(path, "r+") as file:
        change(file, name)
    return path


def drop(file, name):
    del file[name]


def misshape(file, name):
    kind = file[name].dtype
    del file[name]
    file[name] = np.zeros((2, 3, 4), dtype=kind)


def retype(file, name):
    values = np.asarray(file[name]).astype("S3")
    del file[name]
    file[name] = values


def unname(file, name):
    del file[name].attrs["flag_meanings"]


def misname(file, name):
    file[name].attrs["flag_meanings"] = "one two"


def inject(file, name):
    words = file[name].attrs["flag_meanings"].split()
    file[name].attrs["flag_meanings"] = " ".join(["$x|<b>", *words[1:]])


@pytest.mark.parametrize("write, name, change, reason", [
    (write_work_precision, "error_peak_force", drop, "no dataset error_peak_force"),
    (write_work_precision, "method", misshape, "method of shape (2, 3, 4)"),
    (write_work_precision, "outcome", misshape, "outcome of shape (2, 3, 4)"),
    (write_work_precision, "run/seconds_per_cycle", retype, "of type |S"),
    (write_work_precision, "method", unname, "doesn't say what the numbers of method mean"),
    (write_work_precision, "outcome", misname, "doesn't say what the numbers of outcome mean"),
    (write_labels, "changed_share", misshape, "changed_share of shape"),
    (write_labels, "cells", retype, "cells of type"),
    (write_labels, "run", drop, "no dataset run/seconds_per_cell"),
    (write_stability, "scene", inject, "has '$x|<b>' among the meanings of scene"),
    (write_stability, "engine", misshape, "engine of shape"),
    (write_stability, "status", retype, "status of type"),
])
def test_a_bad_study_is_refused_in_one_line(tmp_path, draw, write, name, change, reason):
    outcome = draw(changed(write(tmp_path / "bad.h5"), name, change))
    assert outcome.code == 2 and reason in outcome.stderr
    assert outcome.stderr.count("\n") == 1 and outcome.pictures == []


def test_a_study_of_something_else_is_refused(tmp_path, draw):
    assert "is a study of 'beauty'" in draw(write_labels(tmp_path / "a.h5", topic="beauty")).stderr


def test_the_table_of_work_and_precision(tmp_path):
    runs = [
        ("exact", 0, [1e-13] * 3, [1e-6] * 3, DONE),
        ("cvode_adams", 1e-3, [5e-4] * 3, [50e-6] * 3, DONE),
        ("cvode_adams", 1e-8, [5e-9, 6e-9, 7e-8], [200e-6] * 3, ["done", "done", "other_orbit"]),
    ]
    with StudyFile(write_work_precision(tmp_path / "a.h5", runs)) as file:
        *_, exact, adams = study_words.work_precision_table(file.table).splitlines()
    assert exact == "| closed form (exact) | 10<sup>−13</sup> (10<sup>−13</sup>) | 1 | 1 | 1 | 1 | 1 | 0 |"
    assert adams == "| CVODE Adams | 5·10<sup>−9</sup> (6·10<sup>−9</sup>) | 200 | 50 | 200 | – | – | 17 % |"


def test_the_list_of_scenes_in_which_engines_break(tmp_path):
    with StudyFile(write_stability(tmp_path / "a.h5")) as file:
        lines = study_words.where_engines_break(file.table).splitlines()
        table = study_words.stability_table(file.table).splitlines()
    assert lines[0] == "- exact: numbers grew out of range (conservative)"
    assert lines[3] == "- arkode: **wrong** (stiffness 1e15); nothing dissipates (conservative)"
    assert table[2].startswith("| exact | 5 | 1 | 0 | 1 | ")
