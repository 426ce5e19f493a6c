"""Pictures of a sweep: panels, directions, jumps and resonances with their numbers, bifurcation diagrams."""

import numpy as np
import pytest
from colour_distance import deuteranope_sight, difference, normal_sight
from matplotlib.colors import to_rgb
from peterka.errors import PeterkaFileError
from peterka.plotting.classes import CLASSES, SECOND_COLOURS
from peterka.plotting.figures import figure_of
from peterka.sweeps import bifurcation, every_attractor, response
from peterka.measurements import marks
from peterka.measurements.points import Measurements, Point
from peterka.sweeps.sweep_file import SweepFile
from peterka.sweeps.borders import Border
from peterka.sweeps.sweep_panels import LOOKS, place_text
from sealing import SealedFile
from sweep_samples import WEIGHT, write_sweep, write_sweep_with_starts

pytestmark = pytest.mark.thorough

NOTHING = Measurements([], [])


def panels_of(figure, gaps=2):
    return figure.axes[:gaps]


def texts(ax):
    return [text.get_text() for text in ax.texts if text.get_text()]


def lines_of(ax, colour):
    return [line for line in ax.lines if line.get_color() == colour and len(line.get_xdata()) > 2]


def legend_texts(figure):
    return [text.get_text() for ax in figure.axes if ax.get_legend() for text in ax.get_legend().get_texts()]


