"""Pictures of elasticities: of each number, and of the one that matters most, with and without [uncertainty]."""

import h5py
import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.text import Text
from peterka.maps import elasticity_map
from peterka.maps.elasticity_map import NUMBERS, deviation_of, draw, draw_most, spoken
from peterka.maps.map_file import PeterkaFile
from peterka.pictures import pictures_of
from peterka.plotting import fills, style
from sealing import seal_file
from uncertain_samples import write_uncertain

pytestmark = pytest.mark.thorough

ROWS, COLUMNS = 24, 32
STIFFNESS, GAP, RATIO = "contact_stiffness_n_per_m", "gap_m", "hammer_damping_ratio"


def with_elasticities(path, values, result="force"):
    with h5py.File(path, "r+") as file:
        regime = file["regime"][()]
        for number, value in values.items():
            file[f"{result}_elasticity_{number}"] = np.where(regime == 1, value * np.ones(regime.shape), np.nan)
    seal_file(path)
    return path


def sample(folder, **values):
    return with_elasticities(write_uncertain(folder / "a.h5"), values)


def ramp():
    return np.linspace(-2, 1, COLUMNS)[None, :] * np.ones((ROWS, 1))


def orbits(path):
    with h5py.File(path) as file:
        return file["regime"][()] == 1


def test_an_elasticity_has_a_scale_around_0(tmp_path):
    path = sample(tmp_path, **{STIFFNESS: ramp()})
    with PeterkaFile(path) as file:
        ax = draw(file, number=STIFFNESS)
    mesh = ax.collections[-1]
    low, high = mesh.get_clim()
    assert low == -high and 1 < high <= 2
    shown = np.ma.filled(mesh.get_array().reshape(ROWS, COLUMNS), np.nan)
    np.testing.assert_allclose(shown, np.where(orbits(path), ramp(), np.nan))
    assert any(axes.get_xlabel() == "peak force by stop stiffness (% per %)" for axes in ax.figure.axes)


def colours_of(ax):
    mesh = ax.collections[-1]
    return np.vectorize(lambda value: to_hex(mesh.to_rgba(value)).upper())(mesh.get_array().reshape(ROWS, COLUMNS).filled(0))


def test_what_matters_most_has_the_colour_of_its_number(tmp_path):
    path = sample(tmp_path, hammer_mass_kg=0.3, frequency_hz=ramp())
    with PeterkaFile(path) as file:
        ax = draw_most(file)
    colours = colours_of(ax)
    is_orbit = orbits(path)
    most = np.where(np.abs(ramp()) > 0.3, NUMBERS["frequency_hz"][0], NUMBERS["hammer_mass_kg"][0])
    assert (colours[is_orbit] == most[is_orbit]).all()
    assert not np.isin(colours[~is_orbit], most).any()
    assert "depends most" in " ".join(ax.figure._suptitle.get_text().split())


def test_with_uncertain_numbers_it_is_what_spreads_most(tmp_path):
    """3 % of the stiffness; a damping ratio that the job doesn't give has no relative deviation, nor a gap that is certain: one alone isn't
    compared."""
    path = sample(tmp_path, **{STIFFNESS: 1.0, RATIO: 1.0, GAP: 100.0})
    with PeterkaFile(path) as file:
        assert deviation_of(file, STIFFNESS) == pytest.approx(0.03)
        assert deviation_of(file, RATIO) is None and deviation_of(file, GAP) is None
        assert "per relative change" in " ".join(draw_most(file).figure._suptitle.get_text().split())


@pytest.mark.parametrize("offset, ratio", [("gap_m = { standard_deviation = 4e-6 }", 4e-6 / 0.89e-3),
                                           ("gap_ratio = { from = -1e-3, to = 1e-3 }", 1e-3 / 3**0.5)])
def test_offsets_of_the_gap_count_relative_to_it(tmp_path, offset, ratio):
    path = sample(tmp_path, **{STIFFNESS: 1.0, GAP: 10.0})
    with h5py.File(path, "r+") as file:
        job = file.attrs["job"]
        job = job if isinstance(job, str) else job.decode()
        file.attrs["job"] = job + f"[uncertainty.operating_point]\n{offset}\n"
        file.attrs["cart_amplitude_m"] = 0.89e-3
    seal_file(path)
    with PeterkaFile(path) as file:
        deviation = deviation_of(file, GAP)
        np.testing.assert_allclose(deviation[1:], ratio / file.rows.values[1:, None])
        ax = draw_most(file)
        colours = colours_of(ax)
    assert any("an uncertain number is 0" in text.get_text() for text in ax.figure.findobj(Text))  # the gap of the first row
    is_orbit = orbits(path)[6]
    larger = 10 * deviation[6, 0] > 0.03
    assert (colours[6][is_orbit] == NUMBERS[GAP if larger else STIFFNESS][0]).all()


def test_a_file_gives_a_picture_of_each_and_one_more_of_two(tmp_path):
    def names(**values):
        with PeterkaFile(sample(tmp_path, **values)) as file:
            return {name for name in pictures_of(file) if "elasticity" in name or name == "depends_most"}

    assert names(**{GAP: 1.0}) == {"elasticity_gap_m"}
    assert names(**{GAP: 1.0, STIFFNESS: 2.0}) == {"elasticity_gap_m", f"elasticity_{STIFFNESS}", "depends_most"}


def test_without_an_orbit_there_is_none(tmp_path):
    path = sample(tmp_path, **{GAP: np.nan, STIFFNESS: np.nan})
    with PeterkaFile(path) as file:
        assert draw(file, number=GAP) is None and draw_most(file) is None


def test_colours_are_distinct_in_words_and_grey():
    looks = list(NUMBERS.values())
    assert len({colour for colour, _ in looks}) == len({hatch for _, hatch in looks}) == len(looks)
    assert len({spoken(number) for number in NUMBERS}) == len(NUMBERS)
    assert elasticity_map.OTHERS[0][1] not in {colour for colour, _ in looks}


def test_in_grey_what_matters_most_is_no_void(tmp_path):
    path = sample(tmp_path, hammer_mass_kg=0.3, frequency_hz=ramp())
    with style.using(palette="grey"), PeterkaFile(path) as file:
        patches = {text.get_text().partition(" (")[0]: patch.get_facecolor()[:3] for text, patch in
                   zip(*(lambda legend: (legend.get_texts(), legend.get_patches()))(
                       next(ax.get_legend() for ax in draw_most(file).figure.axes if ax.get_legend())))}
    assert patches["no elasticity"] == (1, 1, 1) and max(patches["excitation frequency"]) < 0.8


def test_grey_hatchings_of_all_numbers_are_drawn_and_differ():
    masks = [fills.strokes(hatch, 240, 240) for _, hatch in NUMBERS.values() if hatch]
    assert all(0.05 < mask.mean() < 0.95 and mask.shape == (240, 240) for mask in masks)
    assert all((one != other).mean() > 0.05 for n, one in enumerate(masks) for other in masks[:n])


def test_white_is_0_whatever_the_limits(tmp_path):
    with style.using(limits=(0.0, 2.0)), PeterkaFile(sample(tmp_path, **{GAP: 1.0})) as file:
        ax = draw(file, number=GAP)
        mesh, scales = ax.collections[-1], [one.get_xlim() for one in ax.figure.axes]
        assert mesh.norm(0.0) == 0.5 and (0.0, 2.0) in scales
