"""Effect of a frequency drift on the force, from every start: at gap 0 and at larger gaps (section 5; section 4.2).

Compares the largest worst-case force of any place with drift to the largest one at the same gap without drift: the worst
case over the box of drift and over all starts of the map, whatever the regime, as in operating_point.py.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Reals
from ..maps.map_file import PeterkaFile
from ..operating.admitted import ANY, JOB, admitted
from ..operating.drift import reach, worst_of_boxes
from .folder import Folder
from .force_map import RIGS
from .record import DRIFT, SHARE, Claim, claim, not_computed, percent

PLACE = "section 5; section 4.2"
SAYS = {
    "drift_gap_0": f"Gap 0 is robust: with a frequency that drifts by ±{DRIFT:g} Hz a place of it keeps most of the "
                   "force, from every start tried.",
    "drift_higher_gaps": f"Higher gaps demand a careful tuning: at 1, 2 and 3 mm a drift of ±{DRIFT:g} Hz costs more than that.",
}


@dataclass(frozen=True)
class Kept:
    """For each gap of a map, (rows,): the gap in mm, and the largest worst-case force of any place in N, `still` (without
    drift) and `drifting`; 0 if no place has one."""

    gaps: Reals
    still: Reals
    drifting: Reals

    @property
    def kept(self) -> Reals:
        """The share of the force that remains under drift."""
        return np.divide(self.drifting, self.still, out=np.zeros(len(self.gaps)), where=self.still > 0)


def claims(folder: Folder) -> list[Claim]:
    """The claims of this group."""
    paths = {rig: folder.path / f"drift_{rig}.h5" for rig in RIGS}
    missing = [path.name for path in paths.values() if not path.exists()]
    if missing:
        return [not_computed(key, PLACE, says, missing[0]) for key, says in SAYS.items()]
    found = {rig: kept_of(path, DRIFT, ANY) for rig, path in paths.items()}
    from_rest = {rig: kept_of(path, DRIFT, JOB) for rig, path in paths.items()}
    least = {rig: _in_words(each, 0) for rig, each in found.items()}
    lost = [1 - each.kept[0] for each in found.values()]
    lost_higher = [1 - each.kept[1:].max() for each in found.values()]
    return [
        claim("drift_gap_0", PLACE, SAYS["drift_gap_0"], _listed(least), max(lost) <= SHARE,
              f"{percent(max(lost))} of the force is lost at most"),
        claim("drift_higher_gaps", PLACE, SAYS["drift_higher_gaps"], _listed(_higher(found)), min(lost_higher) > SHARE,
              f"{percent(min(lost_higher))} of the force is lost at least",
              "no force is one from every start where a motion without impact exists, so that the places of the largest forces don't "
              "count. From rest alone, where they do: " + _listed(_higher(from_rest))),
    ]


def kept_of(path: Path, hertz: float, starts: str) -> Kept:
    """The Kept of a map with [starts], over ANY of them or for the JOB's own start alone."""
    with PeterkaFile(path) as file:
        if not file.is_complete:
            raise file.refusal("is not complete; finish it with the command that began it")
        found = admitted(file, starts, "peak_force")
        metres = file.positive("cart_amplitude_m")
        if not file.newtons or not metres:
            raise file.refusal("doesn't say what its hammer weighs and how far its cart moves")
        largest = []
        for drift in (0.0, hertz):
            values = worst_of_boxes(found, reach(file, file.rows, 0.0, 0.0), reach(file, file.columns, drift, 0.0))
            largest.append(np.nan_to_num(values, nan=0.0).max(axis=1) * file.newtons)
        return Kept(1000 * metres * file.rows.values, *largest)


def _higher(found: Mapping[str, Kept]) -> dict[str, str]:
    """For each rig, a description of the gaps above the first."""
    return {rig: "; ".join(_in_words(each, row) for row in range(1, len(each.gaps))) for rig, each in found.items()}


def _in_words(found: Kept, row: int) -> str:
    text = f"{found.gaps[row]:.2g} mm {found.still[row]:.4g} N"
    return text + (f", {percent(round(found.kept[row], 3))} of it with the drift" if found.drifting[row] else ", none with the drift")


def _listed(words: Mapping[str, str]) -> str:
    return ". ".join(f"{rig}: {text}" for rig, text in words.items())
