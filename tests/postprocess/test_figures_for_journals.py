"""Journal requirements for pictures: a column's width, distinguishable greys, units, parts, formats."""

from itertools import combinations

import numpy as np
import pytest
from attractor_samples import write_attractors
from colour_distance import lightness
from curves_samples import write_curves, write_distances
from matplotlib.colors import to_hex
from matplotlib.image import imread
from matplotlib.text import Text
from peterka.cli import draw
from peterka.cli.picture_options import zoomed
from peterka.plotting import figures, fills, style
from peterka.plotting.classes import SECOND_COLOURS
from peterka.plotting.figures import figure_of
from peterka.maps import peterka_map
from peterka.pictures import open_file, pictures_of
from picture_samples import ALL_CLASSES, NO_IMPACT, CHAOTIC, Drawn, orbit, write_basin, write_map
from picture_texts import faults_of_layout
from sweep_samples import write_sweep
from trace_samples import write_trace

pytestmark = pytest.mark.thorough

COLUMN = 84  # mm
APART = 12  # in lightness: two greys distinguishable in print, adjacent or not
BLOCKS = np.repeat(np.repeat(np.array(ALL_CLASSES), 12, axis=0), 12, axis=1)
FIELDS = {name: np.outer(1 + np.arange(4.0), 1 + np.arange(4.0)) for name in ("impact_speed", "max_displacement")}


def look_of(pixels):
    """(median lightness, share of pixels far from it): zero for a plain grey, positive for a hatched one."""
    light = np.array([lightness("#" + 3 * f"{value:02X}")
                      for value in pixels.ravel()])
    middle = np.median(light)
    return middle, float(np.mean(np.abs(light - middle) > APART))


def test_the_greys_are_told_apart_by_lightness_or_hatching():
    looks = {label: look for label, look in fills.GREYS.items() if label != "not computed yet"}  # open, hatched
    looks |= dict(zip(SECOND_COLOURS, fills.SECOND))
    for (first, (light, hatch)), (second, (other, over)) in combinations(looks.items(), 2):
        assert abs(light - other) >= APART or hatch != over, f"{first} and {second} look the same in grey"


