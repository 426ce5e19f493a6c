"""The program refuses each bad job with exit code 2 and its message on stderr, before it computes or writes anything."""

import os
import pathlib
import subprocess

import pytest

FOLDER = pathlib.Path(__file__).parent / "bad"
BINARY = os.environ.get("PETERKA_BINARY", "build/peterka")
MARK = "#! --set "


def run(command, job, cwd, overrides=()):
    arguments = [BINARY, command, str(job)]
    for override in overrides:
        arguments += ["--set", override]
    return subprocess.run(arguments, cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)


def overrides_in(job):
    return [line[len(MARK):] for line in job.read_text().splitlines() if line.startswith(MARK)]


@pytest.mark.parametrize("command", ["check", "run"])
@pytest.mark.parametrize("name", ["all_at_once", "mass_negative", "axis_backwards", "axis_without_points",
                                  "syntax_key_twice", "set_faults_after_those_of_the_file"])
def test_bad_job_gets_its_message_and_leaves_no_file(name, command, tmp_path):
    job = FOLDER / f"{name}.toml"
    result = run(command, job, tmp_path, overrides_in(job))
    assert result.returncode == 2
    for line in (FOLDER / f"{name}.txt").read_text().splitlines():
        assert line in result.stderr
    assert result.stdout == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("content", [None, b"", bytes(range(256)) * 8, b"\x89HDF\r\n\x1a\n" + b"\0" * 4096])
def test_what_is_no_job_is_refused(content, tmp_path):
    job = tmp_path / "job.toml"
    if content is not None:
        job.write_bytes(content)
    result = run("check", job, tmp_path)
    assert result.returncode == 2
    assert "job.toml" in result.stderr


def test_folder_is_refused(tmp_path):
    result = run("check", tmp_path, tmp_path)
    assert result.returncode == 2
    assert "this is a folder" in result.stderr
