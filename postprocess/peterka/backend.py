"""xarray.open_dataset("map.h5", engine="peterka"): the file as returned by peterka.open, checked and verified by its seal."""

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import xarray
from xarray.backends import BackendEntrypoint

from .runs import open as open_verified


class PeterkaBackend(BackendEntrypoint):
    """The entry point "peterka" of the group xarray.backends, registered by pip."""

    description = "Files of peterka, verified by their seal"
    open_dataset_parameters = ("filename_or_obj", "drop_variables")

    def open_dataset(self, filename_or_obj: Any, drop_variables: str | Iterable[str] | None = None, **others: Any) -> xarray.Dataset:
        """The dataset of the file at this path without `drop_variables`. Raises whatever peterka.open raises; TypeError if not
        given a path, or given other options."""
        if not isinstance(filename_or_obj, str | os.PathLike):
            raise TypeError(f"peterka opens files by their path, not {type(filename_or_obj).__name__}")
        if others:
            raise TypeError(f"peterka takes no {', '.join(others)}")
        left_out = [drop_variables] if isinstance(drop_variables, str) else list(drop_variables or [])
        return open_verified(Path(filename_or_obj)).drop_vars(left_out, errors="ignore")

    def guess_can_open(self, filename_or_obj: Any) -> bool:
        """Always False: an .h5 file may come from any program."""
        return False
