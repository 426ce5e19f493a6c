"""A table of differences between measured and computed forces: a line for each motion known beside a point."""

from collections.abc import Sequence
from dataclasses import dataclass

from ..plotting.units import number
from .matches import Match
from .points import Point

HEADS = ("motion", "starts", "computed", "residual", "", "", "computed at", "label")


@dataclass(frozen=True)
class Units:
    """The file's unit frequency, gap and force in Hz, mm and N; None if the file does not give it."""

    hertz: float | None
    millimetres: float | None
    newtons: float | None


def table(found: Sequence[Sequence[Match]], units: Units) -> list[str]:
    """The table's lines for the [Match] of each point, the nearest motion on a point's first line."""
    if not found:
        return []
    force = f"[{'N' if units.newtons else 'F/(m g)'}]"
    heads = (f"frequency [{'Hz' if units.hertz else 'Omega/omega'}]", f"gap [{'mm' if units.millimetres else 'gap/A0'}]",
             f"measured {force}", *(head + f" {force}" * (head in ("computed", "residual")) for head in HEADS))
    rows = [[*(_of_point(matches[0].point, units) if number == 0 else [""] * 3), *_of_motion(match, units),
             name_of(match.point) if number == 0 else ""] for matches in found for number, match in enumerate(matches)]
    told = [number for number, column in enumerate(zip(*rows)) if any(column)]  # a column of nothing is left out
    return lines([heads[number] for number in told], [[row[number] for number in told] for row in rows])


def lines(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """The table as text, all columns but the last right-aligned."""
    table = [heads, *rows]
    widths = [max(map(len, column)) for column in zip(*table)]
    return [("  ".join(cell.rjust(width) for cell, width in zip(row[:-1], widths)) + f"  {row[-1]}").rstrip() for row in table]


def name_of(point: Point) -> str:
    """The point's series and label, as available."""
    return ", ".join(filter(None, (point.series, point.label)))


def _of_point(point: Point, units: Units) -> tuple[str, ...]:
    assert point.force is not None
    return (f"{point.frequency * (units.hertz or 1):.5g}", "" if point.gap is None else f"{point.gap * (units.millimetres or 1):.4g}",
            f"{point.force * (units.newtons or 1):.4g}")


def _of_motion(match: Match, units: Units) -> tuple[str, ...]:
    error = match.point.errors.get("force")
    share = match.motion.share
    return (match.motion.title, "" if share is None else f"{100 * share:.3g} %", f"{match.force * (units.newtons or 1):.4g}",
            f"{'-' if match.residual < 0 else '+'}{number(abs(match.residual) * (units.newtons or 1))}",
            f"{100 * match.residual / match.force:+.1f} %" if match.force > 0 else "",
            f"{match.residual / error:+.1f} s.e." if error else "", _where(match.away, units))


def _where(away: tuple[float, float] | None, units: Units) -> str:
    if away is None or not any(away):
        return "the point"
    frequency, gap = away
    parts = [f"{frequency * (units.hertz or 1):.2g} {'Hz' if units.hertz else 'of Omega/omega'}"] if frequency else []
    parts += [f"{gap * (units.millimetres or 1):.2g} {'mm' if units.millimetres else 'of gap/A0'}"] if gap else []
    return f"{', '.join(parts)} away"
