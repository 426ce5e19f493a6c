"""Rigs with very little dissipation: with the max_cycles that the summary suggests no cell remains chaotic so far."""

import re

import edges_of_motions
import h5py
import jobs
import launch
import pytest

CHAOTIC_SO_FAR = 8  # status
RIGS = [{"zeta": 0.0024, "stop": edges_of_motions.kept_claims.spring(1.04e6, 22.3)},
        {"zeta": 0.0029, "stop": 'law = "restitution"\ncoefficient = 0.95'}]


def share_so_far(folder, *settings):
    finished = launch.run("run", "job.toml", "--fresh", *settings, cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        return float((file["status"][()] == CHAOTIC_SO_FAR).mean()), finished.stdout


@pytest.mark.parametrize("rig", RIGS, ids=["spring and dashpot", "rigid"])
def test_the_cycles_that_are_named_decide_chaos(tmp_path, rig):
    window = jobs.axis("frequency_ratio", 2.4, 3.4, 16) + jobs.axis("gap_ratio", 0.1, 1.2, 16)
    jobs.write(tmp_path, edges_of_motions.RIG.format(kind="map", **rig) + window)
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    before, text = share_so_far(tmp_path)
    told, named = (int(re.search(pattern, words)[1]) for pattern, words in (
        (r"With max_cycles = (\d+) each", checked.stdout), (r"steady_state\.max_cycles = (\d+)\n", text)))
    assert before > 0.04 and 3000 < named and named / 4 < told < named * 4
    after, text = share_so_far(tmp_path, "--set", f"steady_state.max_cycles={named}")
    assert after < 0.05 * before
    assert "and no longer followed" not in text or after > 0
    assert "chaos " not in launch.run("check", "job.toml", "--set", "steady_state.max_cycles=1000000", cwd=tmp_path).stdout
