"""Pictures of traces: numbers at the right place and in SI units, omission of what a file lacks."""

import h5py
import numpy as np
import pytest
from peterka import rig_sketch
from peterka.pictures import open_file, pictures_of
from peterka.plotting import axes
from peterka.plotting.figures import figure_of
from peterka.traces import impact, motion, phase_plane, spectrum
from peterka.traces.trace_file import TraceFile
from trace_samples import AMPLITUDE, CONTACT, HZ, JUMP, PEAK, TOUCH, WEIGHT, write_trace
from sealing import SealedFile

pytestmark = pytest.mark.thorough


def drawn(path, picture, tmp_path):
    with TraceFile(path) as file:
        figure = figure_of(picture.draw(file))
    axes.save(figure, tmp_path / "a.png")
    return figure


def line(ax, number):
    return (np.asarray(values, float) for values in ax.lines[number].get_data())


def texts(figure):
    return [text.get_text() for ax in figure.axes for text in ax.texts]


@pytest.mark.parametrize("units, place", [("both", "9 Hz (Ω/ω = 2), gap 0.222 mm"), ("si", "9 Hz, gap 0.222 mm"),
                                          ("ratio", "Ω/ω = 2, gap/A₀ = 0.25")])
def test_the_title_has_the_units_of_the_picture(tmp_path, units, place):
    with TraceFile(write_trace(tmp_path / "a.h5", gap_ratio=0.25)) as file:
        assert place in figure_of(motion.draw(file, units=units))._suptitle.get_text().split("\n")


def test_a_trace_gives_six_pictures(tmp_path, draw):
    outcome = draw(write_trace(tmp_path / "strike.h5"), "--formats", "png")
    assert outcome.code == 0, outcome.stderr
    assert outcome.pictures == [f"strike_{name}.png" for name in (
        "impact", "motion", "phase_plane", "poincare", "relative_plane", "spectrum")]


def test_displacements_are_in_mm_and_forces_in_newtons(tmp_path):
    path = write_trace(tmp_path / "a.h5")
    displacements, acceleration, force = drawn(path, motion, tmp_path).axes[:3]
    time, hammer = line(displacements, 0)
    np.testing.assert_allclose(hammer, 1000 * AMPLITUDE * (-2 + np.cos(2 * np.pi * HZ * time)))
    assert len(displacements.lines) == 2  # at gap 0 the stop coincides with the cart
    assert "mm" in displacements.get_ylabel() and "(N)" in force.get_ylabel() and "m/s²" in acceleration.get_ylabel()
    with h5py.File(path) as file:
        samples = np.stack([file["time"][()], file["force_ratio"][()] * WEIGHT], axis=1)
        touches = file["impacts/touch_time"][()]
        zeros, jumps = (np.stack([touches, 3 * [height * WEIGHT]], axis=1) for height in (0, JUMP))
        sampled = samples[np.searchsorted(samples[:, 0], touches + 1e-4), 0]  # one in each contact
        peaks = np.stack([sampled, 3 * [PEAK * WEIGHT]], axis=1)
        points = np.concatenate([zeros, jumps, samples, peaks])  # in this order where they have the same time
        np.testing.assert_allclose(np.stack(list(line(force, 0)), axis=1), points[np.argsort(points[:, 0], kind="stable")])
        np.testing.assert_allclose(list(line(force, 1))[1], 3 * [PEAK * WEIGHT])
        np.testing.assert_allclose(list(line(acceleration, 0))[1], file["hammer_acceleration"][()])
    assert force.get_xlabel() == "time (s)" and displacements.get_xlim() == (0, pytest.approx(3 / HZ))


def test_the_stop_moves_with_the_cart(tmp_path):
    displacements = drawn(write_trace(tmp_path / "a.h5", gap_ratio=1.5), motion, tmp_path).axes[0]
    np.testing.assert_allclose(list(line(displacements, 2))[1],
                               list(line(displacements, 1))[1] + 1500 * AMPLITUDE)


