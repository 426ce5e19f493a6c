"""A table of how far measured forces are from computed ones."""

from collections.abc import Sequence

from .points import Point


def lines(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Text: all columns but the last one to the right."""
    table = [heads, *rows]
    widths = [max(map(len, column)) for column in zip(*table)]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row[:-1], widths)) + f"  {row[-1]}".rstrip() for row in table]


def share(point: Point, force: float) -> str:
    """By which part of the computed force the measured one is above it, and by how many of its standard errors; "" where
    nothing impacts. Forces F/(m g)."""
    if not force > 0:
        return ""
    assert point.force is not None
    error = point.errors.get("force")
    return f"{100 * (point.force / force - 1):+.1f} %" + (f" ({abs(point.force - force) / error:.1f} s.e.)" if error else "")


def name_of(point: Point) -> str:
    """Its series and its label, as far as it has them."""
    return ", ".join(filter(None, (point.series, point.label)))
