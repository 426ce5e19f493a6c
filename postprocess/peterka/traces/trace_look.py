"""Shared by the pictures of a trace: line styles, and axes in mm, N and seconds."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..files.regimes import CHAOTIC, FAILED, NO_IMPACT, PERIODIC, SUSTAINED_CONTACT, UNRESOLVED, reason
from ..plotting import axes, style, units
from .trace_file import TraceFile

SAME = 1e-3  # of the steady peak: an impact harder than by that belongs to the way to it
HAMMER, CART, STOP, FORCE = "#0B5FA5", "#C65F00", "#7A7A7A", "#A3123F"
HAMMER_LINE = {"color": HAMMER, "linewidth": 1.0}
CART_LINE = {"color": CART, "linewidth": 0.9, "linestyle": (0, (5, 2))}
STOP_LINE = {"color": STOP, "linewidth": 0.8, "linestyle": (0, (1, 1.5))}
FORCE_LINE = {"color": FORCE, "linewidth": 1.0}
STEM = {"color": FORCE, "linewidth": 0.8}
ACCELERATION_LINE = {"color": HAMMER, "linewidth": 0.8}


def displacement(file: TraceFile, ratio: Any) -> tuple[Any, str]:
    """(values, label unit) of ratios, scalar or array, in mm if the file gives the amplitude."""
    in_mm = file.millimetres and style.current().units != "ratio"
    return (ratio * file.millimetres, "mm") if in_mm else (ratio, "$A_0$")


def force(file: TraceFile, ratio: Any) -> tuple[Any, str]:
    """(values, label unit) of ratios, scalar or array, in N if the file gives the mass; all pictures of a trace use the same prefix."""
    factor, unit = _force_scale(file)
    return factor * ratio, unit


def _force_scale(file: TraceFile) -> tuple[float, str]:
    if not file.newtons or style.current().units == "ratio":
        return 1.0, "$mg$"
    forces = [file.motion["force_ratio"]] + ([] if file.impacts is None else [file.impacts["peak_force_ratio"]])
    largest = max(float(np.max(np.nan_to_num(values), initial=0)) for values in forces)
    factor, unit = units.with_prefix(largest * file.newtons, "N")
    return factor * file.newtons, unit


def strikes_rigid_stop(file: TraceFile) -> bool:
    """Whether no impact has a force at first touch, be it 0."""
    return file.impacts is not None and bool(np.all(np.isnan(file.impacts["touch_force_ratio"])))


def second_force_scale(ax: Axes, file: TraceFile) -> None:
    """A scale of F/mg to the right of a scale in N."""
    if file.newtons and style.current().units == "both":
        weight = _force_scale(file)[0]
        right = ax.secondary_yaxis("right", functions=(lambda force: force / weight, lambda ratio: ratio * weight))
        right.set_ylabel("$F/(mg)$", fontsize=8)


def grid(ax: Axes) -> None:
    """A pale grid behind all lines."""
    ax.grid(color="#DDDDDD", linewidth=0.5)
    ax.set_axisbelow(True)


def place(file: TraceFile) -> str:
    """Where in the plane the trace is, for a title."""
    hertz, gap, shown = file.excitation_hz, file.number("gap_ratio"), style.current().units
    ratio = f"Ω/ω = {file.number('frequency_ratio'):.4g}" if hertz else ""
    in_hertz = f"{hertz:.4g} Hz" if hertz else ""
    parts = [{"si": in_hertz, "ratio": ratio}.get(shown, f"{in_hertz} ({ratio})") if hertz else "cart at rest"]
    if gap is not None:
        parts.append(f"gap {gap * file.millimetres:.3g} mm" if file.millimetres and shown != "ratio" else f"gap/A₀ = {gap:.4g}")
    return ", ".join(parts)


def write_title(figure: Figure, file: TraceFile, extra: str = "", ax: Axes | None = None) -> None:
    """Writes the title, with the trace's operating point and the proof of its regime below the file's title."""
    axes.write_title(figure, file, "\n".join(filter(None, [place(file), claim(file), extra])), ax)


def peaks(file: TraceFile) -> str:
    """Whether the hardest impact shown is that of the steady motion, or of the way to it, in one line; empty if the file doesn't tell."""
    if file.cell is None or file.impacts is None or file.cell["regime"] != PERIODIC or file.steady_peak is None:
        return ""
    hardest = float(np.nanmax(file.impacts["peak_force_ratio"], initial=0.0))
    (shown, unit), (steady, _) = (force(file, np.float64(value)) for value in (hardest, file.steady_peak))
    if np.isnan(file.impacts["peak_force_ratio"]).any() and hardest < file.steady_peak * (1 - SAME):  # one that the trace's end cuts may be harder
        return f"peak of the steady motion {steady:.4g} {unit}"
    if hardest > file.steady_peak * (1 + SAME):
        return f"hardest impact {shown:.4g} {unit}, on the way to the steady motion, whose peak is {steady:.4g} {unit}"
    if hardest >= file.steady_peak * (1 - SAME):
        return f"hardest impact {shown:.4g} {unit}: the peak of the steady motion"
    return f"hardest impact {shown:.4g} {unit}; peak of the steady motion {steady:.4g} {unit}"


def claim(file: TraceFile) -> str:
    """Regime, z, and the proof behind them, in one line; empty if the file does not give them."""
    cell = file.cell
    if cell is None:
        return ""
    cycles = f"{cell['observed_cycles']:,}"
    q = f"{cell['period']} cycle{'s' * (cell['period'] != 1)}"
    proof = {
        NO_IMPACT: "no impact: what is left of the free motion can't reach the stop",
        PERIODIC: f"z = {cell['impacts']}/{cell['period']}: repeats after {q}, stable (multipliers within "
                  f"{cell['multiplier']:.3g})",
        CHAOTIC: f"chaotic for {cycles} cycles: errors grow (exponent {cell['lyapunov']:.3g} per cycle)",
        SUSTAINED_CONTACT: "sustained contact: what is left of the motion can't separate the hammer",
        UNRESOLVED: f"unresolved after {cycles} cycles: {reason(cell['status'])}",
        FAILED: f"failed: {reason(cell['status'])}",
    }
    return proof.get(cell["regime"], "")
