"""Presents an xarray.Dataset of a file to the checked readers. This module does not import xarray, so that programs that
only read files need not wait for it to load.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import PeterkaFileError
from .checked_hdf5 import check_range, is_number, meanings

if TYPE_CHECKING:
    import xarray


UNFINISHED = "unfinished"  # the attribute, 1, of a dataset of a file that a run has not finished


class DatasetContent:
    """A dataset in place of a CheckedFile; the readers check it as they check a file."""

    may_be_part = True  # of its file, by sel or isel

    def __init__(self, dataset: xarray.Dataset) -> None:
        self._dataset = dataset
        self.path = Path(dataset.encoding.get("source") or f"{dataset.attrs.get('title') or 'dataset'}.h5")

    @property
    def is_finished(self) -> bool:
        """As CheckedFile.is_finished."""
        return UNFINISHED not in self._dataset.attrs

    def close(self) -> None:
        """Does nothing: the dataset belongs to the caller."""

    def verify(self) -> None:
        """Does nothing: the file was verified when it was opened."""

    def refusal(self, reason: str) -> PeterkaFileError:
        """The exception to raise, with the message 'the dataset of FILE reason'."""
        return PeterkaFileError(f"the dataset of {self.path} {reason}")

    def attribute(self, name: str, of: str = "/") -> str | int | float | None:
        """As CheckedFile.attribute."""
        attributes = self._dataset.attrs if of == "/" else self._dataset[of].attrs
        value = attributes.get(name)
        return value if isinstance(value, str) or is_number(value) else None

    def names(self) -> list[str]:
        """Names of all objects at the root."""
        return sorted({str(name).split("/")[0] for name in self._dataset.variables})

    def has(self, name: str) -> bool:
        """Whether a variable or a group of this name exists."""
        return any(known == name or str(known).startswith(f"{name}/") for known in self._dataset.variables)

    def dataset(self, name: str, shape: tuple[int, ...] | None, kinds: str) -> xarray.Variable:
        """The variable, of this shape (None: any) and of one of these kinds of numbers; raises PeterkaFileError otherwise."""
        if name not in self._dataset.variables:
            raise self.refusal(f"has no dataset {name}")
        values = self._dataset.variables[name]
        if values.dtype.kind not in kinds:
            raise self.refusal(f"has {name} of type {values.dtype}")
        if shape is not None and values.shape != shape:
            raise self.refusal(f"has {name} of shape {values.shape} instead of {shape}")
        return values

    def values(self, name: str, rows: Any) -> Any:
        """These rows (a slice, or () for a scalar) of a variable already checked."""
        values = np.asarray(self._dataset.variables[name][rows].values)
        check_range(self, name, values)
        return values

    def words(self, name: str) -> dict[int, str]:
        """{number: word} of a variable of flags already checked."""
        return meanings(self, name, np.ravel(self._dataset[name].attrs.get("flag_values", ())))

    def text(self, name: str) -> list[str]:
        """Always empty: a dataset holds only numbers."""
        return []
