"""A motion in closed form, piece by piece, against scipy's DOP853: a cart at rest and in motion, stops of little and much damping."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from peterka.identification.motion import Cart, Rig, motion, next_touch
from simulated_hammer import Hammer, driven, simulate

RATE = 20000.0
FREE = Hammer(mass=0.3, hertz=9.0, ratio=0.02, stiffness=2e5, damping=20.0, gap=0.5e-3, start=-4e-3)
CASES = {"at rest": FREE, "driven": driven(FREE, 0.7e-3, 14.0, phase=0.6), "overdamped": replace(FREE, damping=1200.0),
         "pressed": replace(FREE, gap=-1e-3)}
NAMES = ("force", "acceleration", "displacement", "cart_acceleration", "cart_displacement")


@cache
def simulated(case):
    return simulate(CASES[case], 0.35, RATE)


def rig_and_cart(hammer):
    rig = Rig(hammer.mass, hammer.stiffness, hammer.damping, 2 * np.pi * hammer.hertz, hammer.ratio, hammer.gap)
    omega = 2 * np.pi * hammer.cart_hertz
    return rig, Cart(omega, hammer.amplitude * omega**2 * np.exp(1j * (hammer.phase - np.pi / 2)))


@cache
def moved(case):
    """The Motion from the first touch, which is found on the cubic parabola through four samples before it."""
    hammer, (time, columns) = CASES[case], simulated(case)
    rig, cart = rig_and_cart(hammer)
    place = int(np.argmax(columns["displacement"] > hammer.gap))
    near = slice(place - 4, place)
    line = np.polyfit(time[near] - time[place - 1], columns["displacement"][near] - hammer.gap, 3)
    roots = np.roots(line)
    root = min(roots[np.isreal(roots)].real, key=abs)
    return motion(rig, cart, time[place - 1] + root, np.polyval(np.polyder(line), root), 0.35)


@pytest.mark.parametrize("case", CASES)
def test_signals_are_those_of_steps_in_time(case):
    time, columns = simulated(case)
    found = moved(case).signals(time, NAMES)
    edges = np.concatenate([[piece.begin] for piece in moved(case).pieces])
    clear = np.min(np.abs(time[:, None] - edges), axis=1) > 2 / RATE  # of jumps of the force
    assert len(moved(case).touches) >= (1 if case == "overdamped" else 3)
    for name in ("force", "acceleration", "displacement"):
        largest = np.abs(columns[name]).max()
        np.testing.assert_allclose(found[name][clear], columns[name][clear], atol=2e-4 * largest, err_msg=name)
    hammer, omega = CASES[case], 2 * np.pi * CASES[case].cart_hertz
    np.testing.assert_allclose(found["cart_displacement"], hammer.amplitude * np.sin(omega * time + hammer.phase), atol=1e-12)
    np.testing.assert_allclose(found["cart_acceleration"], -omega**2 * found["cart_displacement"], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("case", CASES)
def test_pieces_join_and_obey_the_equation_of_motion(case):
    rig, cart = rig_and_cart(CASES[case])
    pieces = moved(case).pieces
    for piece, after in zip(pieces, pieces[1:]):
        for order in (0, 1):
            assert piece.derivative(order, after.begin) == pytest.approx(float(after.derivative(order, after.begin)), rel=1e-8, abs=1e-12)
        assert piece.contact != after.contact
    for piece, time in ((piece, piece.begin + share * 1e-4) for piece in pieces for share in (-1.0, 2.0)):
        u, v, a = (float(piece.derivative(order, time)) for order in range(3))
        assert piece.at(time) == pytest.approx((u, v, a), rel=1e-9)
        force = (rig.stiffness * (u - rig.gap) + rig.damping * v) * piece.contact
        damping, springs = 2 * rig.damping_ratio * rig.omega * v, rig.omega**2 * u
        assert a + float(cart.signal(time, 2)) == pytest.approx(-damping - springs - force / rig.mass, rel=1e-7, abs=1e-7)
    for begin, end in moved(case).contacts():
        contact = next(piece for piece in pieces if piece.contact and piece.begin == begin)
        assert rig.stiffness * (contact.at(end)[0] - rig.gap) + rig.damping * contact.at(end)[1] == pytest.approx(0, abs=1e-5)


@pytest.mark.parametrize("case", CASES)
def test_means_are_those_of_fine_sums(case):
    edges = np.linspace(-0.01, 0.3, 40) + 1e-5
    means = moved(case).means(edges[:-1], edges[1:], NAMES)
    for place in range(0, 39, 3):
        width = (edges[place + 1] - edges[place]) / 4000
        for name, values in moved(case).signals(edges[place] + width * (np.arange(4000) + 0.5), NAMES).items():
            largest = np.abs(values).max()
            assert means[name][place] == pytest.approx(values.mean(), rel=1e-4, abs=2e-4 * largest + 1e-12), (name, place)


def test_a_motion_of_so_many_impacts_goes_on_without_a_stop():
    whole, hammer = moved("at rest"), CASES["at rest"]
    rig, cart = rig_and_cart(hammer)
    first, speed = whole.pieces[1].begin, whole.pieces[1].at(whole.pieces[1].begin)[1]
    some = motion(rig, cart, first, speed, 0.35, most=2)
    assert [piece.contact for piece in some.pieces] == [False, True, False, True, False]
    assert some.pieces[4].begin == pytest.approx(whole.pieces[4].begin, abs=1e-9)
    assert float(some.signals(np.array([0.34]), ["force"])["force"][0]) == 0.0
    touch = next_touch(rig, cart, some.pieces[4], 0.35)
    assert touch == pytest.approx(whole.touches[2], abs=1e-9)
    assert next_touch(rig, cart, some.pieces[4], touch - 1e-6) is None and next_touch(rig, cart, some.pieces[4], some.pieces[4].begin) is None
    assert [touch for touch in motion(rig, cart, first, speed, whole.touches[2] - 1e-6).touches] == pytest.approx(list(whole.touches[:2]))


def test_contacts_may_begin_at_samples_that_are_told():
    """They then go on before their touches as smooth functions."""
    whole = moved("at rest")
    time = whole.touches[0] + np.array([-2.5, -1.5, -0.5, 0.5, 1.5]) * 1e-5
    told = whole.signals(time, ["force", "displacement"], places=np.array([1]))
    contact = whole.pieces[1]
    own = 2e5 * (contact.derivative(0, time) - 0.5e-3) + 20.0 * contact.derivative(1, time)
    assert told["force"] == pytest.approx(np.append(0, own[1:])) and own[1] > 0
    assert whole.signals(time, ["force"])["force"] == pytest.approx(np.append(np.zeros(3), own[3:]))
