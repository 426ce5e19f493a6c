"""Sweeps along any single number of the rig: each point starts where the previous one ended, in metres and seconds."""

import re

import h5py
import jobs
import launch
import numpy as np
import pytest
from any_axes import LABEL, SWEEPS, axis


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("name", SWEEPS)
def test_each_point_of_a_sweep_starts_where_the_one_before_ended(tmp_path, name, direction):
    """Position and velocity in SI units carry over: a job for the next point alone, started there, ends the same."""
    along, place = SWEEPS[name]
    key = re.search(r"\[axes\.(.*)\]", along)[1]
    coordinate = key.replace(".", "_")
    text = (jobs.RIG.format(kind="sweep", title=name) + place + f'[sweep]\ndirection = "{direction}"\nsamples = 64\n'
            + "[start]\nvelocity_ratio = 2.5\n" + along)
    jobs.write(tmp_path, text)
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as file:
        values, labels = file[coordinate][()], np.array([file[field][0] for field in LABEL]).T
        force = file["peak_force_ratio"][0]
        x, v = file["stroboscopic_displacement"][0], file["stroboscopic_velocity"][0]
        assert "gap_ratio" not in file or coordinate == "gap_ratio"
    assert (labels[:, 0] == 1).any()
    order = range(len(values)) if direction == "up" else range(len(values) - 1, -1, -1)
    scales = [units_at(place, key, value) for value in values]
    checked, before = 0, None
    for point in order:
        if before is not None and labels[before][2] == 1:  # one stroboscopic point: the end state
            length, rate, eta, gap = scales[point]
            old_length, old_rate, old_eta, _ = scales[before]
            start = x[before, 0] * old_length / length
            speed = (v[before, 0] + old_eta) * old_length * old_rate / (length * rate)
            if start < gap:  # the stop is not in the way
                assert settles_in(tmp_path, text, key, values[point], start, speed) == (
                    tuple(labels[point]), pytest.approx(force[point], rel=1e-7, nan_ok=True)), point
                checked += 1
        before = point
    assert checked > 1


def units_at(place, key, value):
    """A0 [m], omega [rad/s], eta and gap/A0."""
    length = value if key == "cart.amplitude_m" else 0.89e-3
    omega = 2 * np.pi * 4.5
    hertz = re.search(r"frequency_hz = (\S+)", place)
    eta = float(hertz[1]) * 2 * np.pi / omega if hertz else 1.8
    gap = value if key == "gap_ratio" else float(re.search(r"gap_m = (\S+)", place)[1]) / length
    return length, omega, eta, gap


def settles_in(folder, text, key, value, start, speed):
    text = re.sub(r"\[sweep\]\n.*\n.*\n", "", text).replace('kind = "sweep"', 'kind = "map"')
    text = text.replace("velocity_ratio = 2.5", f"velocity_ratio = {float(speed)!r}\ndisplacement_ratio = {float(start)!r}")
    text = re.sub(r"\[axes[^\[]*", axis(key, repr(float(value)), repr(float(value)), 1), text)
    other = "[axes.hammer.damping_ns_per_m]\nfrom = 0.06\nto = 0.06\npoints = 1\n"
    jobs.write(folder, text + other, "point.toml")
    finished = launch.run("run", "point.toml", "--fresh", "--quiet", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "point.h5") as file:
        return tuple(file[field][0, 0] for field in LABEL), file["peak_force_ratio"][0, 0]
