"""q cycles of the cart from a box of states in flight: all its motions at once, through contacts in their order, with the
derivative of the last state with respect to the first. If Newton's interval operator maps the box into itself, exactly one
motion of the box has the period q.

Each motion of the box has its own time: a leg ends where the motion meets a surface, that of an event or a moment of time, so that the
next begins there with all motions on this surface. What each state (T, u, du/dT) changes by is projected onto it along the motion.

What a leg between two events must show of each of its moments: in flight that u < g or P < 0 (before a rigid stop that u < g), in contact
that P > 0. Where these hold by less than the box is wide, the sign of a slope takes their place: after an event, on whose surface
the motions began, and before one, on whose other side they end.
"""

from dataclasses import dataclass
from itertools import pairwise

from .balls import Ball, Series, Undecided, one, zero
from .motion import DEPTH, PRESSURE, TIME, Phase, Rig, State, Step

TOUCH, RELEASE, RENEWED, BOUNCE, REBOUND = "touch", "release", "renewed contact", "bounce", "rebound"
ARRIVAL = ""  # at a moment of time
_SURFACE = {TOUCH: (DEPTH, 1), RELEASE: (PRESSURE, -1), RENEWED: (PRESSURE, 1), BOUNCE: (DEPTH, 1), REBOUND: (DEPTH, -1), ARRIVAL: (TIME, 1)}
SMALLEST_PIECE = 2.0**-24  # of a step
Pair = tuple[Ball, Ball]  # u and du/dT


@dataclass
class Guess:
    """A periodic orbit as it is thought to be: time [turns] and state in flight, events [(time, kind)] until q turns later."""

    time: float
    state: tuple[float, float]
    events: list[tuple[float, str]]
    period: int


@dataclass
class Orbit:
    """Of the one periodic orbit in a box: enclosures of its start, of its states after each cycle and at phase 0 after q, of trace and
    determinant of the derivative of q cycles, and of its largest P, or du/(omega dt) before impacts on a rigid stop."""

    box: Pair
    start: Pair
    stops: dict[float, Pair]
    trace: Ball
    determinant: Ball
    force: Ball


