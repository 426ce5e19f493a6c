"""What is told while explore.py builds the page's engine, and where that fails."""

import io
import sys

import pytest

from peterka.cli import explore
from peterka.page import engine


@pytest.fixture
def script(tmp_path, monkeypatch):
    """Sets what stands for the build script, which gets the name of the module."""
    file = tmp_path / "src" / "page" / "build_wasm.sh"
    file.parent.mkdir(parents=True)
    packages = file.with_name("packages.sh")
    packages.write_text("#!/bin/sh\necho clang-of-this-test\n")
    packages.chmod(0o755)
    monkeypatch.setattr(engine, "SCRIPT", file)
    monkeypatch.setattr(engine, "_fingerprint", lambda: "0123456789abcdef")

    def write(lines):
        file.write_text("#!/bin/sh\n" + lines)
        file.chmod(0o755)
    return write


def test_each_file_that_is_compiled_is_told(script, tmp_path):
    script("echo 3\nfor name in a b c; do echo $name.cpp; done\necho warning >&2\nprintf engine > $1\n")
    told = []
    assert engine.module(tmp_path / "cache", lambda done, files: told.append((done, files))) == b"engine"
    assert told == [(1, 3), (2, 3), (3, 3)]


def test_a_build_that_fails_tells_its_first_complaint_and_the_packages(script, tmp_path):
    script("echo 3\necho a.cpp\necho b.cpp: no such header >&2\nexit 1\n")
    with pytest.raises(engine.NoEngine, match=r"cannot be built: b.cpp: no such header; .* clang-of-this-test"):
        engine.module(tmp_path / "cache")


@pytest.mark.parametrize("is_terminal, words", [(True, "\r  1 of 2 files compiled\r  2 of 2 files compiled\n"), (False, "")])
def test_files_are_counted_in_one_line_of_a_terminal(monkeypatch, is_terminal, words):
    stream = io.StringIO()
    stream.isatty = lambda: is_terminal
    monkeypatch.setattr(sys, "stderr", stream)
    explore.tell_compiled(1, 2)
    explore.tell_compiled(2, 2)
    assert stream.getvalue() == words
