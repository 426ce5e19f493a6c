"""The folders of src show the data's way: a folder includes only what stands before it in the table of src/README.md."""

import architecture
from architecture import PAGE, SOURCE, drawing, order, with_drawing


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
