"""Real numbers enclosed by balls: middle and radius are whole multiples of 2**-Ball.bits, which Python adds and multiplies
exactly. What a middle loses by rounding is added to the radius, so that a result encloses all that its operands enclose."""

from __future__ import annotations

from functools import lru_cache
from math import isqrt
from operator import mul


class Undecided(Exception):
    """Something could be neither proved nor refuted; the message says what."""


class Ball:
    """All real numbers within `radius` of `middle`, both in units of 2**-bits; `bits` is common to all balls in use."""

    __slots__ = ("middle", "radius")
    bits = 160

    def __init__(self, middle: int, radius: int = 0) -> None:
        self.middle, self.radius = middle, radius

    @staticmethod
    def of(number: float) -> Ball:
        """Encloses a double or an integer; alone in its ball, unless it has digits beyond the last of `bits`."""
        numerator, denominator = number.as_integer_ratio()
        middle, rest = divmod(numerator << Ball.bits, denominator)
        return Ball(middle, 1 if rest else 0)

    @staticmethod
    def between(low: int, high: int) -> Ball:
        """Encloses [low, high], both in units of 2**-bits."""
        middle = (low + high) >> 1
        return Ball(middle, high - middle)

    @property
    def low(self) -> int:
        """The least number enclosed, in units of 2**-bits."""
        return self.middle - self.radius

    @property
    def high(self) -> int:
        """The largest number enclosed, in units of 2**-bits."""
        return self.middle + self.radius

    @property
    def size(self) -> int:
        """The largest distance from 0, in units of 2**-bits."""
        return abs(self.middle) + self.radius

    def __add__(self, other: Ball) -> Ball:
        return Ball(self.middle + other.middle, self.radius + other.radius)

    def __sub__(self, other: Ball) -> Ball:
        return Ball(self.middle - other.middle, self.radius + other.radius)

    def __neg__(self) -> Ball:
        return Ball(-self.middle, self.radius)

    def __mul__(self, other: Ball) -> Ball:
        a, b, r, s = self.middle, other.middle, self.radius, other.radius
        return Ball(a * b >> Ball.bits, (abs(a) * s + abs(b) * r + r * s >> Ball.bits) + 2)

    def times(self, factor: int) -> Ball:
        """By an integer, without any loss."""
        return Ball(self.middle * factor, self.radius * abs(factor))

    def over(self, divisor: int) -> Ball:
        """By a positive integer."""
        return Ball(self.middle // divisor, self.radius // divisor + 2)

    def __truediv__(self, other: Ball) -> Ball:
        least = abs(other.middle) - other.radius
        if least <= 0:
            raise Undecided("a divisor that may be 0 (near a grazing, or where the orbit ends)")
        spread = abs(other.middle) * self.radius + abs(self.middle) * other.radius
        return Ball((self.middle << Ball.bits) // other.middle, (spread << Ball.bits) // (least * abs(other.middle)) + 2)

    def sqrt(self) -> Ball:
        """The root; Undecided if the ball holds a negative number."""
        if self.low < 0:
            raise Undecided("the root of what may be negative")
        return Ball.between(isqrt(self.low << Ball.bits), isqrt(self.high << Ball.bits) + 1)

    def holds(self, other: Ball) -> bool:
        """Whether the other lies within this one."""
        return self.low <= other.low and other.high <= self.high

    def apart(self, other: Ball) -> bool:
        """Whether the two have no number in common."""
        return self.high < other.low or other.high < self.low

    def __float__(self) -> float:
        return self.middle / (1 << Ball.bits)


def one() -> Ball:
    """1, alone in its ball."""
    return Ball(1 << Ball.bits)


def zero() -> Ball:
    """0, alone in its ball."""
    return Ball(0)


def from_0_to(end: Ball) -> Ball:
    """Encloses x y for all x in [0, 1] and all y in `end`."""
    return end * Ball(1 << Ball.bits - 1, 1 << Ball.bits - 1)


@lru_cache
def _pi(bits: int) -> int:
    """By Machin's formula, 16 arctan(1/5) - 4 arctan(1/239), with 32 further bits for what its terms lose."""
    def arctan_of_inverse(n: int) -> int:
        power, total, k = (1 << bits + 32) // n, 0, 0
        while power:
            total += (-1) ** k * (power // (2 * k + 1))
            power, k = power // n**2, k + 1
        return total  # each term is wrong by 2 at most, and their number is below 2**20

    return (16 * arctan_of_inverse(5) - 4 * arctan_of_inverse(239)) >> 32


def pi() -> Ball:
    """Encloses pi."""
    return Ball(_pi(Ball.bits), 2)


def sine_cosine(turns: Ball) -> tuple[Ball, Ball]:
    """sin and cos of 2 pi times a number of turns."""
    half = 1 << Ball.bits - 1
    angle = (pi() * Ball((turns.middle + half) % (2 * half) - half)).times(2)
    sums, term, k = [zero(), one()], one(), 0
    while k < 4 or term.size > 4:
        k += 1
        term = (term * angle).over(k)
        sums[(k + 1) % 2] += term if k % 4 < 2 else -term
    # The series alternate, and beyond the fourth their terms fall; both functions' slopes are 2 pi < 7 at most.
    rest = term.size + 1 + 7 * turns.radius
    return Ball(sums[0].middle, sums[0].radius + rest), Ball(sums[1].middle, sums[1].radius + rest)


class Series:
    """Coefficients of a polynomial, from the constant on; balls, as lists of middles, their sizes, and the bounds of all within."""

    def __init__(self, *coefficients: Ball) -> None:
        self.middles = [coefficient.middle for coefficient in coefficients]
        self.sizes = [abs(middle) for middle in self.middles]
        self.bounds = [coefficient.size for coefficient in coefficients]

    def append(self, coefficient: Ball) -> None:
        """Adds the next higher coefficient."""
        self.middles.append(coefficient.middle)
        self.sizes.append(abs(coefficient.middle))
        self.bounds.append(coefficient.size)

    def __getitem__(self, n: int) -> Ball:
        return Ball(self.middles[n], self.bounds[n] - self.sizes[n])

    def __len__(self) -> int:
        return len(self.middles)

    def product(self, other: Series, n: int) -> Ball:
        """The n-th coefficient of the product."""
        middle = sum(map(mul, self.middles, other.middles[n::-1]))
        radius = sum(map(mul, self.bounds, other.bounds[n::-1])) - sum(map(mul, self.sizes, other.sizes[n::-1]))
        return Ball(middle >> Ball.bits, (radius >> Ball.bits) + 2)

    def slope(self) -> Series:
        """The derivative."""
        return Series(*(self[n].times(n) for n in range(1, len(self))))

    def at(self, x: Ball) -> Ball:
        """Encloses the values on a ball, by Horner's scheme."""
        value = zero()
        for n in range(len(self) - 1, -1, -1):
            value = value * x + self[n]
        return value

    def over(self, slope: Series, piece: Ball) -> Ball:
        """Encloses the values on a piece, by the mean value theorem."""
        return self.at(Ball(piece.middle)) + slope.at(piece) * Ball(0, piece.radius)
