"""The motion of a hammer in a cart, piecewise in closed form.

    m (u'' + y'') + c u' + k u = -F,   F = max(0, ki (u - gap) + ci u') beyond the gap, 0 before it

u is the hammer's position relative to the cart and y the cart's position, with harmonic acceleration -y'' = Re(a exp(i W
t)); a = 0 is a cart at rest. Flight and contact are damped oscillators under a harmonic force, so each piece, and its mean
over any interval, is known at any time without time stepping.
"""

import cmath
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from ..arrays import Integers, Reals
from .contact_pulse import pulse

LONGEST_SEARCH = 200
MOST_IMPACTS = 500  # of one motion; later ones are too weak to be recorded
PER_PERIOD = 40  # points per period of springs or cart at which a flight is checked
SHORTEST = 1e-12  # s: shortest contact, and the accuracy of event times
NEWTON = 12  # steps


@dataclass(frozen=True)
class Rig:
    """mass [kg], stiffness ki [N/m] and damping ci [Ns/m] of the stop, omega [rad/s] and damping ratio of the springs, gap [m]."""

    mass: float
    stiffness: float
    damping: float
    omega: float
    damping_ratio: float
    gap: float


@dataclass(frozen=True)
class Cart:
    """omega W [rad/s] and the complex a [m/s^2]: y'' = -Re(a exp(i W t)), y = Re(a exp(i W t))/W^2."""

    omega: float = 1.0
    drive: complex = 0j

    def signal(self, time: Reals | float, order: int) -> Reals:
        """y (order 0), its derivatives [m/s^order], or its integral (order -1) at these times."""
        values: Reals = (self.drive / self.omega**2 * (1j * self.omega)**order * np.exp(1j * self.omega * np.asarray(time))).real
        return values


@dataclass(frozen=True)
class Piece:
    """From `begin` [s] on, u [m] is `rest` plus the real part of the sum of amplitude exp(root s), s = time since `begin`;
    `forced` is the (root, amplitude) of the response to the cart."""

    begin: float
    contact: bool
    rest: float
    roots: tuple[complex, complex]
    amplitudes: tuple[complex, complex]
    forced: tuple[complex, complex]

    def derivative(self, order: int, time: Reals | float) -> Reals:
        """The order-th derivative of u at these times; order -1 is its integral since `begin`, up to a constant."""
        since: Reals = np.asarray(time) - self.begin
        total: Reals
        if self.roots[0].imag:  # a conjugate pair
            total = 2 * (self.amplitudes[0] * self.roots[0]**order * np.exp(self.roots[0] * since)).real
        else:
            total = sum(a.real * r.real**order * np.exp(r.real * since) for a, r in zip(self.amplitudes, self.roots))
        if self.forced[1]:
            total = total + (self.forced[1] * self.forced[0]**order * np.exp(self.forced[0] * since)).real
        total = total + (self.rest if order == 0 else self.rest * since if order == -1 else 0.0)
        return total


    def at(self, time: float) -> tuple[float, float, float]:
        """(u, u', u'') at a single time; faster than derivative()."""
        since = time - self.begin
        u, v, a = self.rest, 0.0, 0.0
        for root, amplitude in (*zip(self.roots, self.amplitudes), self.forced):
            if amplitude:
                term = amplitude * cmath.exp(root * since)
                speed = term * root
                u, v, a = u + term.real, v + speed.real, a + (speed * root).real
        return u, v, a