def test_a_far_stop_is_left_out(tmp_path):
    figure = drawn(write_trace(tmp_path / "a.h5", impacts=False, gap_ratio=50.0), motion, tmp_path)
    assert len(figure.axes[0].lines) == 2


def test_the_phase_plane_marks_cycles_and_first_touches(tmp_path):
    figure = drawn(write_trace(tmp_path / "a.h5"), phase_plane, tmp_path)
    ax = figure.axes[0]
    displacement, velocity = line(ax, 1)
    np.testing.assert_allclose(displacement, 4 * [-1000 * AMPLITUDE])
    np.testing.assert_allclose(velocity, 0, atol=1e-12)
    displacement, velocity = line(ax, 2)
    angle = 2 * np.pi * HZ * TOUCH
    np.testing.assert_allclose(displacement, 3 * [1000 * AMPLITUDE * (-2 + np.cos(angle))], rtol=1e-3)
    np.testing.assert_allclose(velocity, 3 * [-0.05 * np.sin(angle)], rtol=1e-2)


def test_the_impact_names_its_peak_and_its_jump(tmp_path):
    figure = drawn(write_trace(tmp_path / "a.h5"), impact, tmp_path)
    milliseconds, force = line(figure.axes[0], 0)
    peak = np.argmax(force)
    assert (milliseconds[peak], force[peak]) == pytest.approx((1000 * CONTACT / 3, PEAK * WEIGHT), rel=1e-2)
    assert f"peak {PEAK * WEIGHT:.4g} N\nafter {1000 * CONTACT / 3:.3g} ms" in texts(figure)
    assert f"jump to\n{JUMP * WEIGHT:.4g} N" in texts(figure)
    assert milliseconds[0] == pytest.approx(-1) and milliseconds[-1] == pytest.approx(2)


def test_without_impacts_there_is_no_picture_of_one(tmp_path, draw):
    outcome = draw(write_trace(tmp_path / "free.h5", impacts=False), "--formats", "png")
    assert outcome.code == 0, outcome.stderr
    assert outcome.pictures == [f"free_{name}.png" for name in (
        "motion", "phase_plane", "poincare", "relative_plane", "spectrum")]
    assert "impact is left out" in outcome.stdout


def test_spectra_keep_their_numbers(tmp_path):
    figure = drawn(write_trace(tmp_path / "a.h5"), spectrum, tmp_path)
    frequency, amplitude = line(figure.axes[0], 0)
    np.testing.assert_allclose(frequency, HZ * np.arange(1, 50))
    np.testing.assert_allclose(amplitude, 1 / (1 + np.arange(1, 50)))
    assert [ax.get_title() for ax in figure.axes] == [
        "whole motion", "whole motion", "hardest impact alone", "flight after it"]


def test_a_cart_at_rest_has_natural_periods(tmp_path):
    figure = drawn(write_trace(tmp_path / "a.h5", frequency_ratio=0.0), motion, tmp_path)
    assert "cart at rest" in figure._suptitle.get_text()
    assert "natural periods" in [child.get_xlabel() for child in figure.axes[0].child_axes]


def replaced(path, name, values):
    with SealedFile(path, "r+") as file:
        del file[name]
        if values is not None:
            file[name] = values
    return path


@pytest.mark.parametrize("name, values, message", [
    ("force_ratio", None, "no dataset force_ratio"),
    ("force_ratio", np.zeros(7), "shape (7,)"),
    ("hammer_velocity", np.full(601, np.nan), "hammer_velocity that is not finite"),
    ("time", np.zeros(601), "time that does not ascend"),
    ("impact/impact", np.int32(3), "an impact closely that its list does not have"),
    ("spectrum/frequency", np.zeros((3, 3)), "spectrum/frequency of shape (3, 3)"),
])
def test_a_damaged_trace_is_refused(tmp_path, draw, name, values, message):
    outcome = draw(replaced(write_trace(tmp_path / "a.h5"), name, values))
    assert outcome.code == 2 and message in outcome.stderr


