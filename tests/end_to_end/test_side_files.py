"""The files that a run keeps beside its output, and the paths by which an output can be reached."""

import os
import signal
import subprocess

import pytest

import jobs
import launch
import map_contents

pytestmark = pytest.mark.thorough


def start_at_work(folder, *arguments):
    process = launch.start("run", "job.toml", *arguments, cwd=folder)
    process.stderr.readline()  # "... cells to compute"
    return process


def test_other_programs_files_of_like_names_stay(tmp_path):
    jobs.write(tmp_path, jobs.small_map(20, 20))
    others = [tmp_path / name for name in ("poetry.lock", "poetry.creating", "poetry.previous")]
    for other in others:
        other.write_text("a poem")
    for fresh in ([], ["--fresh"]):
        assert launch.run("run", "job.toml", "--output", "poetry", *fresh, cwd=tmp_path).returncode == 0
    assert [other.read_text() for other in others] == ["a poem"] * 3


def test_what_mpi_left_of_a_killed_run_goes_with_the_one_that_finishes(tmp_path):
    jobs.write(tmp_path, jobs.small_map(20, 20))
    left = [f"job.h5.{kind}.{rank}" for kind in ("data", "metadata") for rank in (0, 1, 17)]
    others = {"job.h5.data.x": "", "job.h5.data.": "", "job.h5.data.2": "a poem", "other.h5.data.0": ""}
    for name in left:
        (tmp_path / name).touch()
    for name, text in others.items():
        (tmp_path / name).write_text(text)
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=2).returncode == 0
    assert {path.name for path in tmp_path.iterdir()} == {"job.toml", "job.h5", *others}
    assert (tmp_path / "job.h5.data.2").read_text() == "a poem"


@pytest.mark.parametrize("suffix", [".peterka-lock", ".peterka-creating"])
@pytest.mark.parametrize("link", ["symbolic", "hard"])
def test_a_link_in_the_place_of_a_side_file_is_not_followed(tmp_path, suffix, link):
    jobs.write(tmp_path, jobs.small_map(20, 20))
    victim, place = tmp_path / "victim", tmp_path / ("job.h5" + suffix)
    victim.write_text("")
    place.symlink_to(victim) if link == "symbolic" else os.link(victim, place)
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3
    assert f"job.h5{suffix}: is " in finished.stderr and "Move it away" in finished.stderr
    assert victim.read_text() == "" and place.exists() and not (tmp_path / "job.h5").exists()


@pytest.mark.parametrize("kind", ["symbolic", "hard"])
def test_a_second_run_by_another_name_is_kept_out(tmp_path, kind):
    jobs.write(tmp_path, jobs.small_map(1000, 1000))  # seconds, of which a busy machine may take one until the first is stopped
    first = start_at_work(tmp_path)
    alias = tmp_path / "alias.h5"
    alias.symlink_to("job.h5") if kind == "symbolic" else os.link(tmp_path / "job.h5", alias)
    first.send_signal(signal.SIGSTOP)  # so that it holds its lock for as long as others wait
    kept_out = launch.run("run", "job.toml", "--output", "alias.h5", cwd=tmp_path)
    first.terminate()
    first.send_signal(signal.SIGCONT)
    first.communicate(timeout=launch.HANGING)
    assert kept_out.returncode == 3 and "is being written by another run" in kept_out.stderr
    assert first.returncode == 5
    let_in = launch.run("run", "job.toml", "--output", "alias.h5", "--max-wall", "1e-9", cwd=tmp_path)
    assert let_in.returncode == 5 and "stopped early" in let_in.stderr


def test_a_map_that_is_computed_can_be_read_meanwhile(tmp_path):
    jobs.write(tmp_path, jobs.larger_map())
    run = start_at_work(tmp_path)
    done = map_contents.done_tiles(tmp_path / "job.h5")
    run.communicate(timeout=launch.HANGING)
    assert run.returncode == 0 and 0 <= done <= map_contents.tile_count(tmp_path / "job.h5")


def test_a_file_that_is_replaced_during_the_run_is_noticed(tmp_path):
    jobs.write(tmp_path, jobs.larger_map())
    run = start_at_work(tmp_path)
    (tmp_path / "other").write_text("somebody's")
    os.replace(tmp_path / "other", tmp_path / "job.h5")
    output, errors = run.communicate(timeout=launch.HANGING)
    assert run.returncode == 3 and output == ""
    assert "job.h5: has been replaced by another file" in errors
    assert (tmp_path / "job.h5").read_text() == "somebody's"


def test_an_output_that_is_a_link_to_a_map_stays_one(tmp_path):
    jobs.write(tmp_path, jobs.small_map(20, 20))
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "job.h5").symlink_to("elsewhere/map.h5")
    dangling = launch.run("run", "job.toml", cwd=tmp_path)
    assert dangling.returncode == 3 and "job.h5: is a link that can't be followed" in dangling.stderr
    (tmp_path / "job.h5").unlink()
    assert launch.run("run", "job.toml", "--output", "elsewhere/map.h5", cwd=tmp_path).returncode == 0
    (tmp_path / "job.h5").symlink_to("elsewhere/map.h5")
    assert launch.run("run", "job.toml", "--fresh", cwd=tmp_path).returncode == 0
    assert (tmp_path / "job.h5").is_symlink()
    assert [path.name for path in (tmp_path / "elsewhere").iterdir()] == ["map.h5"]


def test_a_lock_that_cannot_be_made_is_told(tmp_path):
    """As on a file system without locks."""
    jobs.write(tmp_path, jobs.small_map(20, 20))
    environment = launch.ENVIRONMENT | {"LD_PRELOAD": str(launch.BINARY.with_name("faulty_io.so")), "FAULTY_PATH": "job.h5",
                                        "FAULTY_CALL": "lock", "FAULTY_AT": "1", "FAULTY_HOW": "EIO"}
    finished = subprocess.run([launch.BINARY, "run", "job.toml"], cwd=tmp_path, env=environment, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, timeout=launch.HANGING)
    assert finished.returncode == 0
    assert "job.h5 can't be locked (Input/output error): nothing keeps a second run from it" in finished.stderr
