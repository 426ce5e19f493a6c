"""explore.py: accepted and refused arguments, unfinished and large files, and a machine without the compiler."""

import json
import re
import shutil
import subprocess
import sys

import h5py
import numpy as np
import pages
import pytest
from conftest import JOBS, SIZE

sys.path.insert(0, str(pages.ROOT / "postprocess"))
from peterka.page import engine, layers  # noqa: E402
from peterka.page import page as page_module  # noqa: E402
from peterka.pictures import open_file  # noqa: E402


def test_files_of_another_kind_are_refused_with_a_word(tmp_path):
    file = pages.compute(tmp_path, JOBS / "trace_170mm_9hz.toml")
    run = pages.explore(file, "--output", tmp_path / "page.html")
    assert run.returncode == 2
    assert "map.h5 is of kind trace; explore.py shows map, basin, sweep and curves files" in run.stderr
    assert not (tmp_path / "page.html").exists()


@pytest.mark.parametrize("points, arguments, words", [
    (8, ["--every", "2"], "is a sweep, of which a page shows every point"),
    (8, ["--layers", "status"], "has no number of each point named status"),
    (8, ["--layers", "nothing"], "has no number of each point named nothing"),
    (1, [], "is a sweep of one point"),
])
def test_what_of_a_sweep_cannot_be_shown_is_refused_with_its_reason(tmp_path, points, arguments, words):
    file = pages.compute(tmp_path, JOBS / "sweep_170mm.toml", f"axes.frequency_ratio.points={points}")
    run = pages.explore(file, "--output", tmp_path / "page.html", *arguments)
    assert run.returncode == 2 and words in run.stderr and not (tmp_path / "page.html").exists()


@pytest.mark.parametrize("job", ["sweep_170mm.toml", "curves_170mm.toml"])
def test_a_damaged_file_is_refused_as_a_map_is(tmp_path, job):
    file = pages.compute(tmp_path, JOBS / job, "axes.frequency_ratio.points=24")
    with h5py.File(file, "r+") as data:
        data["peak_force_ratio"][0, 3] += 1e-9
    run = pages.explore(file, "--output", tmp_path / "page.html")
    assert run.returncode == 2 and "map.h5" in run.stderr and "checksum" in run.stderr
    assert not (tmp_path / "page.html").exists()


@pytest.mark.parametrize("arguments, words", [
    (["--layers", "nothing"], "has no number of each cell named nothing"),
    (["--layers", "run/tile"], "has no number of each cell named run/tile"),
    (["--every", "0"], "'0' is not a step"),
    (["--every", "50"], "too few rows or columns"),
])
def test_bad_arguments_are_refused(map_file, arguments, words):
    run = pages.explore(map_file, "--output", map_file.with_name("bad.html"), *arguments)
    assert run.returncode == 2 and words in run.stderr


@pytest.mark.parametrize("columns, rows, words", [(8, 1, "1 row and 8 columns"), (1, 8, "8 rows and 1 column"), (1, 1, "1 row and 1 column")])
def test_a_map_without_a_plane_is_refused_as_what_it_is(tmp_path, columns, rows, words):
    file = pages.compute(tmp_path, JOBS / "peterka_170mm.toml", f"axes.frequency_ratio.points={columns}", f"axes.gap_ratio.points={rows}", "audit.cells=0")
    run = pages.explore(file, "--output", tmp_path / "page.html")
    assert run.returncode == 2 and f"has {words}; a page shows planes" in run.stderr and "--every" not in run.stderr


def test_a_page_that_cannot_be_written(map_file, tmp_path):
    run = pages.explore(map_file, "--output", tmp_path / "nowhere" / "page.html")
    assert run.returncode == 3 and "cannot write" in run.stderr


