"""peterka from Python: jobs run, files opened, pictures drawn into the user's own Axes, and rejected uses."""

import os
import subprocess
import sys

import numpy as np
import peterka
import pytest
import xarray
from conftest import POSTPROCESS
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from peterka.pictures import open_file
from picture_samples import write_map
from sealing import SealedFile, unfinish
from test_picture_real_file import MAP, RIG

pytestmark = pytest.mark.thorough

JOB = {
    "schema": 1, "kind": "map",
    "hammer": {"mass_kg": 0.298, "natural_frequency_hz": 4.5, "damping_ns_per_m": 0.06},
    "cart": {"amplitude_m": 0.89e-3},
    "contact": {"law": "kelvin_voigt", "stiffness_n_per_m": 5.5e6, "damping_ns_per_m": 1.2e3},
    "axes": {"frequency_ratio": {"from": 1.2, "to": 3.9, "points": 4}, "gap_ratio": {"from": 0.0, "to": 5.0, "points": 4}},
}
TRACE = RIG.format(kind="trace") + "[operating_point]\nfrequency_ratio = 2.0\ngap_ratio = 0.0\n"
SWEEP = RIG.format(kind="sweep") + "[sweep]\ngap_ratio = [0.0]\n[axes.frequency_ratio]\nfrom = 1.8\nto = 2.2\npoints = 5\n"
BASIN = (RIG.format(kind="basin") + "[operating_point]\nfrequency_ratio = 1.8\ngap_ratio = 1.5\n" + "".join(
    f"[axes.{name}_ratio]\nfrom = -3.0\nto = 1.0\npoints = 4\n" for name in ("displacement", "velocity")))


def test_path_text_and_tables_are_the_same_job(tmp_path):
    (tmp_path / "job.toml").write_text(MAP.replace('title = "Four by four"\n', ""))
    of_path = peterka.run(tmp_path / "job.toml", ranks=1)
    of_text = peterka.run(MAP.replace('title = "Four by four"\n', ""), ranks=2)
    of_tables = peterka.run(JOB, ranks=1)
    for other in (of_text, of_tables):
        assert other.attrs["job_identity"] == of_path.attrs["job_identity"]
        assert other.regime.equals(of_path.regime) and other.peak_force_ratio.equals(of_path.peak_force_ratio)
    assert of_path.regime.dims == ("gap_ratio", "frequency_ratio") and of_path.regime.dtype == np.int8


def test_a_dataset_has_what_xarray_reads_in_the_file(tmp_path):
    data = peterka.run(JOB, ranks=1, output=tmp_path / "rig.h5")
    with xarray.open_dataset(tmp_path / "rig.h5", engine="h5netcdf") as other:
        assert set(other.variables) <= set(data.variables)
        for name in other.variables:
            np.testing.assert_array_equal(data[name].values, other[name].values)
            assert data[name].dims == other[name].dims
    assert data.peak_force_ratio.attrs["units"] == "1" and "run/ranks" in data


def test_changes_are_overrides():
    data = peterka.run(JOB, ranks=1, axes={"gap_ratio": {"points": 3, "to": 1.0}}, hammer__damping_ns_per_m=0.08)
    assert data.gap_ratio.values.tolist() == [0.0, 0.5, 1.0]
    assert data.attrs["damping_ratio"] == pytest.approx(0.08 / (2 * 0.298 * 2 * np.pi * 4.5))


def test_a_table_of_the_job_may_be_called_output():
    data = peterka.run(JOB, ranks=1, output={"fields": ["multiplier"]})
    assert "multiplier" in data


def test_a_file_that_a_run_has_not_finished_says_so(tmp_path):
    path = write_map(tmp_path / "a.h5", [[(1, 1, 1), (-128, -1, -1)]])
    with pytest.warns(UserWarning, match="the run isn't finished: what has no result yet holds fill values"):
        assert peterka.open(path).regime.values.tolist() == [[1, -128]]
    whole = write_map(tmp_path / "b.h5")
    unfinish(whole)
    with pytest.warns(UserWarning, match="the run isn't finished"):
        data = peterka.open(whole)
    with open_file(data.isel(frequency_ratio=slice(2))) as part:
        assert part.computed == 1 and not part.is_complete


