"""The README pages are accurate: links resolve, commands and their options exist, all jobs and fields are documented."""

import os
import re
import shlex
import subprocess
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *(ROOT / folder / "README.md" for folder in ("src", "jobs", "tests", "postprocess")),
         ROOT / "src" / "COSTS.md", ROOT / "src" / "CHANGELOG.md", ROOT / "postprocess" / "NEED.md",
         ROOT / "postprocess" / "examples" / "gallery.md",
         ROOT / "postprocess" / "examples" / "peers.md", ROOT / ".github" / "CONTRIBUTING.md"]
BINARY = os.environ.get("PETERKA_BINARY", ROOT / "build" / "peterka")


def anchors(page):
    headings = re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)


def commands(page):
    """The words of each command on the page that calls one of our programs, beginning with that program."""
    lines = [line for block in blocks(page, "sh") for line in block.splitlines()]
    lines += re.findall(r"`((?:\./)?(?:jobs|tests|postprocess)/(?!test_)[\w/]+\.(?:sh|py)[^`\n]*)`", page.read_text())
    for line in lines:
        words = shlex.split(line, comments=True)
        for start, word in enumerate(words):
            if re.fullmatch(r"(\./)?((jobs|tests|postprocess)/(?!test_)[\w/]+\.(sh|py)|build/peterka)", word):
                yield words[start:]
                break


def test_the_first_page_is_short():
    assert len((ROOT / "README.md").read_text().splitlines()) <= 160


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if file.is_dir():
            file = file / "README.md"
        assert file.exists(), target
        assert not anchor or anchor in anchors(file), target


@cache
def options_of(program, *sub):
    """The options that a program tells of itself."""
    told = subprocess.run([program, *sub, "--help"], capture_output=True, text=True, check=True).stdout
    return {"--help", *re.findall(r"--[\w-]+", told)}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_commands_and_their_options_exist(page):
    for words in commands(page):
        program = BINARY if words[0] == "build/peterka" else ROOT / words[0]
        assert Path(program).is_file(), words
        options = {word.partition("=")[0] for word in words[1:] if word.startswith("--")}
        if options:
            sub = [words[1]] if words[0] == "build/peterka" and not words[1].startswith("-") else []
            assert options <= options_of(program, *sub), words


def test_the_complete_job_is_sound(tmp_path):
    jobs = [text for text in blocks(ROOT / "README.md", "toml") if text.startswith("schema")]
    assert len(jobs) == 1
    (tmp_path / "job.toml").write_text(jobs[0])
    checked = subprocess.run([BINARY, "check", tmp_path / "job.toml"], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stderr


def test_all_jobs_are_told():
    table = [line.split("|")[1] for line in (ROOT / "jobs" / "README.md").read_text().splitlines() if line.startswith("| `")]
    told = set()
    for cell in table:
        names = re.findall(r"`([\w.]+)`", cell)
        if not names[0].endswith(".toml"):
            continue
        for name in names:
            if name.startswith("_"):  # `_150mm` and the like: the first one's name with another ending
                told.add(re.sub(r"_[^_]+$", name, names[0].removesuffix(".toml")) + ".toml")
            else:
                told.add(name)
    studies = set(re.findall(r"`(study_\w+\.toml)`", (ROOT / "jobs" / "README.md").read_text()))
    assert told | studies == {job.name for job in (ROOT / "jobs").glob("*.toml")}


def test_all_variables_are_told():
    source = (ROOT / "src" / "cell" / "quantities.hpp").read_text()
    names = re.findall(r'^    \{"(\w+)", member\(', source, re.MULTILINE)
    assert len(names) > 20
    page = (ROOT / "postprocess" / "README.md").read_text()
    assert [name for name in names if f"`{name}`" not in page] == []


def test_places_of_the_guide_exist():
    page = (ROOT / ".github" / "CONTRIBUTING.md").read_text()
    places = re.findall(r"`((?:src|tests|postprocess)/[\w/*.]+)`", page)
    assert len(places) > 10
    assert [place for place in places if not list(ROOT.glob(place.rstrip("/")))] == []
    suite = re.search(r"--gtest_filter='(\w+)\*'", page).group(1)
    assert any(f"TEST({suite}" in file.read_text() for file in (ROOT / "tests" / "unit").glob("*.cpp"))
