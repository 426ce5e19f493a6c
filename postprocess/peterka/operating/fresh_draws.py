"""What a place of a map with [uncertainty] is worth by fresh draws: the best of many places owes part of its value to the draws by
which it was chosen, and nothing was computed between its cells.

The program computes the map's rigs at many places from end to end of the drift, and draws many more rigs at the worst of these. The
draws of a low-discrepancy sequence begin with those of the map; all others are new.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..maps.map_file import Axis, PeterkaFile
from ..maps.outcomes import draws_of
from ..plotting import units
from .admitted import Quantity
from .drift import unit_of
from .places import Place
from .risk import admitted_at, assured, needed_share, quantity_at
from .verify import ROUNDING, NotVerified, axis_paths, compute, finer
from .words import on_axis

TIMES, FEWEST, MOST = 16, 1024, 10_000  # draws, times those of the map; at least and at most
PLACES = 17  # from end to end of a drift, along each axis


@dataclass(frozen=True)
class Fresh:
    """`rigs` drawn, `new` of them; where, in words; the `value` reached with the probability asked for [in the unit of the Quantity], NaN
    where the motions asked for are too rare to tell one in them; and the probability of these motions, 1 for any."""

    rigs: int
    new: int
    where: str
    value: float
    share: float = 1.0


def draw_afresh(file: PeterkaFile, place: Place, drift: tuple[float, float], risk: float, folder: Path, ranks: int = 1,
                binary: Path | None = None, regimes: Sequence[str] | None = None) -> Fresh:
    """The Fresh of a Place with a drift [Hz, mm], in any motion or in `regimes`; its jobs and files are written to `folder`."""
    paths = axis_paths(file, file.data.attribute("job"))
    axes = {"columns": file.columns, "rows": file.rows}
    sides = {"columns": _side(file, file.columns, place.column, drift), "rows": _side(file, file.rows, place.row, drift)}
    places = math.prod(points for _, _, points in sides.values())
    where = "at this place"
    if places > 1:
        sides = _worst(file, sides, compute(file, {paths[side]: ends for side, ends in sides.items()}, {}, folder / f"{file.path.stem}_places",
                                            ranks, binary), risk, regimes)
        at = ", ".join(on_axis(file, axes[side], begin / axes[side].unit) for side, (begin, _, _) in sides.items())
        where = f"at the worst of {places} places within the drift, {at}"
    before = draws_of(file).count
    drawn = compute(file, {paths[side]: ends for side, ends in sides.items()}, {"uncertainty.rigs": min(MOST, max(FEWEST, TIMES * before))},
                    folder / f"{file.path.stem}_draws", ranks, binary)
    with PeterkaFile(drawn) as found:
        told = quantity_at(found, risk).of(admitted_at(found, risk, regimes))
        value, share = float(np.min(told.value)), float(np.min(told.share)) if regimes else 1.0
        rigs = draws_of(found).count
    if not math.isfinite(value) and not regimes:
        raise NotVerified(f"the fresh draws of {file.path} have no value")
    return Fresh(rigs, max(0, rigs - before), where, value, share)


def text_of(found: Fresh, place: Place, risk: float, quantity: Quantity, regimes: Sequence[str] | None = None) -> str:
    """The result in words, beside what the map promised."""
    drawn = f"of {found.rigs:,} rigs, {found.new:,} of them new, {found.where},"
    if regimes and not math.isfinite(found.value):
        return (f"it isn't told by fresh draws: {drawn} {100 * found.share:.4g} % end in {','.join(regimes)}, and only where {100 * needed_share(risk):g} % do, "
                f"the file tells a value that {100 * risk:g} % reach in it")
    change = 100 * (found.value / place.worst - 1)
    beside = f"{change:+.2g} %" if abs(change) < 10 else f"{change:+.0f} %"
    judged = "it holds" if found.value >= place.worst * (1 - ROUNDING) else "it falls short"
    amount = units.amount(found.value, quantity.unit, 4)
    if regimes:
        return (f"{judged} in fresh draws ({beside} beside the map's): {drawn} {100 * found.share:.4g} % end in {','.join(regimes)}, and "
                f"{100 * risk:g} % or more reach {amount} in it")
    return (f"{judged} in fresh draws ({beside} beside the map's): {drawn} {100 * risk:g} % reach {amount}; of all at least "
            f"{100 * assured(risk, found.rigs):.3g} % there, in 19 cases of 20")


def _side(file: PeterkaFile, axis: Axis, at: int, drift: tuple[float, float]) -> tuple[float, float, int]:
    """(from, to, points) along an axis, in the numbers of the job: PLACES of them over a drift [Hz, mm], otherwise the place alone."""
    unit = unit_of(file, axis.name)
    width = 0.0 if unit is None else {"Hz": drift[0], "mm": drift[1]}[unit.unit] / unit.factor
    begin, end, _ = finer(axis, width, at)
    return begin, end, PLACES if width > 0 else 1


def _worst(file: PeterkaFile, sides: dict[str, tuple[float, float, int]], box: Path, risk: float,
           regimes: Sequence[str] | None) -> dict[str, tuple[float, float, int]]:
    """The worst place of a computed box, as sides of a single point."""
    with PeterkaFile(box) as found:
        told = quantity_at(found, risk).of(admitted_at(found, risk, regimes))
        if found.shape != (sides["rows"][2], sides["columns"][2]):
            raise NotVerified(f"the places within the drift of {file.path} were computed as {found.shape[0]} x {found.shape[1]} cells")
    # where the motions asked for are too rare to tell a value, the rarer the worse
    worst = np.unravel_index(np.argmin(np.where(np.isfinite(told.value), told.value, told.share - 2)), told.value.shape)
    indices = {"rows": int(worst[0]), "columns": int(worst[1])}
    alone = {}
    for side, (begin, end, points) in sides.items():
        value = float(np.linspace(begin, end, points)[indices[side]])
        alone[side] = (value, value, 1)
    return alone
