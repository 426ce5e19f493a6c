"""Pictures of curves: each kind by its line style, special points by letters, p/q at the curves, in the right place."""

import itertools

import matplotlib.pyplot as plt
import numpy as np
import pytest
from curves_samples import LINES, write_curves, write_distances
from peterka.export.formats import export
from peterka.cli.picture_options import zoomed
from peterka.errors import PeterkaFileError
from peterka.plotting import axes, style
from peterka.maps import curves_map, edge_distance_map
from peterka.maps.curves_file import CurvesFile
from peterka.maps.curves_over import read_lines
from peterka.pictures import open_file, pictures_of
from picture_samples import PLAIN, write_map
from sealing import SealedFile

pytestmark = pytest.mark.thorough


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


def test_the_legend_says_what_several_letters_are(tmp_path):
    """A fold with grazing and a cusp so near to each other that they share their letters."""
    specials = [(0, 2.5, 2.5), (3, 2.52, 2.5)]
    figure = drawn(write_curves(tmp_path / "c.h5", specials=specials), curves_map.draw, tmp_path)
    titles = [ax.get_legend().get_title().get_text() for ax in figure.axes if ax.get_legend()]
    assert "FC" in [text.get_text() for text in figure.axes[0].texts] and titles[-1] == "special points (several letters: several together)"


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


def test_the_picture_over_the_map_says_what_its_colours_are(tmp_path):
    path = write_curves(tmp_path / "c.h5")
    over, alone = (legend_words(drawn(path, picture, tmp_path)) for picture in (curves_map.draw_over_map, curves_map.draw))
    assert {word.split(" (")[0] for word in over} - set(alone) >= {"1/1", "no impact", "chaotic"}
    assert over[-len(alone):] == alone


def test_special_points_that_lie_together_have_their_letters_once(tmp_path):
    crowd = [(0, 3.0, 2.8), (0, 3.0, 2.8), (0, 3.002, 2.8), (3, 3.06, 2.82), (1, 1.9, 0.6)]
    figure = drawn(write_curves(tmp_path / "c.h5", specials=crowd), curves_map.draw, tmp_path)
    letters = [text for text in figure.axes[0].texts if set(text.get_text()) <= set("FPGCI")]
    assert sorted(text.get_text() for text in letters) == ["FC", "P"]
    dots = [line for line in figure.axes[0].lines if line.get_marker() == "."]
    assert len(dots) == 3  # points closer than a dot's width share one


