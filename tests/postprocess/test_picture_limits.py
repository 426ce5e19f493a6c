"""--limits: their unit doesn't depend on the prefix that a scale has in one file or another."""

import numpy as np
import pytest
from attractor_samples import write_attractors
from peterka.measurements.points import Measurements, Point
from peterka.pictures import open_file, pictures_of
from peterka.plotting.figures import figure_of
from picture_samples import PLAIN, write_map
from sealing import SealedFile
from sweep_samples import WEIGHT, write_sweep
from uncertain_samples import write_uncertain_sweep

pytestmark = pytest.mark.thorough


@pytest.mark.parametrize("times", [1, 100])  # forces in N, and in kN
def test_limits_in_si_are_newtons_whatever_the_prefix(tmp_path, times):
    forces = times * np.arange(10.0, 26).reshape(4, 4)
    with open_file(write_map(tmp_path / "a.h5", forces=forces)) as file:
        norm = pictures_of(file)["force_all"](file, limits=(times * 30, times * 60), units="si").collections[-1].norm
    kilo = 1000 if times == 100 else 1
    assert (norm.vmin, norm.vmax) == pytest.approx((times * 30 / kilo, times * 60 / kilo))


def test_limits_are_in_weights_where_the_scale_is(tmp_path):
    with open_file(write_map(tmp_path / "a.h5")) as file:
        norm = pictures_of(file)["force_all"](file, limits=(11, 12)).collections[-1].norm
    assert (norm.vmin, norm.vmax) == pytest.approx((11, 12))


@pytest.mark.parametrize("units", ["both", "si", "ratio"])
def test_limits_of_a_number_without_a_ratio_are_in_si(tmp_path, units):
    speed = 1e-3 * np.arange(1.0, 17).reshape(4, 4)  # shown in mm/s
    with open_file(write_map(tmp_path / "a.h5", fields={"impact_speed": speed})) as file:
        norm = pictures_of(file)["impact_speed"](file, limits=(2e-3, 5e-3), units=units).collections[-1].norm
    assert (norm.vmin, norm.vmax) == pytest.approx((2, 5))


def test_limits_of_a_sweep_are_newtons_too(tmp_path):
    with open_file(write_sweep(tmp_path / "a.h5")) as file:
        ends = [ax.get_ylim() for ax in pictures_of(file)["response"](file, limits=(0, 100), units="si")]
    assert all(low == 0 and high * WEIGHT == pytest.approx(100) for low, high in ends)


def test_nothing_beyond_the_limits_stands_in_another_panel(tmp_path):
    """A star of 40 weights, which clipping doesn't hold, stood in the panel above; measured points did, too."""
    measured = Measurements([Point(2.0, 40.0, None, 0.0, ""), Point(1.5, 15.0, None, 1.5, "")], [])
    with open_file(write_sweep(tmp_path / "a.h5")) as file:
        panels = pictures_of(file, measured=measured)["response"](file, limits=(0, 20), units="ratio")
    for panel in panels:
        marks = [line for line in panel.lines if line.get_linestyle() == "None" and not line.get_clip_on()]
        assert all(0 <= height <= 20 for line in marks for height in line.get_ydata())
    assert any(15.0 in line.get_ydata() for line in panels[1].lines)


def test_measured_points_beyond_what_is_computed_are_seen(tmp_path):
    """Without limits a panel grows to hold them."""
    measured = Measurements([Point(2.0, None, 50.0, 0.0, "")], [])
    with open_file(write_sweep(tmp_path / "a.h5")) as file:
        panel = pictures_of(file, measured=measured)["bifurcation"](file)[0]
    assert any(50.0 in line.get_ydata() for line in panel.lines) and panel.get_ylim()[1] > 50


