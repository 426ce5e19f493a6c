"""Discrete-event replay of the distribution of tiles to ranks: predicts the run time of a map on a given number of ranks.

Every rank holds a few tiles, takes another when the first of them is done, and requests its next run of tiles when it takes
the last one of its current run. Rank 0 deals the tiles in an order that scatters any run over the plane (tile_costs). It
serves requests first come, first served, and computes in between, on single tiles: it polls for requests at fixed intervals,
and serving them lengthens its own tiles. A message takes a fixed time whatever else is in progress. Start-up, writing and
shutdown are omitted, and the tiles held by a rank are treated as executed one after the other.

Which rank gets the last expensive tile, and when, is random: with few tiles per rank, run times vary by some per cent for a
small change of any tile's time, and a faster rank 0 may even finish later. The mean of several replays is therefore used,
with tile times perturbed as if measured again; the perturbations are the same for all machines compared.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from heapq import heapify, heapreplace
from math import ceil

import numpy as np

from .tile_costs import TileCosts

RUNS_PER_RANK = 16
MOST_REPLAYS, REPLAYED_TILES = 24, 400_000  # for one case, and in total
MANY = 2000  # tiles per rank from which a single replay suffices
NOISE = 0.05  # of a tile's time, between measurements


@dataclass(frozen=True)
class Machine:
    """Times of a machine in s."""

    service: float  # of rank 0 for one run: its request, its answer and its reports
    latency: float  # of a message
    look: float  # between two polls of rank 0 for requests, while it computes
    in_hand: int = 2  # tiles held by a rank


@dataclass(frozen=True)
class Replay:
    """The run of a map on a number of ranks."""

    ranks: int
    seconds: float  # until the last rank is done
    work: float  # computing time of all tiles [s]
    runs: int  # dealt by rank 0 to others
    scatter: float = 0.0  # of the seconds: standard deviation over mean

    @property
    def efficiency(self) -> float:
        """Parallel efficiency: work over the total time of all ranks."""
        return self.work / (self.ranks * self.seconds)


def deal_size(remaining: int, tiles: int, ranks: int, runs_per_rank: int = RUNS_PER_RANK) -> int:
    """The number of tiles in a run; the program's rule (deal_size in src/parallel/tile_pool.cpp)."""
    longest = max(tiles // (runs_per_rank * ranks), 1)
    return min(-(-remaining // (2 * ranks)), longest)


def typical(costs: TileCosts, ranks: int, machine: Machine, size: Callable[[int, int, int], int] = deal_size) -> Replay:
    """The mean of several replays, as a Replay."""
    random = np.random.default_rng(ranks)
    few = ranks > 1 and costs.count < MANY * ranks
    count = min(MOST_REPLAYS, max(1, REPLAYED_TILES // costs.count)) if few else 1
    replays = [replay(costs if count == 1 else costs.measured_again(random, NOISE), ranks, machine, size)
               for _ in range(count)]
    efficiency = np.array([one.efficiency for one in replays])
    return Replay(ranks, costs.total / (ranks * float(efficiency.mean())), costs.total,
                  round(float(np.mean([one.runs for one in replays]))), float(efficiency.std() / efficiency.mean()))


def replay(costs: TileCosts, ranks: int, machine: Machine, size: Callable[[int, int, int], int] = deal_size) -> Replay:
    """The run of a map with these TileCosts, as a Replay."""
    before, tiles, in_hand = costs.before, costs.count, machine.in_hand
    master = _Master(costs, machine)
    requests = [(machine.latency, rank) for rank in range(1, ranks)]  # arrival time at rank 0, and the requesting rank
    heapify(requests)
    done = [deque([0.0] * in_hand, in_hand) for _ in range(ranks)]  # end times of each rank's latest tiles
    runs = 0
    while requests:
        arrival, rank = requests[0]
        if arrival > master.now:
            master.compute_until(arrival)
        first = master.dealt
        if first == tiles:
            break
        master.now += machine.service
        end = first + size(tiles - first, tiles, ranks)
        master.dealt = end
        runs += 1

        has_run = master.now + machine.latency
        mine = done[rank]
        shift = max(has_run, mine[-1]) - before(first)
        length = end - first
        room = shift + before(end - in_hand) if length > in_hand else mine[length - 1 - in_hand]
        mine.extend([shift + before(tile) for tile in range(max(first, end - in_hand) + 1, end + 1)])
        heapreplace(requests, (max(has_run, room) + machine.latency, rank))
    else:
        master.compute_until(costs.total)
    return Replay(ranks, max(master.now + sum(master.in_hand), max(mine[-1] for mine in done)), costs.total, runs)


class _Master:
    """Rank 0 as a computing rank: takes tiles from the front of the undealt ones."""

    def __init__(self, costs: TileCosts, machine: Machine) -> None:
        self._costs = costs
        self._look = machine.look
        self._most = machine.in_hand
        self.now = 0.0  # s
        self.in_hand: list[float] = []  # remaining times of its tiles [s]
        self.dealt = 0  # tiles, by itself and to others

    def compute_until(self, moment: float) -> None:
        """Advances to its first poll for requests at or after this time, or to the end of its last tile."""
        self._fill()
        time = ceil((moment - self.now) / self._look) * self._look
        if time < sum(self.in_hand):
            self.now += time
            while time >= self.in_hand[0]:
                time -= self.in_hand.pop(0)
            self.in_hand[0] -= time
        else:
            self._finish_all(time)
        self._fill()

    def _finish_all(self, time: float) -> None:
        """Adds the tiles that it completes within this time to those it holds."""
        before, tiles = self._costs.before, self._costs.count
        reached = before(self.dealt) + time - sum(self.in_hand)  # on the cumulative axis of all tiles' times
        end = max(self._costs.turn_after(reached), self.dealt + 1)
        if end > tiles:
            self.now += sum(self.in_hand) + before(tiles) - before(self.dealt)
            self.in_hand, self.dealt = [], tiles
        else:
            self.now += time
            self.in_hand, self.dealt = [before(end) - reached], end

    def _fill(self) -> None:
        while len(self.in_hand) < self._most and self.dealt < self._costs.count:
            self.in_hand.append(self._costs.before(self.dealt + 1) - self._costs.before(self.dealt))
            self.dealt += 1
