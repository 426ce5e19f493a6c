"""A checked study file. Its `table` is that of its topic:

    work_precision   error and time of integration methods, runs x cells
    labels           share of changed labels of a small map, one number per run
    stability        outcome of extreme scenes, scenes x engines, and the limit of a rigid stop

Names are stored as flag_meanings; here they are arrays of words, "" where nothing is computed. Measured times are in the
group `run`. The file calls runs trials, because its group `run` holds the measurements.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Reals
from ..files.checked_hdf5 import INTEGER, REAL, Content, shown
from ..files.opened import OpenedFile

MAX_SIDE = 4096  # runs, cells, scenes, engines or rungs
MAX_NUMBERS = 2**20

Words = NDArray[np.object_]


@dataclass(frozen=True)
class WorkPrecision:
    """Shapes (runs,), (cells,) and (runs, cells)."""

    frequency_ratio: Reals
    gap_ratio: Reals
    method: Words
    setting: Reals  # tolerance; steps per cycle for a fixed step; 0 if none
    outcome: Words  # done, failed, other_orbit
    error_peak_force: Reals  # relative
    seconds_per_cycle: Reals


@dataclass(frozen=True)
class Labels:
    """Shape (runs,)."""

    cells: int
    method: Words
    setting: Reals
    changed_share: Reals
    unproved_share: Reals
    seconds_per_cell: Reals


@dataclass(frozen=True)
class Stability:
    """Shapes (scenes,), (engines,), (scenes, engines) and, of the limit of a rigid stop, (rungs,)."""

    scene: Words
    engine: Words
    outcome: Words  # agrees, says_why_not, wrong, not_for_this_scene
    regime: Words
    status: Words
    energy_imbalance: Reals
    contact_stiffness: Reals
    speed_difference: Reals


class StudyFile(OpenedFile):
    """A checked, open study: topic and table."""

    topic: str
    table: Any  # WorkPrecision, Labels or Stability, by the topic

    @cached_property
    def computed(self) -> float:
        """The computed share of the results, 0 to 1."""
        table = self.table
        return float(np.mean(np.isfinite(table.changed_share) if self.topic == "labels" else table.outcome != ""))

    def check_content(self) -> None:
        """Sets the documented members; raises PeterkaFileError for invalid content."""
        topic = self.data.attribute("topic")
        if not isinstance(topic, str) or topic not in _READERS:
            raise self.refusal(f"is a study of {shown(topic)}; this program draws {', '.join(_READERS)}")
        self.topic = topic
        self.table = _READERS[self.topic](_Columns(self.data))


class _Columns:
    """Reads whole datasets of known shape."""

    def __init__(self, data: Content) -> None:
        self._data = data

    def count(self, name: str) -> int:
        shape = self._data.dataset(name, None, INTEGER + REAL).shape
        if len(shape) != 1 or not 1 <= shape[0] <= MAX_SIDE:
            raise self._data.refusal(f"has {name} of shape {shape}; 1 to {MAX_SIDE} can be drawn")
        return int(shape[0])

    def numbers(self, name: str, *shape: int) -> Reals:
        self._data.dataset(name, shape, REAL)
        if np.prod(shape) > MAX_NUMBERS:
            raise self._data.refusal(f"has {name} of shape {shape}, too large to draw")
        return np.asarray(self._data.values(name, ...), dtype=float)

    def words(self, name: str, *shape: int) -> Words:
        self._data.dataset(name, shape, INTEGER)
        if np.prod(shape) > MAX_NUMBERS:
            raise self._data.refusal(f"has {name} of shape {shape}, too large to draw")
        words, values = self._data.words(name), self._data.values(name, ...)
        return np.array([words.get(int(value), "") for value in values.ravel()], dtype=object).reshape(shape)

    def whole_number(self, name: str) -> int:
        self._data.dataset(name, (), INTEGER)
        return int(self._data.values(name, ()))

    def has(self, name: str) -> bool:
        return self._data.has(name)


def _work_precision(file: _Columns) -> WorkPrecision:
    runs, cells = file.count("method"), file.count("frequency_ratio")
    return WorkPrecision(
        frequency_ratio=file.numbers("frequency_ratio", cells),
        gap_ratio=file.numbers("gap_ratio", cells),
        method=file.words("method", runs),
        setting=file.numbers("setting", runs),
        outcome=file.words("outcome", runs, cells),
        error_peak_force=file.numbers("error_peak_force", runs, cells),
        seconds_per_cycle=file.numbers("run/seconds_per_cycle", runs, cells),
    )


def _labels(file: _Columns) -> Labels:
    runs = file.count("method")
    return Labels(
        cells=file.whole_number("cells"),
        method=file.words("method", runs),
        setting=file.numbers("setting", runs),
        changed_share=file.numbers("changed_share", runs),
        unproved_share=file.numbers("unproved_share", runs),
        seconds_per_cell=file.numbers("run/seconds_per_cell", runs),
    )


def _stability(file: _Columns) -> Stability:
    scenes, engines = file.count("scene"), file.count("engine")
    rungs = file.count("rung") if file.has("rung") else 0
    return Stability(
        scene=file.words("scene", scenes),
        engine=file.words("engine", engines),
        outcome=file.words("outcome", scenes, engines),
        regime=file.words("regime", scenes, engines),
        status=file.words("status", scenes, engines),
        energy_imbalance=file.numbers("energy_imbalance", scenes, engines),
        contact_stiffness=file.numbers("contact_stiffness", rungs) if rungs else np.array([]),
        speed_difference=file.numbers("speed_difference", rungs) if rungs else np.array([]),
    )


_READERS = {"work_precision": _work_precision, "labels": _labels, "stability": _stability}
