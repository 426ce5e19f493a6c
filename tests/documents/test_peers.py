"""Results of others: the jobs are sound, and the page is what jobs/peers/claims.py makes of them. The ball's job is run here."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BINARY = os.environ.get("PETERKA_BINARY", ROOT / "build" / "peterka")
PEERS = ROOT / "jobs" / "peers"
PAGE = (ROOT / "postprocess" / "examples" / "peers.md").read_text()


@pytest.fixture(scope="module")
def claims():
    specification = importlib.util.spec_from_file_location("peers_claims", PEERS / "claims.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


@pytest.mark.parametrize("job", sorted(path.name for path in PEERS.glob("*.toml")))
def test_the_job_is_sound_and_told(job):
    checked = subprocess.run([BINARY, "check", PEERS / job], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stderr
    assert job in PAGE


def test_the_ball_is_told_as_it_is_computed(claims, tmp_path):
    subprocess.run([BINARY, "run", PEERS / "bouncing_ball.toml", "--quiet", "--output", tmp_path / "ball.h5"], check=True)
    assert claims.BALL + "".join(claims.ball(sys.modules["peterka"].open(tmp_path / "ball.h5"))) in PAGE, "run jobs/peers.sh"


def test_each_claim_has_a_verdict_and_each_difference_a_reason(claims):
    assert PAGE.startswith(claims.HEAD + claims.BALL) and claims.BUDD in PAGE
    rows = [line.strip("| ").split(" | ") for line in PAGE.splitlines() if line.startswith("| ") and not line.endswith(" | |")]
    assert len(rows) == 14 and {len(row) for row in rows} == {3}
    verdicts = [row[2] for row in rows]
    assert [one for one in verdicts if not one.startswith(("agrees", "differs"))] == []
    assert [one for one in verdicts if one.startswith("differs") and len(one) < 40] == []


@pytest.mark.parametrize("printed, computed, expected", [
    ("0.0115", 0.01151, "agrees"), ("0.0115", 0.011449, "differs by -0.4 %"), ("0.0106", 0.010535, "differs by -0.6 %"), ("2", 2.4, "agrees"),
])
def test_a_printed_number_agrees_with_what_rounds_to_it(claims, printed, computed, expected):
    assert claims.verdict(printed, computed) == expected
