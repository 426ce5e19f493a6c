"""A sketch of the rig with its coordinates and sign conventions, as used in jobs, files and pictures.

    python3 -m peterka.rig_sketch OUT.png
"""

import sys
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Rectangle

from .plotting.figures import new_figure, save
from .plotting.style import using

WIDTH, HEIGHT = 5.2, 2.03  # in
METAL, AIR = "#C9D3DC", "white"
CART = [(0.5, 0.9, 6.6, 0.3), (0.5, 1.2, 0.3, 1.7), (6.8, 1.2, 0.3, 1.7)]  # x, y, width, height: floor, wall and stop
HAMMER = (3.2, 1.55, 1.5, 0.9)


def draw() -> Figure:
    """The sketch as a Figure."""
    with using():
        figure = new_figure(WIDTH, HEIGHT)
        figure.set_layout_engine("none")
        ax = figure.add_axes((0, 0, 1, 1))
        ax.set(xlim=(0, 10), ylim=(0.4, 4.3), aspect="equal")
        ax.axis("off")
        for x, y, width, height in (*CART, HAMMER):
            ax.add_patch(Rectangle((x, y), width, height, facecolor=METAL, edgecolor="black", linewidth=0.9))
        _spring(ax, 0.8, 3.2, 2.2, r"$k,\ k_3$")
        _damper(ax, 0.8, 3.2, 1.75, "$c$")
        _spring(ax, 5.9, 6.8, 2.2, "$k_i$")
        _damper(ax, 5.9, 6.8, 1.75, "$c_i$")
        ax.plot([5.9, 5.9], [1.55, 2.45], color="black", linewidth=1.6)
        ax.text(3.95, 2.0, "hammer $m$", ha="center", va="center", fontsize=8)
        ax.text(2.4, 1.05, "cart", ha="center", va="center", fontsize=8)
        ax.text(6.95, 3.05, "stop", ha="center", va="bottom", fontsize=8)
        _measure(ax, 4.7, 5.9, 2.75, "gap (at $u=0$)")
        _arrow(ax, 3.95, 4.95, 3.45, "$x$: hammer, seen from the ground", 2.45)
        _arrow(ax, 0.65, 1.65, 3.45, "$y=A_0\\,\\sin\\,\\Omega t$: cart", 2.9)
        _arrow(ax, 4.7, 3.9, 1.35, "$F$ on hammer", None)
        ax.text(7.35, 2.35, "$u = x - y$:\nhammer, seen from the cart\n\n$\\delta = u - \\mathrm{gap}$:\npenetration\n\n"
                            "all positive to the right,\nvelocities, too", va="center", fontsize=6.5)
        ax.plot([0.2, 9.8], [0.655, 0.655], color="black", linewidth=0.8)
        for wheel in (1.4, 6.2):
            ax.plot(wheel, 0.75, marker="o", markersize=6, markerfacecolor=AIR, markeredgecolor="black", markeredgewidth=0.9)
        return figure


def _arrow(ax: Axes, start: float, end: float, y: float, words: str, foot: float | None) -> None:
    ax.add_patch(FancyArrowPatch((start, y), (end, y), arrowstyle="-|>", mutation_scale=9, linewidth=1.1, color="black",
                                 shrinkA=0, shrinkB=0))
    if foot is not None:  # a line up from the part that the arrow measures
        ax.plot([start, start], [foot, y + 0.15], color="black", linewidth=0.6, linestyle=(0, (3, 2)))
        ax.text(start, y + 0.25, words, ha="left", va="bottom", fontsize=7)
    else:
        ax.text(start + 0.1, y, words, ha="left", va="center", fontsize=6)


def _measure(ax: Axes, low: float, high: float, y: float, words: str) -> None:
    ax.add_patch(FancyArrowPatch((low, y), (high, y), arrowstyle="<|-|>", mutation_scale=7, linewidth=0.8, color="black",
                                 shrinkA=0, shrinkB=0))
    for x in (low, high):
        ax.plot([x, x], [2.45, y + 0.1], color="black", linewidth=0.5)
    ax.text((low + high) / 2, y + 0.1, words, ha="center", va="bottom", fontsize=7)


def _spring(ax: Axes, low: float, high: float, y: float, words: str) -> None:
    turns = 13
    x = [low, *(low + (high - low) * (0.15 + 0.7 * n / (turns - 1)) for n in range(turns)), high]
    ax.plot(x, [y, *(y + 0.12 * (0 if n in (0, turns - 1) else (-1) ** n) for n in range(turns)), y], color="black", linewidth=0.9)
    ax.text((low + high) / 2, y + 0.16, words, ha="center", va="bottom", fontsize=6.5)


def _damper(ax: Axes, low: float, high: float, y: float, words: str) -> None:
    middle, half, wide = (low + high) / 2, 0.1, 0.12 * (high - low)
    ax.plot([low, middle], [y, y], color="black", linewidth=0.9)
    ax.plot([middle, middle], [y - 0.7 * half, y + 0.7 * half], color="black", linewidth=0.9)
    ax.plot([middle - wide, middle + wide, middle + wide, middle - wide], [y - half, y - half, y + half, y + half], color="black", linewidth=0.9)
    ax.plot([middle + wide, high], [y, y], color="black", linewidth=0.9)
    ax.text((low + high) / 2, y - 0.12, words, ha="center", va="top", fontsize=6.5)


if __name__ == "__main__":
    save(draw(), Path(sys.argv[1]))
