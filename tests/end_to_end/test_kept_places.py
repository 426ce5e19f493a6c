"""The places reported by operating_point.py, against random starts and points in their boxes."""

import random

import kept_claims
import kept_places
import pytest

pytestmark = pytest.mark.thorough

RIG = kept_places.RIG.format(zeta=0.00356, stop=kept_claims.spring(5.5e6, 1200.0))
WINDOW = {"frequency_ratio": (1.2, 3.6), "gap_ratio": (0.6, 1.6)}
DRIFT = 0.1, 0.03


def test_nothing_that_is_proved_breaks_and_of_what_is_sampled_no_more_than_is_told(tmp_path):
    chance = random.Random(3)
    any_start = kept_places.places(tmp_path, RIG, WINDOW, 8, ("any",), DRIFT, points=40)
    share = kept_places.places(tmp_path, RIG, WINDOW, 16, ("share", "0.8"), DRIFT, points=40)
    assert len(any_start) > 3 and len(share) > 3
    for place in chance.sample(any_start, 2):
        ends = kept_places.ends_of(tmp_path, RIG, place, DRIFT, chance, tries=4)
        assert ends[0] == 0, (place, ends)  # by proof
        assert 1 - ends[place[2]] / ends.total() <= 1 - 0.05 ** (1 / 8), (place, ends)
    for place in chance.sample(share, 2):
        ends = kept_places.ends_of(tmp_path, RIG, place, DRIFT, chance, tries=4)
        # between the binomial bound of its starts and all of them
        assert ends[place[2]] / ends.total() > place[3] - 4 * (0.25 / 16) ** 0.5, (place, ends)
