"""The folders of src show the data's way: a folder includes only what stands before it in the table of src/README.md."""

import re

import architecture
import pytest
from architecture import PAGE, SOURCE, drawing, order, with_drawing

ROOT = SOURCE.parent
NAMED = re.compile(r"(?<![\w/])(\w+)/([\w-]+)(\.[ch]pp)")  # in comments and includes
IN_THE_PAGE = re.compile(r"`(\w+)/([\w-]+)(\.[ch]pp)?`")


def upward_includes(source, folders):
    return [f"{folder} includes {name}" for folder, names in architecture.includes(source).items() for name in sorted(names)
            if folders.index(name) > folders.index(folder)]


def test_every_folder_has_its_place():
    assert sorted(folder.name for folder in SOURCE.iterdir() if folder.is_dir()) == sorted(order())


def test_data_flows_one_way():
    assert upward_includes(SOURCE, order()) == []


def test_an_upward_include_would_be_seen(tmp_path):
    for folder in ("motion", "scene", "map_file"):
        (tmp_path / folder).mkdir()
    (tmp_path / "motion" / "wrong.hpp").write_text('#include "scene/scene.hpp"\n#include "map_file/map_file.hpp"\n')
    assert upward_includes(tmp_path, order()) == ["motion includes map_file"]


def test_the_drawing_is_that_of_the_includes():
    assert PAGE.read_text() == with_drawing(PAGE.read_text(), drawing()), "run tests/documents/architecture.py"


def test_the_drawing_leaves_out_what_other_arrows_imply(tmp_path):
    for folder, included in (("a", ""), ("b", "a"), ("c", "ab")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "x.hpp").write_text("".join(f'#include "{name}/x.hpp"\n' for name in included))
    assert drawing(tmp_path) == "```mermaid\nflowchart BT\n    a\n    b --> a\n    c --> b\n```\n"


def missing(files, pattern, roots=(SOURCE, ROOT / "tests")):
    """What these files name that lies under none of the roots, as "file: what it names"."""
    return [f"{file.name}: {folder}/{stem}{end}" for file in files for folder, stem, end in pattern.findall(file.read_text())
            if not any(found for root in roots for found in root.glob(f"{folder}/{stem}{end or '.?pp'}"))]


@pytest.mark.parametrize("files, pattern", [
    ([*SOURCE.glob("*/*.?pp"), *(ROOT / "tests").glob("*/*.?pp"), ROOT / "CMakeLists.txt"], NAMED), ([PAGE], IN_THE_PAGE),
], ids=["comments", "page"])
def test_files_that_are_named_exist(files, pattern):
    elsewhere = {"generated/version.hpp", "CLI/CLI.hpp", "src/main.cpp"}
    assert [name for name in missing(files, pattern) if name.split(": ")[1] not in elsewhere] == []


def test_a_name_of_yesterday_would_be_seen(tmp_path):
    (tmp_path / "motion").mkdir()
    (tmp_path / "motion" / "signal.hpp").write_text("// see motion/signal.hpp and motion/old_name.hpp\n")
    assert missing([tmp_path / "motion" / "signal.hpp"], NAMED, [tmp_path]) == ["signal.hpp: motion/old_name.hpp"]
