"""Recipes for Spack and containers fit the build: same version, a package for all that CMake and Python look for, files that are there.

Neither Spack nor Apptainer is here: the recipe runs against stand-ins for the names that it takes from Spack."""

import contextlib
import re
import sys
import tomllib
import types
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CMAKE = (ROOT / "CMakeLists.txt").read_text()
INSTALL = (ROOT / "jobs" / "install" / "install.cmake").read_text()
REPOSITORY = ROOT / "jobs" / "spack" / "spack_repo" / "peterka"
SPACK_NAMES = {"MPI": "mpi", "HDF5": "hdf5", "SUNDIALS": "sundials", "Eigen3": "eigen", "fmt": "fmt", "CLI11": "cli11", "hwy": "highway",
               "tomlplusplus": "tomlplusplus", "xxhash": "xxhash", "flint": "flint", "Python3": "python"}
CONTAINERS = ["peterka.def", "Containerfile"]


@pytest.fixture
def recipe(monkeypatch):
    """(the class, what it called: [(directive, its first argument)])."""
    calls = []

    def directive(name):
        return lambda first, *_, **__: calls.append((name, first))
    package = types.ModuleType("spack.package")
    for name in ("version", "variant", "depends_on", "extends"):
        setattr(package, name, directive(name))
    package.when = lambda _: contextlib.nullcontext()
    cmake = types.ModuleType("spack_repo.builtin.build_systems.cmake")
    cmake.CMakePackage = type("CMakePackage", (), {"define": staticmethod(lambda key, value: f"-D{key}={value}"),
                                                    "spec": {"python": types.SimpleNamespace(command=types.SimpleNamespace(path="PYTHON"))}})
    for name, module in (("spack.package", package), ("spack_repo.builtin.build_systems.cmake", cmake)):
        for parent in (name.rsplit(".", level)[0] for level in range(name.count("."), 0, -1)):
            monkeypatch.setitem(sys.modules, parent, types.ModuleType(parent))
        monkeypatch.setitem(sys.modules, name, module)
    space = {"__name__": "package"}
    exec((REPOSITORY / "packages" / "peterka" / "package.py").read_text(), space)  # noqa: S102: our own file
    return space["Peterka"], calls


def needed(calls):
    """{package: the version from which on it will do, or ""}."""
    specs = [spec for name, spec in calls if name == "depends_on"]
    return {name: version for name, version in (re.match(r"([\w-]+)(?:@([\d.]+):)?", spec).groups(default="") for spec in specs)}


def test_spack_builds_this_version(recipe):
    _, calls = recipe
    version = re.search(r"^project\(peterka VERSION (\S+)", CMAKE, re.MULTILINE).group(1)
    assert ("version", version) in calls
    assert f"peterka@{version}" in (REPOSITORY / "packages" / "peterka" / "package.py").read_text()


def test_spack_brings_all_that_cmake_looks_for(recipe):
    packages = needed(recipe[1])
    wanted = re.findall(r"^find_package\((\w+)(?: ([\d.]+))?", CMAKE + INSTALL, re.MULTILINE)
    wanted += [(name, "") for name in re.findall(r"^find_library\(\w+ (\w+) REQUIRED", CMAKE, re.MULTILINE)]
    assert len(wanted) == len(SPACK_NAMES)
    for name, version in wanted:
        assert packages[SPACK_NAMES[name]].startswith(version), name
    assert packages["cmake"] == re.search(r"cmake_minimum_required\(VERSION ([\d.]+)", CMAKE).group(1)
    assert packages["eigen"] == re.search(r"Eigen3_VERSION VERSION_LESS ([\d.]+)", CMAKE).group(1)


def test_spack_brings_all_that_the_python_package_needs(recipe):
    packages = needed(recipe[1])
    project = tomllib.loads((ROOT / "postprocess" / "pyproject.toml").read_text())["project"]
    wanted = {f"py-{name}": version for name, version in (requirement.split(">=") for requirement in project["dependencies"])}
    assert {name: version for name, version in packages.items() if name.startswith("py-")} == wanted


def test_spack_sets_what_cmake_knows(recipe):
    arguments = recipe[0]().cmake_args()
    assert "-DPython3_EXECUTABLE=PYTHON" in arguments
    known = CMAKE + INSTALL + (ROOT / "jobs" / "prepare.sh").read_text()
    assert [one for one in arguments if one[2:].split("=")[0] not in known] == []


@pytest.mark.parametrize("name", CONTAINERS)
def test_a_container_copies_what_is_there_and_all_that_is_needed(name):
    text = (ROOT / "jobs" / "container" / name).read_text()
    copied = re.findall(r"^(?:COPY|   ) (\S+) /opt/peterka/(\S+)$", text, re.MULTILINE)
    assert {source for source, _ in copied} == {"CMakeLists.txt", "jobs", "postprocess", "src"}
    assert [source for source, target in copied if source != target or not (ROOT / source).exists()] == []


def test_both_containers_run_the_same_commands():
    definition, containerfile = ((ROOT / "jobs" / "container" / name).read_text() for name in CONTAINERS)
    post = [line.strip() for line in definition.split("%post\n")[1].split("\n\n")[0].splitlines()]
    run = containerfile.split("RUN ")[1].split("\nENV")[0].replace("\\\n", "")
    assert [part.strip() for part in run.split("&&")] == post
    program, option = post[1].split()
    assert option in (ROOT / program).read_text()
