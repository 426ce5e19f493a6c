"""The equation of motion of a hammer with a spring-dashpot stop, with time T in turns of the cart,

    d2u/dT2 + D du/dT + K u + C c(u) = (2 pi)^2 sin(2 pi T) + f0,    c = u^3, or (u + y)^3 - y^3 with y = sin(2 pi T),

and steps along it. u is the distance of hammer and cart in A0; with s = 2 pi/eta flight has D = 2 zeta s, K = s^2, f0 = 0 and
contact D = s (2 zeta + chi), K = s^2 (1 + kappa), f0 = s^2 kappa g, and C = s^2 gamma in both. The stop's force in k A0 is
P = kappa (u - g) + chi u'/s. From a rigid stop, du/dT = w rebounds as -r w.

A step encloses all motions from a box by their Taylor series in theta, T = T0 + h theta, 0 <= theta <= 1. The last coefficient
is that of the Lagrange remainder: it is taken at all states that the motions meet meanwhile.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import log2, sqrt

from .balls import Ball, Series, Undecided, from_0_to, one, pi, sine_cosine, zero

Pair = tuple[Ball, Ball]  # u and du/dT


@dataclass(frozen=True)
class Rig:
    """The numbers of a cell: eta, zeta, kappa, chi, g, gamma; `absolute`: c is of x^3 - y^3; `unit`: F/(m g0) of one k A0. Of a rigid
    stop, kappa and chi are 0, `restitution` is r, and `unit` the m/s of one A0 omega."""

    frequency: Ball
    damping_ratio: Ball
    stiffness: Ball
    damping: Ball
    gap: Ball
    cubic: Ball
    absolute: bool
    unit: Ball
    restitution: Ball | None = None

    def turn(self) -> Ball:
        """s: omega t during one turn."""
        return pi().times(2) / self.frequency


class Phase:
    """The equation in flight, or pressed against the stop."""

    def __init__(self, rig: Rig, pressed: bool) -> None:
        s = rig.turn()
        self.rig, self.turn, self.pressed = rig, s, pressed
        self.damping = s * (rig.damping_ratio.times(2) + (rig.damping if pressed else zero()))
        self.spring = s * s * (one() + (rig.stiffness if pressed else zero()))
        self.push = s * s * rig.stiffness * rig.gap if pressed else zero()
        self.bend = s * s * rig.cubic
        self.drive = (pi() * pi()).times(4)
        self.bends = rig.cubic.size > 0
        self.rate = sqrt(float(self.spring)) + float(self.damping) + 6.3  # at which motions change, per turn

    def longest_step(self) -> float:
        """The longest step that is tried [turns]."""
        return 0.8 / self.rate

    def slope(self, u: Ball, sine: Ball) -> Ball:
        """The derivative of K u + C c(u)."""
        if not self.bends:
            return self.spring
        x = u + sine if self.rig.absolute else u
        return self.spring + (self.bend * x * x).times(3)

    def acceleration(self, state: Pair, sine: Ball) -> Ball:
        """d2u/dT2 at a state (u, du/dT)."""
        u, w = state
        force = self.drive * sine + self.push - self.spring * u - self.damping * w
        if not self.bends:
            return force
        x = u + sine if self.rig.absolute else u
        return force - self.bend * (x * x * x - (sine * sine * sine if self.rig.absolute else zero()))

    def within(self, time: Ball, length: Ball, state: Pair) -> Pair:
        """Encloses all that motions from `state` at `time` meet in a time `length`."""
        sine = sine_cosine(time + from_0_to(length))[0]
        return _met(state, lambda met: (length * met[1], length * self.acceleration(met, sine)))

    def series(self, time: Ball, length: Ball, state: Pair, columns: tuple[Pair, ...], order: int) -> tuple[Series, ...]:
        """The coefficients 0 to `order` of u, and of the derivatives of u that begin with `columns`, in theta."""
        spring, damping, bend = length * length * self.spring, length * self.damping, length * length * self.bend
        drive, push, angle = length * length * self.drive, length * length * self.push, (pi() * length).times(2)
        sine, cosine = sine_cosine(time)
        u, sines = Series(state[0], length * state[1]), Series(sine)
        x, x2, y2 = Series(), Series(), Series()  # x = u or u + y, and squares
        derivatives = tuple(Series(v, length * dv) for v, dv in columns)
        for k in range(order - 1):
            force = drive * sine + (push if k == 0 else zero()) - spring * u[k] - damping * u[k + 1].times(k + 1)
            if self.bends:
                x.append(u[k] + sine if self.rig.absolute else u[k])
                x2.append(x.product(x, k))
                cube = x2.product(x, k)
                if self.rig.absolute:
                    y2.append(sines.product(sines, k))
                    cube -= y2.product(sines, k)
                force -= bend * cube
            for v in derivatives:
                pull = -(spring * v[k]) - damping * v[k + 1].times(k + 1)
                if self.bends:
                    pull -= (bend * x2.product(v, k)).times(3)
                v.append(pull.over((k + 1) * (k + 2)))
            u.append(force.over((k + 1) * (k + 2)))
            sine, cosine = (angle * cosine).over(k + 1), -(angle * sine).over(k + 1)
            sines.append(sine)
        return u, *derivatives

    def pressure_at(self, state: Pair) -> Ball:
        """The stop's force at a state (u, du/dT), over k A0."""
        return self.rig.stiffness * (state[0] - self.rig.gap) + self.rig.damping / self.turn * state[1]


