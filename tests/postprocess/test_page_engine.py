"""The building of the page's engine is told source by source, and what stops it is told once."""

import pytest
from peterka.cli import explore
from peterka.page import engine
from peterka.page.engine import NoEngine


@pytest.fixture
def script(tmp_path, monkeypatch):
    """Replaces the building script by one with this text; returns the cache."""
    def write(text):
        source = tmp_path / "src"
        (source / "page").mkdir(parents=True)
        (source / "engine_sources.txt").write_text("")
        (source / "page" / "packages.sh").write_text("#!/bin/sh\necho clang\n")
        (source / "page" / "build_wasm.sh").write_text(f"#!/bin/sh\n{text}\n")
        for path in (source / "page").iterdir():
            path.chmod(0o755)
        monkeypatch.setattr(engine, "SOURCE", source)
        monkeypatch.setattr(engine, "SCRIPT", source / "page" / "build_wasm.sh")
        monkeypatch.setenv("PETERKA_PAGE_CACHE", str(tmp_path / "cache"))
        return tmp_path / "cache"
    return write


def test_each_source_that_is_compiled_is_told(script):
    script('echo 3; echo a; echo b; echo c; echo module > "$1"')
    told = []
    assert engine.path(progress=lambda done, total: told.append((done, total))).read_text() == "module\n"
    assert told == [(1, 3), (2, 3), (3, 3)]


def test_the_program_tells_how_far_it_is(script, capsys):
    script('echo 40; for n in $(seq 40); do echo $n; done; echo module > "$1"')
    explore.build_engine()
    lines = capsys.readouterr().err.splitlines()
    assert "building the page's engine" in lines[0]
    assert [line.partition(": ")[2] for line in lines[1:]] == ["10 of 40 sources compiled", "20 of 40 sources compiled",
                                                               "30 of 40 sources compiled", "40 of 40 sources compiled, linking"]


@pytest.mark.parametrize("rig, given, numbers", [
    ({"natural_frequency_hz": 4.5, "cart_amplitude_m": 1e-3}, {"gap_m": 2e-3, "frequency_hz": 9.0},
     {"gap_ratio": 2.0, "frequency_ratio": 2.0}),
    ({"natural_frequency_hz": 4.5}, {"gap_m": 2e-3, "frequency_ratio": 2.0}, {"gap_ratio": None, "gap_m": 2e-3, "frequency_ratio": 2.0})])
def test_a_place_in_si_is_a_ratio_unless_that_varies_from_cell_to_cell(rig, given, numbers):
    """As that of a gap over the cart's amplitude does where this is an axis."""
    class File:
        positive = staticmethod(rig.get)

    assert engine._place(File, {"operating_point": given}) == numbers | {"displacement_ratio": None, "velocity_ratio": None}


@pytest.mark.parametrize("text", ["echo lld is missing >&2; exit 1", "echo 2; echo a; echo lld is missing >&2; exit 1"])
def test_what_stops_it_is_told(script, text):
    script(text)
    with pytest.raises(NoEngine, match="cannot be built: lld is missing; on Debian: apt-get install clang"):
        engine.path()
