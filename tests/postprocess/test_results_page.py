"""The results page: every section from its file, pictures beside it, clear refusals."""

import os
import subprocess
import sys

import numpy as np
import pytest
from conftest import POSTPROCESS
from picture_samples import write_audit, write_map
from study_samples import write_labels, write_stability, write_work_precision
from sealing import SealedFile
from test_picture_audit import AGREES, ERRORS, LABELS, PLACES

pytestmark = pytest.mark.thorough


def run_program(name, folder, *arguments):
    return subprocess.run([sys.executable, POSTPROCESS / name, *arguments], cwd=folder, capture_output=True, text=True,
                          timeout=120, check=False)


@pytest.fixture
def files(tmp_path):
    path = write_audit(write_map(tmp_path / "rig.h5", title="A <b>rig"), PLACES, LABELS, ERRORS, AGREES)
    with SealedFile(path, "r+") as file:
        file["summary/omitted"] = np.bytes_("cubic spring: in 16 cells, where 3 k3 u^2/k < 0.001\nnumerical integration\n")
    return [write_work_precision(tmp_path / "wp.h5"), write_labels(tmp_path / "small.h5"),
            write_stability(tmp_path / "battery.h5"), path]


def test_the_page_tells_all_and_has_its_pictures(files, tmp_path):
    assert run_program("draw.py", tmp_path, *files, "--formats", "png").returncode == 0
    done = run_program("results.py", tmp_path, *files, "--page", "page/results.md", "--pictures", "pictures")
    assert (done.returncode, done.stderr) == (0, "")
    page = (tmp_path / "page" / "results.md").read_text(encoding="utf-8")
    names = ["wp_work_precision.png", "small_labels.png", "battery_stability.png"]
    for name in names:
        assert f"]({name})" in page and (tmp_path / "page" / name).stat().st_size > 1000
    headings = [line for line in page.splitlines() if line.startswith("#")]
    assert [heading.split(":")[0] for heading in headings] == [
        "# Results", "## Error and time", "## What errors do to a map", "## Where engines break", "## What `auto` left out"]
    assert "**A &lt;b&gt;rig**" in page and "- cubic spring: in 16 cells, where 3 k3 u^2/k &lt; 0.001" in page
    assert "solved 5 cells again, half of them at random and half where claims are weakest. 4 have the same regime" in page
    assert "the peak forces of the 2 comparable ones differ by 1.0e-09 in the median" in page
    assert "to the power −0.500" in page


def test_a_map_without_an_audit_says_so(tmp_path):
    path = write_map(tmp_path / "rig.h5")
    done = run_program("results.py", tmp_path, path, "--page", "results.md", "--pictures", "pictures")
    assert done.returncode == 0
    assert "No cell of this map was audited." in (tmp_path / "results.md").read_text(encoding="utf-8")


def test_missing_pictures_and_bad_files_are_told_in_one_line(files, tmp_path):
    done = run_program("results.py", tmp_path, files[0], "--page", "results.md", "--pictures", "nowhere")
    assert done.returncode == 3 and "wp_work_precision.png" in done.stderr and done.stderr.count("\n") == 1
    done = run_program("results.py", tmp_path, tmp_path / "none.h5", "--page", "results.md", "--pictures", "nowhere")
    assert done.returncode == 2 and "does not exist" in done.stderr and done.stderr.count("\n") == 1
    assert not (tmp_path / "results.md").exists()


STAND_IN = """#!/bin/sh
# Stands in for peterka: "computes" a file that lies ready, and tells what it was asked.
[ "${{OMPI_COMM_WORLD_RANK:-${{PMI_RANK:-0}}}}" = 0 ] || exit 0
echo "$@" "on ${{OMPI_COMM_WORLD_SIZE:-$PMI_SIZE}} ranks" >>"{folder}/asked"
cp "{folder}/ready/$(basename "$4")" "$4"
"""


def test_the_script_runs_draws_and_writes_the_page(tmp_path):
    ready = tmp_path / "ready"
    ready.mkdir()
    write_work_precision(ready / "study_work_precision.h5")
    write_work_precision(ready / "study_cubic_work_precision.h5")
    write_labels(ready / "study_labels.h5")
    write_stability(ready / "study_stability.h5")
    for rig in (170, 150, 135):
        write_audit(write_map(ready / f"peterka_{rig}mm.h5", title=f"Springs {rig} mm"), PLACES, LABELS, ERRORS, AGREES)
    program = tmp_path / "peterka"
    program.write_text(STAND_IN.format(folder=tmp_path))
    program.chmod(0o755)
    done = subprocess.run(
        [POSTPROCESS.parent / "jobs" / "results.sh", "out", "page"], cwd=tmp_path, stdin=subprocess.DEVNULL,
        env=os.environ | {"PETERKA_BINARY": str(program)}, capture_output=True, text=True, timeout=300, check=False,
    )
    assert done.returncode == 0, done.stderr
    asked = (tmp_path / "asked").read_text().splitlines()
    assert [line.split()[1] for line in asked] == [
        f"jobs/{name}.toml" for name in ("study_work_precision", "study_cubic_work_precision", "study_labels",
                                         "study_stability", "peterka_170mm", "peterka_150mm", "peterka_135mm")
    ]
    assert all(line.endswith("on 2 ranks") for line in asked)
    page = (tmp_path / "page" / "results.md").read_text(encoding="utf-8")
    assert "**Springs 135 mm**" in page and "](study_stability.png)" in page
    assert sorted(path.name for path in (tmp_path / "page").iterdir()) == [
        "results.md", "study_cubic_work_precision.png", "study_labels.png", "study_stability.png",
        "study_work_precision.png",
    ]
    assert (tmp_path / "out" / "pictures" / "peterka_170mm_audit.pdf").exists()
