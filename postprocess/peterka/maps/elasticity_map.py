"""How the peak force of each orbit, or on a rigid stop its impact speed, depends on the numbers of the rig and of its place.

An elasticity is the relative change of the result per relative change of one number, in % per %. One picture for each number that
the file has, and one of the number that matters most in each cell: by the elasticity's size or, where [uncertainty] tells how well
each number is known, by its product with the number's relative standard deviation, the share of the result's to first order. A number
has the same colour in every picture. A block of a reduced map shows what is farthest from 0, or the commonest number.
"""

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ..arrays import Integers, Reals
from ..files.regimes import NOT_COMPUTED, PERIODIC
from ..plotting import axes, style
from ..plotting.coordinates import label
from ..plotting.fills import Fill, grey
from ..plotting.picture import picture
from . import signed_map
from .field_map import without_value
from .map_file import PeterkaFile
from .reduce import Reduced, class_picture
from .rig_numbers import deviation_of
from .signed_map import SignedField

WIDTH = 3.7  # in
PLAIN = 70  # lightness in the grey palette of the number that has no hatching
OTHERS = [("no elasticity", "#CFCFCF", ""), ("not computed yet", "#FFFFFF", "")]
# Of each number, after which the dataset is named: its colour, and its hatching in the grey palette.
NUMBERS = {
    "frequency_hz": ("#0072B2", ""),
    "gap_m": ("#E69F00", "//"),
    "hammer_mass_kg": ("#1A1A1A", "\\\\"),
    "hammer_natural_frequency_hz": ("#56B4E9", "xx"),
    "hammer_stiffness_n_per_m": ("#4F7A46", ".."),
    "hammer_damping_ns_per_m": ("#CC79A7", "--"),
    "hammer_damping_ratio": ("#8F5F86", "||"),
    "hammer_cubic_stiffness_n_per_m3": ("#5A12B8", "++"),
    "cart_amplitude_m": ("#F0E442", "oo"),
    "contact_stiffness_n_per_m": ("#D55E00", "OO"),
    "contact_damping_ns_per_m": ("#009E73", "**"),
    "contact_coefficient": ("#762024", "xx.."),
}
RESULTS = {"force": "peak force", "speed": "impact speed"}
DATASETS = frozenset(f"{result}_elasticity_{number}" for result in RESULTS for number in NUMBERS)


def datasets(file: PeterkaFile) -> dict[str, str]:
    """{number: its dataset} of the elasticities that a file has, in the order of NUMBERS."""
    return {number: f"{result}_elasticity_{number}" for number in NUMBERS for result in RESULTS
            if f"{result}_elasticity_{number}" in file.elasticities}


@picture(PeterkaFile)
def draw(file: PeterkaFile, ax: Axes | None = None, *, number: str) -> Axes | None:
    """The picture of the elasticity by one of NUMBERS, as Axes; None if no cell has one."""
    name = datasets(file)[number]
    field = SignedField([name], lambda band, _: band[name], words(name), "% per %", OTHERS[0][:2])
    return signed_map.draw(file, field, ax)


@picture(PeterkaFile)
def draw_most(file: PeterkaFile, ax: Axes | None = None) -> Axes | None:
    """The number that matters most in each cell; None where the file has no two to compare, or no cell has one."""
    of = datasets(file)
    known = {number: deviation for number in of if (deviation := deviation_of(file, number)) is not None}
    weights: dict[str, Any] = known if len(known) > 1 else dict.fromkeys(of, 1.0)
    if len(weights) < 2:
        return None
    numbers = list(weights)
    reduced, counts = _most(file, [of[number] for number in numbers], list(weights.values()))
    if not counts[:len(numbers)].any():
        return None
    looks = [_look_of(number) for number in numbers] + _looks()
    words = [spoken(number) for number in numbers] + [text for text, *_ in OTHERS]
    if any(not np.all(np.isfinite(weight)) for weight in weights.values()):
        words[len(numbers)] += ", or an uncertain number is 0"
    order = sorted(range(len(numbers)), key=lambda n: -int(counts[n])) + [len(numbers), len(numbers) + 1]
    having = counts[:len(numbers)].sum()
    handles = [axes.legend_patch(words[n] + (f" ({axes.percent(counts[n] / having)})" if n < len(numbers) else ""), looks[n],
                                 n == len(numbers) + 1) for n in order if counts[n]]
    figure, ax, _ = axes.stack(WIDTH, reduced.image, [(handles, 2, None)], ax=ax)
    axes.show_classes(ax, reduced, looks, len(numbers) + 1)
    axes.label_axes(ax, file)
    axes.notice_incomplete(ax, file)
    result = _result(of[numbers[0]])
    told = (f"what spreads the {result} most to first order: elasticity times relative standard deviation" if len(known) > 1
            else f"on what the {result} depends most, per relative change")
    axes.write_title(figure, file, "\n".join(filter(None, [axes.operating_point(file), told])), ax)
    return ax


def has(file: PeterkaFile, number: str) -> bool:
    """Whether a file has the elasticity by one of NUMBERS."""
    return number in datasets(file)


def has_two(file: PeterkaFile) -> bool:
    """Whether a file has elasticities to compare."""
    return len(datasets(file)) > 1


def words(dataset: str) -> str:
    """An elasticity in words: "peak force by stop stiffness"."""
    return f"{_result(dataset)} by {spoken(dataset.partition('_elasticity_')[2])}"


def spoken(number: str) -> str:
    """One of NUMBERS in words: "stop stiffness"."""
    return "gap" if number == "gap_m" else re.sub(r" ?\$[^$]*\$", "", label(number)).partition(" (")[0]


def _result(name: str) -> str:
    return RESULTS[name.partition("_")[0]]


def _look_of(number: str) -> str | Fill:
    """The look of cells in which a number matters most; in grey, one without a hatching has a lightness of its own."""
    colour, hatch = NUMBERS[number]
    return Fill(grey(PLAIN)) if style.is_grey() and not hatch else without_value(colour, hatch)


def _looks() -> list[str | Fill]:
    return [without_value(colour, hatch) for _, colour, hatch in OTHERS]


def _most(file: PeterkaFile, names: Sequence[str], weights: Sequence[float | Reals]) -> tuple[Reduced, NDArray[np.int64]]:
    """The place in `names` of what is largest, times its weight; len(names) where nothing is, one more where nothing is computed."""
    row = 0

    def classify(regime: Integers, *values: Reals) -> Integers:
        nonlocal row
        rows = slice(row, row + regime.shape[0])
        row += regime.shape[0]
        with np.errstate(invalid="ignore"):  # 0 times infinity: what deviates from 0 has no relative deviation
            sizes = np.stack([np.abs(value) * _part(weight, rows) for value, weight in zip(values, weights)])
        has_all = (regime == PERIODIC) & np.all(np.isfinite(sizes), axis=0)
        return np.where(has_all, np.argmax(np.nan_to_num(sizes), axis=0), len(names) + (regime == NOT_COMPUTED))

    return class_picture(file, ["regime", *names], classify, len(names) + 2)


def _part(weight: float | Reals, rows: slice) -> float | Reals:
    """Of a weight for each row, that of these rows."""
    return weight[rows] if isinstance(weight, np.ndarray) and weight.shape[0] > 1 else weight


