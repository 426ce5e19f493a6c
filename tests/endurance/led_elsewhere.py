#!/usr/bin/python3
"""Labels that rounding decides, as many digits settle them (certificate.many_digits), against bounces followed by mpmath with 560 digits:
maps of 24 x 24 cells of 20 random rigs with linear springs and a rigid stop, where chaos is long. Of each rig, up to four cells whose label
the proof changed, and as many whose label it kept.

    PETERKA_RANDOM_RIGS=60 tests/endurance.sh led_elsewhere     rigs, instead of 20
"""

import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

import parts

try:
    import mpmath
except ModuleNotFoundError:
    parts.skip("there is no mpmath (python3-mpmath)")

RIGS = int(os.environ.get("PETERKA_RANDOM_RIGS", "20"))
SEED = 2611
CELLS = 4  # of a rig, of each kind
CYCLES = 8000
NEAR = 1e-9  # to the stop, from where doubles no longer tell, in A0
RESTS = 1e-12  # the same, and a speed
ROUNDING, START = 6, 2
NO_IMPACT = (0, 1)
JOB = """schema = 1
kind = "map"
title = "chaos that ends"
[hammer]
mass_kg = 1.0
natural_frequency_hz = {hertz!r}
damping_ratio = {ratio!r}
[cart]
amplitude_m = 1e-3
[contact]
law = "restitution"
coefficient = {restitution!r}
[axes.frequency_ratio]
from = {slow!r}
to = {fast!r}
points = 24
[axes.gap_ratio]
from = 0.8
to = 2.0
points = 24
[certificate]
cells = "all"
starts = true
many_digits = {digits}
"""


def random_rig(random):
    return {"hertz": float(random.uniform(2, 50)), "ratio": float(np.exp(random.uniform(np.log(0.002), np.log(0.03)))),
            "restitution": float(random.uniform(0.3, 0.9)), "slow": float(random.uniform(1.5, 2.2)), "fast": float(random.uniform(2.3, 4.5))}


class Flight:
    """u'' + 2 zeta u' + u = eta^2 sin(eta t) from a state at a phase of the forcing, in closed form. `context`: mpmath, or math for doubles."""

    def __init__(self, context, zeta, eta, phase, state):
        denominator = (1 - eta**2)**2 + (2 * zeta * eta)**2
        self.context, self.zeta, self.eta, self.phase, self.turn = context, zeta, eta, phase, context.sqrt(1 - zeta**2)
        self.in_phase, self.after = eta**2 * (1 - eta**2) / denominator, -2 * zeta * eta**3 / denominator
        sine, cosine = context.sin(phase), context.cos(phase)
        self.cosine = state[0] - self.in_phase * sine - self.after * cosine
        self.sine = (state[1] - eta * (self.in_phase * cosine - self.after * sine) + zeta * self.cosine) / self.turn
        self.forced, self.swing = context.hypot(self.in_phase, self.after), context.hypot(self.cosine, self.sine)

    def at(self, later):
        """(u, u')."""
        context = self.context
        fade, sine, cosine = context.exp(-self.zeta * later), context.sin(self.turn * later), context.cos(self.turn * later)
        swing = fade * (self.cosine * cosine + self.sine * sine)
        rate = fade * self.turn * (self.sine * cosine - self.cosine * sine) - self.zeta * swing
        sine, cosine = context.sin(self.phase + self.eta * later), context.cos(self.phase + self.eta * later)
        return self.in_phase * sine + self.after * cosine + swing, self.eta * (self.in_phase * cosine - self.after * sine) + rate

    def farthest(self, later):
        """What |u| never exceeds after this time."""
        return self.forced + self.swing * self.context.exp(-self.zeta * later)

    def fastest(self, later):
        """What |u''| never exceeds after this time; the swing's frequency is 1, damping included."""
        return self.eta**2 * self.forced + self.swing * self.context.exp(-self.zeta * later)


def approach(flight, gap, later, height, least):
    """Goes on with steps that |u''| keeps from meeting the stop, to where it is nearer than `least`; None where it never is. `height`: below
    the stop at `later`, told beforehand because there, at an impact, it is 0."""
    _, rate = flight.at(later)
    while True:
        bend = flight.fastest(later)
        later += (flight.context.sqrt(rate * rate + 2 * bend * height) - rate) / bend
        if flight.farthest(later) < gap:
            return None
        u, rate = flight.at(later)
        height = gap - u
        if height < least:
            return later


