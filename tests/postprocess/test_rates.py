"""Changes of a force per Hz, mm, kN/m, from elasticities: against differences of a force that is known in closed form, in tables and
pictures, and not where a file doesn't tell what they take."""

import csv

import h5py
import numpy as np
import pytest
from peterka.maps import signed_map
from peterka.maps.elasticity_map import NUMBERS
from peterka.maps.map_file import PeterkaFile
from peterka.maps.rates import NAMES, RESULTS, UNITS
from peterka.pictures import pictures_of
from peterka.plotting import style
from peterka.plotting.figures import figure_of
from peterka.plotting.frames import label_of_bar, text_width
from picture_samples import orbit, write_map
from picture_texts import faults_of_layout
from sealing import seal_file
from sweep_samples import write_sweep

MASS, HERTZ, AMPLITUDE, STIFFNESS = 3.1, 14.0, 0.5e-3, 2e6
WEIGHT = MASS * 9.80665  # N
POWERS = {"frequency_hz": 2.0, "gap_m": -0.5, "contact_stiffness_n_per_m": 0.25}
JOB = f"""
hammer = {{ mass_kg = {MASS}, natural_frequency_hz = {HERTZ}, damping_ratio = 0.01 }}
cart = {{ amplitude_m = {AMPLITUDE} }}
contact = {{ law = "kelvin_voigt", stiffness_n_per_m = {STIFFNESS}, damping_ns_per_m = 100.0 }}
[axes]
frequency_ratio = {{ from = 1.0, to = 2.0, points = 5 }}
gap_ratio = {{ from = 0.0, to = 2.0, points = 4 }}
"""


def newtons(hertz, metres, stiffness):
    """A force that is a power of each number, so that its elasticities are the powers."""
    return 3 * hertz**2 * np.maximum(metres, 1e-30) ** -0.5 * stiffness**0.25 / 1e3


def sample(folder, job=JOB, **attributes):
    frequencies, gaps = np.linspace(1, 2, 5), np.linspace(0, 2, 4)
    forces = newtons(HERTZ * frequencies[None, :], AMPLITUDE * gaps[:, None], STIFFNESS) / WEIGHT
    rig = {"natural_frequency_hz": HERTZ, "cart_amplitude_m": AMPLITUDE, "hammer_mass_kg": MASS, "job": job} | attributes
    path = write_map(folder / "a.h5", [[orbit(1, 1)] * 5] * 4, frequencies, gaps, forces=forces, **rig)
    with h5py.File(path, "r+") as file:
        for number, power in POWERS.items():
            file[f"force_elasticity_{number}"] = np.full((4, 5), power)
    seal_file(path)
    return path


