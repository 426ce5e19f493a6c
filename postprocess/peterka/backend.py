"""xarray.open_dataset("map.h5", engine="peterka"): the file as peterka.open gives it, checked and verified by its seal."""

from collections.abc import Iterable
from pathlib import Path

import xarray
from xarray.backends import BackendEntrypoint

from .runs import open as open_verified


class PeterkaBackend(BackendEntrypoint):
    """The entry point "peterka" of the group xarray.backends, which pip makes."""

    description = "Files of peterka, verified by their seal"
    open_dataset_parameters = ("filename_or_obj", "drop_variables")

    def open_dataset(self, filename_or_obj, *, drop_variables: str | Iterable[str] | None = None) -> xarray.Dataset:
        """Raises what peterka.open raises; `drop_variables` are left out."""
        left_out = [drop_variables] if isinstance(drop_variables, str) else list(drop_variables or [])
        return open_verified(Path(filename_or_obj)).drop_vars(left_out, errors="ignore")

    def guess_can_open(self, filename_or_obj) -> bool:
        """Never by itself: an .h5 file may be anybody's."""
        return False
