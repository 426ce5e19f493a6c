"""Measured points from a CSV file: units, gaps, rigs, and one clear line for each fault."""

import re

import h5py
import matplotlib.collections
import matplotlib.text
import numpy as np
import peterka
import pytest
from conftest import POSTPROCESS
from peterka.errors import PeterkaFileError
from peterka.measurements import map_residuals
from peterka.measurements.points import read_measurements
from peterka.maps.map_file import PeterkaFile
from peterka.sweeps.residuals import residuals
from peterka.sweeps.sweep_file import SweepFile
from picture_texts import faults_of_layout
from peterka.plotting.seen import SEEN
from picture_samples import write_basin, write_map
from sealing import SealedFile, seal_file
from starts_samples import add_starts
from sweep_samples import WEIGHT, write_sweep, write_sweep_with_starts

pytestmark = pytest.mark.thorough


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


@pytest.mark.parametrize("name, told", [
    ("force_nn", "unknown column 'force_nn' (did you mean force_n?)"), ("Gap_mm", "'Gap_mm' (did you mean gap_mm?)"),
    ("lable", "(did you mean label?)"), ("colour", "'colour'; it may have frequency_ratio"),
    ("force_error_ratio" * 600, "…'; it may have")])
def test_an_unknown_column_is_told_with_the_nearest_known_one(tmp_path, name, told):
    with pytest.raises(PeterkaFileError) as refusal:
        points(tmp_path, f"frequency_hz,{name}\n9,1\n")
    assert told in str(refusal.value) and "\n" not in str(refusal.value)
    assert ("did you mean" in told) != ("it may have" in str(refusal.value))  # all of them only where none is near


def test_kilonewtons_are_a_thousand_newtons(tmp_path):
    in_n, in_kn = (points(tmp_path, f"frequency_hz,gap_mm,force_{unit},force_error_{unit}\n9.0,1.335,{force},{error}\n").points
                   for unit, force, error in (("n", 204, 3), ("kn", 0.204, 0.003)))
    assert in_kn[0].force == pytest.approx(in_n[0].force, rel=1e-12) and in_kn[0].errors == pytest.approx(in_n[0].errors, rel=1e-12)
    with pytest.raises(PeterkaFileError, match="has force_n and force_kn; each quantity has one column"):
        points(tmp_path, "frequency_hz,gap_mm,force_n,force_kn\n9,1.335,200,0.2\n")


def test_ratios_stay_and_cells_may_be_empty(tmp_path):
    found = points(tmp_path, "# mine\nlabel, gap_ratio ,force_ratio,frequency_ratio\n\n,0,70.5,2\nedge,0,,2.5\n")
    assert [(point.frequency, point.force, point.label) for point in found.points] == [(2, 70.5, ""), (2.5, None, "edge")]


def test_points_of_one_gap_need_none(tmp_path):
    (point,) = points(tmp_path, "frequency_ratio\n2\n", gaps=(1.5,)).points
    assert point.gap is None


def test_of_a_sweep_that_does_not_tell_its_gap_points_of_any_gap_are_drawn(tmp_path):
    path = write_sweep(tmp_path / "a.h5", gaps=(1.5,))
    (tmp_path / "points.csv").write_text("frequency_ratio,gap_ratio\n2,1.5\n")
    with SweepFile(peterka.open(path).drop_vars("gap_ratio")) as file:
        assert file.gaps == [None]
        found = read_measurements(tmp_path / "points.csv", file)
    assert [point.gap for point in found.points] == [None] and found.left_out == []


def test_points_of_other_rigs_and_gaps_are_left_out_and_told(tmp_path):
    found = points(tmp_path, "natural_frequency_hz,gap_ratio,frequency_ratio\n4.5,0,2\n5.25,0,2\n4.5,3.37,2\n")
    assert len(found.points) == 1
    assert "1 point of rigs with another natural frequency" in found.left_out[0]
    assert "1 point at gap 2.999 mm is left out" in found.left_out[1]


@pytest.mark.parametrize("text, units", [
    ("frequency_hz,gap_mm,force_n\n56.5,0,9\n", "frequency_hz is in hertz, gap_mm is in millimetres"),  # rad/s
    ("frequency_ratio,gap_mm,force_n\n2,0.3e-2,9\n2,-4,9\n", None),
    ("frequency_ratio,gap_ratio,force_n\n9,0,9\n", "frequency_ratio is Omega/omega, gap_ratio is gap/A0")])
