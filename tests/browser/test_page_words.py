"""What pages write beside sliders, on scales and in legends: a damping that is common to all cells, each unit once, powers of ten, long
numbers with room for them, and no line that isn't there."""

import re

import h5py
import numpy as np
import pages
import pytest
from test_page_any_axes import RIG, axis
from test_page_sweep import PLACE, RIGID

VISCOUS = RIG.replace("damping_ratio = 0.02", "damping_ns_per_m = 0.06")


def opened(browser, tmp_path, text):
    job = tmp_path / "job.toml"
    job.write_text(text)
    browser.open(pages.written(pages.compute(tmp_path, job)))


def slider(browser, name):
    """[label, number with its unit]; None where there is none."""
    return browser.ask(f"((one) => one && [...one.closest('label').querySelectorAll('span, output')].map((part) => part.textContent))"
                       f"(document.getElementById('slider-{name}'))")


def test_where_the_mass_is_an_axis_a_common_damping_has_its_slider(browser, tmp_path):
    opened(browser, tmp_path, VISCOUS + axis("contact.stiffness_n_per_m", 1e6, 9e6) + axis("hammer.mass_kg", 0.8, 1.6) + PLACE)
    assert slider(browser, "damping_ratio") is None
    assert slider(browser, "damping_ns_per_m") == ["spring damping", "0.0600 Ns/m"]
    browser.slide("slider-damping_ns_per_m", 400)
    assert slider(browser, "damping_ns_per_m")[1] == "6.00 Ns/m"
    browser.until(lambda: browser.data("live-state", "finished") == "true", "no live map")
    assert "damping_ns_per_m=6" in browser.ask("location.hash") and browser.complaints() == []


def test_a_damping_ratio_that_is_common_has_its_slider(browser, tmp_path):
    opened(browser, tmp_path, RIG + axis("contact.stiffness_n_per_m", 1e6, 9e6) + axis("hammer.mass_kg", 0.8, 1.6) + PLACE)
    assert slider(browser, "damping_ratio") == ["damping ratio", "0.0200"] and slider(browser, "damping_ns_per_m") is None


@pytest.mark.parametrize("rig, axes, name, told", [
    (RIGID, axis("frequency_hz", 30.0, 50.0) + axis("contact.coefficient", 0.2, 0.8) + "[operating_point]\ngap_ratio = 0.5\n",
     "contact_first", ["coefficient of restitution", "0.500"]),
    (RIG, axis("frequency_hz", 30.0, 50.0) + axis("hammer.damping_ratio", 0.01, 0.03) + "[operating_point]\ngap_ratio = 0.5\n",
     "damping_ratio", ["damping ratio", "0.0200"]),
    (RIG, axis("frequency_ratio", 1.0, 2.0) + axis("hammer.natural_frequency_hz", 18.0, 26.0) + "[operating_point]\ngap_ratio = 0.5\n",
     "frequency_ratio", ["frequency", "1.50 Ω/ω"]),
    (RIG, axis("contact.stiffness_n_per_m", 1e6, 9e6) + axis("hammer.mass_kg", 0.8, 1.6) + PLACE,
     "contact_first", ["stop stiffness", "5.0·10⁶ N/m"])])
def test_a_slider_of_an_axis_has_the_unit_of_its_number(browser, tmp_path, rig, axes, name, told):
    opened(browser, tmp_path, rig + axes)
    browser.solved()
    label, number = slider(browser, name)
    assert label == told[0]
    value, _, unit = number.partition(" ")
    assert unit == told[1].partition(" ")[2] and re.fullmatch(r"[\d.]+(·10[⁰¹²³⁴⁵⁶⁷⁸⁹]+)?", value)


def test_ticks_have_powers_of_ten(browser, tmp_path):
    opened(browser, tmp_path, RIG + axis("contact.stiffness_n_per_m", 0.5e6, 10.5e6, 11) + axis("hammer.mass_kg", 0.8, 1.6) + PLACE)
    ticks = [text for text, *_ in browser.written_on_map()]
    assert {"2·10⁶", "4·10⁶", "1.0·10⁷"} <= set(ticks) and not any("^" in text for text in ticks)


def test_names_of_scales_stand_beside_long_numbers(browser, tmp_path):
    """Displacements of 0.0001 mm, of a sweep without impacts."""
    opened(browser, tmp_path, RIG.replace('kind = "map"', 'kind = "sweep"') + axis("frequency_hz", 0.2, 0.5, 20) + "[sweep]\ngap_m = [2e-3]\n")
    written = browser.written_on_map()
    width = browser.ask("document.getElementById('map').getBoundingClientRect().width")
    names = {side: x for text, x, _ in written if text.startswith("x") for side in [x > width / 2]}
    assert len(names) == 2
    long = 0
    for text, x, _ in written:
        if not re.fullmatch(r"[−\d.·⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", text) or 100 < x < width - 100:
            continue
        letters = browser.ask(f"((pen) => (pen.font = pen.font.replace(/^[\\d.]+px/, '11px'), pen.measureText('{text}').width))"
                              "(document.getElementById('map').getContext('2d'))")
        long += letters > 46
        assert x + letters < names[True] - 6 if x > width / 2 else x - letters > names[False] + 6, text
    assert long > 5


@pytest.mark.parametrize("frequencies, gaps, seen", [((0.1, 0.3), (2.0, 3.0), False), ((1.1, 3.0), (0.0, 2.0), True)])
def test_the_line_of_grazing_is_named_where_it_is_seen(browser, tmp_path, frequencies, gaps, seen):
    opened(browser, tmp_path, RIG + axis("frequency_ratio", *frequencies) + axis("gap_ratio", *gaps))
    assert ("free swing grazes the stop" in browser.text("legend")) == seen


def test_a_filled_cell_is_told_as_such(browser, tmp_path):
    """It had no run: no status, no engine, and a result that the page's engine can't contradict."""
    job = tmp_path / "job.toml"
    job.write_text(VISCOUS + axis("frequency_hz", 20.0, 60.0, 33) + axis("gap_m", 1e-4, 9e-4, 33) + "[refine]\nlevels = 3\n")
    file = pages.compute(tmp_path, job)
    with h5py.File(file) as data:
        row, column = np.argwhere(data["computed"][()] == 0)[5].tolist()
        place = f"{float(data['frequency_hz'][column]) / data.attrs['natural_frequency_hz']!r},{float(data['gap_m'][row]) / data.attrs['cart_amplitude_m']!r}"
        filled = float(np.mean(data["computed"][()] == 0))
    browser.open(pages.written(file), f"at={place}&layer=status")
    browser.solved()
    browser.until(lambda: re.search(rf"filled from the cells around\W+{100 * filled:.1f}", browser.text("legend")), "the legend doesn't tell of filled cells")
    browser.until(lambda: "filled from those around" in browser.text("agreement"), "the panel doesn't say that the cell was filled")
    assert browser.complaints() == []
