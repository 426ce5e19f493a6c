"""An open peterka file of any kind with a checked header: layout version, kind, title and plain attributes.

Files that cannot be drawn raise PeterkaFileError. Use this class, or a subclass, in a `with` block.
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
from .job_axes import given_in_si

if TYPE_CHECKING:
    import xarray

Source: TypeAlias = "str | os.PathLike | xarray.Dataset"

__all__ = ["KINDS", "OpenedFile", "STANDARD_GRAVITY"]

LAYOUTS = (2, 3)  # readable versions; in layout 2, status 0 (named proved) may hide that rounding decides a label
KINDS = ("map", "basin", "sweep", "trace", "study", "curves")
STANDARD_GRAVITY = 9.80665  # m/s^2


class OpenedFile:
    """`kind` is one of KINDS; subclasses check their own content in check_content()."""

    def __init__(self, source: Source) -> None:
        """`source`: the path of a file, or an xarray.Dataset of one."""
        self.data: CheckedFile | DatasetContent = (
            CheckedFile(source) if isinstance(source, (str, os.PathLike)) else DatasetContent(source))
        self.path = self.data.path
        self.refusal = self.data.refusal
        try:
            self.kind = self._checked_kind()
            self.check_content()
            if type(self) is not OpenedFile:  # nothing is shown from the header alone
                self.data.verify()
        except BaseException:
            self.data.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.data.close()

    def check_content(self) -> None:
        """Checks nothing beyond the header."""

    @cached_property
    def given_in_si(self) -> frozenset[str]:
        """The coordinates, by the names of their ratios, that its job gives in SI units."""
        return given_in_si(self.data.attribute("job"))

    @property
    def computed(self) -> float:
        """The computed share, 0 to 1; each kind of file counts in its own way."""
        raise NotImplementedError

    @property
    def is_complete(self) -> bool:
        """Whether all is computed, also what follows when all cells are: audits, motions found next door, what ends in what."""
        return self.data.is_finished and self.computed == 1

    @cached_property
    def title(self) -> str:
        """The title as one sanitised line; the file's name if it has no title."""
        text = self.data.attribute("title")
        return harmless((text.strip() if isinstance(text, str) else "") or self.path.stem)

    def number(self, name: str) -> float | None:
        """A root attribute that is a finite number of reasonable size, as float; None if absent or anything else."""
        value = self.data.attribute(name)
        return float(value) if is_number(value) and np.isfinite(value) and abs(value) <= LARGEST else None

    def positive(self, name: str) -> float | None:
        """The same for a positive number used as a divisor."""
        value = self.number(name)
        return value if value is not None and value >= 1 / LARGEST else None

    @property
    def newtons(self) -> float | None:
        """The hammer's weight in N; None if the file does not give the mass."""
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
