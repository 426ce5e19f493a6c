"""The folders of src show the data's way: a folder includes only what stands before it."""

import re
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2] / "src"
ORDER = ["support", "job", "scene", "motion", "trajectory", "integrators", "batch", "regime", "parallel", "refine", "hdf5",
         "quantities", "findings", "map_file", "study", "trace", "page", "report", "run"]
INCLUDE = re.compile(r'^#include "(\w+)/', re.MULTILINE)


def upward_includes(source):
    found = []
    for file in sorted(source.glob("*/*.?pp")):
        own = ORDER.index(file.parent.name)
        for folder in INCLUDE.findall(file.read_text()):
            if folder in ORDER and ORDER.index(folder) > own:
                found.append(f"{file.parent.name}/{file.name} includes {folder}/")
    return found


def test_every_folder_has_its_place():
    assert sorted(folder.name for folder in SOURCE.iterdir() if folder.is_dir()) == sorted(ORDER)


def test_data_flows_one_way():
    assert upward_includes(SOURCE) == []


def test_an_upward_include_would_be_seen(tmp_path):
    (tmp_path / "motion").mkdir()
    (tmp_path / "motion" / "wrong.hpp").write_text('#include "scene/scene.hpp"\n#include "map_file/map_file.hpp"\n')
    assert upward_includes(tmp_path) == ["motion/wrong.hpp includes map_file/"]
