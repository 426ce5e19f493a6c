"""Errors of a recording's channels that are no error of the rig: fitted with it where the recording shows them.

A channel may come later than another, as those of a multiplexed logger or of a sensor with a filter of its own do; its offset may
drift; and it may hum with the mains. Delays are fitted wherever there are two signals, since even a part of a sample would move the numbers
by more than their errors; drift and hum where they are seen. The model of a signal s is then, with the offset b, the range R and the recording's length T,

    s(t - delay) + b + R (drift t/T + hum_cos cos(2 pi f t) + hum_sin sin(2 pi f t)),   f near 50 or 60 Hz

Delays are those against the first of force, acceleration and displacement that was recorded.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..arrays import Reals
from .problem import SHARP, Problem
from .recording import Recording
from .solve import Solved, converged

MAINS = (50.0, 60.0)  # Hz
MAINS_ERROR = 0.1  # Hz
SURE, MAYBE = 3.0, 2.0  # standard errors from which drift and hum count as seen, and from which they are looked at closely
MOST_LOOKED_AT, MOST_CALMED = 200_000, 2_000_000  # samples; of longer recordings, drift and hum are left in when impacts are looked for
CALM_ROUNDS, STANDS_OUT = 8, 4.0  # standard deviations
TRIED = 2  # fits, the best ones
CLOSE = 4.0  # times the sum of squares per residual of the best: fits beyond are of other minima and aren't solved again
NAMES = (*SHARP, "displacement")


def calmed(recording: Recording) -> Recording:
    """The same with the force's drift and hum taken away, as it shows them between impacts, where it would be constant: to find impacts by."""
    if "force" not in recording.signals or recording.count > MOST_CALMED:
        return recording
    values = recording.signals["force"]
    some = np.arange(0, recording.count, max(1, recording.count // MOST_LOOKED_AT))
    seen = np.asarray(values[some], dtype=float)
    best = min((_calm(some / recording.count, recording.step * some, seen, mains) for mains in MAINS), key=lambda one: one[1])
    answer, rest, count, mains = best
    is_seen = np.hypot(*answer[2:]) > SURE * rest * np.sqrt(2 / count) or abs(answer[1]) > SURE * rest * np.sqrt(12 / count)
    if not rest > 0 or not is_seen:
        return recording
    every = np.arange(recording.count)
    shown = _waves(every / recording.count, recording.step * every, mains)[:, 1:] @ answer[1:]
    return replace(recording, signals={**recording.signals, "force": values - shown})


def _calm(share: Reals, time: Reals, seen: Reals, mains: float) -> tuple[Reals, float, int, float]:
    """(offset, drift, cosine and sine at this frequency [Hz], root mean square of the rest, its samples, the frequency), without samples that stand
    out, as those of impacts do."""
    matrix, kept = _waves(share, time, mains), np.isfinite(seen)
    answer, rest = np.zeros(4), np.inf
    for _ in range(CALM_ROUNDS):
        answer = np.linalg.lstsq(matrix[kept], seen[kept], rcond=None)[0]
        left = np.abs(seen - matrix @ answer)
        rest = 1.4826 * float(np.nanmedian(left))
        if not rest > 0:  # a force of exactly 0 between impacts
            break
        kept = left < STANDS_OUT * rest
    return answer, rest, int(kept.sum()), mains


def _waves(share: Reals, time: Reals, mains: float) -> Reals:
    angle = 2 * np.pi * mains * time
    return np.transpose([np.ones(len(time)), share - 0.5, np.cos(angle), np.sin(angle)])


def with_channels(found: Sequence[Solved]) -> list[Solved]:
    """The same fits of a recording, best first, with the errors of channels that the best of them show."""
    shown = [one for one in (_shown(other) for other in found[:TRIED]) if one is not None]
    if not shown:
        return list(found)
    best = min(shown, key=lambda one: one.per_row)
    others = [one for one in (converged(_like(other.problem, best.problem), other.value) for other in found
                              if other.per_row < CLOSE * found[0].per_row) if one is not None]
    return sorted([best, *others], key=lambda one: one.per_row)


def without_channels(recording: Recording, found: Solved) -> Recording | None:
    """The same with the drift and hum of its displacement, by a fit of it as one leg, taken away, and its delay up to a sample; None where a recording so long
    has these."""
    problem, name = found.problem, "displacement"
    is_shifted = any(f"{part}_{name}" in problem.channels for part in ("drift", "hum_cos"))
    late = round(problem.delay(found.value, name) / recording.step)
    if name not in problem.names or not is_shifted and not late:
        return recording
    if recording.count > MOST_CALMED:
        return None
    values = np.asarray(recording.signals[name], dtype=float)
    if is_shifted:
        time = recording.step * np.arange(recording.count)
        values = values - problem.base(found.value, 0, name, time) + problem.base(found.value, 0, name, np.zeros(1))
    if late:
        moved = np.full(recording.count, np.nan)
        moved[max(0, -late):recording.count - max(0, late)] = values[max(0, late):recording.count - max(0, -late)]
        values = moved
    return replace(recording, signals={**recording.signals, name: values})


def told_by_flights(problem: Problem) -> list[str]:
    """Those of a Problem's errors of channels that flights alone tell: a force is 0 there, so that nothing is late against it."""
    in_flight = [name for name in NAMES if name in problem.names and name != "force"]
    kept = {f"delay_{name}" for name in in_flight[1:]}
    return [name for name in problem.channels if not name.startswith("delay_") or name in kept]


def reference(problem: Problem) -> str:
    """The signal against which delays are."""
    return next(name for name in NAMES if name in problem.names and not (problem.unseen and name == "force"))


def with_all_channels(problem: Problem, mains: float) -> Problem:
    """The same with all errors that its channels may have, hum at mains of this frequency [Hz]."""
    return _with(problem, [*_delays(problem), *_others(problem)], mains)


def glimpsed(found: Solved) -> Solved | None:
    """After one step from a fit without them, the Solved with all errors that its channels may have, at the likelier of both mains; None where that
    doesn't converge."""
    tried = [one for mains in MAINS if (one := converged(with_all_channels(found.problem, mains), found.value, most=2, rounds=1)) is not None]
    return min(tried, key=lambda one: one.per_row) if tried else None


def _delays(problem: Problem) -> list[tuple[str, ...]]:
    return [(f"delay_{name}",) for name in NAMES if name in problem.names and name != reference(problem)]


def _others(problem: Problem) -> list[tuple[str, ...]]:
    if problem.pushed:  # single impacts have an offset of their own each
        return []
    return [(f"drift_{name}",) for name in problem.names] + [(f"hum_cos_{name}", f"hum_sin_{name}") for name in problem.names]


def _shown(found: Solved) -> Solved | None:
    """The Solved with delays, and with the other errors of channels that it shows; None where there are none, and none were fitted."""
    problem = found.problem
    delays, others = _delays(problem), _others(problem)
    seen_in = found if problem.channels else glimpsed(found) if others else None
    kept, mains, value = ([], problem.mains, found.value) if seen_in is None else (
        _seen(seen_in, others, MAYBE), seen_in.problem.mains, seen_in.value)
    while delays or kept or problem.channels:
        best = converged(_with(problem, delays + kept, mains), value)
        if best is None or len(seen := _seen(best, kept, SURE)) == len(kept):
            return best
        kept, value = seen, best.value
    return None


def _with(problem: Problem, errors: Sequence[tuple[str, ...]], mains: float) -> Problem:
    """The same with these errors of channels."""
    hums = any(len(names) > 1 for names in errors)
    return replace(problem, channels=[*(name for names in errors for name in names), *(["hum_hertz"] if hums else [])], mains=mains,
                   prior=_priors(problem, hums))


def _seen(found: Solved, errors: Sequence[tuple[str, ...]], sure: float) -> list[tuple[str, ...]]:
    """Those that are larger than so many standard errors."""
    wide = sure * float(np.sqrt(max(found.per_row, 1.0)))
    return [names for names in errors if any(abs(found.value[name]) > wide * found.error(name) for name in names)]


def _like(problem: Problem, other: Problem) -> Problem:
    return replace(problem, channels=other.channels, mains=other.mains, prior=_priors(problem, "hum_hertz" in other.channels))


def _priors(problem: Problem, hums: bool) -> dict[str, tuple[float, float]]:
    kept = {name: prior for name, prior in problem.prior.items() if name != "hum_hertz"}
    return {**kept, "hum_hertz": (0.0, MAINS_ERROR)} if hums else kept
