"""Neighbouring points of an axis that have something in common."""

import numpy as np


def spans(mask):
    """(first, last) of each run of True, both included."""
    steps = np.diff(np.concatenate([[0], np.asarray(mask, dtype=int), [0]]))
    return list(zip(np.flatnonzero(steps == 1).tolist(), (np.flatnonzero(steps == -1) - 1).tolist()))


def span_around(mask, index):
    """The run that holds this index; None where it isn't True."""
    return next((span for span in spans(mask) if span[0] <= index <= span[1]), None)


def widest(mask):
    """None without any."""
    return max(spans(mask), key=lambda span: span[1] - span[0], default=None)
