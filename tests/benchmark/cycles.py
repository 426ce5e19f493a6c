"""Distribution of forcing cycles: by regime, and the share spent on establishing chaos."""

import h5py
import numpy as np
from labels import CHAOTIC, NO_IMPACT, PERIODIC, SUSTAINED, UNRESOLVED, Labels

WHERE = ["cells", "of the map", "its cycles a cell", "of its cycles", "of the refined map's computed cells", "of its cycles"]
SOONER = ["chaos_cycles", "where", "called chaotic", "of them settled after a long run", "cycles per cell of the map"]
AT_ONCE = (1000, 700, 500)  # chaos_cycles; the first is the default


def by_regime(whole, refined):
    """[cells, share of the cells, ...] for a map's file and for a refined one."""
    parts = [_parts(whole), _parts(refined)]
    rows = []
    for name in parts[0]:
        (cells, mean, cycles), (cells_refined, _, cycles_refined) = (part[name] for part in parts)
        rows.append([name, _percent(cells), f"{mean:.0f}", _percent(cycles), _percent(cells_refined), _percent(cycles_refined)])
    return rows


def _parts(file):
    """{cells: (share of those computed, cycles per cell, share of the cycles)}"""
    labels = Labels(file)
    with h5py.File(file) as opened:
        computed = opened["computed"][:] == 1 if "computed" in opened else np.full(labels.regime.shape, True)
    regime, cycles = labels.regime[computed], labels.cycles[computed].astype(float)
    free = labels.comes_free[computed]
    late = cycles > 300
    which = {"no impact, decided at once": (regime == NO_IMPACT) & (cycles == 0),
             "no impact or periodic within 300 cycles": np.isin(regime, [NO_IMPACT, PERIODIC, SUSTAINED]) & ~late & (cycles > 0),
             "no impact or periodic later": np.isin(regime, [NO_IMPACT, PERIODIC, SUSTAINED]) & late,
             "chaotic where no impact is possible, too": (regime == CHAOTIC) & free,
             "chaotic where impacts go on for ever": (regime == CHAOTIC) & ~free, "unresolved": regime == UNRESOLVED}
    return {name: (np.mean(cells), np.mean(cycles[cells]) if cells.any() else 0, cycles[cells].sum() / cycles.sum())
            for name, cells in which.items()}


def called_sooner(bench, sizes, truth):
    """Rows for maps with fewer chaos_cycles; truth: the Labels of a map of the same cells after a long run."""
    settles = np.isin(truth.regime, [NO_IMPACT, PERIODIC, SUSTAINED])
    rows = []
    for cycles in AT_ONCE:
        found = Labels(bench.map(sizes.labels, 2, "_labels_sooner", [f"steady_state.chaos_cycles={cycles}"]).file)
        for name, where in (("no impact is possible, too", found.comes_free), ("impacts go on for ever", ~found.comes_free)):
            called = where & (found.regime == CHAOTIC)
            share = np.mean(settles[called]) if called.any() else 0
            rows.append([str(cycles), name, str(int(called.sum())), _percent(share), f"{np.mean(found.cycles):.1f}"])
    return rows


def _percent(share):
    return f"{100 * share:.2g} %"
