"""Balls hold what exact fractions give, and are not much larger than they have to be; pi, sine and cosine."""

from fractions import Fraction

import pytest
from peterka.second_proof.balls import Ball, Series, Undecided, from_0_to, one, pi, sine_cosine

X_AND_Y = [(0.7, -1.3), (-2.5, 3.1), (1e-9, 1e9), (12.125, 0.1)]


@pytest.fixture(autouse=True)
def bits(monkeypatch):
    monkeypatch.setattr(Ball, "bits", 160)


def ends(ball):
    return Fraction(ball.low, 1 << Ball.bits), Fraction(ball.high, 1 << Ball.bits)


def is_tight(ball, low, high):
    """Whether a ball holds [low, high], and on either side no more than 2^-140 of the size beside."""
    least, most = ends(ball)
    spare = Fraction(1 + max(abs(low), abs(high)), 1 << 140)
    return low - spare <= least <= low and high <= most <= high + spare


@pytest.mark.parametrize("x, y", X_AND_Y)
def test_results_hold_what_exact_fractions_give_and_little_else(x, y):
    r, s = Fraction(1, 1 << 80), Fraction(1, 1 << 90)
    a, b = Ball(Ball.of(x).middle, 1 << 80), Ball(Ball.of(y).middle, 1 << 70)
    (a_low, a_high), (b_low, b_high) = ends(a), ends(b)
    assert (a_low, a_high, b_low, b_high) == (Fraction(x) - r, Fraction(x) + r, Fraction(y) - s, Fraction(y) + s)
    products = [p * q for p in (a_low, a_high) for q in (b_low, b_high)]
    quotients = [p / q for p in (a_low, a_high) for q in (b_low, b_high)]
    assert is_tight(a + b, a_low + b_low, a_high + b_high) and is_tight(a - b, a_low - b_high, a_high - b_low)
    middle, spread = Fraction(x) * Fraction(y), abs(Fraction(x)) * s + abs(Fraction(y)) * r + r * s
    assert ends(a * b)[0] <= min(products) and max(products) <= ends(a * b)[1] and is_tight(a * b, middle - spread, middle + spread)
    assert ends(a / b)[0] <= min(quotients) and max(quotients) <= ends(a / b)[1]
    assert ends(a / b)[1] - ends(a / b)[0] < 2.001 * (r + abs(Fraction(x) / Fraction(y)) * s) / abs(Fraction(y)) + Fraction(1, 1 << 150)
    assert is_tight(-a, -a_high, -a_low) and is_tight(a.times(-3), -3 * a_high, -3 * a_low)
    assert is_tight(a.over(7), a_low / 7, a_high / 7)


def test_of_a_double_that_has_more_digits_than_balls():
    low, high = ends(Ball.of(2.0**-170))
    assert low <= Fraction(1, 1 << 170) <= high and high - low == Fraction(2, 1 << 160)
    assert ends(Ball.of(0.1)) == (Fraction(0.1), Fraction(0.1)) and ends(Ball.of(3)) == (3, 3)
    assert ends(one()) == (1, 1) and Ball.of(-2.5).size == 5 << 159 and float(Ball.of(-2.5)) == -2.5


def test_of_ends_that_are_an_odd_number_apart():
    assert Ball.between(3, 6).low <= 3 and Ball.between(3, 6).high >= 6 and Ball.between(-7, -7).radius == 0


def test_one_ball_in_another_and_apart_from_it():
    ball = Ball(10, 4)
    assert ball.holds(ball) and ball.holds(Ball(7, 1)) and ball.holds(Ball(13, 1)) and not ball.holds(Ball(7, 2)) and not ball.holds(Ball(13, 2))
    assert ball.apart(Ball(3, 2)) and ball.apart(Ball(17, 2)) and not ball.apart(Ball(4, 2)) and not ball.apart(Ball(16, 2))