def table(folder, run_program, path):
    assert run_program("export", path)[0] == 0
    with open(folder / path.with_suffix(".csv").name, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


def test_a_table_has_what_a_small_step_of_each_number_does(tmp_path, run_program):
    lines = table(tmp_path, run_program, sample(tmp_path))
    for line in lines[5:]:
        hertz, metres = float(line["frequency_hz"]), float(line["gap_mm"]) / 1e3
        here = np.array([hertz, metres, STIFFNESS])
        assert float(line["peak_force_n"]) == pytest.approx(newtons(*here))
        for n, (name, unit) in enumerate((("force_per_frequency_n_per_hz", 1.0), ("force_per_gap_n_per_mm", 1e-3),
                                          ("force_per_stop_stiffness_n_per_kn_per_m", 1e3))):
            step = np.zeros(3)
            step[n] = 1e-6 * here[n]
            slope = (newtons(*(here + step)) - newtons(*(here - step))) / (2 * step[n]) * unit
            assert float(line[name]) == pytest.approx(slope, rel=1e-6), name


def test_no_column_of_an_elasticity_reads_as_if_it_had_a_unit(tmp_path, run_program):
    line = table(tmp_path, run_program, sample(tmp_path))[7]
    assert {name: float(value) for name, value in line.items() if "elasticity" in name} == {
        "force_elasticity_by_frequency": 2.0, "force_elasticity_by_gap": -0.5, "force_elasticity_by_stop_stiffness": 0.25}


def test_at_a_number_of_0_there_is_no_rate(tmp_path, run_program):
    lines = table(tmp_path, run_program, sample(tmp_path))
    assert [line["force_per_gap_n_per_mm"] for line in lines[:5]] == [""] * 5  # gap 0
    assert all(line["force_per_frequency_n_per_hz"] for line in lines[:5])


def test_a_picture_tells_its_unit(tmp_path):
    with PeterkaFile(sample(tmp_path)) as file:
        drawn = {name: draw(file) for name, draw in pictures_of(file).items() if name.startswith("force_per_")}
    labels = {name: " ".join(ax.get_xlabel() for ax in drawn[name].figure.axes) for name in drawn}
    assert set(drawn) == {"force_per_frequency", "force_per_gap", "force_per_stop_stiffness"}
    assert "kN per mm)" in labels["force_per_gap"] and "per kN/m)" in labels["force_per_stop_stiffness"]
    shown = np.ma.filled(drawn["force_per_gap"].collections[-1].get_array().reshape(4, 5), np.nan)
    assert np.isnan(shown[0]).all() and (shown[1:] < 0).all()
    force = newtons(HERTZ * 1.5, AMPLITUDE * 2, STIFFNESS)
    assert shown[3, 2] == pytest.approx(-0.5 * force / 1.0 / 1e3)  # kN per mm at a gap of 1 mm


@pytest.mark.parametrize("attributes, gone", [
    ({"hammer_mass_kg": "unknown"}, {"force_per_frequency", "force_per_gap", "force_per_stop_stiffness"}),
    ({"cart_amplitude_m": "unknown"}, {"force_per_gap"}), ({"natural_frequency_hz": "unknown"}, {"force_per_frequency"})])
def test_what_the_file_does_not_tell_gives_no_rate(tmp_path, attributes, gone):
    with PeterkaFile(sample(tmp_path, **attributes)) as file:
        names = {name for name in pictures_of(file) if name.startswith("force_per_")}
    assert names == {"force_per_frequency", "force_per_gap", "force_per_stop_stiffness"} - gone


@pytest.mark.parametrize("units", ["si", "both"])
def test_pictures_of_rates_fit_a_column(tmp_path, monkeypatch, units):
    with PeterkaFile(sample(tmp_path)) as file:
        for name in ("force_per_frequency", "force_per_stop_stiffness"):
            faults = faults_of_layout(figure_of(pictures_of(file)[name](file, width=84, units=units)), monkeypatch)
            assert not faults, f"{name}:\n" + "\n".join(faults)


def test_the_points_of_a_sweep_have_them(tmp_path, run_program):
    path = write_sweep(tmp_path / "s.h5", gaps=(0.5, 1.5), job=JOB)
    with h5py.File(path, "r+") as file:
        shape = file["regime"].shape
        file["force_elasticity_gap_m"], file["force_elasticity_frequency_hz"] = np.full(shape, -0.5), np.full(shape, 2.0)
    seal_file(path)
    lines = table(tmp_path, run_program, path)
    assert len({line["gap_mm"] for line in lines}) == 2
    for line in lines:
        force = float(line["peak_force_n"])
        assert float(line["force_per_gap_n_per_mm"]) == pytest.approx(-0.5 * force / float(line["gap_mm"]), rel=1e-12)
        assert float(line["force_per_frequency_n_per_hz"]) == pytest.approx(2 * force / float(line["frequency_hz"]), rel=1e-12)


def test_each_number_that_has_elasticities_has_rates():
    assert list(UNITS) == list(NUMBERS) and len(set(NAMES)) == len(NAMES) == 2 * len(NUMBERS)


def test_the_label_of_each_rate_fits_a_journal_s_column():
    with style.using(width=84):
        for result, unit, words in ((name, unit, words) for name, (_, unit, _, words) in RESULTS.items()):
            for short, _, per, _ in UNITS.values():
                told = label_of_bar(f"change of {words} by {short.replace('_', ' ')}", f"(m{unit} per {per})", " ", signed_map.WIDTH)
                assert text_width(told, 8) < 84 / 25.4, told
