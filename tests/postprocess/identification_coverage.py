"""Recordings of random hammers, and the errors of identified parameters, in standard errors."""

from pathlib import Path

import numpy as np
from scipy.stats import binom
from simulated_hammer import noisy, simulate, varied

from peterka.errors import PeterkaFileError
from peterka.identification import numbers_found
from peterka.identification.fit import fit
from peterka.identification.recording import Recording

KINDS = (("force",), ("force", "displacement"), ("acceleration",), ("acceleration", "displacement"))
PER_CONTACT = 30  # samples
ALLOWED = 5e-4  # two-sided error probability of calling sound intervals unsound
BIAS = 0.2


def sound_rig(chance):
    """(Hammer, (times, signals)) of a hammer whose release has at least three impacts."""
    while True:
        hammer = varied(chance)
        rate = PER_CONTACT / (np.pi / np.sqrt(hammer.stiffness / hammer.mass))
        recorded = simulate(hammer, 4 / hammer.hertz, rate)
        if np.sum(np.diff((recorded[1]["force"] > 0).astype(int)) == 1) >= 3:
            return hammer, recorded


def pulls_of(hammer, recorded, names, noise, seed):
    """{key: (found - true)/error}; or the message of a refusal."""
    time, columns = recorded
    true = {numbers_found.STIFFNESS: hammer.stiffness, numbers_found.DAMPING: hammer.damping, numbers_found.FREQUENCY: hammer.hertz,
            numbers_found.DAMPING_RATIO: hammer.ratio, numbers_found.GAP: hammer.gap}
    try:
        found = fit(Recording(Path("simulated"), 0.0, time[1], noisy(columns, names, noise, seed)), hammer.mass).found
    except PeterkaFileError as reason:
        return str(reason)
    return {key: (number.value - true[key]) / number.error for key in found.values if (number := found.number(key))}


def coverage_faults(pulls):
    """([faults in words], counts in words) of many {key: pull}."""
    faults, words = [], []
    for name, width, share in (("68 %", 1.0, 0.6827), ("95 %", 1.96, 0.95)):
        counts = {key: sum(abs(one[key]) < width for one in pulls if key in one) for key in numbers_found.KEYS}
        trials = {key: sum(key in one for one in pulls) for key in numbers_found.KEYS}
        words.append(f"within {name}: " + ", ".join(f"{key.split('.')[1]} {counts[key]} of {trials[key]}" for key in counts))
        for key, count in counts.items():
            low, high = binom.ppf((ALLOWED, 1 - ALLOWED), trials[key], share)
            if not low <= count <= high:
                faults.append(f"{key}: {count} of {trials[key]} within {name}, {low:.0f} to {high:.0f} allowed")
    bias = {key: float(np.mean([one[key] for one in pulls if key in one])) for key in numbers_found.KEYS}
    pooled = float(np.mean([value for one in pulls for value in one.values()]))
    words.append(f"mean over standard errors {pooled:+.2f} (" + ", ".join(f"{value:+.2f}" for value in bias.values()) + ")")
    return faults + [f"bias of {pooled:+.2f} standard errors"] * (abs(pooled) > BIAS), "; ".join(words)
