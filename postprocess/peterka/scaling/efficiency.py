"""Parallel efficiency against ranks: the measured tiles replayed for any number of ranks (dealing), for maps of several
sizes, next to the measured efficiency.

Dotted: rank 0 answers without delay. Where a line departs from its dotted one, rank 0 is the bottleneck; where the dotted
line falls, there are too few tiles for that many ranks.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from math import isqrt

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..plotting import axes, style
from .dealing import MOST_REPLAYS, Machine, Replay, typical
from .run_record import RunRecord
from .tile_costs import TileCosts, goes_by_squares, tiles_of

WIDTH, HEIGHT = 3.7, 3.0  # in, without the legend
COLOURS = ("#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7")  # Okabe and Ito
MARKERS = "osD^v"
WELL_USED = 0.9  # efficiency above which ranks are well used


@dataclass(frozen=True)
class Curve:
    """The same plane as a map of this many cells; members of shape (ranks,)."""

    cells: int
    tiles: tuple[int, int]  # rows and columns
    replays: list[Replay]
    ideal: list[Replay]  # the same for a rank 0 that answers without delay


@dataclass(frozen=True)
class Measured:
    """A measured run."""

    cells: int
    ranks: int
    seconds: float
    efficiency: float  # relative to the run with as many cells on one rank


def ranks_up_to(most: int) -> list[int]:
    """1, 2, 5, 10, ... and `most` itself."""
    decades = 10 ** np.arange(int(np.log10(most)) + 1)
    return sorted({int(number) for number in np.outer(decades, (1, 2, 5)).ravel() if number <= most} | {most})


def curve(record: RunRecord, cells: int, ranks: Iterable[int], machine: Machine) -> Curve:
    """The Curve of a square map of about this many cells."""
    shape = record.shape if cells == record.cells else (isqrt(cells), isqrt(cells))
    tiles = tiles_of(shape, record.tile)
    ideal = replace(machine, service=0.0)
    real, at_once = [], []
    for _, group in groupby(ranks, lambda number: goes_by_squares(tiles[0] * tiles[1], number)):
        numbers = list(group)
        costs = TileCosts(record.tile_seconds, tiles, numbers[0])
        real += [typical(costs, number, machine) for number in numbers]
        at_once += [typical(costs, number, ideal) for number in numbers]
    return Curve(cells, tiles, real, at_once)


def measured_efficiency(records: Sequence[RunRecord]) -> tuple[list[Measured], list[RunRecord]]:
    """(list of Measured, list of RunRecord without a one-rank run for comparison)."""
    alone: dict[tuple[int, int], float] = {}
    for record in records:
        if record.ranks == 1:
            alone[record.shape] = min(record.seconds, alone.get(record.shape, np.inf))
    points = [Measured(record.cells, record.ranks, record.seconds,
                       alone[record.shape] / (record.ranks * record.seconds))
              for record in records if record.shape in alone]
    return points, [record for record in records if record.shape not in alone]


def most_ranks(replays: Iterable[Replay], least: float = WELL_USED) -> int:
    """The largest number of ranks up to which all efficiencies reach this value; 1 rank is always well used."""
    well = 1
    for one in replays:
        if one.efficiency < least:
            break
        well = one.ranks
    return well


def well_used(curve: Curve) -> str:
    """The largest well-used number of ranks, and whether rank 0 limits it."""
    real, ideal = most_ranks(curve.replays), most_ranks(curve.ideal)
    ranks = f"{real} rank{'s' * (real > 1)}"
    return f"{ranks}, and up to {ideal} if rank 0 answered without delay" if ideal > real else f"{ranks}; rank 0 is not what limits it"


def text(curves: Sequence[Curve], machine: Machine) -> str:
    """The picture's numbers as lines, and where rank 0 is too slow."""
    lines = [f"{'cells':>9}{'ranks':>8}{'time [s]':>11}{'efficiency':>12}{'if rank 0 answered without delay':>34}"]
    for one in curves:
        for real, ideal in zip(one.replays, one.ideal):
            lines.append(f"{one.cells:>9.3g}{real.ranks:>8}{real.seconds:>11.4g}{100 * real.efficiency:>10.1f} %"
                         f"{100 * ideal.efficiency:>32.1f} %")
    for one in curves:
        lines.append(f"{one.cells:.3g} cells: {100 * WELL_USED:.0f} % efficiency up to {well_used(one)}.")
    scatter = max(real.scatter for one in curves for real in one.replays)
    if scatter > 0:
        lines.append("Which rank gets the last costly tile is chance: times are means of up to "
                     f"{MOST_REPLAYS} replays, which scatter by {100 * scatter:.1f} % at most (standard deviation).")
    return "\n".join([*lines, assumptions(machine)])


def assumptions(machine: Machine) -> str:
    """The assumptions of the replay, in a sentence."""
    return (f"Rank 0 deals {_rate(machine)} runs a second and looks for requests every {1e6 * machine.look:.3g} µs, a "
            f"message takes {1e6 * machine.latency:.3g} µs; starting up and the file are left out.")


@style.using()
def draw(record: RunRecord, curves: Sequence[Curve], measured: Sequence[Measured], machine: Machine) -> Figure:
    """Figure of Curves and Measured points."""
    handles = [Line2D([], [], color=COLOURS[number % len(COLOURS)], marker=MARKERS[number % len(MARKERS)],
                      markersize=3.5, linewidth=1.1, label=f"{_power(one.cells)} cells")
               for number, one in enumerate(curves)]
    handles.append(Line2D([], [], color="#555555", linestyle=":", linewidth=1.0, label="rank 0 answers without delay"))
    if measured:
        handles.append(Line2D([], [], **_MEASURED, label="measured"))
    figure, (ax,) = axes.diagram(WIDTH, HEIGHT, handles)
    for number, one in enumerate(curves):
        colour, marker = COLOURS[number % len(COLOURS)], MARKERS[number % len(MARKERS)]
        ranks = [real.ranks for real in one.replays]
        ax.plot(ranks, [100 * ideal.efficiency for ideal in one.ideal], color=colour, linestyle=":", linewidth=1.0)
        ax.plot(ranks, [100 * real.efficiency for real in one.replays], color=colour, marker=marker, markersize=3.5,
                linewidth=1.1)
    for point in measured:
        ax.plot(point.ranks, 100 * point.efficiency, **_MEASURED)
    axes.log_scale(ax, "x")
    ax.set_ylim(0, max(105, 105 * max((point.efficiency for point in measured), default=0)))
    ax.margins(x=0.04)
    ax.set_xlabel("ranks")
    ax.set_ylabel("parallel efficiency (%)")
    axes.write_title(figure, record, f"rank 0 deals {_rate(machine)} runs a second,\n"
                                     f"a message takes {1e6 * machine.latency:.3g} µs")
    return figure


_MEASURED = {"marker": "*", "linestyle": "none", "markersize": 10, "markerfacecolor": "#F0E442",
             "markeredgecolor": "black", "markeredgewidth": 0.7, "zorder": 5}


def _rate(machine: Machine) -> str:
    return f"{float(f'{1 / machine.service:.2g}'):,.0f}".replace(",", " ")


def _power(cells: int) -> str:
    exponent = int(np.floor(np.log10(cells)))
    factor = cells / 10**exponent
    return f"$10^{{{exponent}}}$" if abs(factor - 1) < 0.005 else f"${factor:.2g}\\cdot10^{{{exponent}}}$"
