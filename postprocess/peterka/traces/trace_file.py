"""A checked trace file.

    motion    over the time of the trace: MOTION, each (samples,)
    impacts   IMPACTS, each (impacts,); empty without impacts
    impact    close-up of the hardest one: MOTION and time_from_touch over its own times, with its peak
    spectrum, impact_spectrum   of the motion, and of the hardest impact with the flight after it
In the file displacements are in A0 and forces over the hammer's weight; `millimetres` and `newtons` are the factors to mm
and N. Files that cannot be drawn raise PeterkaFileError.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Reals
from ..files.checked_hdf5 import INTEGER, REAL
from ..files.opened import OpenedFile
from ..files.regimes import check_labels

MOTION = ("time", "cycle", "hammer_displacement_ratio", "cart_displacement_ratio", "relative_displacement_ratio",
          "hammer_velocity", "cart_velocity", "relative_velocity", "hammer_acceleration", "force_ratio")
IMPACTS = ("touch_time", "impact_speed", "touch_force_ratio", "peak_force_ratio", "impulse", "contact_time", "work")
SPECTRUM = ("frequency", "force_amplitude", "acceleration_amplitude")
IMPACT_SPECTRUM = ("frequency", "force_spectrum", "flight_acceleration_amplitude")
CELL = {"regime": INTEGER, "impacts": INTEGER, "period": INTEGER, "status": INTEGER, "observed_cycles": INTEGER,
        "multiplier": REAL, "lyapunov": REAL}
MAX_ROWS = 10_000_000


@dataclass(frozen=True)
class HardestImpact:
    """Close-up of one impact: its motion, its index among the impacts, and its peak (None on a rigid stop)."""

    motion: dict[str, Reals]
    number: int
    peak_time: float | None  # s since the trace began
    peak_force_ratio: float | None


class TraceFile(OpenedFile):
    """A checked, open trace: motion, impacts, impact, spectrum, impact_spectrum, and cell, the contents of a map's cell
    (None if the file lacks them)."""

    computed = 1  # traces are always written completely

    def check_content(self) -> None:
        """Sets the documented members; raises PeterkaFileError for invalid content."""
        self.motion = self._columns("", MOTION)
        if not np.all(np.diff(self.motion["time"]) > 0):
            raise self.refusal("has a time that does not ascend")
        self.impacts = self._columns("impacts/", IMPACTS) if self.data.has("impacts") else None
        self.impact = self._hardest() if self.data.has("impact") else None
        self.spectrum = self._columns("spectrum/", SPECTRUM)
        self.cell = self._cell() if self.data.has("cell") else None
        self.impact_spectrum = self._columns("impact_spectrum/", IMPACT_SPECTRUM) if self.data.has(
            "impact_spectrum") else None

    @property
    def millimetres(self) -> float | None:
        """A0 in mm; None if the file does not give it."""
        metres = self.positive("cart_amplitude_m")
        return 1000 * metres if metres else None

    @property
    def steady_peak(self) -> float | None:
        """Largest force of the steady motion, F/(m g); None if the file does not give it."""
        if not self.data.has("cell/peak_force_ratio"):
            return None
        self.data.dataset("cell/peak_force_ratio", (), REAL)
        value = float(self.data.values("cell/peak_force_ratio", ()))
        return value if np.isfinite(value) and value > 0 else None

    @property
    def excitation_hz(self) -> float | None:
        """Excitation frequency [Hz] of the cart; None for a cart at rest."""
        ratio, natural = self.positive("frequency_ratio"), self.positive("natural_frequency_hz")
        return ratio * natural if ratio and natural else None

    def _columns(self, group: str, names: tuple[str, ...]) -> dict[str, Reals]:
        shape = self.data.dataset(group + names[0], None, REAL).shape
        if len(shape) != 1 or not 1 <= shape[0] <= MAX_ROWS:
            raise self.refusal(f"has {group}{names[0]} of shape {shape}; 1 to {MAX_ROWS} can be drawn")
        return {name: self._numbers(group + name, shape) for name in names}

    def _numbers(self, name: str, shape: tuple[int, ...] | None) -> Reals:
        self.data.dataset(name, shape, REAL)
        values = np.asarray(self.data.values(name, ...), dtype=float)
        if not name.startswith("impacts/") and not np.isfinite(values).all():
            raise self.refusal(f"has a {name} that is not finite")
        return values

    def _cell(self) -> dict[str, Any]:
        """{name: value} of a map's cell: CELL, and `status` in words."""
        for name, kind in CELL.items():
            self.data.dataset(f"cell/{name}", (), kind)
        cell = {name: self.data.values(f"cell/{name}", ()).item() for name in CELL}
        check_labels(self.data, {name: np.array([cell[name]]) for name in ("regime", "impacts", "period")})
        return cell | {"status": self.data.words("cell/status").get(cell["status"], "").replace("_", " ")}

    def _hardest(self) -> HardestImpact:
        self.data.dataset("impact/impact", (), INTEGER)
        number = int(self.data.values("impact/impact", ()))
        if self.impacts is None or not 0 <= number < len(self.impacts["touch_time"]):
            raise self.refusal("shows an impact closely that its list does not have")
        peak = [float(self._numbers(f"impact/{name}", ())) if self.data.has(f"impact/{name}") else None
                for name in ("peak_time", "peak_force_ratio")]
        return HardestImpact(self._columns("impact/", MOTION + ("time_from_touch",)), number, *peak)
