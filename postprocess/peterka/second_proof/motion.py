"""The equation of motion of a hammer with a spring-dashpot stop, with time T in turns of the cart,

    d2u/dT2 + D du/dT + K u + C c(u) = (2 pi)^2 y + f0,    y = sin(2 pi T),    c = u^3, or (u + y)^3 - y^3,

and steps along it. u is the distance of hammer and cart in A0; with s = 2 pi/eta flight has D = 2 zeta s, K = s^2, f0 = 0 and
contact D = s (2 zeta + chi), K = s^2 (1 + kappa), f0 = s^2 kappa g, and C = s^2 gamma in both. The stop's force in k A0 is
P = kappa (u - g) + chi u'/s. From a rigid stop, du/dT = w rebounds as -r w.

A step encloses all motions from a box by their Taylor series in theta, T = T0 + h theta, 0 <= theta <= 1. The last coefficient
is that of the Lagrange remainder: it is taken at all states that the motions meet meanwhile.
"""

from dataclasses import dataclass
from itertools import count
from math import lgamma, log, log2, sqrt

from .balls import Ball, Series, Undecided, from_0_to, one, pi, sine_cosine, zero

State = tuple[Ball, Ball, Ball]  # T, u and du/dT, or what these change by
Path = tuple[Ball, Series]  # T at theta = 0, and u
DEPTH, PRESSURE, TIME = "u - g", "P", "T"  # surfaces in which legs end: zeros of u - g, of P, and of the time to an end


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
        self.rig, self.turn, self.bends = rig, s, rig.cubic.size > 0
        self.damping = s * (rig.damping_ratio.times(2) + (rig.damping if pressed else zero()))
        self.spring = s * s * (one() + (rig.stiffness if pressed else zero()))
        self.push = s * s * rig.stiffness * rig.gap if pressed else zero()
        self.bend, self.drive = s * s * rig.cubic, (pi() * pi()).times(4)
        self.rate = sqrt(float(self.spring)) + float(self.damping) + 6.3  # at which motions change, per turn

    def normal(self, surface: str) -> State:
        """What u - g, P or T change by with T, u and du/dT."""
        kappa, chi = self.rig.stiffness, self.rig.damping / self.turn
        return {DEPTH: (zero(), one(), zero()), PRESSURE: (zero(), kappa, chi), TIME: (one(), zero(), zero())}[surface]

    def accelerations(self, state: State, moved: list[State]) -> list[Ball]:
        """d2u/dT2, and what it changes by where the state is `moved` by each of these."""
        return [of[2].times(2) for of in self.series(state, one(), moved, 2)]

    def within(self, state: State, moved: list[State], length: Ball) -> tuple[State, list[State]]:
        """Encloses all that motions from a state meet in a time `length`, and what this changes by where the state is `moved` at first:
        a box into which the integral equation maps itself."""
        begin = met = [state, *moved]
        times = [state[0] + from_0_to(length), *(since for since, _, _ in moved)]
        for _ in range(10):  # where it doesn't soon, the numbers of a cubic spring would grow without bounds
            slopes = self.accelerations((times[0], *met[0][1:]), met[1:])
            ends = [(t, u + from_0_to(length * v), w + from_0_to(length * a))
                    for t, (_, u, w), (_, _, v), a in zip(times, begin, met, slopes, strict=True)]
            if all(a.holds(b) for old, new in zip(met, ends, strict=True) for a, b in zip(old[1:], new[1:], strict=True)):
                return ends[0], ends[1:]
            met = [(t, *(Ball(x.middle, x.radius + (x.radius >> 2) + 2) for x in values)) for t, *values in ends]  # type: ignore[misc]
        raise Undecided("a step too long for its bounds")

    def series(self, state: State, length: Ball, moved: list[State], order: int) -> list[Series]:
        """The coefficients 0 to `order` of u, and of the changes of u where T, u and du/dT are `moved` at first, in theta."""
        spring, damping, bend = length * length * self.spring, length * self.damping, length * length * self.bend
        drive, push, angle = length * length * self.drive, length * length * self.push, (pi() * length).times(2)
        sine, cosine = sine_cosine(state[0])
        u, x, y, x2, y2 = Series(state[1], length * state[2]), Series(), Series(), Series(), Series()  # x = u or u + y; squares
        changes = [(Series(v, length * w), Series(), Series(), pi().times(2) * since) for since, v, w in moved]  # of u, x, y, 2 pi T
        for k in range(order - 1):
            force = drive * sine + (push if k == 0 else zero()) - spring * u[k] - damping * u[k + 1].times(k + 1)
            if self.bends:
                y.append(sine if self.rig.absolute else zero())
                x.append(u[k] + y[k])
                x2.append(x.product(x, k))
                y2.append(y.product(y, k))
                force -= bend * (x2.product(x, k) - y2.product(y, k))
            pulled = drive * cosine
            for v, dx, dy, turned in changes:
                pull = pulled * turned - spring * v[k] - damping * v[k + 1].times(k + 1)
                if self.bends:
                    dy.append(cosine * turned if self.rig.absolute else zero())
                    dx.append(v[k] + dy[k])
                    pull -= (bend * (x2.product(dx, k) - y2.product(dy, k))).times(3)
                v.append(pull.over((k + 1) * (k + 2)))
            u.append(force.over((k + 1) * (k + 2)))
            sine, cosine = (angle * cosine).over(k + 1), -(angle * sine).over(k + 1)
        return [u, *(v for v, *_ in changes)]


class Step:
    """All motions from the box `cloud`, for an exact `length`; `point` is one state of the box, and `changes` are those of its motions."""

    def __init__(self, phase: Phase, length: Ball, point: State, cloud: State, changes: list[State]) -> None:
        self.phase, self.length = phase, length
        order = next(n for n in count(4) if n * log2(float(length) * phase.rate) - lgamma(n + 1) / log(2) < -Ball.bits)
        met, met_changes = phase.within(cloud, changes, length)
        rest = phase.series(met, length, met_changes, order)
        around, *moved = phase.series(cloud, length, changes, order - 1)
        middle = phase.series(point, length, [], order - 1)[0]
        for series, last in zip((around, *moved, middle), (*rest, rest[0]), strict=True):
            series.append(last[order])
        self.cloud, self.point = (cloud[0], around), (point[0], middle)
        self._last_but_one, self._changes = rest[0][order - 1], [(change[0], v) for change, v in zip(changes, moved, strict=True)]

    def state(self, path: Path, theta: Ball) -> State:
        """At a share theta of the step."""
        return path[0] + theta * self.length, path[1].at(theta), path[1].slope().at(theta) / self.length

    def changes(self, theta: Ball) -> list[State]:
        """What the states of the whole box, at theta, change by."""
        return [(since, v.at(theta), v.slope().at(theta) / self.length) for since, v in self._changes]

    def surface(self, name: str, path: Path, end: Ball) -> Series:
        """u - g, P or T - end in theta. The remainder of u' comes one coefficient earlier than that of u."""
        since, place, speed = self.phase.normal(name)
        u, speed = path[1], speed / self.length
        terms = [place * x + speed * u[n].times(n) for n, x in enumerate([*(u[n] for n in range(len(u) - 2)), self._last_but_one], 1)]
        terms[0] += since * (path[0] - end) - place * self.phase.rig.gap
        terms[1] += since * self.length
        return Series(*terms)
