"""The colours of the classes: permanently fixed, and distinguishable for every reader."""

from itertools import combinations

import numpy as np
import pytest
import peterka
from colour_distance import deuteranope_sight, difference, lightness, normal_sight, protanope_sight, tritanope_sight
from peterka.plotting import fills
from peterka.plotting.classes import CLASSES, INDEX, MOST_NAMED, SECOND_COLOURS, class_of, classify, named
from peterka.plotting.fills import GREYS
from peterka.maps import basin_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import ALL_CLASSES, Drawn, colour_named, write_map

pytestmark = pytest.mark.thorough

# Published maps have these colours; changing one makes old and new maps incomparable.
TABLE = {
    "no impact": "#F2F2F2",
    "1/1": "#D55E00", "2/2": "#E69F00", "4/4": "#762024", "3/3": "#8F5100", "1/2": "#009E73", "2/4": "#4F7A46",
    "1/3": "#0072B2", "2/1": "#CC79A7", "4/2": "#74285D", "3/1": "#56B4E9", "6/2": "#A9D3DC", "4/1": "#5A12B8",
    "5/1": "#8F5F86", "3/2": "#F0E442", "other p/q": "#D4BEA5",
    "chaotic": "#1A1A1A", "sustained contact": "#99AA66", "unresolved": "#686868", "failed": "#C04DF7",
    "not computed yet": "#FFFFFF",
}
SECOND = {"2/3": "#07E0FE", "1/4": "#D1FDC2"}
# CIEDE2000; 2.3 is just noticeable for adjacent colours. For the first table, and for all colours.
DISTANCES = {normal_sight: (15.1, 12.7), protanope_sight: (9.0, 8.4), deuteranope_sight: (10.0, 8.8), tritanope_sight: (8.4, 8.1)}
GREY_DISTANCE, TWO_COLOUR_GREY_DISTANCE = 30, 15  # in L*


def test_the_tables_are_fixed():
    colours = {entry.label: entry.colour for entry in CLASSES}
    assert {label: colours[label] for label in TABLE} == TABLE
    assert {label: colours[label] for label in SECOND} == SECOND
    assert all(entry.colour in SECOND_COLOURS for entry in CLASSES if entry.label not in TABLE)
    assert len(CLASSES) == len(INDEX) == len(TABLE) + 144 - 14


def test_distance_agrees_with_published_pairs():
    # Three pairs from the test data of Sharma, Wu & Dalal (2005).
    assert difference((50, 2.6772, -79.7751), (50, 0, -82.7485)) == pytest.approx(2.0425, abs=1e-4)
    assert difference((50, 0, 0), (50, -1, 2)) == pytest.approx(2.3669, abs=1e-4)
    assert difference((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387)) == pytest.approx(1.2644, abs=1e-4)


@pytest.mark.parametrize("sight", DISTANCES)
def test_every_two_colours_differ(sight):
    """For normal sight, and for protanopes, deuteranopes and tritanopes."""
    first = [colour for label, colour in TABLE.items() if label != "not computed yet"]  # that one is hatched
    for colours, smallest in zip((first, [*first, *SECOND_COLOURS]), DISTANCES[sight]):
        distances = {pair: difference(*map(sight, pair)) for pair in combinations(colours, 2)}
        assert min(distances.values()) >= smallest, min(distances, key=distances.get)


def cells_of(*orbits):
    """Counts of CLASSES from {label: number of cells}."""
    counts = np.zeros(len(CLASSES), dtype=int)
    for label, count in dict(orbits).items():
        counts[INDEX[label]] = count
    return counts


def test_what_is_rarer_than_all_that_are_named_is_other():
    first = [label for label in TABLE if "/" in label and label != "other p/q"]
    counts = cells_of(("2/3", 50), ("1/4", 2), *((label, 10) for label in first))
    names = {CLASSES[n].label: CLASSES[as_what].label for n, as_what in enumerate(named(counts)) if counts[n]}
    assert names["2/3"] == "2/3" and names["1/4"] == "other p/q"
    kept = [label for label, as_what in names.items() if as_what == label]
    assert len(kept) == MOST_NAMED and min(counts[INDEX[label]] for label in kept) >= 10


def test_two_of_one_colour_are_not_both_named():
    twin = next(entry for entry in CLASSES if entry.colour == SECOND["2/3"] and entry.label != "2/3")
    counts = cells_of(("1/1", 90), ("2/3", 50), (twin.label, 40), ("1/2", 30))
    names = {CLASSES[n].label: CLASSES[as_what].label for n, as_what in enumerate(named(counts))}
    assert names["2/3"] == "2/3" and names[twin.label] == names["1/2"] == "other p/q"
    assert names["chaotic"] == "chaotic" and names["3/3"] == "3/3"  # absent here: a live map may have it


