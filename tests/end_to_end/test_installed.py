"""What `cmake --install` puts below a prefix needs nothing of the checkout, wherever the prefix is moved."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import launch

pytestmark = pytest.mark.thorough

CHECKOUT = Path(__file__).resolve().parents[2]
BUILD = Path(launch.BINARY).parent
ENGINE = b"\0asm\1\0\0\0 not the engine, but its place"


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    """A prefix that was moved after the installation, whose engine is a stand-in."""
    folder = tmp_path_factory.mktemp("installed")
    sys.path.insert(0, str(CHECKOUT / "postprocess"))
    from peterka.page import engine
    cache = folder / "cache"
    cache.mkdir()
    (cache / f"engine-{engine._fingerprint()}.wasm").write_bytes(ENGINE)
    installed = subprocess.run(["cmake", "--install", BUILD, "--prefix", folder / "first"], capture_output=True, text=True, timeout=300,
                               env=os.environ | {"PETERKA_PAGE_CACHE": str(cache)})
    assert installed.returncode == 0, installed.stderr
    (folder / "first").rename(folder / "moved here")
    return folder / "moved here"


@pytest.fixture
def call(prefix, tmp_path):
    """Calls a program of the prefix in tmp_path, with nothing of this environment but a PATH."""
    def of_prefix(*command):
        path = f"{prefix / 'bin'}:/usr/bin:/bin"
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, env={
            "PATH": path, "HOME": str(tmp_path), "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_tmpdir_base": str(tmp_path), "LANG": "C.UTF-8",
            "PYTHONPATH": str(next((prefix / "lib").glob("python3*/*-packages")))})
        assert done.returncode == 0, done.stderr
        return done.stdout
    return of_prefix


def test_the_programs_find_each_other_and_the_engine(prefix, call, tmp_path):
    job = prefix / "share/peterka/jobs/smoke.toml"
    assert call("peterka", "run", job, "--output", "map.h5").endswith("Draw it    peterka-draw map.h5\n")
    assert "pictures/map_map.png" in call("peterka-draw", "map.h5", "--only", "map", "--formats", "png")
    assert call("peterka-explore", "map.h5").splitlines() == ["map.html"]  # and no word of a missing engine
    told = call("/usr/bin/python3", "-c", f"import peterka, xarray; print(peterka.check({str(job)!r})); "
                                           "print(dict(xarray.open_dataset('map.h5', engine='peterka').sizes)['gap_ratio'])")
    assert "is a sound job" in told and told.endswith("64\n")


def test_a_package_from_pip_finds_the_program_on_the_path(prefix, tmp_path):
    """As in a virtual environment that has the packages it needs; the package of the prefix itself stays unused."""
    subprocess.run(["cp", "-r", CHECKOUT / "postprocess", tmp_path / "source"], check=True)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--no-index", "--target", tmp_path / "site"]
    subprocess.run([*pip, tmp_path / "source"], check=True, capture_output=True, timeout=120)
    job = prefix / "share/peterka/jobs/smoke.toml"
    done = subprocess.run([sys.executable, "-c", f"import peterka; print(peterka.__file__, peterka.run({str(job)!r}, ranks=1).sizes['gap_ratio'])"],
                          cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False, env={
                              "PATH": f"{prefix / 'bin'}:/usr/bin:/bin", "HOME": str(tmp_path), "PYTHONPATH": str(tmp_path / "site"), "LANG": "C.UTF-8",
                              "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_tmpdir_base": str(tmp_path)})
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{tmp_path / 'site/peterka/__init__.py'} 64\n"


def test_help_names_the_installed_programs(call):
    told = call("peterka-operating-point", "--help")
    assert "peterka-operating-point MAP.h5" in told and ".py" not in told


def test_nothing_names_the_checkout(prefix):
    files = [path for path in prefix.rglob("*") if path.is_file()]
    assert len(files) > 150
    assert [path for path in files if path.name != "peterka" and str(CHECKOUT).encode() in path.read_bytes()] == []


def test_the_manual_is_the_help(prefix, call):
    page = (prefix / "share/man/man1/peterka.1").read_text().replace("\\-", "-").replace("\\e", "\\")
    for command in ([], ["run"], ["check"]):
        for line in call("peterka", *command, "--help").splitlines():
            assert line in page


@pytest.mark.parametrize("typed, offered", [
    ("peterka r", "run"), ("peterka --v", "--version"), ("peterka run --max", "--max-wall"), ("peterka check --se", "--set"),
    ("peterka run sm", "smoke.toml"), ("peterka run smoke.toml --fr", "--fresh"), ("peterka check --ou", ""),
])
def test_bash_completes(prefix, tmp_path, typed, offered):
    (tmp_path / "smoke.toml").touch()
    (tmp_path / "smooth.h5").touch()
    script = f"""source '{prefix}/share/bash-completion/completions/peterka'
        COMP_WORDS=({typed}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _peterka; echo "${{COMPREPLY[*]}}" """
    done = subprocess.run(["bash", "-c", script], cwd=tmp_path, capture_output=True, text=True, timeout=30)
    assert done.stdout.strip() == offered, done.stderr
