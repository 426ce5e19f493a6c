"""Programs started by a Python without the packages, as pyenv's or conda's
often is, find the system's, or report in one line what is missing."""

import os
import subprocess
import sys

import pytest
from conftest import POSTPROCESS
from peterka.cli import interpreter
from picture_samples import write_map

PROGRAMS = sorted(path.name for path in POSTPROCESS.glob("*.py"))


@pytest.fixture
def bare_python(tmp_path):
    """A separate interpreter with only the standard library."""
    home = tmp_path / "bare"
    (home / "bin").mkdir(parents=True)
    (home / "pyvenv.cfg").write_text(
        f"home = {os.path.dirname(interpreter.SYSTEMS)}\ninclude-system-site-packages = false\n", encoding="utf-8")
    python = home / "bin" / "python3"
    python.symlink_to(interpreter.SYSTEMS)
    lacks = subprocess.run([python, "-c", "import matplotlib"], capture_output=True, check=False)
    assert lacks.returncode == 1
    return python


def run(folder, *command, **variables):
    return subprocess.run(command, cwd=folder, env=os.environ | variables, capture_output=True, text=True, timeout=120,
                          check=False)


def test_the_system_s_python_goes_on(tmp_path, bare_python):
    write_map(tmp_path / "rig.h5")
    done = run(tmp_path, bare_python, POSTPROCESS / "draw.py", "rig.h5", "--formats", "png")
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "pictures" / "rig_map.png").exists()


def test_a_program_on_the_path_goes_on(tmp_path, bare_python):
    """As a user starts it: by its shebang, which takes python3 from the PATH."""
    done = run(tmp_path, POSTPROCESS / "draw.py", "no.h5", PATH=f"{bare_python.parent}:{os.environ['PATH']}")
    assert done.returncode == 2 and done.stderr.startswith("draw.py: no.h5")


@pytest.mark.parametrize("program", PROGRAMS)
def test_one_line_says_what_no_python_has(tmp_path, bare_python, program):
    """Neither interpreter can import h5py: the PYTHONPATH has one that fails to load."""
    (tmp_path / "h5py.py").write_text("raise ImportError('libhdf5.so is missing')\n", encoding="utf-8")
    done = run(tmp_path, bare_python, POSTPROCESS / program, "--help", PYTHONPATH=str(tmp_path))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1 and done.stderr.startswith(f"{program}: {bare_python} lacks numpy and h5py and")
    assert "/usr/bin/python3" in done.stderr and "python3-h5py" in done.stderr


def test_nothing_is_started_anew_where_the_packages_are(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "execv", lambda *_: pytest.fail("started anew"))
    interpreter.use_one_with_packages()
    assert interpreter.what_is_lacking() == "" and interpreter.has_packages(sys.executable)
