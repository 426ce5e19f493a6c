"""Extreme scenes and their outcome with every engine; energy imbalance per period, and the limit of a rigid stop.

A square is coloured by the outcome and carries a mark, so that it is readable in grey; an engine without a result states its
reason as the file's status. Right: the imbalance between drive work and losses per period, a point per scene; and the impact
speed's difference from that on a rigid stop, which decreases as the stiffness to the power -1/2.
"""

import re
from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from ..arrays import Reals, ma
from ..plotting import axes, figures
from ..plotting.picture import picture
from .methods import marker_look
from .study_file import Stability, StudyFile

WIDTH, SQUARES_WIDTH, PANEL_WIDTH = 7.2, 3.2, 1.7  # in; the rest is for names and numbers beside them
ROW_HEIGHT, LEAST_HEIGHT, PANEL_HEIGHT, AROUND_HEIGHT = 0.132, 5.0, 1.8, 0.6  # in
SMALLEST = 1e-17


@dataclass(frozen=True)
class Outcome:
    """Look of an engine's outcome in a scene: its words, its colour '#RRGGBB', the letter in its square."""

    label: str
    colour: str
    mark: str


OUTCOMES = {
    "agrees": Outcome("agrees", "#5BB89A", "✓"),
    "says_why_not": Outcome("says why not", "#F5E79B", "?"),
    "wrong": Outcome("wrong", "#9E1B1B", "✗"),
    "not_for_this_scene": Outcome("not for this scene", "#EDEDED", "–"),
}
_NAMES = list(OUTCOMES)


@picture(StudyFile)
def draw(file: StudyFile, ax: Axes | None = None) -> list[Axes] | None:
    """The squares and the two diagrams of a study of stability as a list of Axes; None without any outcome."""
    table = file.table
    if not np.any(table.outcome != ""):
        return None
    body = max(LEAST_HEIGHT, ROW_HEIGHT * len(table.scene))
    figure, grid = figures.divided(WIDTH, AROUND_HEIGHT + body, ax, 1, 2, width_ratios=[SQUARES_WIDTH, PANEL_WIDTH])
    squares = figures.panel(figure, grid, ax=ax)
    right = grid[0, 1].subgridspec(3, 1, height_ratios=[PANEL_HEIGHT, PANEL_HEIGHT, body - 2 * PANEL_HEIGHT])
    _draw_squares(squares, table, SQUARES_WIDTH / len(table.engine))
    imbalance, rigid_limit, legend_ax = (figure.add_subplot(right[row]) for row in range(3))
    _draw_imbalance(imbalance, table)
    _draw_rigid_limit(rigid_limit, table)
    legend_ax.axis("off")
    legend_ax.legend(handles=_legend_entries(table), loc="upper center", title="results (number)", frameon=False,
                     fontsize=7, borderaxespad=0, handlelength=1.4)
    axes.write_title(figure, file, axes.so_far(file).strip(), squares)
    return [squares, imbalance, rigid_limit]


def scene_name(word: str) -> str:
    """A scene's name in words: 'frequency 0.01' for frequency_0_01."""
    return re.sub(r"(?<=\d)_(?=\d)", ".", word).replace("_", " ")


def status_word(table: Stability, scene: int, engine: int) -> str:
    """Why there is no result, in words."""
    word = table.status[scene, engine]
    word = table.regime[scene, engine] if word in ("", "verified", "proved") else word
    text: str = word.replace("_", " ")
    return text


def fitted_slope(stiffness: Reals, difference: Reals) -> tuple[float, float] | None:
    """(slope, intercept) of ln |difference| over ln stiffness by least squares over the stiffer half of the rungs, as the
    power law is asymptotic. None with fewer than 2 points."""
    usable = (stiffness > 0) & np.isfinite(stiffness) & (np.abs(difference) > 0) & np.isfinite(difference)
    usable &= stiffness >= np.median(stiffness) if len(stiffness) else usable
    if np.sum(usable) < 2 or np.ptp(stiffness[usable]) == 0:
        return None
    slope, intercept = np.polyfit(np.log(stiffness[usable]), np.log(np.abs(difference[usable])), 1)
    return float(slope), float(intercept)


