"""Reference files for several tests: computed once, alone and without interruption."""

import pytest

import jobs
import launch


def compute(folder, text):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", "--quiet", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5"


@pytest.fixture(scope="session")
def small_map_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("small_map"), jobs.small_map())


@pytest.fixture(scope="session")
def small_basin_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("small_basin"), jobs.small_basin())


@pytest.fixture(scope="session")
def medium_map_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("medium_map"), jobs.medium_map())


@pytest.fixture(scope="session")
def small_sweep_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("small_sweep"), jobs.small_sweep())


@pytest.fixture(scope="session")
def larger_map_file(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("larger_map"), jobs.larger_map())
