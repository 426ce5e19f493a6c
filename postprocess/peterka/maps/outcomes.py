"""What a map or sweep with [uncertainty] tells: for each cell the motions in which its drawn rigs end, by probability, and quantiles
of their forces.

On [outcome][rows][columns]: outcome_regime int8 (-128: empty slot), outcome_impacts and outcome_period int32, outcome_probability f64.
On [rows][columns], of all draws, where no impact and failed rigs count as 0: force_q05_ratio, force_q50_ratio, force_q95_ratio f64 [F/(m g)], or, of a
stop without a force, speed_q05, speed_q50, speed_q95 [m/s]; outcome_others, the probability of the motions that are not kept.
"""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Integers, Mask, Reals
from ..files.checked_hdf5 import INTEGER, REAL, Content
from ..files.harmless import harmless
from ..files.job_numbers import UnreadableJob, number_of, tables_of
from ..files.opened import OpenedFile
from ..files.regimes import CHAOTIC, PERIODIC
from ..plotting import units
from ..plotting.coordinates import label, without_symbol

OUTCOMES = {"outcome_regime": INTEGER, "outcome_impacts": INTEGER, "outcome_period": INTEGER, "outcome_probability": REAL}
QUANTILES = (5, 50, 95)  # %
QUANTITIES = {"force": "force_q{:02}_ratio", "speed": "speed_q{:02}"}
MOST = 64  # slots
LEAST_PLAIN = 1e-3  # of numbers with a unit: smaller ones take a prefix
LONGEST = 400  # letters of what is uncertain
UNITS = {"gap_m": (1e3, "mm"), "cart_amplitude_m": (1e3, "mm")}  # told in other units than those of the job


@dataclass(frozen=True)
class Draws:
    """How many rigs were drawn for each cell, and `what` of them was uncertain, in words."""

    count: int
    what: str

    @property
    def in_words(self) -> str:
        """For a caption."""
        deviations = " (±: standard deviation)" if "±" in self.what else ""
        return f"{self.count:,} rigs drawn: {self.what}{deviations}" if self.what else f"{self.count:,} rigs drawn"


def check_outcomes(data: Content, shape: tuple[int, ...], most_numbers: int) -> int:
    """The number of outcomes kept for each of the cells of this shape; 0 in a file without them."""
    if not data.has("outcome_probability"):
        return 0
    slots = data.dataset("outcome_probability", None, REAL).shape[:1]
    if not slots or not 1 <= slots[0] <= MOST or slots[0] * np.prod(shape, dtype=float) > most_numbers:
        raise data.refusal(f"keeps {slots[0] if slots else 'no'} outcomes for each cell; 1 to {MOST} can be drawn")
    for name, kind in OUTCOMES.items():
        data.dataset(name, slots + shape, kind)
    for name in quantiles(data).values():
        data.dataset(name, shape, REAL)
    return int(slots[0])


def quantiles(data: Content) -> dict[int, str]:
    """{per cent: dataset} of the quantiles over the draws, of forces or else of impact speeds; {} without them."""
    for name in QUANTITIES.values():
        found = {share: name.format(share) for share in QUANTILES}
        if all(data.has(each) for each in found.values()):
            return found
    return {}


def draws_of(file: OpenedFile) -> Draws:
    """The Draws of a file with outcomes. Raises PeterkaFileError if its job doesn't tell how many they are."""
    try:
        tables = tables_of(file.data.attribute("job"))
    except UnreadableJob as error:
        raise file.refusal(str(error)) from error
    count = number_of(tables, "uncertainty.rigs")
    if count is None or not 1 <= count < 1e9:
        raise file.refusal("holds a job that doesn't tell how many rigs were drawn for its cells")
    return Draws(int(count), harmless(", ".join(_uncertain(tables["uncertainty"])), LONGEST))


def is_class(wanted: str, regime: Integers, impacts: Integers, period: Integers) -> Mask:
    """Which of these motions are `wanted`: "impacts", of any kind, "no impact", "chaotic", or p/q."""
    if wanted == "impacts":
        mask: Mask = (regime == PERIODIC) & (impacts > 0) | (regime == CHAOTIC)
    elif "/" not in wanted:
        mask = regime == {"no impact": 0, "chaotic": CHAOTIC}[wanted]
    else:
        p, q = map(int, wanted.split("/"))
        mask = (regime == PERIODIC) & (impacts == p) & (period == q)
    return mask


def probability(wanted: str, regime: Integers, impacts: Integers, period: Integers, probability: Reals) -> Reals:
    """Probability of what is `wanted` in each cell, from (slots, rows, columns); of outcomes that aren't kept none counts."""
    values: Reals = np.where(is_class(wanted, regime, impacts, period), np.nan_to_num(probability), 0.0).sum(axis=0)
    return values


def read_wanted(text: str) -> str:
    """A motion whose probability is asked for: p/q, "impacts" of any kind, "no impact", "chaotic". Raises ValueError where it is none."""
    if text in ("impacts", "no impact", "chaotic") or re.fullmatch(r"[1-9]\d{0,8}/[1-9]\d{0,8}", text):
        return text
    raise ValueError(f"{harmless(text, 40)!r} is no motion such as '3/2', 'impacts', 'no impact' or 'chaotic'")


def _uncertain(tables: dict[str, Any]) -> Iterator[str]:
    covariance = tables.get("covariance")
    if isinstance(covariance, dict):
        of, matrix = covariance.get("of", []), covariance.get("matrix", [])
        for n, key in enumerate(of):
            try:
                yield _spread(str(key), {"standard_deviation": math.sqrt(matrix[n][n])})
            except (IndexError, TypeError, ValueError):
                continue
        if len(of) > 1:
            yield "together as identified"
    for table, keys in tables.items():
        for key, spread in keys.items() if isinstance(keys, dict) and table != "covariance" else ():
            if isinstance(spread, dict):
                yield _spread(f"{table}.{key}", {name: value for name, value in spread.items() if isinstance(value, (int, float))})


def _spread(path: str, spread: Mapping[str, float]) -> str:
    """Of one number: "stop stiffness ±3 %", a standard deviation, or from where to where it lies."""
    table, _, key = path.rpartition(".")
    name = key if table in ("", "operating_point") else f"{table}_{key}"
    words, _, unit = without_symbol(label(name)).partition(" (")
    factor, unit = UNITS.get(name, (1.0, unit.rstrip(")")))
    if table == "operating_point":
        words = "offset of " + {"gap_m": "gap", "frequency_hz": "frequency"}.get(key, key)
    if "relative" in spread:
        return f"{words} ±{100 * spread['relative']:.3g} %"
    if "standard_deviation" in spread:
        deviation = spread["standard_deviation"]
        text = f"{factor * deviation:.3g} {unit}".rstrip()
        if unit and ("e" in text or 0 < factor * deviation < LEAST_PLAIN):
            text = units.amount(deviation, "m" if name in UNITS else unit, 3)
        return f"{words} ±{text}"
    return f"{words} {factor * spread.get('from', np.nan):.4g} to {factor * spread.get('to', np.nan):.4g} {unit}".rstrip()