class Shot:
    """Follows the box `start` +- radius (in units of 2**-bits) through the guess's events; raises Undecided where it can't. At the end
    `point` is the state of its middle, `changes` are those by the first u and du/dT, `stops` has all states after each cycle and at phase 0.
    With radius 0 only to see where the middle goes: nothing is shown then."""

    def __init__(self, rig: Rig, guess: Guess, start: Pair, radius: int) -> None:
        self._phases = {pressed: Phase(rig, pressed) for pressed in (False, True)}
        self._pressed, self._radius = False, radius
        self.point: State = (Ball.of(guess.time), *start)
        self.changes: list[State] = [(zero(), one(), zero()), (zero(), zero(), one())]
        self.stops: dict[float, Pair] = {}
        times = {float(guess.period), *(guess.time + cycle for cycle in range(1, guess.period + 1))}
        self._last_event = ""  # that next to which the box still is
        self._contacts: list[tuple[Series, int]] = []  # P along each step in contact, until this theta
        self._impacts = [zero()]  # du/(omega dt) before each bounce
        for time, event in sorted([*guess.events, *((time, ARRIVAL) for time in times if time > guess.time)]):
            self._leg(Ball.of(time), event)
            if event == ARRIVAL:
                self.stops[time] = self._cloud()[1:]

    def largest(self) -> Ball:
        """Encloses the largest P, or du/(omega dt) before a bounce, by branch and bound."""
        lower, upper = max(impact.low for impact in self._impacts), max(impact.high for impact in self._impacts)
        for series, until in self._contacts:
            slopes, pieces = series.slope(), [(0, until)]
            while pieces:
                first, last = pieces.pop()
                piece, ends = Ball.between(first, last), [series.at(Ball(end)) for end in (first, last)]
                lower, slope = max(lower, *(end.low for end in ends)), slopes.at(piece)
                bound = max(end.high for end in ends) if _has_sign(slope, 1) or _has_sign(slope, -1) else series.over(slopes, piece).high
                if bound <= lower + (lower >> 44) + 4 * ends[0].radius or last - first < one().middle * SMALLEST_PIECE:
                    upper = max(upper, bound)
                else:
                    pieces += [(first, (first + last) >> 1), ((first + last) >> 1, last)]
        return Ball.between(lower, upper)

    def _cloud(self) -> State:
        spread = Ball(0, self._radius)
        return tuple(x + a * spread + b * spread for x, a, b in zip(self.point, *self.changes, strict=True))  # type: ignore[return-value]

    def _leg(self, end: Ball, event: str) -> None:
        """To a time, or to the event near it."""
        phase = self._phases[self._pressed]
        count = max(int(float(end - self.point[0]) * phase.rate / 0.8), 0) + 1
        for steps_left in range(count, 0, -1):
            share = 65 if steps_left == 1 else 64  # the last step goes on for a bit, so that all ends of the box lie within
            length = Ball((end - self.point[0]).middle * share // (64 * steps_left))
            if length.middle <= 0:
                raise Undecided("events in another order than was thought")
            step = Step(phase, length, self.point, self._cloud(), self.changes)
            if steps_left == 1:
                return self._arrive(step, end, event)
            self._show(step, one().middle, ARRIVAL)
            self.point, self.changes = step.state(step.point, one()), step.changes(one())

    def _arrive(self, step: Step, end: Ball, event: str) -> None:
        """On a surface, and through its event."""
        (name, direction), rig = _SURFACE[event], step.phase.rig
        if event and (event == BOUNCE) != (rig.restitution is not None) or (event and self._pressed != (event == RELEASE)):
            raise Undecided("an event that can't follow")
        of_point, of_cloud = (step.surface(name, path, end) for path in (step.point, step.cloud))
        by_time, by_place, by_speed = step.phase.normal(name)
        theta = _zero_of(of_point)
        at_point, between = _around(of_point, theta, direction), _around(of_cloud, theta, direction)
        if self._radius and not between.holds(at_point):
            raise Undecided("an event that isn't enclosed (near a grazing)")
        speed = of_cloud.slope().at(between) / step.length
        self._show(step, between.high, event)
        state, projected = step.state(step.cloud, between), []
        acceleration = step.phase.accelerations(state, [])[0]
        for since, v, w in step.changes(between):
            shift = -((by_time * since + by_place * v + by_speed * w) / speed)
            projected.append((since + shift, v + shift * state[2], w + shift * acceleration))
        self.changes, self.point = projected, step.state(step.point, at_point)
        if event == ARRIVAL:
            return
        self._pressed, self._last_event = event in (TOUCH, RENEWED), event
        if event == RENEWED and not _has_sign(state[1] - rig.gap, 1):
            raise Undecided("a renewed contact that may be a first one")
        if event == BOUNCE:
            rebound = -(rig.restitution or zero())
            self._impacts.append(state[2] / step.phase.turn)
            self.point = self.point[0], rig.gap, rebound * self.point[2]
            self.changes = [(since, zero(), rebound * w) for since, _, w in projected]
            self._last_event = REBOUND

    def _show(self, step: Step, until: int, event: str) -> None:
        """That until this theta, at which `event` is over if there is one, the step's motions have no other."""
        surfaces = {name: step.surface(name, step.cloud, zero()) for name in (DEPTH, PRESSURE)}
        slopes = {name: surface.slope() for name, surface in surfaces.items()}
        if self._pressed:
            self._contacts.append((surfaces[PRESSURE], until))

        def crosses(event: str, piece: Ball) -> bool:
            name, direction = _SURFACE[event]
            return name in slopes and _has_sign(slopes[name].at(piece), direction)

        def is_clear(piece: Ball) -> bool:
            sides = [(PRESSURE, 1)] if self._pressed else [(DEPTH, -1), (PRESSURE, -1)]
            return any(_has_sign(surfaces[name].over(slopes[name], piece), sign) for name, sign in sides)

        pieces = [(0, until)] if self._radius else []
        while pieces:
            first, last = pieces.pop()
            piece = Ball.between(first, last)
            if crosses(self._last_event, piece):
                continue
            if is_clear(piece):
                self._last_event = ""
            elif crosses(event, Ball.between(first, until)):
                return
            elif last - first < one().middle * SMALLEST_PIECE:
                raise Undecided("a leg that nearly has another event (near a grazing)")
            else:
                pieces += [((first + last) >> 1, last), (first, (first + last) >> 1)]


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


def _around(series: Series, theta: Ball, direction: int) -> Ball:
    """Encloses a zero of each function in a series, before which it has one sign and after which the other."""
    width = (2 * series.at(theta).size << Ball.bits) // max(abs(series.slope().at(theta).middle), 1) + 16
    before, after = Ball(theta.middle - width), Ball(theta.middle + width)
    if before.middle < 0 or after.middle > one().middle:
        raise Undecided("an event that may lie anywhere (near a grazing)")
    if not (_has_sign(series.at(before), -direction) and _has_sign(series.at(after), direction)):
        raise Undecided("an event that can't be enclosed (near a grazing)")
    return Ball(theta.middle, width)


def newton_step(shot: Shot, start: Pair) -> Pair:
    """What Newton's method adds to the start so that it returns to itself; with a shot of a box, an enclosure of what leads from
    its middle to any orbit in it."""
    (_, a, c), (_, b, d) = shot.changes
    a, d, u, w = a - one(), d - one(), shot.point[1] - start[0], shot.point[2] - start[1]
    determinant = a * d - b * c
    return (b * w - d * u) / determinant, (c * u - a * w) / determinant


def growth_of(rig: Rig, guess: Guess) -> int:
    """About how many bits the steps' balls lose on the way, most of them in long contacts."""
    legs = pairwise([(guess.time, RELEASE), *guess.events, (guess.time + guess.period, ARRIVAL)])
    return int(1.5 * sum((end - begin) * Phase(rig, event in (TOUCH, RENEWED)).rate for (begin, event), (end, _) in legs))


def prove(rig: Rig, guess: Guess) -> Orbit:
    """The orbit near a guess, in a box a thousand times as large as what its middle may be wrong by. Raises Undecided."""
    start, radius = (Ball.of(guess.state[0]), Ball.of(guess.state[1])), 0
    for _ in range(12):
        move = newton_step(Shot(rig, guess, start, 0), start)
        start, radius = (Ball((start[0] + move[0]).middle), Ball((start[1] + move[1]).middle)), max(x.size for x in move) << 10
        if all(abs(x.middle) <= x.radius for x in move):
            break
    shot = Shot(rig, guess, start, radius)
    move = newton_step(shot, start)
    if max(x.size for x in move) >= radius:
        raise Undecided("no box that q cycles surely map into itself (near where the orbit ends, or growth too strong)")
    (_, a, c), (_, b, d) = shot.changes
    box = Ball(start[0].middle, radius), Ball(start[1].middle, radius)
    return Orbit(box, (start[0] + move[0], start[1] + move[1]), shot.stops, a + d, a * d - b * c, shot.largest())
