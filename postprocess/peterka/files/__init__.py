"""Access to any file of peterka, checked before its contents are used.

checked_hdf5, own_objects, seal   single attributes and datasets of an untrusted file; its checksums
raw_bytes, trial   checks made before HDF5 opens a file
opened     a file of any kind with a checked header
dataset, dataset_content   a file as an xarray.Dataset, and a dataset as a source for the readers
regimes    the numbers of `regime`
csv_table  user-written tables: CSV separated by commas, semicolons or tabs
whole_file files that appear under their name only when complete
harmless   texts from a file, made safe to display
"""