@pytest.mark.parametrize("seconds", ["1e-9", "0.05"])  # the first: no cell computed yet
def test_an_unfinished_map_is_shown_as_far_as_it_is_computed(browser, tmp_path, seconds):
    file = tmp_path / "map.h5"
    settings = ["--set", "axes.frequency_ratio.points=1200", "--set", "axes.gap_ratio.points=800"]
    run = subprocess.run([pages.BINARY, "run", JOBS / "smoke.toml", "--output", file, "--quiet", "--max-wall", seconds, *settings],
                         cwd=tmp_path, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=pages.HANGING)
    assert run.returncode == 5, run.stderr
    with h5py.File(file) as data:
        regime = data["regime"][()]
    missing = np.argwhere(regime == -128)
    assert len(missing) == regime.size if seconds == "1e-9" else len(missing) > 0
    browser.open(pages.written(file))
    row, column = missing[len(missing) // 2].tolist()
    assert browser.ask(f"peterka.value({row}, {column})")["regime"] == -128
    assert "% computed" in browser.text("facts")
    assert "not computed yet" in browser.text("legend")
    assert browser.promise(f"peterka.solve({row}, {column})")["regime"] >= 0


def test_without_a_compiler_the_map_and_its_values_are_shown(browser, map_file, tmp_path):
    page = tmp_path / "page.html"
    run = pages.explore(map_file, "--output", page, CXX_WASM="no-such-compiler", PETERKA_PAGE_CACHE=str(tmp_path / "cache"))
    assert run.returncode == 0
    packages = subprocess.run([pages.ROOT / "src" / "page" / "packages.sh"], stdout=subprocess.PIPE, text=True, check=True).stdout
    assert "clang" in packages and "wasm32" in packages
    assert run.stderr == "explore.py: building the page's engine, about a minute, once\n"
    assert "no-such-compiler is not here" in run.stdout and f"apt-get install {packages}" in run.stdout
    browser.open(page)
    assert "no-such-compiler is not here" in browser.text("missing")
    assert browser.ask("peterka.value(3, 14)")["regime"] in range(6)
    assert "no-such-compiler" in browser.promise("peterka.solve(3, 14)")


@pytest.mark.parametrize("changed, is_other", [
    ("cell/labels.hpp", True), ("integrators/integrated_cycle_map.hpp", True), ("page/build_wasm.sh", True),
    ("engine_sources.txt", True), ("regime/search_pool.cpp", False), ("report/summary.cpp", False)])
def test_the_engine_is_built_anew_where_a_file_that_it_is_made_of_changed(tmp_path, monkeypatch, changed, is_other):
    source = tmp_path / "src"
    shutil.copytree(engine.SOURCE, source)
    monkeypatch.setattr(engine, "SOURCE", source)
    monkeypatch.setattr(engine, "SCRIPT", source / "page" / "build_wasm.sh")
    (cache := tmp_path / "cache").mkdir()
    monkeypatch.setattr(engine, "_build", lambda built, _: built.write_bytes(b"engine"))
    engine.module(cache)
    with open(source / changed, "a") as file:
        file.write("\n")
    engine.module(cache)
    assert len(list(cache.iterdir())) == 1 + is_other


def test_the_engine_is_built_once(map_file, tmp_path):
    cache = tmp_path / "cache"
    cache.mkdir()
    built = sorted((pages.ROOT / "build" / "page").glob("engine-*.wasm"))
    assert len(built) == 1  # by the pages of these tests; older ones are removed
    (cache / built[0].name).write_bytes(built[0].read_bytes())
    run = pages.explore(map_file, "--output", tmp_path / "page.html", CXX_WASM="no-such-compiler", PETERKA_PAGE_CACHE=str(cache))
    assert run.returncode == 0 and "no engine" not in run.stdout and run.stderr == ""


def test_every_nth_row_and_column(browser, map_file, tmp_path):
    page = tmp_path / "page.html"
    assert pages.explore(map_file, "--output", page, "--every", "5").returncode == 0
    browser.open(page)
    with h5py.File(map_file) as data:
        kept = data["peak_force_ratio"][::5, ::5], data["regime"][::5, ::5]
    for row, column in [(0, 0), (1, 3), (9, 9), (4, 6)]:
        shown = browser.ask(f"peterka.value({row}, {column})")
        assert shown["regime"] == kept[1][row, column]
        assert shown["peak_force_ratio"] == pytest.approx(kept[0][row, column], rel=0, nan_ok=True)


def test_shortened_numbers_of_a_large_map_are_right_to_the_digits_told(browser, map_file, tmp_path, monkeypatch):
    """A map that explore.py considers larger than what a page stores exactly."""
    monkeypatch.setattr(layers, "EXACT_CELLS", SIZE**2 - 1)
    with open_file(map_file) as file:
        text, _ = page_module.page(file)
    page = tmp_path / "page.html"
    page.write_text(text)
    content = json.loads(re.search(r'id="content">(.*?)</script>', text, re.DOTALL).group(1))
    assert [layer["name"] for layer in content["layers"]] == ["peak_force_ratio"]
    bits = content["layers"][0]["plane"]["bits"]
    assert bits == 20  # there is room
    browser.open(page)
    assert "force to 6 digits" in browser.text("facts")
    shown = browser.ask(f"Array.from({{length: {SIZE**2}}}, (_, i) => peterka.value(Math.floor(i / {SIZE}), i % {SIZE}).peak_force_ratio)")
    with h5py.File(map_file) as data:
        kept = data["peak_force_ratio"][()].ravel()
    np.testing.assert_allclose(np.array(shown, dtype=float), kept, rtol=2.0 ** -(bits + 1), atol=0)