@dataclass(frozen=True)
class Motion:
    """Pieces in order of time; the first, a flight, begins at the first touch and also holds before it."""

    rig: Rig
    cart: Cart
    pieces: list[Piece]

    @property
    def touches(self) -> Reals:
        """Times at which contacts begin."""
        return np.array([piece.begin for piece in self.pieces if piece.contact])

    def contacts(self) -> list[tuple[float, float]]:
        """(begin, end) of each contact that ended."""
        return [(piece.begin, after.begin) for piece, after in zip(self.pieces, self.pieces[1:]) if piece.contact]

    def signals(self, time: Reals, names: Iterable[str], places: Integers | None = None) -> dict[str, Reals]:
        """{name: values at these ascending times} of force [N], acceleration of the hammer [m/s^2], displacement of the hammer in the
        cart [m], cart_displacement [m] and cart_acceleration [m/s^2]. `places`: index of the first of these times in each contact, if
        given independently of the touches: contacts are then extended before their touches as smooth functions."""
        return self._by_pieces(time, names, self._signal, places)

    def means(self, begins: Reals, ends: Reals, names: Iterable[str]) -> dict[str, Reals]:
        """{name: means of these signals from begins to ends}, both ascending."""
        edges = np.unique(np.concatenate([begins, ends]))
        integrals = self._by_pieces(edges, names, self._integral)
        for name, values in integrals.items():
            for piece, after in zip(self.pieces, self.pieces[1:]):  # match integration constants to make them one continuous function
                at = np.array([after.begin])
                jump = self._integral(piece, at, name) - self._integral(after, at, name)
                values[edges >= after.begin] += jump
        first, last = np.searchsorted(edges, begins), np.searchsorted(edges, ends)
        return {name: (values[last] - values[first]) / (ends - begins) for name, values in integrals.items()}

    def _by_pieces(self, time: Reals, names: Iterable[str], values_of: Callable[[Piece, Reals, str], Reals | float],
                   places: Integers | None = None) -> dict[str, Reals]:
        found = {name: np.empty(len(time)) for name in names}
        ends = np.searchsorted(time, [piece.begin for piece in self.pieces[1:]])
        if places is not None:
            contacts = np.flatnonzero([piece.contact for piece in self.pieces[1:]])[:len(places)]
            ends[contacts] = places[:len(contacts)]
            ends = np.maximum.accumulate(ends)
        for piece, first, last in zip(self.pieces, [0, *ends], [*ends, len(time)]):
            if first < last:
                for name in found:
                    found[name][first:last] = values_of(piece, time[first:last], name)
        return found

    def _signal(self, piece: Piece, time: Reals, name: str) -> Reals | float:
        if name == "displacement":
            return piece.derivative(0, time)
        if name == "acceleration":
            return piece.derivative(2, time) + self.cart.signal(time, 2)
        if name.startswith("cart_"):
            return self.cart.signal(time, 2 if name == "cart_acceleration" else 0)
        return force_of(self.rig, piece, time) if piece.contact else 0.0

    def _integral(self, piece: Piece, time: Reals, name: str) -> Reals:
        if name == "displacement":
            return piece.derivative(-1, time)
        if name == "acceleration":
            return piece.derivative(1, time) + self.cart.signal(time, 1)
        if name.startswith("cart_"):
            return self.cart.signal(time, 1 if name == "cart_acceleration" else -1)
        if not piece.contact:
            return np.zeros(len(time))
        lengths = piece.derivative(-1, time) - self.rig.gap * (time - piece.begin)
        return self.rig.stiffness * lengths + self.rig.damping * piece.derivative(0, time)


def force_of(rig: Rig, piece: Piece, time: Reals) -> Reals:
    """ki (u - gap) + ci u' [N] at these times, of either sign."""
    return rig.stiffness * (piece.derivative(0, time) - rig.gap) + rig.damping * piece.derivative(1, time)


def motion(rig: Rig, cart: Cart, touch_time: float, touch_speed: float, until: float, most: int = MOST_IMPACTS) -> Motion:
    """The Motion that first touches the stop at this time and speed, with all impacts that begin before `until` [s]; after
    `most` impacts the hammer continues as if there were no stop."""
    pieces = [_piece(rig, cart, touch_time, rig.gap, touch_speed, contact=False)]
    for number in range(most):
        pieces.append(contact := _piece(rig, cart, touch_time, rig.gap, touch_speed, contact=True))
        end = _end_of_contact(rig, contact, until)
        if end is None:
            break
        u, v, _ = contact.at(end)
        flight = _piece(rig, cart, end, u, v, contact=False)
        pieces.append(flight)
        touch = next_touch(rig, cart, flight, until) if number + 1 < most else None
        if touch is None:
            break
        touch_time, touch_speed = touch, flight.at(touch)[1]
    return Motion(rig, cart, pieces)