def test_a_logarithmic_scale_has_no_limit_below_0(tmp_path):
    lives = np.full((4, 13), np.nan)
    lives[0] = np.geomspace(1, 100, 13)
    path = write_sweep(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file["mean_life_s"] = lives
    with open_file(path) as file:
        panel = pictures_of(file)["life"](file, limits=(0, 50))[0]
    assert panel.get_ylim() == pytest.approx((0.9, 50))


def test_kicks_shares_and_lives_have_limits(tmp_path):
    with open_file(write_attractors(tmp_path / "a.h5")) as file:
        pictures = pictures_of(file)
        for name, limits in (("kick", (0.1, 3.0)), ("attractors_impact", (0.5, 1.0))):
            norm = pictures[name](file, limits=limits).collections[-1].norm
            assert (norm.vmin, norm.vmax) == pytest.approx(limits), name


@pytest.mark.parametrize("name, options, told", [
    ("map", ("--limits", "1,2"), "map: --limits sets nothing in it"), ("map", ("--log",), "map: --log sets nothing in it"),
    ("map", ("--log", "--limits", "1,2"), "map: --limits and --log set nothing in it"), ("force_all", ("--log",), None)])
def test_a_picture_without_such_a_scale_says_so(tmp_path, draw, name, options, told):
    outcome = draw(write_map(tmp_path / "a.h5"), "--only", name, *options)
    assert outcome.code == 0 and (told in outcome.stdout if told else "nothing in it" not in outcome.stdout)


def test_what_has_no_logarithm_is_named(tmp_path):
    exponents = np.linspace(-1, 2, 16).reshape(4, 4)
    with open_file(write_map(tmp_path / "a.h5", fields={"lyapunov": exponents})) as file:
        for log in (True, False):
            figure = figure_of(pictures_of(file)["lyapunov"](file, log=log))
            texts = [text.get_text() for ax in figure.axes if ax.get_legend() for text in ax.get_legend().get_texts()]
            assert ("0 or below: no logarithm" in texts) == log
        figure = figure_of(pictures_of(file)["lyapunov"](file, log=True, limits=(-1, -0.1)))  # of which there is none
        assert not any("no logarithm" in text.get_text() for ax in figure.axes if ax.get_legend() for text in ax.get_legend().get_texts())


@pytest.mark.parametrize("log, limits, lowest", [(False, (0, 30), 0), (False, (-5, 30), -5), (False, (5, 30), 5), (True, (5, 30), 5),
                                                 (True, (0, 30), 0.9 * 0.1 * 1.05 * 40)])
def test_a_sweep_begins_at_the_lower_limit_unless_it_has_no_logarithm(tmp_path, log, limits, lowest):
    """Then it begins below a tenth of its top, which is 5 % above the largest force."""
    path = write_sweep(tmp_path / "a.h5", gaps=(0.0,))
    with SealedFile(path, "r+") as file:
        file["peak_force_ratio"][:] = np.linspace(20, 40, 13)
    with open_file(path) as file:
        panel, = pictures_of(file)["response"](file, limits=limits, units="ratio", log=log)
    assert panel.get_ylim()[0] == pytest.approx(lowest)


def test_limits_of_the_response_of_rigs_are_newtons_too(tmp_path):
    with open_file(write_uncertain_sweep(tmp_path / "a.h5")) as file:
        for ax in pictures_of(file)["response_of_rigs"](file, limits=(10, 200), units="si"):
            assert np.array(ax.get_ylim()) * WEIGHT == pytest.approx((10, 200))


@pytest.mark.parametrize("units, asked, told", [
    ("si", "1000,2000", "has values from 29.22 to 67.21 N, and --limits 1000,2000 (in N) leaves nothing"),
    ("both", "0.1,0.2", "has values from 10 to 23 weights of the hammer, F/(m g), and --limits 0.1,0.2 (in weights"),
])
def test_limits_that_leave_nothing_are_refused_with_the_range_and_its_unit(tmp_path, draw, units, asked, told):
    forces = np.linspace(10, 23, 16).reshape(4, 4)
    path = write_map(tmp_path / "rig.h5", [[PLAIN[0][0]] * 4] * 4, forces=forces)
    outcome = draw(path, "--only", "map,force_all", "--units", units, "--limits", asked, "--format", "png")
    assert outcome.code == 2 and outcome.pictures == ["rig_map.png"]
    assert told in outcome.stderr and outcome.stderr.startswith("draw.py: force_all: ") and "--only" in outcome.stderr


def test_a_sweep_says_so_too(tmp_path, draw):
    outcome = draw(write_sweep(tmp_path / "s.h5"), "--only", "response", "--units", "si", "--limits", "5000,6000")
    assert outcome.code == 2 and " N, and --limits 5000,6000 (in N)" in outcome.stderr
