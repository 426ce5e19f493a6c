"""Dimensionless numbers: each one in a file has a picture, with the cells that carry it and its own scale."""

import matplotlib
import numpy as np
import pytest
from matplotlib.colors import to_hex
from peterka.maps import field_map, number_map
from peterka.maps.map_file import PURE_NUMBERS, PeterkaFile
from peterka.pictures import pictures_of
from picture_samples import CHAOTIC, FAILED, NO_IMPACT, Drawn, colour_named, orbit, write_map

pytestmark = pytest.mark.thorough

CELLS = [[orbit(1, 1), orbit(1, 2)], [CHAOTIC, NO_IMPACT], [FAILED, orbit(1, 1)]]


def drawn_of(folder, name, values):
    with PeterkaFile(write_map(folder / "a.h5", CELLS, fields={name: values})) as file:
        drawn = Drawn(number_map.draw(file, name=name), folder / "a.png")
        return drawn, np.array([[drawn.colour_of(file, row, column) for column in range(2)] for row in range(3)])


def test_a_multiplier_is_that_of_orbits(tmp_path):
    drawn, seen = drawn_of(tmp_path, "multiplier", [[0.2, 0.8], [np.nan, 0.4], [np.nan, 0.0]])
    colours = matplotlib.colormaps[field_map.COLOURS]
    assert seen[0, 1] == to_hex(colours(1.0)).upper() and seen[1, 1] == to_hex(colours(0.5)).upper()
    assert seen[1, 0] == colour_named("chaotic") and seen[2, 0] == colour_named("failed")
    assert drawn.figure.axes[1].get_xlabel() == r"largest Floquet multiplier $|\mu|$"


def test_an_exponent_s_scale_does_not_begin_at_zero_and_chaos_has_one(tmp_path):
    drawn, seen = drawn_of(tmp_path, "lyapunov", [[-3.0, -1.0], [1.0, -2.0], [np.nan, -0.5]])
    norm = drawn.map_axes.collections[-1].norm
    assert norm.vmax == 1.0 and -3.0 <= norm.vmin < -2.5
    assert seen[1, 0] == to_hex(matplotlib.colormaps[field_map.COLOURS](1.0)).upper()


def test_forces_of_each_cycle_are_in_newtons_too(tmp_path):
    drawn, _ = drawn_of(tmp_path, "peak_force_q95_ratio", [[10.0, 20.0], [30.0, 0.0], [np.nan, 40.0]])
    second, = drawn.figure.axes[1].child_axes
    assert second.get_xlabel() == "force (N)"
    assert second.get_xlim()[1] == pytest.approx(40 * 0.298 * 9.80665)
    assert drawn.map_texts()[0].startswith("max 40")


@pytest.mark.parametrize("name, ratio, si, factor, unit", [
    ("orbit_displacement", "$u/A_0$", "$u$", 0.89, "mm"),
    ("orbit_velocity", r"$\dot{u}/(A_0\omega)$", r"$\dot{u}$", 2 * np.pi * 4.5 * 0.89e-3, "m/s")])
def test_the_state_of_an_orbit_is_in_the_units_of_the_picture(tmp_path, name, ratio, si, factor, unit):
    """A0 omega is the unit of velocities, omega that of the hammer."""
    path = write_map(tmp_path / "a.h5", CELLS, fields={name: np.array([[-2.0, 1.0], [np.nan, 0.0], [np.nan, 2.0]])})
    ratio, si = f"{ratio} at forcing phase 0", f"{si} at forcing phase 0 ({unit})"
    with PeterkaFile(path) as file:
        for units, labels, top in (("both", [ratio, si], 2), ("ratio", [ratio], 2), ("si", [si], 2 * factor)):
            ax = number_map.draw(file, name=name, units=units)
            bar = ax.figure.axes[1]
            assert [bar.get_xlabel(), *(scale.get_xlabel() for scale in bar.child_axes)] == labels
            assert bar.get_xlim()[1] == pytest.approx(top)
            if units == "both":
                bar.figure.canvas.draw()
                assert bar.child_axes[0].get_xlim()[1] == pytest.approx(2 * factor)


def test_an_orbit_without_the_rig_is_in_ratios(tmp_path):
    path = write_map(tmp_path / "a.h5", CELLS, fields={"orbit_velocity": np.ones((3, 2))}, cart_amplitude_m=np.nan)
    with PeterkaFile(path) as file:
        assert number_map.draw(file, name="orbit_velocity", units="si").figure.axes[1].get_xlabel().startswith(r"$\dot{u}/(A_0")


@pytest.mark.parametrize("name", PURE_NUMBERS)
def test_each_has_a_picture_where_the_file_has_it(tmp_path, name):
    assert set(number_map.NUMBERS) == set(PURE_NUMBERS)
    values = np.where(np.array(CELLS)[..., 0] == 5, np.nan, 0.5)
    with PeterkaFile(write_map(tmp_path / "a.h5", CELLS, fields={name: values})) as file:
        assert name in pictures_of(file)
    with PeterkaFile(write_map(tmp_path / "b.h5", CELLS)) as file:
        assert name not in pictures_of(file)


@pytest.mark.parametrize("name, is_marked", [("orbit_displacement", False), ("orbit_velocity", False), ("lyapunov", True), ("multiplier", True)])
def test_a_coordinate_has_no_largest_value_marked(tmp_path, name, is_marked):
    """Its values have either sign, and the largest one means nothing; the largest exponent does."""
    drawn, _ = drawn_of(tmp_path, name, [[0.3, 0.8], [0.5, 0.4], [np.nan, 0.1]])
    assert any("max" in text.get_text() for text in drawn.map_axes.texts) == is_marked
