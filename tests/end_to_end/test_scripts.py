"""The shell scripts of jobs/ and tests/: they print their usage, refuse
unknown arguments before they begin, and build in a relocated clone."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = sorted(str(path.relative_to(ROOT)) for folder in ("jobs", "tests", "tests/endurance")
                 for path in (ROOT / folder).glob("*.sh") if os.access(path, os.X_OK))
WITH_FOLDERS = ["jobs/api.sh", "jobs/benchmark.sh", "jobs/gallery.sh", "jobs/paper.sh", "jobs/peers.sh",
                "jobs/results.sh"]
BEGUN = "has begun"


@pytest.fixture
def start(tmp_path):
    """Runs a script in an empty folder, where every program that would do work only reports that it was started."""
    programs = tmp_path / "programs"
    programs.mkdir()
    for name in ("cmake", "ctest", "mpirun", "apt-get", "clang-format", "clang-tidy", "dpkg-query", "ip", "valgrind"):
        (programs / name).write_text(f"#!/bin/sh\necho {name} {BEGUN}\nexit 99\n", encoding="utf-8")
        (programs / name).chmod(0o755)
    folder = tmp_path / "here"
    folder.mkdir()

    def run(script, *arguments, **variables):
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("PETERKA_BINARY", "PETERKA_BUILD", "ENDURANCE_ROWS")}
        environment["PATH"] = f"{programs}:{environment['PATH']}"
        return subprocess.run([ROOT / script, *arguments], cwd=folder, env=environment | variables, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, timeout=60, check=False)

    run.folder = folder
    return run


def refused(done, *words):
    """Whether a script ended with one line containing these words, without having begun."""
    assert BEGUN not in done.stdout + done.stderr
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    assert all(word in done.stderr for word in words), done.stderr
    return True


def test_all_scripts_are_found():
    assert {"jobs/prepare.sh", "jobs/quickstart.sh", "tests/run.sh", "tests/style.sh", "tests/endurance/fuzz.sh",
            *WITH_FOLDERS} <= set(SCRIPTS)


@pytest.mark.parametrize("script", SCRIPTS)
def test_help_is_the_usage(start, script):
    done = start(script, "--help")
    assert (done.returncode, done.stderr) == (0, "")
    assert BEGUN not in done.stdout and 0 < done.stdout.count("\n") < 20
    comment = re.match(r"#!.*\n((?:#.*\n)+)", (ROOT / script).read_text(encoding="utf-8")).group(1)
    assert done.stdout == re.sub(r"(?m)^# ?", "", comment)
    assert list(start.folder.iterdir()) == []


@pytest.mark.parametrize("script", SCRIPTS)
@pytest.mark.parametrize("argument", ["--no-such-option", "-x", ""])
def test_an_unknown_option_is_refused(start, script, argument):
    assert refused(start(script, argument), Path(script).name, argument, "--help tells the usage")
    assert list(start.folder.iterdir()) == []


@pytest.mark.parametrize("script", WITH_FOLDERS)
def test_a_folder_that_is_none_is_refused(start, script):
    (start.folder / "map.h5").write_text("a file", encoding="utf-8")
    assert refused(start(script, "map.h5"), "map.h5 is not a folder")
    assert refused(start(script, "map.h5/results"), "map.h5/results")
    assert refused(start(script, "a", "b", "c"), "too many arguments: a b c")


@pytest.mark.parametrize("script, arguments, words", [
    ("jobs/benchmark.sh", ["--quick", "--huge"], ["exclude each other"]),
    ("jobs/quickstart.sh", ["nowhere.toml"], ["there is no job file nowhere.toml"]),
    ("jobs/prepare.sh", ["Not_A_Package"], ["Not_A_Package is no name of a package"]),
    ("tests/run.sh", ["job"], ["job follows no -R"]),
    ("tests/run.sh", ["-R"], ["-R wants a pattern"]),
    ("tests/run.sh", ["--all", "-R", "job"], ["one option at a time"]),
    ("tests/releases.sh", ["bookworm", "/etc"], ["/etc is no name of a release"]),
    ("tests/endurance.sh", ["signals", "nowhere"], ["there is no part nowhere"]),
    ("tests/endurance/signals.py", [], ["tests/endurance.sh signals"]),
    ("tests/endurance/hosts.sh", [], ["tests/endurance.sh hosts"]),
])
def test_odd_arguments_are_refused(start, script, arguments, words):
    assert refused(start(script, *arguments), Path(script).name, *words)


@pytest.mark.parametrize("script, variable", [
    ("jobs/paper.sh", "PETERKA_BINARY"), ("jobs/results.sh", "PETERKA_BINARY"), ("tests/endurance.sh", "PETERKA_BINARY"),
    ("jobs/benchmark.sh", "PETERKA_BUILD"),
])
def test_a_program_that_is_none_is_refused(start, script, variable):
    assert refused(start(script, **{variable: "nowhere"}), f"{variable}=nowhere")


def test_a_job_named_from_elsewhere_is_found(start):
    (start.folder / "mine.toml").write_text("schema = 1\n", encoding="utf-8")
    done = start("jobs/quickstart.sh", "mine.toml")
    assert BEGUN in done.stdout + done.stderr and "no job file" not in done.stderr


def run_in(clone, programs, *arguments):
    environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}"}
    return subprocess.run([clone / "jobs" / "prepare.sh", *arguments], env=environment, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, timeout=120, check=False)


def test_a_clone_that_was_moved_or_copied_is_configured_anew(tmp_path):
    """With a project of one target; all packages are present."""
    programs, clone = tmp_path / "programs", tmp_path / "clone"
    programs.mkdir()
    (programs / "dpkg-query").write_text("#!/bin/sh\necho 'install ok installed'\n", encoding="utf-8")
    (programs / "dpkg-query").chmod(0o755)
    (clone / "jobs").mkdir(parents=True)
    for name in ("prepare.sh", "arguments.sh"):
        shutil.copy(ROOT / "jobs" / name, clone / "jobs" / name)
    (clone / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.22)\nproject(clone NONE)\n"
        "add_custom_target(all_of_it ALL COMMAND ${CMAKE_COMMAND} -E echo built in ${CMAKE_SOURCE_DIR})\n",
        encoding="utf-8")

    def build_is_new(folder):
        done = run_in(folder, programs)
        assert done.returncode == 0, done.stdout + done.stderr
        assert f"built in {folder}\n" in done.stdout
        return "configured anew" in done.stderr

    assert not build_is_new(clone)  # there was none
    assert not build_is_new(clone)
    shutil.copytree(clone, tmp_path / "copy")
    assert build_is_new(tmp_path / "copy")
    clone.rename(tmp_path / "moved")
    assert build_is_new(tmp_path / "moved")
    assert not build_is_new(tmp_path / "moved")
