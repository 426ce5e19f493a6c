"""What depends on the start: between the bands at higher gaps (section 4.2, Fig. 22), and the paper's two basins (Fig. 24).
"""

import numpy as np

from .record import ALL, SHARE, claim, not_computed, off_by, percent
from .sensitivity import contact_damping_that_carries

PLACE = "section 4.2, Fig. 24"
FROM_GAP = 1.5  # as printed
NOTABLE = 0.10  # of the cells of a gap
SAYS = {
    "starts_region": "Above gap/A0 of about 1.5, between z = 1/1 and z = 1/2, the regime depends on the start.",
    "fig_24a": "150 mm, Ω/ω = 1.80, gap/A0 = 1.74: some starts end in impacts, others in no impact.",
    "fig_24b": "135 mm, Ω/ω = 2.15, gap/A0 = 1.60: some starts end in impacts, others in no impact.",
}
MANY = 300  # forcing cycles: a run that many would call long enough


def claims(folder):
    return [_region(folder), _first_basin(folder), _second_basin(folder)]


def depends_on_start(planes):
    """Cells whose proved label (orbit, no impact, lasting contact) isn't the same from all starts, (rows, columns)."""
    lowest, highest, count = None, None, None
    for plane in planes:
        proved = plane.is_settled
        code = np.where(proved, plane.label_code, -1)
        if lowest is None:
            lowest, highest, count = np.where(proved, code, np.iinfo(np.int64).max), code, proved.astype(int)
            continue
        lowest = np.minimum(lowest, np.where(proved, code, np.iinfo(np.int64).max))
        highest, count = np.maximum(highest, code), count + proved
    return (count > 1) & (lowest != highest)


def _region(folder):
    planes = folder.planes("starts/start_")
    if len(planes) < 2:
        return not_computed("starts_region", "section 4.2, Fig. 22", SAYS["starts_region"], "starts/start_*.h5")
    depends, gaps, ratios = depends_on_start(planes), planes[0].rows, planes[0].columns
    shares = depends.mean(axis=1)
    few = np.flatnonzero(shares < NOTABLE)
    first = int(few[-1]) + 1 if len(few) else 0
    if first == len(gaps):
        return claim("starts_region", "section 4.2, Fig. 22", SAYS["starts_region"],
                     f"at the highest gap {percent(shares[-1])} of the cells depend on the start", False)
    where = ratios[np.argwhere(depends[first:])[:, 1]]
    low, high = np.quantile(where, [0.05, 0.95])
    return claim(
        "starts_region", "section 4.2, Fig. 22", SAYS["starts_region"],
        f"{len(planes)} starts in each cell: from gap/A0 = {gaps[first]:.3g} up {percent(shares[first:].min())} to "
        f"{percent(shares[first:].max())} of the cells depend on the start, below {percent(shares[:first].max(initial=0))} "
        f"at most; 90 % of them lie at Ω/ω = {low:.2f} to {high:.2f}",
        abs(gaps[first] / FROM_GAP - 1) <= SHARE, f"from {off_by(gaps[first], FROM_GAP, 'A0')}", "", ["starts_170mm"])


def _first_basin(folder):
    plane = folder.plane("basin_150mm")
    if plane is None:
        return not_computed("fig_24a", f"{PLACE}a", SAYS["fig_24a"], "basin_150mm.h5")
    striking = plane.share(plane.strikes)
    near, beyond = both_nearest(folder, "nearby_150mm/gap_", plane.gap_ratio)
    text = f"{percent(1 - striking)} of the starts end in no impact"
    if near:
        text += (f"; the nearest gap with both is gap/A0 = {near.gap_ratio:.4g}, where {percent(near.share(near.strikes))} "
                 "of the starts end in impacts")
    why = ""
    if near and beyond:
        why = (f"lasting impacts end between gap/A0 = {near.gap_ratio:.4g} and {beyond.gap_ratio:.4g}, a little below the "
               "paper's point")
        damping = contact_damping_that_carries(folder, "sensitivity/150mm_")
        why += f"; {damping}" if damping else ""
    return claim("fig_24a", f"{PLACE}a", SAYS["fig_24a"], text, 0 < striking < 1,
                 f"{off_by(near.gap_ratio, plane.gap_ratio, 'A0')} for the nearest such gap" if near else "", why,
                 ["basin_150mm_basin_impact", "basin_150mm_coexisting_basin_impact"])


def _second_basin(folder):
    plane = folder.plane("basin_135mm")
    if plane is None or plane.last_impact is None:
        return not_computed("fig_24b", f"{PLACE}b", SAYS["fig_24b"], "basin_135mm.h5")
    striking = plane.share(plane.strikes)
    lives = plane.last_impact[plane.quiet & (plane.last_impact > 0)]
    late = plane.share(plane.strikes | (plane.last_impact > MANY))
    near, _ = both_nearest(folder, "nearby_135mm/gap_", plane.gap_ratio)
    text = f"{percent(plane.share(plane.quiet))} of the starts end in no impact"
    if len(lives):
        text += f", after {lives.mean():.4g} cycles with impacts on average, {lives.max()} at most"
    text += f"; after {MANY} cycles {percent(late)} still impact"
    if near:
        text += f"; the nearest gap with lasting impacts beside no impact is gap/A0 = {near.gap_ratio:.4g}"
    return claim("fig_24b", f"{PLACE}b", SAYS["fig_24b"], text, 0 < striking < ALL,
                 f"{percent(striking)} of the starts end in lasting impacts",
                 "impacts are a chaotic transient here, which a run of some hundred cycles takes for an attractor: what "
                 f"is seen then is the picture after {MANY} cycles", [f"basin_135mm_impact_after_{MANY}",
                                                                     "basin_135mm_last_impact"])


def both_nearest(folder, prefix, gap_ratio):
    """(the basin with both outcomes whose gap is nearest, the one next to it towards gap_ratio) among those of the prefix;
    (None, None) without any."""
    planes = folder.planes(prefix)
    both = [plane for plane in planes if 0 < plane.share(plane.strikes) < 1]
    if not both:
        return None, None
    near = min(both, key=lambda plane: abs(plane.gap_ratio - gap_ratio))
    low, high = sorted([near.gap_ratio, gap_ratio])
    between = [plane for plane in planes if low < plane.gap_ratio < high]
    return near, min(between, key=lambda plane: abs(plane.gap_ratio - near.gap_ratio), default=None)