def test_all_faults_of_a_job_are_one_exception():
    bad = JOB | {"hammer": JOB["hammer"] | {"mass_kg": -1.0}, "contcat": {}}
    with pytest.raises(peterka.JobError) as caught:
        peterka.run(bad, ranks=2)
    faults = caught.value.faults
    assert len(faults) == 2 and any("mass_kg" in fault for fault in faults) and any("contact" in fault for fault in faults)
    assert isinstance(caught.value, peterka.PeterkaError)
    with pytest.raises(peterka.JobError):
        peterka.check(bad)
    assert "cells" in peterka.check(JOB)


def test_what_a_job_cannot_hold_is_refused():
    with pytest.raises(TypeError, match="nothing that a job can hold"):
        peterka.run(JOB | {"title": object()})


def test_a_file_that_is_none_is_refused(tmp_path):
    (tmp_path / "a.h5").write_text("no")
    with pytest.raises(peterka.PeterkaFileError, match="is not an HDF5 file") as caught:
        peterka.open(tmp_path / "a.h5")
    assert isinstance(caught.value, peterka.PeterkaError)


@pytest.mark.parametrize("job", [MAP, BASIN, SWEEP, TRACE], ids=["map", "basin", "sweep", "trace"])
def test_every_picture_goes_into_the_user_s_axes(job):
    data = peterka.run(job, ranks=1)
    names = peterka.picture_names(data)
    assert names
    for name in names:
        figure = Figure(figsize=(12, 6))
        mine, other = figure.subplots(1, 2)
        drawn = peterka.draw(data, name, ax=mine)
        if drawn is None:  # nothing to show in so small a file
            continue
        first = drawn[0] if isinstance(drawn, list) else drawn
        assert first is mine and first.get_title() and not other.has_data()
        figure.draw_without_rendering()
        renderer = FigureCanvasAgg(figure).get_renderer()
        boxes = [ax.get_tightbbox(renderer) for ax in figure.axes if ax is not other]
        assert max(box.x1 for box in boxes if box) < other.get_tightbbox(renderer).x0 + 1


def test_a_part_of_a_dataset_is_drawn(tmp_path):
    data = peterka.open(write_map(tmp_path / "a.h5"))
    part = data.sel(gap_ratio=slice(0, 2.5), frequency_ratio=slice(2, 4))
    ax = peterka.draw(part, "map")
    assert ax.get_xlim() == pytest.approx((1.5, 4.5)) and ax.get_ylim() == pytest.approx((-0.5, 2.5))
    with pytest.raises(ValueError, match="no picture of this map named 'mop'; it has map, force_1_1"):
        peterka.draw(part, "mop")


def test_a_picture_leaves_matplotlib_as_it_was(tmp_path):
    import matplotlib

    before = dict(matplotlib.rcParams)
    figure = peterka.draw(peterka.open(write_map(tmp_path / "a.h5"))).get_figure()
    assert dict(matplotlib.rcParams) == before
    assert figure._repr_png_().startswith(b"\x89PNG")


def test_it_is_installed_by_pip(tmp_path):
    """From a copy: a build leaves its folders beside the sources."""
    subprocess.run(["cp", "-r", POSTPROCESS, tmp_path / "source"], check=True)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--no-index"]
    done = subprocess.run([*pip, "--target", tmp_path / "site", tmp_path / "source"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (tmp_path / "peterka" / "src").mkdir(parents=True)  # a clone, which must not hide the package
    code = ("import peterka, pathlib, xarray; folder = pathlib.Path(peterka.__file__).parent; data = xarray.open_dataset('rig.h5', engine='peterka', "
            "drop_variables='impacts'); print(folder, peterka.draw, (folder / 'page' / 'page.html').is_file(), (folder / 'py.typed').is_file(), "
            "data.regime.shape, 'impacts' in data)")
    write_map(tmp_path / "rig.h5")
    said = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True,
                          env=os.environ | {"PYTHONPATH": str(tmp_path / "site")}).stdout
    assert said.startswith(str(tmp_path / "site")) and said.endswith("True True (4, 4) False\n"), said
    damaged = bytearray((tmp_path / "rig.h5").read_bytes())
    at = damaged.index(b"mass_kg")
    damaged[at] ^= 1
    (tmp_path / "rig.h5").write_bytes(damaged)
    refused = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False,
                             env=os.environ | {"PYTHONPATH": str(tmp_path / "site")})
    assert refused.returncode != 0 and "is damaged" in refused.stderr


