"""Makes the programs in postprocess/ importable and runs them inside the test's process."""

import importlib
import os
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import pytest

POSTPROCESS = Path(__file__).resolve().parents[2] / "postprocess"
sys.path.insert(0, str(POSTPROCESS))
# Starts of the program without what takes Open MPI longest; it changes no result: see end_to_end/launch.py. Each process of
# pytest has a folder of its own for their sockets, as one start removes that folder while another makes it.
SOCKETS = tempfile.TemporaryDirectory(prefix="ompi-")
os.environ |= {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_tmpdir_base": SOCKETS.name, "OMPI_MCA_pml": "ob1"}


def pytest_configure(config):
    # matplotlib only warns of a picture whose axes collapsed
    config.addinivalue_line("filterwarnings", "error:constrained_layout")


@dataclass
class Outcome:
    code: int
    stdout: str
    stderr: str
    pictures: list[str]  # names in the output folder


@pytest.fixture
def run_program(tmp_path, monkeypatch, capsys):
    """Calls the program of this name in tmp_path: (exit code, stdout, stderr)."""

    def run(name, *arguments):
        program = importlib.import_module(name)
        monkeypatch.chdir(tmp_path)
        monkeypatch.setattr(sys, "argv", [f"{name}.py", *map(str, arguments)])
        try:
            code = program.main()
        except SystemExit as stop:
            code = stop.code
        return code, *capsys.readouterr()

    return run


@pytest.fixture
def draw(tmp_path, run_program):
    """Calls draw.py with these arguments and `tmp_path/out` as output folder."""

    def run(*arguments):
        output = tmp_path / "out"
        printed = run_program("draw", *arguments, "--output-dir", output)
        names = sorted(path.name for path in output.iterdir()) if output.is_dir() else []
        return Outcome(*printed, names)

    return run
