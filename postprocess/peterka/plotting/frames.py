"""Layout of the parts of a picture: a map above its colour bar, legends and a panel; stacked diagrams."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Patch
from matplotlib.textpath import text_to_path
from numpy.typing import NDArray

from .figures import divided, panel, width_of
from .fills import Fill, fill

NOT_COMPUTED_HATCH = {"facecolor": "white", "edgecolor": "#8C8C8C", "hatch": "//////", "linewidth": 0}
MAP_HEIGHT, BAR_HEIGHT, LEGEND_GAP, LEGEND_ROW = 3.15, 0.75, 0.12, 0.165  # in
LETTERS = 8  # pt, of a legend
BAR_MARGIN = 0.5  # in, at both sides of a colour bar's label together: scales at the left move it to the right
KEY_GAP, SPACE, MARGIN = 0.06, 0.14, 0.1  # in: after the key of an entry, between columns, around all entries
PATCH, LINE = 1.4, 2.0  # length of a key over the font size


def legend_patch(label: str, colour: str | Fill | None, hatched: bool = False) -> Patch:
    """A legend entry: a colour, or its Fill in the current palette; `hatched`: not yet computed."""
    if hatched:
        return Patch(label=label, **NOT_COMPUTED_HATCH | {"linewidth": 0.4})
    assert colour is not None
    look = fill(colour)
    if not look.hatch:
        return Patch(facecolor=look.colour, edgecolor="black", linewidth=0.3, label=label)
    return Patch(facecolor=look.colour, edgecolor=look.stroke, linewidth=0.3, label=label, hatch=2 * look.hatch)


def stack(width: float, image: NDArray[Any], legends: Sequence[tuple[Sequence[Artist], int, str | None]], bar: bool = False,
          panel_height: float = 0.0, ax: Axes | None = None) -> tuple[Figure, Axes, Axes | None]:
    """A figure of `width` [in]: a map and, below it, an optional colour bar, the legends, and an optional panel of this
    height [in]; or all of these in the place of `ax`.

    `legends` is a list of (handles, columns, title); empty ones are omitted. Returns the figure, the map's axes and those of
    the bar or the panel (None without). The figure's height follows from its legends, so that all maps have the same size."""
    own, width = width, width_of(width)
    legends = [(handles, columns_that_fit(handles, columns, width, PATCH), title) for handles, columns, title in legends if handles]
    rows = sum(-(-len(handles) // columns) + (title is not None) for handles, columns, title in legends)
    height = (MAP_HEIGHT + panel_height) * width / own + BAR_HEIGHT * bar + LEGEND_GAP * len(legends) + LEGEND_ROW * rows
    shares = [1] + [0.045] * bar + [0.001] * len(legends) + [0.75 * panel_height / MAP_HEIGHT] * (panel_height > 0)
    figure, grid = divided(width, height, ax, len(shares), cells=max(image.shape), height_ratios=shares)
    ax, *below = (panel(figure, grid, row, ax=ax) for row in range(len(shares)))
    for legend_ax, (handles, columns, title) in zip(below[bar:], legends):
        write_legend(legend_ax, handles, columns, title, handlelength=PATCH)
    return figure, ax, (below[0] if bar else below[-1] if panel_height else None)


def diagram(width: float, height: float, handles: Sequence[Artist], panels: int = 1, columns: int = 2,
            ax: Axes | None = None) -> tuple[Figure, list[Axes]]:
    """A figure of `width` [in] with stacked diagrams, `height` [in] in total, sharing the x axis, and a legend below them;
    or all of these in the place of `ax`. Returns the figure and the list of Axes."""
    own, width = width, width_of(width)
    columns = columns_that_fit(handles, columns, width, LINE)
    rows = -(-len(handles) // columns)
    height = height * max(1, width / own) + LEGEND_GAP + LEGEND_ROW * rows
    figure, grid = divided(width, height, ax, panels + 1, height_ratios=[1] * panels + [0.001])
    all_axes = [panel(figure, grid, row, ax=ax) for row in range(panels + 1)]
    for other in all_axes[1:panels]:
        other.sharex(all_axes[0])
    write_legend(all_axes[-1], handles, columns, None, handlelength=LINE)
    return figure, all_axes[:panels]


def write_legend(ax: Axes, handles: Sequence[Artist], columns: int, title: str | None, handlelength: float) -> None:
    """A legend with Axes of its own."""
    ax.axis("off")
    ax.legend(
        handles=handles, ncol=columns, title=title, loc="upper center", bbox_to_anchor=(0.5, 1), borderaxespad=0,
        frameon=False, handlelength=handlelength, handletextpad=0.5, columnspacing=1.2, labelspacing=0.35, borderpad=0,
    )


def columns_that_fit(handles: Sequence[Artist], most: int, width: float, key: float) -> int:
    """The number of columns, at most `most`, in which the entries of a legend fit into this width [in]."""
    widths = [text_width(handle.get_label(), LETTERS, has_mathematics=True) + key * LETTERS / 72 + KEY_GAP for handle in handles]
    for columns in range(min(most, len(handles)), 1, -1):
        taken = [max(column) for column in np.array_split(widths, columns)]  # as a legend deals its entries out
        if sum(taken) + SPACE * (len(taken) - 1) <= width - MARGIN:
            return columns
    return 1


def label_of_bar(label: str, more: str, joint: str, width: float) -> str:
    """The label of a colour bar in a figure of this own `width` [in]: with more words after a joint, or in a second line where one has no
    room for them."""
    whole = f"{label}{joint}{more}"
    fits = text_width(whole, LETTERS, has_mathematics=True) < width_of(width) - BAR_MARGIN
    return whole if fits or not more else f"{label}\n{more}"


def text_width(text: str, size: float, has_mathematics: bool = False) -> float:
    """Width [in] of a text's widest line."""
    def of_line(line: str) -> float:
        is_math = has_mathematics and line.count("$") > 1
        return float(text_to_path.get_text_width_height_descent(line, FontProperties(size=size), ismath=is_math)[0] / 72)

    return max(map(of_line, text.splitlines()), default=0.0)