@pytest.mark.parametrize("ranks", [1, 2])
def test_how_far_a_run_is_is_told(ranks, tmp_path, capfd):
    shares = []
    large = {"axes": {"frequency_ratio": {"points": 192}, "gap_ratio": {"points": 96}}}
    with_progress = peterka.run(JOB, ranks=ranks, progress=shares.append, **large)
    assert shares and shares == sorted(shares) and 0 <= shares[0] and shares[-1] == 1.0
    assert capfd.readouterr().err == ""
    assert peterka.run(JOB, ranks=ranks, progress=True, **large).regime.equals(with_progress.regime)
    assert "100.0 %" in capfd.readouterr().err
    with pytest.raises(peterka.JobError) as caught:
        peterka.run(JOB | {"contcat": {}}, ranks=ranks, progress=shares.append)
    assert len(caught.value.faults) == 1


@pytest.mark.parametrize("ranks", [1, 2])
def test_an_interrupted_run_goes_on_from_its_file(ranks, tmp_path):
    large = {"axes": {"frequency_ratio": {"points": 512}, "gap_ratio": {"points": 512}}}

    def interrupt(share):
        if share > 0.05:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        peterka.run(JOB, ranks=ranks, output=tmp_path / "rig.h5", progress=interrupt, **large)
    seen = []
    whole = peterka.run(JOB, ranks=ranks, output=tmp_path / "rig.h5", progress=seen.append, **large)
    assert seen[0] > 0 and not (whole.regime == -128).any()


@pytest.mark.parametrize("line", ['rig = "stop.toml"', "rig = 'stop.toml'", '  rig="stop.toml"  # of the workshop', 'rig = "\\u0073top.toml"',
                                  '"rig" = "stop.toml"', "'rig' = 'stop.toml'"])
@pytest.mark.parametrize("name", ["plain", 'quo"ted', "back\\slash", "emoji \U0001f528"])
def test_a_rig_is_looked_for_from_here_whatever_this_folder_is_called(line, name, tmp_path, monkeypatch):
    folder = tmp_path / name
    folder.mkdir()
    (folder / "stop.toml").write_text(RIG[RIG.index("[hammer]"):])
    monkeypatch.chdir(folder)
    plane = MAP[MAP.index("[axes"):]
    assert "mass_kg = 0.298" in peterka.check(f'schema = 1\nkind = "map"\n{line}\n{plane}')


def test_a_path_is_no_option(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(peterka.PeterkaError):
        peterka.check("--help")
    (tmp_path / "--help").write_text(MAP)
    assert "mass_kg = 0.298" in peterka.check("--help")
    assert peterka.run("--help", ranks=1, output="-map.h5").regime.shape == (4, 4)
    assert (tmp_path / "-map.h5").is_file()


def test_a_byte_of_zero_is_told():
    with pytest.raises(peterka.PeterkaError, match="a byte of zero"):
        peterka.check("job\0.toml")


def test_one_gap_of_a_map_says_how_to_ask_for_a_plane(tmp_path):
    data = peterka.open(write_map(tmp_path / "a.h5"))
    from peterka.errors import PeterkaFileError

    with pytest.raises(PeterkaFileError, match=r"keep a plane with sel\(gap_ratio=\[1\]\)"):
        peterka.draw(data.sel(gap_ratio=1.0))
    assert peterka.draw(data.sel(gap_ratio=[1.0])).get_ylim() == (0.95, 1.05)


def test_what_guards_a_file_is_not_listed(tmp_path):
    path = write_map(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file["tiles/done"], file["run/tile_seconds"] = np.ones(3, "i1"), np.ones(3)
    groups = {name.partition("/")[0] for name in peterka.open(path).variables if "/" in name}
    assert groups == {"run"}
