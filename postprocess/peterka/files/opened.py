"""A peterka file of any kind, open and with a checked header: layout version, kind, title and plain attributes.

What cannot be drawn raises PeterkaFileError. Use it, or a class made of it, in a `with` block.
"""

from __future__ import annotations

import os
from functools import cached_property
from typing import TYPE_CHECKING, Self, TypeAlias

import numpy as np

from ..errors import PeterkaFileError
from .checked_hdf5 import LARGEST, CheckedFile, is_number, shown
from .dataset_content import DatasetContent
from .harmless import harmless

if TYPE_CHECKING:
    import xarray

Source: TypeAlias = "str | os.PathLike | xarray.Dataset"

__all__ = ["KINDS", "OpenedFile", "STANDARD_GRAVITY"]

LAYOUTS = (2, 3)  # that can be read; in those of 2 status 0, named proved, may hide that rounding decides a label
KINDS = ("map", "basin", "sweep", "trace", "study", "curves")
STANDARD_GRAVITY = 9.80665  # m/s^2


class OpenedFile:
    """`kind` is one of KINDS; a subclass checks its own content in check_content()."""

    def __init__(self, source: Source) -> None:
        """`source`: the path of a file, or an xarray.Dataset of one."""
        self.data: CheckedFile | DatasetContent = (
            CheckedFile(source) if isinstance(source, (str, os.PathLike)) else DatasetContent(source))
        self.path = self.data.path
        self.refusal = self.data.refusal
        try:
            self.kind = self._checked_kind()
            self.check_content()
            if type(self) is not OpenedFile:  # of the header alone nothing is shown
                self.data.verify()
        except BaseException:
            self.data.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.data.close()

    def check_content(self) -> None:
        """Nothing beyond the header."""

    @property
    def computed(self) -> float:
        """The share of it, 0 to 1, that is computed; each kind of file counts its own."""
        raise NotImplementedError

    @cached_property
    def title(self) -> str:
        """One harmless line; the name of the file where it has no title."""
        text = self.data.attribute("title")
        return harmless((text.strip() if isinstance(text, str) else "") or self.path.stem)

    def number(self, name: str) -> float | None:
        """A root attribute that is a finite number of some reasonable size, as float; None where it is absent or anything
        else."""
        value = self.data.attribute(name)
        return float(value) if is_number(value) and np.isfinite(value) and abs(value) <= LARGEST else None

    def positive(self, name: str) -> float | None:
        """The same for a number that must be above zero, and by which others are divided."""
        value = self.number(name)
        return value if value is not None and value >= 1 / LARGEST else None

    @property
    def newtons(self) -> float | None:
        """N in the hammer's weight; None where the file doesn't tell."""
        mass = self.positive("hammer_mass_kg")
        return mass * STANDARD_GRAVITY if mass else None

    def _checked_kind(self) -> str:
        layout, kind = self.data.attribute("peterka_layout"), self.data.attribute("peterka_kind")
        if layout is None:
            raise self.refusal("is HDF5, but not a peterka file (no attribute peterka_layout)")
        if not is_number(layout) or layout not in LAYOUTS:
            lacks = ", which has no checksum over what lies outside its cells" if layout == 1 else ""
            raise self.refusal(f"has layout version {shown(layout)}{lacks}; this program draws versions {LAYOUTS[0]} and {LAYOUTS[1]}")
        if not isinstance(kind, str) or kind not in KINDS:
            raise self.refusal(f"is of kind {shown(kind)}; this program draws {', '.join(KINDS)} files")
        return kind
