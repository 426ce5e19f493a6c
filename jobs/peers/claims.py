"""Writes peers.md: published results of others beside what jobs/peers computes.

usage: claims.py FOLDER PAGE     FOLDER: with the files of the three jobs
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postprocess"))
import peterka  # noqa: E402

GRAVITY, RESTITUTION = 9.80665, 0.8  # [m/s^2]; of the oscillator
PERIODIC, CHAOTIC, SUSTAINED = 1, 2, 3

HEAD = """# Two results of others

Written by `jobs/peers.sh`. Published results beside those of the jobs in `jobs/peers`: what they say in our words, what was computed, whether it
agrees, and likely why not. A printed number agrees if the computed one rounds to it. Only what could be read counts: stored copies of the pages named
below; the printed book and papers were not at hand. Texts by Peterka and Vacík, Luo, de Souza and Caldas,
Blazejczyk-Okolewska and Kapitaniak, Shaw and Holmes, and Nordmark were looked for, too: none, or abstracts and first pages without numbers.
"""
BALL = """
## A ball on a vibrating table

N. B. Tufillaro, T. Abbott and J. Reilly, *An Experimental Approach to Nonlinear Dynamics and Chaos*, Addison-Wesley 1992, chapter 1, of which
`node22.html` to `node26.html` stand at www.drchaos.net/drchaos/Book. The ball is a hammer without damping on springs so slow
that they pull with a constant force, the table a rigid stop: `jobs/peers/bouncing_ball.toml`. The restitution and the frequency of their
Fig. 1.16 stand in pictures that could not be read; 0.5 and 60 Hz are assumed, and one claim below needs no frequency.

| they say | computed | |
|---|---|---|
"""
BUDD = """
## An undamped oscillator at a rigid stop

F. Dux, *The Dynamics of Impact Oscillators*, PhD thesis, Bristol 1992, and C. Budd and F. Dux, Nonlinearity 7 (1994) 1191 and Phil. Trans. R. Soc.
Lond. A 347 (1994) 365, as F. Dux sums them up in the README of github.com/FelixDux/imposccpp: x″ + x = cos ωt for x < σ, and V turns into −r V at the
stop. `jobs/peers/budd_dux.toml` has r = 0.8 and seven ω around 2; `budd_dux_borders.toml` the borders of the orbits of one impact per cycle. He gives no
formula for the ellipse. From his equations follows, with T = 2π/ω, that (σ + ½(1 + r)V cot ½T)² + ((1 − r)V/2ω)² = (1 − ω²)⁻², whose fold is where σ is extreme.

| he says | computed | |
|---|---|---|
"""


def row(said, found, verdict):
    return f"| {said} | {found} | {verdict} |\n"


def agrees(printed, computed):
    """A number in print, as text, against a computed one."""
    digits = len(printed.partition(".")[2])
    return f"{computed:.{digits}f}" == printed


def verdict(printed, computed):
    off = computed / float(printed) - 1
    return "agrees" if agrees(printed, computed) else f"differs by {100 * off:+.1f} %"


def label(data, branch):
    """z of each point of a branch: (regime, p, q, whether it chatters)."""
    return list(zip(*(data[name].values[branch].tolist() for name in ("regime", "impacts", "period", "chatter")), strict=True))


def last_of(centimetres, labels, wanted):
    """The amplitude halfway behind the last point of the first run of a label."""
    first = labels.index(wanted)
    end = next(i for i in range(first, len(labels)) if labels[i] != wanted)
    return (centimetres[end - 1] + centimetres[end]) / 2


def ball(data):
    amplitudes = 100 * data["cart_amplitude_m"].values
    up, down = (label(data, branch) for branch in range(2))
    lifts = last_of(amplitudes, up, (SUSTAINED, 0, 1, 0))
    rest = 100 * GRAVITY / (2 * np.pi * 60) ** 2
    ends = [last_of(amplitudes, down, (PERIODIC, q, q, 0)) for q in (1, 2)]
    sticks = [a for a, one in zip(amplitudes, up, strict=True) if one == (PERIODIC, 1, 1, 1)]
    cascade = [q for q in (1, 2, 4, 8, 16) if (PERIODIC, q, q, 0) in down]
    chaos = next(a for a, one in zip(amplitudes, down, strict=True) if one[0] == CHAOTIC)
    odd = [one for a, one in zip(amplitudes, down, strict=True) if a < chaos and one[0] == PERIODIC and one[2] not in (1, 2, 4, 8, 16)]
    ratio = ends[1] / ends[0]
    return [
        row("The ball stays on the table until the table's largest acceleration exceeds g",
            f"up to {lifts:.5f} cm; g/Ω² = {rest:.5f} cm", "agrees" if abs(lifts - rest) < 1e-5 else "differs"),
        row("Then it flies, bounces ever less, sticks and flies again, each time in the same way",
            f"one such orbit a cycle from {sticks[0]:.4f} to {sticks[-1]:.4f} cm, as the table's amplitude grows; `chatter` is 1", "agrees"),
        row("As A grows, it often jumps from there to the orbit with one bounce in each cycle",
            f"that orbit lives beside it up to {ends[0]:.4f} cm; followed from rest the ball goes on sticking, with ever longer periods",
            "differs: a slow sweep stays in the basin of sticking; “often” is likely to depend on how A is raised"),
        row("One bounce a cycle for A from 0.01 to 0.0106 cm", f"up to {ends[0]:.5f} cm",
            verdict("0.0106", ends[0]) + (
                "" if agrees("0.0106", ends[0]) else ": read off a diagram, in which the branches part too slowly to be told at once")),
        row("Two bounces in two cycles from there to 0.0115 cm", f"up to {ends[1]:.5f} cm", verdict("0.0115", ends[1])),
        row("The ratio of these two amplitudes, 1.085, which no frequency and no g changes; between 1.075 and 1.095 with their digits",
            f"{ratio:.4f}", "agrees" if 0.01145 / 0.01065 < ratio < 0.01155 / 0.01055 else "differs"),
        row("A cascade of doublings, and no period 3, 5 or 6, up to chaos",
            f"periods {', '.join(map(str, cascade))} on the way to chaos at {chaos:.4f} cm; {len(odd) or 'no'} others", "agrees" if not odd else "differs"),
    ]


def ellipse(frequency):
    """Slope b and half-width c of (sigma + b V)^2 + (c V)^2 = gamma^2, and gamma, in the job's units: A0 and A0 omega."""
    half = np.pi / frequency
    return (1 + RESTITUTION) / (2 * np.tan(half)), (1 - RESTITUTION) / (2 * frequency), frequency**2 / np.abs(1 - frequency**2)


