"""test_damaged_files.py with files of all other kinds."""

import pytest

import damaged_files
import test_damaged_files as sample

pytestmark = pytest.mark.thorough


@pytest.fixture(scope="module", params=sample.MORE_KINDS)
def readers(request, tmp_path_factory):
    return damaged_files.Readers(tmp_path_factory.mktemp("damaged"), request.param)


test_a_damaged_file_is_refused_or_shown_as_it_was = sample.test_a_damaged_file_is_refused_or_shown_as_it_was
test_run_refuses_it_too = sample.test_run_refuses_it_too
