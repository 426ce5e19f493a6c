"""Dependence on the start: between the bands at larger gaps (section 4.2, Fig. 22), and in the paper's two basins (Fig. 24).
"""

from collections.abc import Callable, Sequence

import numpy as np

from ..arrays import Mask, Reals
from ..errors import PeterkaFileError
from .folder import Folder, Plane, require_alike
from .record import HIGH_GAP, SOME, Claim, claim, near, not_computed, off_by, percent
from .sensitivity import contact_damping_with_both, outcomes
from .spans import around_bands

PLACE = "section 4.2, Fig. 24"
SAYS = {
    "starts_region": "Above gap/A0 of about 1.5 there is an area between z = 1/1 and z = 1/2 where the regime depends on the "
                     "start.",
    "fig_24a": "150 mm, Ω/ω = 1.80, gap/A0 = 1.74: some starts end in impacts, others in no impact.",
    "fig_24b": "135 mm, Ω/ω = 2.15, gap/A0 = 1.60: some starts end in impacts, others in no impact.",
}
MANY = 300  # forcing cycles: a run of this length is commonly considered long enough


def claims(folder: Folder) -> list[Claim]:
    """The claims of this group."""
    return [_region(folder), _first_basin(folder), _second_basin(folder)]


def depends_on_start(planes: Sequence[Plane]) -> Mask:
    """Cells whose settled label (orbit, no impact, lasting contact) differs between starts, (rows, columns)."""
    require_alike(planes)
    settled = np.array([plane.is_settled for plane in planes])
    codes = np.array([plane.label_code for plane in planes])
    lowest = np.where(settled, codes, np.iinfo(np.int64).max).min(axis=0)
    highest = np.where(settled, codes, -1).max(axis=0)
    mask: Mask = (settled.sum(axis=0) > 1) & (lowest != highest)
    return mask


def _region(folder: Folder) -> Claim:
    place, says = "section 4.2, Fig. 22", SAYS["starts_region"]
    planes = folder.planes("starts/start_")
    if len(planes) < 2:
        return not_computed("starts_region", place, says, "starts/start_*.h5")
    depends, gaps, (_, between, _) = depends_on_start(planes), planes[0].rows, around_bands(planes[0])
    shares = (depends & between).sum(axis=1) / np.maximum(between.sum(axis=1), 1)
    first = first_of_the_rest(shares, SOME)
    if first is None:
        return claim("starts_region", place, says, f"at the highest gap {percent(shares[-1])} of the cells between the bands "
                     "depend on the start", False)
    elsewhere = np.sum((depends & ~between)[first:]) / np.sum(depends[first:])
    return claim(
        "starts_region", place, says,
        f"{len(planes)} starts in each cell: from gap/A0 = {gaps[first]:.3g} up {percent(shares[first:].min())} to "
        f"{percent(shares[first:].max())} of the cells between the bands of the start at rest depend on the start, below "
        f"{percent(shares[:first].max(initial=0))} at most ({_other_limits(shares, gaps)}). From this gap up "
        f"{percent(elsewhere)} of all cells that depend on the start lie elsewhere, which the paper leaves open",
        near(gaps[first], HIGH_GAP), f"from {off_by(gaps[first], HIGH_GAP, 'A0')}", "", ["starts_170mm"])


def first_of_the_rest(shares: Reals | Sequence[float], limit: float) -> int | None:
    """The first row from which all shares reach a limit; None if the last row does not."""
    few = np.flatnonzero(np.asarray(shares) < limit)
    first = int(few[-1]) + 1 if len(few) else 0
    return first if first < len(shares) else None


def _other_limits(shares: Reals, gaps: Reals) -> str:
    """The gap at which the region would begin for half or twice the required share of cells."""
    rows = {limit: first_of_the_rest(shares, limit) for limit in (SOME / 2, 2 * SOME)}
    return ", ".join(f"{percent(limit)} or more from " + ("no gap" if row is None else f"{gaps[row]:.3g} A0") + " up"
                     for limit, row in rows.items())


def _first_basin(folder: Folder) -> Claim:
    plane = folder.plane("basin_150mm")
    if plane is None:
        return not_computed("fig_24a", f"{PLACE}a", SAYS["fig_24a"], "basin_150mm.h5")
    planes = folder.planes("nearby_150mm/gap_")
    both = nearest(planes, plane.gap_ratio, lambda other: other.has_both)
    lasting = nearest(planes, plane.gap_ratio, lambda other: bool(other.strikes.any()))
    why = []
    if lasting:
        why.append(f"the last gap towards the paper's point where any of the starts tried ends in impacts is gap/A0 = "
                   f"{lasting.gap_ratio:.4g}, where {outcomes(lasting)}")
    why += [words for words in [contact_damping_with_both(folder, "sensitivity/150mm_")] if words]
    return claim("fig_24a", f"{PLACE}a", SAYS["fig_24a"], outcomes(plane) + _nearest_with_both(both, planes), plane.has_both,
                 f"{off_by(both.gap_ratio, plane.gap_ratio, 'A0')} for the nearest such gap" if both else "", "; ".join(why),
                 ["basin_150mm_basin_impact", "basin_150mm_coexisting_basin_impact"])


def _second_basin(folder: Folder) -> Claim:
    plane = folder.plane("basin_135mm")
    if plane is None:
        return not_computed("fig_24b", f"{PLACE}b", SAYS["fig_24b"], "basin_135mm.h5")
    if plane.last_impact is None:
        raise PeterkaFileError(f"{plane.path} holds no last_impact")
    lives = plane.last_impact[plane.quiet & (plane.last_impact > 0)]
    late = plane.share(plane.strikes | (plane.last_impact > MANY))
    planes = folder.planes("nearby_135mm/gap_")
    both = nearest(planes, plane.gap_ratio, lambda other: other.has_both)
    text = outcomes(plane)
    if len(lives):
        text += f"; impacts end after {lives.mean():.4g} cycles on average, {lives.max()} at most"
    text += f"; after {MANY} cycles {percent(late)} still impact, {percent(1 - late)} don't" + _nearest_with_both(both, planes)
    return claim("fig_24b", f"{PLACE}b", SAYS["fig_24b"], text, plane.has_both,
                 f"{percent(plane.share(plane.strikes))} of the starts end in lasting impacts; {percent(SOME)} of each "
                 "kind count as some",
                 "impacts are a chaotic transient here, which a run of some hundred cycles takes for an attractor: what "
                 f"is seen then is the picture after {MANY} cycles", [f"basin_135mm_impact_after_{MANY}",
                                                                     "basin_135mm_last_impact"])


def nearest(planes: Sequence[Plane], gap_ratio: float, suits: Callable[[Plane], bool]) -> Plane | None:
    """The suitable basin with the nearest gap; None without one."""
    suitable = [plane for plane in planes if suits(plane)]
    return min(suitable, key=lambda plane: abs(plane.gap_ratio - gap_ratio)) if suitable else None


def _nearest_with_both(both: Plane | None, planes: Sequence[Plane]) -> str:
    if both:
        return (f"; the nearest gap with at least {percent(SOME)} of each is gap/A0 = {both.gap_ratio:.4g}, where "
                f"{outcomes(both)}")
    gaps = [plane.gap_ratio for plane in planes]
    return f"; no gap that was tried, gap/A0 = {min(gaps):g} to {max(gaps):g}, has {percent(SOME)} of each" if gaps else ""
