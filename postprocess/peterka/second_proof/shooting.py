"""q cycles of the cart from a box of states in flight: all its motions at once, through contacts in their order, with the
derivative of the last state with respect to the first. If Newton's interval operator maps the box into itself, exactly one
motion of the box has the period q.

What a leg between two events must show of each of its moments: in flight that u < g or P < 0 (before a rigid stop that u < g), in contact
that P > 0. Next to an event, where these hold by less than the box is wide, the sign of a slope takes their place.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from .balls import Ball, Series, Undecided, from_0_to, one, sine_cosine, zero
from .motion import Pair, Phase, Rig, Step

TOUCH, RELEASE, RENEWED, BOUNCE, REBOUND = "touch", "release", "renewed contact", "bounce", "rebound"
_DIRECTION = {TOUCH: 1, RELEASE: -1, RENEWED: 1, BOUNCE: 1, REBOUND: -1}  # in which its surface is crossed
SMALLEST_PIECE = 2.0**-24  # of a step
Matrix = tuple[Pair, Pair]


@dataclass
class Guess:
    """A periodic orbit as it is thought to be: time [turns] and state in flight, events [(time, kind)] until q turns later."""

    time: float
    state: tuple[float, float]
    events: list[tuple[float, str]]
    period: int


@dataclass
class Passage:
    """What q cycles from a box lead to: the last state of its middle, the derivative of the last state with respect to the first,
    all states of the box at the times that were asked for, and bounds of the largest P; of a rigid stop of the largest du/(omega dt)."""

    end: Pair
    flow: Matrix
    stops: dict[float, Pair]
    force: Ball


class Shot:
    """Follows the box `start` +- radius (in units of 2**-bits) through the guess's events; raises Undecided where it can't.
    With radius 0 only to see where the middle goes: nothing is shown then."""

    def __init__(self, rig: Rig, guess: Guess, start: Pair, radius: int, stops: Iterable[float] = ()) -> None:
        self._phases = {pressed: Phase(rig, pressed) for pressed in (False, True)}
        self._pressed, self._radius = False, radius
        self._time, self._point = Ball.of(guess.time), start
        self._flow: Matrix = ((one(), zero()), (zero(), one()))
        self._last_event = ""  # that next to which the box still is
        self._contacts: list[tuple[Series, int]] = []  # P along each step in contact, until this theta
        self._jumps: list[Ball] = []  # P next to each first touch; du/(omega dt) before each bounce
        self._met: dict[float, Pair] = {}
        for time, event in sorted([*guess.events, *((time, "") for time in stops), (guess.time + guess.period, "")]):
            self._leg(time, event)
            if not event:
                self._met[time] = self._cloud()

    def passage(self) -> Passage:
        """What was gathered on the way."""
        force = _largest(self._contacts, self._jumps) if self._radius else zero()
        return Passage(self._point, self._flow, self._met, force)

    def _cloud(self) -> Pair:
        spread = Ball(0, self._radius)
        (a, b), (c, d) = self._flow
        return self._point[0] + a * spread + b * spread, self._point[1] + c * spread + d * spread

    def _leg(self, until: float, event: str) -> None:
        """To a time, or through the event near it."""
        phase, end = self._phases[self._pressed], Ball.of(until)
        if end.middle <= self._time.middle:
            if end.middle == self._time.middle and not event:
                return
            raise Undecided("events in another order than was thought")
        count = int((until - float(self._time)) / phase.longest_step()) + 1
        for steps_left in range(count, 0, -1):
            length = Ball((end - self._time).middle // steps_left)
            if event and steps_left == 1:
                length = Ball(length.middle + (length.middle >> 6))  # the events of the whole box shall lie within
            cloud = self._cloud()
            if max(cloud[0].radius, cloud[1].radius) > one().middle >> 8:
                raise Undecided("growth too strong for this box")
            step = Step(phase, self._time, length, self._point, cloud)
            if event and steps_left == 1:
                self._bounce(step) if event == BOUNCE else self._pass(step, event)
                return
            self._show(step, one().middle, "")
            if self._pressed:
                self._contacts.append((step.pressure(step.cloud), one().middle))
            self._point = step.state(step.point, one())
            self._flow = _product(step.flow(one()), self._flow)
            self._time += length

    def _pass(self, step: Step, event: str) -> None:
        """From a time before an event of any motion of the box to one after all of these."""
        earlier, later = self._phases[self._pressed], self._phases[not self._pressed]
        surface = step.penetration if event == TOUCH else step.pressure
        of_cloud, of_point = surface(step.cloud), surface(step.point)
        theta = _zero_of(of_point)
        before, between, after = _around(of_cloud, theta, _DIRECTION[event])
        point_before, _, point_after = _around(of_point, theta, _DIRECTION[event])
        if not _has_sign(of_cloud.slope().at(between), _DIRECTION[event]):
            raise Undecided("an event without a definite speed (near a grazing)")
        self._show(step, before.middle, event)

        start = self._time + before * step.length
        end = Ball((self._time + after * step.length).high + 8)
        at_event = step.state(step.cloud, between)
        met = later.within(start, end - start, at_event)
        met = met[0].hull(at_event[0]), met[1].hull(at_event[1])
        sine = sine_cosine(start + from_0_to(end - start))[0]
        change = later.acceleration(met, sine)
        self._show_after(event, met, change)
        if event == TOUCH:
            self._jumps.append(later.pressure_at(met))
        if self._pressed:
            self._contacts.append((of_cloud, before.middle))

        near = [_near_identity(phase, met, sine, end - start) for phase in (earlier, later)]
        jump = -(later.turn * later.rig.damping) if event == TOUCH else zero()  # P jumps there by chi/s du/dT
        saltation = (one(), zero()), (jump, one())
        self._flow = _product(near[1], _product(saltation, _product(near[0], _product(step.flow(before), self._flow))))
        pause = (point_after - point_before) * step.length
        u, w = step.state(step.point, point_before)
        point = u + pause * met[1], w + pause * change.hull(earlier.acceleration(met, sine))
        since = self._time + point_after * step.length
        wait = end - since  # until the whole box has had the event
        met = later.within(since, wait, point)
        sine = sine_cosine(since + from_0_to(wait))[0]
        self._point = point[0] + wait * met[1], point[1] + wait * later.acceleration(met, sine)
        self._time = end
        self._pressed, self._last_event = not self._pressed, event

    def _bounce(self, step: Step) -> None:
        """The same for a bounce from a rigid stop."""
        flight, r = self._phases[False], self._phases[False].rig.restitution
        assert r is not None
        gap = flight.rig.gap
        of_cloud, of_point = step.penetration(step.cloud), step.penetration(step.point)
        theta = _zero_of(of_point)
        before, between, after = _around(of_cloud, theta, 1)
        point_before, _, point_after = _around(of_point, theta, 1)
        position, arriving = step.state(step.cloud, between)
        if not _has_sign(arriving, 1):
            raise Undecided("an impact without a definite speed (near a grazing)")
        self._show(step, before.middle, BOUNCE)

        start = self._time + before * step.length
        end = Ball((self._time + after * step.length).high + 8)
        sine = sine_cosine(start + from_0_to(end - start))[0]
        leaving = flight.within(start, end - start, (gap, -(r * arriving)))
        if self._radius and not _has_sign(leaving[1], -1):
            raise Undecided("an impact that another may follow at once")
        self._jumps.append(arriving / flight.turn)
        a, b = flight.acceleration((gap, arriving), sine), flight.acceleration((gap, -(r * arriving)), sine)
        saltation = (-r, zero()), ((b + r * a) / arriving, -r)
        near = _near_identity(flight, (position.hull(leaving[0]), arriving), sine, end - start)
        self._flow = _product(near, _product(saltation, _product(near, _product(step.flow(before), self._flow))))

        pause = (point_after - point_before) * step.length
        _, w = step.state(step.point, point_before)
        w = -(r * (w + from_0_to(pause) * flight.acceleration((position, arriving), sine)))
        met = leaving[0], leaving[1].hull(w)
        point = gap + from_0_to(pause) * met[1], w + from_0_to(pause) * flight.acceleration(met, sine)
        since = self._time + point_after * step.length
        wait = end - since
        met = flight.within(since, wait, point)
        sine = sine_cosine(since + from_0_to(wait))[0]
        self._point = point[0] + wait * met[1], point[1] + wait * flight.acceleration(met, sine)
        self._time, self._last_event = end, REBOUND

    def _show(self, step: Step, until: int, event: str) -> None:
        """That until this theta, where `event` follows if there is one, the step's motions have no event."""
        if not self._radius:
            return
        delta, pressure = step.penetration(step.cloud), step.pressure(step.cloud)
        slopes = {TOUCH: delta.slope(), RELEASE: pressure.slope()}
        slopes |= {RENEWED: slopes[RELEASE], BOUNCE: slopes[TOUCH], REBOUND: slopes[TOUCH]}

        def is_next_to(event: str, piece: Ball) -> bool:
            return _has_sign(slopes[event].at(piece), _DIRECTION[event])

        def is_clear(piece: Ball) -> bool:
            if self._pressed:
                return _has_sign(pressure.over(slopes[RELEASE], piece), 1)
            return _has_sign(delta.over(slopes[TOUCH], piece), -1) or _has_sign(pressure.over(slopes[RELEASE], piece), -1)

        last = until
        if event:
            tails = (until - (until >> halvings) for halvings in range(24))
            last = next((first for first in tails if is_next_to(event, Ball.between(first, until))), -1)
            if last < 0:
                raise Undecided("a slow approach to an event (near a grazing)")
        pieces = [(0, last)]
        while pieces:
            first, last = pieces.pop()
            piece = Ball.between(first, last)
            if self._last_event and is_next_to(self._last_event, piece):
                continue
            if is_clear(piece):
                self._last_event = ""
            elif last - first < one().middle * SMALLEST_PIECE:
                raise Undecided("a leg that nearly has another event (near a grazing)")
            else:
                middle = (first + last) >> 1
                pieces += [(middle, last), (first, middle)]

    def _show_after(self, event: str, met: Pair, acceleration: Ball) -> None:
        """That there is no event while all motions of the box have theirs."""
        if not self._radius:
            return
        rig, turn = self._phases[True].rig, self._phases[True].turn
        slope = met[1] if event == TOUCH else rig.stiffness * met[1] + rig.damping / turn * acceleration
        if not _has_sign(slope, _DIRECTION[event]) or (event == RENEWED and not _has_sign(met[0] - rig.gap, 1)):
            raise Undecided("an event that another may follow at once")


