"""The orbit of a cell in floating-point numbers: its contacts, one after the other, by scipy's integrator. Nothing of it is trusted."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

from ..arrays import Reals
from .balls import Undecided
from .motion import Rig
from .shooting import BOUNCE, RELEASE, RENEWED, TOUCH, Guess

MOST_EVENTS = 400
TAU = 2 * np.pi


def follow(rig: Rig, state: Reals, until: float, time: float = 0.0) -> tuple[Reals, list[tuple[float, str]]]:
    """From a state (u, du/dT) at a time [turns] to another time: the state there, and events (time, kind) on the way."""
    turn, zeta, kappa, chi, gap, gamma = map(float, (rig.turn(), rig.damping_ratio, rig.stiffness, rig.damping, rig.gap, rig.cubic))
    rebound = None if rig.restitution is None else -float(rig.restitution)

    def force(_: float, state: Reals) -> float:
        return float(kappa * (state[0] - gap) + chi * state[1] / turn)

    def rising(time: float, state: Reals) -> float:
        return float(state[0] - gap) if rebound is not None else min(kappa * float(state[0] - gap), force(time, state))

    def change(time: float, state: Reals) -> list[float]:
        (u, w), y = state, np.sin(TAU * time)
        cubic = (u + y) ** 3 - y**3 if rig.absolute else u**3
        return [w, TAU**2 * y - turn**2 * (2 * zeta * w / turn + u + gamma * cubic + (force(time, state) if pressed else 0.0))]

    force.terminal = rising.terminal = True  # type: ignore[attr-defined]
    force.direction, rising.direction = -1, 1  # type: ignore[attr-defined]
    pressed, events = rebound is None and rising(time, state) > 0, list[tuple[float, str]]()
    while time < until:
        path = solve_ivp(change, (time, until), state, method="DOP853", rtol=1e-11, atol=1e-12, max_step=1 / 64,
                         events=force if pressed else rising)
        time, state = path.t[-1], path.y[:, -1]
        if path.status != 1:
            break
        if rebound is not None:
            events.append((time, BOUNCE))
            state = np.array([gap, rebound * state[1]])
        else:
            deep = kappa * (state[0] - gap) > 1e-9 * (1 + chi * abs(state[1]) / turn)
            events.append((time, RELEASE if pressed else RENEWED if deep else TOUCH))
            pressed = not pressed
        if len(events) > MOST_EVENTS or rebound is not None and not state[1] < -1e-6:
            raise Undecided("too many contacts for this program" if rebound is None else "impacts that end in rest on the stop")
    return state, events


def guess_of(rig: Rig, displacement: float, velocity: float, period: int) -> Guess:
    """The orbit near a state at phase 0, (x - y)/A0 and (x' - y')/(A0 omega); it begins in the middle of its longest flight."""
    found = root(lambda state: follow(rig, state, period)[0] - state, [displacement, velocity * float(rig.turn())], options={"eps": 1e-14})
    if not np.abs(found.fun).max() < 1e-6 * (1 + np.abs(found.x).max()):
        raise Undecided("no orbit closes near the cell's state")
    events = follow(rig, found.x, period)[1]
    if not events:
        raise Undecided("the orbit meets no stop")
    times = [time for time, _ in events]
    longest, release = max((after - time, time) for (time, kind), after in zip(events, [*times[1:], times[0] + period], strict=True)
                           if kind in (RELEASE, BOUNCE))
    begin = round((release + longest / 2) * 2**20) / 2**20 % period
    state = follow(rig, found.x, begin)[0]
    around = sorted((time + period * (time < begin), kind) for time, kind in events)
    return Guess(begin, (float(state[0]), float(state[1])), around, period)