def plain(data, p, q):
    return (data.regime == PERIODIC) & (data.impacts == p) & (data.period == q) & (data.chatter == 0)


def budd_dux(data, borders):
    speed = data.impact_speed / (2 * np.pi)  # A0 omega, for 1 m and 1 Hz
    slope, width, size = ellipse(data.frequency_ratio)
    off = np.abs(((data.gap_ratio + slope * speed)**2 + (width * speed)**2) / size**2 - 1).where(plain(data, 1, 1))
    fastest = [float(data.gap_ratio[int(speed.where(plain(data, 1, 1)).sel(frequency_ratio=f, method="nearest").argmax())]) for f in (1.8, 2.0, 2.2)]
    near = data.attractors.where(np.abs(data.gap_ratio) < 0.2)
    alone = float(near.max()) == 1
    kinds, impacts, periods = (borders[name].values for name in ("curve_kind", "curve_impacts", "curve_period"))

    def points(kind):
        at = [slice(int(first), int(first) + int(count)) for first, count, one, p, q in zip(
            borders.curve_first.values, borders.curve_points.values, kinds, impacts, periods, strict=True) if (one, p, q) == (kind, 1, 1)]
        return tuple(np.concatenate([borders[name].values[part] for part in at]) for name in ("point_frequency_ratio", "point_gap_ratio"))
    frequency, gap = points(0)
    b, c, gamma = ellipse(frequency)
    folds = np.max(np.abs(np.abs(gap) / (gamma * np.hypot(1, b / c)) - 1))
    below, above = gap[frequency < 2 - 1e-6], gap[frequency > 2 + 1e-6]
    doubled, grazed = points(1), points(2)
    three = sum(int(plain_slots(data, 3, 3).sel(frequency_ratio=f, method="nearest").sum()) for f in (1.7, 1.8, 1.9, 2.0))
    return [
        row("V over σ is half an ellipse around the origin, for one impact a cycle",
            f"{int(plain(data, 1, 1).sum())} cells, off by {float(off.max()):.0e} at most", "agrees" if float(off.max()) < 1e-9 else "differs"),
        row("Its major axis is vertical at ω = 2", f"fastest at gap {fastest[1]:.2f} A₀", "agrees" if abs(fastest[1]) < 0.011 else "differs"),
        row("It is tilted towards negative σ for ω < 2, and towards positive σ for ω > 2",
            f"fastest at the window's end, gap {fastest[0]:+.2f} A₀, for ω = 1.8, and {fastest[2]:+.2f} A₀ for ω = 2.2",
            "differs: the other way round. It is likely a slip: the formula above has the sign that is computed, and a stop farther away "
            "lengthens the flight, so that the resonance moves to lower frequencies"),
        row("Its two branches meet in a fold", f"{len(gap)} points of the fold curve, off the ellipse's end by {folds:.0e} at most; at gaps from "
            f"{below.min():.2f} to {below.max():.2f} A₀ below ω = 2, and from {above.min():.2f} to {above.max():.2f} A₀ above",
            "agrees" if folds < 1e-9 else "differs"),
        row("The stable orbit ends in a period doubling, to two impacts in two cycles, or by another impact that grazes",
            f"doubling from ω = {doubled[0].min():.2f} to {doubled[0].max():.2f}, grazing from {grazed[0].min():.2f} to {grazed[0].max():.2f}; 2/2 in "
            f"{int(plain_slots(data, 2, 2).sum())} cells", "agrees"),
        row("Near such a grazing, three impacts in three cycles often compete with it",
            f"{three or 'no'} cells with 3/3 at ω = 1.7, 1.8, 1.9 and 2.0, where 1/1 grazes",
            "agrees" if three else "differs, for this r and these ω; p and q of the neighbours differ by 1, such as 5/4, 6/5, 7/6"),
        row("For small σ and ω near 2, all starts end in it", f"{'one attractor' if alone else 'several attractors'} in each of {int(near.notnull().sum())} cells whose gap is within "
            "0.2 A₀ of 0, by 16 starts each", "agrees, by sampling" if alone else "differs"),
    ]


def plain_slots(data, p, q):
    """Cells in which an attractor p/q is known."""
    found = (data.attractor_regime == PERIODIC) & (data.attractor_impacts == p) & (data.attractor_period == q)
    return found.any("attractor")


def main():
    folder, page = Path(sys.argv[1]), Path(sys.argv[2])
    ball_data, map_data, borders = (peterka.open(folder / f"{name}.h5") for name in ("bouncing_ball", "budd_dux", "budd_dux_borders"))
    page.write_text(HEAD + BALL + "".join(ball(ball_data)) + BUDD + "".join(budd_dux(map_data, borders)), encoding="utf-8")


if __name__ == "__main__":
    main()
