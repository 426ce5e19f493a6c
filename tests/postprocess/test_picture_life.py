"""Pictures of mean lives: which motion of a cell is shown, the scale, and cells without a life."""

import numpy as np
import pytest

from peterka.maps import life_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import CHAOTIC as CHAOS, MISSING, NO_IMPACT as SWINGS, Drawn, orbit, write_map

pytestmark = pytest.mark.thorough

NO_IMPACT, PERIODIC, CHAOTIC, UNRESOLVED = 0, 1, 2, 4
NAN = np.nan


def test_the_first_settled_motion_is_shown_or_none():
    """Not the life of another one, on which hardly a start ends, where the first wasn't followed."""
    regime = np.zeros((1, 4), int)
    of = np.array([[[CHAOTIC, PERIODIC, PERIODIC, CHAOTIC]], [[PERIODIC, NO_IMPACT, NO_IMPACT, UNRESOLVED]]])
    life = np.array([[[7.0, NAN, 3.0, 7.0]], [[5.0, 2.0, 1.0, NAN]]])
    least = np.array([[[NAN, 90.0, NAN, NAN]], [[NAN, NAN, NAN, NAN]]])
    shown, bound = life_map._settled(regime, of, life, least)
    assert np.array_equal(shown, [[5.0, NAN, 3.0, NAN]], equal_nan=True)  # chaos that dies by itself is none
    assert np.array_equal(bound, [[NAN, 90.0, NAN, NAN]], equal_nan=True)
    life[0, 0, 2] = least[0, 0, 1] = NAN
    assert np.array_equal(life_map._settled(regime, of, life, least)[0], [[5.0, NAN, NAN, NAN]], equal_nan=True)


def test_without_starts_it_is_the_cells_own():
    regime = np.array([[PERIODIC, CHAOTIC, NO_IMPACT]])
    shown, bound = life_map._settled(regime, np.array([[4.0, 4.0, NAN]]), np.array([[NAN, NAN, 50.0]]))
    assert np.array_equal(shown, [[4.0, NAN, NAN]], equal_nan=True)
    assert np.array_equal(bound, [[NAN, NAN, 50.0]], equal_nan=True)


def test_what_is_no_time_is_no_life():
    regime = np.full((1, 4), PERIODIC)
    shown, bound = life_map._settled(regime, np.array([[0.0, -1.0, np.inf, 2.0]]), np.array([[np.inf, 0.0, 3.0, NAN]]))
    assert np.array_equal(shown, [[NAN, NAN, NAN, 2.0]], equal_nan=True)
    assert np.array_equal(bound, [[NAN, NAN, 3.0, NAN]], equal_nan=True)


@pytest.mark.parametrize("lives, limits", [([3.0, 40.0], (1.0, 100.0)), ([25.0], (10.0, 1000.0)), ([NAN], (1.0, 100.0)),
                                           ([0.2, 3e9], (0.1, 1e5)), ([0.02, 700.0], (0.01, 1000.0))])
def test_the_scale_has_whole_powers_of_ten(lives, limits):
    assert life_map._limits(np.array(lives)) == pytest.approx(limits)


CELLS = [[orbit(1, 1)] * 4, [SWINGS] * 4, [CHAOS, orbit(1, 2), SWINGS, MISSING]]
LIFE = [[2.0, 20.0, NAN, 2.0], [500.0, NAN, NAN, 2.0], [NAN, NAN, 2.0, NAN]]
LEAST = [[NAN, NAN, 1e3, NAN], [NAN, 1e3, 1e3, NAN], [NAN, NAN, NAN, NAN]]


def test_lives_are_on_the_scale_and_what_has_none_is_set_apart(tmp_path):
    fields = {"mean_life_s": LIFE, "mean_life_least_s": LEAST}
    with PeterkaFile(write_map(tmp_path / "a.h5", CELLS, fields=fields)) as file:
        drawn = Drawn(life_map.draw(file), tmp_path / "a.png")
        short, longer, longest = (drawn.colour_of(file, *place) for place in ((0, 0), (0, 1), (1, 0)))
        assert short == drawn.colour_of(file, 0, 3) == drawn.colour_of(file, 1, 3)
        assert len({short, longer, longest, *life_map.COLOURS[:3]}) == 6
        for place in ((0, 2), (1, 1), (1, 2)):
            assert drawn.colour_of(file, *place) == life_map.COLOURS[life_map.UNENDED]
        for place in ((2, 0), (2, 1)):
            assert drawn.colour_of(file, *place) == life_map.COLOURS[life_map.NONE_SETTLED]
    assert drawn.legend_texts() == ["none settled, or not followed", "hardly a life seen to end", "not computed yet"]


def test_only_a_map_with_noise_gives_the_picture(tmp_path, draw):
    fields = {"mean_life_s": np.ones((4, 4)), "mean_life_least_s": np.full((4, 4), NAN)}
    disturbed = write_map(tmp_path / "disturbed.h5", fields=fields)
    assert "disturbed_life.png" in draw(disturbed, "--formats", "png").pictures
    assert not any("plain_life" in name for name in draw(write_map(tmp_path / "plain.h5"), "--formats", "png").pictures)
