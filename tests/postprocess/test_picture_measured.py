"""Measured points from a CSV file: units, gaps, rigs, and one clear line for what is wrong with it."""

import matplotlib.collections
import matplotlib.text
import numpy as np
import peterka
import pytest
from conftest import POSTPROCESS
from peterka.measurements.points import read_measurements
from peterka.maps.map_file import PeterkaFile
from peterka.sweeps.residuals import residuals
from peterka.sweeps.sweep_file import SweepFile
from picture_texts import faults_of_layout
from picture_samples import write_basin, write_map
from sweep_samples import WEIGHT, write_sweep


def points(tmp_path, text, **sample):
    path = tmp_path / "points.csv"
    path.write_text(text)
    with SweepFile(write_sweep(tmp_path / "a.h5", **sample)) as file:
        return read_measurements(path, file)


def test_units_become_ratios(tmp_path):
    found = points(tmp_path, "frequency_hz,force_n,displacement_mm,gap_mm,label\n9.0,204,-1.78,1.335,one\n")
    (point,) = found.points
    assert point.frequency == pytest.approx(2.0) and point.force == pytest.approx(204 / WEIGHT)
    assert point.displacement == pytest.approx(-2.0) and point.gap == 1.5 and point.label == "one"
    assert found.at_gap(1.5) == [point] and found.at_gap(0.0) == [] and found.left_out == []


def test_ratios_stay_and_cells_may_be_empty(tmp_path):
    found = points(tmp_path, "# mine\nlabel, gap_ratio ,force_ratio,frequency_ratio\n\n,0,70.5,2\nedge,0,,2.5\n")
    assert [(point.frequency, point.force, point.label) for point in found.points] == [(2, 70.5, ""), (2.5, None, "edge")]


def test_points_of_one_gap_need_none(tmp_path):
    (point,) = points(tmp_path, "frequency_ratio\n2\n", gaps=(1.5,)).points
    assert point.gap is None


def test_points_of_other_rigs_and_gaps_are_left_out_and_told(tmp_path):
    found = points(tmp_path, "natural_frequency_hz,gap_ratio,frequency_ratio\n4.5,0,2\n5.25,0,2\n4.5,3.37,2\n")
    assert len(found.points) == 1
    assert "1 points of rigs with another natural frequency" in found.left_out[0]
    assert "1 points at gap/A0 3.37 are left out" in found.left_out[1]


def test_the_papers_numbers_lie_over_its_rig(tmp_path, draw):
    sweep = write_sweep(tmp_path / "a.h5")
    outcome = draw(sweep, "--measured", POSTPROCESS / "paper_measurements.csv", "--formats", "png")
    assert (outcome.code, outcome.stderr) == (0, "") and len(outcome.pictures) == 3
    with SweepFile(sweep) as file:
        found = read_measurements(POSTPROCESS / "paper_measurements.csv", file)
    assert [(point.frequency * 4.5, point.force * WEIGHT) for point in found.points if point.force] == [
        (pytest.approx(9.0), pytest.approx(204))]


@pytest.mark.parametrize("text, reason", [
    ("", "has no points"),
    ("frequency_hz\n", "has no points"),
    ("frequency_hz,colour\n1,red\n", "unknown column 'colour'"),
    ("frequency_hz,frequency_ratio\n9,2\n", "frequency_ratio and frequency_hz"),
    ("frequency_hz,gap_mm,gap_mm\n9,0,0\n", "gap_mm twice"),
    ("force_n,gap_mm\n9,0\n", "no column frequency_hz or frequency_ratio"),
    ("frequency_hz,gap_mm\n9,0,3\n", ":2 has 3 cells"),
    ("frequency_hz,gap_mm\n9,wide\n", ":2 has 'wide' as gap_mm"),
    ("frequency_hz,gap_mm\nnan,0\n", ":2 has 'nan' as frequency_hz"),
    ("# a\nfrequency_hz,gap_mm\n,0\n", ":3 has no frequency above 0"),
    ("frequency_hz\n9\n", ":2 has no gap, and the sweep has 2"),
])
def test_what_is_wrong_is_said_in_one_line(tmp_path, draw, text, reason):
    (tmp_path / "points.csv").write_text(text)
    outcome = draw(write_sweep(tmp_path / "a.h5"), "--measured", tmp_path / "points.csv")
    assert outcome.code == 2 and reason in outcome.stderr and outcome.stderr.count("\n") == 1
    assert outcome.pictures == []


def test_a_file_that_is_no_text_or_not_there(tmp_path, draw):
    sweep = write_sweep(tmp_path / "a.h5")
    assert "cannot be read" in draw(sweep, "--measured", tmp_path / "none.csv").stderr
    (tmp_path / "points.csv").write_bytes(b"\xff\xfe\x00")
    assert "UTF-8" in draw(sweep, "--measured", tmp_path / "points.csv").stderr


SERIES = ("frequency_hz;gap_mm;force_n;force_error_n;gap_error_mm;series;label\n9,0;0,89;100,5;2,5;0,1;rising;\n"
          "13,5;0,89;90;;;rising;\n9,0;1,78;70;5;;falling;odd one\n")


