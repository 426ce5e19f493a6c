"""Text from a file or a job can neither command the terminal on which it is shown nor flood it."""

import shutil
import subprocess

import h5py
import pytest

import jobs
import launch

COMMAND = "\x1b]0;owned\x07\x1b[2J\u009b31m\u202e\npeterka: all is well\r"


def shown(*arguments, cwd):
    finished = subprocess.run(launch.command(*arguments), cwd=cwd, env=launch.ENVIRONMENT, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=launch.HANGING)
    text = finished.stdout.decode("utf-8")
    strange = [letter for letter in text if not letter.isprintable() and letter != "\n"]
    assert not strange, text
    return finished.returncode, text


@pytest.fixture
def unfinished(tmp_path):
    jobs.write(tmp_path, jobs.small_map(columns=8, rows=8))
    assert launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path).returncode == 5
    return tmp_path


def test_arithmetic_of_a_file(unfinished):
    with h5py.File(unfinished / "job.h5", "r+") as file:
        file.attrs["arithmetic"] = "x86" + COMMAND + "x" * 10000
    code, text = shown("run", "job.toml", cwd=unfinished)
    assert code == 3 and "x86\\x1b]0;owned\\x07\\x1b[2J\\u009b31m\\u202e\\x0apeterka" in text
    assert len(text) < 1000 and len(text.splitlines()) == 1


def test_job_of_a_file(unfinished):
    keys = "".join(f"key_{number}{COMMAND.splitlines()[0]} = {number}\n" for number in range(20000))
    with h5py.File(unfinished / "job.h5", "r+") as file:
        del file.attrs["job_identity"]
        file.attrs["job_identity"] = keys[:40000]
    code, text = shown("run", "job.toml", cwd=unfinished)
    assert code == 3 and "belongs to another job" in text and "more keys" in text
    assert text.splitlines()[-1].startswith("Start over with --fresh")
    assert len(text) < 50000 and len(text.splitlines()) < 60


def test_names_of_files(tmp_path, small_map_file):
    name = "a\x1b[2J\nb.h5"
    shutil.copy(small_map_file, tmp_path / name)
    jobs.write(tmp_path, jobs.small_map())
    code, text = shown("run", "job.toml", "--output", name, cwd=tmp_path)
    assert code == 0 and "a\\x1b[2J" in text
    code, text = shown("check", "no\x1b[2Jjob.toml", cwd=tmp_path)
    assert code == 2 and "no\\x1b[2Jjob.toml" in text


def test_titles(tmp_path):
    title = "red \\u009b31m"
    jobs.write(tmp_path, jobs.small_map(columns=8, rows=8, title=title))
    code, text = shown("run", "job.toml", cwd=tmp_path)
    assert code == 2 and "title has a line break or control character" in text
