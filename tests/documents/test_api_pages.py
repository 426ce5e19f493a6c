"""jobs/api.sh makes pages of all docstrings without a warning. Where Sphinx isn't installed only the reading of docstrings is tested."""

import importlib.util
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
API = ROOT / "postprocess" / "api"


def loaded(name):
    specification = importlib.util.spec_from_file_location(f"api_{name}", API / f"{name}.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """{name: text} of the pages."""
    pytest.importorskip("sphinx")
    folder = tmp_path_factory.mktemp("api")
    done = subprocess.run([ROOT / "jobs" / "api.sh", folder], capture_output=True, text=True, timeout=300, stdin=subprocess.DEVNULL,
                          env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"})
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    assert done.stdout == f"{folder}/index.html\n"
    return {page.stem: page.read_text() for page in folder.glob("*.html")}


def test_names_that_stay_are_on_the_first_page_with_their_arguments(pages):
    for signature in ("peterka.run", "peterka.check", "peterka.open", "peterka.draw", "peterka.picture_names", "peterka.JobError",
                      "peterka.PeterkaFileError", "peterka.PeterkaError"):
        name = signature.rpartition(".")[2]
        assert f'<span class="sig-name descname"><span class="pre">{name}</span></span>' in pages["index"]
    assert "ranks" in pages["index"] and "Raises JobError with all faults of the job" in pages["index"]


def test_every_module_has_its_heading(pages):
    modules = [name for names in loaded("sources").parts().values() for name in names]
    assert len(modules) == len(list((ROOT / "postprocess" / "peterka").rglob("*.py"))) - 1
    assert [name for name in modules if f'id="module-{name}"' not in pages[name.split(".")[1]]] == []


@pytest.mark.parametrize("docstring, shown", [
    (["A|B of *.h5, one_ and two__"], ["A\\|B of \\*.h5, one\\_ and two_\\_", ""]),
    (["`a*b` stays", "and a_b, too"], ["`a*b` stays", "and a_b, too", ""]),
    (["First.", "", "    x = 1"], ["First.", "", "::", "", "        x = 1", ""]),
    (["First.", "", "name   meaning", "b      c|d"], ["First.", "", "::", "", "    name   meaning", "    b      c|d", ""]),
    ([""], ["", ""]),
])
def test_docstrings_are_shown_as_they_stand(docstring, shown):
    assert loaded("conf").plain(docstring) == shown
