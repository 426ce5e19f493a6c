"""Borders from curves over the pictures of a sweep: those met by its motions, in their place, listed in Hz."""

import re

import h5py
import pytest
from curves_samples import write_curves
from peterka.errors import PeterkaFileError
from peterka.plotting import style
from peterka.plotting.figures import figure_of
from peterka.maps.curves_map import COLOURS
from peterka.sweeps import bifurcation, borders, response, unstable
from peterka.sweeps.sweep_file import SweepFile
from sealing import seal_file
from sweep_samples import write_sweep

JOB = """
hammer = { mass_kg = 0.298 }
cart = { amplitude_m = 0.89e-3 }
contact = { law = "restitution", coefficient = 0.5 }
"""
LINES = [(0, 1, 1, [(1.5, 1.0), (2.0, 2.0)]), (1, 1, 1, [(1.0, 0.0), (1.5, 2.0)]), (2, 0, 1, [(1.4, 1.0), (1.6, 2.0)]),
         (0, 1, 3, [(1.7, 1.0), (1.8, 2.0)])]
FOLD, DOUBLING, GRAZING = (0, 1.7612345678, 1.5), (1, 1.37, 1.5), (2, 1.53, 1.5)
CROSSINGS = [FOLD, DOUBLING, GRAZING, (3, 1.75, 1.5), (0, 2.3, 1.5), (0, 1.75, 1.0)]  # then: of no motion there, of no gap


@pytest.fixture
def files(tmp_path):
    return (write_sweep(tmp_path / "sweep.h5", job=JOB),
            write_curves(tmp_path / "curves.h5", LINES, [], CROSSINGS, job=JOB))


@pytest.mark.parametrize("draw", [response.draw, bifurcation.draw])
def test_each_border_is_a_line_in_the_panel_of_its_gap(files, draw):
    with SweepFile(files[0]) as sweep:
        found = borders.read_borders(files[1], sweep)
        bare, drawn = (figure_of(draw(sweep, borders=some)) for some in ([], found))
    def upright(figure):
        return [{(line.get_xdata()[0], line.get_color()) for line in ax.lines if len(line.get_xdata()) == 2
                 and line.get_xdata()[0] == line.get_xdata()[1] and list(line.get_ydata()) == [0, 1]} for ax in figure.axes[:2]]
    assert upright(bare) == [set(), set()]
    assert upright(drawn) == [set(), {(1.37, COLOURS["period_doubling"]), (1.53, COLOURS["grazing"]),
                                      (1.7612345678, COLOURS["fold"])}]
    words = [text.get_text() for ax in drawn.axes if ax.get_legend() for text in ax.get_legend().get_texts()]
    assert {"fold", "period doubling", "grazing"} <= set(words)


def test_borders_are_listed_in_hertz_to_nine_digits_and_millimetres(files):
    with SweepFile(files[0]) as sweep:
        lines = borders.table(sweep, borders.read_borders(files[1], sweep))
    assert [re.split(r"\s{2,}", line.strip()) for line in lines[1:]] == [
        ["6.16500000", "1.335", "1/1", "period doubling"], ["6.88500000", "1.335", "no impact", "grazing"], ["7.92555556", "1.335", "1/1", "fold"]]


def test_a_curve_that_meets_a_gap_twice_up_to_rounding_is_one_border(files, tmp_path):
    """As at gap 0 where a curve begins there."""
    twice = [*CROSSINGS, *((number, place * (1 + 1e-13), gap) for number, place, gap in CROSSINGS)]
    other = write_curves(tmp_path / "other.h5", LINES, [], twice, job=JOB)
    with SweepFile(files[0]) as sweep:
        once, both = (borders.read_borders(path, sweep) for path in (files[1], other))
    assert len(both) == len(once) == 3


def test_borders_are_listed_in_millimetres_where_pictures_are_in_si_alone(files):
    with SweepFile(files[0]) as sweep, style.using(units="si"):
        lines = borders.table(sweep, borders.read_borders(files[1], sweep))
    assert "gap [mm]" in lines[0] and "A0" not in lines[0]
    assert [line.split()[1] for line in lines[1:]] == ["1.335"] * 3


