"""What every picture shares: figure and fonts, cells on axes, second scales, legend, notices, writing a picture.

Axes are ratios in the paper's notation; a second scale gives Hz and mm where the file knows them. Cells are drawn as
they are, without interpolation, between their borders: linear or logarithmic. Sizes are for one journal column.
"""

import os

import matplotlib

matplotlib.use("Agg")

import matplotlib.patheffects as patheffects
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import NullFormatter, NullLocator

from .linear_ticks import LinearNumbers, LinearTicks
from .log_ticks import LogNumbers, LogTicks
from .titles import write_title  # noqa: F401: a piece every picture shares

LABELS = {
    "frequency_ratio": r"$\Omega/\omega$",
    "gap_ratio": r"$\mathrm{gap}/A_0$",
    "displacement_ratio": r"$x/A_0$",
    "velocity_ratio": r"$\dot{x}/(A_0\omega)$",
}
STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.titlesize": 9,
    "axes.labelsize": 9,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "legend.fontsize": 8,
    "legend.title_fontsize": 8,
    "hatch.linewidth": 0.5,
    "mathtext.fontset": "dejavusans",
    "pdf.fonttype": 42,
    "agg.path.chunksize": 20000,
}
NOT_COMPUTED_HATCH = {"facecolor": "white", "edgecolor": "#8C8C8C", "hatch": "//////", "linewidth": 0}
COARSE_DPI, FINE_DPI, FINE_FROM = 300, 600, 800  # a map of more than FINE_FROM cells a side needs the finer raster
MAP_HEIGHT, BAR_HEIGHT, LEGEND_GAP, LEGEND_ROW = 3.15, 0.75, 0.12, 0.165  # in
LETTER_SHARE = 0.033  # width of a 9 pt letter over the width of the map
GREY_BOUNDARY = 0.35  # relative luminance above which black letters read better than white ones


