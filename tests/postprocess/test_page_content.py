"""Contents of pages of sweeps and curves before a browser shows them:
tracks, the states of their motions, and curves with their orbits."""

import base64
import json
import re
import zlib

import h5py
import numpy as np
import pytest
from curves_samples import LINES, write_curves
from picture_samples import write_map
from sealing import SealedFile
from sweep_samples import POINTS, SAMPLES, write_sweep, write_sweep_with_starts

from peterka.errors import PeterkaFileError
from peterka.page import page as page_module
from peterka.page.engine import NoEngine
from peterka.pictures import open_file


@pytest.fixture(autouse=True)
def no_engine(monkeypatch):
    def missing():
        raise NoEngine("not asked for")
    monkeypatch.setattr(page_module, "module", missing)


def with_velocities(path):
    with SealedFile(path, "r+") as file:
        for name in [name for name in file if name.endswith(("stroboscopic_displacement", "impact_displacement"))]:
            file[name.replace("displacement", "velocity")] = 2 * file[name][()]
        if "attractor" in file:
            for kind in ("stroboscopic", "impact"):
                slots = np.full((4, POINTS, SAMPLES), -1, dtype="i4")
                slots[..., 0] = 0
                slots[2:, :6, 1] = 1
                file[f"{kind}_attractor"] = slots
    return path


def content_of(path, asked=None):
    """(content, numbers(packed reals)) of the page of a file."""
    with open_file(path) as file:
        text, _ = page_module.page(file, 1, asked)
    content = json.loads(re.search(r'id="content">(.*?)</script>', text, re.DOTALL).group(1))

    def numbers(packed):
        blob = re.search(rf'id="blob-{packed["blob"]}">(.*?)</script>', text).group(1)
        assert packed["plane"]["as"] == "reals"
        by_weight = np.frombuffer(zlib.decompress(base64.b64decode(blob)), np.uint8).reshape(8, -1)
        return np.ascontiguousarray(by_weight.T).view("<f8").ravel()
    return content, numbers


def test_branches_come_first_then_the_attractors_of_each_gap(tmp_path):
    content, numbers = content_of(with_velocities(write_sweep_with_starts(tmp_path / "sweep.h5")))
    assert content["gaps"] == [0.0, 1.5] and content["branches"] == 4 and content["gap"]["sets"] == "gap_ratio"
    assert [(track["gap"], track["slot"], track["direction"]) for track in content["tracks"]] == [
        (0, None, "up"), (0, None, "down"), (1, None, "up"), (1, None, "down"), (0, 0, "up"), (0, 1, "up"), (1, 0, "up"), (1, 1, "up")]
    layers = {layer["name"]: layer for layer in content["layers"]}
    force = numbers(layers["peak_force_ratio"]).reshape(8, POINTS)
    np.testing.assert_array_equal(force[7], [70] * 6 + [np.nan] * (POINTS - 6))
    with h5py.File(tmp_path / "sweep.h5") as file:
        np.testing.assert_array_equal(force[:4], file["peak_force_ratio"][()])
    assert layers["basin_share"]["first"] == 4
    np.testing.assert_array_equal(numbers(layers["basin_share"]).reshape(4, POINTS)[3], [0.25] * 6 + [0] * (POINTS - 6))


def test_each_point_has_where_its_motion_is(tmp_path):
    content, numbers = content_of(with_velocities(write_sweep_with_starts(tmp_path / "sweep.h5")))
    u, v = (numbers(content["starts"][f"stroboscopic_{name}"]).reshape(8, POINTS) for name in ("displacement", "velocity"))
    np.testing.assert_array_equal(v, 2 * u)
    with h5py.File(tmp_path / "sweep.h5") as file:
        np.testing.assert_array_equal(u[:4], file["stroboscopic_displacement"][..., 0])
    np.testing.assert_array_equal(u[7], [-9] * 6 + [np.nan] * (POINTS - 6))  # its sample follows the other's


