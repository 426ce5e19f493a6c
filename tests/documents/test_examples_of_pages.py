"""The examples of the README pages work as printed: job fragments, lines of Python; and their tables are complete."""

import os
import re
import subprocess
import sys

import pytest
from test_pages import BINARY, PAGES, ROOT, blocks

JOBS, SOURCE = ROOT / "jobs", ROOT / "src"
PIECES = [text for text in blocks(JOBS / "README.md", "toml")]
RIG = f'rig = "{JOBS / "rigs" / "170mm.toml"}"\n'
MAP_OF_THE_PAGES = "peterka_170mm.h5"


def axis(name, ends):
    return f"[axes.{name}]\nfrom = {ends[0]}\nto = {ends[1]}\npoints = 16\n"


FREQUENCIES, GAPS = axis("frequency_ratio", (0.5, 4.5)), axis("gap_ratio", (0.0, 5.0))


def whole_job(piece):
    """The fragment, completed by what every job requires."""
    if piece.startswith("schema"):
        return piece
    if "[operating_point]" in piece:
        return f'schema = 1\nkind = "map"\n{RIG}{piece}'
    if "[sweep]" in piece:
        return f'schema = 1\nkind = "sweep"\n{RIG}{piece}'
    kind = "curves" if "[curves]" in piece else "map"
    if "[axes.frequency_hz]" in piece:
        return f'schema = 1\nkind = "{kind}"\n{RIG}{piece}'
    return f'schema = 1\nkind = "{kind}"\n{RIG}{FREQUENCIES}{GAPS}{piece}'


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """With a map that contains the cell, and a file of the numbers, that fragments name, and with the jobs, as in a clone."""
    path = tmp_path_factory.mktemp("clone")
    (path / "jobs").symlink_to(JOBS)
    (path / "stop_identified.toml").write_text('[covariance]\nof = ["contact.stiffness_n_per_m"]\nmean = [5.5e6]\nmatrix = [[1e10]]\n')
    subprocess.run([BINARY, "run", "jobs/peterka_170mm.toml", "--quiet", "--set", "axes.frequency_ratio.points=301", "--set",
                    "axes.gap_ratio.points=101", "--set", "audit.cells=0", "--set", "steady_state.max_cycles=10"], cwd=path, check=True)
    return path


def test_all_tables_of_a_job_that_a_page_tells_of_have_a_piece():
    assert set(re.findall(r"^\[(\w+)", "".join(PIECES), re.MULTILINE)) >= {"operating_point", "axes", "starts", "sweep", "curves",
                                                                           "trace", "basin", "uncertainty"}


@pytest.mark.parametrize("number", range(len(PIECES)))
def test_pieces_of_jobs_are_sound(folder, number):
    job = folder / f"piece{number}.toml"
    job.write_text(whole_job(PIECES[number]))
    checked = subprocess.run([BINARY, "check", job.name], cwd=folder, capture_output=True, text=True)
    assert checked.returncode == 0, PIECES[number] + checked.stderr


@pytest.mark.parametrize("text", blocks(ROOT / "postprocess" / "README.md", "python"), ids=lambda text: text.split()[1])
def test_lines_of_python_run(folder, text):
    environment = os.environ | {"PYTHONPATH": str(ROOT / "postprocess"), "MPLBACKEND": "agg", "HDF5_USE_FILE_LOCKING": "FALSE",
                                "PETERKA_BINARY": str(BINARY)}
    done = subprocess.run([sys.executable, "-c", text], cwd=folder, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_jobs_that_commands_name_exist(page):
    for name in re.findall(r"\bjobs/[\w/]+\.\w+", "".join(blocks(page, "sh"))):
        assert (ROOT / name).is_file(), name


def first_column(page, heading):
    table = page.read_text().split(heading)[1].split("\n\n")[0]
    return set(re.findall(r"`(\w+)`", "".join(line.split("|")[1] for line in table.splitlines()[1:])))


@pytest.mark.parametrize("heading, file, pattern", [
    ("| `engine` |", "job/names.hpp", r'EngineChoice::(?!automatic)\w+, "(\w+)"'), ("| `law` |", "job/job.hpp", r'std::string_view name = "(\w+)"'),
], ids=["engines", "laws"])
def test_engines_and_laws_are_told(heading, file, pattern):
    assert first_column(SOURCE / "README.md", heading) == set(re.findall(pattern, (SOURCE / file).read_text()))


def test_keys_of_a_trace_are_told():
    keys = re.findall(r'\{"(\w+)", "', (SOURCE / "job" / "schema_trace.hpp").read_text().split("inline constexpr")[0])
    assert len(keys) == 7
    assert first_column(JOBS / "README.md", "| key of `[trace]` |") == {*keys, "map", "row", "column"}


def test_variables_of_attractors_outcomes_sweeps_and_curves_are_told():
    rows = re.findall(r'^    \{"(\w+)", of_(?:attractor|outcome)\(', (SOURCE / "cell" / "quantities.hpp").read_text(), re.MULTILINE)
    files = ("map_file/samples.hpp", "map_file/attractor_samples.hpp", "curves/tables.cpp", "curves/branch_tables.cpp")
    names = rows + [name for file in files for name in re.findall(r'\{"(\w+)",\s*(?:hdf5::)?Number::', (SOURCE / file).read_text())]
    assert len(rows) == 26 and len(names) > 52
    page = (ROOT / "postprocess" / "README.md").read_text()
    assert [name for name in names if f"`{name}`" not in page] == []


def test_exit_codes_are_told():
    told = re.search(r"^Exit codes: (.*?)\.\n\n", (ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL).group(1)
    usage = subprocess.run([BINARY, "--help"], capture_output=True, text=True, check=True).stdout
    codes = re.findall(r"^ +(\d+)  ", usage.split("Exit codes:")[1], re.MULTILINE)
    assert re.findall(r"(?:^|; )(\d+) ", told) == codes and len(codes) == 6


def test_tests_that_are_named_exist():
    tests = ROOT / "tests"
    named = re.findall(r"`(\w+/\w+\.(?:py|cpp)|test_\w+\.py)`",
                       (tests / "README.md").read_text().split("## Where the tests are")[0])
    assert len(named) > 8
    assert [name for name in named if not list(tests.glob(name if "/" in name else f"*/{name}"))] == []