def test_a_divisor_that_may_be_0_and_the_root_of_what_may_be_negative():
    for divisor in (Ball(5, 5), Ball(-5, 6), Ball(0)):
        with pytest.raises(Undecided, match="a divisor that may be 0"):
            one() / divisor
    one() / Ball(5, 4)
    with pytest.raises(Undecided, match="the root of what may be negative"):
        Ball(5, 6).sqrt()
    low, high = ends(Ball(9 << 159, 9 << 159).sqrt())
    assert -Fraction(1, 1 << 150) < low <= 0 and 3 <= high < 3 + Fraction(1, 1 << 150)
    low, high = ends(Ball.of(2).sqrt())
    assert low**2 <= 2 <= high**2 and high - low < Fraction(4, 1 << 160)


def test_shares_of_a_ball():
    low, high = ends(from_0_to(Ball.of(3)))
    assert -Fraction(1, 1 << 150) < low <= 0 and 3 <= high < 3 + Fraction(1, 1 << 150)


def test_a_series_its_products_slope_and_bounds():
    first, second = Series(*(Ball(Ball.of(x).middle, 1 << 60) for x in (1.5, -2.0, 0.25, 3.0))), Series(*map(Ball.of, (0.5, 4.0, -1.0, 2.0)))
    exact = [Fraction(x) for x in (1.5, -2.0, 0.25, 3.0)]
    others = [Fraction(x) for x in (0.5, 4.0, -1.0, 2.0)]
    for n in range(4):
        value, spread = sum(exact[k] * others[n - k] for k in range(n + 1)), sum(map(abs, others[:n + 1])) / (1 << 100)
        assert is_tight(first.product(second, n), value - spread, value + spread)
        assert ends(first[n]) == (exact[n] - Fraction(1, 1 << 100), exact[n] + Fraction(1, 1 << 100))
    assert len(first) == 4 and len(first.slope()) == 3
    assert [float(first.slope()[n]) for n in range(3)] == [-2.0, 0.5, 9.0]
    x = Fraction(3, 8)
    value = sum(c * x**n for n, c in enumerate(others))
    assert is_tight(second.at(Ball.of(0.375)), value, value)
    piece = Ball.between(Ball.of(0.25).middle, Ball.of(0.5).middle)
    values = [sum(c * Fraction(k, 64)**n for n, c in enumerate(others)) for k in range(16, 33)]
    low, high = ends(second.over(second.slope(), piece))
    assert low <= min(values) and max(values) <= high and high - low < Fraction(3, 2)


def test_sine_and_cosine_and_pi():
    half, root = sine_cosine(Ball.of(1) / Ball.of(12))
    assert half.holds(Ball(1 << 159)) and half.radius < 1 << 10
    three_quarters = root * root
    assert three_quarters.holds(Ball(3 << 158)) and three_quarters.radius < 1 << 12
    for turns in (-1.25, 0.0, 0.3, 7.5, 1e6 + 0.375):
        sine, cosine = sine_cosine(Ball.of(turns))
        assert (sine * sine + cosine * cosine).holds(one())
    assert pi().radius < 1 << 4 and ends(pi())[0] < Fraction(31415926535897932384626433832795028841971693993751, 10**49) < ends(pi())[1]


@pytest.mark.parametrize("turns, sine, cosine", [(0.25, 1, 0), (-0.25, -1, 0), (0.5, 0, -1), (3.75, -1, 0), (0.125, None, None)])
def test_signs_of_sine_and_cosine_by_quarters(turns, sine, cosine):
    found = sine_cosine(Ball.of(turns))
    if sine is None:
        assert not found[0].apart(found[1]) and float(found[0]) == pytest.approx(0.5**0.5, rel=1e-15)
    else:
        assert found[0].holds(Ball.of(sine)) and found[1].holds(Ball.of(cosine)) and max(ball.radius for ball in found) < 1 << 10


def test_a_spread_of_turns_widens_both_by_its_slope():
    sine, cosine = sine_cosine(Ball(Ball.of(0.1).middle, 1 << 100))
    for ball in (sine, cosine):
        assert 6 << 100 < ball.radius < 8 << 100
