"""Positions of a picture's texts: which leave the canvas, and which overlap something else."""

import io
from itertools import combinations

from matplotlib.text import Text

SLACK = 1.0  # pixels: glyphs have padding


def drawn_texts(figure, monkeypatch):
    """(text, box in pixels) of everything written when the figure is saved."""
    drawn = {}
    draw = Text.draw

    def draw_and_note(artist, renderer, *arguments, **options):
        if artist.get_visible() and artist.get_text().strip():
            drawn[id(artist)] = artist.get_text(), Text.get_window_extent(artist, renderer)
        return draw(artist, renderer, *arguments, **options)

    draw_all = type(figure).draw

    def begin_anew(artist, renderer):  # the first layout pass yields preliminary positions
        drawn.clear()
        return draw_all(artist, renderer)

    with monkeypatch.context() as patch:
        patch.setattr(Text, "draw", draw_and_note)
        patch.setattr(type(figure), "draw", begin_anew)
        figure.savefig(io.BytesIO(), format="png", dpi=figure.dpi)
    return list(drawn.values())


def faults_of_layout(figure, monkeypatch):
    """Faults visible to a reader, in words; empty for a sound picture."""
    texts = drawn_texts(figure, monkeypatch)
    canvas = figure.bbox
    faults = [f"{text!r} leaves the canvas by {beyond:.0f} pixels" for text, box in texts
              if (beyond := max(canvas.x0 - box.x0, canvas.y0 - box.y0, box.x1 - canvas.x1, box.y1 - canvas.y1)) > SLACK]
    for (first, box), (second, other) in combinations(texts, 2):
        width = min(box.x1, other.x1) - max(box.x0, other.x0)
        height = min(box.y1, other.y1) - max(box.y0, other.y0)
        if min(width, height) > SLACK:
            faults.append(f"{first!r} and {second!r} overlap by {width:.0f} x {height:.0f} pixels")
    return faults


def has_scales(ax):
    """Whether a plane of frequencies and gaps is labelled in ratios, and in Hz and mm, on its own axes or on second scales."""
    named = {label for each in (ax, *ax.child_axes) for label in (each.get_xlabel(), each.get_ylabel()) if label}
    ratios, si = {r"$\Omega/\omega$", r"$\mathrm{gap}/A_0$"}, {"excitation frequency (Hz)", "gap (mm)"}
    assert named <= ratios | si, named
    assert named & ratios in (set(), ratios) and named & si in (set(), si), named
    return bool(named & ratios), bool(named & si)
