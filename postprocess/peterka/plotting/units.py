"""Formats amounts with the prefix that keeps the number between 1 and 1000."""

from collections.abc import Iterable

import numpy as np

PREFIXES = [(1e-9, "n"), (1e-6, "µ"), (1e-3, "m"), (1, ""), (1e3, "k"), (1e6, "M"), (1e9, "G"), (1e12, "T")]
PLAIN_TO = 1e6
DIGITS = 4  # significant ones, as in the program's summary


def with_prefix(largest: float, unit: str) -> tuple[float, str]:
    """(factor, unit with the prefix) that bring a scale's largest value to 1 ... 1000 if prefixes suffice."""
    fitting = [(size, letter) for size, letter in PREFIXES if largest >= size * (1 - 1e-12)]
    size, letter = fitting[-1] if fitting else (PREFIXES[0] if largest > 0 else (1, ""))
    return 1 / size, letter + unit


def amount(value: float, unit: str, digits: int = DIGITS) -> str:
    """2714.2 N becomes "2.714 kN"."""
    rounded = float(f"{value:.{digits}g}")  # 999.96 becomes 1 k
    factor, unit = with_prefix(abs(rounded), unit)
    return f"{number(rounded * factor, digits)} {unit}"


def number(value: float, digits: int = DIGITS) -> str:
    """Plain up to a million: 10856 becomes "10860"."""
    rounded = float(f"{value:.{digits}g}")
    if not np.isfinite(rounded) or not 1e-4 <= abs(rounded) < PLAIN_TO:
        return f"{value:.{digits}g}"
    return f"{rounded:.0f}" if abs(rounded) >= 10 ** (digits - 1) else f"{rounded:.{digits}g}"


def number_apart(value: float, others: Iterable[float], digits: int = DIGITS) -> str:
    """With more digits if others that differ by more than rounding would read the same."""
    apart = [other for other in others if not np.isclose(other, value, rtol=1e-9, atol=0)]
    while digits < 9 and any(number(other, digits) == number(value, digits) for other in apart):
        digits += 1
    return number(value, digits)
