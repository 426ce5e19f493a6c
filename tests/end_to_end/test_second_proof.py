"""check_proofs.py: all orbits of a small map are confirmed, and claims that were altered are not."""

import dataclasses
import subprocess
import sys
from pathlib import Path

import pytest

import jobs
import launch

pytestmark = pytest.mark.thorough

POSTPROCESS = Path(__file__).parents[2] / "postprocess"
sys.path.insert(0, str(POSTPROCESS))
from peterka.maps.map_file import PeterkaFile  # noqa: E402
from peterka.cli.check_proofs import claims_of  # noqa: E402
from peterka.second_proof import cells  # noqa: E402


def text(points, settings="", rig=jobs.RIG):
    return (rig.format(kind="map", title="proofs") + jobs.axis("frequency_ratio", 1.4, 4.4, points)
            + jobs.axis("gap_ratio", 0.1, 2.5, points) + f'[certificate]\ncells = "all"\n[output]\nfields = [{settings}]\n')


def solved(folder, job):
    jobs.write(folder, job)
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5"


def check(path, *arguments):
    return subprocess.run([sys.executable, POSTPROCESS / "check_proofs.py", path, *arguments], capture_output=True, text=True)


@pytest.fixture(scope="module")
def small_map(tmp_path_factory):
    return solved(tmp_path_factory.mktemp("second"), text(4, '"orbit"'))


@pytest.fixture(scope="module")
def claims(small_map):
    with PeterkaFile(small_map) as file:
        return [(numbers, claim) for _, numbers, claim in claims_of(file, 100, 4)]


def test_all_orbits_of_a_small_map_are_confirmed(small_map):
    finished = check(small_map, "--max-period", "4")
    assert finished.returncode == 0, finished.stderr
    assert " 0 not decided, 0 contradicted" in finished.stdout
    assert int(finished.stdout.split(" cells")[0].split()[-1]) >= 8


def test_where_nothing_has_a_proof_that_is_told(tmp_path):
    path = solved(tmp_path, text(2, '"orbit"').replace("from = 0.1", "from = 2.4").replace("from = 1.4", "from = 4.3"))
    with PeterkaFile(path) as file:
        assert not (file.data.values("regime", slice(None)) == 1).any()
    finished = check(path)
    assert finished.returncode == 0 and "no periodic cell with q up to 8 has a proof, so none was proved again" in finished.stdout


def test_of_an_unfinished_file_it_is_told_how_much_is_there(tmp_path):
    jobs.write(tmp_path, text(2, '"orbit"'))
    assert launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path).returncode == 5
    told = check(tmp_path / "job.h5").stdout.splitlines()
    assert told[0].endswith("job.h5: incomplete: 0.0 % computed") and "none was proved again" in told[1]


def test_one_with_a_cubic_spring_is(tmp_path):
    path = solved(tmp_path, text(3, '"orbit"', jobs.RIG.replace("[cart]", "cubic_stiffness_n_per_m3 = 238.23\n[cart]")))
    assert ": 1 confirmed, 0 not decided, 0 contradicted" in check(path, "--cells", "1", "--max-period", "1").stdout


def word(numbers, claim, **changes):
    return cells.verdict_of(numbers, dataclasses.replace(claim, **changes)).word


def test_altered_claims_are_contradicted(claims):
    numbers, claim = next((numbers, claim) for numbers, claim in claims if claim.period == 1)
    force, tiny = claim.upper, 1e-9 * claim.upper
    assert word(numbers, claim) == cells.CONFIRMED
    for changes in ({"lower": force + tiny, "upper": force + 2 * tiny}, {"lower": force - 2 * tiny, "upper": force - tiny},
                    {"stability_margin": claim.stability_margin * 1.001},
                    {"impacts": claim.impacts + 1}, {"period": 2, "impacts": 2 * claim.impacts},
                    {"period": 3, "impacts": 3 * claim.impacts}):
        assert word(numbers, claim, **changes) == cells.CONTRADICTED, changes


def test_other_orbits_and_other_rigs_are_not_confirmed(claims):
    numbers, claim = claims[0]
    for changes in ({"displacement": claim.displacement + 0.01}, {"velocity": claim.velocity - 0.01}, {"displacement": -5.0}):
        assert word(numbers, claim, **changes) != cells.CONFIRMED
    for key in ("operating_point.gap_ratio", "contact.stiffness_n_per_m", "hammer.damping_ns_per_m", "cart.amplitude_m"):
        assert word({**numbers, key: numbers[key] * (1 + 1e-6)}, claim) != cells.CONFIRMED, key


def test_a_file_without_orbits_is_refused(tmp_path):
    finished = check(solved(tmp_path, text(2)))
    assert finished.returncode == 2
    assert "orbit" in finished.stderr


def test_orbits_of_a_rigid_stop_are_confirmed(tmp_path):
    finished = check(solved(tmp_path, jobs.with_rigid_stop(text(4, '"orbit", "impact_speed"'))))
    assert finished.returncode == 0, finished.stderr
    assert " 0 not decided, 0 contradicted" in finished.stdout and int(finished.stdout.split(" cells")[0].split()[-1]) >= 8


def test_another_law_is_refused_in_words(tmp_path):
    law = 'law = "hunt_crossley"\nstiffness_n_per_m_pow_n = 5.5e8\ndissipation_s_per_m = 0.3\n'
    finished = check(solved(tmp_path, text(2, '"orbit"').replace(jobs.KELVIN_VOIGT, law)))
    assert finished.returncode == 2
    assert "another stop than a spring and dashpot or a rigid one" in finished.stderr
