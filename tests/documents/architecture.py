"""The folders of src and their include relations, from the include lines.

    tests/documents/architecture.py      redraws them in src/README.md
"""

import re
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2] / "src"
PAGE = SOURCE / "README.md"
INCLUDE = re.compile(r'^#include "(\w+)/', re.MULTILINE)
BEGIN = "<!-- tests/documents/architecture.py draws this -->\n"
END = "<!-- end of the drawing -->\n"


def order(page=PAGE):
    """The folders in the order of the page's table: each includes only folders above it."""
    table = page.read_text().split("| folder |")[1].split("\n\n")[0]
    return re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)


def includes(source=SOURCE):
    """{folder: the folders that its files include}."""
    return {folder.name: {name for file in folder.glob("*.?pp") for name in INCLUDE.findall(file.read_text())
                          if (source / name).is_dir()} - {folder.name}
            for folder in sorted(source.iterdir()) if folder.is_dir()}


def reach(graph, folder):
    """All folders that a folder includes, directly or through others."""
    found = set()
    for name in graph.get(folder, ()):
        found |= {name} | reach(graph, name)
    return found


def drawing(source=SOURCE):
    """A Mermaid flowchart. Arrows implied by others are omitted, and so is `support`, which all may include."""
    graph = {folder: names - {"support"} for folder, names in includes(source).items() if folder != "support"}
    lines = ["```mermaid", "flowchart BT"]
    for folder, names in graph.items():
        implied = set().union(*(reach(graph, name) for name in names))
        lines += [f"    {folder} --> {name}" for name in sorted(names - implied)] or [f"    {folder}"]
    return "\n".join([*lines, "```", ""])


def with_drawing(text, picture):
    before, rest = text.split(BEGIN)
    return before + BEGIN + picture + END + rest.split(END)[1]


if __name__ == "__main__":
    PAGE.write_text(with_drawing(PAGE.read_text(), drawing()))