def test_without_its_peak_force_an_impact_has_no_peak_named(tmp_path):
    figure = drawn(replaced(write_trace(tmp_path / "a.h5"), "impact/peak_force_ratio", None), impact, tmp_path)
    assert not any(text.get_text().startswith("peak") for text in figure.axes[0].texts)


def test_the_sketch_of_the_rig_names_its_coordinates():
    """As in the README; no text leaves it or overlaps another."""
    figure = rig_sketch.draw()
    figure.canvas.draw()
    texts = [text for text in figure.axes[0].texts]
    words = " ".join(text.get_text() for text in texts)
    assert all(name in words for name in ("$x$", "$y=A_0", "$u = x - y$", "gap", "$F$", "$k_i$", "$c_i$"))
    boxes = [text.get_window_extent() for text in texts]
    assert all(figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1 and box.y1 <= figure.bbox.y1 for box in boxes)
    assert not any(one.overlaps(other) for n, one in enumerate(boxes) for other in boxes[:n])


def test_spectra_in_a_narrow_picture_have_room_for_their_ticks(tmp_path):
    """Those of 8 kHz need 2 in: side by side in a column of a journal they had two ticks."""
    with open_file(write_trace(tmp_path / "a.h5")) as file:
        for width in (84, None):
            panels = pictures_of(file)["spectrum"](file, width=width)
            figure_of(panels).draw_without_rendering()
            assert all(ax.bbox.width / figure_of(panels).dpi > 1.8 for ax in panels)


@pytest.mark.parametrize("times, words", [(0.5, "on the way to the steady motion, whose peak is"), (1.0, "the peak of the steady motion"),
                                          (2.0, "; peak of the steady motion")])
