"""Small maps and sweeps with [uncertainty], written without peterka: 1/1 below a slanting border, no impact above it, and 2/2 or chaos
beside the border, each with a probability that changes smoothly."""

import h5py
import numpy as np
from picture_samples import CHAOTIC, NO_IMPACT, orbit, write_map
from sealing import seal_file
from sweep_samples import FREQUENCY, write_sweep

EMPTY = (-128, 0, 0)
JOB = """
schema = 1
kind = "map"
hammer = {{ mass_kg = 0.298, natural_frequency_hz = 4.5, damping_ns_per_m = 0.06 }}
cart = {{ amplitude_m = 0.89e-3 }}
contact = {{ law = "kelvin_voigt", stiffness_n_per_m = 5.5e6, damping_ns_per_m = 1.2e3 }}
axes = {{ {axes} }}
[uncertainty]
rigs = {rigs}
[uncertainty.contact.stiffness_n_per_m]
relative = 0.03
[uncertainty.hammer.damping_ratio]
from = 0.003
to = 0.005
"""
AXES = "frequency_ratio = {{ from = 1.0, to = 4.0, points = {0} }}, gap_ratio = {{ from = 0.0, to = 3.0, points = {1} }}"
KINDS = (orbit(1, 1), NO_IMPACT, orbit(2, 2), CHAOTIC)


def probabilities(rows, columns):
    """(kind, rows, columns), their sum below 1 by at most 0.05."""
    gap, frequency = np.linspace(0, 3, rows)[:, None], np.linspace(1, 4, columns)[None, :]
    distance = gap - 0.5 - 0.5 * frequency
    strikes = 1 / (1 + np.exp(4 * distance))
    beside = 0.4 * np.exp(-4 * np.abs(distance + 0.4))
    chaos = 0.1 * np.exp(-4 * (distance + 0.4) ** 2) * (frequency > 2)
    return np.stack([strikes * (1 - beside - chaos), 1 - strikes, strikes * beside, strikes * chaos * 0.5 + 0 * frequency])


def forces(rows, columns):
    """Of the 5, 50 and 95 % quantiles: (3, rows, columns), F/(m g)."""
    shares = probabilities(rows, columns)
    middle = (20 + 10 * np.linspace(1, 4, columns))[None, :] * np.ones((rows, 1))
    low = np.where(shares[1] > 0.05, 0.0, 0.8 * middle)
    return np.stack([low, np.where(shares[1] > 0.5, 0.0, middle), np.where(shares[1] > 0.95, 0.0, 1.3 * middle)])


def add_outcomes(path, kinds, shares, quantiles, names=("force_q05_ratio", "force_q50_ratio", "force_q95_ratio")):
    """Adds the datasets of [uncertainty]: kinds (slot, ..., 3) and shares (slot, ...), sorted by share; three of the quantiles."""
    with h5py.File(path, "r+") as file:
        file["outcome"] = np.arange(len(kinds), dtype="i4")
        for n, (name, kind) in enumerate((("regime", "i1"), ("impacts", "i4"), ("period", "i4"))):
            file[f"outcome_{name}"] = kinds[..., n].astype(kind)
        file["outcome_probability"] = np.asarray(shares, dtype="f8")
        file["outcomes"] = np.sum(kinds[..., 0] != EMPTY[0], axis=0, dtype="i4")
        file["outcome_others"] = np.maximum(0, 1 - np.sum(shares, axis=0))
        for name, values in zip(names, quantiles):
            file[name] = np.asarray(values, dtype="f8")
        file["outcome"].make_scale("outcome")
        plane = [scale[0] if len(scale) else None for scale in file["regime"].dims]
        for name in ("outcome_regime", "outcome_impacts", "outcome_period", "outcome_probability", "outcomes", "outcome_others", *names):
            dimensions = [file["outcome"], *plane] if file[name].ndim == 3 else plane
            for dimension, scale in zip(file[name].dims, dimensions):
                if scale is not None:
                    dimension.attach_scale(scale)
        for name in names:
            if name.startswith("speed"):
                file[name].attrs["units"] = "m/s"
    seal_file(path)
    return path


def by_probability(shares):
    """(kinds (slot, ..., 3), shares (slot, ...)) from shares (kind, ...), the commonest first; slots of none are empty."""
    order = np.argsort(-shares, axis=0, kind="stable")
    sorted_shares = np.take_along_axis(shares, order, axis=0)
    kinds = np.array(KINDS)[order]
    kinds[sorted_shares == 0] = EMPTY
    return kinds, sorted_shares


def write_uncertain(path, rows=24, columns=32, rigs=64, shares=None, quantiles=None, **options):
    names = options.pop("names", ("force_q05_ratio", "force_q50_ratio", "force_q95_ratio"))
    shares = probabilities(rows, columns) if shares is None else np.asarray(shares)
    kinds, sorted_shares = by_probability(shares)
    job = JOB.format(rigs=rigs, axes=AXES.format(columns, rows))
    write_map(path, kinds[0], np.linspace(1, 4, columns), np.linspace(0, 3, rows), job=job, **options)
    return add_outcomes(path, kinds, sorted_shares, forces(rows, columns) if quantiles is None else quantiles, names)


def write_uncertain_sweep(path, rigs=64, names=("force_q05_ratio", "force_q50_ratio", "force_q95_ratio"), **options):
    """Bands from 0.8 to 1.2 of the rising branches of sweep_samples.py, 0 where these have no impact, the same for both of a gap."""
    job = JOB.format(rigs=rigs, axes="frequency_ratio = { from = 1.0, to = 2.5, points = 13 }")
    write_sweep(path, job=job, **options)
    with h5py.File(path) as file:
        force, labels = file["peak_force_ratio"][()], [file[name][()] for name in ("regime", "impacts", "period")]
    kinds = np.stack(labels, axis=-1)[None]
    assert force.shape == (4, len(FREQUENCY))
    force = force[[0, 0, 2, 2]]
    return add_outcomes(path, kinds, np.ones((1, *force.shape)), np.multiply.outer([0.8, 1.0, 1.2], force), names)