def new_figure(width, height, cells=1):
    """A Figure [in x in] in the common style, with a raster fine enough for so many cells along a side."""
    matplotlib.rcParams.update(STYLE)
    dpi = COARSE_DPI if cells <= FINE_FROM else FINE_DPI
    figure = Figure(figsize=(width, height), dpi=dpi, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def label_axes(ax, file):
    """Axis labels and scales; on top and at the right in Hz, mm and m/s where the file gives frequency and amplitude."""
    for axis, ticks, which in ((file.columns, ax.xaxis, "x"), (file.rows, ax.yaxis, "y")):
        getattr(ax, f"set_{which}label")(LABELS[axis.name])
        getattr(ax, f"set_{which}scale")("log" if axis.log else "linear")
        getattr(ax, f"set_{which}lim")(axis.edges[0], axis.edges[-1])
        _set_ticks(ticks, axis.log)
    top, right = (_second_scale(file, axis.name) for axis in (file.columns, file.rows))
    if top:
        scale = ax.secondary_xaxis("top", functions=scale_functions(top[1]))
        scale.set_xlabel(top[0], fontsize=8)
        _set_ticks(scale.xaxis, file.columns.log)
    if right:
        scale = ax.secondary_yaxis("right", functions=scale_functions(right[1]))
        scale.set_ylabel(right[0], fontsize=8)
        _set_ticks(scale.yaxis, file.rows.log)


def _second_scale(file, name):
    """(label, factor from the ratios of this axis) of its scale in SI units; None where the file doesn't tell."""
    hertz, metres = file.positive("natural_frequency_hz"), file.positive("cart_amplitude_m")
    if name == "frequency_ratio":
        return ("excitation frequency (Hz)", hertz) if hertz else None
    if name == "velocity_ratio":
        return (r"$\dot{x}$ (m/s)", 2 * np.pi * hertz * metres) if hertz and metres else None
    label = "gap (mm)" if name == "gap_ratio" else "$x$ (mm)"
    return (label, 1000 * metres) if metres else None


def _set_ticks(ticks, log):
    """Round, plain numbers; on a logarithmic axis as many of 1, 2, 5, 10, ... as have room."""
    if log:
        ticks.set_major_locator(LogTicks())
        ticks.set_major_formatter(LogNumbers())
        ticks.set_minor_formatter(NullFormatter())
    else:
        ticks.set_major_locator(LinearTicks())
        ticks.set_major_formatter(LinearNumbers())


def scale_functions(factor):
    """Of a second scale: from ratios to so many units each, and back."""
    return (lambda ratio: ratio * factor), (lambda value: value / factor)


def show_classes(ax, reduced, colours, not_computed):
    """Draws class numbers (rows, columns) in their colours; the class `not_computed` is left open over a hatch."""
    hatch_background(ax)
    shown = np.ma.masked_equal(reduced.image, not_computed)
    ax.pcolormesh(
        reduced.column_edges, reduced.row_edges, shown,
        cmap=ListedColormap(colours), vmin=-0.5, vmax=len(colours) - 0.5, rasterized=True,
    )


def hatch_background(ax):
    """Hatches the whole plane: what nothing is drawn over is not computed yet."""
    ax.patch.set(**NOT_COMPUTED_HATCH)


def legend_patch(label, colour, hatched=False):
    if hatched:
        return Patch(label=label, **NOT_COMPUTED_HATCH | {"linewidth": 0.4})
    return Patch(facecolor=colour, edgecolor="black", linewidth=0.3, label=label)


def stack(width, image, legends, bar=False, panel=0.0):
    """A figure of `width` [in]: a map and, below it, a colour bar if asked for, the legends, and a panel of this height
    [in] if asked for.

    `legends` is a list of (handles, columns, title); empty ones are left out. Returns the figure, the map's axes and
    those of the bar or the panel (None without). The figure is as high as its legends need, so all maps have the same
    size."""
    legends = [legend for legend in legends if legend[0]]
    rows = sum(-(-len(handles) // columns) + (title is not None) for handles, columns, title in legends)
    height = MAP_HEIGHT + BAR_HEIGHT * bar + LEGEND_GAP * len(legends) + LEGEND_ROW * rows + panel
    figure = new_figure(width, height, max(image.shape))
    shares = [1] + [0.045] * bar + [0.001] * len(legends) + [0.75 * panel / MAP_HEIGHT] * (panel > 0)
    ax, *below = figure.subplots(len(shares), 1, squeeze=False, gridspec_kw={"height_ratios": shares})[:, 0]
    for legend_ax, (handles, columns, title) in zip(below[bar:], legends):
        legend_ax.axis("off")
        legend_ax.legend(
            handles=handles, ncol=columns, title=title, loc="upper center", bbox_to_anchor=(0.5, 1), borderaxespad=0, frameon=False, handlelength=1.4,
            handletextpad=0.5, columnspacing=1.2, labelspacing=0.35, borderpad=0,
        )
    return figure, ax, (below[0] if bar else below[-1] if panel else None)


def diagram(width, height, handles, panels=1, columns=2):
    """A figure of `width` [in] with diagrams above each other, `height` [in] together, of one x axis, and a legend
    below them. Returns the figure and the Axes, a list where there are several."""
    rows = -(-len(handles) // columns)
    figure = new_figure(width, height + LEGEND_GAP + LEGEND_ROW * rows)
    all_axes = figure.subplots(panels + 1, 1, gridspec_kw={"height_ratios": [1] * panels + [0.001]})
    for ax in all_axes[1:panels]:
        ax.sharex(all_axes[0])
    all_axes[-1].axis("off")
    all_axes[-1].legend(
        handles=handles, ncol=columns, loc="upper center", bbox_to_anchor=(0.5, 1), borderaxespad=0, frameon=False,
        handlelength=2.0, handletextpad=0.5, columnspacing=1.2, labelspacing=0.35, borderpad=0,
    )
    return figure, (all_axes[0] if panels == 1 else list(all_axes[:panels]))


def percent(share):
    """A share 0..1 for a legend; neither 0 % nor 100 % unless it is exactly that."""
    value = 100 * share
    if 0 < value < 0.1:
        return "< 0.1 %"
    if 99.9 < value < 100:
        return "> 99.9 %"
    return f"{value:.1f} %"


def operating_point(file):
    """Where in the map a basin lies, as text; empty for a map."""
    frequency_ratio, gap_ratio = file.positive("frequency_ratio"), file.number("gap_ratio")
    if frequency_ratio is None or gap_ratio is None:
        return ""
    return f"Ω/ω = {frequency_ratio:.4g}, gap/A₀ = {gap_ratio:.4g}"


def notice_incomplete(ax, file):
    """Writes into the picture that, and how much of, the map is missing."""
    if file.computed < 1:
        ax.text(
            0.03, 0.97, incomplete_text(file), transform=ax.transAxes, va="top", ha="left", weight="bold",
            bbox={"facecolor": "white", "edgecolor": "black", "linewidth": 0.6, "boxstyle": "square,pad=0.4"},
            zorder=10,
        )


def so_far(file):
    """The same for a title."""
    return f"{incomplete_text(file)}\n" if file.computed < 1 else ""


def incomplete_text(file):
    return f"incomplete: {np.floor(1000 * file.computed) / 10:.1f} % computed"


def log_scale(ax, *sides):
    """Makes the sides "x" or "y" of a diagram logarithmic, with few, plain ticks and a pale grid."""
    for side in sides:
        getattr(ax, f"set_{side}scale")("log")
        axis = getattr(ax, f"{side}axis")
        axis.set_major_locator(LogTicks())
        axis.set_major_formatter(LogNumbers())
        axis.set_minor_locator(NullLocator())
    ax.grid(color="#DDDDDD", linewidth=0.5)
    ax.set_axisbelow(True)


def name_areas(ax, reduced, names):
    """Writes a class's name into its largest rectangle, where that is large enough to hold it.

    `names` maps a class number of the image to (text, colour of the class)."""
    for number, (text, colour) in names.items():
        window = _largest_window(reduced.image == number, LETTER_SHARE * len(text))
        if window is not None:
            (left, right), (low, high) = window
            xs, ys = reduced.column_edges[[left, right]], reduced.row_edges[[low, high]]
            middle = ax.transAxes.inverted().transform(ax.transData.transform(np.column_stack([xs, ys]))).mean(axis=0)
            ax.text(*middle, text, transform=ax.transAxes, ha="center", va="center", fontsize=9,
                    color=letter_colour(colour), path_effects=outline(2, colour))


def letter_colour(background):
    red, green, blue = (value**2.2 for value in to_rgb(background))
    return "black" if 0.2126 * red + 0.7152 * green + 0.0722 * blue > GREY_BOUNDARY else "white"


def _largest_window(mask, smallest, purity=0.97):
    """The largest window, in the proportions of the whole, of which the share `purity` is True.

    Returns its borders ((left, right), (low, high)) in cells; None if it is below `smallest` of the whole's sides."""
    total = np.zeros(np.add(mask.shape, 1), dtype=np.int64)
    total[1:, 1:] = mask.cumsum(axis=0).cumsum(axis=1)
    found = None
    low, high = smallest, 1.0
    for _ in range(8):
        share = low if found is None else (low + high) / 2
        height, width = (max(1, round(share * size)) for size in mask.shape)
        inside = total[height:, width:] - total[:-height, width:] - total[height:, :-width] + total[:-height, :-width]
        row, column = np.unravel_index(inside.argmax(), inside.shape)
        if inside[row, column] >= purity * height * width:
            found, low = ((column, column + width), (row, row + height)), share
        elif found is None:
            return None
        else:
            high = share
    return found


def outline(width=2.0, colour="white"):
    """Path effect: a halo that keeps a line or letter legible on any colour."""
    return [patheffects.withStroke(linewidth=width, foreground=colour)]


def save(figure, path):
    """Writes a finished picture in the format of its suffix; an interrupted one never passes for a picture."""
    unfinished = path.with_name(f".{path.name}.unfinished")
    dates = {"png": {"Software": None}, "pdf": {"CreationDate": None}}  # the same map gives the same bytes
    try:
        figure.savefig(unfinished, format=path.suffix[1:], dpi=figure.dpi, metadata=dates[path.suffix[1:]])
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)
