"""Version, changes and citation say the same, and the promises name what the code has."""

import os
import re
import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BINARY = os.environ.get("PETERKA_BINARY", ROOT / "build" / "peterka")
CHANGES = (ROOT / "src" / "CHANGELOG.md").read_text()
VERSION = re.search(r"^project\(peterka VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE).group(1)


def number(file, pattern):
    return int(re.search(pattern, (ROOT / file).read_text()).group(1))


def cited(name, pattern):
    """All that matches in a file of citations."""
    return re.findall(pattern, (ROOT / ".github" / name).read_text(), re.MULTILINE)


def test_the_program_tells_this_version():
    told = subprocess.run([BINARY, "--version"], capture_output=True, text=True, check=True).stdout
    assert told.startswith(f"peterka {VERSION} (commit ")


def test_the_python_package_has_this_version():
    assert tomllib.loads((ROOT / "postprocess" / "pyproject.toml").read_text())["project"]["version"] == VERSION


def test_the_newest_change_is_this_version_and_has_a_date():
    version, date = re.search(r"^### (\S+), (\d{4}-\d\d-\d\d)$", CHANGES, re.MULTILINE).groups()
    assert version == VERSION
    assert cited("CITATION.cff", r"^date-released: (.*)$") == [date]
    assert cited("CITATION.bib", r"^  year    = \{(\d+)\}")[0] == date[:4]


def test_citations_name_this_version_and_one_title():
    assert cited("CITATION.cff", r"^version: (.*)$") == cited("CITATION.bib", r"^  version = \{(.*)\},$") == [VERSION]
    titles = cited("CITATION.bib", r"^  title   = \{(.*)\},$")
    assert titles == [*cited("CITATION.cff", r'^title: "(.*)"$'), *cited("CITATION.cff", r"^    title: (.*)$")]


def test_the_citation_file_has_what_its_format_requires():
    yaml = pytest.importorskip("yaml")
    citation = yaml.safe_load((ROOT / ".github" / "CITATION.cff").read_text())
    assert {"cff-version", "message", "title", "authors"} <= citation.keys()
    assert citation["authors"] == [{"name": "The peterka developers"}]


def test_promises_name_schema_and_layouts_of_the_code():
    newest, oldest = number("src/cell/quantities.hpp", r"newest_layout = (\d+)"), number("src/map_file/layout.hpp", r"oldest_readable = (\d+)")
    assert f"`schema = {number('src/job/schema.hpp', r'schema_version = (.)')}`" in CHANGES
    rows = re.findall(r"^\| layout (\d+).*? \| (yes|no)\b.*? \| (yes|no)\b", CHANGES, re.MULTILINE)
    assert [(int(layout), shown, resumed) for layout, shown, resumed in rows] == [
        (layout, "yes" if layout >= oldest else "no", "yes" if layout == newest else "no") for layout in range(newest, 0, -1)]


def test_promises_name_what_the_package_offers():
    used = re.search(r"_USED = (\{.*?\})", (ROOT / "postprocess" / "peterka" / "__init__.py").read_text(), re.DOTALL).group(1)
    functions = CHANGES.split("the Python functions**")[1].split("stay;")[0]
    assert set(re.findall(r"`(\w+)`", functions)) == set(re.findall(r'"(\w+)": ', used))
