"""Draws pictures of datasets, by name."""

from collections.abc import Sequence
from typing import Any

import xarray
from matplotlib.axes import Axes

from .files.nearest import instead_of
from .plotting.style import NAMES, using
from .pictures import open_file, pictures_of


def picture_names(data: xarray.Dataset) -> list[str]:
    """Names of all pictures that a dataset of a file provides, the most general one first. Raises PeterkaFileError if `data` is not
    a valid dataset of such a file."""
    with open_file(data) as file:
        return list(pictures_of(file))


def draw(data: xarray.Dataset, name: str | None = None, ax: Axes | None = None,
         **options: Any) -> Axes | Sequence[Axes] | None:
    """Draws a picture of a dataset returned by open() or run(), or of a part of one.

    `name`: one of picture_names(data); by default the first. `ax`: Axes made by subplots(), whose place the picture takes
    with its legends and scales; by default a new figure, ax.figure. `options`: fields of plotting.style.Style (width [mm],
    dpi, font, title, limits, log, palette "colour" or "grey", units "both", "si" or "ratio"), `cycles` of a basin's short
    run, `measured` points of a sweep, `probability` of which motion of drawn rigs ("3/2", "impacts"). Returns the Axes, a list
    of them for a picture with several panels, None if there is nothing to draw. The coordinates of the Axes are the file's ratios, whatever units the scales show. Raises ValueError for
    an unknown name, PeterkaFileError if `data` is not a valid dataset of a file."""
    changes = {key: options.pop(key) for key in NAMES & options.keys()}
    with using(**changes), open_file(data) as file:
        pictures = pictures_of(file, **options)
        name = next(iter(pictures)) if name is None else name
        if name not in pictures:
            raise ValueError(f"there is no picture of this {file.kind} named {instead_of([name], pictures, 'it has')}")
        return pictures[name](file, ax)