def test_each_letter_of_the_legend_is_in_the_picture(tmp_path):
    """Also where a name leaves no room beside its point, as that of 1/1 at (2, 1.5), in a crowd, and in the corner."""
    crowd = [(4, 2.0, 1.5)] + [(kind, 2.0 + 0.25 * (number % 4), 1.8 + 0.25 * (number // 4))
                               for number, kind in enumerate([0, 1, 2, 0, 1, 2, 0, 2, 1, 0, 2, 1, 0, 1])] + [(0, 4.45, 3.45)]
    for width in (None, 84):
        with CurvesFile(write_curves(tmp_path / "c.h5", specials=crowd)) as file, style.using(width=width):
            ax = curves_map.draw(file)
            axes.save(axes.figure_of(ax), tmp_path / "a.png")
        letters = [text.get_text() for text in ax.texts if set(text.get_text()) <= set("FPGCI")]
        assert set("".join(letters)) == set("FPGI") and "I" in letters
        for text in ax.texts:
            assert ax.get_window_extent().contains(*text.get_window_extent().min)
            assert ax.get_window_extent().contains(*text.get_window_extent().max)


CROWD = [(kind, 2.0 + 0.3 * (number % 4), 1.2 + 0.3 * (number // 4)) for number, kind in enumerate([0, 1, 2, 3] * 3)]
NEAR_LETTERS = 9  # pt: letters farther from their own dot have a line to it


@pytest.mark.parametrize("picture", [curves_map.draw, curves_map.draw_over_map])
def test_letters_are_beside_their_dots_and_over_nothing(tmp_path, picture):
    with CurvesFile(write_curves(tmp_path / "c.h5", specials=[*CROWD, (0, 4.0, 3.0), (1, 1.0, 0.0)])) as file, style.using(width=84):
        ax = picture(file)
        axes.save(axes.figure_of(ax), tmp_path / "a.png")
    dots = ax.transData.transform([line.get_xydata()[0] for line in ax.lines if line.get_marker() == "."])
    leaders = [ax.transData.transform(line.get_xydata()) for line in ax.lines if line.get_linewidth() == 0.6]
    boxes = {text: text.get_window_extent() for text in ax.texts}
    letters = [box for text, box in boxes.items() if set(text.get_text()) <= set("FPGCI")]
    assert len(letters) == 14
    for box in letters:
        assert ax.bbox.x0 < box.x0 and box.x1 < ax.bbox.x1 and ax.bbox.y0 < box.y0 and box.y1 < ax.bbox.y1
        away = np.min(np.hypot(*(dots - np.clip(dots, box.min, box.max)).T)) * 72 / axes.figure_of(ax).dpi
        ends = [end for line in leaders for end in line if np.all((end >= box.min - 2) & (end <= box.max + 2))]
        assert away <= NEAR_LETTERS + 1 or ends
        assert not np.any(np.all((dots > box.min) & (dots < box.max), axis=1))
    for first, second in itertools.combinations(boxes.values(), 2):
        assert not first.overlaps(second)


def test_a_motion_without_impact_is_named_so(tmp_path):
    figure = drawn(write_curves(tmp_path / "c.h5", [*LINES[:2], (2, 0, 1, LINES[2][3])]), curves_map.draw, tmp_path)
    words = {text.get_text() for text in figure.axes[0].texts}
    assert "no impact" in words and "0/1" not in words


def test_letters_look_in_the_legend_as_in_the_picture(tmp_path):
    """Upright and bold, without an edge that would fill a narrow one."""
    figure = drawn(write_curves(tmp_path / "c.h5", specials=[(4, 2.5, 2.5)]), curves_map.draw, tmp_path)
    legend = next(ax.get_legend() for ax in figure.axes if ax.get_legend() and ax.get_legend().get_title().get_text())
    handles = legend.legendHandles if hasattr(legend, "legendHandles") else legend.legend_handles  # before matplotlib 3.7, and since
    assert [(handle.get_marker(), handle.get_markeredgewidth()) for handle in handles] == [(r"$\mathbf{I}$", 0)]


def test_a_file_without_curves_gives_no_picture(tmp_path):
    assert drawn(write_curves(tmp_path / "c.h5", [], []), curves_map.draw, tmp_path) is None


def test_the_program_of_pictures_knows_the_kind(tmp_path):
    with open_file(write_curves(tmp_path / "c.h5")) as file:
        assert list(pictures_of(file)) == ["curves", "curves_over_map"]


@pytest.mark.parametrize("line", [(3, 1, 1, [(1.0, 1.0)]), (0, -1, 1, [(1.0, 1.0)]), (0, 1, 0, [(1.0, 1.0)]),
                                  (0, 1, 1, [(np.nan, 1.0)])])
def test_a_curve_that_cannot_be_is_refused(tmp_path, line):
    with pytest.raises(PeterkaFileError):
        CurvesFile(write_curves(tmp_path / "c.h5", [*LINES, line]))


SOUND = (0.5, 1, 1, [(1.5, 20.0, 0.4), (1.6, 21.0, 0.3)])


@pytest.mark.parametrize("branch", [(0.5, 1, 1, []), (np.nan, 1, 1, SOUND[3]), (0.5, 1, 1, [(np.inf, 20.0, 0.4)])],
                         ids=["no point", "no gap", "no place"])
def test_unstable_orbits_that_cannot_be_are_refused(tmp_path, branch):
    with CurvesFile(write_curves(tmp_path / "sound.h5", branches=[SOUND])) as file:
        assert file.unstable_branches[0].force.tolist() == [20.0, 21.0]
    with pytest.raises(PeterkaFileError, match="has a branch of no place"):
        CurvesFile(write_curves(tmp_path / "c.h5", branches=[SOUND, branch]))


@pytest.mark.parametrize("side, unit, drift", [("frequency_ratio", "Hz", 0.4), ("gap_ratio", "mm", 0.1)])
def test_distances_to_the_edge_are_drawn_in_units(tmp_path, side, unit, drift):
    path, kinds = write_distances(tmp_path / "c.h5")
    figure = drawn(path, lambda file: edge_distance_map.draw(file, side=side), tmp_path)
    values = figure.axes[0].collections[-1].get_array().reshape(kinds.shape)
    assert np.allclose(values[kinds == 0], drift) and np.ma.getmaskarray(values)[kinds != 0].all()
    assert unit in figure.axes[1].get_xlabel()
    assert legend_words(figure) == ["no edge within the window", "could not be followed to one",
                                    "chaotic, unresolved, or q above curves.max_period"]


def test_distances_have_pictures_where_the_file_has_them(tmp_path):
    with open_file(write_distances(tmp_path / "c.h5")[0]) as file:
        assert {"edge_distance_frequency", "edge_distance_gap"} <= set(pictures_of(file))
    with open_file(write_curves(tmp_path / "d.h5")) as file:
        assert not any("edge_distance" in name for name in pictures_of(file))


def test_distances_are_exported_in_hertz_and_millimetres(tmp_path):
    path, kinds = write_distances(tmp_path / "c.h5")
    with open_file(path) as file:
        table = next(iter(export(file, tmp_path, ["csv"]))).read_text(encoding="utf-8").splitlines()
    rows = [dict(zip(table[0].split(","), row.split(","))) for row in table[1:]]
    known = [row for row in rows if row["edge_kind_gap_ratio"] == "0"]
    assert len(known) == (kinds == 0).sum()
    assert {row["edge_distance_frequency_hz"] for row in known} == {"-0.4"}
    assert {row["edge_distance_gap_mm"] for row in known} == {"-0.1"}


JOB = """
schema = 1
hammer = { mass_kg = 0.298, natural_frequency_hz = 4.0, damping_ns_per_m = 0.06 }
cart = { amplitude_m = 1e-3 }
contact = { law = "kelvin_voigt", stiffness_n_per_m = 5.5e6, damping_ns_per_m = 1.2e3 }
axes = { %s = { from = 1, to = 4, points = 4 }, %s = { from = 0, to = 3, points = 4 } }
"""
OF_RIG = {"cart_amplitude_m": 1e-3, "natural_frequency_hz": 4.0}


def in_si(path):
    """Brings the axes of a map to Hz and m."""
    with SealedFile(path, "r+") as file:
        for ratio, unit, twin in (("frequency_ratio", 4.0, "frequency_hz"), ("gap_ratio", 1e-3, "gap_m")):
            file[ratio][...] *= unit
            file.move(ratio, twin)
    return path


@pytest.mark.parametrize("unit", ["ratio", "si"])
@pytest.mark.parametrize("ends, kinds, words, specials", [
    ((1.4, 2.6, 0.4, 2.6), ["fold", "grazing"], {"1/1", "3/2", "F", "C"}, 2),
    ((1.6, 3.4, 0.6, 2.4), ["fold", "period_doubling", "grazing"], {"1/1", "1/2"}, 0),
    ((2.6, 4.4, 0.6, 3.4), ["period_doubling", "grazing"], {"1/2"}, 0)])
def test_a_part_is_shown_of_curves_in_either_unit(tmp_path, ends, kinds, words, specials, unit):
    path = write_curves(tmp_path / "a.h5", **OF_RIG)
    factors = (4.0, 4.0, 1.0, 1.0) if unit == "si" else (1.0,) * 4
    with open_file(path) as whole:
        part = zoomed(whole, tuple(end * factor for end, factor in zip(ends, factors)), unit == "si")
        assert [curve.kind for curve in part.curves] == kinds and len(part.specials) == specials
        for name in ("curves", "curves_over_map"):
            ax = pictures_of(part)[name](part)
            assert ax.get_xlim() == pytest.approx(ends[:2]) and ax.get_ylim() == pytest.approx(ends[2:])
            assert {text.get_text() for text in ax.texts} >= words
            plt.close(ax.figure)


def test_a_curve_that_leaves_the_window_and_comes_back_has_two_parts(tmp_path):
    bow = [(0, 1, 1, [(1.5, 1.0), (1.6, 1.6), (1.8, 2.6), (2.2, 2.6), (2.4, 1.6), (2.5, 1.0)])]
    with open_file(write_curves(tmp_path / "a.h5", bow, specials=[], **OF_RIG)) as whole:
        part = zoomed(whole, (1.0, 4.0, 0.5, 2.0), False)
        assert [curve.rows.tolist() for curve in part.curves] == [[1.0, 1.6, 2.6], [2.6, 1.6, 1.0]]
        assert [rows.tolist() for rows in part.along_curves("point_gap_ratio")] == [[1.0, 1.6, 2.6], [2.6, 1.6, 1.0]]


@pytest.mark.parametrize("unit", ["ratio", "si"])
def test_curves_lie_over_a_map_of_the_same_rig_in_either_unit(tmp_path, run_program, unit):
    curves = write_curves(tmp_path / "curves.h5", job=JOB % ("frequency_ratio", "gap_ratio"), **OF_RIG)
    names = ("frequency_hz", "gap_m") if unit == "si" else ("frequency_ratio", "gap_ratio")
    path = write_map(tmp_path / "map.h5", PLAIN, job=JOB % names, **OF_RIG)
    if unit == "si":
        in_si(path)
    with open_file(path) as file:
        lines = read_lines(curves, file)
        ax = pictures_of(file, curves=lines)["curves_over_map"](file)
        drawn = [line.get_xydata() for line in ax.lines if len(line.get_xydata()) == 3]
        assert [line.tolist() for line in drawn] == [[list(map(float, point)) for point in points] for *_, points in LINES]
        assert "curves_over_map" not in pictures_of(file)
        plt.close(ax.figure)
    code, _, err = run_program("draw", path, "--curves", curves, "--only", "curves_over_map", "--output-dir", tmp_path)
    assert code == 0 and (tmp_path / "map_curves_over_map.png").exists(), err


@pytest.mark.parametrize("old, new, reason", [
    ("mass_kg = 0.298", "mass_kg = 0.3", "another rig or operating point than %s: hammer.mass_kg differs"),
    ("axes = { frequency_ratio", "axes = { contact.damping_ns_per_m", "is a map over frequency and gap"),
])
def test_curves_of_another_rig_or_plane_lie_over_no_map(tmp_path, run_program, old, new, reason):
    job = JOB % ("frequency_ratio", "gap_ratio")
    curves = write_curves(tmp_path / "curves.h5", job=job.replace(old, new), **OF_RIG)
    if "axes" in old:
        with SealedFile(curves, "r+") as file:
            file.move("frequency_ratio", "contact_damping_ns_per_m")
            for name in ("point", "special"):
                file.move(f"{name}_frequency_ratio", f"{name}_contact_damping_ns_per_m")
    path = write_map(tmp_path / "map.h5", PLAIN, job=job, **OF_RIG)
    code, _, err = run_program("draw", path, "--curves", curves, "--output-dir", tmp_path)
    assert code == 2 and reason.replace("%s", str(path)) in err and err.count("\n") == 1, err


def test_no_name_lies_over_another_curve(tmp_path):
    """Two curves that cross in the middle of the first: its name moves aside; one with another along all of it has none."""
    lines = [(0, 1, 1, [(1.2, 0.5), (2.5, 1.5), (3.8, 2.5)]), (1, 1, 2, [(1.9, 2.6), (2.5, 1.5), (3.1, 0.4)]),
             (2, 3, 2, [(1.2, 2.0), (2.0, 2.8)]), (2, 4, 2, [(1.22, 2.0), (2.02, 2.8)])]
    with CurvesFile(write_curves(tmp_path / "a.h5", lines, [])) as file:
        for over in (curves_map.draw, curves_map.draw_over_map):
            ax = over(file)
            ax.figure.draw_without_rendering()
            ways = {f"{p}/{q}": curves_map._dense(ax.transData.transform(np.array(points))) for _, p, q, points in lines}
            boxes = {text.get_text(): text.get_window_extent() for text in ax.texts if text.get_text() in ways}
            assert {"1/1", "1/2"} <= boxes.keys() and not {"3/2", "4/2"} & boxes.keys()
            for name, box in boxes.items():
                assert box.count_contains(ways[name]) > 0
                assert all(box.count_contains(way) == 0 for other, way in ways.items() if other != name), name


def test_a_file_without_a_curve_shows_the_coarse_map_and_says_so(tmp_path, draw):
    path = write_curves(tmp_path / "c.h5", lines=[], specials=[])
    assert draw(path, "--formats", "png").pictures == ["c_curves_over_map.png"]
    figure = drawn(path, curves_map.draw_over_map, tmp_path)
    assert figure._suptitle.get_text().endswith("where regimes end: no curve was found")
