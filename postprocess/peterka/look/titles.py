"""The title of a picture, which it makes room for, and the last look at its layout."""

import textwrap

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from .linear_ticks import use_everywhere

SIZE = 9  # pt
LINE = 0.155  # in, of a title
MARGIN = 0.1  # in, left and right of it


def write_title(figure, file, extra=""):
    """Title of the file, wrapped to the figure; `extra` below it, line by line. Never read as mathematics: it may hold
    a $. To be called when the picture is complete, but for notes that look for a place."""
    width = figure.get_figwidth() - 2 * MARGIN
    lines = [line for text in [file.title, *extra.split("\n")] if text for line in wrapped(text, width)]
    figure.set_figheight(figure.get_figheight() + LINE * (len(lines) - 1))
    figure.suptitle("\n".join(lines), fontsize=SIZE, parse_math=False)
    use_everywhere(figure)
    # The layout is made of labels, which hang on the layout: a first round here, the second one when it is saved.
    figure.draw_without_rendering()


def text_width(text, size=SIZE):
    """Of one line [in]."""
    return text_to_path.get_text_width_height_descent(text, FontProperties(size=size), ismath=False)[0] / 72


def wrapped(text, width):
    """As few lines as fit into so many inches, and these about equally long."""
    letters = len(text)
    while letters > 1 and not _fits(text, letters, width):
        letters -= 1
    lines = len(textwrap.wrap(text, letters))
    while letters > 1 and len(textwrap.wrap(text, letters - 1)) == lines and _fits(text, letters - 1, width):
        letters -= 1
    return textwrap.wrap(text, letters)


def _fits(text, letters, width):
    return all(text_width(line) <= width for line in textwrap.wrap(text, letters))
