"""Files of every kind with one item changed: each dataset and each attribute, to contents that no program of ours writes."""

import shutil

import h5py
import numpy as np
from attractor_samples import write_attractors
from curves_samples import write_curves
from picture_samples import PLAIN, write_audit, write_basin, write_map
from sealing import SealedFile
from study_samples import write_labels, write_stability, write_work_precision
from sweep_samples import write_sweep, write_sweep_with_starts
from trace_samples import write_trace
from uncertain_samples import write_uncertain, write_uncertain_sweep

JOB = """
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
[cart]
amplitude_m = 0.89e-3
[operating_point]
frequency_ratio = 1.8
gap_ratio = 1.6
"""


def full_map(path):
    fields = {name: np.ones((4, 4)) for name in ("impact_speed", "contact_time")}
    write_map(path, fields=fields | {"chatter": np.zeros((4, 4)), "last_impact": np.zeros((4, 4))}, job=JOB)
    write_audit(path, [(0, 0), (1, 1)], [PLAIN[0][0], PLAIN[1][1]], [1e-8, 2e-8], [1, 1])
    with SealedFile(path, "r+") as file:
        file["run/tile_seconds"], file["run/ranks"], file["run/solve_seconds"] = np.ones(1), np.int32(1), 1.0
        file["summary/omitted"] = np.bytes_("cubic spring: left out")
    return path


def full_basin(path):
    return write_basin(path, fields={"last_impact": np.zeros((4, 4))}, job=JOB, attractor=np.zeros((4, 4)), attractors=[
        dict(regime=1, impacts=1, period=1, cells=4, peak_force_ratio=12.0, orbit_displacement=-1.0, orbit_velocity=0.5)])


KINDS = {
    "map": full_map,
    "map with starts": lambda path: write_attractors(path, job=JOB),
    "map of uncertain rigs": lambda path: write_uncertain(path, rows=5, columns=6),
    "basin": full_basin,
    "sweep": lambda path: write_sweep(path, job=JOB),
    "sweep with starts": write_sweep_with_starts,
    "sweep of uncertain rigs": write_uncertain_sweep,
    "trace": lambda path: write_trace(path, job=JOB),
    "precision": write_work_precision,
    "labels": write_labels,
    "stability": write_stability,
    "curves": lambda path: write_curves(path, job=JOB),
}

# Names under which claims.py looks for files of a kind.
CLAIMED = {
    "map": ["gaps_170mm.h5", "peterka_170mm.h5", "peterka_150mm.h5", "peterka_135mm.h5", "starts/start_1.h5",
            "starts/start_2.h5"],
    "basin": ["basin_150mm.h5", "basin_135mm.h5", "nearby_150mm/gap_1.h5", "nearby_135mm/gap_1.h5"],
    "sweep": ["sweep_170mm.h5", "sweep_150mm.h5", "sweep_135mm.h5"],
    "trace": ["trace_170mm_release.h5", "trace_170mm_9hz.h5"],
}

REAL = {"1e308": 1e308, "-1e308": -1e308, "infinite": np.inf, "no number": np.nan, "0": 0.0, "-1": -1.0, "1e-308": 1e-308}


def changes_of(values):
    """{description: altered values} of a dataset."""
    values = np.asarray(values)
    changes = {"as text": np.full(values.shape, b"x"), "scalar" if values.shape else "list": (
        values.ravel()[0] if values.shape else np.array([values, values])), "nothing": np.zeros((0,) * max(values.ndim, 1))}
    if values.dtype.kind == "f":
        changes |= {name: np.full(values.shape, value) for name, value in REAL.items()}
        changes |= {"half": values.astype("f2"), "whole": np.nan_to_num(values).astype("i4")}
        if values.size > 1:
            one = values.copy()
            one.flat[-1] = 1e308
            changes["one of 1e308"] = one
    if values.dtype.kind in "iu":
        limits = np.iinfo(values.dtype)
        changes |= {"least": np.full(values.shape, limits.min), "largest": np.full(values.shape, limits.max),
                    "none": np.zeros_like(values), "unsigned": np.abs(values).astype("u1"), "long": values.astype("i8"),
                    "real": values.astype("f8")}
    if values.ndim:
        changes |= {"longer": np.concatenate([values, values]), "deeper": values[..., None]}
    return changes


ATTRIBUTES = {"text": "x", "no text": "", "0": 0.0, "-1": -1.0, "no number": np.nan, "infinite": np.inf, "1e308": 1e308,
              "1e-308": 1e-308, "list": np.array([1.0, 2.0]), "text of 60 kB": "\x1b[2J" * 15000, "bytes": np.bytes_(b"\xff\x00")}
JOBS = {"mass as text": JOB.replace("0.298", '"x"'), "mass 0": JOB.replace("0.298", "0.0"), "no mass": JOB.replace("mass_kg", "m"),
        "frequency 0": JOB.replace("4.5", "0"), "frequency huge": JOB.replace("4.5", "1e308"),
        "frequency as a list": JOB.replace("4.5", "[4.5]"), "amplitude true": JOB.replace("0.89e-3", "true"),
        "no place": JOB[:JOB.index("[operating")], "place as text": JOB.replace("1.6", '"x"'), "hammer is a list": "hammer = []\n",
        "no cart": JOB.replace("[cart]", "[card]"), "endless": "[" * 5000, "mass infinite": JOB.replace("0.298", "inf")}


def hostile_files(kind, folder, wanted=lambda what: True):
    """(description, path) of each selected change; the path is reused."""
    sound, path = KINDS[kind](folder / f"{kind}_sound.h5"), folder / f"{kind}.h5"
    with h5py.File(sound) as file:
        names, groups = [], []
        file.visititems(lambda name, thing: (names if isinstance(thing, h5py.Dataset) else groups).append(name))
        values = {name: file[name][()] for name in names}
        attributes = list(file.attrs)

    def replace(name, value):
        def act(file):
            attributes = dict(file[name].attrs)
            del file[name]
            file[name] = value
            for key in ("units", "flag_values", "flag_meanings"):
                if key in attributes:
                    file[name].attrs[key] = attributes[key]
        return act

    def changes():
        """(what, what does it to an open file)"""
        for name in names + groups:
            yield f"no {name}", lambda file, name=name: file.pop(name)
        for name in names:
            for what, value in changes_of(values[name]).items() if not isinstance(values[name], bytes) else ():
                yield f"{name}: {what}", replace(name, value)
        for name in attributes:
            yield f"no attribute {name}", lambda file, name=name: file.attrs.pop(name)
            for what, value in ATTRIBUTES.items():
                yield f"attribute {name}: {what}", lambda file, name=name, value=value: file.attrs.update({name: value})
        for what, job in JOBS.items() if "job" in attributes else ():
            yield f"job: {what}", lambda file, job=job: file.attrs.update({"job": job})

    for what, act in changes():
        if not wanted(what):
            continue
        shutil.copy(sound, path)
        with SealedFile(path, "r+") as file:
            act(file)
        yield what, path
