"""Small planes and folders of planes for testing claims."""

from pathlib import Path

import numpy as np
from peterka.claims.folder import Plane

ONE, HALF, TWICE, QUIET, CHAOS = (1, 1, 1), (1, 1, 2), (1, 2, 2), (0, 0, 1), (2, 0, 0)
JOB = """
hammer = { mass_kg = 0.298, natural_frequency_hz = 4.5 }
cart = { amplitude_m = 0.89e-3 }
contact = { stiffness_n_per_m = 5.5e6, damping_ns_per_m = 1.2e3 }
"""


def plane(labels, force=None, gap_ratio=1.0, rows=None, columns=None, last_impact=None):
    """`labels`: (regime, p, q) by row and column. A hammer of 1 N and 1 Hz, a cart of 1 mm: ratios equal N, Hz and mm;
    columns are 1, 2, ... by default, rows 0, 1, ..."""
    labels = np.array(labels)
    job = {"hammer": {"natural_frequency_hz": 1.0, "mass_kg": 1 / 9.80665}, "cart": {"amplitude_m": 1e-3},
           "operating_point": {"gap_ratio": gap_ratio, "frequency_ratio": 2.0}}
    height, width = labels.shape[:2]
    force = np.ones((height, width)) if force is None else np.array(force, dtype=float)
    return Plane(Path("a.h5"), "map", job, np.arange(height) if rows is None else np.array(rows),
                 1.0 + np.arange(width) if columns is None else np.array(columns),
                 labels[..., 0], labels[..., 1], labels[..., 2], force, last_impact)


def basin(striking, quiet, gap_ratio=1.0):
    """A basin with these numbers of starts of each kind; gap_ratio is its operating point."""
    cells = [[ONE] * striking + [QUIET] * quiet]
    return plane(cells, gap_ratio=gap_ratio, last_impact=np.zeros((1, striking + quiet), dtype=int))


class Held:
    """A folder of planes by name."""

    def __init__(self, curves=None, **planes):
        self._planes, self._curves = planes, curves

    def curves(self, name):
        return self._curves

    def plane(self, name):
        return self._planes.get(name)

    def planes(self, prefix):
        return [self._planes[name] for name in sorted(self._planes) if name.startswith(prefix)]


def verdicts(claims):
    return {claim.key: claim.verdict for claim in claims}