def test_a_panel_for_each_gap_with_hertz_newtons_and_millimetres(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        figure = figure_of(response.draw(file))
    panels = panels_of(figure)
    assert [texts(ax)[0] for ax in panels] == ["gap/A₀ = 0 (0 mm)", "gap/A₀ = 1.5 (1.33 mm)"]
    assert panels[1].get_xlabel() == r"$\Omega/\omega$"
    labels = [child.get_xlabel() or child.get_ylabel() for ax in panels for child in ax.child_axes]
    assert [label for label in labels if label] == ["excitation frequency (Hz)", "peak force (N)", "peak force (N)"]


def test_neighbouring_points_and_places_half_way_have_texts_of_their_own(tmp_path):
    """A jump lies half-way: with four digits its place was 20.92 Hz in the summary and 20.91 Hz in the picture."""
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        for values in (np.linspace(0.5, 4.5, 401), np.linspace(2.49, 2.51, 301), np.geomspace(0.01, 9.99, 5001)):
            file.values = values
            places = [*values, *(values[1:] + values[:-1]) / 2]
            assert len({place_text(file, place) for place in places}) == len(places)


def test_a_place_half_way_in_hertz_is_rounded_as_in_the_summary(tmp_path):
    """From its ratio 20.375 Hz came back as 20.374999..., 20.37 Hz, which the summary calls 20.38 Hz."""
    with SweepFile(write_sweep(tmp_path / "a.h5", natural_frequency_hz=22.0, job="[axes.frequency_hz]\nfrom = 15.0\n")) as file:
        file.values = np.linspace(15, 60, 181) / 22
        middles = (file.values[1:] + file.values[:-1]) / 2
        told = [place_text(file, middle).split()[0] for middle in middles]
    assert told == [f"{15.125 + 0.25 * n:.4g}" for n in range(180)]


@pytest.mark.parametrize("draw", [response.draw, bifurcation.draw])
def test_in_si_alone_every_panel_has_ticks_and_grid_at_round_numbers_of_these_units(tmp_path, draw):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        figure = figure_of(draw(file, units="si"))
        figure.canvas.draw()
        factors = {"x": 4.5, "y": WEIGHT if draw is response.draw else 0.89}
    panels = panels_of(figure)
    for side in "xy":
        for ax in panels:
            axis = getattr(ax, f"{side}axis")
            low, high = sorted(axis.get_view_interval())
            lines = [line for line, at in zip(axis.get_gridlines(), axis.get_ticklocs()) if low <= at <= high]
            assert axis.get_visible() and len(lines) > 1 and all(line.get_visible() for line in lines)
            numbers = axis.get_ticklocs() * factors[side]
            assert np.allclose(numbers, np.round(numbers, 2))
    assert np.array_equal(*(ax.get_xticks() for ax in panels))
    shown = [label.get_text() for label in panels[1].get_xticklabels()]
    assert shown == [f"{round(at * 4.5, 6):g}" for at in panels[1].get_xticks()]


@pytest.mark.parametrize("units, air", [("both", 16), ("si", 3), ("ratio", 3)])
def test_a_gap_stands_above_a_scale_only_where_there_is_one(tmp_path, units, air):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        panels = panels_of(figure_of(response.draw(file, units=units)))
    assert [ax.texts[0].get_position()[1] for ax in panels] == [air, 3]


def test_directions_differ_in_line_and_brightness(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        figure = figure_of(response.draw(file))
    up, down = (lines_of(panels_of(figure)[0], response.LOOKS[name].colour)[0] for name in ("up", "down"))
    assert up.get_linestyle() == "-" and down.get_linestyle() != "-"
    assert legend_texts(figure)[:5] == ["frequency rising", "no period, frequency rising", "frequency falling", "no period, frequency falling",
                                        "impact resonance ($z = 1/1$)"]


def test_lines_end_at_jumps_and_motions_without_a_period_are_marks(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        figure = figure_of(response.draw(file))
    ax = panels_of(figure)[1]
    line = lines_of(ax, response.LOOKS["up"].colour)[0]
    x, y = line.get_data()
    cut = np.flatnonzero(np.isnan(x))
    assert cut.tolist() == [7] and x[6] == 1.75 and x[8] == 1.875
    assert np.isnan(y[-2:]).all()
    marks = [line for line in ax.lines if line.get_linestyle() == "None" and len(line.get_xdata()) == 2]
    assert marks and marks[0].get_ydata().tolist() == [25, 25]


def test_jumps_and_resonance_carry_their_numbers(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        figure = figure_of(response.draw(file))
    first, second = panels_of(figure)
    assert texts(first)[1:] == [f"★ 40 = {40 * WEIGHT:.4g} N at 2 (9 Hz)"]
    # up jumps between 1.75 and 1.875, down between 1.625 and 1.5
    assert sorted(texts(second)[1:]) == [
        "1.562 (7.031 Hz)", "1.812 (8.156 Hz)", f"■ 50 = {50 * WEIGHT:.4g} N at 1.5 (6.75 Hz)",
        f"■ 60 = {60 * WEIGHT:.4g} N at 1.75 (7.875 Hz)"]


@pytest.mark.parametrize("units, job, told", [
    ("both", "", ["gap/A₀ = 0 (0 mm)", f"★ 40 = {40 * WEIGHT:.4g} N at 2 (9 Hz)"]),
    ("both", "[axes.frequency_hz]\nfrom = 4.5\n", ["gap = 0 mm (gap/A₀ = 0)", f"★ {40 * WEIGHT:.4g} N = 40 at 9 Hz (2)"]),
    ("si", "", ["gap = 0 mm", f"★ {40 * WEIGHT:.4g} N at 9 Hz"]),
    ("ratio", "[axes.frequency_hz]\nfrom = 4.5\n", ["gap/A₀ = 0", "★ 40 at 2"])])
def test_words_lead_with_the_unit_of_the_job(tmp_path, units, job, told):
    with SweepFile(write_sweep(tmp_path / "a.h5", job=job)) as file:
        assert texts(panels_of(figure_of(response.draw(file, units=units)))[0]) == told


def test_a_jump_looks_like_no_border_in_the_legend(tmp_path):
    """Grazings are dotted, too."""
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        figure = figure_of(response.draw(file, borders=[Border(2.0, 1.5, "grazing", 1, 1)]))
    legend, = (ax.get_legend() for ax in figure.axes if ax.get_legend())
    handles = legend.legendHandles if hasattr(legend, "legendHandles") else legend.legend_handles  # before matplotlib 3.7, and since
    looks = {text.get_text(): handle for text, handle in zip(legend.get_texts(), handles)}
    assert (looks["jump"].get_marker(), looks["grazing"].get_marker()) == (">", "None")


def test_notes_of_a_falling_branch_are_black_in_grey(tmp_path):
    """Its own colour would be a pale grey."""
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        panels = panels_of(figure_of(response.draw(file, palette="grey")))
    notes = [text for ax in panels for text in ax.texts if "Hz" in text.get_text()]
    assert "1.562 (7.031 Hz)" in [text.get_text() for text in notes]
    assert {to_rgb(text.get_color()) for text in notes} == {(0.0, 0.0, 0.0)}


def test_the_legend_names_what_limits_leave(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        figure = figure_of(response.draw(file, limits=(1.0, 22.0)))  # below chaos, at 25 weights, and the largest of 1/1
    assert legend_texts(figure)[:3] == ["frequency rising", "frequency falling", "jump"]


def test_only_a_maximum_inside_the_band_is_a_resonance(tmp_path):
    """At gap 0 it is; at 1.5 both branches are cut off by a jump."""
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        assert [branch.is_resonance(branch.strongest_single()) for branch in file.branches] == [True, True, False, False]
        figure = figure_of(response.draw(file))
    assert legend_texts(figure)[4:6] == ["impact resonance ($z = 1/1$)", "largest of $z = 1/1$, cut off"]
    cut = write_sweep(tmp_path / "b.h5", gaps=(0.0,))
    with SealedFile(cut, "r+") as file:
        file["peak_force_ratio"][0] = np.linspace(20, 40, 13)  # it rises to the end of the sweep
        file["impacts"][1, 9] = 2  # 2/1 next to the largest
    with SweepFile(cut) as file:
        assert [branch.is_resonance(branch.strongest_single()) for branch in file.branches] == [False, False]


@pytest.mark.parametrize("sight, distance, from_second", [(normal_sight, 14, 12.7), (deuteranope_sight, 9.5, 8.8)])
def test_lines_and_marks_have_the_colours_of_no_class(sight, distance, from_second):
    lines = {look.colour for look in LOOKS.values()} | {dots[0] for dots in bifurcation.DOTS.values()}
    for colour in lines:
        for entry in CLASSES:
            smallest = from_second if entry.colour in SECOND_COLOURS else distance
            assert difference(sight(colour), sight(entry.colour)) > smallest, (colour, entry.label)
    first, second = (LOOKS[name].colour for name in ("up", "down"))
    assert difference(sight(first), sight(second)) > distance
    assert set(marks.FACES) <= {"white", "black", "#AAAAAA"}


def test_without_rig_there_are_ratios_alone(tmp_path):
    path = write_sweep(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        for name in ("natural_frequency_hz", "cart_amplitude_m", "hammer_mass_kg"):
            del file.attrs[name]
    with SweepFile(path) as file:
        figure = figure_of(response.draw(file))
    assert texts(panels_of(figure)[0]) == ["gap/A₀ = 0", "★ 40 at 2"]


def test_bifurcation_diagrams_show_every_sample(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        figure = figure_of(bifurcation.draw(file, name="stroboscopic_displacement"))
        impacts = figure_of(bifurcation.draw(file, name="impact_displacement"))
    up = panels_of(figure)[1].lines[0]
    assert len(up.get_xdata()) == 11 + 2 * 4
    assert sorted(up.get_ydata()[np.isclose(up.get_xdata(), 2.5)]) == [-4, -3, -2, -1]
    assert len(panels_of(impacts)[1].lines[0].get_xdata()) == 9
    assert legend_texts(figure)[:2] == ["frequency rising", "frequency falling"]


@pytest.mark.parametrize("change, marked", [(1e-9, False), (1e-4, True)])
def test_no_point_is_the_strongest_where_rounding_decides(tmp_path, change, marked):
    path = write_sweep(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        force = file["peak_force_ratio"]
        force[:2] = 40 * (1 + change * np.cos(np.arange(force.shape[1])))
    with SweepFile(path) as file:
        assert [branch.strongest_single() is not None for branch in file.at_gap(0.0)] == [marked, marked]
        assert all(branch.strongest_single() is not None for branch in file.at_gap(1.5))


@pytest.mark.parametrize("change, magnified", [(1e-9, False), (1e-4, True)])
def test_a_bifurcation_diagram_does_not_magnify_rounding(tmp_path, change, magnified):
    path = write_sweep(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        touched = file["impact_displacement"][()]
        file["impact_displacement"][...] = touched * (1 + change * np.linspace(0, 1, touched.shape[1])[:, None])
    with SweepFile(path) as file:
        low, high = panels_of(figure_of(bifurcation.draw(file, name="impact_displacement")))[0].get_ylim()
    assert low < 0.5 < high
    assert (high - low < 1e-3) == magnified and (high - low > 0.05) != magnified


def test_branches_with_their_own_starts_at_one_gap(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5", gaps=(1.5,), directions=(2,))) as file:
        figure = figure_of(response.draw(file))
        assert file.branches[0].direction == "independent"
    assert legend_texts(figure)[0] == "each from the start"


def test_measured_points_lie_over_both_pictures(tmp_path):
    measured = Measurements([Point(2.0, 38.0, None, 0.0, "measured"), Point(1.5, None, None, None, "edge"),
                             Point(1.25, None, -3.0, 1.5, "")], [])
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        first, second = panels_of(figure_of(response.draw(file, measured=measured)))
        below = panels_of(figure_of(bifurcation.draw(file, measured=measured)))[1]
    assert "measured" in texts(first) and "edge" in texts(first) and "edge" in texts(second)
    assert "measured" not in texts(second)
    assert [-3.0] in [line.get_ydata().tolist() if hasattr(line.get_ydata(), "tolist") else list(line.get_ydata())
                      for line in below.lines]


def test_an_unfinished_sweep_says_so(tmp_path, draw):
    path = write_sweep(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file["regime"][3] = -128
        file["jump"][3] = -128
        file["peak_force_ratio"][3] = np.nan
    outcome = draw(path, "--formats", "png")
    assert (outcome.code, outcome.pictures) == (0, ["a_bifurcation.png", "a_bifurcation_impact.png", "a_response.png"])
    assert "incomplete: 75.0 % computed" in outcome.stdout


@pytest.mark.parametrize("name, values", [
    ("frequency_ratio", np.linspace(2, 1, 13)), ("direction", np.array([0, 1, 2, 7], dtype="i1")),
    ("regime", np.full((4, 13), 9, dtype="i1")), ("jump", np.full((4, 13), 5, dtype="i1")),
    ("peak_force_ratio", np.zeros((4, 12))), ("stroboscopic_displacement", np.zeros((4, 13))),
    ("gap_ratio", np.full(4, np.nan)),
])
def test_damaged_content_is_refused(tmp_path, name, values):
    path = write_sweep(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        del file[name]
        file[name] = values
    with pytest.raises(PeterkaFileError, match=name if name != "stroboscopic_displacement" else "shape"):
        SweepFile(path)


def dots_of(ax):
    return [line for line in ax.lines if line.get_color() == every_attractor.COLOUR]


def test_every_attractor_is_drawn_thin_below_the_branches(tmp_path):
    with SweepFile(write_sweep_with_starts(tmp_path / "a.h5")) as file:
        figure = figure_of(response.draw(file))
        diagram = figure_of(bifurcation.draw(file))
    ax = panels_of(figure)[1]
    dots, = dots_of(ax)
    up = lines_of(ax, LOOKS["up"].colour)[0]
    assert dots.get_zorder() < up.get_zorder() and dots.get_markersize() < up.get_linewidth()
    x, y = dots.get_data()
    assert x[y == 70].tolist() == file.values[:6].tolist()
    assert ax.get_ylim()[1] > 70  # no branch has more than 60
    samples, = dots_of(panels_of(diagram)[1])
    assert np.sum(np.asarray(samples.get_ydata()) == -9) == 6
    for drawn in (figure, diagram):
        assert "attractors that are known" in legend_texts(drawn)


def test_a_sweep_whose_branches_never_impact_shows_what_starts_find(tmp_path):
    write_sweep_with_starts(tmp_path / "a.h5")
    with SealedFile(tmp_path / "a.h5", "r+") as file:
        file["peak_force_ratio"][...] = 0
        file["regime"][...], file["jump"][...] = 0, 0
        force = file["attractor_peak_force_ratio"][()]
        force[0] = 0
        file["attractor_peak_force_ratio"][...] = force
    with SweepFile(tmp_path / "a.h5") as file:
        ax = panels_of(figure_of(response.draw(file)))[1]
    assert ax.get_ylim()[1] > 70 and (dots_of(ax)[0].get_ydata() == 70).sum() == 6


def test_a_sweep_without_starts_has_none_of_it(tmp_path):
    with SweepFile(write_sweep(tmp_path / "a.h5")) as file:
        assert file.slots == 0
        figure = figure_of(response.draw(file))
    assert not dots_of(panels_of(figure)[1])
    assert "attractors that are known" not in legend_texts(figure)


def test_attractors_of_another_shape_are_refused(tmp_path):
    write_sweep_with_starts(tmp_path / "a.h5")
    with SealedFile(tmp_path / "a.h5", "r+") as file:
        del file["basin_share"]
        file["basin_share"] = np.zeros((2, 3, 5))
    with pytest.raises(PeterkaFileError):
        SweepFile(tmp_path / "a.h5")
