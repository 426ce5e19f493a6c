"""Shares and kicks against complete runs of single starts, by an integrator independent of the closed form."""

from collections import Counter

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import jobs
import many_starts

pytestmark = pytest.mark.thorough

COUNT = 12
RECTANGLE = {"displacement": (-4.0, 0.25), "velocity": (-4.0, 4.0)}
ROUNDING = 15  # sensitivity above which another engine may change a label: its errors exceed those of rounding
OVERDAMPED = 'law = "kelvin_voigt"\nstiffness_n_per_m = 4.0e4\ndamping_ns_per_m = 2.5e2\n'  # zeta_i = 1.14
UNDERDAMPED = 'law = "kelvin_voigt"\nstiffness_n_per_m = 5.5e6\ndamping_ns_per_m = 3.0e2\n'  # zeta_i = 0.12
RIGID = 'law = "restitution"\ncoefficient = 0.6\n'
RIGS = {
    "underdamped": lambda job: job.replace(jobs.KELVIN_VOIGT, UNDERDAMPED),
    "overdamped": lambda job: job.replace(jobs.KELVIN_VOIGT, OVERDAMPED),
    "rigid": lambda job: job.replace(jobs.KELVIN_VOIGT, RIGID),
    "cubic": lambda job: job.replace("damping_ns_per_m = 0.06", "damping_ns_per_m = 0.06\n"
                                     "cubic_stiffness_n_per_m3 = 238.23"),
}


def window(seed):
    """2 by 2 cells at random points where several attractors are common and no start is constrained by the stop."""
    chance = np.random.default_rng(seed)
    left, low = chance.uniform(0.8, 4.0), chance.uniform(0.3, 3.0)
    return (jobs.RIG.format(kind="map", title="cells") + jobs.axis("frequency_ratio", left, left + 0.4, 2)
            + jobs.axis("gap_ratio", low, low + 1.0, 2))


def labels_of(cells):
    return np.stack([cells[name] for name in ("regime", "impacts", "period")], axis=-1)


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("rig", RIGS)
def test_each_start_ends_where_a_run_of_its_own_does(tmp_path, rig, seed):
    job = RIGS[rig](window(seed))
    many = many_starts.compute(tmp_path, job + many_starts.table(COUNT, **RECTANGLE), name="many", ranks=2)
    expected = {place: Counter() for place in np.ndindex(2, 2)}
    open_ends = Counter()
    for x, v in many_starts.starts(COUNT, **RECTANGLE):
        single = many_starts.compute(
            tmp_path, job + f"[start]\ndisplacement_ratio = {float(x)!r}\nvelocity_ratio = {float(v)!r}\n"
            '[solver]\nengine = "cvode"\n[output]\nfields = ["sensitivity"]\n', name="single", ranks=2)
        for place in expected:
            expected[place][tuple(int(number) for number in labels_of(single)[place])] += 1
            proved = single["regime"][place] in (0, 1, 3)
            open_ends[place] += bool(not proved or single["sensitivity"][place] > ROUNDING)
    for place, wanted in expected.items():
        found = Counter()
        for slot in range(int(many["attractors"][place])):
            label = tuple(int(many[f"attractor_{name}"][slot][place]) for name in ("regime", "impacts", "period"))
            found[label] += round(COUNT * float(many["basin_share"][slot][place]))
        assert found.total() == COUNT
        assert (wanted - found).total() <= open_ends[place], (rig, seed, place, wanted, found)
    assert sum(open_ends.values()) < COUNT  # of 4 COUNT: otherwise nothing was compared


def rates(tau, state, eta, gap):
    """u'' of the nondimensional hammer, in the notation of src/scene/oscillator.hpp."""
    stiffness = 0.298 * (2 * np.pi * 4.5) ** 2
    zeta = 0.06 / (2 * np.sqrt(0.298 * stiffness))
    u, v = state
    depth = u - gap
    force = max(0.0, 5.5e6 / stiffness * depth + 1.2e3 / np.sqrt(0.298 * stiffness) * v) if depth > 0 else 0.0
    return v, eta**2 * np.sin(eta * tau) - 2 * zeta * v - u - force


def carried(state, begin, end, eta, gap):
    """By the Dormand-Prince method, with steps so short that no contact is missed; times in forcing cycles."""
    period = 2 * np.pi / eta
    if end <= begin:
        return state
    return solve_ivp(rates, (begin * period, end * period), state, args=(eta, gap), method="DOP853", rtol=1e-10, atol=1e-12,
                     max_step=0.002).y[:, -1]


