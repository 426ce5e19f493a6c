"""Pictures of sweeps of one point and over logarithmic axes, places on axes without a ratio, and gaps of which curves are missing."""

import warnings

import numpy as np
import pytest
from curves_samples import write_curves
from peterka.plotting.figures import figure_of
from peterka.sweeps import bifurcation, borders, response, uncertain_response
from peterka.sweeps.sweep_file import SweepFile
from peterka.sweeps.sweep_panels import LOOKS
from sealing import SealedFile
from sweep_samples import POINTS, WEIGHT, write_sweep
from test_sweep_borders import CROSSINGS, JOB, LINES
from uncertain_samples import write_uncertain_sweep

STIFFNESS = "contact_stiffness_n_per_m"


def at_point(path, point):
    """The same sweep with one of its points alone."""
    with SealedFile(path, "r+") as file:
        for name in [name for name in file if POINTS in getattr(file[name], "shape", ())]:
            values = file[name][()]
            del file[name]
            file[name] = np.take(values, [point], axis=values.shape.index(POINTS))
    return path


def over_stiffness(path, low=1e2, high=1e10):
    """The same sweep over stiffnesses of the stop, evenly spaced in the logarithm."""
    write_sweep(path, job="[axes.contact.stiffness_n_per_m]\nfrom = 1.0\n")
    with SealedFile(path, "r+") as file:
        del file["frequency_ratio"]
        file[STIFFNESS] = np.geomspace(low, high, POINTS)
    return path


def texts(ax):
    return [text.get_text() for text in ax.texts if text.get_text()]


@pytest.mark.parametrize("draw", [response.draw, bifurcation.draw])
def test_one_point_is_drawn_in_a_cell_without_a_warning(tmp_path, draw):
    with SweepFile(at_point(write_sweep(tmp_path / "a.h5"), 8)) as file, warnings.catch_warnings():
        warnings.simplefilter("error")
        figure = figure_of(draw(file))
        figure.canvas.draw()
    assert figure.axes[0].get_xlim() == pytest.approx((1.9, 2.1))


def test_the_force_of_one_point_is_a_line_across_its_cell(tmp_path):
    with SweepFile(at_point(write_sweep(tmp_path / "a.h5"), 8)) as file:
        ax = figure_of(response.draw(file)).axes[0]
    lines = [line for line in ax.lines if line.get_color() == LOOKS["up"].colour and len(line.get_xdata()) == 2]
    assert [line.get_xydata().tolist() for line in lines if line.get_linestyle() == "-" and line.get_linewidth() > 1] == [
        [[1.9, 40], [2.1, 40]]]


def test_the_band_of_one_point_goes_across_its_cell(tmp_path):
    with SweepFile(at_point(write_uncertain_sweep(tmp_path / "a.h5"), 8)) as file:
        ax = figure_of(uncertain_response.draw(file)).axes[0]
    corners = ax.collections[0].get_paths()[0].vertices
    assert (corners.min(axis=0), corners.max(axis=0)) == (pytest.approx([1.9, 32]), pytest.approx([2.1, 48]))


def test_curves_meet_a_sweep_of_one_point_where_it_lies(tmp_path):
    sweep = at_point(write_sweep(tmp_path / "sweep.h5", job=JOB), 6)
    curves = write_curves(tmp_path / "curves.h5", LINES, [], [(0, 1.75, 1.5), (0, 1.76, 1.5)], job=JOB)
    with SweepFile(sweep) as file:
        assert [border.frequency_ratio for border in borders.read_borders(curves, file)] == [1.75]


def test_an_axis_that_is_evenly_spaced_in_the_logarithm_is_logarithmic(tmp_path):
    """Points stand at even distances, with their classes and notes above them."""
    with SweepFile(over_stiffness(tmp_path / "a.h5")) as file:
        figure = figure_of(response.draw(file))
        figure.canvas.draw()
    first, second = figure.axes[:2]
    assert [ax.get_xscale() for ax in (first, second)] == ["log", "log"] and first.get_xlim() == pytest.approx((1e2, 1e10))
    star, = (text for text in first.texts if text.get_text().startswith("★"))
    assert star.xy[0] == pytest.approx(8 / 12 + 0.004)
    strip = next(child for child in second.child_axes if len(child.patches) == 3)
    ends = [patch.get_window_extent().x1 for patch in strip.patches]
    box = strip.get_window_extent()
    assert [(end - box.x0) / box.width for end in ends] == pytest.approx([6.5 / 12, 10.5 / 12, 1], abs=1e-3)


def test_a_linear_axis_stays_linear(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        assert figure_of(response.draw(file)).axes[0].get_xscale() == "linear"


def test_places_on_an_axis_without_a_ratio_have_their_unit(tmp_path):
    """All are told: on the linear axis they would lie at one place."""
    with SweepFile(over_stiffness(tmp_path / "a.h5")) as file:
        first, second = figure_of(response.draw(file)).axes[:2]
    assert texts(first)[1:] == [f"★ 40 = {40 * WEIGHT:.4g} N at 2.154e+07 N/m"]
    notes = texts(second)[1:]
    assert len(notes) == 4 and all(note.endswith(" N/m") for note in notes)


@pytest.mark.parametrize("asked, told", [
    ("gap_ratio = [1.5]", True), ("gap_m = [1.335e-3]", True), ("gap_ratio = [0.0, 1.5]", False), ("gap_m = [0.0, 1.335e-3]", False)])
def test_gaps_of_which_a_file_has_no_curves_are_told(tmp_path, asked, told):
    curves = write_curves(tmp_path / "curves.h5", LINES, [], CROSSINGS, job=f"{JOB}curves = {{ {asked} }}\n")
    with SweepFile(write_sweep(tmp_path / "sweep.h5", job=JOB)) as file:
        last = borders.told(curves, file, borders.read_borders(curves, file))[-1]
    assert last.endswith("curves.h5 has no curves at gap 0 mm; compute it with [curves] gap_ratio = [0, 1.5]" if told else "fold")


def test_that_no_border_is_met_is_told_and_at_which_gaps_none_was_sought(tmp_path):
    far = [(0, 2.3, 1.5)]  # of 1/1, where the sweep has none
    curves = write_curves(tmp_path / "curves.h5", LINES, [], far, job=f"{JOB}curves = {{ gap_ratio = [1.5] }}\n")
    with SweepFile(write_sweep(tmp_path / "sweep.h5", job=JOB)) as file:
        met, lacking = borders.told(curves, file, borders.read_borders(curves, file))
    assert met.endswith("sweep.h5 meets a border at its gaps") and "no curves at gap 0 mm" in lacking


def test_why_a_rigid_stop_has_no_picture_of_forces_is_told(tmp_path, run_program):
    path = write_sweep(tmp_path / "rigid.h5")
    with SealedFile(path, "r+") as file:
        file["impacts"][...] = file["regime"][()] == 1
        file["peak_force_ratio"][...] = 0
    told = run_program("draw", path, "--output-dir", tmp_path)[1]
    assert "no value to draw (impacts have no peak force, as on a rigid stop; the field impact_speed has a picture), response is left out" in told
    assert (tmp_path / "rigid_bifurcation.png").exists()
