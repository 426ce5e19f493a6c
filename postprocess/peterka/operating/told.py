"""What a map implies for other starts, places and motions: what is proved, what is sampled (peterka/sampling.py), and how many
starts a question requires.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Mask
from ..files import job_numbers
from ..files.regimes import NAMES, NO_IMPACT, NOT_COMPUTED, PERIODIC
from ..maps.map_file import PeterkaFile
from ..sampling import draws_needed, least_share, share_excluded
from .drift import Reach
from .places import Place, box_of

USUAL = (0.05, 0.01)  # shares, for comparison
CLOSED_FORM = "a motion without impact"


@dataclass(frozen=True)
class LeftOut:
    """A motion in the box other than the place's own: `name`, the number of `cells` in which it is known, and its largest
    `share` of a cell's starts; 0 if no start found it."""

    name: str
    cells: int
    share: float


def has_job(file: PeterkaFile) -> bool:
    """Whether a file contains its job's text."""
    return isinstance(file.data.attribute("job"), str)


def starts_of(file: PeterkaFile) -> int:
    """The number of starts per cell."""
    count = job_numbers.number_of(_tables(file), "starts.count")
    if count is None or not 1 <= count < 1e15:
        raise file.refusal("holds a job that doesn't tell how many starts its cells have")
    return int(count)


def refuse_few_starts(file: PeterkaFile, share: float) -> None:
    """Refuses a question that the file's starts cannot answer."""
    starts = starts_of(file)
    if share >= 1:
        raise file.refusal("can't tell a share of 1, whatever its starts: ask for --starts any, or for a share below 1")
    needed = draws_needed(share)
    if starts < needed:
        raise file.refusal(f"has {starts} starts of each cell, which can't tell a share of {share:g}: even where all of them end in one "
                           f"motion, others may have {100 * share_excluded(starts):.2g} % (in one case of twenty); {needed} could "
                           f"tell it: --set starts.count={needed}")


def may_stay_free(file: PeterkaFile, rows: Reach, columns: Reach) -> Mask:
    """Whether the hammer can swing without impact anywhere within the drift around each cell, (rows, columns): in closed form,
    not at the cells alone."""
    tables = _tables(file)
    found = np.zeros(file.shape, dtype=bool)
    # the amplitude has a single peak along the frequency and the stop is farthest at the largest gap: the minimum over a box
    # of amplitude over gap is attained at a corner
    for up in (-1, 1):
        for right in (-1, 1):
            coordinates = {file.columns.name: (file.columns.values + right * columns.width)[None, :],
                           file.rows.name: (file.rows.values + up * rows.width)[:, None]}
            try:
                found |= np.broadcast_to(job_numbers.swing_of(tables, coordinates).stays_free(), file.shape)
            except job_numbers.UnreadableJob as error:
                raise file.refusal(str(error)) from error
    return found


def left_out(file: PeterkaFile, place: Place, rows: Reach, columns: Reach) -> list[LeftOut]:
    """Motions other than a place's own that are known in the cells of its box, those with the largest shares first."""
    box = box_of(place, rows, columns)
    regime, impacts, period, share = (file.data.values(name, (slice(None), box[0]))[:, :, box[1]] for name in
                                      ("attractor_regime", "attractor_impacts", "attractor_period", "basin_share"))
    names = np.where(regime == PERIODIC, np.char.add(np.char.add(impacts.astype(str), "/"), period.astype(str)),
                     np.array(NAMES)[np.clip(regime, 0, len(NAMES) - 1)])
    names[regime == NOT_COMPUTED] = ""
    own = place.z
    found = [LeftOut(str(name), int((names == name).any(axis=0).sum()), float(np.where(names == name, share, 0).sum(axis=0).max()))
             for name in np.unique(names) if name not in ("", own)]
    return sorted(found, key=lambda one: (-one.share, -one.cells, one.name))


def text_of_left_out(file: PeterkaFile, found: list[LeftOut], stays_free: bool) -> str:
    """Describes the other motions of the best place."""
    words = [f"{one.name} (in {one.cells} cells of the box, " +
             (f"up to {100 * one.share:.2g} % of a cell's starts)" if one.share > 0 else "found by no start)") for one in found]
    if stays_free and all(one.name != NAMES[NO_IMPACT] for one in found):
        words.append(f"{CLOSED_FORM} (between cells of the box, in {closed_form_of(file)})")
    return f"left out: {', '.join(words)}" if words else "nothing is left out: no other motion is known in the best box"


def text_of_sampling(starts: int, share: float | None) -> str:
    """What this many starts per cell imply for all starts, if all, or a share of them, end in one motion."""
    others = ", ".join(f"{draws_needed(1 - each)} exclude more than {100 * each:g} %" for each in USUAL
                       if each < share_excluded(starts))
    if share is None:
        return (f"by sampling: all {starts} starts of each cell of a box end in it, and no other motion is known there; a motion with less than "
                f"{100 * share_excluded(starts):.2g} % of the starts isn't excluded{f' ({others})' if others else ''}")
    return (f"by sampling: {starts} starts of each cell of a box; of all starts at least {100 * least_share(share, starts):.4g} % end in it, "
            "in 19 cases of 20 for each cell of the best box by itself")


def text_of_proof(file: PeterkaFile) -> str:
    """What holds for every start and everywhere within the drift."""
    where = "nowhere within the drift, nor between the cells there,"
    if has_cubic_spring(file):
        return (f"not proved: {where} could the hammer swing without impact if its springs were linear (closed form); with the cubic term of these "
                "a motion without impact isn't excluded that no start found")
    return f"by proof: {where} can the hammer swing without impact (closed form)"


def closed_form_of(file: PeterkaFile) -> str:
    """The words for that of a motion without impact."""
    return "closed form of linear springs, which these are not quite" if has_cubic_spring(file) else "closed form"


def has_cubic_spring(file: PeterkaFile) -> bool:
    """Whether some of a map's cells have one."""
    name = "hammer.cubic_stiffness_n_per_m3"
    return bool(job_numbers.number_of(_tables(file), name)) or name.replace(".", "_") in (file.rows.name, file.columns.name)


def _tables(file: PeterkaFile) -> dict[str, Any]:
    try:
        return job_numbers.tables_of(file.data.attribute("job"))
    except job_numbers.UnreadableJob as error:
        raise file.refusal(str(error)) from error