def test_draw_tells_and_draws_them(files, tmp_path, run_program):
    code, stdout, stderr = run_program("draw", files[0], "--curves", files[1], "--output-dir", tmp_path / "out", "--only",
                                       "response")
    assert code == 0 and "7.92555556" in stdout and (tmp_path / "out" / "sweep_response.png").exists(), stderr


@pytest.mark.parametrize("lines, crossings, job, words", [
    (LINES, CROSSINGS, JOB.replace("0.5", "0.6"), "another rig than .*sweep.h5: contact.coefficient differs"), (LINES, [], JOB, r"gap_ratio = \[0, 1.5\]"),
    (LINES, CROSSINGS, "nonsense", "no job")])
def test_curves_that_tell_nothing_of_the_sweep_are_refused(files, tmp_path, lines, crossings, job, words):
    other = write_curves(tmp_path / "other.h5", lines, [], crossings, job=job)
    with SweepFile(files[0]) as sweep, pytest.raises(PeterkaFileError, match=words):
        borders.read_borders(other, sweep)


def test_gaps_to_compute_are_named_as_the_sweep_names_them(tmp_path):
    with h5py.File(write_sweep(tmp_path / "sweep.h5", job=JOB), "r+") as file:
        file["gap_m"] = file["gap_ratio"][()] * 0.89e-3
        del file["gap_ratio"]
    seal_file(tmp_path / "sweep.h5")
    other = write_curves(tmp_path / "other.h5", LINES, [], [], job=JOB)
    with SweepFile(tmp_path / "sweep.h5") as sweep, pytest.raises(PeterkaFileError, match=r"gap_m = \[0, 0.001335\]"):
        borders.read_borders(other, sweep)


def test_a_map_has_no_borders(files):
    class Map:
        kind, axis_name, path = "map", "frequency_ratio", "a.h5"
    with pytest.raises(PeterkaFileError, match="is no sweep but a map; borders are drawn over a sweep of frequencies"):
        borders.read_borders(files[1], Map)


BRANCHES = [(1.5, 1, 1, [(1.7612345678, 5.0, 0.5), (1.65, 4.0, 0.3), (1.6, 3.0, 0.2)]),
            (1.5, 2, 2, [(1.6, 3.0, 0.9, 0.2), (1.62, 2.5, 0.1, 0.8)]),  # continues the previous one
            (1.5, 1, 1, [(2.3, 5.0, 0.5), (2.2, 4.0, 0.4)]),  # from a fold of no motion of the sweep
            (1.0, 1, 1, [(1.75, 5.0, 0.5), (1.7, 4.0, 0.4)])]  # at another gap


def thin_lines(ax):
    return {tuple(zip(line.get_xdata(), line.get_ydata())) for line in ax.lines if line.get_color() == unstable.LOOK["color"]}


def test_unstable_orbits_join_the_borders_that_a_sweep_meets(tmp_path, files):
    path = write_curves(tmp_path / "with_branches.h5", LINES, [], CROSSINGS, BRANCHES, job=JOB)
    with SweepFile(files[0]) as sweep:
        found = unstable.read_unstable(path, sweep, borders.read_borders(path, sweep))
        forces, heights, bare = (figure_of(draw(sweep, unstable=some)) for draw, some in (
            (response.draw, found), (bifurcation.draw, found), (response.draw, [])))
    assert [branch.period for branch in found] == [1, 2]
    assert thin_lines(bare.axes[1]) == set() == thin_lines(forces.axes[0])
    assert thin_lines(forces.axes[1]) == {((1.7612345678, 5.0), (1.65, 4.0), (1.6, 3.0)), ((1.6, 3.0), (1.62, 2.5))}
    assert thin_lines(heights.axes[1]) == {((1.7612345678, 0.5), (1.65, 0.3), (1.6, 0.2)), ((1.6, 0.2), (1.62, 0.1)),
                                           ((1.6, 0.9), (1.62, 0.8))}
    words = [text.get_text() for ax in forces.axes if ax.get_legend() for text in ax.get_legend().get_texts()]
    assert "unstable" in words
