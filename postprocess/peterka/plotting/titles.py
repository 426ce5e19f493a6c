"""The title of a picture, for which it reserves space, and the final layout."""

import re
import textwrap

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from . import style
from .drawn import Titled
from .figures import Picture
from .frames import text_width
from .linear_ticks import use_everywhere

SIZE = 9  # pt
LINE = 0.155  # in, of a title
MARGIN = 0.1  # in, left and right of it
NO_BREAK, BEFORE_A_UNIT = "\N{NO-BREAK SPACE}", re.compile(r"(?<=\d) (?=(%|[kmµ]?(Hz|N|m|s)|m/s)(?![\w]))")


def write_title(figure: Figure, file: Titled, extra: str = "", ax: Axes | None = None) -> None:
    """Title of the file, wrapped to the figure's width; `extra` follows line by line. Never interpreted as mathematics,
    because it may contain a $. Call it when the picture is complete except for notes that still need a place. In a caller's
    figure it is placed over `ax`, whose place the picture took, and that figure's layout is computed when it is shown."""
    own = isinstance(figure, Picture)
    width = (figure.get_figwidth() if own else figure.get_figwidth() * _share(ax)) - 2 * MARGIN
    texts = [file.title, *extra.split("\n")] if style.current().title else []
    lines = [line for text in texts if text for line in wrapped(text, width)]
    if own:
        figure.set_figheight(figure.get_figheight() + LINE * (len(lines) - 1))
        if lines:
            figure.suptitle("\n".join(lines), fontsize=SIZE, parse_math=False)
        use_everywhere(figure)
    elif lines:
        assert ax is not None
        ax.set_title("\n".join(lines), fontsize=SIZE, parse_math=False)
    # The layout depends on the labels and they on the layout: first pass here, second when the figure is saved.
    figure.draw_without_rendering()


def _share(ax: Axes) -> float:
    """Share of the figure's width that the Axes occupy."""
    place = ax.get_subplotspec().get_position(ax.get_figure())
    return float(place.width)


def wrapped(text: str, width: float) -> list[str]:
    """Wraps into as few lines as fit this width [in], of about equal length."""
    text = BEFORE_A_UNIT.sub(NO_BREAK, text)
    letters = len(text)
    while letters > 1 and not _fits(text, letters, width):
        letters -= 1
    lines = len(_wrap(text, letters))
    while letters > 1 and len(_wrap(text, letters - 1)) == lines and _fits(text, letters - 1, width):
        letters -= 1
    return [line.replace(NO_BREAK, " ") for line in _wrap(text, letters)]


class _Wrapper(textwrap.TextWrapper):
    wordsep_simple_re = re.compile(r"([\t\n\x0b\x0c\r ]+|(?<=[a-z][_.])(?=[a-z]))")  # also inside a key, contact.damping_ns_per_m


def _wrap(text: str, letters: int) -> list[str]:
    return _Wrapper(letters, break_on_hyphens=False).wrap(text)


def _fits(text: str, letters: int, width: float) -> bool:
    return all(text_width(line, SIZE) <= width for line in _wrap(text, letters))
