"""Recordings of a hammer computed independently of the project: scipy's DOP853 from event to event.

    m_k (q_k'' + y'') + 2 zeta_k m_k omega_k q_k' + m_k omega_k^2 q_k = -F,   u = sum of q_k,   y'' = -A W^2 sin(W t + phase)
    F = max(0, ki (u - gap) + ci u') beyond the gap, 0 before it
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import solve_ivp

EXACT = {"method": "DOP853", "rtol": 1e-11}
UNITS = {"force": "force_n", "acceleration": "acceleration_m_s2", "displacement": "displacement_m"}


@dataclass(frozen=True)
class Hammer:
    """mass [kg], natural frequency [Hz], damping ratio, ki [N/m], ci [Ns/m], gap [m]; start [m] and [m/s] of the first mode;
    cart: amplitude [m], frequency [Hz], phase; further modes: (mass [kg], frequency [Hz], damping ratio)."""

    mass: float = 1.2
    hertz: float = 22.0
    ratio: float = 0.015
    stiffness: float = 1.7e7
    damping: float = 2400.0
    gap: float = 0.5e-3
    start: float = -5e-3
    speed: float = 0.0
    amplitude: float = 0.0
    cart_hertz: float = 1.0
    phase: float = 0.0
    modes: tuple = ()


def simulate(hammer, seconds, rate):
    """(times [s], {signal: values}) as sampled by an ideal logger."""
    masses = np.array([hammer.mass, *(mode[0] for mode in hammer.modes)])
    omegas = 2 * np.pi * np.array([hammer.hertz, *(mode[1] for mode in hammer.modes)])
    ratios = np.array([hammer.ratio, *(mode[2] for mode in hammer.modes)])
    cart_omega, count = 2 * np.pi * hammer.cart_hertz, len(masses)

    def cart(t):
        return -hammer.amplitude * cart_omega**2 * np.sin(cart_omega * t + hammer.phase)

    def forces(state):
        return hammer.stiffness * (state[:count].sum(axis=0) - hammer.gap) + hammer.damping * state[count:].sum(axis=0)

    def change(t, state, contact):
        pushed = forces(state) if contact else 0.0
        q, v = state[:count], state[count:]
        return np.concatenate([v, -pushed / masses - 2 * ratios * omegas * v - omegas**2 * q - cart(t)])

    def touch(t, state, contact):
        return state[:count].sum() - hammer.gap

    def leave(t, state, contact):
        return forces(state)

    touch.terminal = leave.terminal = True
    touch.direction, leave.direction = 1, -1
    time = np.arange(int(seconds * rate)) / rate
    columns = {name: np.empty(len(time)) for name in UNITS}
    t, contact = 0.0, False
    state = np.concatenate([[hammer.start], np.zeros(count - 1), [hammer.speed], np.zeros(count - 1)])
    longest = 0.02 / max(omegas.max() / (2 * np.pi), hammer.cart_hertz)
    shortest = 0.2 / np.sqrt(hammer.stiffness / hammer.mass)
    while t < seconds:
        done = solve_ivp(change, (t, seconds + 1 / rate), state, events=leave if contact else touch, args=(contact,),
                         max_step=shortest if contact else longest, atol=1e-14, dense_output=True, **EXACT)
        inside = (time >= t) & (time < done.t[-1]) if done.status == 1 else time >= t
        if inside.any():
            states = done.sol(time[inside])
            columns["displacement"][inside] = states[:count].sum(axis=0)
            columns["force"][inside] = force = forces(states) if contact else 0.0
            columns["acceleration"][inside] = (-force / masses[0] - 2 * ratios[0] * omegas[0] * states[count]
                                               - omegas[0]**2 * states[0])
        t, state, contact = done.t[-1], done.y[:, -1], not contact
    return time, columns


def noisy(columns, names, noise, seed, offset=0.05):
    """{signal: values} with offset and white noise, both relative to its largest value."""
    chance, found = np.random.default_rng(seed), {}
    for name in names:
        largest = np.abs(columns[name]).max()
        found[name] = columns[name] + largest * (offset + noise * chance.standard_normal(len(columns[name])))
    return found


def write(path, time, columns):
    """Writes a CSV file; returns its path."""
    lines = [",".join(["time_s", *(UNITS[name] for name in columns)])]
    lines += [",".join(f"{value:.10g}" for value in row) for row in zip(time, *columns.values())]
    path.write_text("\n".join(lines) + "\n")
    return path


def varied(chance):
    """A random Hammer: springs of 3 to 40 Hz, contacts of 0.2 to 3 % of a swing, restitution 0.3 to 0.9."""
    mass, hertz = np.exp(chance.uniform(np.log(0.1), np.log(3))), np.exp(chance.uniform(np.log(3), np.log(40)))
    share, stop_ratio = np.exp(chance.uniform(np.log(2e-3), np.log(3e-2))), chance.uniform(0.03, 0.35)
    omega = np.pi / (share / hertz)
    stiffness = mass * omega**2
    start = -np.exp(chance.uniform(np.log(1e-3), np.log(1e-2)))
    return Hammer(mass, hertz, chance.uniform(0.003, 0.02), stiffness, 2 * stop_ratio * np.sqrt(stiffness * mass),
                  chance.uniform(0, 0.4) * -start, start)


def driven(hammer, amplitude, cart_hertz, **others):
    """The same Hammer in a moving cart."""
    return replace(hammer, amplitude=amplitude, cart_hertz=cart_hertz, **others)
