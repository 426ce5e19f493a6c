"""Runs peterka's jobs, opens its files and draws them:

    data = peterka.run("jobs/smoke.toml", ranks=2, axes__gap_ratio__points=64)    # an xarray.Dataset
    data = peterka.open("smoke.h5")
    peterka.draw(data, "force_all", ax=ax, palette="grey")

Users call run, check, open, draw and picture_names. These raise subclasses of PeterkaError: JobError for a faulty job,
PeterkaFileError for a file. Each package has one subject and imports only packages listed above it:

errors     exceptions raised for users
arrays     array types for annotations
sampling   what a number of draws tells of all
files      access to any file of peterka, checked before its contents are used: HDF5, seals, headers, regime numbers
plotting   shared by all pictures: figures, scales, ticks, titles, units, the fixed colour of each class of z = p/q
measurements   measured points and their marks over sweeps and maps
rig_sketch   the rig with its coordinates and sign conventions, for the README
maps       maps and basins: the checked file, reduction to picture size, the pictures, comparison of two files
sweeps     sweeps: frequency response and bifurcation diagrams, with measured points over them
traces     a single cell in time: motion, phase plane, impact, spectra
studies    comparisons of engines: work and precision, labels, stability
second_proof   certified orbits proved once more, in another arithmetic and by another method
export     maps and basins for other programs: CSV, VTK, MATLAB
operating  choice of an operating point: worst case over a drift and over the starts, best places, verification of the box
toml       a job's tables as TOML
scaling    parallel efficiency: tile times, replay of their distribution to ranks, the picture
pictures   the table of all pictures that each kind of file provides
launching  starts, watches and interrupts the program
runs       runs jobs with the program and opens files as datasets
identification   stop and springs identified from recordings, measured impacts and measured forces
claims     the paper's claims and the page that reports their verdicts
backend    the same files by xarray's own open_dataset, engine="peterka"
drawing    draws pictures of datasets, by name
results_page   the results page in Markdown, from studies and maps
page       the page of explore.py: a map, basin, sweep or curves with the program's own engine embedded
cli        shared by the command-line programs: an interpreter with the packages, exit codes, arguments, messages
"""

import importlib
from typing import Any

_USED = {"run": "runs", "check": "runs", "open": "runs", "JobError": "errors", "PeterkaError": "errors",
         "PeterkaFileError": "errors", "draw": "drawing",
         "picture_names": "drawing"}
__all__ = sorted(_USED)


def __getattr__(name: str) -> Any:
    """Imports each public name on first use: the programs request packages only after checking that they are installed."""
    if name not in _USED:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f".{_USED[name]}", __name__), name)


def __dir__() -> list[str]:
    return __all__
