"""Labels of a map's cells, as compared by benchmarks."""

import tomllib

import h5py
import numpy as np

NO_IMPACT, PERIODIC, CHAOTIC, SUSTAINED, UNRESOLVED = range(5)  # regimes in a file


class Labels:
    """Regime, p and q of a map's cells, their cycles, and whether the hammer may become permanently free there."""

    def __init__(self, file):
        with h5py.File(file) as opened:
            self.regime, self.impacts, self.period, self.cycles = (
                opened[name][:] for name in ("regime", "impacts", "period", "cycles"))
            eta, gap = opened["frequency_ratio"][:], opened["gap_ratio"][:]
            hammer = tomllib.loads(opened.attrs["job"])["hammer"]  # including the numbers of its rig
        zeta = hammer["damping_ns_per_m"] / (4 * np.pi * hammer["mass_kg"] * hammer["natural_frequency_hz"])
        amplitude = eta**2 / np.hypot(1 - eta**2, 2 * zeta * eta)
        self.comes_free = gap[:, None] > amplitude[None, :]

    def same(self, other):
        return (self.regime == other.regime) & (self.impacts == other.impacts) & (self.period == other.period)
