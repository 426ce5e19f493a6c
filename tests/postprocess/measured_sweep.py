"""Peak forces of a hammer over the excitation frequency, computed independently of the project, in absolute coordinates:

    m x'' = -k (x - y) - c (x' - y') - F,   y = A sin(W t),   F = max(0, ki (x - y - gap) + ci (x' - y')) beyond the gap

Between its events each piece is linear with a harmonic force, and is stepped by the matrix exponential of (x, x', sin, cos); events are
located by bisection over the same exponential. A sweep goes on from state to state, up or down.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

SETTLING, OBSERVED = 200, 12  # cycles at each frequency
STEPS = 48  # of a flight in each cycle
CLOSE = 1e-6  # relative difference of the forces of the cycles of a period


@dataclass(frozen=True)
class Rig:
    """mass [kg], natural frequency [Hz], damping ratio, A0 [m], ki [N/m], ci [Ns/m], gap [m]."""

    mass: float
    hertz: float
    ratio: float
    amplitude: float
    stiffness: float
    damping: float
    gap: float

    def toml(self):
        return (f"[hammer]\nmass_kg = {self.mass!r}\nnatural_frequency_hz = {self.hertz!r}\ndamping_ratio = {self.ratio!r}\n[cart]\n"
                f"amplitude_m = {self.amplitude!r}\n[contact]\nlaw = \"kelvin_voigt\"\nstiffness_n_per_m = {self.stiffness!r}\n"
                f"damping_ns_per_m = {self.damping!r}\n[operating_point]\ngap_m = {self.gap!r}\n")


class Piece:
    """Linear motion of (x, x', sin W t, cos W t, 1) in flight or contact, with its exponentials over a step and its halves."""

    def __init__(self, rig, hertz, contact):
        omega, own = 2 * np.pi * hertz, 2 * np.pi * rig.hertz
        k = rig.mass * own**2 + (rig.stiffness if contact else 0.0)
        c = 2 * rig.mass * own * rig.ratio + (rig.damping if contact else 0.0)
        a, push = rig.amplitude, rig.stiffness * rig.gap if contact else 0.0
        change = np.zeros((5, 5))
        change[0, 1] = 1.0
        change[1] = np.array([-k, -c, k * a, c * a * omega, push]) / rig.mass
        change[2, 3], change[3, 2] = omega, -omega
        self.step = 1 / hertz / STEPS
        if contact:
            self.step = min(self.step, 0.04 * np.sqrt(rig.mass / rig.stiffness))
        self.jumps = [expm(change * self.step / 2**n) for n in range(34)]
        self.sizes = [self.step / 2**n for n in range(34)]
        y = np.array([0.0, 0.0, a, 0.0, 0.0])
        v = np.array([0.0, 0.0, 0.0, a * omega, 0.0])
        x, u = np.eye(5)[0], np.eye(5)[1]
        self.depth = x - y - rig.gap * np.eye(5)[4]
        self.force = rig.stiffness * self.depth + rig.damping * (u - v)


def settle(rig, hertz, state):
    """(peak force [N] or None without a period of up to 4 cycles, state at the end) from a state (x, x') at phase 0."""
    flight, pressed = Piece(rig, hertz, False), Piece(rig, hertz, True)
    both = np.array([pressed.depth, pressed.force])
    z = np.array([*state, 0.0, 1.0, 1.0])
    contact = bool((both @ z).min() > 0)
    peaks = []
    while len(peaks) < SETTLING + OBSERVED and not _settled(peaks):
        t, end, peak = 0.0, 1 / hertz, 0.0
        while end - t > 1e-9 * end:
            piece = pressed if contact else flight
            level, changes = 0, False
            while level < len(piece.jumps):  # the longest step that stays before the event and the end of the cycle, halved and halved
                after = piece.jumps[level] @ z
                late, over = t + piece.sizes[level] > end, ((both @ after).min() > 0) != contact
                if late or over:
                    changes = over and not late
                    level += 1
                    continue
                z, t = after, t + piece.sizes[level]
                peak = max(peak, both[1] @ z) if contact else peak
                level += level > 0
            if changes:  # the event is nearer than the smallest step
                z, t, contact = piece.jumps[-1] @ z, t + piece.sizes[-1], not contact
                peak = max(peak, both[1] @ z) if contact else peak
        peaks.append(peak)
        z[2:] = 0.0, 1.0, 1.0
    period = _period(peaks, CLOSE)
    return (max(peaks[-period:]) if period and max(peaks[-period:]) > 0 else None), z[:2]


def _settled(peaks):
    return len(peaks) > 60 and (_period(peaks, 1e-9) > 0 and peaks[-1] > 0 or max(peaks[-40:]) == 0)


def _period(peaks, close):
    last = np.array(peaks[-OBSERVED:])
    return next((q for q in (1, 2, 3, 4) if np.allclose(last[q:], last[:-q], rtol=close, atol=0)), 0)


def sweep(rig, hertz):
    """[peak force [N] or None] of a sweep over frequencies in their order, from rest."""
    forces, state = [], (0.0, 0.0)
    for one in hertz:
        force, state = settle(rig, one, state)
        forces.append(force)
    return forces