def test_a_map_names_what_it_has_most_of(tmp_path):
    cells = np.full((4, 5, 3), (1, 2, 3))
    cells[0, :2] = (1, 7, 13)
    write_map(tmp_path / "a.h5", cells)
    drawn = Drawn(peterka.draw(peterka.open(tmp_path / "a.h5"), "map"), tmp_path / "a.png")
    assert {"2/3 (90.0 %)", "other p/q (10.0 %)"} <= set(drawn.legend_texts())
    with PeterkaFile(tmp_path / "a.h5") as file:
        assert drawn.colour_of(file, 3, 0) == SECOND["2/3"] and drawn.colour_of(file, 0, 0) == TABLE["other p/q"]


def test_the_last_of_all_classes_is_hatched_like_the_first():
    """There are more colours, including hatchings, than fit into a byte."""
    looks = [fills.fill(entry.colour) if entry.label != "other p/q" else fills.Fill("#F6F6F6", "xx") for entry in CLASSES]
    number = INDEX["other p/q"]
    raster, *_ = fills.textured(np.full((4, 4), number, dtype=np.uint8), np.arange(5.0), np.arange(5.0), looks)
    assert set(np.unique(raster)) == {number, len(CLASSES) + number}


def test_what_is_nearly_black_is_hatched_in_colour_too(tmp_path):
    """In small areas no one tells such colours from chaos, nor from one another; all others are plain."""
    dark = {colour for colour in SECOND_COLOURS if lightness(colour) < 20}
    looks = {entry.colour: fills.fill(entry.colour) for entry in CLASSES}
    assert {colour for colour, look in looks.items() if look.hatch} == dark and len({looks[colour].hatch for colour in dark}) == len(dark) == 3
    assert all(lightness(looks[colour].stroke.upper()) > lightness(colour) + 30 for colour in dark)
    write_map(tmp_path / "a.h5", np.full((4, 5, 3), (1, 6, 8)))
    drawn = Drawn(peterka.draw(peterka.open(tmp_path / "a.h5"), "map"), tmp_path / "a.png")
    (patch,) = [patch for ax in drawn.figure.axes if ax.get_legend() for patch in ax.get_legend().get_patches()]
    look = fills.fill(class_of(1, 6, 8).colour)
    seen = {"#%02X%02X%02X" % tuple(pixel) for pixel in np.unique(drawn.pixels.reshape(-1, 3), axis=0)}
    assert patch.get_hatch() and {look.colour.upper(), look.stroke.upper()} <= seen


@pytest.mark.parametrize("label", [label for label, (_, hatch) in GREYS.items() if hatch])
def test_a_hatching_reads_as_a_darker_or_lighter_grey_in_a_thin_tongue(label):
    """A tongue one hundredth of the side wide has both colours, and together they are darker than without hatching."""
    look = fills.Fill(fills.grey(GREYS[label][0]), GREYS[label][1])
    raster, *_, colours = fills.textured(np.zeros((100, 100), dtype=int), np.arange(101.0), np.arange(101.0), [look])
    for tongue in (raster[:, 350:357], raster[350:357]):
        light = np.array([lightness(colour.upper()) for colour in colours])[tongue]
        assert abs(light.mean() - lightness(look.colour.upper())) > 5 and len(np.unique(light)) == 2


@pytest.mark.parametrize("orbit", ["1/1", "1/2"])
@pytest.mark.parametrize("other", ["no impact", "chaotic"])
def test_the_main_classes_differ_in_grey(orbit, other):
    assert abs(lightness(colour_named(orbit)) - lightness(colour_named(other))) > GREY_DISTANCE


def test_the_regimes_without_an_orbit_differ_in_grey():
    # Sustained contact and chaos are adjacent in maps of small gaps.
    light = [lightness(colour_named(label)) for label in ("chaotic", "unresolved", "sustained contact", "no impact")]
    assert np.diff(light).min() > TWO_COLOUR_GREY_DISTANCE
    assert light[2] - light[0] > GREY_DISTANCE


def test_impact_and_no_impact_differ_in_grey():
    colours = basin_map.IMPACT_COLOUR, basin_map.NO_IMPACT_COLOUR
    assert abs(lightness(colours[0]) - lightness(colours[1])) > TWO_COLOUR_GREY_DISTANCE


def test_every_class_is_recognised():
    cells = np.array(ALL_CLASSES).reshape(-1, 3)
    found = {CLASSES[index].label for index in classify(*cells.T)}
    assert found >= set(TABLE) - {"other p/q"}


@pytest.mark.parametrize("cell, label, colour", [
    ((1, 2, 2), "2/2", "#E69F00"), ((1, 7, 13), "7/13", "#D4BEA5"), ((1, 2, 3), "2/3", "#07E0FE"), ((2, 0, 0), "chaotic", "#1A1A1A"),
    ((0, 1, 1), "no impact", "#F2F2F2"),
])
def test_one_cell(cell, label, colour):
    assert (class_of(*cell).label, class_of(*cell).colour) == (label, colour)
