"""Peak forces of a hammer over the excitation frequency, computed independently of the project, in absolute coordinates:

    m x'' = -k (x - y) - c (x' - y') - F,   y = A sin(W t),   F = max(0, ki (x - y - gap) + ci (x' - y')) beyond the gap

Between its events each piece is linear with a harmonic force, and is stepped by the matrix exponential of (x, x', sin, cos); events are
located by bisection over the same exponential. A sweep goes on from state to state, up or down.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

SETTLING, OBSERVED = 250, 12  # cycles at each frequency
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
    pieces = Piece(rig, hertz, False), Piece(rig, hertz, True)
    z = np.array([*state, 0.0, 1.0, 1.0])
    contact = bool(pieces[1].depth @ z > 0 and pieces[1].force @ z > 0)
    peaks, cycles = [], SETTLING + OBSERVED
    t, end, peak, number = 0.0, 1 / hertz, 0.0, 0
    while number < cycles:
        piece = pieces[contact]
        ending = -piece.force if contact else piece.depth
        level = 0
        while level < len(piece.jumps):  # the longest step that stays before the event and the end of the cycle, halved and halved
            after = piece.jumps[level] @ z
            if t + piece.sizes[level] > end or ending @ after > 0:
                level += 1
                continue
            z, t = after, t + piece.sizes[level]
            if contact:
                peak = max(peak, piece.force @ z)
            level += level > 0
        if end - t < 4 * piece.sizes[-1]:
            peaks.append(peak)
            number, t, peak = number + 1, 0.0, 0.0
            z[2:] = 0.0, 1.0, 1.0
            if number > 40 and peaks[-1] > 0 and all(abs(peaks[-n] / peaks[-1] - 1) < 1e-9 for n in range(2, 9)):
                break
        else:
            contact = not contact
            if contact:
                peak = max(peak, pieces[1].force @ z)
    last = np.array(peaks[-OBSERVED:])
    periodic = [q for q in (1, 2, 3, 4) if np.allclose(last[q:], last[:-q], rtol=CLOSE, atol=0)]
    return (float(last.max()) if periodic and last.max() > 0 else None), z[:2]


def sweep(rig, hertz):
    """[peak force [N] or None] of a sweep over frequencies in their order, from rest."""
    forces, state = [], (0.0, 0.0)
    for one in hertz:
        force, state = settle(rig, one, state)
        forces.append(force)
    return forces
