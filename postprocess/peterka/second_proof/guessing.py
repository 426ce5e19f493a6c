"""The orbit of a cell in floating-point numbers: its contacts, one after the other, by scipy's integrator. Nothing of it is trusted."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from ..arrays import Reals
from .balls import Undecided
from .motion import Rig
from .shooting import BOUNCE, RELEASE, RENEWED, TOUCH, Guess

MOST_EVENTS = 400
TAU = 2 * np.pi


class Simulation:
    """From a state (u, du/dT) at a time [turns] on; `events` of (time, kind) so far."""

    def __init__(self, rig: Rig, state: Reals, time: float = 0.0) -> None:
        self._turn, self._zeta, self._kappa = TAU / float(rig.frequency), float(rig.damping_ratio), float(rig.stiffness)
        self._chi, self._gap, self._gamma, self._absolute = float(rig.damping), float(rig.gap), float(rig.cubic), rig.absolute
        self._restitution = None if rig.restitution is None else float(rig.restitution)
        self.state, self.time = np.asarray(state, dtype=float), time
        self.events: list[tuple[float, str]] = []
        self._pressed = self._restitution is None and self._about_to_press(time, self.state) > 0

    def _pressure(self, _: float, state: Reals) -> float:
        value: float = self._kappa * (state[0] - self._gap) + self._chi * state[1] / self._turn
        return value

    def _about_to_press(self, time: float, state: Reals) -> float:
        if self._restitution is not None:
            return float(state[0] - self._gap)
        return min(self._kappa * float(state[0] - self._gap), self._pressure(time, state)) + 0.0

    def _change(self, time: float, state: Reals) -> list[float]:
        u, w = state
        y = np.sin(TAU * time)
        cubic = (u + y) ** 3 - y**3 if self._absolute else u**3
        force = self._pressure(time, state) if self._pressed else 0.0
        return [w, TAU**2 * y - self._turn**2 * (2 * self._zeta * w / self._turn + u + self._gamma * cubic + force)]

    def run(self, until: float) -> Simulation:
        """On to a time [turns]; itself."""
        while self.time < until:
            surface = self._pressure if self._pressed else self._about_to_press
            def crossing(time: float, state: Reals, surface: Callable[[float, Reals], float] = surface) -> float:
                return surface(time, state)
            crossing.terminal, crossing.direction = True, -1 if self._pressed else 1  # type: ignore[attr-defined]
            path = solve_ivp(self._change, (self.time, until), self.state, method="DOP853", rtol=1e-11, atol=1e-12, max_step=1 / 64,
                             events=crossing)
            self.time, self.state = path.t[-1], path.y[:, -1]
            if path.status != 1:
                return self
            if self._restitution is not None:
                self.events.append((self.time, BOUNCE))
                self.state = np.array([self._gap, -self._restitution * self.state[1]])
                if not self.state[1] < -1e-6 or len(self.events) > MOST_EVENTS:
                    raise Undecided("impacts that end in rest on the stop")
                continue
            deep = self._kappa * (self.state[0] - self._gap) > 1e-9 * (1 + self._chi * abs(self.state[1]) / self._turn)
            self.events.append((self.time, RELEASE if self._pressed else RENEWED if deep else TOUCH))
            self._pressed = not self._pressed
            if len(self.events) > MOST_EVENTS:
                raise Undecided("too many contacts for this program")
        return self


def guess_of(rig: Rig, displacement: float, velocity: float, period: int) -> Guess:
    """The orbit near a state at phase 0, (x - y)/A0 and (x' - y')/(A0 omega); it begins in the middle of its longest flight."""
    state = np.array([displacement, velocity * TAU / float(rig.frequency)])
    last = np.inf
    for _ in range(6):
        end = Simulation(rig, state).run(period).state
        scales = 1e-7 * (1 + np.abs(state))
        slopes = [(Simulation(rig, state + shift).run(period).state - end) / shift.sum() for shift in np.diag(scales)]
        step = np.linalg.solve(np.transpose(slopes) - np.eye(2), state - end)
        state = state + step
        if not np.abs(step).max() < max(last, 1e-3):
            raise Undecided("no orbit closes near the cell's state")
        last = np.abs(step).max()
        if last < 1e-8 * (1 + np.abs(state).max()):
            break
    events = Simulation(rig, state).run(period).events
    if not events:
        raise Undecided("the orbit meets no stop")
    times = [time for time, _ in events]
    flights = [(after - time, time) for (time, kind), after in zip(events, [*times[1:], times[0] + period], strict=True)
               if kind in (RELEASE, BOUNCE)]
    longest, release = max(flights, default=(0.0, 0.0))
    begin = round((release + longest / 2) % period * 2**20) / 2**20
    state = Simulation(rig, state).run(begin).state
    around = sorted((time + period * (time < begin), kind) for time, kind in events)
    return Guess(begin, (float(state[0]), float(state[1])), around, period)