def next_impact(zeta, eta, phase, state, gap):
    """When and how fast the flight meets the stop next; None if it never does. Raises Close where the hammer rests, or all but touches."""
    exact = Flight(mpmath, zeta, eta, phase, state)
    if -state[1] < RESTS:
        raise Close
    doubles = Flight(math, float(zeta), float(eta), float(mpmath.fmod(phase, 2 * mpmath.pi)), [float(number) for number in state])
    later, height = 0.0, float(gap - state[0])
    while True:
        later = approach(doubles, float(gap), later, max(height, 0.0), NEAR)
        if later is None:
            return None
        at = mpmath.mpf(later)
        while True:  # from here with all digits, until it meets the stop or is far from it again
            u, rate = exact.at(at)
            if rate > 0 and abs(gap - u) < mpmath.mpf(10) ** (60 - mpmath.mp.dps):
                return at, rate
            if rate > 0 and -NEAR < gap - u < 0:  # doubles went a little too far
                at -= 2 * (u - gap) / rate
                continue
            if rate <= 0 and gap - u > 4 * NEAR:
                break
            bend = exact.fastest(at)
            at += (mpmath.sqrt(rate * rate + 2 * bend * (gap - u)) - rate) / bend
            if abs(rate) < RESTS and gap - u < RESTS:
                raise Close
        later, height = float(at), float(gap - u)


class Close(Exception):
    """A flight's top lies so close to the stop that this program doesn't tell whether it touches; or the hammer rests."""


def repeated(cycles, speeds, end):
    """(p, q) where the speeds of the last q cycles before `end` are those of the q before them; None if there is no such q, or if the two
    halves of these q still draw nearer to each other, as on the way to half the period."""
    cycles, speeds = np.array(cycles), np.array(speeds)

    def apart(period, end):
        last, before = (speeds[(cycles > end - (n + 1) * period) & (cycles <= end - n * period)] for n in (0, 1))
        return np.abs(last - before).max() if 0 < len(last) == len(before) else np.inf

    for period in range(1, 65):
        if apart(period, end) < 1e-7:
            impacts = np.count_nonzero((cycles > end - period) & (cycles <= end))
            halves = [apart(period // 2, end - before) for before in (0, 24 * period)]  # infinite where they have other impacts
            approach = period % 2 == 0 and np.isfinite(halves[0]) and not abs(halves[0] / halves[1] - 1) < 1e-4
            return None if approach else (impacts, period)
    return None


def label_of(rig, frequency_ratio, gap_ratio):
    """(p, q), (0, 1) without impact, or None where it isn't periodic by the last of CYCLES."""
    zeta, eta, gap, restitution = (mpmath.mpf(number) for number in (rig["ratio"], frequency_ratio, gap_ratio, rig["restitution"]))
    cycle = 2 * mpmath.pi / eta
    time, state, cycles, speeds = mpmath.mpf(0), (mpmath.mpf(0), -eta), [], []
    for end in np.arange(200, CYCLES, 200) - 0.123:  # no impact lies there of a motion that repeats
        while time < end * cycle:
            impact = next_impact(zeta, eta, eta * time, state, gap)
            if impact is None:
                return NO_IMPACT
            time, state = time + impact[0], (gap, -restitution * impact[1])
            cycles.append(float(time / cycle))
            speeds.append(float(impact[1]))
        if label := repeated(cycles, speeds, end):
            return label
    return None


def run(folder, rig, digits):
    (folder / "job.toml").write_text(JOB.format(**rig, digits=digits))
    finished = subprocess.run([os.environ["PETERKA_BINARY"], "run", "job.toml", "--quiet", "--fresh"], cwd=folder, capture_output=True, text=True)
    if finished.returncode:
        raise SystemExit(finished.stderr)
    with h5py.File(folder / "job.h5") as file:
        return {name: file[name][()] for name in ("impacts", "period", "status", "certified", "frequency_ratio", "gap_ratio")}


def main():
    random = np.random.default_rng(SEED)
    mpmath.mp.dps = 560
    open_before = open_after = 0
    tried, wrong, close = {True: 0, False: 0}, {True: 0, False: 0}, 0
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(RIGS):
            rig = random_rig(random)
            doubles, digits = (run(Path(folder), rig, answer) for answer in ("false", "true"))
            open_before += np.count_nonzero(doubles["status"] == ROUNDING)
            open_after += np.count_nonzero(digits["status"] == ROUNDING)
            settled = (doubles["status"] == ROUNDING) & (digits["certified"] == START)
            other = (doubles["impacts"] != digits["impacts"]) | (doubles["period"] != digits["period"])
            for changed in (True, False):
                for row, column in random.permutation(np.argwhere(settled & (other == changed)))[:CELLS]:
                    try:
                        label = label_of(rig, digits["frequency_ratio"][column], digits["gap_ratio"][row])
                    except Close:
                        close += 1
                        continue
                    tried[changed] += 1
                    claimed = (int(digits["impacts"][row, column]), int(digits["period"][row, column]))
                    if label != claimed:
                        wrong[changed] += 1
                        print(f"{rig}, cell {row} {column}: mpmath {label}, the map {claimed}", flush=True)
    parts.row(f"a label that rounding decides, in many digits: {RIGS} random rigs, rigid stops", open_before,
              f"{open_before - open_after} settled; against mpmath, 560 digits: {wrong[True]} of {tried[True]} that changed are wrong, "
              f"{wrong[False]} of {tried[False]} that were kept; {close} more pass the stop too closely for it")
    return int(wrong[True] + wrong[False] > 0 or tried[True] == 0)


if __name__ == "__main__":
    sys.exit(main())