def test_where_no_point_is_left_the_units_of_its_columns_are_told(tmp_path, text, units):
    told = [sentence for sentence in points(tmp_path, text).left_out if "no point is left" in sentence]
    assert told == ([f"{tmp_path / 'points.csv'}: no point is left; {units}"] if units else [])


def test_points_outside_the_frequencies_of_a_sweep_are_left_out_and_told(tmp_path):
    """The sample runs from 1 to 2.5, 4.5 to 11.25 Hz, whose ends belong to it whatever rounding makes of them."""
    text = "frequency_hz,gap_mm,force_n\n4.5,0,9\n11.250000000000002,0,9\n4.499999999999999,0,9\n4.4,0,9\n200,0,9\n44,0,\n"
    found = points(tmp_path, text)
    assert len(found.points) == 3
    assert found.left_out == [f"{tmp_path / 'points.csv'}: 3 points outside the frequencies of the sweep are left out"]
    with SweepFile(tmp_path / "a.h5") as file:
        assert [len(each) for each in residuals(file, found.points)] == [1, 1, 1]


def test_a_gap_that_is_nearly_one_of_the_sweep_is_told_with_its_distance(tmp_path):
    assert points(tmp_path, "frequency_ratio,gap_ratio\n2,1.5\n").left_out == []
    found = points(tmp_path, "frequency_ratio,gap_ratio\n2,1.51\n2,1.485\n")
    assert [point.gap for point in found.points] == [1.5, 1.5]
    assert found.left_out == [f"{tmp_path / 'points.csv'}: 2 points are drawn at gap 1.335 mm, up to 0.01335 mm from the measured gap"]
    found = points(tmp_path, "frequency_ratio,gap_ratio\n2,1.51\n")
    assert found.left_out == [f"{tmp_path / 'points.csv'}: 1 point is drawn at gap 1.335 mm, 0.0089 mm from the measured gap"]


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


def test_points_of_one_place_stand_side_by_side(tmp_path):
    """Neither hides the other, each has its label on its own side, and bars stay at the place itself."""
    found = points_of_map(tmp_path, "frequency_ratio,gap_ratio,force_ratio,frequency_error_ratio,series,label\n"
                          "2,1,10,0.1,one,left\n2,1,11,0.1,two,right\n3,2,11,0,one,alone\n")
    ax = peterka.draw(peterka.open(tmp_path / "m.h5"), "force_all", measured=found)
    places = [(line.get_marker(), line.get_transform().transform(line.get_xydata())[0] - ax.transData.transform(line.get_xydata())[0])
              for line in ax.lines if line.get_gid() == SEEN and line.get_marker() in "Do"]
    point = ax.figure.dpi / 72
    assert sorted((mark, round(across / point, 6), round(up / point, 6)) for mark, (across, up) in places) == [
        ("D", -3, 0), ("D", 0, 0), ("o", 3, 0)]
    x = {text.get_text(): text.get_window_extent().x0 for text in ax.texts}
    assert x["left"] < ax.transData.transform((2, 1))[0] < x["right"] and "alone" in x
    bars = [bar.get_segments()[0][:, 0] for bar in ax.collections if isinstance(bar, matplotlib.collections.LineCollection)]
    assert all(ends.mean() == pytest.approx(2) for ends in bars) and len(bars) == 2


def test_no_note_is_written_over_a_mark(tmp_path, monkeypatch):
    """Marks where the note of the largest force and a label would be placed."""
    found = points_of_map(tmp_path, "frequency_ratio,gap_ratio,force_ratio,label\n3.4,0.8,10,a label\n2,0.8,10,\n2.4,0.8,9,\n1.4,1.6,9,\n")
    ax = peterka.draw(peterka.open(tmp_path / "m.h5"), "force_all", measured=found)
    figure = ax.figure
    assert faults_of_layout(figure, monkeypatch) == []
    places = [ax.transData.transform((point.frequency, point.gap)) for point in found.points]
    inside = [(text.get_text(), tuple(place)) for text in ax.texts for place in places
              if matplotlib.text.Text.get_window_extent(text, figure.canvas.get_renderer()).contains(*place)]
    assert len(ax.texts) >= 2 and inside == []


