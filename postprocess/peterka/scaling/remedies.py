"""Remedies where rank 0 is too slow for the number of ranks: longer runs, or groups of ranks with one dealer each.

    floor    a run lasts at least as long as rank 0 needs to serve all ranks once; tiles are assumed to cost the mean
    groups   each group of ranks has its own dealer and every n-th tile for n groups, which is the same plane with 1/n of the
             tiles: the replay of one group represents all
"""

from collections.abc import Iterable
from dataclasses import dataclass
from math import ceil, sqrt

from .dealing import Machine, Replay, deal_size, typical
from .efficiency import Curve
from .run_record import RunRecord
from .tile_costs import TileCosts

BEST_PART = 0.9  # efficiency relative to that of a rank 0 that answers without delay, below which remedies are considered
BUSY = 0.8  # largest share of time that rank 0 may spend on serving
GROUP_SIZES = (100, 200, 500, 1000)  # ranks


@dataclass(frozen=True)
class Remedies:
    """Efficiencies with and without each remedy."""

    ranks: int
    present: float
    floor: float
    groups: float
    group_size: int  # of the best grouping


def text(record: RunRecord, curves: Iterable[Curve], machine: Machine) -> str:
    """A line for each number of ranks of these Curves at which rank 0 costs more than a tenth of the efficiency."""
    lines = [f"{'cells':>9}{'ranks':>8}{'one dealer':>12}{'longer runs':>13}{'groups':>10}"]
    for curve in curves:
        for real, ideal in zip(curve.replays, curve.ideal):
            if real.efficiency < BEST_PART * ideal.efficiency:
                found = remedies(record, curve.tiles, real, machine)
                lines.append(f"{curve.cells:>9.3g}{found.ranks:>8}{100 * found.present:>10.1f} %"
                             f"{100 * found.floor:>11.1f} %{100 * found.groups:>8.1f} % of {found.group_size} ranks")
    return "\n".join(lines) if len(lines) > 1 else "Rank 0 is fast enough everywhere."


def remedies(record: RunRecord, tiles: tuple[int, int], present: Replay, machine: Machine) -> Remedies:
    """Efficiencies of each remedy in place of this Replay of a plane of `tiles` (rows, columns) with the costs of a RunRecord."""
    ranks = present.ranks
    costs = TileCosts(record.tile_seconds, tiles, ranks)
    least = ceil(ranks * machine.service / (BUSY * costs.total / costs.count))

    def with_floor(remaining: int, all_tiles: int, everyone: int) -> int:
        return min(max(deal_size(remaining, all_tiles, everyone), least), ceil(remaining / everyone))

    groups = {size: _one_group(record, tiles, ranks / size, size, machine) for size in GROUP_SIZES if size < ranks}
    best = max(groups, key=lambda size: groups[size], default=ranks)
    floor = typical(costs, ranks, machine, with_floor).efficiency
    return Remedies(ranks, present.efficiency, floor, groups.get(best, present.efficiency), best)


def _one_group(record: RunRecord, tiles: tuple[int, int], groups: float, size: int, machine: Machine) -> float:
    rows, columns = (max(1, round(side / sqrt(groups))) for side in tiles)
    return typical(TileCosts(record.tile_seconds, (rows, columns), size), size, machine).efficiency
