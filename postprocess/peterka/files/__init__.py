"""Any file of peterka, checked before anything in it is believed.

checked_hdf5, own_objects, seal   single attributes and datasets of a file nobody vouches for; its checksums
raw_bytes, trial   what is looked at before HDF5 opens a file
opened     a file of any kind with a checked header
dataset, dataset_content   a file as an xarray.Dataset, and a dataset as what the readers read
regimes    the numbers of `regime`
csv_table  tables that people write: CSV with commas, semicolons or tabs
whole_file files written under their name when they are complete
harmless   texts out of a file, made safe to show
"""