def _piece(rig: Rig, cart: Cart, begin: float, u: float, speed: float, contact: bool) -> Piece:
    stiffness = rig.omega**2 + rig.stiffness / rig.mass * contact
    decay = rig.damping_ratio * rig.omega + rig.damping * contact / (2 * rig.mass)
    rest = rig.stiffness / rig.mass * rig.gap / stiffness if contact else 0.0
    swing = np.sqrt(complex(decay**2 - stiffness))
    if abs(swing) < 1e-7 * abs(decay):  # a double root: separated by less than any measurement resolves
        swing = complex(1e-7 * decay)
    roots = -decay + swing, -decay - swing
    root = 1j * cart.omega
    amplitude = cart.drive * np.exp(root * begin) / (stiffness - cart.omega**2 + 2 * decay * root) if cart.drive else 0j
    away, speed = u - rest - amplitude.real, speed - (amplitude * root).real
    first = (speed - roots[1] * away) / (roots[0] - roots[1])
    return Piece(begin, contact, rest, roots, (first, away - first), (root, amplitude))


def _end_of_contact(rig: Rig, contact: Piece, until: float) -> float | None:
    """The time at which the force falls to 0; None if not before `until`."""
    def force(time: float) -> float:
        u, v, _ = contact.at(time)
        return rig.stiffness * (u - rig.gap) + rig.damping * v

    end = free = pulse(rig.mass, rig.stiffness, rig.damping)[1]  # contact time of a free mass
    for _ in range(NEWTON):
        u, v, a = contact.at(contact.begin + end)
        slope = rig.stiffness * v + rig.damping * a
        change = (rig.stiffness * (u - rig.gap) + rig.damping * v) / slope if slope else np.inf
        if not abs(change) < 0.3 * free:
            break
        end -= change
        if abs(change) < SHORTEST * free:
            return contact.begin + end if slope < 0 else _searched_end(contact, force, until)
    return _searched_end(contact, force, until)


def _searched_end(contact: Piece, force: Callable[[float], float], until: float) -> float | None:
    """The same, by stepping."""
    step = 0.05 / abs(contact.roots[1])  # the faster root if overdamped
    for _ in range(LONGEST_SEARCH):
        if force(contact.begin + 1.3 * step) <= 0:
            begin = contact.begin + (step if force(contact.begin + step) > 0 else 0.0)
            return brentq(force, begin, contact.begin + 1.3 * step, xtol=1e-15) if force(begin) > 0 else begin
        step *= 1.3
        if contact.begin + step > until:
            return None
    return None


def next_touch(rig: Rig, cart: Cart, flight: Piece, until: float) -> float | None:
    """The time at which a flight meets the stop: u reaches the gap, or the force rises from 0 beyond it; None if not before `until`."""
    def over(time: float) -> float:
        u, v, _ = flight.at(time)
        return min(u - rig.gap, rig.stiffness * (u - rig.gap) + rig.damping * v)

    left = until - flight.begin
    if left <= SHORTEST:
        return None
    fastest = max(rig.omega, cart.omega if cart.drive else 0.0)
    count = int(np.clip(left * fastest / (2 * np.pi) * PER_PERIOD, 8, 100_000)) + 1
    times = np.linspace(flight.begin, until, count)
    above, speeds = flight.derivative(0, times) - rig.gap, flight.derivative(1, times)
    values = np.minimum(above, rig.stiffness * above + rig.damping * speeds)
    below = int(np.argmax(values < 0))
    if not values[below] < 0:
        return None  # it does not separate
    turns = np.flatnonzero((speeds[below:-1] > 0) & (speeds[below + 1:] <= 0)) + below
    rises = np.flatnonzero((values[below:-1] < 0) & (values[below + 1:] >= 0)) + below
    for place in np.union1d(turns, rises):
        end = times[place + 1]
        if values[place + 1] < 0:  # it may have crossed and returned
            end = _root(lambda time: flight.at(time)[1], times[place], end)
            if not over(end) > 0:
                continue
        return _root(over, times[place], end)
    return None


def _root(function: Callable[[float], float], begin: float, end: float) -> float:
    if function(begin) * function(end) > 0:
        return begin
    return float(brentq(function, begin, end, xtol=1e-15))