def test_a_trace_tells_the_peak_of_the_steady_motion_from_that_of_the_way_to_it(tmp_path, times, words):
    path = write_trace(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        hardest = float(np.nanmax(file["impacts/peak_force_ratio"][...]))
        for name, value in {"regime": np.int8(1), "impacts": np.int32(1), "period": np.int32(1), "status": np.int8(0),
                            "observed_cycles": np.int32(0), "multiplier": 0.1, "lyapunov": np.nan, "peak_force_ratio": times * hardest}.items():
            file[f"cell/{name}"] = value
        file["cell/status"].attrs.update({"flag_values": np.array([0], dtype="i1"), "flag_meanings": "verified"})
    with TraceFile(path) as file:
        for picture in (motion, impact):
            title = " ".join(figure_of(picture.draw(file, units="si"))._suptitle.get_text().split())
            assert f"hardest impact {hardest * WEIGHT:.4g} N" in title and words in title
            assert times == 1 or f"{times * hardest * WEIGHT:.4g} N" in title
    with SealedFile(path, "r+") as file:
        file["impacts/peak_force_ratio"][-1] = np.nan
    with TraceFile(path) as file:
        title = " ".join(figure_of(motion.draw(file, units="si"))._suptitle.get_text().split())
        steady = f"peak of the steady motion {times * hardest * WEIGHT:.4g} N"
        assert words in title if times <= 1 else title.endswith(steady) and "hardest" not in title  # the one that is cut may be harder


def shaped(path, contact, cut=False):
    """A trace whose contacts last so long, over many samples; cut: the last one by the end of the trace, and so not known."""
    write_trace(path, cycles=2, samples=400)
    with SealedFile(path, "r+") as file:
        time = file["motion/time" if "motion" in file else "time"]
        times = time[...]
        since = np.mod(times - TOUCH + 1e-12, 1 / HZ)
        forces = np.where((since < contact) & (times > TOUCH - 1e-9), np.interp(since, [0, contact / 3, contact], [JUMP, PEAK, 0]), 0)
        file["force_ratio"][...] = forces
        file["impacts/contact_time"][...] = contact
        if cut:
            for name in ("peak_force_ratio", "contact_time", "impulse", "work"):
                file[f"impacts/{name}"][-1] = np.nan
    return path


@pytest.mark.parametrize("contact", [1e-5, 1e-3, 0.03])
def test_a_force_jumps_at_the_touch_and_has_its_peak_later(tmp_path, contact):
    panel = drawn(shaped(tmp_path / "a.h5", contact), motion, tmp_path).axes[2]
    times, forces = line(panel, 0)
    peaks, heights = line(panel, 1)
    touches = TOUCH + np.arange(2) / HZ
    assert heights == pytest.approx([PEAK * WEIGHT] * 2)
    assert peaks == pytest.approx(touches + contact / 3 * (contact > 1e-4), abs=1.1 / (400 * HZ))
    assert np.all(np.diff(times) >= 0)
    for touch in touches:
        at = np.flatnonzero(times == touch)
        assert list(forces[at][:2]) == pytest.approx([0, JUMP * WEIGHT])
        pressed = forces[(times >= touch) & (times <= touch + contact)]
        risen = np.diff(pressed[1:])
        assert np.sum((risen[:-1] > 1e-9) & (risen[1:] < -1e-9)) <= 1, "one maximum"


@pytest.mark.parametrize("jump", [JUMP, 0.0])
def test_an_impact_that_the_end_of_the_trace_cuts_has_no_peak(tmp_path, jump):
    """Without a jump, too: a stop without damping isn't rigid."""
    path = shaped(tmp_path / "a.h5", 0.03, cut=True)
    with SealedFile(path, "r+") as file:
        file["impacts/touch_force_ratio"][...] = jump
    figure = drawn(path, motion, tmp_path)
    peaks, _ = line(figure.axes[2], 1)
    assert len(peaks) == 1 and np.isfinite(list(line(figure.axes[2], 0))[1]).all()
    assert "peak of an impact" in legend_of(figure)
    with SealedFile(path, "r+") as file:
        file["impacts/peak_force_ratio"][...] = np.nan
    figure = drawn(path, motion, tmp_path)
    assert "force" in figure.axes[2].get_ylabel() and not any("of an impact" in text for text in legend_of(figure))


def legend_of(figure):
    return [text.get_text() for legend in [*figure.legends, *(ax.get_legend() for ax in figure.axes)] if legend for text in legend.get_texts()]


def test_a_peak_after_the_end_of_the_trace_is_not_shown(tmp_path):
    """That of a release is known beyond the end."""
    path = shaped(tmp_path / "a.h5", 0.03)
    with SealedFile(path, "r+") as file:
        end = TOUCH + 1 / HZ + 0.008
        times = file["time"][...] * end / file["time"][-1]
        file["time"][...] = times
        since = np.mod(times - TOUCH + 1e-12, 1 / HZ)
        file["force_ratio"][...] = np.where((since < 0.03) & (times > TOUCH - 1e-9), np.interp(since, [0, 0.01, 0.03], [JUMP, PEAK, 0]), 0)
    peaks, _ = line(drawn(path, motion, tmp_path).axes[2], 1)
    assert len(peaks) == 1 and peaks[0] < 0.04


def test_impacts_on_a_rigid_stop_have_speeds_instead_of_forces(tmp_path):
    path = write_trace(tmp_path / "a.h5", rigid=True)
    figure = drawn(path, motion, tmp_path)
    speeds = figure.axes[2]
    assert speeds.get_ylabel() == "impact speed (m/s)" and speeds.get_ylim()[0] == 0
    np.testing.assert_allclose(list(line(speeds, 0)), [TOUCH + np.arange(3) / HZ, 3 * [0.3]])
    words = [text.get_text() for ax in figure.axes if ax.get_legend() for text in ax.get_legend().get_texts()]
    assert "speed of an impact" in words and not any("force" in ax.get_ylabel() for ax in figure.axes)
    velocity, acceleration = drawn(path, impact, tmp_path).axes[:2]
    with h5py.File(path) as file:
        np.testing.assert_allclose(list(line(velocity, 0))[1], file["impact/relative_velocity"][()])
    assert "(m/s)" in velocity.get_ylabel() and "m/s²" in acceleration.get_ylabel()