def test_a_map_is_told_beside_each_force(tmp_path, draw):
    points_of_map(tmp_path, SERIES + "99;0;9;;;rising;\n9;1,78;1300;;;rising;\n")
    outcome = draw(tmp_path / "m.h5", "--measured", tmp_path / "points.csv", "--formats", "png", "--only", "map")
    assert outcome.code == 0, outcome.stderr
    assert "1 point outside the map is left out" in outcome.stdout
    rows = [re.split(r"  +", line.strip()) for line in outcome.stdout.splitlines()]
    # the sample's forces are 10 + row + column/10; 9 Hz, 0.89 mm is row 1, column 1: 11.1 weights
    force = 11.1 * WEIGHT
    assert ["frequency [Hz]", "gap [mm]", "measured [N]", "motion", "computed [N]", "residual [N]", "computed at", "label"] in rows
    assert ["9", "0.89", "100.5", "1/1", f"{force:.4g}", f"{100.5 - force:+.4g}", f"{100 * (100.5 / force - 1):+.1f} %",
            f"{(100.5 - force) / 2.5:+.1f} s.e.", "the point", "rising"] in rows
    assert ["9", "1.78", "70", "no impact", "0", "+70", "+14.0 s.e.", "the point", "falling, odd one"] in rows
    assert ["9", "1.78", "1300", "no impact", "0", "+1300", "the point", "rising"] in rows


def places_of(file, text, tmp_path):
    (tmp_path / "points.csv").write_text(text)
    return map_residuals.residuals(file, read_measurements(tmp_path / "points.csv", file).points)


def test_a_motion_of_all_cells_around_a_point_is_interpolated(tmp_path):
    """The sample's forces are linear: 10 + row + column/10, at gaps 0, 1, 2 and frequencies 1, 2, 3, 4."""
    columns = np.zeros((3, 4), dtype=int)
    labels = np.stack([columns + 1, columns + 1, columns + 1], axis=-1)
    write_map(tmp_path / "m.h5", labels, frequency_ratio=np.arange(1.0, 5), gap_ratio=np.arange(3.0))
    with PeterkaFile(tmp_path / "m.h5") as file:
        ((one,), (border,)) = places_of(file, "frequency_ratio,gap_ratio,force_ratio\n1.25,0.5,12\n4.25,2.5,12\n", tmp_path)
    assert one.force == pytest.approx(10 + 0.5 + 0.25 / 10) and one.away is None and one.residual == pytest.approx(12 - 10.525)
    assert border.force == pytest.approx(12.3) and border.away == pytest.approx((0.25, 0.5))


def test_the_swing_without_impact_is_a_motion_of_each_place_that_has_it(tmp_path):
    """At half the natural frequency the swing reaches 1/3 A0, well below a gap of 1 and above one of 0.2."""
    labels = np.full((3, 2, 3), 1)
    labels[2] = (0, 0, 1)  # told once, where the start leads to it, too
    write_map(tmp_path / "m.h5", labels, frequency_ratio=np.array([0.5, 0.51]), gap_ratio=np.array([0.2, 1, 2]),
              job="[hammer]\nmass_kg = 0.298\nnatural_frequency_hz = 4.5\ndamping_ratio = 0.01\n[cart]\namplitude_m = 0.89e-3\n")
    text = "frequency_ratio,gap_ratio,force_ratio\n0.5,1,0\n0.5,0.2,0\n0.5,0.8,0\n0.5,2,0\n"
    with PeterkaFile(tmp_path / "m.h5") as file:
        both, one, between, own = places_of(file, text, tmp_path)
    assert [(each.motion.words, each.force) for each in both] == [("no impact", 0), ("1/1", 11)]
    assert [each.motion.words for each in one] == ["1/1"] and [each.motion.words for each in own] == ["no impact"]
    assert [(each.motion.words, each.away) for each in between] == [("no impact", (0, pytest.approx(0.2))), ("1/1", None)]


