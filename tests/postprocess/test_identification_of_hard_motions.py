"""The cases of test_identification_of_motions.py that take longest: of each, a quicker one is there."""

import pytest
import test_identification_of_motions as motions

pytestmark = pytest.mark.thorough


def test_a_wrong_gap_is_refused(tmp_path, run_program):
    motions.refuses_a_wrong_gap(tmp_path, run_program, ["acceleration"], 0.01)


@pytest.mark.parametrize("names, noise, seed", [(("acceleration",), 0.0027666244986762232, 1001), (("acceleration",), 0.001356163020207942, 1005)])
def test_five_impacts_with_little_noise(names, noise, seed):
    motions.test_five_impacts_with_little_noise(names, noise, seed)


def test_two_rigs_that_meet_the_same_impacts_are_named():
    motions.test_two_rigs_that_meet_the_same_impacts_are_named(0.024699590807650065, 3001)
