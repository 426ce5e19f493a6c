"""Makes the programs in postprocess/ importable and runs draw.py inside the test's process."""

import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

POSTPROCESS = Path(__file__).resolve().parents[2] / "postprocess"
sys.path.insert(0, str(POSTPROCESS))


def pytest_configure(config):
    # a picture whose axes collapsed is only warned of by matplotlib
    config.addinivalue_line("filterwarnings", "error:constrained_layout")


@dataclass
class Outcome:
    code: int
    stdout: str
    stderr: str
    pictures: list[str]  # names in the output folder


@pytest.fixture
def draw(tmp_path, monkeypatch, capsys):
    """Calls draw.py with these arguments and `tmp_path/out` as output folder."""
    import draw as program

    def run(*arguments):
        output = tmp_path / "out"
        monkeypatch.setattr(sys, "argv", ["draw.py", *map(str, arguments), "--output-dir", str(output)])
        try:
            code = program.main()
        except SystemExit as stop:
            code = stop.code
        printed = capsys.readouterr()
        names = sorted(path.name for path in output.iterdir()) if output.is_dir() else []
        return Outcome(code, printed.out, printed.err, names)

    return run