def points_of_map(tmp_path, text):
    path = tmp_path / "points.csv"
    path.write_text(text)
    with PeterkaFile(write_map(tmp_path / "m.h5")) as file:
        return read_measurements(path, file)


def test_points_lie_over_a_map(tmp_path):
    found = points_of_map(tmp_path, SERIES)
    data = peterka.open(tmp_path / "m.h5")
    ax = peterka.draw(data, "map", measured=found)
    legend = [text.get_text() for text in ax.figure.findobj(matplotlib.text.Text) if text.get_text() in ("rising", "falling")]
    assert sorted(legend) == ["falling", "rising"]
    places = {line.get_marker(): np.column_stack([line.get_xdata(), line.get_ydata()]) for line in ax.lines}
    assert places["D"] == pytest.approx(np.array([[2.0, 1.0], [3.0, 1.0]])) and places["o"] == pytest.approx(np.array([[2.0, 2.0]]))
    assert "odd one" in [text.get_text() for text in ax.texts]
    with PeterkaFile(tmp_path / "m.h5") as file:
        assert ax.get_xlim() == tuple(file.columns.edges[[0, -1]]) and ax.get_ylim() == tuple(file.rows.edges[[0, -1]])
    bars = [collection for collection in ax.collections if isinstance(collection, matplotlib.collections.LineCollection)]
    (ends,) = [bar.get_segments()[0] for bar in bars if len(bar.get_segments()) == 2]
    assert ends[:, 1] == pytest.approx([1.0 - 0.1 / 0.89, 1.0 + 0.1 / 0.89]) and ends[:, 0] == pytest.approx([2.0, 2.0])


def test_over_a_map_of_forces_a_mark_has_the_colour_of_its_force(tmp_path):
    found = points_of_map(tmp_path, f"frequency_ratio,gap_ratio,force_ratio\n1,0,10\n2,0,{10 + 1 / 10}\n")
    ax = peterka.draw(peterka.open(tmp_path / "m.h5"), "force_all", measured=found)
    mesh = ax.collections[-1] if hasattr(ax.collections[-1], "to_rgba") else ax.collections[0]
    colours = [line.get_markerfacecolor() for line in ax.lines if line.get_marker() == "D" and len(line.get_xdata()) == 1]
    assert [tuple(colour) for colour in colours] == [tuple(mesh.to_rgba(force)) for force in (10, 10.1)]


def test_no_note_is_written_over_a_mark(tmp_path, monkeypatch):
    """Marks where the note of the largest force and a label would stand."""
    found = points_of_map(tmp_path, "frequency_ratio,gap_ratio,force_ratio,label\n3.4,0.8,10,a label\n2,0.8,10,\n2.4,0.8,9,\n1.4,1.6,9,\n")
    ax = peterka.draw(peterka.open(tmp_path / "m.h5"), "force_all", measured=found)
    figure = ax.figure
    assert faults_of_layout(figure, monkeypatch) == []
    places = [ax.transData.transform((point.frequency, point.gap)) for point in found.points]
    inside = [(text.get_text(), tuple(place)) for text in ax.texts for place in places
              if matplotlib.text.Text.get_window_extent(text, figure.canvas.get_renderer()).contains(*place)]
    assert len(ax.texts) >= 2 and inside == []


def test_residuals_of_a_map_are_to_the_cell_of_a_point(tmp_path, draw):
    points_of_map(tmp_path, SERIES + "99;0;9;;;rising;\n")
    outcome = draw(tmp_path / "m.h5", "--measured", tmp_path / "points.csv", "--formats", "png", "--only", "map")
    assert outcome.code == 0, outcome.stderr
    assert "1 points outside the map are left out" in outcome.stdout
    rows = [line.split() for line in outcome.stdout.splitlines()]
    # the sample's forces are 10 + row + column/10; 9 Hz, 0.89 mm is row 1, column 1: 11.1 weights
    force = 11.1 * WEIGHT
    assert ["9", "0.89", "100.5", f"{force:.4g}", "1/1", f"{100 * (100.5 / force - 1):+.1f}", "%", f"({abs(100.5 - force) / 2.5:.1f}",
            "s.e.)", "rising"] in rows
    assert ["9", "1.78", "70", "0", "no", "impact", "falling,", "odd", "one"] in rows


@pytest.mark.parametrize("text, reason", [
    ("frequency_hz,force_n\n9,100\n", ":2 has no gap, and a map has all of them"),
    ("frequency_hz,gap_mm,force_error_n\n9,0,-1\n", ":2 has a standard error of force below 0"),
    ("frequency_hz,gap_mm,force_error_n,force_error_ratio\n9,0,1,1\n", "force_error_ratio and force_error_n"),
    ("frequency_hz,gap_mm,series\n" + "".join(f"9,0,series {n}\n" for n in range(25)), "has 25 series; 24 can be told apart"),
])
def test_what_a_map_cannot_show_is_said(tmp_path, draw, text, reason):
    (tmp_path / "points.csv").write_text(text)
    outcome = draw(write_map(tmp_path / "a.h5"), "--measured", tmp_path / "points.csv")
    assert outcome.code == 2 and reason in outcome.stderr and outcome.stderr.count("\n") == 1