def test_an_attractor_without_samples_has_its_orbit(tmp_path):
    path = with_velocities(write_sweep_with_starts(tmp_path / "sweep.h5"))
    with SealedFile(path, "r+") as file:
        file["stroboscopic_attractor"][2:, 2, 1] = -1
        for name, value in (("displacement", -8.5), ("velocity", 3.5)):
            file[f"attractor_orbit_{name}"] = np.full((2, 4, POINTS), value)
    content, numbers = content_of(path)
    u, v = (numbers(content["starts"][f"stroboscopic_{name}"]).reshape(8, POINTS)[7] for name in ("displacement", "velocity"))
    assert (u[1], u[2], v[2]) == (-9, -8.5, 3.5)


def test_layers_that_are_asked_for(tmp_path):
    path = with_velocities(write_sweep(tmp_path / "sweep.h5"))
    content, numbers = content_of(path, ["stroboscopic_velocity"])
    assert [layer["name"] for layer in content["layers"]] == ["peak_force_ratio", "stroboscopic_velocity"]
    assert content["layers"][1]["samples"] == SAMPLES
    for name in ("nothing", "jump", "regime", "sample"):
        with pytest.raises(PeterkaFileError, match=f"has no number of each point named {name}"):
            content_of(path, [name])


def test_curves_have_their_points_and_orbits(tmp_path):
    path = write_curves(tmp_path / "curves.h5")
    count = sum(len(points) for *_, points in LINES)
    content, numbers = content_of(path)
    assert content["curves"]["has_orbits"] is False  # as in files of older versions
    with SealedFile(path, "r+") as file:
        for n, name in enumerate(("multiplier", "peak_force_ratio", "orbit_displacement", "orbit_velocity")):
            file[f"point_{name}"] = n + np.arange(count) / 10
            file[f"point_{name}"].dims[0].attach_scale(file["point"])
        velocity = file["point_orbit_velocity"][()]
        del file["point_orbit_velocity"]
    assert content_of(path)[0]["curves"]["has_orbits"] is False  # half an orbit is none
    with SealedFile(path, "r+") as file:
        file["point_orbit_velocity"] = velocity
        file["point_orbit_velocity"].dims[0].attach_scale(file["point"])
    content, numbers = content_of(path)
    curves = content["curves"]
    assert curves["has_orbits"] is True
    assert [(one["kind"], one["impacts"], one["period"], one["to"] - one["from"]) for one in curves["list"]] == [
        (("fold", "period_doubling", "grazing")[kind], p, q, len(points)) for kind, p, q, points in LINES]
    np.testing.assert_array_equal(numbers(curves["points"]["column"]), [x for *_, points in LINES for x, _ in points])
    np.testing.assert_array_equal(numbers(curves["points"]["row"]), [y for *_, points in LINES for _, y in points])
    np.testing.assert_array_equal(numbers(curves["points"]["orbit_velocity"]), 3 + np.arange(count) / 10)
    assert [one["words"] for one in curves["specials"]] == ["fold with grazing", "cusp: two folds meet"]


def test_names_of_layers_have_no_units_in_them(tmp_path):
    titles = {"contact_power_w": ("contact power", "W"), "edge_distance_frequency_hz": ("edge distance frequency", "Hz"),
              "edge_kind_gap_m": ("edge kind gap", "1"), "edge_distance_gap_ratio": ("edge distance gap ratio", "1")}
    path = write_map(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        for name, (_, unit) in titles.items():
            file[name] = np.ones(file["regime"].shape)
            file[name].attrs["units"] = unit
    content, _ = content_of(path, list(titles))
    assert {layer["name"]: (layer["title"], layer["unit"]) for layer in content["layers"][1:]} == titles


def test_a_file_without_any_curve_is_a_coarse_map(tmp_path):
    path = write_curves(tmp_path / "curves.h5", lines=[], specials=[])
    content, numbers = content_of(path)
    assert content["curves"]["list"] == [] and len(numbers(content["curves"]["points"]["column"])) == 0


def test_directions_are_told_without_mathematics(tmp_path):
    path = with_velocities(write_sweep(tmp_path / "sweep.h5", job="[axes.contact.stiffness_n_per_m]\nfrom = 1.0\n"))
    with SealedFile(path, "r+") as file:
        file["contact_stiffness_n_per_m"] = 1e6 * file["frequency_ratio"][()]
        del file["frequency_ratio"]
    content, _ = content_of(path)
    assert {track["words"] for track in content["tracks"]} == {"stop stiffness rising", "stop stiffness falling"}
