"""Pages shared by several tests, written once, and one browser for all of them."""

import pages
import pytest

FIELDS = 'output.fields=["multiplier", "sensitivity", "impact_speed", "last_impact"]'
SIZE = 48
SMALL = (f"axes.frequency_ratio.points={SIZE}", f"axes.gap_ratio.points={SIZE}", "audit.cells=0")
JOBS = pages.ROOT / "jobs"


@pytest.fixture(scope="session")
def browser():
    one = pages.Browser()
    yield one
    one.driver.quit()


@pytest.fixture(scope="session")
def map_file(tmp_path_factory):
    return pages.compute(tmp_path_factory.mktemp("map"), JOBS / "peterka_170mm.toml", *SMALL, FIELDS)


@pytest.fixture(scope="session")
def map_page(map_file):
    return pages.written(map_file)


@pytest.fixture(scope="session")
def basin_page(tmp_path_factory):
    settings = [f"axes.{axis}_ratio.points=32" for axis in ("displacement", "velocity")]
    return pages.written(pages.compute(tmp_path_factory.mktemp("basin"), JOBS / "basin_150mm_coexisting.toml", *settings))


@pytest.fixture(scope="session")
def page_of(tmp_path_factory):
    """The file of a shipped job with these settings."""

    def make(job, *settings, code=0):
        return pages.written(pages.compute(tmp_path_factory.mktemp("page"), JOBS / job, *settings, code=code))

    return make
