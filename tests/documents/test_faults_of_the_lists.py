"""The faults that tests/mutation.sh always tries, and those that it knows to have no effect, are in the code as it is: else it
stops before its first one, or tells what it knew as new. Where none is asked for, the code with all of them means what it meant."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LISTS = ROOT / "tests" / "mutation"
sys.path.insert(0, str(LISTS))
from mutants import known_faults, mutants_of, with_all  # noqa: E402


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


@pytest.mark.parametrize("assigned, left, right", [
    ("sum += a > 0 && b ? 1 : 0;", "a > 0", "b"), ("sum = a && b > 1;", "a", "b > 1"), ("sum |= a || f(b, c) ? 1 : 0;", "a", "f(b, c)"),
    ("return a != 0 && b;", "a != 0", "b"), ("sum = c ? a && b : d;", "a", "b"),
])
def test_a_turned_and_or_or_takes_its_two_operands_alone(assigned, left, right):
    text = f"void f() {{\n    {assigned}\n}}\n"
    (turned,) = [mutant for mutant in mutants_of("f.cpp", text) if text[mutant.begin:mutant.end] in (" && ", " || ")]
    with_it, left_out = with_all(text, {7: turned})
    assert left_out == []
    asked = "peterka_mutant::asked<7, false>()"
    of_both = f"((bool({left}) != {asked}) {text[turned.begin:turned.end].strip()} (bool({right}) != {asked})) != {asked}"
    assert of_both in with_it
    assert with_it.replace(of_both, text[text.index(left):text.index(right) + len(right)]) == text
