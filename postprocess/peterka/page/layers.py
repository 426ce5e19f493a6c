"""Cells of a file, or points of a sweep's branches, as planes for a page: their labels, and one layer per dataset.

A map of up to EXACT_CELLS cells has every dataset on its cells, exactly. For a larger map only labels and peak force are
included unless others are requested, and real numbers are shortened to fit into `room` bytes.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from ..arrays import Integers, Reals
from ..errors import PeterkaFileError
from ..files.checked_hdf5 import INTEGER, REAL
from ..files.coordinates import SPOKEN
from ..files.opened import OpenedFile
from ..plotting import classes
from ..maps import elasticity_map, signed_map
from ..maps.map_file import PeterkaFile

from . import planes

EXACT_CELLS = 2**20
MOST_CELLS = 2**24  # limit of a page; --every takes a part of a larger map
MOST_LABELS = 65536
LABELS = ("regime", "impacts", "period")
TITLES = {"peak_force_ratio": "peak force", "impact_rate": "impacts per cycle", "cycles": "cycles spent",
          "contact_power_w": "contact power", "mean_life_s": "mean life", "mean_life_error_s": "mean life error",
          "mean_life_least_s": "least mean life",
          "force_q05_ratio": "force that 95 % of drawn rigs reach", "force_q50_ratio": "median force of drawn rigs",
          "force_q95_ratio": "force that 5 % of drawn rigs exceed", "speed_q05": "impact speed that 95 % of drawn rigs reach",
          "speed_q50": "median impact speed of drawn rigs", "speed_q95": "impact speed that 5 % of drawn rigs exceed",
          "outcome_others": "probability of rarer outcomes",
          "outcomes": "number of outcomes"}
NEVER = {"last_impact": "impacts go on"}  # what -1 says
OF_RUNS, NONE = ("status", "engine"), -128  # a filled cell had no run
TOP_SHARE = 99.9  # of the values: single cells beyond don't stretch the scale


def labels(file: PeterkaFile, every: int) -> tuple[dict[str, Any], bytes]:
    """As numbered_labels, for each cell."""
    bands = list(_bands(file, LABELS, every))
    return numbered_labels(file, {name: np.concatenate([band[name] for band in bands]) for name in LABELS})


def numbered_labels(file: OpenedFile, cells: dict[str, NDArray[Any]]) -> tuple[dict[str, Any], bytes]:
    """({"table": [[regime, p, q, class], ...], "shown": [displayed class of each class], ...}, bytes): each cell's label as
    an index into the table. `cells`: {dataset: (rows, columns)} of LABELS."""
    key = _key(cells)
    found, index, counts = np.unique(key, return_inverse=True, return_counts=True)
    if len(found) > MOST_LABELS:
        raise file.refusal(f"has {len(found)} different z; a page holds {MOST_LABELS}")
    regime, impacts, period = (found >> 48) - 128, (found >> 24) & 0xFFFFFF, found & 0xFFFFFF
    number = classes.classify(regime, impacts, period)
    shown = classes.named(np.bincount(number, weights=counts, minlength=len(classes.CLASSES)))
    table = np.column_stack([regime, impacts, period, shown[number]])
    description, packed = planes.integers(index.reshape(key.shape))
    return {"table": table.tolist(), "shown": shown.tolist(), "plane": description}, packed


def datasets(file: PeterkaFile, asked: Sequence[str] | None) -> list[str]:
    """Names of the datasets that become layers: always peak force, which scripts rely on."""
    if asked is None:
        asked = file.data.names() if file.shape[0] * file.shape[1] <= EXACT_CELLS else []
    always = ["peak_force_ratio", *(["computed"] if file.is_refined else [])]
    return [*always, *(name for name in asked if name not in (*LABELS, *always))]


def layers_of(file: PeterkaFile, name: str, every: int, room: int) -> list[tuple[dict[str, Any], bytes]] | None:
    """[({description}, bytes), ...] of a dataset: one, or one per slot for [slot][row][column]. None if it is not a number per cell."""
    shape = shape_of(file, name)
    if shape == file.shape:
        values = file.data.values(name, slice(None))[::every, ::every]
        if name not in OF_RUNS or not file.is_refined:
            return [layer(file, name, name, values, room)]
        computed = file.data.values("computed", slice(None))[::every, ::every] == 1
        description, packed = layer(file, name, name, np.where(computed, values, NONE).astype(values.dtype), room)
        if "words" in description:
            description["words"][str(NONE)] = "filled from the cells around"
        return [(description, packed)]
    if shape is not None and len(shape) == 3 and shape[1:] == file.shape and 0 < shape[0] <= 16:
        slots = range(shape[0])
        return [layer(file, name, f"{name}[{slot}]", file.data.values(name, slot)[::every, ::every], room)
                for slot in slots]
    return None


def scale(name: str) -> list[str]:
    """A colour scale of the pictures, from low to high."""
    return [to_hex(colour) for colour in colormaps[name](np.linspace(0, 1, 256))]


def layer(file: OpenedFile, dataset: str, name: str, values: NDArray[Any], room: int = 0) -> tuple[dict[str, Any], bytes]:
    """({description}, bytes) of values of a dataset, (rows, columns), under a name: exact, or shortened to fit into `room` bytes."""
    description: dict[str, Any] = {
        "name": name,
        "title": _title(dataset, name[len(dataset):]),
        "about": str(file.data.attribute("long_name", dataset) or ""),
        "unit": str(file.data.attribute("units", dataset) or "1"),
        "over_weight": "force" in dataset and dataset.endswith("_ratio"),
    }
    if dataset in NEVER:
        description["never"] = NEVER[dataset]
    if values.dtype.kind in INTEGER:
        description |= _words(file, dataset)
        plane, packed = planes.integers(values)
    elif values.size <= EXACT_CELLS or np.nanmin(values, initial=0) < 0:
        plane, packed = planes.reals(values)
    else:
        plane, packed = _shortened(values, room)
    if dataset in elasticity_map.DATASETS:  # as in their pictures
        top = signed_map.top_of(values)
        return description | {"title": elasticity_map.words(dataset), "about": "", "unit": "% per %", "diverging": True, "plane": plane,
                              "low": -top, "top": top}, packed
    return description | {"plane": plane} | _span(values[values >= 0] if dataset in NEVER else values), packed


def shape_of(file: OpenedFile, name: str) -> tuple[int, ...] | None:
    """The shape; None if it is not a dataset of numbers."""
    try:
        shape: tuple[int, ...] = file.data.dataset(name, None, INTEGER + REAL).shape
    except PeterkaFileError:
        return None
    return shape


def _title(dataset: str, slot: str = "") -> str:
    """In words, and without the unit, which is told beside it. `slot`: "[0]" of the first of several, or ""."""
    if dataset == "outcome_probability":  # its slots are in order
        return "probability of the commonest outcome" if slot == "[0]" else f"probability of outcome {int(slot[1:-1]) + 1}"
    axis = next((axis for axis in SPOKEN if dataset.endswith(f"_{axis}")), None)
    name = dataset if axis is None else dataset.removesuffix(axis) + SPOKEN[axis][0]
    return TITLES.get(dataset, name.replace("_", " ")) + slot.replace("[", " ").replace("]", "")


def _shortened(values: Reals, room: int) -> tuple[dict[str, Any], bytes]:
    for bits in planes.SHORT_BITS:
        plane, packed = planes.short_reals(values, bits)
        if len(packed) <= room:
            break
    return plane, packed


def _words(file: OpenedFile, dataset: str) -> dict[str, Any]:
    try:
        return {"words": {str(number): word for number, word in file.data.words(dataset).items()}}
    except PeterkaFileError:
        return {}


def _span(values: NDArray[Any]) -> dict[str, float]:
    finite = values[np.isfinite(values)] if values.dtype.kind in REAL else values[values > -128]
    if not finite.size:
        return {"low": 0.0, "top": 1.0}
    top, largest = float(np.percentile(finite, TOP_SHARE)), float(finite.max())
    top = top if 0 < top and largest > 1.15 * top else largest
    return {"low": min(0.0, float(finite.min())), "top": top if top > 0 else 1.0}


def _key(band: Mapping[str, Integers]) -> Integers:
    regime, impacts, period = (band[name].astype(np.int64) for name in LABELS)
    return ((regime + 128) << 48) | (np.clip(impacts, 0, 0xFFFFFF) << 24) | np.clip(period, 0, 0xFFFFFF)


def _bands(file: PeterkaFile, names: Iterable[str], every: int) -> Iterator[dict[str, NDArray[Any]]]:
    """Checked bands of rows, keeping every `every`-th row and column."""
    for _, band in file.bands(list(names), every):
        yield {name: values[::every, ::every] for name, values in band.items()}
