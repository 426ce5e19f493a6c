"""Runs peterka's jobs, opens its files and draws them:

    data = peterka.run("jobs/smoke.toml", ranks=2, axes__gap_ratio__points=64)    # an xarray.Dataset
    data = peterka.open("smoke.h5")
    peterka.draw(data, "force_all", ax=ax, palette="grey")

run, check, open, draw and picture_names are what users call; what they raise is a PeterkaError: JobError of a job,
PeterkaFileError of a file. Each package is about one thing and
imports only those above it:

errors     what is raised for users
arrays     kinds of arrays, for hints
files      any file of peterka, checked before anything in it is believed: HDF5, seals, headers, numbers of regimes
plotting   what every picture shares: figures, scales, ticks, titles, units, the fixed colour of each class of z = p/q
measurements   points that somebody measured, and how they look over sweeps and maps
rig_sketch   the rig with its coordinates and their signs, for the README
maps       maps and basins: the checked file, reduction to what a picture can show, the pictures, two files compared
sweeps     sweeps: frequency response and bifurcation, measured points over them
traces     one cell in time: motion, phase plane, impact, spectra
studies    engines compared: work and precision, labels, stability
export     maps and basins for other programs: CSV, VTK, MATLAB
operating  where to operate a rig: the worst over a drift and over the starts, the best places, the box computed anew
toml       a job's tables as TOML
identification   stop and springs from recordings and measured impacts
scaling    parallel efficiency: times of tiles, the replay of their dealing, the picture
claims     the paper's claims and the page that tells how they fare
pictures   which pictures a file gives: the one place that knows them all
launching  the program started, watched and interrupted
runs       jobs run by the program, files opened as datasets
backend    the same files by xarray's own open_dataset, engine="peterka"
drawing    pictures of datasets, by name
results_page   the results page in Markdown, of studies and maps
page       the page of explore.py: a map, basin, sweep or curves with the program's own engine inside
cli        what the programs beside this folder share: a Python with the packages, exit codes, arguments, messages
"""

import importlib

_USED = {"run": "runs", "check": "runs", "open": "runs", "JobError": "errors", "PeterkaError": "errors",
         "PeterkaFileError": "errors", "draw": "drawing",
         "picture_names": "drawing"}
__all__ = sorted(_USED)


def __getattr__(name):
    """Loads what is used when it is used: the programs ask for packages only once they know that these are here."""
    if name not in _USED:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f".{_USED[name]}", __name__), name)


def __dir__():
    return __all__