def test_a_point_meets_every_attractor_of_its_place(tmp_path, draw):
    """All four cells have 1/1 and, with twice its force, 1/2; only the nearest has 2/2."""
    shape = (2, 2)
    write_map(tmp_path / "m.h5", np.full((*shape, 3), 1), frequency_ratio=np.array([1.0, 2]), gap_ratio=np.array([0.0, 1]))
    slots = np.zeros((3, *shape, 3), dtype=int)
    slots[0], slots[1], slots[2] = (1, 1, 1), (1, 1, 2), (-128, 0, 0)
    slots[2, 1, 1] = (1, 2, 2)
    forces = np.stack([np.full(shape, 10.0), np.array([[20.0, 22], [20, 22]]), np.full(shape, np.nan)])
    forces[2, 1, 1] = 60
    shares = np.stack([np.full(shape, 0.6), np.full(shape, 0.4), np.zeros(shape)])
    add_starts(tmp_path / "m.h5", slots, shares, forces, np.zeros(shape))
    text = "frequency_ratio,gap_ratio,force_ratio,force_error_ratio\n1.75,0.75,22,2\n"
    with PeterkaFile(tmp_path / "m.h5") as file:
        (found,) = places_of(file, text, tmp_path)
    assert [(one.motion.words, one.motion.share) for one in found] == [("1/2", 0.4), ("1/1", 0.6), ("2/2", 0.0)]
    assert [one.force for one in found] == pytest.approx([21.5, 10, 60])
    assert [one.away for one in found] == [None, None, pytest.approx((0.25, 0.25))]
    told = draw(tmp_path / "m.h5", "--measured", tmp_path / "points.csv", "--only", "map").stdout.splitlines()
    assert [line.split()[-2:] for line in told if "%" in line] == [["the", "point"], ["the", "point"], ["mm", "away"]]
    assert "+0.2 s.e." in told[1] and "60 %" in told[2] and "1.1 Hz, 0.22 mm away" in told[3]


def test_forces_that_jump_are_of_two_branches(tmp_path):
    """With equal labels: nothing lies between them."""
    write_map(tmp_path / "m.h5", np.full((1, 2, 3), 1), frequency_ratio=np.array([1.0, 2]), gap_ratio=np.array([0.0]),
              forces=np.array([[10.0, 20]]))
    with PeterkaFile(tmp_path / "m.h5") as file:
        (found,) = places_of(file, "frequency_ratio,gap_ratio,force_ratio\n1.4,0,12\n", tmp_path)
    assert [one.force for one in found] == [10, 20]
    assert [one.away for one in found] == [pytest.approx((0.4, 0)), pytest.approx((0.6, 0))]


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
    """By a separate column, or by their common label; with bars for given errors."""
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


def test_as_many_series_as_can_be_told_apart_are_drawn(tmp_path):
    found = points(tmp_path, "frequency_hz,gap_mm,series\n" + "".join(f"9,0,series {n}\n" for n in range(24)))
    assert [point.series for point in found.points] == [f"series {n}" for n in range(24)]


def test_a_comma_that_is_no_decimal_one_is_told(tmp_path, draw):
    (tmp_path / "points.csv").write_text("frequency_hz;gap_mm\n1.234,5;0\n")
    outcome = draw(write_sweep(tmp_path / "a.h5"), "--measured", tmp_path / "points.csv")
    assert outcome.code == 2 and ":2 has '1.234,5' as frequency_hz" in outcome.stderr


def test_each_branch_is_told_and_the_nearest_first(tmp_path):
    """At gap 1.5 the sample follows 30 + 40 (r - 1) up to 1.75 when rising, and from 1.5 when falling; it jumps in between."""
    found = points(tmp_path, "frequency_ratio,gap_ratio,force_ratio\n1.3,1.5,45\n1.625,1.5,50\n1.625,1.5,4\n1.9,1.5,30\n9,0,9\n2,0,\n")
    with SweepFile(tmp_path / "a.h5") as file:
        told = residuals(file, found.points)
    assert [(each[0].point.force, [one.motion.title for one in each]) for each in told] == [
        (45, ["1/1 up and down"]), (50, ["1/1 up", "no impact down"]), (4, ["no impact down", "1/1 up"]), (30, ["no impact up and down"])]
    assert told[0][0].force == pytest.approx(42.0) and told[0][0].residual == pytest.approx(3.0)
    assert [one.force for one in told[1]] == pytest.approx([55.0, 0.0])


