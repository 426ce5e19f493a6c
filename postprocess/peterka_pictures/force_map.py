"""Peak impact force over the plane of a map: of z = 1/1 alone (the paper's Fig. 23), and of all impacts.

Force is F/(m g), with a second scale in newtons where the file knows the hammer's mass. The largest force of all cells
drawn is marked with its value. Cells of a reduced map show the largest force in their block.
"""

import numpy as np

from . import axes
from .classes import CHAOTIC, CLASSES, INDEX, PERIODIC, classify
from .reduce import class_picture, force_picture

WIDTH = 3.7  # in
STANDARD_GRAVITY = 9.80665  # m/s^2
COLOURS = "viridis"
OTHER_COLOUR = "#F2F2F2"
TOP_SHARE, TOP_EXCESS = 99.9, 1.15  # the scale ends at this percentile where single cells exceed it by this factor


def draw_single_impact(file):
    """Force where one impact comes in each forcing cycle; None where no cell does."""
    return _draw(file, lambda regime, p, q: (regime == PERIODIC) & (p == 1) & (q == 1), "$z = 1/1$", apart=[])


def draw_all_impacts(file):
    """Force of every proved orbit with impacts, chaotic ones over their observed window; None where no cell has one."""
    apart = ["no impact", "sustained contact", "unresolved", "failed"]
    return _draw(file, lambda regime, p, q: (regime == PERIODIC) | (regime == CHAOTIC), "all impacts", apart)


def _draw(file, wanted, what, apart):
    force, peak = force_picture(file, wanted)
    if peak is None:
        return None
    classes, counts = class_picture(file, ["regime", "impacts", "period"], classify, len(CLASSES))
    figure, ax, bar_ax = axes.stack(WIDTH, force.image, [(_legend_entries(counts, apart), 2, None)], bar=True)
    colours = [entry.colour if entry.label in apart else OTHER_COLOUR for entry in CLASSES]
    axes.show_classes(ax, classes, colours, INDEX["not computed yet"])
    top = _top_of_scale(force.image, peak)
    mesh = ax.pcolormesh(
        force.column_edges, force.row_edges, np.ma.masked_invalid(force.image),
        cmap=COLOURS, vmin=0, vmax=top, rasterized=True,
    )
    axes.label_axes(ax, file)
    _draw_scale(figure, bar_ax, mesh, file, what, peak.value > top)
    _mark(ax, peak, file)
    axes.notice_incomplete(ax, file)
    axes.write_title(figure, file)
    return figure


def _legend_entries(counts, apart):
    """Legend entries of the cells without a colour of force: by class where `apart` names it, else together."""
    labels = [entry.label for n, entry in enumerate(CLASSES) if counts[n]]
    entries = [axes.legend_patch(label, CLASSES[INDEX[label]].colour) for label in labels if label in apart]
    if not apart and set(labels) - {"1/1", "not computed yet"}:
        entries.append(axes.legend_patch("any other regime", OTHER_COLOUR))
    if "not computed yet" in labels:
        entries.append(axes.legend_patch("not computed yet", None, hatched=True))
    return entries


def _top_of_scale(image, peak):
    top = float(np.nanpercentile(image, TOP_SHARE))
    return top if top > 0 and peak.value > TOP_EXCESS * top else max(peak.value, np.finfo(float).tiny)


def _draw_scale(figure, bar_ax, mesh, file, what, beyond):
    bar = figure.colorbar(mesh, cax=bar_ax, orientation="horizontal", extend="max" if beyond else "neither")
    bar.outline.set_linewidth(0.6)
    bar.set_label(f"peak force $F/(m\\,g)$, {what}", fontsize=8)
    mass = file.positive("hammer_mass_kg")
    if mass:
        weight = mass * STANDARD_GRAVITY
        newtons = bar_ax.secondary_xaxis("top", functions=((lambda f: f * weight), (lambda n: n / weight)))
        newtons.set_xlabel("peak force (N)", fontsize=8)


def _mark(ax, peak, file):
    """A cross at the largest force, its value beside it on the side where the picture has room."""
    place = ax.transData.transform((peak.column_value, peak.row_value))
    across, up = ax.transAxes.inverted().transform(place)
    mass = file.positive("hammer_mass_kg")
    text = f"max {peak.value:.3g}" + (f" ({peak.value * mass * STANDARD_GRAVITY:.3g} N)" if mass else "")
    ax.plot(
        peak.column_value, peak.row_value, marker="x", markersize=5, markeredgewidth=1.2, color="black", clip_on=False,
        path_effects=axes.outline(2.4), zorder=6,
    )
    ax.annotate(
        text, (peak.column_value, peak.row_value), textcoords="offset points",
        xytext=(8 if across < 0.5 else -8, 8 if up < 0.5 else -8),
        ha="left" if across < 0.5 else "right", va="bottom" if up < 0.5 else "top",
        path_effects=axes.outline(2.4), zorder=7,
    )
