"""Writes what Sphinx reads: a page of the functions that stay, and one for each part of the package, in the order of its docstring.

usage: sources.py FOLDER
"""

import ast
import re
import sys
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "peterka"
FRONT = """peterka
=======

.. automodule:: peterka
   :members:
   :no-undoc-members:
   :noindex:

The parts of the package
------------------------

For those who change it; only the names above are promised to stay.

.. toctree::
   :maxdepth: 1

{parts}
"""


def words():
    """The docstring of the package."""
    return ast.get_docstring(ast.parse((PACKAGE / "__init__.py").read_text()))


def parts():
    """{part: the dotted names of its modules}, in the order in which the docstring lists the parts."""
    return {name: modules_of(name) for name in re.findall(r"^(\w+)  +\S", words(), re.MULTILINE)}


def modules_of(part):
    files = sorted((PACKAGE / part).glob("*.py")) if (PACKAGE / part).is_dir() else [PACKAGE / f"{part}.py"]
    return [f"peterka.{part}" + (f".{file.stem}" if file.parent.name == part and file.stem != "__init__" else "") for file in files]


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "index.rst").write_text(FRONT.format(parts="\n".join(f"   {part}" for part in parts())))
    for part, modules in parts().items():
        (folder / f"{part}.rst").write_text(f"{part}\n{'=' * len(part)}\n\n" + "".join(
            f"{module}\n{'-' * len(module)}\n\n.. automodule:: {module}\n   :members:\n\n" for module in modules))


if __name__ == "__main__":
    main()