def _met(start: Pair, change: Callable[[Pair], Pair]) -> Pair:
    """Encloses x for a time 1, where x' = change(x) and x = start at first: a box into which the integral equation maps itself."""
    met = start
    for _ in range(60):
        moved = tuple(a + from_0_to(b) for a, b in zip(start, change(met), strict=True))
        if met[0].holds(moved[0]) and met[1].holds(moved[1]):
            return moved[0], moved[1]
        met = tuple(Ball(x.middle, x.radius + (x.radius >> 2) + 2) for x in moved)  # type: ignore[assignment]
    raise Undecided("a step too long for its bounds")


class Step:
    """All motions from the box `cloud` at an exact time, for an exact `length`; `point` is one state of the box."""

    def __init__(self, phase: Phase, time: Ball, length: Ball, point: Pair, cloud: Pair) -> None:
        self.phase, self.time, self.length = phase, time, length
        order, smallness = 3, 0.0
        while smallness > -Ball.bits:
            order += 1
            smallness = sum(log2(float(length) * phase.rate / k) for k in range(1, order + 1))
        met = phase.within(time, length, cloud)
        sine = sine_cosine(time + from_0_to(length))[0]
        pull = phase.slope(met[0], sine)
        columns = (one(), zero()), (zero(), one())
        met_columns = tuple(_met(v, lambda x: (length * x[1], -(length * (pull * x[0] + phase.damping * x[1])))) for v in columns)
        rest = phase.series(time + from_0_to(length), length, met, met_columns, order)
        self._last_but_one = rest[0][order - 1]
        self.cloud, *self.columns = phase.series(time, length, cloud, columns, order - 1)
        self.point = phase.series(time, length, point, (), order - 1)[0]
        for series, last in zip((self.cloud, *self.columns, self.point), (*rest, rest[0]), strict=True):
            series.append(last[order])

    def state(self, u: Series, theta: Ball) -> Pair:
        """(u, du/dT) at a share theta of the step."""
        return u.at(theta), u.slope().at(theta) / self.length

    def penetration(self, u: Series) -> Series:
        """delta = u - gap."""
        return Series(u[0] - self.phase.rig.gap, *(u[n] for n in range(1, len(u))))

    def pressure(self, u: Series) -> Series:
        """P, whose own remainder comes one coefficient earlier than that of u."""
        rig, last = self.phase.rig, len(u) - 1
        speed, delta = rig.damping / (self.phase.turn * self.length), self.penetration(u)
        terms = (delta[n] if n < last - 1 else self._last_but_one for n in range(last))
        return Series(*(rig.stiffness * term + speed * u[n + 1].times(n + 1) for n, term in enumerate(terms)))

    def flow(self, theta: Ball) -> tuple[Pair, Pair]:
        """The derivative of the state with respect to that at the beginning, by rows; the same for the whole box."""
        (a, c), (b, d) = (self.state(v, theta) for v in self.columns)
        return (a, b), (c, d)
