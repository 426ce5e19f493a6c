"""The program loads nothing from its working directory, and libc and linker hardening are enabled."""

import re
import subprocess

import pytest

import launch


def read(binary, option):
    return subprocess.run(["readelf", "-W", option, binary], capture_output=True, text=True, check=True).stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    prefix = tmp_path_factory.mktemp("installed")
    subprocess.run(["cmake", "--install", launch.BINARY.parent, "--prefix", prefix], check=True, capture_output=True)
    return prefix / "bin" / "peterka"


@pytest.fixture(params=["built", "installed"])
def binary(request, installed):
    return launch.BINARY if request.param == "built" else installed


def test_libraries_are_searched_in_absolute_folders_alone(binary):
    paths = re.findall(r"\((?:RUNPATH|RPATH)\).*\[(.*)\]", read(binary, "-d"))
    folders = [folder for path in paths for folder in path.split(":")]
    assert all(folder.startswith("/") for folder in folders), folders


def test_libraries_in_the_current_folder_are_not_loaded(tmp_path, binary):
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", read(binary, "-d"))
    assert "libfmt" in " ".join(needed)
    for name in needed:
        (tmp_path / name).write_bytes(b"no library")
    shown = launch.run("--version", cwd=tmp_path, binary=binary)
    assert shown.returncode == 0, shown.stderr


def test_addresses_are_random_and_tables_of_the_linker_are_read_only(binary):
    dynamic, segments = read(binary, "-d"), read(binary, "-l")
    assert "DYN" in segments.split("\n")[1]
    assert "GNU_RELRO" in segments and "BIND_NOW" in dynamic
    assert re.search(r"GNU_STACK.* RW ", segments)


def test_the_stack_and_calls_of_libc_are_watched(binary):
    symbols = read(binary, "--dyn-syms")
    assert "__stack_chk_fail" in symbols
    assert re.search(r"__\w+_chk@", symbols.replace("__stack_chk_fail", ""))
