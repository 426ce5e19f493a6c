"""A file of peterka as an xarray.Dataset.

Names are those of the file, prefixed by the group's name: "attractors/cells". Coordinates and numbers are as stored, regime
-128 for a cell not computed. Values are read lazily.
"""

from typing import Any

import h5py
import numpy as np
import xarray
from numpy.typing import NDArray
from xarray.backends import BackendArray
from xarray.core import indexing

from .checked_hdf5 import CheckedFile
from .coordinates import NAMES
from .dataset_content import UNFINISHED

OF_THE_FILE = ("tiles/", "summary/")  # checksums and what is finished: verified when it is opened


class _Stored(BackendArray):
    """The numbers of one dataset of an open file."""

    def __init__(self, data: CheckedFile, name: str, dataset: h5py.Dataset) -> None:
        self.data, self.name, self.shape, self.dtype = data, name, dataset.shape, dataset.dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._read)

    def _read(self, key: tuple[Any, ...]) -> NDArray[Any]:
        return np.asarray(self.data.values(self.name, key))


def dataset_of(data: CheckedFile) -> xarray.Dataset:
    """All numbers of a checked file, but those that guard it: OF_THE_FILE. It stays open as long as the dataset is used. That of an
    unfinished file has one more attribute, UNFINISHED."""
    variables = {}
    for name, dataset in data.numbers().items():
        if name.startswith(OF_THE_FILE):
            continue
        values = indexing.LazilyIndexedArray(_Stored(data, name, dataset))
        variables[name] = xarray.Variable(_dimensions(name, dataset), values, data.attributes(name))
    scales = {name for name, variable in variables.items() if variable.dims == (name,)}
    beside = {name for name, variable in variables.items() if name in NAMES | {"direction"} and name not in scales
              and variable.ndim == 1}
    coordinates = {name: variables.pop(name) for name in scales | beside}
    attributes = data.attributes("/") | ({} if data.is_finished else {UNFINISHED: 1})
    result = xarray.Dataset(variables, coordinates, attributes)
    result.encoding["source"] = str(data.path)
    result.set_close(data.close)
    return result


def _dimensions(name: str, dataset: h5py.Dataset) -> tuple[str, ...]:
    """Names of the dimension scales along each side, within the dataset's group."""
    group = name.rpartition("/")[0]
    if h5py.h5ds.is_scale(dataset.id):
        return (name,)
    return tuple("/".join(filter(None, [group, scale.keys()[0] if len(scale) else f"{name}_{side}"]))
                 for side, scale in enumerate(dataset.dims))
