"""Pictures of files whose axes are in Hz and metres equal those over ratios: ratios at the bottom and left, Hz and mm at the top and
right, or either alone; --zoom uses the displayed units, a sweep along the gap says so, and measured points lie at their place."""

import re
import subprocess
import sys
from pathlib import Path

import jobs
import launch
import numpy as np
import pytest
from any_axes import axis, map_over

pytestmark = pytest.mark.thorough

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
from peterka.errors import PeterkaFileError  # noqa: E402
from peterka.measurements.points import read_measurements  # noqa: E402
from peterka.pictures import open_file, pictures_of  # noqa: E402
from peterka.cli.picture_options import zoomed  # noqa: E402

HERTZ, MILLIMETRES = 4.5, 0.89  # values of ratio 1 for jobs.RIG
FREQUENCY, GAP = "excitation frequency (Hz)", "gap (mm)"
MAP = map_over(axis("frequency_hz", 6.0, 12.0, 7), axis("gap_m", 0.0, 2e-3, 9))
SWEEP = (jobs.RIG.format(kind="sweep", title="gaps") + '[sweep]\ndirection = "both"\n[operating_point]\nfrequency_hz = 9.0\n'
         + axis("gap_m", 0.0, 2e-3, 9))


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lengths")
    for name, text in (("map", MAP), ("sweep", SWEEP)):
        jobs.write(folder, text, f"{name}.toml")
        assert launch.run("run", f"{name}.toml", cwd=folder).returncode == 0
    return folder


def scales(ax):
    """{label: axis} of all scales of a picture, once it is drawn."""
    ax.figure.canvas.draw()
    axes = [axis for one in (ax, *ax.child_axes) for axis in (one.xaxis, one.yaxis)]
    return {axis.get_label_text(): axis for axis in axes if axis.get_label_text()}


def places(axis, numbers):
    """Where numbers on a scale stand in the picture [pixels], as its labels have it."""
    texts = [label.get_text().replace("\N{MINUS SIGN}", "-") for label in axis.get_ticklabels()]
    first, last = axis.get_ticklocs()[[0, -1]]
    share = (np.asarray(numbers) - float(texts[0])) / (float(texts[-1]) - float(texts[0]))
    along = first + share * (last - first)
    return axis.axes.transData.transform(np.column_stack([along, along]))[:, "xy".index(axis.axis_name)]


@pytest.mark.parametrize("units, expected", [
    ("both", {r"$\Omega/\omega$": "bottom", r"$\mathrm{gap}/A_0$": "left", FREQUENCY: "top", GAP: "right"}),
    ("si", {FREQUENCY: "bottom", GAP: "left"}), ("ratio", {r"$\Omega/\omega$": "bottom", r"$\mathrm{gap}/A_0$": "left"})])
def test_a_map_over_hz_and_metres_has_ratios_and_beside_them_hz_and_mm(files, units, expected):
    with open_file(files / "map.h5") as file:
        ax = pictures_of(file)["map"](file, units=units)
        shown = scales(ax)
    assert {label: axis.get_label_position() for label, axis in shown.items()} == expected
    assert np.allclose(ax.get_xlim(), np.divide([5.5, 12.5], HERTZ)) and np.allclose(ax.get_ylim(), np.divide([-0.125, 2.125], MILLIMETRES))
    if units != "ratio":
        assert np.allclose(places(shown[FREQUENCY], [5.5, 12.5]), ax.bbox.intervalx, atol=0.01)
        assert np.allclose(places(shown[GAP], [-0.125, 2.125]), ax.bbox.intervaly, atol=0.01)


IN_SI, AS_RATIOS = (7.0, 11.0, 0.5, 1.5), (7 / HERTZ, 11 / HERTZ, 0.5 / MILLIMETRES, 1.5 / MILLIMETRES)


@pytest.mark.parametrize("zoom, in_si", [(IN_SI, True), (AS_RATIOS, False)])
def test_a_zoom_is_in_the_units_of_the_main_axes(files, zoom, in_si):
    with open_file(files / "map.h5") as file, zoomed(file, zoom, in_si=in_si) as part:
        assert part.shape == (5, 5)
        assert np.allclose(part.columns.values, np.divide([7, 8, 9, 10, 11], HERTZ))
        assert np.allclose(part.rows.values, np.divide([0.5, 0.75, 1.0, 1.25, 1.5], MILLIMETRES))
        ax = pictures_of(part)["map"](part, units="si")
        assert np.allclose(places(scales(ax)[FREQUENCY], [7, 11]), ax.bbox.intervalx, atol=0.01)
        assert np.allclose(places(scales(ax)[GAP], [0.5, 1.5]), ax.bbox.intervaly, atol=0.01)


@pytest.mark.parametrize("zoom, in_si, named", [(IN_SI, False, "frequency_ratio from 7"), (AS_RATIOS, True, "frequency from 1.55556 to 2.44444 Hz")])
def test_a_zoom_is_in_no_other_units(files, zoom, in_si, named):
    with open_file(files / "map.h5") as file, pytest.raises(PeterkaFileError, match=f"has 0 points of {named}"):
        zoomed(file, zoom, in_si=in_si)