def _product(a: Matrix, b: Matrix) -> Matrix:
    (p, q), (r, s) = b
    return tuple((x * p + y * r, x * q + y * s) for x, y in a)  # type: ignore[return-value]


def _has_sign(ball: Ball, sign: int) -> bool:
    return ball.low > 0 if sign > 0 else ball.high < 0


def _zero_of(series: Series) -> Ball:
    """Near a zero towards the end of the step, by Newton's method, which proves nothing."""
    theta, slope = Ball.of(64 / 65), series.slope()
    for _ in range(12):
        theta = Ball((theta - Ball(series.at(theta).middle) / Ball(slope.at(theta).middle)).middle)
        if not 0 < theta.middle < one().middle:
            raise Undecided("an event that isn't where it was thought to be")
    return theta


def _around(series: Series, theta: Ball, direction: int) -> tuple[Ball, Ball, Ball]:
    """An exact moment before the zeros of all functions in a series, all moments until after them, and the last of these."""
    slope = abs(series.slope().at(theta).middle)
    width = (2 * series.at(theta).size << Ball.bits) // max(slope, 1) + 16
    before, after = Ball(theta.middle - width), Ball(theta.middle + width)
    if before.middle < 0 or after.middle > one().middle:
        raise Undecided("an event that may lie anywhere (near a grazing)")
    if not (_has_sign(series.at(before), -direction) and _has_sign(series.at(after), direction)):
        raise Undecided("an event that can't be enclosed (near a grazing)")
    return before, Ball(theta.middle, width), after


