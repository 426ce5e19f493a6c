"""Pictures of drawn rigs: probabilities and their lines, the commonest outcome, the lower 5 % of the forces, the band of a sweep.
test_picture_uncertain_more.py has further motions and options."""

import re

import numpy as np
import peterka
import pytest
from matplotlib.colors import to_hex, to_rgb
from peterka.errors import PeterkaFileError
from peterka.maps import uncertain_map
from peterka.maps.uncertain_map import rounded_up
from peterka.maps.map_file import PeterkaFile
from peterka.maps.outcomes import draws_of, is_class
from peterka.pictures import open_file, pictures_of
from peterka.plotting import style
from peterka.plotting.classes import CLASSES, INDEX
from peterka.plotting.figures import figure_of
from peterka.sweeps import uncertain_response
from peterka.sweeps.sweep_file import SweepFile
from picture_samples import CHAOTIC, NO_IMPACT, Drawn, colour_named, write_map
from picture_texts import faults_of_layout
from sealing import SealedFile
from sweep_samples import write_sweep
from uncertain_samples import AXES, JOB, add_outcomes, forces, probabilities, write_uncertain, write_uncertain_sweep

pytestmark = pytest.mark.thorough

ROWS, COLUMNS = 24, 32
SHARES = probabilities(ROWS, COLUMNS)  # of 1/1, no impact, 2/2, chaos
CAPTION = "64 rigs drawn: stop stiffness ±3 %, damping ratio 0.003 to 0.005 (±: standard deviation)"


def title_of(ax):
    return " ".join(ax.figure._suptitle.get_text().split())


@pytest.mark.parametrize("wanted, right", [
    ("1/1", SHARES[0]), ("chaotic", SHARES[3]), ("3/2", 0 * SHARES[0]), ("impacts", 1 - SHARES[1])])
def test_the_probability_of_any_motion_is_drawn(tmp_path, wanted, right):
    path = write_uncertain(tmp_path / "a.h5")
    with PeterkaFile(path) as file:
        ax = uncertain_map.draw_probability(file, probability=wanted)
    np.testing.assert_allclose(ax.collections[0].get_array().reshape(right.shape), right)
    assert ax.collections[0].get_clim() == (0, 1)
    assert CAPTION in title_of(ax)
    of = {"chaotic": "chaos"}.get(wanted, f"$z = {wanted}$" if "/" in wanted else wanted)
    assert f"probability of {of}" in [each.get_xlabel() for each in figure_of(ax).axes]