@pytest.mark.parametrize("count", [16, 0])
def test_a_critical_kick_ends_elsewhere_and_a_hair_less_does_not(tmp_path, count):
    """1/2 beside no impact, as an attractor and as the cell's own motion. The motion from the orbit's first point to the
    kick, and from there to the next phase 0, is integrated here; a separate run follows."""
    eta, gap = 2.55, 2.95
    speed = 0.89e-3 * 2 * np.pi * 4.5  # A0 omega [m/s]
    cells = (jobs.RIG.format(kind="map", title="kicked") + jobs.axis("frequency_ratio", eta, eta, 1)
             + jobs.axis("gap_ratio", gap, gap, 1))
    inside = "[start]\ndisplacement_ratio = -2.7256\nvelocity_ratio = -3.4413\n"
    kicks = many_starts.compute(tmp_path, cells + inside + '[output]\nfields = ["critical_kick", "orbit"]\n'
                                + (many_starts.table(count) if count else ""), name="kicks")
    if count:
        regimes = kicks["attractor_regime"][:, 0, 0]
        assert set(regimes) == {1, 0, -128}
        slot = int(np.argmax(regimes == 1))
        assert np.array_equal(np.isfinite(kicks["critical_kick_tried"][:, 0, 0]), regimes == 1)
        told = {name: float(kicks[name][slot, 0, 0]) for name in kicks if name.startswith(("critical", "attractor_orbit"))}
        orbit = np.array([told["attractor_orbit_displacement"], told["attractor_orbit_velocity"]])
    else:
        assert (kicks["regime"][0, 0], kicks["period"][0, 0]) == (1, 2)
        told = {name: float(kicks[name][0, 0]) for name in kicks if name.startswith("critical")}
        orbit = np.array([kicks["orbit_displacement"][0, 0], kicks["orbit_velocity"][0, 0]])
    assert 0.01 < told["critical_kick"] / speed < 4 and told["critical_kick_tried"] >= told["critical_kick"]
    assert 0 < told["critical_kick_lower"] <= told["critical_kick"] / 2
    phase = told["critical_kick_phase"]
    assert 0 <= phase <= 2 and told["critical_kick_direction"] in (-1, 1)

    def end(share):
        kicked = carried(orbit, 0, phase, eta, gap)
        kicked = kicked + [0, share * told["critical_kick_direction"] * told["critical_kick"] / speed]
        x, v = carried(kicked, phase % 1, 1, eta, gap)  # the cart is at its centre and moves with eta
        start = f"[start]\ndisplacement_ratio = {float(x)!r}\nvelocity_ratio = {float(v) + eta!r}\n"
        single = many_starts.compute(tmp_path, cells + start, name="single")
        return tuple(int(number) for number in labels_of(single)[0, 0])

    lower = told["critical_kick_lower"] / told["critical_kick"]
    assert end(lower) == end(0.5) == end(0.997) == (1, 1, 2)
    assert end(1.0) == (0, 0, 1)


def test_chaos_beside_no_impact_has_the_share_of_runs_of_their_own(tmp_path):
    """Three cells in which most starts are chaotic and may end in no impact: 64 starts, and each of them in a separate run.
    Rounding decides a few, where chaos lives for about as long as it is followed."""
    count = 64
    axes = jobs.axis("frequency_ratio", 3.89, 3.95, 3) + jobs.axis("gap_ratio", 1.1235955, 1.1235955, 1)
    cells = jobs.RIG.format(kind="map", title="chaos") + axes
    many = many_starts.compute(tmp_path, cells + many_starts.table(count), name="many")
    cycles, chaotic = np.zeros(3), np.zeros(3)
    for x, v in many_starts.starts(count, (-4.0, 1.0), (-4.0, 4.0)):
        single = many_starts.compute(
            tmp_path, cells + f"[start]\ndisplacement_ratio = {float(x)!r}\nvelocity_ratio = {float(v)!r}\n", name="single")
        cycles += single["cycles"][0]
        chaotic += single["regime"][0] == 2
    found = count * np.where(many["attractor_regime"] == 2, many["basin_share"], 0).sum(axis=0)[0]
    assert np.all(chaotic > 0.5 * count)
    assert np.all(np.abs(found - chaotic) <= 0.05 * chaotic), (found, chaotic)
    assert np.all(np.abs(many["cycles"][0] / cycles - 1) < 0.1), (many["cycles"][0], cycles)