def test_what_looked_the_same_in_grey_does_not_any_more(tmp_path):
    """1/1, 1/2, 2/4, 3/3 and unresolved, measured in the picture."""
    with open_file(write_map(tmp_path / "a.h5", BLOCKS)) as file:
        drawn = Drawn(peterka_map.draw(file, palette="grey"), tmp_path / "a.png")
        looks = {}
        for label, row, column in (("1/1", 0, 0), ("1/2", 0, 4), ("2/4", 0, 5), ("3/3", 0, 3), ("unresolved", 2, 5)):
            x, y = (axis.values[12 * at + np.array([1, 10])] for axis, at in ((file.columns, column), (file.rows, row)))
            (left, bottom), (right, top) = drawn.map_axes.transData.transform(np.column_stack([x, y]))
            height = drawn.pixels.shape[0]
            area = drawn.pixels[int(height - top):int(height - bottom), int(left):int(right), 0]
            edge = area[: area.shape[0] // 4]  # the name of a class is in the middle
            looks[label] = look_of(edge[::3, ::3])
    for (first, one), (second, other) in combinations(looks.items(), 2):
        assert abs(one[0] - other[0]) >= APART or abs(one[1] - other[1]) >= 0.1, f"{first} {one}, {second} {other}"


def samples(folder):
    return [write_map(folder / "map.h5", BLOCKS), write_basin(folder / "basin.h5"), write_sweep(folder / "sweep.h5"),
            write_trace(folder / "trace.h5"), write_trace(folder / "with_a_stop.h5", gap_ratio=0.25),
            write_curves(folder / "curves.h5"), write_map(folder / "fields.h5", fields=FIELDS)]


def test_a_grey_picture_has_no_colour(tmp_path):
    for path in samples(tmp_path):
        with open_file(path) as file:
            for name, draw in pictures_of(file).items():
                figure = figure_of(draw(file, palette="grey"))
                figure.savefig(tmp_path / "a.png", dpi=100)
                pixels = imread(tmp_path / "a.png")[..., :3]
                assert np.ptp(pixels, axis=2).max() < 0.02, f"{path.stem} {name} has colours"


def without_a_value(ax):
    """The colours of what lies beneath the values of a map, and those of its scale."""
    beneath, values = ax.collections
    shown = np.unique(beneath.get_array().compressed()).astype(int)
    return {to_hex(beneath.cmap(number)) for number in shown}, {to_hex(values.cmap(number)) for number in range(256)}


def test_in_grey_nothing_without_a_value_looks_like_one(tmp_path):
    """It is white, which no value is, under lines where there is more than one of it: cells that are not computed yet, too."""
    distances, kicks = write_distances(tmp_path / "c.h5")[0], write_attractors(tmp_path / "k.h5")
    for path, name, count in ((write_map(tmp_path / "a.h5", BLOCKS), "force_1_1", 2), (distances, "edge_distance_gap", 3),
                              (distances, "edge_distance_frequency", 3), (kicks, "kick", 4)):
        with open_file(path) as file:
            figure = figure_of(pictures_of(file)[name](file, palette="grey"))
        beneath, scale = without_a_value(figure.axes[0])
        assert "#ffffff" in beneath and "#ffffff" not in scale, name
        patches = [patch for ax in figure.axes if ax.get_legend() for patch in ax.get_legend().get_patches()]
        looks = [(to_hex(patch.get_facecolor()), patch.get_hatch()) for patch in patches]
        assert {colour for colour, _ in looks} == {"#ffffff"}, f"{name}: {looks}"
        assert len(set(looks)) == len(looks) == count, f"{name}: {looks}"


def test_a_colour_picture_has(tmp_path):
    with open_file(write_map(tmp_path / "a.h5", BLOCKS)) as file:
        pixels = Drawn(peterka_map.draw(file), tmp_path / "a.png").pixels
        assert np.ptp(pixels, axis=2).max() > 100


@pytest.mark.parametrize("palette, units", [("grey", "si"), ("colour", "ratio")])
def test_every_picture_fits_a_column(tmp_path, monkeypatch, palette, units):
    for path in samples(tmp_path):
        with open_file(path) as file:
            for name, draw in pictures_of(file).items():
                figure = figure_of(draw(file, width=COLUMN, palette=palette, units=units))
                assert figure.get_figwidth() * 25.4 == pytest.approx(COLUMN)
                faults = faults_of_layout(figure, monkeypatch)
                assert not faults, f"{path.stem} {name}:\n" + "\n".join(faults)


@pytest.mark.parametrize("name", ["edge_distance_frequency", "edge_distance_gap"])
def test_distances_to_the_edge_fit_a_column(tmp_path, monkeypatch, name):
    with open_file(write_distances(tmp_path / "c.h5")[0]) as file:
        faults = faults_of_layout(figure_of(pictures_of(file)[name](file, width=COLUMN, units="si")), monkeypatch)
    assert not faults, "\n".join(faults)


def labels_of(figure):
    axes = [one for ax in figure.axes for one in (ax, *ax.child_axes)]
    return {axis.get_label_text() for ax in axes for axis in (ax.xaxis, ax.yaxis)
            if axis.get_visible() and axis.get_label_text()}


def test_units_are_of_one_kind_where_asked_for(tmp_path):
    with open_file(write_map(tmp_path / "a.h5")) as file:
        force = pictures_of(file)["force_all"]
        si, ratio, both = (labels_of(figure_of(force(file, units=units))) for units in ("si", "ratio", "both"))
    assert si == {"excitation frequency (Hz)", "gap (mm)", "peak force (N), all impacts"}
    assert ratio == {r"$\Omega/\omega$", r"$\mathrm{gap}/A_0$", "peak force $F/(m\\,g)$, all impacts"}
    assert both == ratio | {"excitation frequency (Hz)", "gap (mm)", "peak force (N)"}


def test_limits_and_a_logarithmic_scale_of_values(tmp_path):
    with open_file(write_map(tmp_path / "a.h5")) as file:
        force = pictures_of(file)["force_all"]
        limited = force(file, limits=(11.0, 12.0), log=True).collections[-1].norm
        free = force(file, log=True).collections[-1].norm
    assert (limited.vmin, limited.vmax, type(limited).__name__) == (11.0, 12.0, "LogNorm")
    assert free.vmin == pytest.approx(10.0)  # the smallest force, of the first cell


def test_a_zoom_shows_and_counts_what_is_inside(tmp_path, draw):
    cells = np.full((6, 6, 3), NO_IMPACT)
    cells[:3, :3] = orbit(1, 1)
    cells[3:, 3:] = CHAOTIC
    path = write_map(tmp_path / "rig.h5", cells, frequency_ratio=np.arange(1.0, 7), gap_ratio=np.arange(0.0, 6))
    outcome = draw(path, "--only", "map", "--zoom", "1,3,0,3", "--format", "svg")
    assert (outcome.code, outcome.pictures) == (0, ["rig_map.svg"])
    text = (tmp_path / "out" / "rig_map.svg").read_text()
    assert "75.0 %" in text and "chaotic" not in text and "100.0 %" not in text
    in_hertz = draw(path, "--only", "map", "--zoom", "4.5,13.5,0,2.68", "--units", "si", "--format", "svg")
    assert in_hertz.code == 0 and "75.0 %" in (tmp_path / "out" / "rig_map.svg").read_text()


def test_cells_that_the_frame_cuts_have_no_name_beside_it(tmp_path):
    """Names were written across the frame, over its ticks."""
    path = write_map(tmp_path / "a.h5", [[orbit(2, 2), orbit(2, 2), NO_IMPACT], [orbit(1, 1), orbit(1, 1), NO_IMPACT], [orbit(3, 3), orbit(3, 3), NO_IMPACT]])
    with open_file(path) as whole:
        columns, rows = whole.columns, whole.rows
        window = [columns.edges[0], columns.edges[2] + 0.02, rows.edges[1] - 0.02, rows.edges[2] + 0.02]
        ax = peterka_map.draw(zoomed(whole, tuple(map(float, window)), in_si=False))
    assert [text.get_text() for text in ax.texts] == ["1/1"]
    assert all(0 < share < 1 for text in ax.texts for share in text.get_position())


@pytest.mark.parametrize("zoom, share, border", [
    (None, "(share of the map)", ", on the map's border"),
    ((1.0, 2.8, 0.0, 3.0), "(share of the part shown)", ", on the border"),
])
def test_a_zoom_says_of_what_its_shares_and_its_border_are(tmp_path, zoom, share, border):
    """Its largest value is marked within it, though it cuts the middle of that cell off."""
    job = "[axes]\n" + "".join(f"{name}_ratio = {{from = 0, to = 1, points = 4}}\n" for name in ("frequency", "gap"))
    with open_file(write_map(tmp_path / "a.h5", job=job)) as whole, style.using(units="si"):
        file = zoomed(whole, zoom, in_si=False)
        pictures = pictures_of(file)
        assert any(share in text.get_text() for text in figure_of(pictures["map"](file)).findobj(Text))
        ax = pictures["force_all"](file)
        note, = ax.texts
        assert note.get_text().endswith(border)
        (low, high), x = ax.get_xlim(), note.xy[0]
        assert low <= x <= high


@pytest.mark.parametrize("arguments, words", [
    (["--only", "mop"], "gives no picture named 'mop'; it gives map, force_1_1, force_all"),
    (["--zoom", "1,1.1"], "has 1 point of frequency_ratio from 1 to 1.1; --zoom has to leave 2"),
    (["--zoom", "0,3", "--units", "si"], "has 1 point of frequency from 0 to 3 Hz; --zoom has to leave 2"),
    (["--zoom", "0,20,0,0.1", "--units", "si"], "has 1 point of gap from 0 to 0.1 mm; --zoom has to leave 2"),
    (["--zoom", "4,14"], "from 4 to 14; --zoom has to leave 2; it takes Hz with --units si"),
    (["--zoom", "1,4,1,2", "--units", "si"], "from 1 to 4 Hz; --zoom has to leave 2; as ratios these numbers fit: leave --units si out for them"),
    (["--only", "audit", "--zoom", "1,3"], "gives no picture with --zoom named 'audit'; it gives map"),
    (["--zoom", "3,1"], "wants the smaller number first"),
    (["--zoom", "1,2,3"], "is not 2 or 4 numbers"),
    (["--limits", "1"], "is not 2 numbers"),
    (["--width", "4"], "is not a number from 40 to 500"),
    (["--font", "No Such Font"], "there is no font 'No Such Font'"),
    (["--palette", "blue"], "invalid choice"),
])
def test_bad_arguments_get_a_word(tmp_path, draw, arguments, words):
    outcome = draw(write_map(tmp_path / "rig.h5"), *arguments)
    assert outcome.code == 2 and words in outcome.stderr and outcome.stderr.count("\n") == 1


def test_a_title_is_left_out_where_the_caption_says_it(tmp_path):
    with open_file(write_map(tmp_path / "a.h5", title="Beam springs")) as file:
        assert peterka_map.draw(file).get_figure()._suptitle.get_text() == "Beam springs"
        assert peterka_map.draw(file, title=False).get_figure()._suptitle is None


def test_a_figure_outside_any_style_is_refused():
    """Its fonts would have matplotlib's own sizes, which tests of numbers would not notice."""
    with pytest.raises(RuntimeError, match="@style.using"):
        figures.new_figure(3, 3)
    with style.using(dpi=100):
        assert figures.new_figure(3, 3).dpi == 100


def test_a_part_may_begin_below_zero_as_it_is_written(monkeypatch):
    """argparse takes "-0.5,2" for an option of its own."""
    for words in (["--zoom", "-0.5,2"], ["--zoom=-0.5,2"]):
        monkeypatch.setattr("sys.argv", ["draw.py", *words, "map.h5"])
        arguments = draw.read_arguments()
        assert list(arguments.zoom) == [-0.5, 2.0] and [path.name for path in arguments.files] == ["map.h5"]
    monkeypatch.setattr("sys.argv", ["draw.py", "--zoom", "--no-title", "map.h5"])
    with pytest.raises(SystemExit):
        draw.read_arguments()


def test_small_hatched_areas_are_named_beside_them_in_grey(tmp_path):
    """A tongue of 2/2 within 1/1, too narrow for letters: named with a line from within it; in colour it needs no name."""
    cells = np.full((60, 60, 3), orbit(1, 1))
    cells[20:50, 30:32] = orbit(2, 2)
    with open_file(write_map(tmp_path / "a.h5", cells)) as file:
        grey, colour = (peterka_map.draw(file, palette=palette, width=COLUMN) for palette in ("grey", "colour"))
        assert [text.get_text() for text in colour.texts] == ["1/1"]
        assert sorted(text.get_text() for text in grey.texts) == ["1/1", "2/2"]
        (line,) = [each.get_xydata() for each in grey.lines if each.get_linewidth() == 0.6]
        edges = file.columns.edges[[30, 32]], file.rows.edges[[20, 50]]
    within = [all(low <= value <= high for value, (low, high) in zip(end, edges)) for end in line]
    assert sum(within) == 1
