"""Unused components cost no time: packages that no picture of a file needs, a layout for every format."""

import subprocess
import sys

from conftest import POSTPROCESS
from matplotlib.layout_engine import ConstrainedLayoutEngine
from peterka.plotting.figures import figure_of
from peterka.maps.map_file import PeterkaFile
from peterka.maps.peterka_map import draw
from peterka.cli.command_line import save_all
from picture_samples import write_map

SLOW = {"xarray", "pandas", "scipy.io", "scipy.optimize", "netCDF4"}  # to load


def test_pictures_of_a_file_load_no_package_for_datasets(tmp_path):
    write_map(tmp_path / "rig.h5")
    done = subprocess.run([sys.executable, "-X", "importtime", POSTPROCESS / "draw.py", "rig.h5", "--formats", "png"],
                          cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0
    loaded = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}
    assert "matplotlib.figure" in loaded and not loaded & SLOW


def test_a_picture_s_layout_is_made_once_for_all_formats(tmp_path, monkeypatch):
    layouts = []
    execute = ConstrainedLayoutEngine.execute
    monkeypatch.setattr(ConstrainedLayoutEngine, "execute", lambda self, figure: layouts.append(execute(self, figure)))
    with PeterkaFile(write_map(tmp_path / "rig.h5")) as file:
        figure = figure_of(draw(file))
    save_all(figure, tmp_path, "one", ["png"])
    made, places = len(layouts), [ax.get_position().bounds for ax in figure.axes]
    save_all(figure, tmp_path, "one", ["pdf", "svg"])
    assert made > 0 and len(layouts) == made
    assert [ax.get_position().bounds for ax in figure.axes] == places
