"""Every public function, method and class of postprocess documents its arguments, its result and its purpose; mypy checks
that type annotations are correct (tests/style.sh)."""

import ast
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "postprocess"
FILES = [*sorted(FOLDER.glob("*.py")), *sorted(FOLDER.glob("peterka/**/*.py"))]


def arguments_of(function):
    every = function.args
    named = [*every.posonlyargs, *every.args, *every.kwonlyargs, *filter(None, (every.vararg, every.kwarg))]
    return [argument for argument in named if argument.arg not in ("self", "cls")]


def is_public(name):
    return not name.startswith("_") or name in ("__init__", "__call__", "__enter__", "__exit__")


def faults(node, within=""):
    """What the public functions and classes of a module or class lack, in words."""
    is_protocol = isinstance(node, ast.ClassDef) and any(isinstance(base, ast.Name) and base.id == "Protocol" for base in node.bases)
    found = []
    for child in node.body:
        if not isinstance(child, (ast.FunctionDef, ast.ClassDef)) or not is_public(child.name):
            continue
        name = f"{within}{child.name}"
        if not child.name.startswith("_") and not is_protocol and not ast.get_docstring(child):
            found.append(f"{name} has no docstring")
        if isinstance(child, ast.ClassDef):
            found += faults(child, f"{name}.")
            continue
        found += [f"{name} has no hint of {one.arg}" for one in arguments_of(child) if one.annotation is None]
        found += [f"{name} has no hint of what it returns"] * (child.returns is None)
    return found


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(FOLDER)))
def test_all_that_is_public_is_told_of(path):
    assert faults(ast.parse(path.read_text(encoding="utf-8"))) == []


def test_what_is_lacking_would_be_seen():
    text = '''
class Told:
    """Of something."""
    def __init__(self, size) -> None: ...
    def named(self): ...
def told(size: int) -> int:
    """The size."""
def untold(size, *others: int): ...
def _own(size): ...
'''
    assert faults(ast.parse(text)) == [
        "Told.__init__ has no hint of size", "Told.named has no docstring", "Told.named has no hint of what it returns",
        "untold has no docstring", "untold has no hint of size", "untold has no hint of what it returns"]
