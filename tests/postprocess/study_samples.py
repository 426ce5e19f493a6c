"""Small study files in layout version 3, written without peterka."""

import numpy as np
from sealing import SealedFile

METHODS = ["exact", "split", "cvode_adams", "cvode_bdf", "arkode_explicit", "arkode_implicit", "rk4_with_events",
           "rk4_without_events", "batched"]
RUN_OUTCOMES = ["done", "failed", "other_orbit"]
OUTCOMES = ["agrees", "says_why_not", "wrong", "not_for_this_scene"]
REGIMES = ["no_impact", "periodic", "chaotic", "sustained_contact", "unresolved", "failed"]
STATUSES = ["proved", "budget", "conservative", "too_many_events", "not_finite", "solver_failed"]
NAN = np.nan


def write_work_precision(path, runs=None, **attributes):
    """`runs`: (method, setting, errors of each cell, seconds of each cell, outcomes of each cell)."""
    runs = sample_runs() if runs is None else runs
    cells = len(runs[0][2])
    with _study(path, "work_precision", attributes) as file:
        _scales(file, trial=len(runs), cell=cells)
        _write(file, "frequency_ratio", np.linspace(1, 4, cells), "cell")
        _write(file, "gap_ratio", np.linspace(0, 1, cells), "cell")
        _write(file, "reference_peak_force_ratio", np.full(cells, 50.0), "cell")
        _write(file, "method", [METHODS.index(run[0]) for run in runs], "trial", words=METHODS)
        _write(file, "setting", [float(run[1]) for run in runs], "trial")
        _write(file, "error_peak_force", np.array([run[2] for run in runs], float), "trial", "cell")
        outcomes = [[RUN_OUTCOMES.index(word) if word else -128 for word in run[4]] for run in runs]
        _write(file, "outcome", outcomes, "trial", "cell", words=RUN_OUTCOMES)
        file["run/seconds_per_cycle"] = np.array([run[3] for run in runs], float)
    return path


def sample_runs(cells=8, seed=3):
    """Realistic runs: slower if more accurate; exact and batched have no setting."""
    spread = 10 ** np.random.default_rng(seed).normal(0, 0.5, cells)
    done = ["done"] * cells
    runs = [("exact", 0, 2e-13 * spread, 1.4e-6 * spread**0.1, done),
            ("batched", 0, 2e-14 * spread, 4e-8 * spread**0.1, done)]
    orders = {"split": (0.5, 1e-6), "cvode_adams": (0.08, 4e-5), "cvode_bdf": (0.11, 7e-5),
              "arkode_explicit": (0.1, 3e-5), "arkode_implicit": (0.16, 6e-5)}
    for method, (power, seconds) in orders.items():
        for tolerance in 10.0 ** np.arange(-3, -12, -2):
            runs.append((method, tolerance, 5 * tolerance * spread, seconds * tolerance**-power * spread**0.1, done))
    for steps in (100, 1000, 10000):
        some = ["other_orbit" if steps == 100 and cell < 2 else "done" for cell in range(cells)]
        runs.append(("rk4_with_events", steps, 1e6 / steps**4 * spread, 3e-8 * steps * spread**0, some))
        runs.append(("rk4_without_events", steps, 100 / steps * spread, 3e-8 * steps * spread**0, some))
    return runs


def write_labels(path, runs=None, cells=4096, **attributes):
    """`runs`: (method, setting, changed share, unproved share, seconds per cell)."""
    runs = runs or [("exact", 0, 0, 0.001, 2e-5)] + [
        (method, tolerance, min(0.5, 30 * tolerance**0.8), 0.002 + 20 * tolerance, factor * tolerance**-0.1)
        for method, factor in (("cvode_adams", 1e-3), ("arkode_explicit", 8e-4), ("split", 1e-5))
        for tolerance in (1e-3, 1e-5, 1e-7, 1e-9)
    ]
    with _study(path, "labels", attributes) as file:
        _scales(file, trial=len(runs))
        file["cells"] = np.int64(cells)
        _write(file, "method", [METHODS.index(run[0]) for run in runs], "trial", words=METHODS)
        for column, name in enumerate(["setting", "changed_share", "unproved_share"], 1):
            _write(file, name, [float(run[column]) for run in runs], "trial")
        file["run/seconds_per_cell"] = np.array([run[4] for run in runs], float)
    return path


SCENES = {
    "stiffness_1e2": "aaaa", "stiffness_1e15": "aasw", "contact_elastic": "aaaa", "conservative": "ssss",
    "gap_at_rounding_out_of_reach": "aaaa", "cubic_dominating": "nnaa", "rigid_chatter": "annn",
}
ENGINES = ["exact", "split", "cvode", "arkode"]


def write_stability(path, scenes=None, engines=ENGINES, rungs=8, slope=-0.5, **attributes):
    """`scenes`: {name: a letter for each engine: agrees, says why not, wrong, not for this scene, or - for none}."""
    scenes = scenes or SCENES
    outcome = np.array([["aswn".find(letter) if letter != "-" else -128 for letter in row] for row in scenes.values()])
    shape = outcome.shape
    with _study(path, "stability", attributes) as file:
        _scales(file, scene=shape[0], engine=shape[1], rung=rungs)
        for name, words in (("scene", list(scenes)), ("engine", list(engines))):
            _flags(file[name], words)
        _write(file, "outcome", outcome, "scene", "engine", words=OUTCOMES)
        says = outcome == 1
        _write(file, "regime", np.where(says, 4, 1), "scene", "engine", words=REGIMES)
        _write(file, "status", np.where(says, 1 + np.indices(shape).sum(axis=0) % 5, 0), "scene", "engine",
               words=STATUSES)
        _write(file, "energy_imbalance", np.where(outcome == 0, 10.0 ** (-14 + np.indices(shape)[1] * 2.0), NAN),
               "scene", "engine")
        stiffness = np.geomspace(1e2, 1e9, rungs)
        _write(file, "contact_stiffness", stiffness, "rung")
        _write(file, "speed_difference", -3 * stiffness**slope, "rung")
        file["run/seconds"] = np.ones(shape)
    return path


def _study(path, topic, attributes):
    file = SealedFile(path, "w")
    file.attrs.update({"title": "Sample", "peterka_layout": np.int32(3), "peterka_kind": "study", "topic": topic})
    file.attrs.update(attributes)
    file.create_group("run")
    return file


def _scales(file, **sizes):
    for name, size in sizes.items():
        kind = "i1" if name == "engine" else "i4"
        file.create_dataset(name, data=np.arange(size, dtype=kind)).make_scale(name)


def _write(file, name, values, *dimensions, words=None):
    values = np.array(values)
    dataset = file.create_dataset(name, data=values.astype("i1") if words else values)
    for index, dimension in enumerate(dimensions):
        dataset.dims[index].attach_scale(file[dimension])
    if words:
        _flags(dataset, words)


def _flags(dataset, words):
    dataset.attrs["flag_values"] = np.arange(len(words), dtype=dataset.dtype)
    dataset.attrs["flag_meanings"] = " ".join(words)
