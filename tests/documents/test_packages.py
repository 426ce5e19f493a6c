"""The packages of postprocess/peterka follow the data flow, too: each imports only what its __init__ lists before it."""

import ast
import re
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "postprocess" / "peterka"


def order(package):
    """Packages and modules in the order of the package's docstring."""
    words = ast.get_docstring(ast.parse((package / "__init__.py").read_text()))
    return [name for name in re.findall(r"^(\w+)  +\S", words, re.MULTILINE)]


def parts(package):
    return {path.stem for path in package.glob("*.py")} | {path.parent.name for path in package.glob("*/__init__.py")}


def upward_imports(package, names):
    found = []
    for file in sorted(package.glob("*/*.py")) + sorted(package.glob("[!_]*.py")):
        own = file.parent.name if file.parent != package else file.stem
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.ImportFrom) and node.level == (2 if file.parent != package else 1):
                wanted = [node.module.split(".")[0]] if node.module else [alias.name for alias in node.names]
                found += [f"{file.relative_to(package)} imports {name}" for name in wanted
                          if names.index(name) > names.index(own)]
    return found


def test_every_package_has_its_place():
    assert sorted(order(PACKAGE)) == sorted(parts(PACKAGE) - {"__init__"})


def test_imports_go_one_way():
    assert upward_imports(PACKAGE, order(PACKAGE)) == []


def test_an_upward_import_would_be_seen(tmp_path):
    for name, text in (("files", "from ..maps import reduce\n"), ("maps", "from ..files.opened import OpenedFile\n")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "module.py").write_text(text)
    assert upward_imports(tmp_path, ["files", "maps"]) == ["files/module.py imports maps"]
