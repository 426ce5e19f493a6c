"""Tables of studies as Markdown; times are multiples of the exact engine's, so that they carry over to other machines."""

from collections.abc import Iterable, Sequence

import numpy as np

from ..arrays import Reals
from ..files.regimes import reason
from .methods import look, methods_in_order
from .stability import OUTCOMES, fitted_slope, scene_name, status_word
from .study_file import Labels, Stability, WorkPrecision
from .work_precision import care, points_of

GOALS = (1e-3, 1e-6, 1e-9, 1e-12)  # requested errors in peak force
NONE = "–"


def work_precision_table(table: WorkPrecision) -> str:
    """A row per method: its most accurate run, and the cost of the fastest run whose median error stays within a goal."""
    lines = {method: points_of(table, method) for method in methods_in_order(table.method)}
    unit, reference = _unit([point.seconds for point in lines.get("exact", [])], "µs", 1e6)
    rows = []
    for method, points in lines.items():
        lacking = _share_not_done(table, method)
        best = min(points, key=lambda point: point.error, default=None)
        reached = [min((point.seconds for point in points if point.error <= goal), default=None) for goal in GOALS]
        rows.append([
            look(method).name,
            f"{_error(best.error)} ({_error(best.largest)})" if best else NONE,
            _times(best.seconds / reference) if best else NONE,
            *(NONE if seconds is None else _times(seconds / reference) for seconds in reached),
            _percent(lacking),
        ])
    head = ["method", "smallest error in peak force: median (largest)", f"its time, {unit}"]
    head += [f"time for {_error(goal)}" for goal in GOALS]
    return _markdown([*head, "cells without a result"], rows)


def labels_table(table: Labels) -> str:
    """Rows of each method's least and most accurate run."""
    exact = table.seconds_per_cell[(table.method == "exact") & (table.seconds_per_cell > 0)]
    unit, reference = _unit(exact, "ms", 1e3)
    rows = []
    for method in methods_in_order(table.method):
        runs = np.flatnonzero((table.method == method) & np.isfinite(table.changed_share))
        runs = runs[np.argsort([care(table.setting[run]) for run in runs])]
        for run in dict.fromkeys(runs[[0, -1]].tolist() if len(runs) else []):
            rows.append([
                look(method).name, f"{table.setting[run]:g}" if table.setting[run] > 0 else NONE,
                _percent(table.changed_share[run]), _percent(table.unproved_share[run]),
                _times(table.seconds_per_cell[run] / reference),
            ])
    return _markdown(["method", "tolerance", "other labels", "unverified", f"time, {unit}"], rows)


def stability_table(table: Stability) -> str:
    """The number of outcomes of each kind for each engine, and its largest energy imbalance."""
    rows = []
    for number, engine in enumerate(table.engine):
        imbalance = np.abs(table.energy_imbalance[:, number])
        imbalance = imbalance[np.isfinite(imbalance)]
        counts = [str(np.sum(table.outcome[:, number] == name)) for name in OUTCOMES]
        rows.append([engine, *counts, _error(imbalance.max()) if len(imbalance) else NONE])
    head = ["engine", *(entry.label for entry in OUTCOMES.values()), "largest energy imbalance of a period"]
    return _markdown(head, rows)


def where_engines_break(table: Stability) -> str:
    """A list of the scenes in which an engine gives a reason for having no result, by status, or is wrong."""
    lines = []
    for number, engine in enumerate(table.engine):
        scenes: dict[str, list[str]] = {}
        for row in np.flatnonzero(np.isin(table.outcome[:, number], ["says_why_not", "wrong"])):
            wrong = table.outcome[row, number] == "wrong"
            word = "**wrong**" if wrong else reason(status_word(table, row, number)) or "no reason given"
            scenes.setdefault(word, []).append(scene_name(table.scene[row]))
        text = "; ".join(f"{word} ({', '.join(names)})" for word, names in sorted(scenes.items()))
        lines.append(f"- {engine}: {text or 'nowhere'}")
    return "\n".join(lines)


def rigid_limit_sentence(table: Stability) -> str:
    """The power of the stiffness with which the impact speed tends to its limit; empty if not measured."""
    fit = fitted_slope(table.contact_stiffness, table.speed_difference)
    if fit is None:
        return ""
    slope = f"{fit[0]:.3f}".replace("-", "−")
    return (f"As the stop gets stiffer, the impact speed tends to that on a rigid stop like the stiffness to the power "
            f"{slope}; theory says −0.5.")


def _share_not_done(table: WorkPrecision, method: str) -> float:
    outcome = table.outcome[table.method == method]
    known = outcome != ""
    return float(np.mean(outcome[known] != "done")) if known.any() else np.nan


def _unit(exact: Sequence[float] | Reals, unit: str, per_second: float) -> tuple[str, float]:
    """(column head, seconds per unit): the exact engine's time, or the plain unit if it is missing."""
    return ("exact = 1", float(min(exact))) if len(exact) else (unit, 1 / per_second)


def _times(ratio: float) -> str:
    return f"{ratio:.2g}" if ratio < 99.5 else f"{float(f'{ratio:.2g}'):,.0f}".replace(",", " ")


def _error(value: float) -> str:
    if value == 0:
        return "0"
    digits, exponent = f"{value:.0e}".split("e")
    power = f"10<sup>{int(exponent)}</sup>".replace("-", "−")
    return power if digits == "1" else f"{digits}·{power}"


def _percent(share: float) -> str:
    if not np.isfinite(share):
        return NONE
    return "0" if share == 0 else f"{100 * share:.2g} %"


def _markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
