"""The folders of src follow the data flow: a folder includes only folders listed before it in the table of src/README.md."""

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
    """Names in these files that exist under none of the roots, as "file: name"."""
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


# What the preprocessor may test: the processor, sanitizers, and Highway's macros for the target instruction set.
ASKED = re.compile(r"""defined|PETERKA_\w+|HWY_(?:ONCE|TARGET_TOGGLE|TARGET|AVX2|NATIVE_FMA)|__SANITIZE_ADDRESS__
                   |__(?:x86_64|aarch64|powerpc64|riscv|wasm)(?:__)?|__has_include\("version\.hpp"\)""", re.VERBOSE)
CONDITION = re.compile(r"^[ \t]*#[ \t]*(?:el)?if(?:n?def)?\b((?:.*\\\n)*[^\n/]*)", re.MULTILINE)


def other_conditions(folder):
    """Files in which the preprocessor tests anything else, such as a library's release; a folder's versions.hpp may do so."""
    return sorted({str(file.relative_to(folder)) for file in folder.rglob("*.?pp") if file.name != "versions.hpp"
                   for condition in CONDITION.findall(file.read_text()) if re.search(r"[A-Za-z_]", ASKED.sub("", condition))})


def test_releases_of_libraries_are_told_apart_in_one_file_of_a_folder():
    assert other_conditions(SOURCE) == []


@pytest.mark.parametrize("condition", ["if H5_VERSION_GE(1, 12, 0)", "if SUNDIALS_VERSION_MAJOR < 7", "ifdef __GLIBC__",
                                       "elif defined(PETERKA_A) && \\\n   __GNUC__ > 13", "  if __has_include(<mpi-ext.h>)",
                                       "if defined(HWY_AVX3_ZEN4)"])
def test_a_condition_on_a_release_would_be_seen(tmp_path, condition):
    (tmp_path / "map_file").mkdir()
    for name in ("seal.cpp", "versions.hpp"):
        (tmp_path / "map_file" / name).write_text(f"int a;\n#{condition}\n#endif\n")
    (tmp_path / "map_file" / "own.cpp").write_text("#if defined(PETERKA_A)  // a word\n#elif __x86_64__ && \\\n HWY_ONCE\n#endif\n")
    assert other_conditions(tmp_path) == ["map_file/seal.cpp"]
