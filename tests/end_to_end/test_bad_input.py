"""Bad input: a clear message, printed once, the documented exit code, and no file left that could pass for a map."""

import os
import shutil
import subprocess

import pytest

import jobs
import launch

RANKS = [None, 3]


def refused(folder, *arguments, code, saying, ranks=None):
    """The run ends with `code` and gives the reason once, in these words; nothing else changes in the folder."""
    before = {path: path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}
    finished = launch.run("run", *arguments, cwd=folder, ranks=ranks)
    assert finished.returncode == code, finished.stdout + finished.stderr
    assert finished.stdout == ""
    for word in saying:
        assert word in finished.stderr
    assert finished.stderr.count("peterka: ") == 1, finished.stderr
    for trace in ["terminate called", "HDF5-DIAG", "Segmentation", "*** Process received signal"]:
        assert trace not in finished.stderr
    after = {path: path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}
    assert after == before
    return finished


@pytest.mark.parametrize("ranks", RANKS)
def test_missing_job(tmp_path, ranks):
    refused(tmp_path, "nowhere.toml", code=2, saying=["nowhere.toml"], ranks=ranks)


@pytest.mark.parametrize("ranks", RANKS)
def test_job_that_is_a_directory(tmp_path, ranks):
    (tmp_path / "folder.toml").mkdir()
    refused(tmp_path, "folder.toml", code=2, saying=["folder.toml", "this is a folder"], ranks=ranks)


@pytest.mark.parametrize("ranks", RANKS)
def test_job_of_binary_rubbish(tmp_path, ranks):
    (tmp_path / "job.toml").write_bytes(bytes(range(256)) * 40)
    refused(tmp_path, "job.toml", code=2, saying=["job.toml"], ranks=ranks)


def test_job_that_never_ends(tmp_path):
    refused(tmp_path, "/dev/zero", code=2, saying=["/dev/zero"])


def test_empty_job(tmp_path):
    jobs.write(tmp_path, "")
    refused(tmp_path, "job.toml", code=2, saying=["job.toml", "empty"])


@pytest.mark.parametrize("ranks", RANKS)
@pytest.mark.parametrize("good, bad, words", [
    ("mass_kg = 0.298", "mass_kg = -0.298", ["job.toml:6:", "mass_kg"]),
    ("from = 0.5", "from = 5.5", ["from"]),
    ("points = 40", "points = 0", ["points"]),
    ("mass_kg = 0.298", "mass_kg = nan", ["mass_kg"]),
    ("mass_kg", "mas_kg", ["mas_kg", "mass_kg"]),
])
def test_faults_of_a_job(tmp_path, good, bad, words, ranks):
    text = jobs.small_map()
    assert good in text
    jobs.write(tmp_path, text.replace(good, bad, 1))
    refused(tmp_path, "job.toml", code=2, saying=words, ranks=ranks)


def test_all_faults_are_told_at_once(tmp_path):
    jobs.write(tmp_path, jobs.small_map().replace("0.298", "-0.298").replace("points = 40", "points = 0"))
    refused(tmp_path, "job.toml", code=2, saying=["mass_kg", "points"])


def test_bad_override(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    refused(tmp_path, "job.toml", "--set", "hammer.mass_kg=-1", code=2, saying=["--set", "mass_kg"])


@pytest.mark.parametrize("ranks", RANKS)
def test_bad_arguments(tmp_path, ranks):
    refused(tmp_path, "job.toml", "--max-wall", "soon", code=2, saying=["--max-wall", "--help"], ranks=ranks)


@pytest.mark.parametrize("ranks", RANKS)
def test_output_folder_that_is_not_there(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_map())
    refused(tmp_path, "job.toml", "--output", "no/such/map.h5", code=3, saying=["no/such"], ranks=ranks)


@pytest.mark.parametrize("ranks", RANKS)
def test_output_folder_that_cannot_be_written(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_map())
    refused(tmp_path, "job.toml", "--output", "/proc/map.h5", code=3, saying=["/proc"], ranks=ranks)


@pytest.mark.parametrize("ranks", RANKS)
def test_output_that_is_a_directory(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_map())
    (tmp_path / "job.h5").mkdir()
    refused(tmp_path, "job.toml", code=3, saying=["job.h5", "director"], ranks=ranks)


@pytest.mark.parametrize("options", [[], ["--fresh"]])
@pytest.mark.parametrize("content", [b"dear diary\n", b"", bytes(range(256)) * 40])
def test_output_that_is_another_kind_of_file(tmp_path, content, options):
    jobs.write(tmp_path, jobs.small_map())
    (tmp_path / "job.h5").write_bytes(content)
    refused(tmp_path, "job.toml", *options, code=3, saying=["job.h5"])


@pytest.mark.parametrize("ranks", RANKS)
def test_output_of_another_job(tmp_path, small_map_file, ranks):
    jobs.write(tmp_path, jobs.small_map().replace("amplitude_m = 0.89e-3", "amplitude_m = 0.90e-3"))
    shutil.copy(small_map_file, tmp_path / "job.h5")
    refused(tmp_path, "job.toml", code=3, saying=["amplitude_m", "--fresh"], ranks=ranks)


def test_output_that_is_cut_short(tmp_path, small_map_file):
    jobs.write(tmp_path, jobs.small_map())
    whole = small_map_file.read_bytes()
    (tmp_path / "job.h5").write_bytes(whole[: len(whole) // 2])
    refused(tmp_path, "job.toml", code=3, saying=["job.h5"])


@pytest.mark.parametrize("ranks", RANKS)
def test_a_map_larger_than_the_disk(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_map(columns=10**9))
    refused(tmp_path, "job.toml", code=3, saying=["B"], ranks=ranks)


def test_a_map_larger_than_any_disk(tmp_path):
    jobs.write(tmp_path, jobs.small_map(columns=10**6, rows=10**6))
    refused(tmp_path, "job.toml", code=3, saying=["job.h5"])


def run_without_privileges(folder, *arguments):
    """Root may write everywhere, so the test drops that capability."""
    limited = ["setpriv", "--bounding-set=-dac_override,-dac_read_search"] if os.geteuid() == 0 else []
    return subprocess.run([*limited, *launch.command(*arguments)], cwd=folder, env=launch.ENVIRONMENT,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=launch.HANGING)


def test_a_folder_that_cannot_be_written_is_named(tmp_path):
    jobs.write(tmp_path, jobs.small_map(4, 4))
    (tmp_path / "kept").mkdir(mode=0o555)
    finished = run_without_privileges(tmp_path, "run", "job.toml", "--output", "kept/job.h5")
    assert finished.returncode == 3
    assert "kept/job.h5: the folder kept cannot be written: Permission denied" in finished.stderr
    assert list((tmp_path / "kept").iterdir()) == []


def test_an_unfinished_map_that_cannot_be_written_is_left_alone(tmp_path):
    jobs.write(tmp_path, jobs.small_map(4, 4))
    launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path)
    (tmp_path / "job.h5").chmod(0o444)
    before = (tmp_path / "job.h5").read_bytes()
    finished = run_without_privileges(tmp_path, "run", "job.toml")
    assert finished.returncode == 3
    assert "job.h5: is not finished and cannot be written: Permission denied" in finished.stderr
    assert (tmp_path / "job.h5").read_bytes() == before
