"""The decorator that turns draw(file, ax, ...) into a picture function for an open file or a dataset, in any style."""

import functools
from collections.abc import Callable
from typing import Any, TypeVar

from . import fills, style
from .figures import figure_of

Drawn = TypeVar("Drawn")


def picture(reader: Callable[[Any], Any]) -> Callable[[Callable[..., Drawn]], Callable[..., Drawn]]:
    """Decorates draw(file, ax=None, ...), which draws a checked file of the class `reader`. The decorated function takes

        data     such a file, or an xarray.Dataset from peterka.open or peterka.run, or a part of one
        ax       Axes made by subplots(), whose place the picture takes; None: a figure of its own
        options  those of the picture, and the fields of plotting.style.Style, such as palette="grey"

    and returns the Axes, a list if the picture has several panels, or None if there is nothing to draw."""

    def decorate(draw: Callable[..., Drawn]) -> Callable[..., Drawn]:
        @functools.wraps(draw)
        def drawn(data: Any, ax: Any | None = None, **options: Any) -> Drawn:
            changes = {name: options.pop(name) for name in style.NAMES & options.keys()}
            with style.using(**changes):
                file = reader(data) if hasattr(data, "data_vars") else data
                others = set(ax.get_figure().axes) - {ax} if ax is not None else set()
                result = draw(file, ax, **options)
                if result is not None and style.is_grey():
                    fills.without_colour(figure_of(result), others)
                return result

        return drawn

    return decorate
