"""Axes, forces and lengths in the unit of the job first, the other one beside it."""

import re

import pages
import pytest
from conftest import JOBS

HERTZ, METRES = 4.5, 0.89e-3
RIG = f'schema = 1\nkind = "{{}}"\ntitle = "units"\nrig = "{JOBS}/rigs/170mm.toml"\n'
AXES = {
    "si": f"[axes.frequency_hz]\nfrom = {1.5 * HERTZ}\nto = {2.5 * HERTZ}\npoints = 12\n",
    "ratios": "[axes.frequency_ratio]\nfrom = 1.5\nto = 2.5\npoints = 12\n",
}
GAPS = {"si": f"[axes.gap_m]\nfrom = 0.0\nto = {METRES}\npoints = 12\n", "ratios": "[axes.gap_ratio]\nfrom = 0.0\nto = 1.0\npoints = 12\n"}
SWEPT = {"si": f"[sweep]\ngap_m = [{METRES}]\nsamples = 4\n", "ratios": "[sweep]\ngap_ratio = [1.0]\nsamples = 4\n"}


def opened(browser, tmp_path, kind, text):
    job = tmp_path / "job.toml"
    job.write_text(RIG.format(kind) + text)
    browser.open(pages.written(pages.compute(tmp_path, job)))
    browser.solved()


def scales(browser):
    """Words on the scales of the map: [below, above], [left, right]."""
    words = [one for one in browser.written_on_map() if re.search("[^-−0-9.]", one[0])]
    box = browser.ask("(({width, height}) => [width, height])(document.getElementById('map').getBoundingClientRect())")
    inside = [pages.MARGINS["left"] < x < box[0] - pages.MARGINS["right"] for _, x, _ in words]
    above = {y: text for (text, _, y), one in zip(words, inside) if one}
    beside = {x: text for (text, x, _), one in zip(words, inside) if not one}
    return [above[y] for y in sorted(above, reverse=True)], [beside[x] for x in sorted(beside)]


def show(browser, layer):
    browser.driver.execute_script("const s = document.getElementById('layer'); s.value = arguments[0]; s.dispatchEvent(new Event('change'))", layer)
    browser.until(lambda: layer in browser.ask("location.hash"), f"{layer} is not shown")
    browser.settle()


def in_order(unit, si, ratio):
    return [si, ratio] if unit == "si" else [ratio, si]


@pytest.mark.parametrize("unit", AXES)
def test_a_map_follows_the_units_of_its_job(browser, tmp_path, unit):
    opened(browser, tmp_path, "map", AXES[unit] + GAPS[unit])
    assert scales(browser) == (in_order(unit, "excitation frequency (Hz)", "Ω/ω"), in_order(unit, "gap (mm)", "gap/A₀"))
    newtons, weights = (re.search(rf"([\d.]+) {one}", browser.text("numbers")) for one in ("N", "m g"))
    assert float(newtons[1]) == pytest.approx(float(weights[1]) * 0.298 * 9.80665, rel=1e-3)
    assert (newtons.start() < weights.start()) == (unit == "si")
    show(browser, "peak_force_ratio")
    ticks = browser.ask("[...document.querySelectorAll('#legend .scale span')].map((one) => one.textContent)")
    assert all(tick.splitlines()[0].endswith("N") == (unit == "si") for tick in ticks) and len(ticks) > 2
    assert browser.complaints() == []


@pytest.mark.parametrize("unit", AXES)
def test_a_sweep_follows_the_units_of_its_job(browser, tmp_path, unit):
    opened(browser, tmp_path, "sweep", AXES[unit] + SWEPT[unit])
    along = in_order(unit, "excitation frequency (Hz)", "Ω/ω")
    assert scales(browser) == (along, in_order(unit, "peak force (N)", "F/(m g)"))
    show(browser, "impact_displacement")
    assert scales(browser) == (along, in_order(unit, "x (mm)", "x/A₀ at first touch"))
