"""Gap 0 against other gaps: what makes it robust (sections 3.1, 4.2, 5; Figs. 9, 14, 23)."""

from .gap_zero import limits_hz, resonance
from .record import ALL, SHARE, claim, not_computed, percent
from .spans import widest

PLACE = "section 5; section 4.2"
SAYS = "Gap 0 is robust: force as at other gaps, a wide band, no jump; other gaps want a careful tuning of the frequency."
FILES = ("gaps_170mm", "basin_170mm_gap_0", "basin_170mm_gap_3")


def claims(folder):
    planes = [folder.plane(name) for name in FILES]
    if None in planes:
        return [not_computed("gap_0_robust", PLACE, SAYS, f"{FILES[planes.index(None)]}.h5")]
    gaps, basin_0, basin_3 = planes
    rows = range(len(gaps.rows))
    bands = [limits_hz(gaps, 1, 1, row=row) for row in rows]
    forces = [resonance(gaps, 1, 1, row)[1] for row in rows]
    widths = [high - low for low, high in bands]
    drops = [drop_after(gaps, row) for row in rows]
    reached = [basin.share(basin.is_orbit(1, 1)) for basin in (basin_0, basin_3)]
    millimetres = [f"{gap * gaps.amplitude_mm:.2g} mm" for gap in gaps.rows]
    listed = "; ".join(f"gap {gap}: {force:.4g} N, band {width:.2f} Hz wide, {percent(drop)} of the force is lost at its upper end" for gap, force, width, drop in
                       zip(millimetres, forces, widths, drops))
    holds = (forces[0] >= (1 - SHARE) * max(forces) and widths[0] == max(widths) and drops[0] <= 0.05
             and reached[0] >= ALL)
    return [claim("gap_0_robust", PLACE, SAYS,
                  f"{listed}. z = 1/1 is reached from {percent(reached[0])} of the starts at gap 0 and Ω/ω = "
                  f"{basin_0.frequency_ratio:g}, from {percent(reached[1])} at 3 mm and Ω/ω = {basin_3.frequency_ratio:g}",
                  holds, f"the band at gap 0 is {widths[0] / max(widths[1:]):.2f} times as wide as the next widest", "",
                  ["basin_170mm_gap_0_basin", "basin_170mm_gap_3_basin"])]


def drop_after(plane, row):
    """Share of its force that is lost from the last column of the widest band z = 1/1 to the next one."""
    last = widest(plane.is_orbit(1, 1)[row])[1]
    if last + 1 >= len(plane.columns):
        return 0.0
    return float(max(0.0, 1 - plane.force_n[row, last + 1] / plane.force_n[row, last]))
