"""The faults that tests/mutation.sh always tries, and those that it knows to have no effect, are in the code as it is: else it
stops before its first one, or tells what it knew as new."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LISTS = ROOT / "tests" / "mutation"
sys.path.insert(0, str(LISTS))
from mutants import known_faults  # noqa: E402


def lines(name):
    return (LISTS / name).read_text().splitlines()


@pytest.mark.parametrize("line", lines("known_faults.txt"))
def test_a_known_fault_has_one_place_in_the_code(line):
    (fault,) = known_faults([line], lambda path: (ROOT / "src" / path).read_text())
    path, before, after = line.split(" | ")
    assert (fault.path, fault.after) == (path, after)
    assert (ROOT / "src" / path).read_text()[fault.begin:fault.end] == before


@pytest.mark.parametrize("line", lines("equivalent.txt"))
def test_what_has_no_effect_is_still_in_the_code(line):
    path, _, change = line.rpartition(" # ")[0].partition(": ")
    before = change.partition(" -> ")[0]
    file = ROOT / path if path.startswith("postprocess/") else ROOT / "src" / path
    assert before in " ".join(file.read_text().split())
