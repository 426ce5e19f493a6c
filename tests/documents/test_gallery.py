"""The gallery: each job is sound, and page and pictures are what jobs/gallery.sh made of the jobs that are there."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BINARY = os.environ.get("PETERKA_BINARY", ROOT / "build" / "peterka")
JOBS = {path.stem: path.read_text() for path in sorted((ROOT / "jobs" / "gallery").glob("*.toml"))}
PAGE = (ROOT / "postprocess" / "examples" / "gallery.md").read_text()
PICTURES = ROOT / "postprocess" / "examples" / "gallery"
sys.path.insert(0, str(ROOT / "postprocess"))


def comment(job):
    return [line[2:] for line in job.splitlines() if line.startswith("#")]


def section(job):
    """What the page says of a job."""
    return PAGE.split(f"\n## {comment(job)[0]}\n")[1].split("\n## ")[0]


def test_there_are_ten_questions_in_hz_and_mm():
    assert len(JOBS) == 10
    assert sorted(re.findall(r"^## (.*\?)$", PAGE, re.MULTILINE)) == sorted(comment(job)[0] for job in JOBS.values())
    assert [name for name, job in JOBS.items() if "_ratio" in job] == []


@pytest.mark.parametrize("name", JOBS)
def test_the_job_is_sound(name):
    checked = subprocess.run([BINARY, "check", ROOT / "jobs" / "gallery" / f"{name}.toml"], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stderr


@pytest.mark.parametrize("name, job", JOBS.items(), ids=JOBS)
def test_the_page_shows_the_job_as_it_is(name, job):
    text, page = "\n".join(line for line in job.splitlines() if not line.startswith("#")).strip("\n"), section(job)
    assert f"```toml\n{text}\n```" in page, "run jobs/gallery.sh"
    assert "\n".join(comment(job)[3:]).strip() in page, "run jobs/gallery.sh"
    assert re.search(rf"^`jobs/gallery/{name}.toml`, \d+\.\d s:$", page, re.MULTILINE)


@pytest.mark.parametrize("name, job", JOBS.items(), ids=JOBS)
def test_the_page_has_lines_of_the_summary(name, job):
    told = section(job).split("```text\n")[1].split("```")[0].splitlines()
    pattern = comment(job)[2].removeprefix("told: ")
    assert told and [line for line in told if not re.search(pattern, line)] == []
    assert [part for part in pattern.split("|") if not any(re.search(part, line) for line in told)] == []


@pytest.mark.parametrize("name, job", JOBS.items(), ids=JOBS)
def test_its_picture_is_there_and_small(name, job):
    from peterka.pictures import PICTURES as KNOWN
    picture, kind = comment(job)[1].removeprefix("picture: "), re.search(r'^kind = "(\w+)"', job, re.MULTILINE).group(1)
    assert any(row.name == picture and kind in row.kinds for row in KNOWN)
    assert f"](gallery/{name}.png)" in section(job)
    content = (PICTURES / f"{name}.png").read_bytes()
    assert content.startswith(b"\x89PNG") and len(content) <= 150_000


def test_no_picture_is_left_over():
    assert {path.stem for path in PICTURES.iterdir()} == set(JOBS)


def test_the_script_makes_all_of_them():
    order = re.search(r"^order=\((.*)\)$", (ROOT / "jobs" / "gallery.sh").read_text(), re.MULTILINE).group(1)
    assert sorted(order.split()) == sorted(JOBS)
