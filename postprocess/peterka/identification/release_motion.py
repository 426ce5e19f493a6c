"""The motion of a hammer over a cart at rest, piece by piece in closed form.

    m x'' + c x' + k x = -F,   F = max(0, ki (x - gap) + ci x') beyond the gap

Flight and contact are damped oscillators, so each piece is known at any time without steps. The gap is not negative: then
the springs never push the hammer into the stop, and contact that has ended begins again only at x = gap.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from ..arrays import Reals

LONGEST_SEARCH = 200
MOST_IMPACTS = 500  # of one motion; those after them are too weak to be recorded


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
class Piece:
    """From `begin` [s] on x [m] is `rest` + the real part of a sum of amplitude exp(root s), s = time since `begin`."""

    begin: float
    contact: bool
    rest: float
    roots: tuple[complex, complex]
    amplitudes: tuple[complex, complex]

    def derivative(self, order: int, time: Any) -> Any:
        """The order-th derivative of x at these times."""
        since = np.asarray(time) - self.begin
        if self.roots[0].imag:  # a conjugate pair
            total = 2 * (self.amplitudes[0] * self.roots[0]**order * np.exp(self.roots[0] * since)).real
        else:
            total = sum(a.real * r.real**order * np.exp(r.real * since) for a, r in zip(self.amplitudes, self.roots))
        return total + self.rest if order == 0 else total


@dataclass(frozen=True)
class Motion:
    """Pieces in the order of time; the first one, a flight, begins at the first touch and holds before it."""

    rig: Rig
    pieces: list[Piece]

    @property
    def touches(self) -> Reals:
        """Times at which contacts begin."""
        return np.array([piece.begin for piece in self.pieces if piece.contact])

    def contacts(self) -> list[tuple[float, float]]:
        """(begin, end) of each contact that ended."""
        return [(piece.begin, after.begin) for piece, after in zip(self.pieces, self.pieces[1:]) if piece.contact]

    def signals(self, time: Reals, names: Iterable[str]) -> dict[str, Reals]:
        """{name: values at these ascending times}, of force [N], acceleration [m/s^2], displacement [m]."""
        found = {name: np.empty(len(time)) for name in names}
        ends = np.searchsorted(time, [piece.begin for piece in self.pieces[1:]])
        for piece, first, last in zip(self.pieces, [0, *ends], [*ends, len(time)]):
            if first < last:
                for name in names:
                    found[name][first:last] = self._signal(piece, time[first:last], name)
        return found

    def _signal(self, piece, time, name):
        if name == "displacement":
            return piece.derivative(0, time)
        if name == "acceleration":
            return piece.derivative(2, time)
        if not piece.contact:
            return 0.0
        return self.rig.stiffness * (piece.derivative(0, time) - self.rig.gap) + self.rig.damping * piece.derivative(1, time)


def motion(rig: Rig, touch_time: float, touch_speed: float, until: float) -> Motion:
    """The Motion that first touches the stop then and so fast, with all impacts that begin before `until` [s]."""
    flight = _piece(rig, touch_time, rig.gap, touch_speed, contact=False)
    pieces = [flight]
    for _ in range(MOST_IMPACTS):
        pieces.append(contact := _piece(rig, touch_time, rig.gap, touch_speed, contact=True))
        end = _end_of_contact(rig, contact)
        flight = _piece(rig, end, float(contact.derivative(0, end)), float(contact.derivative(1, end)), contact=False)
        pieces.append(flight)
        touch_time = _next_touch(rig, flight)
        if touch_time is None or touch_time >= until:
            break
        touch_speed = float(flight.derivative(1, touch_time))
    return Motion(rig, pieces)


def _piece(rig, begin, x, speed, contact):
    stiffness = rig.mass * rig.omega**2 + rig.stiffness * contact
    decay = rig.damping_ratio * rig.omega + rig.damping * contact / (2 * rig.mass)
    rest = rig.stiffness * rig.gap / stiffness if contact else 0.0
    swing = np.sqrt(complex(decay**2 - stiffness / rig.mass))
    if abs(swing) < 1e-7 * decay:  # a double root: apart by less than any measurement sees
        swing = complex(1e-7 * decay)
    roots = -decay + swing, -decay - swing
    first = ((speed - roots[1] * (x - rest)) / (roots[0] - roots[1]))
    return Piece(begin, contact, rest, roots, (first, x - rest - first))


def _end_of_contact(rig, contact):
    """When the force falls to 0."""

    def force(time):
        return rig.stiffness * (contact.derivative(0, time) - rig.gap) + rig.damping * contact.derivative(1, time)

    step = 0.05 / abs(contact.roots[1])  # the faster one where it creeps
    for _ in range(LONGEST_SEARCH):
        if force(contact.begin + 1.3 * step) <= 0:
            begin = contact.begin + (step if force(contact.begin + step) > 0 else 0.0)
            return brentq(force, begin, contact.begin + 1.3 * step, xtol=1e-15)
        step *= 1.3
    raise ValueError("a contact that never ends")


def _next_touch(rig, flight):
    """When the flight, which begins on its way back, comes to the gap again; None where it never does."""
    swing = flight.roots[0].imag
    if not swing > 0:
        return None  # creeps back
    speed_angle = np.angle(flight.amplitudes[0] * flight.roots[0])  # x' goes with the cosine of this + swing s
    quarter = np.ceil((speed_angle - np.pi / 2) / np.pi)
    standstill = (np.pi / 2 + quarter * np.pi - speed_angle) / swing  # the first one after the beginning: the farthest point
    farthest, nearest = flight.begin + standstill, flight.begin + standstill + np.pi / swing
    above = [float(flight.derivative(0, time)) - rig.gap for time in (farthest, nearest)]
    if not above[0] < 0 < above[1]:
        return None
    return brentq(lambda time: float(flight.derivative(0, time)) - rig.gap, farthest, nearest, xtol=1e-15)
