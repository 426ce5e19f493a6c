"""Chaos that may end in motion without impact: the shares of its starts, and its mean life, against separate runs."""

import h5py
import numpy as np
import pytest

import jobs
import kept_places
import launch
import shares_of_chaos

pytestmark = pytest.mark.thorough

CHAOTIC, NO_IMPACT = 2, 0
# one start in nine leaves the chaos within the cycles for which a start is followed
DYING_RIG = """
schema = 1
kind = "{kind}"
[hammer]
mass_kg = 0.27793755879331195
natural_frequency_hz = 12.000139959799375
damping_ratio = 0.004814873311513601
[cart]
amplitude_m = 0.00014449650574982576
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 4571236.125980645
damping_ns_per_m = 2603.04264184753
"""
DYING = 4.064070129697011, 1.1763039383850207


def test_a_dying_chaos_is_not_the_only_attractor(tmp_path):
    found = shares_of_chaos.shares(tmp_path, DYING_RIG.format(kind="map"), DYING)
    assert 0.05 < found[NO_IMPACT][0] < 0.2
    for regime in (NO_IMPACT, CHAOTIC):
        assert abs(shares_of_chaos.errors_apart(*found[regime])) < 4, found


def test_shares_beside_a_motion_without_impact_are_those_of_runs_of_their_own(tmp_path):
    rig, _ = kept_places.random_rigs(5, 1)[0]
    cells = shares_of_chaos.chaotic_cells(tmp_path, rig, {"frequency_ratio": (1.5, 5.0), "gap_ratio": (1.05, 2.5)}, points=20)
    assert len(cells) > 10
    errors = []
    for place in np.random.default_rng(2).permutation(cells)[:5].tolist():
        found = shares_of_chaos.shares(tmp_path, rig, place)
        errors += [shares_of_chaos.errors_apart(*found[regime]) for regime in (NO_IMPACT, CHAOTIC)]
    assert max(map(abs, errors)) < 4, errors


def test_the_mean_life_is_that_of_runs_that_are_followed_to_their_end(tmp_path):
    eta, gap = DYING
    cell = shares_of_chaos.solve(tmp_path, DYING_RIG.format(kind="map") + jobs.axis("frequency_ratio", eta, eta, 1)
                                 + jobs.axis("gap_ratio", gap, gap, 1) + shares_of_chaos.starts_table(512), "cell")
    slot = int(np.flatnonzero(cell["attractor_regime"][:, 0, 0] == CHAOTIC)[0])
    hertz = eta * 12.000139959799375
    life, error = (cell[name][slot, 0, 0] * hertz for name in ("mean_life_s", "mean_life_error_s"))
    others = np.arange(8) != slot
    assert np.isnan(cell["mean_life_s"][others]).all() and np.isnan(cell["mean_life_error_s"][others]).all()
    assert 0.05 < error / life < 0.2

    longest = 40_000
    basin = (DYING_RIG.format(kind="basin") + f"[operating_point]\nfrequency_ratio = {float(eta)!r}\ngap_ratio = {float(gap)!r}\n"
             + jobs.axis("displacement_ratio", -3.9, 0.9, 14) + jobs.axis("velocity_ratio", -3.9, 3.9, 14)
             + f'[steady_state]\nchaos_cycles = {longest}\nmax_cycles = {longest}\n[output]\nfields = ["last_impact"]\n')
    jobs.write(tmp_path, basin, name="basin.toml")
    assert launch.run("run", "basin.toml", "--quiet", cwd=tmp_path, ranks=2).returncode == 0
    with h5py.File(tmp_path / "basin.h5") as file:
        ended, last = file["regime"][()] == NO_IMPACT, file["last_impact"][()]
    lives = np.where(ended, last, longest)[~ended | (last > 300)] - 300  # by then a start is on the chaos, or has ended
    expected = lives.sum() / np.sum(lives < longest - 300)
    assert len(lives) > 150
    assert life == pytest.approx(expected, abs=4 * np.hypot(error, expected / np.sqrt(len(lives))))
