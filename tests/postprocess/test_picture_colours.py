"""The colours of the classes: fixed for ever, and apart from each other for every reader."""

from itertools import combinations

import numpy as np
import pytest
from colour_distance import deuteranope_sight, difference, lightness, normal_sight
from peterka.look.classes import CLASSES, class_of, classify
from peterka.maps import basin_map
from picture_samples import ALL_CLASSES, colour_named

# Published maps have these colours; changing one makes old and new maps incomparable.
TABLE = {
    "no impact": "#F2F2F2",
    "1/1": "#D55E00", "2/2": "#E69F00", "4/4": "#762024", "3/3": "#8F5100", "1/2": "#009E73", "2/4": "#4F7A46",
    "1/3": "#0072B2", "2/1": "#CC79A7", "4/2": "#74285D", "3/1": "#56B4E9", "6/2": "#A9D3DC", "4/1": "#5A12B8",
    "5/1": "#8F5F86", "3/2": "#F0E442", "other p/q": "#D4BEA5",
    "chaotic": "#1A1A1A", "sustained contact": "#99AA66", "unresolved": "#686868", "failed": "#C04DF7",
    "not computed yet": "#FFFFFF",
}
NORMAL_DISTANCE, DEUTERANOPE_DISTANCE = 14, 9.5  # CIEDE2000; 2.3 is just noticeable side by side
GREY_DISTANCE, TWO_COLOUR_GREY_DISTANCE = 30, 15  # in L*


def test_the_table_is_fixed():
    assert {entry.label: entry.colour for entry in CLASSES} == TABLE


def test_distance_agrees_with_published_pairs():
    # Three pairs of Sharma, Wu and Dalal's test data.
    assert difference((50, 2.6772, -79.7751), (50, 0, -82.7485)) == pytest.approx(2.0425, abs=1e-4)
    assert difference((50, 0, 0), (50, -1, 2)) == pytest.approx(2.3669, abs=1e-4)
    assert difference((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387)) == pytest.approx(1.2644, abs=1e-4)


@pytest.mark.parametrize("sight, distance", [
    (normal_sight, NORMAL_DISTANCE), (deuteranope_sight, DEUTERANOPE_DISTANCE),
])
def test_every_two_classes_differ(sight, distance):
    drawn = [entry for entry in CLASSES if entry.label != "not computed yet"]  # that one is hatched
    too_close = {
        (first.label, second.label): difference(sight(first.colour), sight(second.colour))
        for first, second in combinations(drawn, 2)
        if difference(sight(first.colour), sight(second.colour)) < distance
    }
    assert not too_close


@pytest.mark.parametrize("orbit", ["1/1", "1/2"])
@pytest.mark.parametrize("other", ["no impact", "chaotic"])
def test_the_main_classes_differ_in_grey(orbit, other):
    assert abs(lightness(colour_named(orbit)) - lightness(colour_named(other))) > GREY_DISTANCE


def test_the_regimes_without_an_orbit_differ_in_grey():
    # Sustained contact and chaos lie side by side in maps of small gaps.
    light = [lightness(colour_named(label)) for label in ("chaotic", "unresolved", "sustained contact", "no impact")]
    assert np.diff(light).min() > TWO_COLOUR_GREY_DISTANCE
    assert light[2] - light[0] > GREY_DISTANCE


def test_impact_and_no_impact_differ_in_grey():
    colours = basin_map.IMPACT_COLOUR, basin_map.NO_IMPACT_COLOUR
    assert abs(lightness(colours[0]) - lightness(colours[1])) > TWO_COLOUR_GREY_DISTANCE


def test_every_class_is_recognised():
    cells = np.array(ALL_CLASSES).reshape(-1, 3)
    found = {CLASSES[index].label for index in classify(*cells.T)}
    assert found == set(TABLE)


@pytest.mark.parametrize("cell, label, colour", [
    ((1, 2, 2), "2/2", "#E69F00"), ((1, 7, 3), "7/3", "#D4BEA5"), ((2, 0, 0), "chaotic", "#1A1A1A"),
    ((0, 1, 1), "no impact", "#F2F2F2"),
])
def test_one_cell(cell, label, colour):
    assert (class_of(*cell).label, class_of(*cell).colour) == (label, colour)
