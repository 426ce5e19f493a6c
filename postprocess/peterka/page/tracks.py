"""Page content of a sweep: *tracks* of points along its axis. Each branch is one; in a sweep with [starts], each attractor
slot of a gap is another, since its attractors may be on no branch.

Every point with a motion also stores its state at forcing phase 0, from which the page's engine finds the same motion.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Integers, Reals
from ..files.checked_hdf5 import INTEGER, REAL
from ..sweeps.sweep_file import Branch, SweepFile
from ..sweeps.sweep_panels import direction_words

from . import layers, planes

PLACE = ("stroboscopic_displacement", "stroboscopic_velocity")
SAMPLED = (*PLACE, "impact_displacement", "impact_velocity")
MOST_SAMPLES = 2**22  # of one layer; larger layers are omitted
FORCE = "peak_force_ratio"
OTHERWISE_SHOWN = (*layers.LABELS, FORCE, "jump", "start_attractor")

Keep = Callable[[bytes], int]


@dataclass(frozen=True)
class Track:
    """A branch, or with its gap the `slot` of an attractor."""

    branch: Branch
    slot: int | None = None


def tracks_of(file: SweepFile) -> list[Track]:
    """Branches first, in their order, then the slots of each gap in turn."""
    branches = [Track(branch) for branch in file.branches]
    return branches + [Track(file.at_gap(gap)[0], slot) for gap in file.gaps for slot in range(file.slots)]


def described(file: SweepFile) -> dict[str, Any]:
    """For each track its gap, in `gaps`, and its direction in words, or its slot."""
    directions = {branch.direction: plain_words(direction_words(file, branch.direction)) for branch in file.branches}
    return {
        "gaps": file.gaps,
        "branches": len(file.branches),
        "tracks": [{"gap": file.gaps.index(track.branch.gap_ratio), "slot": track.slot,
                    "direction": track.branch.direction, "words": directions[track.branch.direction]}
                   for track in tracks_of(file)],
    }


def plain_words(words: str) -> str:
    """Words of pictures without mathematics, of which x and its rate are kept."""
    return re.sub(r" ?\$[^$]*\$", "", words.replace("$x", "x$").replace(r"$\dot{x}", "ẋ$"))


def labels(file: SweepFile) -> tuple[dict[str, Any], bytes]:
    """As layers.numbered_labels, for each point of each track."""
    cells = [_labels_of(file, track) for track in tracks_of(file)]
    return layers.numbered_labels(file, {name: np.stack([one[name] for one in cells]) for name in layers.LABELS})


def starts(file: SweepFile, keep: Keep) -> dict[str, Any]:
    """State of each point's motion at forcing phase 0: u in A0, its rate in A0 omega; NaN without a motion."""
    return {name: _packed(np.stack([_start(file, track, name) for track in tracks_of(file)]), keep) for name in PLACE}


def jumps(file: SweepFile, keep: Keep) -> dict[str, Any]:
    """For each point of each branch, 1 if the force jumps on the way to it."""
    description, packed = planes.integers(np.stack([branch.jump for branch in file.branches]).astype(np.int8))
    return {"plane": description, "blob": keep(packed)}


def datasets(file: SweepFile, asked: Sequence[str] | None) -> list[tuple[dict[str, Any], bytes]]:
    """[({description}, bytes), ...]: the peak force of all tracks, first unless no point has one, as on a rigid stop; then the other
    datasets on its points, or those requested. `first`: the track of a layer's first row; `samples`: numbers per point."""
    forces = np.stack([_forces(file, track) for track in tracks_of(file)])
    found = [_layer(file, FORCE, forces)]
    for name in asked if asked is not None else [*SAMPLED, *file.data.names()]:
        one = _dataset(file, name) if name not in OTHERWISE_SHOWN else None
        if one is None and asked is not None and name != FORCE:
            raise file.refusal(f"has no number of each point named {name}")
        if one is not None and all(one[0]["name"] != other["name"] for other, _ in found):
            found.append(one)
    return found if np.any(forces > 0) else [*found[1:], found[0]]


def _dataset(file: SweepFile, name: str) -> tuple[dict[str, Any], bytes] | None:
    """None if it is not a number per point, or has words as values, which no axis can show."""
    shape = (len(file.branches), len(file.values))
    found = layers.shape_of(file, name)
    if found is None or file.data.attribute("flag_meanings", name) is not None:
        return None
    if name == "basin_share":
        shares = file.data.values(name, slice(None))
        return _layer(file, name, np.stack([shares[track.slot, track.branch.row] for track in tracks_of(file)
                                            if track.slot is not None]), first=shape[0])
    if name in SAMPLED and found[:2] == shape and found[0] * found[1] * found[2] <= MOST_SAMPLES:
        samples = np.stack([_samples(file, track, name) for track in tracks_of(file)])
        used = max(1, int(np.isfinite(samples).sum(axis=2).max()))
        return _layer(file, name, samples[:, :, :used].reshape(len(samples), -1), samples=used)
    return _layer(file, name, file.data.values(name, slice(None))) if found == shape else None


def _layer(file: SweepFile, name: str, values: NDArray[Any], first: int = 0, samples: int = 1) -> tuple[dict[str, Any], bytes]:
    description, packed = layers.layer(file, name, name, values)
    return description | {"first": first, "rows": len(values), "samples": samples}, packed


def _labels_of(file: SweepFile, track: Track) -> dict[str, Integers]:
    if track.slot is None:
        return {name: getattr(track.branch, name) for name in layers.LABELS}
    return {name: file.attractors(track.branch)[f"attractor_{name}"][track.slot] for name in layers.LABELS}


def _forces(file: SweepFile, track: Track) -> Reals:
    values: Reals = track.branch.force if track.slot is None else file.attractor_forces(track.branch)[track.slot]
    return values


def _start(file: SweepFile, track: Track, name: str) -> Reals:
    """The first sample; for an attractor stored without samples, the orbit if it has one."""
    first = _samples(file, track, name)[:, 0]
    orbit = name.replace("stroboscopic", "attractor_orbit")
    if track.slot is None or not file.data.has(orbit):
        return first
    file.data.dataset(orbit, (file.slots, len(file.branches), len(file.values)), REAL)
    return np.where(np.isfinite(first), first, file.data.values(orbit, (track.slot, track.branch.row)))


def _samples(file: SweepFile, track: Track, name: str) -> Reals:
    """(points, samples) of the motion at each point of a track, NaN-padded at the end."""
    row, shape = track.branch.row, (len(file.branches), len(file.values), *file.data.dataset("sample", None, INTEGER).shape)
    file.data.dataset(name, shape, REAL)
    if track.slot is None:
        return np.asarray(file.data.values(name, row), dtype=float)
    kind = name.partition("_")[0]
    file.data.dataset(f"attractor_{name}", shape, REAL)
    file.data.dataset(f"{kind}_attractor", shape, INTEGER)
    own = file.data.values(f"{kind}_attractor", row) == track.slot
    values = np.where(own, file.data.values(f"attractor_{name}", row), np.nan)
    return np.take_along_axis(values, np.argsort(~own, axis=1, kind="stable"), axis=1)


def _packed(values: Reals, keep: Callable[[bytes], int]) -> dict[str, Any]:
    description, packed = planes.reals(values)
    return {"plane": description, "blob": keep(packed)}