def _near_identity(phase: Phase, met: Pair, sine: Ball, wait: Ball) -> Matrix:
    """Encloses the flow's derivative over times up to `wait`, by exp(x) - 1 <= 2 x for 0 <= x <= 1."""
    norm = Ball(max(one().middle, phase.slope(met[0], sine).size + phase.damping.size)) * wait
    if norm.size > one().middle:
        raise Undecided("an event that may lie anywhere (near a grazing)")
    rest = Ball(0, 2 * norm.size)
    return (one() + rest, rest), (rest, one() + rest)


def _largest(contacts: list[tuple[Series, int]], jumps: list[Ball]) -> Ball:
    """Encloses the largest P, by branch and bound."""
    lower, upper = max(jump.low for jump in jumps), max(jump.high for jump in jumps)
    for series, until in contacts:
        slopes, pieces = series.slope(), [(0, until)]
        while pieces:
            first, last = pieces.pop()
            piece = Ball.between(first, last)
            at_middle = series.at(Ball(piece.middle))
            lower = max(lower, at_middle.low)
            ends = [series.at(Ball(end)) for end in (first, last)]
            lower = max(lower, *(end.low for end in ends))
            slope = slopes.at(piece)
            bound = max(end.high for end in ends) if slope.low > 0 or slope.high < 0 else series.over(slopes, piece).high
            if bound <= lower + (lower >> 44) + 4 * at_middle.radius or last - first < one().middle * SMALLEST_PIECE:
                upper = max(upper, bound)
            else:
                pieces += [(first, (first + last) >> 1), ((first + last) >> 1, last)]
    return Ball.between(lower, upper)


