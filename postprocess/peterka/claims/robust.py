"""Gap 0 against larger gaps: what makes it robust, and whether the others jump (sections 3.1, 4.2, 5; Figs. 9, 14, 23)."""

from collections.abc import Sequence

from .folder import Folder, Plane
from .gap_zero import at_edge, limits_hz, resonance
from .record import ALL, SHARE, Claim, claim, not_computed, percent
from .spans import widest

PLACE = "section 5; section 4.2"
SAYS = {
    "gap_0_robust": "Gap 0 is robust: a force as at other gaps, no jump, and z = 1/1 from nearly all starts, from no fewer "
                    "than at 3 mm.",
    "higher_gaps_jump": "At higher gaps the force jumps, which demands a careful tuning of the frequency.",
}
FILES = ("gaps_170mm", "basin_170mm_gap_0", "basin_170mm_gap_3")


def claims(folder: Folder) -> list[Claim]:
    """The claims of this group."""
    found = {name: folder.plane(name) for name in FILES}
    planes = [plane for plane in found.values() if plane is not None]
    if len(planes) < len(FILES):
        missing = next(name for name, plane in found.items() if plane is None)
        return [not_computed(key, PLACE, says, f"{missing}.h5") for key, says in SAYS.items()]
    gaps, *basins = planes
    without = [_millimetres(gaps, row) for row in range(len(gaps.rows)) if resonance(gaps, 1, 1, row) is None]
    if without:
        return [claim(key, PLACE, says, f"no z = 1/1 at a gap of {', '.join(without)}", False) for key, says in SAYS.items()]
    drops = [drop_after(gaps, row) for row in range(len(gaps.rows))]
    return [_robust(gaps, basins, drops), _higher(gaps, drops)]


def drop_after(plane: Plane, row: int) -> float:
    """Share of the force lost from the last column of the widest band z = 1/1 to the next column."""
    band = widest(plane.is_orbit(1, 1)[row])
    assert band is not None
    last = band[1]
    if last + 1 >= len(plane.columns):
        return 0.0
    return float(max(0.0, 1 - plane.force_n[row, last + 1] / plane.force_n[row, last]))


def _robust(gaps: Plane, basins: Sequence[Plane], drops: Sequence[float]) -> Claim:
    forces = [found[1] for row in range(len(gaps.rows)) if (found := resonance(gaps, 1, 1, row))]  # each gap has one
    reached = [basin.share(basin.is_orbit(1, 1)) for basin in basins]
    listed = ", ".join(f"{force:.4g} N at {_millimetres(gaps, row)}" for row, force in enumerate(forces))
    return claim(
        "gap_0_robust", PLACE, SAYS["gap_0_robust"],
        f"largest forces of z = 1/1: {listed}; {percent(drops[0])} of it is lost at the upper end of the band at gap 0; z = "
        f"1/1 is reached from {percent(reached[0])} of the starts at gap 0 and Ω/ω = {basins[0].frequency_ratio:g}, from "
        f"{percent(reached[1])} at 3 mm and Ω/ω = {basins[1].frequency_ratio:g}",
        forces[0] >= (1 - SHARE) * max(forces) and drops[0] <= SHARE and reached[0] >= max(ALL, reached[1]),
        f"the force at gap 0 is {100 * (1 - forces[0] / max(forces)):.1f} % less than the largest at any gap", "",
        ["basin_170mm_gap_0_basin", "basin_170mm_gap_3_basin"])


def _higher(gaps: Plane, drops: Sequence[float]) -> Claim:
    """Judges only the loss at a band's end; a narrow band also requires tuning."""
    bands = [band for row in range(len(gaps.rows)) if (band := limits_hz(gaps, 1, 1, row=row))]  # each gap has one
    widths = [f"{'at least ' if any(at_edge(gaps, band)) else ''}{band[1] - band[0]:.2f} Hz" for band in bands]
    listed = "; ".join(f"{_millimetres(gaps, row)}: {percent(drop)}, band {width} wide"
                       for row, (drop, width) in enumerate(zip(drops, widths)))
    smooth = [_millimetres(gaps, row) for row in range(1, len(drops)) if drops[row] <= SHARE]
    return claim("higher_gaps_jump", PLACE, SAYS["higher_gaps_jump"],
                 f"share of the force that is lost at the upper end of z = 1/1, by gap: {listed}", not smooth,
                 f"no jump at {', '.join(smooth)}" if smooth else "",
                 "at small gaps the band ends by a period doubling, as at gap 0, and not by a fold")


def _millimetres(gaps: Plane, row: int) -> str:
    return f"{gaps.rows[row] * gaps.amplitude_mm:.2g} mm"
