"""A file of peterka as an xarray.Dataset, and such a dataset as what the checked readers read.

Names are those of the file, what lies in a group with the group's before it: "attractors/cells". Coordinates are those
of the file; numbers are the stored ones, regime -128 where a cell isn't computed. Values are read when they are used.
"""

from pathlib import Path

import h5py
import numpy as np
import xarray
from xarray.backends import BackendArray
from xarray.core import indexing

from .checked_hdf5 import CheckedFile, NotDrawable, check_range, is_number, meanings


class _Stored(BackendArray):
    """The numbers of one dataset of an open file."""

    def __init__(self, data, name, dataset):
        self.data, self.name, self.shape, self.dtype = data, name, dataset.shape, dataset.dtype

    def __getitem__(self, key):
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._read)

    def _read(self, key):
        return np.asarray(self.data.values(self.name, key))


def dataset_of(data: CheckedFile) -> xarray.Dataset:
    """All numbers of a checked file. The file stays open as long as the dataset is used."""
    variables = {}
    for name, dataset in data.numbers().items():
        values = indexing.LazilyIndexedArray(_Stored(data, name, dataset))
        variables[name] = xarray.Variable(_dimensions(name, dataset), values, data.attributes(name))
    scales = {name for name, variable in variables.items() if variable.dims == (name,)}
    beside = {name for name, variable in variables.items() if name in ("gap_ratio", "direction") and name not in scales
              and variable.ndim == 1}
    coordinates = {name: variables.pop(name) for name in scales | beside}
    result = xarray.Dataset(variables, coordinates, data.attributes("/"))
    result.encoding["source"] = str(data.path)
    result.set_close(data.close)
    return result


def _dimensions(name, dataset):
    """Names of the scales along each side, in the group of the dataset."""
    group = name.rpartition("/")[0]
    if h5py.h5ds.is_scale(dataset.id):
        return (name,)
    return tuple("/".join(filter(None, [group, scale.keys()[0] if len(scale) else f"{name}_{side}"]))
                 for side, scale in enumerate(dataset.dims))


class DatasetContent:
    """A dataset in the place of a CheckedFile: the readers check it as they check a file."""

    may_be_part = True  # of its file, by sel or isel

    def __init__(self, dataset: xarray.Dataset):
        self._dataset = dataset
        self.path = Path(dataset.encoding.get("source") or f"{dataset.attrs.get('title') or 'dataset'}.h5")

    def close(self):
        """The dataset belongs to its owner."""

    def verify(self):
        """Its file was verified when it was opened."""

    def refusal(self, reason):
        return NotDrawable(f"the dataset of {self.path} {reason}")

    def attribute(self, name, of="/"):
        attributes = self._dataset.attrs if of == "/" else self._dataset[of].attrs
        value = attributes.get(name)
        return value if isinstance(value, str) or is_number(value) else None

    def names(self):
        return sorted({str(name).split("/")[0] for name in self._dataset.variables})

    def has(self, name):
        return any(known == name or str(known).startswith(f"{name}/") for known in self._dataset.variables)

    def dataset(self, name, shape, kinds):
        """The variable, of this shape (None: any) and of one of these kinds of numbers."""
        if name not in self._dataset.variables:
            raise self.refusal(f"has no dataset {name}")
        values = self._dataset.variables[name]
        if values.dtype.kind not in kinds:
            raise self.refusal(f"has {name} of type {values.dtype}")
        if shape is not None and values.shape != shape:
            raise self.refusal(f"has {name} of shape {values.shape} instead of {shape}")
        return values

    def values(self, name, rows):
        values = np.asarray(self._dataset.variables[name][rows].values)
        check_range(self, name, values)
        return values

    def words(self, name):
        return meanings(self, name, np.ravel(self._dataset[name].attrs.get("flag_values", ())))

    def text(self, name):
        return []