def test_branches_that_differ_by_rounding_are_one_motion(tmp_path):
    found = points(tmp_path, "frequency_ratio,gap_ratio,force_ratio\n1.25,0,45\n1.3,0,45\n")
    with h5py.File(tmp_path / "a.h5", "r+") as file:
        file["peak_force_ratio"][1] *= 1 + 1e-14
    seal_file(tmp_path / "a.h5")
    with SweepFile(tmp_path / "a.h5") as file:
        assert [[one.motion.title for one in each] for each in residuals(file, found.points)] == [["1/1 up and down"]] * 2


def test_branches_of_one_force_and_two_motions_stay_two(tmp_path):
    found = points(tmp_path, "frequency_ratio,gap_ratio,force_ratio\n1.25,0,45\n")
    with h5py.File(tmp_path / "a.h5", "r+") as file:
        file["impacts"][1] = file["period"][1] = 2
    seal_file(tmp_path / "a.h5")
    with SweepFile(tmp_path / "a.h5") as file:
        assert [one.motion.title for one in residuals(file, found.points)[0]] == ["1/1 up", "2/2 down"]


def test_columns_without_a_word_are_left_out(tmp_path, draw):
    write_sweep_with_starts(tmp_path / "starts.h5")
    for name, label, heads in (("a.h5", "", ["computed at"]), ("starts.h5", "x", ["starts", "computed at", "label"])):
        points(tmp_path, f"frequency_ratio,gap_ratio,force_ratio,label\n1.0625,1.5,68,{label}\n")
        outcome = draw(tmp_path / name, "--measured", tmp_path / "points.csv", "--formats", "png", "--only", "response")
        head = next(line for line in outcome.stdout.splitlines() if line.startswith("frequency [Hz]"))
        assert [word for word in ("starts", "computed at", "label") if word in re.split("  +", head)] == heads
        assert outcome.code == 0 and len({line.rstrip() == line for line in outcome.stdout.splitlines()}) == 1


def test_across_a_jump_each_side_is_told_with_its_distance(tmp_path):
    """When falling, the sample jumps between 1.625 and 1.5, and follows 30 + 40 (r - 1) from there on; rising, between 1.75 and 1.875."""
    text = "frequency_ratio,gap_ratio,force_ratio\n1.4375,1.5,40\n1.53125,1.5,35\n1.8,1.5,9\n"
    sides = {1: [[(47.5, None)], [(50.0, 0.03125), (0.0, 0.09375)], [(0.0, None)]],
             0: [[(47.5, None)], [(51.25, None)], [(0.0, 0.075), (60.0, 0.05)]]}
    for direction, right in sides.items():
        found = points(tmp_path, text, directions=(direction,))
        with SweepFile(tmp_path / "a.h5") as file:
            told = residuals(file, found.points)
        assert [[(one.force, one.away and one.away[0]) for one in each] for each in told] == [
            [(pytest.approx(force), away and pytest.approx(away)) for force, away in each] for each in right], direction


def test_attractors_on_which_no_branch_is_are_told_too(tmp_path):
    """The sample has another one of force 70 at gap 1.5; those of the branches are not listed twice."""
    (tmp_path / "points.csv").write_text("frequency_ratio,gap_ratio,force_ratio\n1.0625,1.5,68\n")
    with SweepFile(write_sweep_with_starts(tmp_path / "a.h5")) as file:
        ((nearest, branch),) = residuals(file, read_measurements(tmp_path / "points.csv", file).points)
    assert (nearest.motion.words, nearest.motion.share, nearest.force, nearest.away) == ("1/1", 0.25, 70, None)
    assert branch.motion.title == "1/1 up and down" and branch.force == pytest.approx(32.5)


