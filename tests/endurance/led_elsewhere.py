#!/usr/bin/python3
"""Labels that rounding decides, as many digits settle them (certificate.many_digits), against bounces followed by mpmath with 560 digits:
maps of 24 x 24 cells of 20 random rigs with linear springs and a rigid stop, where chaos is long. Of each rig, up to four cells whose label
the proof changed, and as many whose label it kept.

    PETERKA_RANDOM_RIGS=60 tests/endurance.sh led_elsewhere     rigs, instead of 20
"""

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
    """u'' + 2 zeta u' + u = eta^2 sin(eta t) from a state at time t, in closed form."""

    def __init__(self, zeta, eta, time, state):
        denominator = (1 - eta**2)**2 + (2 * zeta * eta)**2
        self.in_phase, self.after = eta**2 * (1 - eta**2) / denominator, -2 * zeta * eta**3 / denominator
        self.zeta, self.eta, self.time, self.turn = zeta, eta, time, mpmath.sqrt(1 - zeta**2)
        sine, cosine = mpmath.sin(eta * time), mpmath.cos(eta * time)
        self.cosine = state[0] - self.in_phase * sine - self.after * cosine
        self.sine = (state[1] - eta * (self.in_phase * cosine - self.after * sine) + zeta * self.cosine) / self.turn

    def at(self, later):
        """(u, u'), exact to the digits in use."""
        fade, sine, cosine = mpmath.exp(-self.zeta * later), mpmath.sin(self.turn * later), mpmath.cos(self.turn * later)
        swing = fade * (self.cosine * cosine + self.sine * sine)
        rate = fade * self.turn * (self.sine * cosine - self.cosine * sine) - self.zeta * swing
        sine, cosine = mpmath.sin(self.eta * (self.time + later)), mpmath.cos(self.eta * (self.time + later))
        return self.in_phase * sine + self.after * cosine + swing, self.eta * (self.in_phase * cosine - self.after * sine) + rate

    def about(self, later):
        """u at many times, in doubles."""
        phase = float(mpmath.fmod(self.eta * self.time, 2 * mpmath.pi)) + float(self.eta) * later
        swing = float(self.cosine) * np.cos(float(self.turn) * later) + float(self.sine) * np.sin(float(self.turn) * later)
        return float(self.in_phase) * np.sin(phase) + float(self.after) * np.cos(phase) + np.exp(-float(self.zeta) * later) * swing


def next_impact(flight, gap, cycle):
    """When and how fast the flight meets the stop next; None if it doesn't in 60 cycles, or only where doubles can't tell (`Close`)."""
    times = np.linspace(0, 60 * cycle, 60 * 400 + 1)
    beyond = flight.about(times) - float(gap)
    beyond[0] = -1e-300  # it has just left
    crossed = np.flatnonzero(beyond[1:] > 0)
    end = crossed[0] + 1 if len(crossed) else len(times)
    tops = np.flatnonzero((beyond[1:-1] > beyond[:-2]) & (beyond[1:-1] >= beyond[2:])) + 1
    if np.any(np.abs(beyond[tops[tops <= end]]) < 1e-9):
        raise Close
    if end == len(times):
        return None
    for _ in range(3):  # down to what doubles tell
        times = np.linspace(times[end - 1], times[end], 1001)
        beyond = flight.about(times) - float(gap)
        end = max(int(np.argmax(beyond > 0)), 1)
    later = mpmath.mpf((times[end - 1] + times[end]) / 2)
    for _ in range(8):
        u, rate = flight.at(later)
        later -= (u - gap) / rate
    if not 0 < later < times[end] + 1e-6:
        raise Close
    return later, flight.at(later)[1]


class Close(Exception):
    """A flight's top lies so close to the stop that this program doesn't tell whether it touches; or the hammer rests."""


def repeated(cycles, speeds, end):
    """(p, q) where the speeds of the last q cycles before `end` are those of the q before them; None if there is no such q."""
    cycles, speeds = np.array(cycles), np.array(speeds)
    for period in range(1, 65):
        last, before = (speeds[(cycles > end - (n + 1) * period) & (cycles <= end - n * period)] for n in (0, 1))
        if len(last) == len(before) and np.all(np.abs(last - before) < 1e-9):
            return len(last), period
    return None


def label_of(rig, frequency_ratio, gap_ratio):
    """(p, q), (0, 1) without impact, or None where it isn't periodic by the last of CYCLES."""
    zeta, eta, gap, restitution = (mpmath.mpf(number) for number in (rig["ratio"], frequency_ratio, gap_ratio, rig["restitution"]))
    cycle = 2 * mpmath.pi / eta
    time, state, cycles, speeds = mpmath.mpf(0), (mpmath.mpf(0), -eta), [], []
    for end in np.arange(200, CYCLES, 200) - 0.123:  # no impact lies there of a motion that repeats
        while time < end * cycle:
            impact = next_impact(Flight(zeta, eta, time, state), gap, float(cycle))
            if impact is None:
                return NO_IMPACT
            if impact[1] < 1e-9:
                raise Close
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
                    wrong[changed] += label != (digits["impacts"][row, column], digits["period"][row, column])
    parts.row(f"a label that rounding decides, in many digits: {RIGS} random rigs, rigid stops", open_before,
              f"{open_before - open_after} settled; against mpmath, 560 digits: {wrong[True]} of {tried[True]} that changed are wrong, "
              f"{wrong[False]} of {tried[False]} that were kept; {close} more pass the stop too closely for it")
    return int(wrong[True] + wrong[False] > 0 or tried[True] == 0)


if __name__ == "__main__":
    sys.exit(main())
