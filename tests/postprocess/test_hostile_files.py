"""Files that are valid HDF5 with impossible contents: one line and exit code 2 or 3, or a picture, and never a traceback.

tests/endurance/hostile_files.py tests every change of every file with every program; here are the known cases.
"""

import re
import shutil

import pytest
from hostile_files import CLAIMED, JOB, full_basin, hostile_files
from picture_samples import PLAIN, write_map

pytestmark = pytest.mark.thorough

CASES = [
    ("draw", "map", "regime: unsigned"), ("draw", "map", "peak_force_ratio: 1e308"),
    ("draw", "map", "peak_force_ratio: one of 1e308"), ("draw", "map", "frequency_ratio: 1e308"),
    ("draw", "map", "attribute natural_frequency_hz: 1e308"), ("draw", "basin", "regime: unsigned"),
    ("draw", "sweep", "peak_force_ratio: one of 1e308"), ("draw", "sweep", "regime: unsigned"),
    ("draw", "sweep", "attribute natural_frequency_hz: 1e308"), ("draw", "sweep", "attribute hammer_mass_kg: 1e308"),
    ("draw", "sweep", "attribute cart_amplitude_m: 1e-308"), ("draw", "trace", "force_ratio: one of 1e308"),
    ("draw", "trace", "spectrum/frequency: 1e308"), ("scaling", "map", "run/tile_seconds: 1e308"),
    ("scaling", "map", "run/solve_seconds: 1e308"), ("scaling", "map", "run/ranks: largest"),
    ("draw", "map with starts", "basin_share: 1e308"), ("draw", "map with starts", "attractor_regime: largest"),
    ("draw", "map with starts", "no start_attractor"), ("draw", "sweep with starts", "basin_share: longer"),
    ("draw", "sweep with starts", "peak_force_ratio: infinite"),
    ("draw", "sweep of uncertain rigs", "force_q05_ratio: infinite"), ("draw", "sweep of uncertain rigs", "outcome_regime: largest"),
    ("draw", "map of uncertain rigs", "outcome_probability: infinite"), ("draw", "map of uncertain rigs", "no outcome_period"),
    ("operating_point", "map of uncertain rigs", "force_q50_ratio: half"),
    ("operating_point", "map with starts", "attractor_peak_force_ratio: 1e308"),
    ("operating_point", "map with starts", "attractor_regime: unsigned"),
    ("compare", "map", "peak_force_ratio: 1e308"), ("compare", "map", "regime: unsigned"),
]
ARGUMENTS = {"scaling": ["--cells", "1e3", "--ranks", "10"], "compare": ["map_sound.h5"],
             ("operating_point", "map of uncertain rigs"): ["--hz", "0.5", "--mm", "0.1", "--risk", "0.5"]}


@pytest.mark.parametrize("program, kind, wanted", CASES)
def test_a_hostile_file_gets_its_line(tmp_path, run_program, program, kind, wanted):
    (_, path), = hostile_files(kind, tmp_path, lambda what: what == wanted)
    code, _, errors = run_program(program, path, *ARGUMENTS.get((program, kind), ARGUMENTS.get(program, [])), "--formats", "png")
    assert code in (0, 2), errors
    assert errors.count("\n") == (0 if code == 0 else 1) and "Traceback" not in errors


@pytest.mark.parametrize("kind", CLAIMED)
def test_claims_of_hostile_files_get_their_line(tmp_path, run_program, kind):
    tried = 0
    wanted = re.compile(r"job: |no \w|.*: (1e308|unsigned|deeper|longer|0)$")
    for what, path in hostile_files(kind, tmp_path, wanted.match):
        tried += 1
        folder = tmp_path / "claims"
        shutil.rmtree(folder, ignore_errors=True)
        for name in CLAIMED[kind]:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, folder / name)
        code, _, errors = run_program("claims", folder)
        assert code in (0, 2) and errors.count("\n") == (0 if code == 0 else 1), (what, errors)
        if kind != "sweep" and what in ("job: mass as text", "job: frequency 0", "job: no cart"):
            assert code == 2, what
    assert tried > 25


def test_files_of_different_shapes(tmp_path, run_program):
    (tmp_path / "starts").mkdir()
    write_map(tmp_path / "starts" / "start_1.h5", job=JOB)
    write_map(tmp_path / "starts" / "start_2.h5", cells=PLAIN[:3], job=JOB)
    code, _, errors = run_program("claims", tmp_path)
    assert code == 2 and "compared cell by cell" in errors and errors.count("\n") == 1


def test_a_basin_under_a_maps_name(tmp_path, run_program):
    full_basin(tmp_path / "gaps_170mm.h5")
    code, _, errors = run_program("claims", tmp_path)
    assert code == 2 and "is a basin; a map of this name is needed" in errors
