"""Pictures over axes that a job gives in metres have them in mm, --zoom too, and a sweep along the gap says so; measured
points lie over axes in Hz and metres as over ratios."""

import subprocess
import sys
from pathlib import Path

import jobs
import launch
import numpy as np
import pytest
from any_axes import axis, map_over

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
from peterka.measurements.points import read_measurements  # noqa: E402
from peterka.pictures import open_file, pictures_of  # noqa: E402
from peterka.program.picture_options import zoomed  # noqa: E402

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


@pytest.mark.parametrize("units", ["both", "si", "ratio"])
def test_a_gap_in_metres_is_shown_in_mm(files, units):
    with open_file(files / "map.h5") as file:
        ax = pictures_of(file)["map"](file, units=units)
        scale, = (child for child in ax.child_axes if child.get_ylabel() == "gap (mm)")
        ax.figure.canvas.draw()
        assert not ax.yaxis.get_visible()
        assert np.allclose(scale.get_ylim(), 1e3 * file.rows.edges[[0, -1]])


def test_a_zoom_is_in_the_units_of_the_picture(files):
    with open_file(files / "map.h5") as file, zoomed(file, (7.0, 11.0, 0.5, 1.5), in_si=False) as part:
        assert np.allclose(part.rows.values[[0, -1]], [0.5e-3, 1.5e-3]) and np.allclose(part.columns.values[[0, -1]], [7, 11])


@pytest.mark.parametrize("name", ["response", "bifurcation"])
def test_a_sweep_along_the_gap_says_so(files, name):
    with open_file(files / "sweep.h5") as file:
        drawn = pictures_of(file)[name](file)
        ax = drawn[0] if isinstance(drawn, list) else drawn
        figure = ax.figure
        words = [text.get_text() for legend in figure.legends + [one.get_legend() for one in figure.axes if one.get_legend()]
                 for text in legend.get_texts()]
        assert {"gap rising", "gap falling"} <= set(words)
        assert any(child.get_xlabel() == "gap (mm)" for one in figure.axes for child in one.child_axes)


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
    """The table of residuals is that of the same map, and sweep, in ratios, and so is the place of each mark."""
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
    with open_file(files / "map.h5") as file:
        measured = read_measurements(tmp_path / "points.csv", file)
        places = [(point.frequency, point.gap) for point in measured.points]
        assert np.allclose(places, [(8, 0.3e-3), (9, 0.3e-3), (10, 1.25e-3)])
        assert measured.points[0].errors["frequency"] == pytest.approx(0.1)
