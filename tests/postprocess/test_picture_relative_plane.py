"""Traces state why a cell has its colour, show the relative frame and stroboscopic points, and have no empty panels."""

import h5py
import numpy as np
import peterka
import pytest
from peterka.plotting import style
from peterka.plotting.figures import figure_of
from peterka.traces import motion, relative_plane, spectrum, trace_look
from peterka.traces.trace_file import TraceFile
from sealing import SealedFile
from test_picture_real_file import RIG
from trace_samples import write_trace

pytestmark = pytest.mark.thorough

STATUS = "proved budget conservative"


def with_cell(path, **changes):
    cell = {"regime": 1, "impacts": 1, "period": 1, "status": 0, "observed_cycles": 0, "multiplier": 0.31, "lyapunov": -1.2}
    with SealedFile(path, "r+") as file:
        group = file.create_group("cell")
        for name, value in (cell | changes).items():
            group[name] = np.float64(value) if name in ("multiplier", "lyapunov") else np.int32(value)
        group["status"].attrs["flag_values"] = np.arange(3, dtype="i1")
        group["status"].attrs["flag_meanings"] = STATUS
    return path


@pytest.mark.parametrize("cell, words", [
    ({}, "z = 1/1: repeats after 1 cycle, stable (multipliers within 0.31)"),
    ({"regime": 0, "impacts": 0}, "no impact: what is left of the free motion can't reach the stop"),
    ({"regime": 2, "impacts": 0, "period": 0, "observed_cycles": 1200, "lyapunov": 0.5},
     "chaotic for 1,200 cycles: errors grow (exponent 0.5 per cycle)"),
    ({"regime": 3, "impacts": 0}, "sustained contact: what is left of the motion can't separate the hammer"),
    ({"regime": 4, "impacts": 0, "period": 0, "status": 1, "observed_cycles": 3000}, "unresolved after 3,000 cycles: nothing verified in all its cycles (steady_state.max_cycles)"),
])
def test_the_title_says_what_decided(tmp_path, cell, words):
    with TraceFile(with_cell(write_trace(tmp_path / "a.h5"), **cell)) as file:
        assert trace_look.claim(file) == words
        title = figure_of(motion.draw(file))._suptitle.get_text()
        assert words in title.replace("\n", " ") and "9 Hz" in title


def test_the_relative_frame_has_its_stop_and_its_points(tmp_path):
    with TraceFile(write_trace(tmp_path / "a.h5", cycles=3, gap_ratio=0.5)) as file:
        way, points, stop = relative_plane.draw_motion(file).lines
        assert way.get_xdata() == pytest.approx(0.89 * file.motion["relative_displacement_ratio"])
        assert len(points.get_xdata()) == 4  # forcing phase 0 of three cycles, and the end
        assert list(stop.get_xdata()) == pytest.approx(2 * [0.5 * 0.89])
        alone = relative_plane.draw_points(file).lines[0]
        assert alone.get_xdata() == pytest.approx(points.get_xdata())


def test_few_points_of_chaos_say_how_to_have_more(tmp_path):
    chaos = {"regime": 2, "impacts": 0, "period": 0, "observed_cycles": 1200}
    with TraceFile(with_cell(write_trace(tmp_path / "a.h5"), **chaos)) as file:
        title = figure_of(relative_plane.draw_points(file))._suptitle.get_text().replace("\n", " ")
        assert "4 points: [trace] cycles = 500 shows what they lie on" in title


def test_a_cart_at_rest_has_no_points(tmp_path):
    with TraceFile(write_trace(tmp_path / "a.h5", frequency_ratio=0.0)) as file:
        assert relative_plane.draw_points(file) is None and len(relative_plane.strobe(file)) == 0


def test_what_does_not_impact_has_no_empty_panels(tmp_path):
    path = write_trace(tmp_path / "a.h5", impacts=False)
    with h5py.File(path) as file:
        assert not file["force_ratio"][...].any()
    with SealedFile(path, "r+") as file:
        file["spectrum/force_amplitude"][...] = 0
    with TraceFile(path) as file:
        panels = [*motion.draw(file), *spectrum.draw(file)]
    assert len(panels) == 3
    assert all(np.ptp(np.asarray(ax.lines[0].get_ydata(), float)) > 0 for ax in panels)


def test_an_orbit_of_q_cycles_has_q_points():
    """From the program, at a place with z = 1/2: 4 cycles show each of its two points twice and the first once more."""
    data = peterka.run(RIG.format(kind="trace") + "[operating_point]\nfrequency_ratio = 3.5\ngap_ratio = 0.3\n", ranks=1,
                       trace__cycles=4)
    assert (int(data["cell/impacts"]), int(data["cell/period"])) == (1, 2)
    x, y = peterka.draw(data, "poincare").lines[0].get_data()
    assert len(x) == 5 and len(np.unique(np.round(x, 6))) == 2 and len(np.unique(np.round(y, 6))) == 2


@pytest.mark.parametrize("units", ["both", "si", "ratio"])
def test_the_axes_of_points_do_not_resolve_rounding(tmp_path, units):
    """The points of an orbit of one cycle are one: without a least span the velocity's axis went from its last digit to its last."""
    with TraceFile(write_trace(tmp_path / "a.h5", cycles=3, gap_ratio=0.5)) as file, style.using(units=units):
        velocity = file.motion["relative_velocity"]
        points = relative_plane.strobe(file)
        velocity[points] = 0.067 + 1e-16 * np.arange(len(points))
        low, high = relative_plane.draw_points(file).get_ylim()
    assert low < 0.067 < high and high - low >= 0.05 * np.ptp(velocity)
