"""The numbers of `regime` in a file, and the words for them."""

from collections.abc import Mapping

import numpy as np

from ..arrays import Integers
from .checked_hdf5 import Content

NAMES = ("no impact", "periodic", "chaotic", "sustained contact", "unresolved", "failed")
NO_IMPACT, PERIODIC, CHAOTIC, SUSTAINED_CONTACT, UNRESOLVED, FAILED, NOT_COMPUTED = 0, 1, 2, 3, 4, 5, -128
_REASONS = {
    "budget": "nothing verified in all its cycles (steady_state.max_cycles)", "conservative": "nothing dissipates",
    "too many events": "too many contacts in a cycle", "not finite": "numbers grew out of range",
    "solver failed": "the integrator gave up", "chaotic so far": "chaos or a long transient",
}


def reason(status: str) -> str:
    """Why a cell is unresolved or failed, in words, from the file's word for its `status`."""
    return _REASONS.get(status, status)


def check_labels(data: Content, columns: Mapping[str, Integers]) -> None:
    """Refuses arrays of regime, impacts and period that are not valid labels.

    `data` is their source file; `columns` {name: integer array}, all of one shape."""
    regime = columns["regime"]
    known = np.isin(regime, [*range(FAILED + 1), NOT_COMPUTED])
    if not known.all():
        raise data.refusal(f"holds the unknown regime {int(regime[~known][0])}")
    periodic = regime == PERIODIC
    for name in ("impacts", "period"):
        if name in columns and np.any(columns[name][periodic] < 1):
            raise data.refusal(f"holds a periodic cell whose {name} is below 1")
