"""Style settings for journals or talks, common to all pictures drawn inside `with using(...)`."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, fields, replace
from typing import Any

import matplotlib

MILLIMETRES = 25.4  # in an inch
PALETTES, UNITS = ("colour", "grey"), ("both", "si", "ratio")
RC = {
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
    "svg.fonttype": "none",  # text stays text: searchable, and editable in a drawing program
    "svg.hashsalt": "peterka",  # reproducible bytes
    "agg.path.chunksize": 20000,
}


@dataclass(frozen=True)
class Style:
    """`width` of a figure [mm], None: the picture's own; `dpi`, None: as fine as the cells require; `limits` (low, high) of the scale
    of values, in base SI units or the ratio shown (limits.py); `log`: whether that scale is logarithmic; `units`: scales in ratios, in SI
    units, or in both."""

    width: float | None = None
    dpi: int | None = None
    font: str | None = None
    title: bool = True
    limits: tuple[float, float] | None = None
    log: bool = False
    palette: str = "colour"
    units: str = "both"

    def __post_init__(self) -> None:
        for name, known in (("palette", PALETTES), ("units", UNITS)):
            if getattr(self, name) not in known:
                raise ValueError(f"{name} is {getattr(self, name)!r}; it can be {' or '.join(known)}")
        if self.limits is not None and not self.limits[0] < self.limits[1]:
            raise ValueError(f"limits are {self.limits}; the first has to be below the second")


NAMES = frozenset(field.name for field in fields(Style))
_current = ContextVar("style", default=Style())
_asked: ContextVar[set[str] | None] = ContextVar("asked", default=None)
_in_use = ContextVar("style_in_use", default=False)


def scale_option(name: str) -> Any:
    """`limits` or `log` of the style, for a picture that has such a scale."""
    asked = _asked.get()
    if asked is not None:
        asked.add(name)
    return getattr(current(), name)


@contextmanager
def listening() -> Iterator[set[str]]:
    """The names of those that pictures ask for, drawn within the block."""
    asked: set[str] = set()
    token = _asked.set(asked)
    try:
        yield asked
    finally:
        _asked.reset(token)


def current() -> Style:
    """The current Style."""
    return _current.get()


@contextmanager
def using(**changes: Any) -> Iterator[Style]:
    """Pictures drawn inside the block have these fields of a Style."""
    token = _current.set(replace(_current.get(), **changes))
    used = _in_use.set(True)
    try:
        with matplotlib.rc_context(rc()):
            yield _current.get()
    finally:
        _in_use.reset(used)
        _current.reset(token)


def rc() -> dict[str, object]:
    """matplotlib's own settings for this style."""
    font = current().font
    return RC | ({"font.family": [font, "DejaVu Sans"]} if font else {})


def is_in_use() -> bool:
    """Whether a `with using(...)` block is active: outside, fonts have matplotlib's own sizes."""
    return _in_use.get()


def is_grey() -> bool:
    """Whether pictures are currently drawn without colours."""
    return current().palette == "grey"
