"""Writes what pip would make of pyproject.toml: dist-info with the entry points, and a starter in bin for each script.

usage: python_metadata.py PYPROJECT FOLDER FROM_BIN     FROM_BIN: the package's folder, seen from the starters'
"""

import sys
import tomllib
from pathlib import Path

STARTER = '''#!/usr/bin/env python3
"""{name}: {module} of the package that was installed with it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "{from_bin}"))

import peterka.cli.interpreter  # noqa: E402, F401, I001: goes on with a Python that has the packages

from {module} import {function}  # noqa: E402

sys.exit({function}())
'''


def main():
    project = tomllib.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))["project"]
    folder, from_bin = Path(sys.argv[2]), sys.argv[3]
    metadata = [("Metadata-Version", "2.1"), ("Name", project["name"]), ("Version", project["version"]),
                ("Summary", project["description"]), ("Requires-Python", project["requires-python"]),
                *(("Requires-Dist", one) for one in project["dependencies"]),
                *(("Classifier", one) for one in project["classifiers"])]
    groups = {"console_scripts": project["scripts"], **project["entry-points"]}
    write(folder / "dist-info/METADATA", "".join(f"{key}: {value}\n" for key, value in metadata))
    write(folder / "dist-info/entry_points.txt", "\n".join(
        f"[{group}]\n" + "".join(f"{name} = {target}\n" for name, target in targets.items()) for group, targets in groups.items()))
    write(folder / "dist-info/INSTALLER", "cmake\n")
    for name, target in project["scripts"].items():
        module, function = target.split(":")
        write(folder / "bin" / name, STARTER.format(name=name, module=module, function=function, from_bin=from_bin)).chmod(0o755)


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


if __name__ == "__main__":
    main()
