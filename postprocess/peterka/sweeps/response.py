"""Frequency response of a sweep: peak force against the excitation frequency, a panel per gap (the paper's Figs. 9 to 11 and
14 to 16), with jumps and the largest force of z = 1/1, which is the impact resonance if it is an interior maximum.

Periodic motions are lines; the largest forces of other motions, over the observation window, are single marks.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..arrays import Mask
from ..plotting import style, units
from ..plotting.coordinates import either
from ..plotting.limits import WEIGHTS, requested
from ..plotting.picture import picture
from ..maps.curves_file import UnstableBranch
from ..measurements.points import NOTHING_MEASURED, Measurements
from . import every_attractor, sweep_panels
from .borders import NO_BORDERS, Border, at_gap, draw_borders
from .borders import handles as border_handles
from .sweep_file import Branch, SweepFile
from .sweep_panels import LOOKS, direction_words
from .unstable import NO_UNSTABLE, draw_unstable
from .unstable import at_gap as unstable_at_gap
from .unstable import handles as unstable_handles

MOST_LABELLED = 3  # jumps of a branch
CLOSE = 0.004  # of the panel's width: marks of both branches closer than this are merged
RESONANCE = {"marker": "*", "markersize": 9, "markeredgecolor": "black", "markeredgewidth": 0.7, "linestyle": "none"}
CUT_OFF = RESONANCE | {"marker": "s", "markersize": 5}

Note = tuple[float, float, str, str]  # x, y, text, colour


@picture(SweepFile)
def draw(file: SweepFile, ax: Axes | None = None, *, measured: Measurements = NOTHING_MEASURED,
         borders: Sequence[Border] = NO_BORDERS, unstable: Sequence[UnstableBranch] = NO_UNSTABLE) -> list[Axes] | None:
    """The response as a list of Axes, one per gap; None if no point has a force."""
    if not _largest(file) > 0:
        return None
    second = _second_scale(file)
    forces = np.concatenate([branch.force for branch in file.branches])
    limits = requested(file, forces, ("N", file.newtons) if file.newtons else None, WEIGHTS)
    handles = [*_handles(file, limits), *every_attractor.handles(file), *border_handles(borders), *unstable_handles(unstable),
               *sweep_panels.measured_handles(measured, "force")]
    panels = sweep_panels.panels(file, handles, r"peak force $F/(m\,g)$", second, ax, log=style.scale_option("log"))
    for gap, ax in panels.items():
        points = measured.at_gap(gap)
        x, forces = every_attractor.forces(file, gap)
        top = max([forces.max(initial=0.0), *(_largest_of(branch) for branch in file.at_gap(gap))]
                  + [point.force + point.errors.get("force", 0.0) for point in points if point.force is not None])
        bottom, top = _limits(file, gap, 1.05 * top if top > 0 else 1, limits)
        every_attractor.draw(ax, x, forces)
        for branch in file.at_gap(gap):
            _draw_branch(ax, file, branch, bottom, top)
        notes = [*_jump_notes(ax, file, gap), *_mark_strongest(ax, file, gap, bottom, top)]
        sweep_panels.head_notes(ax, [note for note in notes if bottom <= note[1] <= top], top, bottom, keeps=limits is not None)
        draw_borders(ax, at_gap(borders, gap))
        draw_unstable(ax, unstable_at_gap(unstable, gap), "force")
        sweep_panels.draw_measured(ax, measured, gap, "force", limits)
    return list(panels.values())


def _largest(file: SweepFile) -> float:
    """The largest force of all branches and attractors."""
    return float(max(*(_largest_of(branch) for branch in file.branches),
                     *(every_attractor.forces(file, gap)[1].max(initial=0.0) for gap in file.gaps)))


def _largest_of(branch: Branch) -> float:
    value: float = branch.force.max(initial=0.0, where=np.isfinite(branch.force))
    return value


def _second_scale(file: SweepFile) -> tuple[str, float] | None:
    if not file.newtons:
        return None
    factor, unit = units.with_prefix(_largest(file) * file.newtons, "N")
    return f"peak force ({unit})", file.newtons * factor


def _limits(file: SweepFile, gap: float | None, top: float, limits: tuple[float, float] | None) -> tuple[float, float]:
    """(bottom, top) of the forces shown, F/(m g); `limits`: those requested."""
    forces = np.concatenate([branch.force[branch.force > 0] for branch in file.at_gap(gap)])
    bottom = 0.9 * float(forces.min(initial=top / 10)) if style.scale_option("log") else 0.0
    if limits:
        low, top = limits
        bottom = low if low > 0 or bottom == 0 else bottom
    return bottom, top


def _handles(file: SweepFile, limits: tuple[float, float] | None) -> list[Artist]:
    """Legend entries of what is drawn within these limits, if requested."""
    low, high = limits or (-np.inf, np.inf)
    handles = sweep_panels.direction_handles(
        file, lambda branch: np.where((low <= branch.force) & (branch.force <= high), branch.force, np.nan))
    strongest = [(branch, branch.strongest_single()) for branch in file.branches]
    found = {branch.is_resonance(at) for branch, at in strongest if at is not None and low <= branch.force[at] <= high}
    if True in found:
        handles.append(Line2D([], [], label="impact resonance ($z = 1/1$)", color="white", **RESONANCE))
    if False in found:
        handles.append(Line2D([], [], label="largest of $z = 1/1$, cut off", color="white", **CUT_OFF))
    if any(branch.jumps() for branch in file.branches):
        handles.append(Line2D([], [], label="jump", color="black", linewidth=0.7, linestyle=":", marker=">", markersize=3.5))
    return handles


def _draw_branch(ax: Axes, file: SweepFile, branch: Branch, bottom: float, top: float) -> None:
    look, x = LOOKS[branch.direction], file.values
    sweep_panels.draw_branch(ax, file, branch, branch.force)
    for before, after in branch.jumps():
        middle = (x[before] + x[after]) / 2
        start, end = np.clip(branch.force[[before, after]], bottom, top)
        ax.annotate("", (middle, end), (middle, start), zorder=look.zorder + 1,
                    arrowprops={"arrowstyle": "-|>", "linestyle": ":", "linewidth": 0.8, "color": look.colour,
                                "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7})


def _jump_notes(ax: Axes, file: SweepFile, gap: float | None) -> list[Note]:
    """The frequencies of the largest jumps."""
    notes: list[Note] = []
    for branch in file.at_gap(gap):
        for before, after in branch.jumps()[:MOST_LABELLED]:
            middle = (file.values[before] + file.values[after]) / 2
            highest = max(branch.force[before], branch.force[after])
            _add(notes, ax, (middle, highest, sweep_panels.place_text(file, middle), LOOKS[branch.direction].colour))
    return notes


def _mark_strongest(ax: Axes, file: SweepFile, gap: float | None, bottom: float, top: float) -> list[Note]:
    """A star at the resonance of each branch, a square at a largest force that is not a maximum, if it lies between these forces;
    returns their notes."""
    notes: list[Note] = []
    for branch in file.at_gap(gap):
        at = branch.strongest_single()
        if at is None or not bottom <= branch.force[at] <= top:
            continue
        look, sign = (RESONANCE, "★") if branch.is_resonance(at) else (CUT_OFF, "■")
        x, force = file.values[at], branch.force[at]
        ax.plot(x, force, color=LOOKS[branch.direction].colour, zorder=5, clip_on=False, **look)
        newtons = units.amount(force * file.newtons, "N") if file.newtons else ""
        told = either(file, newtons, units.number(force), "{} = {}")
        text = f"{sign} {told} at {sweep_panels.place_text(file, x)}"
        _add(notes, ax, (x, force, text, "black"))
    return notes


def _add(notes: list[Note], ax: Axes, note: Note) -> None:
    """Appends a note unless there is already one at the same place."""
    if all(abs(sweep_panels.across(ax, note[0]) - sweep_panels.across(ax, other[0])) > CLOSE for other in notes):
        notes.append(note)
