"""Further cases of test_picture_uncertain.py, which has one of each sort: other motions, other options."""

import pytest
import test_picture_uncertain as sample

pytestmark = pytest.mark.thorough

SHARES = sample.SHARES


@pytest.mark.parametrize("wanted, right", [("no impact", SHARES[1]), ("2/2", SHARES[2]), ("2/1", 0 * SHARES[0])])
def test_the_probability_of_any_motion_is_drawn(tmp_path, wanted, right):
    sample.test_the_probability_of_any_motion_is_drawn(tmp_path, wanted, right)


@pytest.mark.parametrize("options", [{"width": 84}, {"units": "si"}, {"units": "ratio"}])
def test_nothing_overlaps(tmp_path, monkeypatch, options):
    sample.test_nothing_overlaps(tmp_path, monkeypatch, options)
