"""What a place of a map with [uncertainty] is worth by fresh draws: the best of many places owes part of its value to the draws by
which it was chosen.

The program draws many more rigs, each at a place of its own within the drift, evenly in Hz and mm, for the one place: so drift, starts
and rigs vary together. A coordinate that the job has uncertain itself keeps that: there the rigs are drawn at each of several places from end
to end of the drift, and the worst of these counts. The draws of a low-discrepancy sequence begin with those of the map; all others are new.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.job_numbers import tables_of
from ..maps.map_file import Axis, PeterkaFile
from ..maps.outcomes import draws_of
from ..plotting import units
from .admitted import Quantity
from .drift import unit_of
from .places import Place
from .risk import admitted_at, assured, needed_share, quantity_at
from .verify import ROUNDING, NotVerified, axis_paths, compute, finer

TIMES, FEWEST, MOST = 16, 1024, 10_000  # draws, times those of the map; at least and at most
PLACES = 5  # from end to end of a drift
SI = {"Hz": ("frequency_hz", 1.0), "mm": ("gap_m", 1e-3)}  # of a drift: key of the job, and its unit


@dataclass(frozen=True)
class Fresh:
    """`rigs` drawn, `new` of them; the `value` reached with the probability asked for [in the unit of the Quantity], NaN where the motions
    asked for are too rare to tell one in them; what of the place drifted, in words, or is uncertain in the job already; and the least
    probability of these motions, 1 for any."""

    rigs: int
    new: int
    value: float
    drifts: str
    share: float = 1.0


def draw_afresh(file: PeterkaFile, place: Place, drift: tuple[float, float], risk: float, folder: Path, ranks: int = 1,
                binary: Path | None = None, regimes: Sequence[str] | None = None) -> Fresh:
    """The Fresh of a Place with a drift [Hz, mm], in any motion or in `regimes`; its job and file are written to `folder`."""
    before = draws_of(file).count
    rigs = min(MOST, max(FEWEST, TIMES * before))
    paths = axis_paths(file, file.data.attribute("job"))
    offsets, drifts, widths = _offsets(file, drift)
    sizes = {paths[name]: _along(axis, widths.get(axis.name, 0.0), at) for name, axis, at in
             (("columns", file.columns, place.column), ("rows", file.rows, place.row))}
    box = compute(file, sizes, {"uncertainty.rigs": rigs, **offsets}, folder / f"{file.path.stem}_draws", ranks, binary)
    with PeterkaFile(box) as found:
        drawn = quantity_at(found, risk).of(admitted_at(found, risk, regimes))
        value, share = float(np.min(drawn.value)), float(np.min(drawn.share)) if regimes else 1.0
        rigs = draws_of(found).count
    if not math.isfinite(value) and not regimes:
        raise NotVerified(f"the fresh draws of {file.path} have no value")
    return Fresh(rigs, max(0, rigs - before), value, drifts, share)


def text_of(found: Fresh, place: Place, risk: float, quantity: Quantity, regimes: Sequence[str] | None = None) -> str:
    """The result in words, beside what the map promised."""
    drawn = f"of {found.rigs:,} rigs, {found.new:,} of them new, {found.drifts}"
    if regimes and not math.isfinite(found.value):
        return (f"it isn't told by fresh draws: {drawn}, {100 * found.share:.4g} % end in {','.join(regimes)}, and only where {100 * needed_share(risk):g} % do, "
                f"the file tells a value that {100 * risk:g} % reach in it")
    change = 100 * (found.value / place.worst - 1)
    judged = "it holds" if found.value >= place.worst * (1 - ROUNDING) else f"it falls short by {-change:.3g} %"
    if regimes:
        return (f"{judged} in fresh draws: {drawn}, {100 * found.share:.4g} % end in {','.join(regimes)}, and {100 * risk:g} % or more reach "
                f"{units.amount(found.value, quantity.unit, 4)} in it ({change:+.2g} % beside the map's)")
    return (f"{judged} in fresh draws: {drawn}, {100 * risk:g} % reach "
            f"{units.amount(found.value, quantity.unit, 4)} ({change:+.2g} % beside the map's); of all at least "
            f"{100 * assured(risk, found.rigs):.3g} %, in 19 cases of 20")


def _uncertain_of_place(file: PeterkaFile) -> set[str]:
    """Which of "frequency" and "gap" the job has uncertain, by itself or with other numbers."""
    uncertain = tables_of(file.data.attribute("job"))["uncertainty"]
    keys = [*uncertain.get("operating_point", {}), *(str(key).removeprefix("operating_point.") for key in uncertain.get("covariance", {}).get("of", []))]
    return {key.partition("_")[0] for key in keys}


def _offsets(file: PeterkaFile, drift: Sequence[float]) -> tuple[dict[str, float], str, dict[str, float]]:
    """{key of the job: end of an offset} of a drift along the axes in Hz and mm, its words, and {axis: half-width in its own numbers} of
    those that are uncertain in the job."""
    own = _uncertain_of_place(file)
    changes: dict[str, float] = {}
    words: list[str] = []
    widths: dict[str, float] = {}
    for axis in (file.columns, file.rows):
        unit = unit_of(file, axis.name)
        if unit is None:
            continue
        width = dict(zip(SI, drift))[unit.unit]
        key, factor = SI[unit.unit]
        if key.partition("_")[0] in own:
            widths[axis.name] = width / unit.factor
            words.append(f"{unit.what} as uncertain as the job has it" + (
                f", around the worst of {PLACES} places within ±{width:g} {unit.unit}" if width > 0 else ""))
        elif width > 0:
            changes |= {f"uncertainty.operating_point.{key}.from": -width * factor, f"uncertainty.operating_point.{key}.to": width * factor}
            words.append(f"{unit.what} within ±{width:g} {unit.unit}")
    return changes, f"at places of their own ({', '.join(words)})" if words else "at this place", widths


def _along(axis: Axis, width: float, at: int) -> tuple[float, float, int]:
    """(from, to, points) along an axis, in the numbers of the job: PLACES of them over a width, otherwise the place alone."""
    if not width > 0:
        return finer(axis, 0.0, at)
    return (axis.values[at] - width) * axis.unit, (axis.values[at] + width) * axis.unit, PLACES
