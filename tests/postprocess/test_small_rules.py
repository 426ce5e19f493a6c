"""Rules of a line or two that no picture or page shows: arguments at the ends of their range, labels of nothing."""

import argparse

import numpy as np
import pytest
from peterka.cli import explore
from peterka.plotting.linear_ticks import letters, numbers


@pytest.mark.parametrize("text, step", [("1", 1), ("7", 7), ("99999", 99999)])
def test_a_step_along_rows_and_columns_is_taken(text, step):
    assert explore.read_step(text) == step


@pytest.mark.parametrize("text", ["0", "100000", "-1", "1.5", "", "two", "\N{SUPERSCRIPT TWO}"])
def test_another_step_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError):
        explore.read_step(text)


@pytest.mark.parametrize("values, labels", [
    ([0.0, 0.0], ["0", "0"]), ([], []), ([0.0, 0.5, 1.0], ["0.0", "0.5", "1.0"]), ([-2.0, 0.0, 2.0], ["\N{MINUS SIGN}2", "0", "2"]),
    ([0.0, 2e-9, 4e-9], ["0", r"$2\cdot10^{-9}$", r"$4\cdot10^{-9}$"])])
def test_labels_of_an_axis(values, labels):
    assert numbers(np.array(values)) == labels


def test_a_power_of_ten_takes_less_than_its_digits():
    assert letters("123") == 3
    assert letters(r"$2\cdot10^{-9}$") == pytest.approx(1 + 3 + 0.7 * 2)