@pytest.mark.parametrize("across, up", [(0.0, 0.4), (-1.0, 0.0)])
def test_no_label_covers_the_cross_of_the_largest_force(tmp_path, across, up):
    forces = np.full((4, 4), 10.0)
    forces[0, 3] = 20.0
    write_map(tmp_path / "m.h5", [[(1, 1, 1)] * 4] * 4, forces=forces)
    (tmp_path / "p.csv").write_text(f"frequency_ratio,gap_ratio,label\n{4 + across},{up},110 Hz\n")
    with PeterkaFile(tmp_path / "m.h5") as file:
        found = read_measurements(tmp_path / "p.csv", file)
    ax = peterka.draw(peterka.open(tmp_path / "m.h5"), "force_all", measured=found, width=60)
    (cross,) = [line for line in ax.lines if line.get_marker() == "x"]
    (place,) = ax.transData.transform(cross.get_xydata())
    (label,) = [text for text in ax.texts if text.get_text().startswith("110 Hz")]
    box = matplotlib.text.Text.get_window_extent(label, ax.figure.canvas.get_renderer())
    assert cross.get_xydata().tolist() == [[4.0, 0.0]] and not box.contains(*place)


def test_labels_stand_at_their_own_points(tmp_path):
    """For three adjacent points each label is nearest to its own or has a line to it, and none is far."""
    found = points_of_map(tmp_path, "frequency_ratio,gap_ratio,label\n2,1.5,first of three\n2.2,1.5,second of three\n2.4,1.5,third of three\n")
    ax = peterka.draw(peterka.open(tmp_path / "m.h5"), "force_all", measured=found)
    renderer = ax.figure.canvas.get_renderer()
    places = {point.label: ax.transData.transform((point.frequency, point.gap)) for point in found.points}
    boxes = {text.get_text(): matplotlib.text.Text.get_window_extent(text, renderer) for text in ax.texts if text.get_text() in places}
    assert len(boxes) == 3
    for label, box in boxes.items():
        away = {name: np.hypot(*(place - np.clip(place, box.min, box.max))) for name, place in places.items()}
        lined = [line for line in ax.lines if len(line.get_xdata()) == 2
                 and np.allclose(ax.transData.transform(line.get_xydata()[0]), places[label], atol=1e-6)]
        assert lined or all(away[label] < other for name, other in away.items() if name != label), label
        assert away[label] < 21 / 72 * ax.figure.dpi


def test_draw_prints_the_residuals(tmp_path, draw):
    (tmp_path / "points.csv").write_text("frequency_hz,gap_ratio,force_n,label\n9,0,100,mine\n")
    outcome = draw(write_sweep(tmp_path / "a.h5"), "--measured", tmp_path / "points.csv", "--formats", "png")
    line = next(line for line in outcome.stdout.splitlines() if line.endswith("mine"))
    computed = 40 * WEIGHT
    assert re.split(r"  +", line.strip()) == ["9", "0", "100", "1/1 up and down", f"{computed:.4g}", f"{100 - computed:+.3g}",
                                              f"{100 * (100 / computed - 1):+.1f} %", "the point", "mine"]


def test_help_tells_the_columns_of_measured_points_with_an_example(draw, tmp_path):
    """The example is read, and no source file has to be opened."""
    words = " ".join(draw("--help").stdout.split())
    told = words[words.index("--measured POINTS.csv points to draw"):]
    head, line = re.search(r"Two lines of an example: (\S+) / (.*?) --", told).groups()
    assert ".py" not in told[:told.index("Two lines")] and {"frequency_hz", "force_n", "gap_mm"} <= set(head.split(","))
    (tmp_path / "points.csv").write_text(f"{head}\n{line}\n")
    outcome = draw(write_map(tmp_path / "a.h5"), "--only", "force_all", "--measured", tmp_path / "points.csv", "--format", "png")
    assert outcome.code == 0 and "152.5" in outcome.stdout, outcome.stderr


@pytest.mark.parametrize("is_rigid", [True, False])
def test_a_stop_without_forces_says_that_none_is_compared(tmp_path, draw, is_rigid):
    path = write_sweep(tmp_path / "a.h5")
    if is_rigid:
        with SealedFile(path, "r+") as file:
            file["peak_force_ratio"][()] = np.where(file["impacts"][()] > 0, np.nan, 0.0)
    (tmp_path / "points.csv").write_text("frequency_hz,gap_mm,force_n\n9.0,0,100\n")
    outcome = draw(path, "--measured", tmp_path / "points.csv", "--formats", "png", "--only", "bifurcation")
    assert outcome.code == 0, outcome.stderr
    words = f"{path}: impacts have no peak force, as on a rigid stop: there is none to compare measured forces with"
    assert (words in outcome.stdout) == is_rigid