def test_a_basin_takes_no_points(tmp_path, draw):
    (tmp_path / "points.csv").write_text("frequency_hz,gap_mm\n9,0\n")
    outcome = draw(write_basin(tmp_path / "a.h5"), "--measured", tmp_path / "points.csv")
    assert outcome.code == 2 and "drawn over a sweep or a map" in outcome.stderr


def test_forty_points_name_their_series_once(tmp_path):
    """By a column of its own, or by the label that they all have; bars where there are errors."""
    lines = "".join(f"{1 + n / 40},{20 + n},0,{name},1\n" for n in range(20) for name in ("up", "down"))
    for column in ("series", "label"):
        found = points(tmp_path, f"frequency_ratio,force_ratio,gap_ratio,{column},force_error_ratio\n" + lines)
        with peterka.open(tmp_path / "a.h5") as data:
            axes = peterka.draw(data, "response", measured=found)
        words = [text.get_text() for text in axes[0].figure.findobj(matplotlib.text.Text)]
        assert words.count("up") == 1 and words.count("down") == 1
        bars = [bar for bar in axes[0].collections if isinstance(bar, matplotlib.collections.LineCollection)]
        heights = sorted(np.ptp(segment[:, 1]) for bar in bars for segment in bar.get_segments())
        assert heights[-40:] == pytest.approx([2.0] * 40)


def test_a_unit_needs_the_rig(tmp_path, draw):
    (tmp_path / "points.csv").write_text("frequency_ratio,force_n,gap_ratio\n2,204,0\n")
    outcome = draw(write_sweep(tmp_path / "a.h5", hammer_mass_kg="heavy"), "--measured", tmp_path / "points.csv")
    assert outcome.code == 2 and "what a ratio of 1 is" in outcome.stderr


def test_semicolons_and_decimal_commas(tmp_path):
    found = points(tmp_path, "frequency_hz;force_n;gap_mm;label\n9,0;204,5;1,335;one, two\n11.25;;0;\n")
    one, two = found.points
    assert (one.frequency, one.force, one.gap, one.label) == (pytest.approx(2.0), pytest.approx(204.5 / WEIGHT), 1.5, "one, two")
    assert (two.frequency, two.force, two.gap) == (pytest.approx(2.5), None, 0.0)


def test_a_comma_that_is_no_decimal_one_is_told(tmp_path, draw):
    (tmp_path / "points.csv").write_text("frequency_hz;gap_mm\n1.234,5;0\n")
    outcome = draw(write_sweep(tmp_path / "a.h5"), "--measured", tmp_path / "points.csv")
    assert outcome.code == 2 and ":2 has '1.234,5' as frequency_hz" in outcome.stderr


def test_residuals_are_to_the_nearest_branch(tmp_path):
    """At gap 1.5 the sample goes up on 30 + 40 (r - 1) to 1.75, and down on it from 1.5; it jumps in between."""
    found = points(tmp_path, "frequency_ratio,gap_ratio,force_ratio\n1.3,1.5,45\n1.625,1.5,50\n1.625,1.5,4\n1.8,1.5,30\n9,0,9\n2,0,\n")
    with SweepFile(tmp_path / "a.h5") as file:
        told = residuals(file, found.points)
    assert [(one.point.force, one.branch.direction) for one in told] == [(45, "up"), (50, "up"), (4, "down"), (30, "down")]
    assert told[0].force == pytest.approx(42.0) and told[0].share == pytest.approx(45 / 42 - 1)
    assert told[1].force == pytest.approx(55.0) and told[2].force == 0 and told[2].share is None


def test_no_residual_is_told_across_a_jump_from_the_side_it_is_taken(tmp_path):
    """Going down the sample jumps between 1.625 and 1.5, and has 30 + 40 (r - 1) from there on; up, between 1.75 and 1.875."""
    text = "frequency_ratio,gap_ratio,force_ratio\n1.4375,1.5,40\n1.53125,1.5,35\n1.8,1.5,9\n"
    for directions, right in (((1,), [(1.4375, 47.5), (1.8, 0.0)]), ((0,), [(1.4375, 47.5), (1.53125, 51.25)])):
        found = points(tmp_path, text, directions=directions)
        with SweepFile(tmp_path / "a.h5") as file:
            told = residuals(file, found.points)
        assert [(one.point.frequency, one.force) for one in told] == [pytest.approx(pair) for pair in right], directions


def test_draw_prints_the_residuals(tmp_path, draw):
    (tmp_path / "points.csv").write_text("frequency_hz,gap_ratio,force_n,label\n9,0,100,mine\n")
    outcome = draw(write_sweep(tmp_path / "a.h5"), "--measured", tmp_path / "points.csv", "--formats", "png")
    line = next(line for line in outcome.stdout.splitlines() if line.endswith("mine"))
    assert line.split() == ["9", "0", "100", f"{40 * WEIGHT:.4g}", "up", f"{100 * (100 / 40 / WEIGHT - 1):+.1f}", "%", "mine"]