def test_a_motion_of_no_rig_is_not_drawn(tmp_path, draw):
    path = write_uncertain(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file["outcome_others"][:] = 0
    with PeterkaFile(path) as file:
        assert uncertain_map.draw_probability(file, probability="17/3") is None
    drawn = draw(path, "--formats", "png", "--probability", "17/3", "--only", "probability_17_3")
    assert drawn.pictures == [] and "no value to draw, probability_17_3 is left out" in drawn.stdout


def test_lines_lie_at_their_probabilities(tmp_path):
    with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file:
        ax = uncertain_map.draw_probability(file, probability="no impact")
    assert [text.get_text() for legend in ax.figure.axes if legend.get_legend() for text in legend.get_legend().get_texts()] == [
        f"probability {level}" for level in (0.5, 0.9, 0.95)]
    drawn = [line.get_xydata() for line in ax.lines]
    assert len(drawn) == 3
    for line, level in zip(drawn, (0.5, 0.9, 0.95)):
        exact = 1 - 1 / (1 + np.exp(4 * (line[:, 1] - 0.5 - 0.5 * line[:, 0])))
        assert np.abs(exact - level).max() < 0.01


@pytest.mark.parametrize("rigs, levels, words", [
    (4, [], "draws too few for a line at 0.5 (5 could), 0.9 (29 could), 0.95 (59 could)"),
    (28, [0.5], "draws too few for a line at 0.9 (29 could), 0.95 (59 could)"),
    (58, [0.5, 0.9], "draws too few for a line at 0.95 (59 could)"), (59, [0.5, 0.9, 0.95], None)])
def test_lines_are_those_that_the_draws_can_tell(tmp_path, rigs, levels, words):
    """A share s of one kind alone takes n draws with s^n below 1/20."""
    for level in (0.5, 0.9, 0.95):
        assert (level**rigs <= 0.05) == (level in levels)
    with PeterkaFile(write_uncertain(tmp_path / "a.h5", rigs=rigs)) as file:
        ax = uncertain_map.draw_probability(file, probability="no impact")
    assert len(ax.lines) == len(levels)
    assert (words in title_of(ax)) if words else ("too few" not in title_of(ax))


def test_motions_that_a_file_does_not_keep_are_told(tmp_path):
    """In the sample, each cell has the four kinds but where it has less chaos than rounding; 3/2 is never kept."""
    others, least = 1 - SHARES.sum(axis=0), SHARES.min(axis=0)
    with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file:
        told = {name: title_of(uncertain_map.draw_probability(file, probability=name)) for name in ("1/1", "3/2", "impacts")}
    assert "outcomes, the probability may" not in told["1/1"]
    assert f"where a cell has more than 4 outcomes, the probability may be up to {rounded_up(np.minimum(others, least).max())} higher" in told["3/2"]
    assert f"the probability may be up to {rounded_up(np.minimum(others, 3 * least).max())} lower" in told["impacts"]  # no impact is one of four, and kept


@pytest.mark.parametrize("bound, words", [(0.125, "0.13"), (0.12, "0.12"), (1 / 32, "0.032"), (0.1 + 0.2, "0.3"), (1.0, "1"), (0.996, "1"), (2e-5, "2e-05")])
def test_bounds_are_rounded_up(bound, words):
    assert rounded_up(bound) == words


def test_the_commonest_outcome_has_its_colour_the_paler_the_less_likely(tmp_path):
    with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file:
        drawn = Drawn(uncertain_map.draw_commonest(file), tmp_path / "a.png")
        best = SHARES.argmax(axis=0)
        for least, most, white in ((0.95, 1.0, 0.0), (0.75, 0.95, 0.3), (0.5, 0.75, 0.55), (0.0, 0.5, 0.75)):
            at = np.argwhere((best == 0) & (SHARES[0] > least + 0.02) & (SHARES[0] < most - 0.005))
            assert len(at)
            row, column = at[len(at) // 2]
            mixed = [(1 - white) * value + white for value in to_rgb(colour_named("1/1"))]
            assert drawn.colour_of(file, row, column) == to_hex(mixed).upper()
    legend = drawn.legend_texts()
    assert legend[:2] == [f"1/1 ({100 * np.mean(best == 0):.1f} %)", f"no impact ({100 * np.mean(best == 1):.1f} %)"]
    assert legend[2:] == ["≥ 0.95", "0.75–0.95", "0.5–0.75", "< 0.5", "probability 0.95, ticks point to where it is likelier"]


def test_in_grey_lightness_tells_classes_and_lines_tell_probabilities(tmp_path):
    with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file:
        drawn = Drawn(uncertain_map.draw_commonest(file, palette="grey"), tmp_path / "a.png")
        best = SHARES.argmax(axis=0)
        colours = {drawn.colour_of(file, *place) for place in np.argwhere((best == 0) & (np.abs(SHARES[0] - 0.7) < 0.1))[::5]}
        sure = {drawn.colour_of(file, 0, 31)}
    assert colours == sure
    assert drawn.legend_texts()[2:] == ["probability 0.95, ticks point to where it is likelier"]


def test_single_cells_get_no_line(tmp_path):
    shares = np.zeros((4, 12, 12))
    shares[0], shares[0, 5, 5], shares[0, :, 9:] = 0.4, 1.0, 1.0
    shares[1] = 1 - shares[0]
    path = write_uncertain(tmp_path / "a.h5", rows=12, columns=12, shares=shares)
    with PeterkaFile(path) as file:
        ax = uncertain_map.draw_probability(file, probability="1/1")
    assert [len(line.get_xdata()) for line in ax.lines] == [12, 12, 12]  # one for each probability, from end to end


def test_names_of_areas_keep_away_from_lines(tmp_path):
    with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file:
        ax = uncertain_map.draw_commonest(file)
    ax.figure.savefig(tmp_path / "a.png")
    boxes = [text.get_window_extent() for text in ax.texts]
    assert {text.get_text() for text in ax.texts} >= {"1/1"}
    for line in ax.lines:
        points = ax.transData.transform(line.get_xydata())
        between = np.concatenate([points[:-1] + (points[1:] - points[:-1]) * share for share in np.linspace(0, 1, 20)])
        assert not any(box.contains(*point) for box in boxes for point in between)


def test_the_force_of_all_but_five_per_cent(tmp_path):
    with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file:
        ax = uncertain_map.draw_force(file)
    low = forces(ROWS, COLUMNS)[0]
    np.testing.assert_allclose(ax.collections[-1].get_array().reshape(low.shape), low)
    assert CAPTION in title_of(ax) and "too few" not in title_of(ax)
    assert ax.figure.axes[1].get_xlabel() == "peak force of all but 5 % of the rigs, $F/(m\\,g)$"
    with PeterkaFile(write_uncertain(tmp_path / "few.h5", rigs=58)) as file:
        assert "58 draws are too few to assure it: 59 could" in title_of(uncertain_map.draw_force(file))


def test_a_rigid_stop_has_impact_speeds_instead(tmp_path):
    path = write_uncertain(tmp_path / "a.h5", names=("speed_q05", "speed_q50", "speed_q95"), quantiles=forces(ROWS, COLUMNS) / 100)
    with PeterkaFile(path) as file:
        ax = uncertain_map.draw_force(file)
        assert ax.figure.axes[1].get_xlabel() == "impact speed of all but 5 % of the rigs (mm/s)"
    with SweepFile(write_uncertain_sweep(tmp_path / "s.h5", names=("speed_q05", "speed_q50", "speed_q95"))) as file:
        panels = uncertain_response.draw(file)
    assert panels[0].get_ylabel() == "impact speed (m/s)"


def test_draw_makes_them_where_a_file_has_them(tmp_path, draw):
    drawn = draw(write_uncertain(tmp_path / "a.h5"), "--formats", "png", "--probability", "2/2")
    assert drawn.code == 0 and {f"a_{name}.png" for name in (
        "outcome", "force_q05", "probability_1_1", "probability_no_impact", "probability_2_2")} <= set(drawn.pictures)
    with open_file(write_uncertain(tmp_path / "b.h5")) as file:
        assert "probability_impacts" in pictures_of(file) and "probability_5_3" in pictures_of(file, probability="5/3")
    for path in (write_map(tmp_path / "c.h5"), write_sweep(tmp_path / "d.h5")):
        with open_file(path) as file:
            assert not [name for name in pictures_of(file) if name.startswith(("outcome", "force_q05", "probability", "response_of"))]
    refused = draw(tmp_path / "a.h5", "--probability", "1/0")
    assert refused.code == 2 and "'1/0' is no motion such as '3/2'" in refused.stderr
    with pytest.raises(ValueError, match="'five' is no motion such as"):
        peterka.draw(peterka.open(tmp_path / "a.h5"), "probability_five", probability="five")


def test_the_band_of_a_sweep_lies_between_its_quantiles(tmp_path, draw):
    path = write_uncertain_sweep(tmp_path / "a.h5")
    with SweepFile(path) as file:
        first, second = uncertain_response.draw(file)
        branches = file.at_gap(1.5)
    assert CAPTION in title_of(first)
    (band,) = [band.get_paths()[0].vertices for band in second.collections]  # all branches of a gap have the same
    at = np.isclose(band[:, 0], file.values[2])
    assert set(np.round(band[at, 1], 9)) == {round(share * branches[0].force[2], 9) for share in (0.8, 1.2)}
    own = [line.get_ydata() for line in second.lines]
    assert all(any(np.array_equal(line, branch.force) for line in own) for branch in branches)
    (tmp_path / "m.csv").write_text("frequency_ratio,force_ratio,gap_ratio\n2,47,0\n2,49,0\n2,31,0\n1.25,40,1.5\n9,40,1.5\n")
    told = draw(path, "--measured", tmp_path / "m.csv", "--only", "response_of_rigs", "--formats", "png")
    assert told.code == 0 and "2 of 4 measured forces lie where nine of ten drawn rigs have theirs (5 to 95 %)" in told.stdout
    assert told.pictures == ["a_response_of_rigs.png"]


def test_measured_points_lie_over_the_band_and_have_room(tmp_path):
    write_uncertain_sweep(tmp_path / "a.h5")
    point = peterka.measurements.points.Point(2.0, 90.0, None, 0.0, "", "mine")
    with SweepFile(tmp_path / "a.h5") as file:
        first, second = uncertain_response.draw(file, measured=peterka.measurements.points.Measurements([point], []))
    assert [2.0, 90.0] in [[float(line.get_xdata()[0]), float(line.get_ydata()[0])] for line in first.lines if len(line.get_xdata()) == 1]
    assert first.get_ylim()[1] > 90 > second.get_ylim()[1]
    assert [child.get_ylabel() for child in first.child_axes if child.get_ylabel()] == ["peak force (N)"]


@pytest.mark.parametrize("options", [{}, {"palette": "grey", "width": 84}])
def test_nothing_overlaps(tmp_path, monkeypatch, options):
    for path in (write_uncertain(tmp_path / "a.h5", rigs=28), write_uncertain_sweep(tmp_path / "b.h5")):
        data = peterka.open(path)
        for name in ("outcome", "force_q05", "probability_2_2") if path.stem == "a" else ("response_of_rigs",):
            drawn = peterka.draw(data, name, **options)
            assert faults_of_layout(figure_of(drawn), monkeypatch) == []


def test_a_part_and_an_unfinished_map_are_drawn(tmp_path, draw):
    path = write_uncertain(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        for name in ("regime", "outcome_regime"):
            file[name][..., 12:, :] = -128
        file["outcome_probability"][:, 12:] = np.nan
        for share in ("05", "50", "95"):
            file[f"force_q{share}_ratio"][12:] = np.nan
    outcome = draw(path, "--formats", "png", "--only", "outcome,force_q05,probability_1_1")
    assert (outcome.code, len(outcome.pictures)) == (0, 3) and "incomplete: 50.0 % computed" in outcome.stdout
    part = draw(path, "--formats", "png", "--only", "outcome", "--zoom", "1,3,0,1")
    assert part.code == 0


def test_quantiles_are_exported_in_newtons_and_outcomes_are_left_to_other_readers(tmp_path, run_program):
    path = write_uncertain(tmp_path / "a.h5")
    code, told, _ = run_program("export", path, "--as", "csv", "--output-dir", tmp_path)
    head, first = (line.split(",") for line in (tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()[:2])
    assert code == 0 and float(dict(zip(head, first))["force_q05_n"]) == pytest.approx(0.298 * 9.80665 * forces(ROWS, COLUMNS)[0, 0, 0])
    assert "left out: outcome_impacts, outcome_period, outcome_probability, outcome_regime; xarray" in told
    path = write_uncertain(tmp_path / "b.h5", names=("speed_q05", "speed_q50", "speed_q95"))
    assert run_program("export", path, "--as", "csv", "--output-dir", tmp_path)[0] == 0
    assert "speed_q95_m_s" in (tmp_path / "b.csv").read_text(encoding="utf-8").splitlines()[0].split(",")


@pytest.mark.parametrize("name, change, reason", [
    ("outcome_probability", lambda values: values + 1, "no probability"), ("outcome_regime", lambda values: values * 0 + 9, "regime 9"),
    ("outcome_period", lambda values: values[:, 1:], "outcome_period of shape"), ("force_q05_ratio", lambda values: values[1:], "shape")])
def test_damaged_content_is_refused(tmp_path, draw, name, change, reason):
    path = write_uncertain(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        values = change(file[name][()])
        del file[name]
        file[name] = values
    outcome = draw(path)
    assert outcome.code == 2 and reason in outcome.stderr and outcome.stderr.count("\n") == 1


def test_a_job_that_tells_no_rigs_is_refused(tmp_path):
    path = write_uncertain(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file.attrs["job"] = "schema = 1\n"
    with PeterkaFile(path) as file, pytest.raises(PeterkaFileError, match="doesn't tell how many rigs were drawn"):
        uncertain_map.draw_force(file)


@pytest.mark.parametrize("table, words", [
    ("[uncertainty.contact]\nstiffness_n_per_m = { relative = 0.03 }", "stop stiffness ±3 %"),
    ("[uncertainty.hammer]\nnatural_frequency_hz = { standard_deviation = 0.02 }", "natural frequency ±0.02 Hz"),
    ("[uncertainty.operating_point]\ngap_m = { standard_deviation = 8.29e-7 }", "offset of gap ±829 nm"),
    ("[uncertainty.cart]\namplitude_m = { from = 8e-4, to = 9e-4 }", "cart amplitude 0.8 to 0.9 mm"),
    ("[uncertainty.operating_point]\ngap_m = { from = -1e-4, to = 1e-4 }", "offset of gap -0.1 to 0.1 mm"),
    ('[uncertainty.covariance]\nof = ["contact.stiffness_n_per_m", "contact.damping_ns_per_m"]\nmean = [1.0, 1.0]\n'
     "matrix = [[1e8, 0.0], [0.0, 100.0]]", "stop stiffness ±10 kN/m, stop damping ±10 N s/m, together as identified"),
    ('[uncertainty.covariance]\nof = ["contact.stiffness_n_per_m"]\nmatrix = [["x"]]\n[uncertainty.contact]\nx = 3\n', ""),
    ('[uncertainty.covariance]\nof = ["contact.stiffness_n_per_m"]\nmatrix = [[-1e8]]\n', ""),
])
def test_the_caption_tells_what_is_uncertain(tmp_path, table, words):
    path = write_uncertain(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file.attrs["job"] = f"schema = 1\n[uncertainty]\nrigs = 1200\n{table}\n"
    with PeterkaFile(path) as file:
        assert draws_of(file).what == words
        assert draws_of(file).in_words.startswith("1,200 rigs drawn")


def test_classes_of_motions():
    regimes, impacts, periods = np.array([[0, 1, 1, 2, 3, 4, -128], [0, 1, 2, 0, 0, 0, 0], [1, 1, 2, 0, 1, 0, 0]])
    for wanted, right in (("impacts", [0, 1, 1, 1, 0, 0, 0]), ("no impact", [1, 0, 0, 0, 0, 0, 0]), ("2/2", [0, 0, 1, 0, 0, 0, 0]),
                          ("chaotic", [0, 0, 0, 1, 0, 0, 0])):
        assert is_class(wanted, regimes, impacts, periods).tolist() == list(map(bool, right))
    assert CLASSES[INDEX["no impact"]].label == uncertain_map.PROBABILITIES["probability_no_impact"]


def test_ticks_point_to_where_the_commonest_outcome_is_likely(tmp_path):
    """1/1 is likely below a slanting border, no impact above it: the sides of the lines are told by the probability itself."""
    for palette in ("grey", "colour"):
        with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file, style.using(palette=palette):
            ax = uncertain_map.draw_commonest(file)
            likely = file.band(["regime", "outcome_probability"], 0, file.shape[0])["outcome_probability"][0]
        ticks = [line.get_xydata() for line in ax.lines if line.get_gid() == uncertain_map.TICKS]
        assert len(ticks) > 4
        higher = 0
        for own, end in ticks:  # in shares of the picture
            (row, column), (row2, column2) = ((int(place[1] * likely.shape[0]), int(place[0] * likely.shape[1])) for place in (end, 2 * own - end))
            higher += likely[row, column] > likely[row2, column2]
        assert higher == len(ticks)
        words = [text.get_text() for each in ax.figure.axes if each.get_legend() for text in each.get_legend().get_texts()]
        assert any("ticks point to where it is likelier" in word for word in words)


def test_zero_is_apart_from_small_forces(tmp_path):
    with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file, style.using(units="si"):
        ax = uncertain_map.draw_force(file)
        low = file.band(["regime", "force_q05_ratio"], 0, file.shape[0])["force_q05_ratio"]
        words = [text.get_text() for each in ax.figure.axes if each.get_legend() for text in each.get_legend().get_texts()]
        on_scale = ax.collections[-1].get_array().reshape(low.shape)
    assert "0: more than 5 % of the rigs don't impact, or fail" in words and (low == 0).any()
    assert np.array_equal(np.ma.getmaskarray(on_scale), low == 0)


def test_the_response_says_where_rigs_begin(tmp_path, draw):
    points = tmp_path / "points.csv"
    points.write_text("frequency_hz,gap_mm,force_n\n6.0,0,60\n")
    path = write_uncertain_sweep(tmp_path / "a.h5")
    outcome = draw(path, "--only", "response_of_rigs", "--measured", points, "--format", "svg")
    told = "drawn rigs begin from [start], branches with the motion at the point before"
    assert told in outcome.stdout
    assert told in re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", (tmp_path / "out" / "a_response_of_rigs.svg").read_text()))


@pytest.mark.parametrize("motion", ["1/1", "impacts"])
def test_a_probability_is_refused_where_no_rigs_were_drawn(tmp_path, draw, motion):
    """Also that of the default, where it is asked for; in Python, too."""
    path = write_map(tmp_path / "one.h5")
    outcome = draw(path, "--formats", "png", "--probability", motion)
    assert outcome.code == 2 and outcome.pictures == [] and "was computed for one rig alone, so that no motion has a probability" in outcome.stderr
    with pytest.raises(peterka.PeterkaFileError, match="one rig alone"):
        peterka.draw(peterka.open(path), "map", probability=motion)
    sweep = draw(write_sweep(tmp_path / "s.h5"), "--formats", "png", "--probability", motion)
    assert sweep.code == 2 and "is of kind sweep; the probability of a motion is told of a map" in sweep.stderr
    assert draw(path, "--formats", "png", "--only", "map").code == 0


def test_chaos_that_is_less_likely_does_not_look_like_no_impact(tmp_path):
    """Both are pale greys there: chaos has dots, in the legend, too."""
    cells = np.broadcast_to((2, 0, 0), (6, 8, 3))
    path = write_map(tmp_path / "a.h5", cells, job=JOB.format(rigs=64, axes=AXES.format(8, 6)))
    add_outcomes(path, np.broadcast_to(np.array([CHAOTIC, NO_IMPACT])[:, None, None], (2, 6, 8, 3)), 
                 np.stack([np.full((6, 8), 0.4), np.full((6, 8), 0.3)]), np.zeros((3, 6, 8)))
    with PeterkaFile(path) as file:
        drawn = Drawn(uncertain_map.draw_commonest(file), tmp_path / "a.png")
    height, width = drawn.pixels.shape[:2]
    (x0, y0), (x1, y1) = (drawn.figure.transFigure.inverted().transform(drawn.map_axes.transAxes.transform(corner)) for corner in ((0.2, 0.2), (0.8, 0.8)))
    part = drawn.pixels[int((1 - y1) * height):int((1 - y0) * height), int(x0 * width):int(x1 * width)].mean(axis=2)
    assert np.ptp(part) > 60 and 0.05 < (part < part.max() - 30).mean() < 0.6
    patches = {text.get_text().partition(" (")[0]: patch.get_hatch() for one in drawn.figure.axes if one.get_legend()
               for text, patch in zip(one.get_legend().get_texts(), one.get_legend().get_patches())}
    assert patches["chaotic"]