@pytest.mark.parametrize("name", ["response", "bifurcation"])
def test_a_sweep_along_the_gap_says_so(files, name):
    with open_file(files / "sweep.h5") as file:
        drawn = pictures_of(file)[name](file)
        ax = drawn[0] if isinstance(drawn, list) else drawn
        figure = ax.figure
        words = [text.get_text() for legend in figure.legends + [one.get_legend() for one in figure.axes if one.get_legend()]
                 for text in legend.get_texts()]
        assert {"gap rising", "gap falling"} <= set(words)
        assert r"$\mathrm{gap}/A_0$" in {one.get_xlabel() for one in figure.axes}
        figure.canvas.draw()
        scale, = (child for one in figure.axes for child in one.child_axes if child.get_xlabel() == GAP)
        assert np.allclose(scale.get_xlim(), [0, 2])


@pytest.mark.parametrize("units, expected", [("both", r" at \d\S* mm \(\d\S*\)$"), ("si", r" at \d\S* mm$"), ("ratio", r" at \d\S*$")])
def test_places_along_the_gap_are_told_in_the_units_of_the_picture(files, units, expected):
    with open_file(files / "sweep.h5") as file:
        figure = pictures_of(file)["response"](file, units=units)[0].figure
        told = [text.get_text() for ax in figure.axes for text in ax.texts if " at " in text.get_text()]
    assert told and [text for text in told if not re.search(expected, text)] == []


POINTS = ("frequency_hz;gap_mm;force_n;force_error_n;frequency_error_hz;series\n8,0;0,3;100,5;2,5;0,1;first\n"
          "9,0;0,3;90;;;first\n10,0;1,25;70;5;;second\n")
IN_RATIOS = map_over(axis("frequency_ratio", 6.0 / 4.5, 12.0 / 4.5, 7), axis("gap_ratio", 0.0, 2e-3 / 0.89e-3, 9))
ALONG = {"hertz": axis("frequency_hz", 6.0, 12.0, 13), "ratios": axis("frequency_ratio", 6.0 / 4.5, 12.0 / 4.5, 13)}


def residuals(folder, file, *arguments):
    drawn = subprocess.run([sys.executable, ROOT / "postprocess/draw.py", file, "--measured", "points.csv", "--format", "svg", *arguments],
                           cwd=folder, capture_output=True, text=True, check=False)
    assert drawn.returncode == 0, drawn.stderr
    return [line for line in drawn.stdout.splitlines() if "first" in line or "second" in line or "frequency" in line]


def test_measured_points_lie_over_axes_in_hz_and_metres(files, tmp_path):
    """The table of residuals equals that of the same map, and sweep, in ratios, and so does the position of each mark."""
    (tmp_path / "points.csv").write_text(POINTS)
    jobs.write(tmp_path, IN_RATIOS, "ratios.toml")
    for name, along in ALONG.items():
        text = jobs.RIG.format(kind="sweep", title=name) + along + f'[sweep]\ndirection = "up"\ngap_ratio = [{0.3 / 0.89!r}]\n'
        jobs.write(tmp_path, text, f"along_{name}.toml")
    for name in ("ratios", "along_hertz", "along_ratios"):
        assert launch.run("run", f"{name}.toml", cwd=tmp_path).returncode == 0
    over_map = residuals(tmp_path, files / "map.h5", "--only", "map")
    assert len(over_map) == 4 and over_map == residuals(tmp_path, "ratios.h5", "--only", "map")
    over_sweep = residuals(tmp_path, "along_hertz.h5", "--only", "response")
    assert len(over_sweep) == 3 and over_sweep == residuals(tmp_path, "along_ratios.h5", "--only", "response")
    for path in (files / "map.h5", tmp_path / "ratios.h5"):
        with open_file(path) as file:
            measured = read_measurements(tmp_path / "points.csv", file)
        places = [(point.frequency, point.gap) for point in measured.points]
        assert np.allclose(places, [(8 / HERTZ, 0.3 / MILLIMETRES), (9 / HERTZ, 0.3 / MILLIMETRES), (10 / HERTZ, 1.25 / MILLIMETRES)])
        assert measured.points[0].errors["frequency"] == pytest.approx(0.1 / HERTZ)


@pytest.mark.parametrize("units", ["both", "si"])
def test_marks_stand_at_their_hz_and_mm(files, tmp_path, units):
    (tmp_path / "points.csv").write_text(POINTS)
    with open_file(files / "map.h5") as file:
        ax = pictures_of(file, measured=read_measurements(tmp_path / "points.csv", file))["map"](file, units=units)
        shown = scales(ax)
    for shape, hertz, millimetres in (("D", [8, 9], [0.3, 0.3]), ("o", [10], [1.25])):
        mark, = (line for line in ax.lines if line.get_marker() == shape)
        x, y = ax.transData.transform(np.column_stack([mark.get_xdata(), mark.get_ydata()])).T
        assert np.allclose(x, places(shown[FREQUENCY], hertz), atol=0.01)
        assert np.allclose(y, places(shown[GAP], millimetres), atol=0.01)
