"""Means of a closed-form motion between given times, also those at which a piece of it begins, against fine sums."""

import numpy as np
from peterka.identification.motion import Cart, Rig, motion

RIG = Rig(mass=0.3, stiffness=2e5, damping=20.0, omega=2 * np.pi * 4.5, damping_ratio=0.01, gap=0.5e-3)
NAMES = ("force", "acceleration", "displacement")


def test_means_up_to_and_from_a_touch_and_a_release_are_those_of_fine_sums():
    moved = motion(RIG, Cart(), touch_time=0.0, touch_speed=0.3, until=0.4)
    assert len(moved.pieces) > 4
    begins = np.array([piece.begin for piece in moved.pieces[1:]])
    edges = np.concatenate([[-0.01], begins, [begins[-1] + 0.01]])
    means = moved.means(edges[:-1], edges[1:], NAMES)
    for place, (begin, end) in enumerate(zip(edges, edges[1:])):
        width = (end - begin) / 20000
        middles = begin + width * (np.arange(20000) + 0.5)
        for name, values in moved.signals(middles, NAMES).items():
            smallest = 1e-9 * np.abs(values).max()
            np.testing.assert_allclose(means[name][place], values.mean(), rtol=1e-6, atol=smallest, err_msg=f"{name} {place}")