def _draw_squares(ax: Axes, table: Stability, engine_width: float) -> None:
    numbers = np.array([[_NAMES.index(name) if name in OUTCOMES else -1 for name in row] for row in table.outcome])
    axes.hatch_background(ax)
    ax.pcolormesh(ma.masked_less(numbers, 0), cmap=ListedColormap([entry.colour for entry in OUTCOMES.values()]),
                  vmin=-0.5, vmax=len(OUTCOMES) - 0.5, edgecolors="white", linewidth=0.6)
    ax.invert_yaxis()
    for (row, column), number in np.ndenumerate(numbers):
        if number >= 0:
            _write_mark(ax, row, column, _NAMES[number], table, engine_width)
    ax.set_yticks(np.arange(len(table.scene)) + 0.5, [scene_name(name) for name in table.scene], fontsize=6.5)
    ax.set_xticks(np.arange(len(table.engine)) + 0.5, [name.replace("_", "\n") for name in table.engine], fontsize=8)
    ax.xaxis.tick_top()
    ax.tick_params(length=0)


def _write_mark(ax: Axes, row: int, column: int, name: str, table: Stability, engine_width: float) -> None:
    text, size, weight = OUTCOMES[name].mark, 7.0, "bold"
    if name == "says_why_not":
        text, weight = status_word(table, row, column) or text, "normal"
        size = min(6.5, 72 * engine_width / (0.7 * len(text)))
    ax.text(column + 0.5, row + 0.53, text, ha="center", va="center", fontsize=size, weight=weight, parse_math=False,
            color=axes.letter_colour(OUTCOMES[name].colour))


def _legend_entries(table: Stability) -> list[Artist]:
    entries = [axes.legend_patch(f"{entry.mark}  {entry.label} ({np.sum(table.outcome == name)})", entry.colour)
               for name, entry in OUTCOMES.items()]
    if np.any(table.outcome == ""):
        entries.append(axes.legend_patch("not computed yet", None, hatched=True))
    return entries


def _draw_imbalance(ax: Axes, table: Stability) -> None:
    """A row of points for each engine."""
    for number, engine in enumerate(table.engine):
        imbalance = np.abs(table.energy_imbalance[:, number])
        imbalance = np.maximum(imbalance[np.isfinite(imbalance)], SMALLEST)
        spread = 0.18 * np.sin(12.9898 * np.arange(len(imbalance)))  # points of equal height would overlap
        ax.plot(imbalance, number + spread, **marker_look(engine) | {"markersize": 3.2, "markeredgewidth": 0.3})
    axes.log_scale(ax, "x")
    ax.grid(axis="y", visible=False)
    ax.set_ylim(len(table.engine) - 0.5, -0.5)
    ax.set_yticks(range(len(table.engine)), table.engine, fontsize=6.5)
    ax.set_xlabel("energy imbalance\nof a period (relative)", fontsize=8)
    if not np.isfinite(table.energy_imbalance).any():
        _say(ax, "not measured")


def _draw_rigid_limit(ax: Axes, table: Stability) -> None:
    difference = np.abs(table.speed_difference)
    fit = fitted_slope(table.contact_stiffness, table.speed_difference)
    ax.set_xlabel("stiffness $k_i/k$", fontsize=8)
    ax.set_ylabel("speed less rigid\nstop's ($A_0\\omega$)", fontsize=8)
    if fit is None:
        return _say(ax, "not measured")
    usable = (difference > 0) & np.isfinite(difference)
    stiffness = table.contact_stiffness[usable]
    line = np.exp(fit[1]) * stiffness ** fit[0]
    ax.plot(stiffness, line, color="#767676", linewidth=1.0, linestyle="--")
    ax.plot(stiffness, difference[usable], marker="o", linestyle="none", markersize=4, color="black")
    axes.log_scale(ax, "x", "y")
    text = f"slope {fit[0]:.3f}\nin theory −0.5".replace("-", "−")
    ax.text(0.95, 0.93, text, transform=ax.transAxes, ha="right", va="top", fontsize=7)


def _say(ax: Axes, text: str) -> None:
    ax.set_xticks([])
    ax.set_yticks([])
    ax.text(0.5, 0.5, text, transform=ax.transAxes, ha="center", va="center", fontsize=8)