@dataclass
class Orbit:
    """Of the one periodic orbit in the box `start`: enclosures of its states at the times asked for, of trace and determinant of the
    derivative of q cycles, and of its largest P."""

    stops: dict[float, Pair]
    start: Pair
    trace: Ball
    determinant: Ball
    force: Ball


def newton_step(passage: Passage, start: Pair) -> Pair:
    """What Newton's method adds to the start so that it returns to itself; with a passage of a box, an enclosure of what leads from
    its middle to any orbit in it."""
    (a, b), (c, d) = passage.flow
    a, d = a - one(), d - one()
    u, w = passage.end[0] - start[0], passage.end[1] - start[1]
    determinant = a * d - b * c
    return (b * w - d * u) / determinant, (c * u - a * w) / determinant


def growth_of(rig: Rig, guess: Guess) -> int:
    """About how many bits the steps' balls lose on the way, most of them in long contacts."""
    begun = [(guess.time, ""), *guess.events]
    ends = [*(time for time, _ in guess.events), guess.time + guess.period]
    rates = [Phase(rig, pressed).rate for pressed in (False, True)]
    return int(1.5 * sum((end - time) * rates[event in (TOUCH, RENEWED)] for (time, event), end in zip(begun, ends, strict=True)))


def prove(rig: Rig, guess: Guess, radius: int, stops: Iterable[float]) -> Orbit:
    """The orbit near a guess, in a box of this radius in units of 2**-bits. Raises Undecided."""
    start = Ball.of(guess.state[0]), Ball.of(guess.state[1])
    for _ in range(12):
        u, w = newton_step(Shot(rig, guess, start, 0).passage(), start)
        start = Ball((start[0] + u).middle), Ball((start[1] + w).middle)
        if max(abs(u.middle), abs(w.middle)) < radius >> 6:
            break
    passage = Shot(rig, guess, start, radius, stops).passage()
    moved = newton_step(passage, start)
    if max(moved[0].size, moved[1].size) >= radius:
        raise Undecided("no box that q cycles surely map into itself (near where the orbit ends, or growth too strong)")
    (a, b), (c, d) = passage.flow
    box = Ball(start[0].middle, radius), Ball(start[1].middle, radius)
    return Orbit(passage.stops, box, a + d, a * d - b * c, passage.force)
