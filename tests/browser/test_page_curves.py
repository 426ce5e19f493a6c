"""Pages of curves: a click on a curve shows the motions on its two sides, which equal those that the program finds there."""

import re
import subprocess

import h5py
import numpy as np
import pages
import pytest
from conftest import JOBS
from selenium.webdriver.common.action_chains import ActionChains
from test_page_any_axes import RIG, axis
from test_page_sweep import point_at

SMALL = ("axes.frequency_ratio.points=40", "axes.gap_ratio.points=40", "curves.max_period=2")
FOLD, DOUBLING, GRAZING = 0, 1, 2
BORDER = 1.862464993  # of 1/1 at gap/A0 = 1.5: its fold, from an independent program


@pytest.fixture(scope="module")
def curves_file(tmp_path_factory):
    return pages.compute(tmp_path_factory.mktemp("curves"), JOBS / "curves_170mm.toml", *SMALL)


@pytest.fixture(scope="module")
def curves_page(curves_file):
    return pages.written(curves_file)


def stored(file):
    with h5py.File(file) as data:
        return {name: data[name][()] for name in data if name.startswith(("curve_", "point_"))}


def edge_near(kept, kind, impacts, period, frequency, gap):
    """(curve, point) of this kind nearest to a place."""
    curves = np.flatnonzero((kept["curve_kind"] == kind) & (kept["curve_impacts"] == impacts) & (kept["curve_period"] == period))
    points = [(curve, point) for curve in curves for point in range(kept["curve_points"][curve])]
    at = [kept["curve_first"][curve] + point for curve, point in points]
    off = np.hypot(kept["point_frequency_ratio"][at] - frequency, kept["point_gap_ratio"][at] - gap)
    return *map(int, points[int(np.argmin(off))]), at[int(np.argmin(off))]


def by_the_program(folder, kept, at, frequency, gap):
    """(regime, p, q, force) of a trace from the orbit on the curve, at another place."""
    (folder / "trace.toml").write_text(f"""schema = 1
kind = "trace"
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
damping_ns_per_m = 0.06
[cart]
amplitude_m = 0.89e-3
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 5.5e6
damping_ns_per_m = 1.2e3
[operating_point]
frequency_ratio = {frequency!r}
gap_ratio = {gap!r}
[start]
displacement_ratio = {float(kept["point_orbit_displacement"][at])!r}
velocity_ratio = {float(kept["point_orbit_velocity"][at]) + frequency!r}
[trace]
cycles = 1
samples_per_cycle = 100
""")
    run = subprocess.run([pages.BINARY, "run", "trace.toml", "--output", "trace.h5", "--quiet", "--fresh"], cwd=folder,
                         capture_output=True, text=True, timeout=pages.HANGING, stdin=subprocess.DEVNULL)
    assert run.returncode == 0, run.stderr
    with h5py.File(folder / "trace.h5") as data:
        return [data["cell"][name][()].item() for name in ("regime", "impacts", "period", "peak_force_ratio")]


@pytest.mark.parametrize("kind, impacts, period, frequency, gap, words", [
    (FOLD, 1, 1, BORDER, 1.5, "fold: the orbit is born or ends"),
    (DOUBLING, 1, 1, 2.66, 0.0, "period doubling"),
    (GRAZING, 0, 1, 1.55, 1.7, "grazing: an impact is gained or lost"),
])
def test_a_click_on_a_curve_shows_the_motions_on_both_sides(browser, curves_file, curves_page, tmp_path, kind, impacts, period, frequency, gap, words):
    kept = stored(curves_file)
    curve, point, at = edge_near(kept, kind, impacts, period, frequency, gap)
    x, y = (float(kept[f"point_{name}_ratio"][at]) for name in ("frequency", "gap"))
    window = ((x - 0.3, x + 0.3), (max(y - 0.3, -0.05), max(y - 0.3, -0.05) + 0.6))
    browser.open(curves_page, "at=4,4.5&x={:.9g},{:.9g}&y={:.9g},{:.9g}".format(*window[0], *window[1]))
    browser.solved()
    moves = point_at(browser, x, y, window)
    moves.perform()
    told = browser.text("readout").replace("−", "-")
    label = "no impact" if impacts == 0 else f"z = {impacts}/{period}"
    assert words in told and label in told
    assert float(re.search(r"([\d.]+) Hz", told)[1]) == pytest.approx(4.5 * x, rel=1e-2)
    moves.click().perform()
    browser.until(lambda: browser.data("edge", "state") == "solved", "the sides are not solved")
    browser.solved()
    chosen = re.search(r"curve=(\d+),(\d+)", browser.ask("location.hash"))
    curve, point = map(int, chosen.groups())
    at = int(kept["curve_first"][curve]) + point
    assert (kept["curve_kind"][curve], kept["curve_impacts"][curve], kept["curve_period"][curve]) == (kind, impacts, period)
    said = browser.text("edge-words")
    assert words in said and label in said and " Hz" in said and " mm" in said
    assert "0.10 % of the window" in browser.text("edge-step") and "cubic" in browser.text("edge-step")
    sides = browser.promise(f"peterka.beside({curve}, {point})")
    assert sum(side["keeps"] for side in sides) == 1
    for number, side in enumerate(sides):
        regime, p, q, force = by_the_program(tmp_path, kept, at, *side["values"])
        assert [side[name] for name in ("regime", "impacts", "period")] == [regime, p, q]
        assert regime == 2 or side["peak_force_ratio"] == pytest.approx(force, rel=1e-9)
        assert side["keeps"] == ((p, q) == (impacts, period) and regime == (0 if impacts == 0 else 1))
        browser.find(f"side-{number}").click()
        words_of_side = "no impact" if regime == 0 else "chaotic" if regime == 2 else f"z = {p}/{q}"
        browser.until(lambda: browser.text("z") == words_of_side, f"the motion {words_of_side} is not shown")
        browser.solved()
        if regime == 1:
            assert float(browser.text("newtons").split()[0]) == pytest.approx(force * 0.298 * 9.80665, rel=1e-3)
        fate = browser.ask(f"document.getElementById('side-{number}').parentNode.textContent")
        assert words_of_side in fate and ("keeps the motion" if side["keeps"] else "what becomes of it") in fate
    assert browser.complaints() == []


def along(kept, *shares):
    """[curve, point] of each curve, at these shares of its points."""
    return [[curve, int(share * (count - 1))] for curve, count in enumerate(kept["curve_points"]) for share in shares]


def test_one_side_of_almost_each_curve_keeps_its_motion(browser, curves_file, curves_page):
    kept = stored(curves_file)
    browser.open(curves_page)
    all_sides = browser.promise(f"Promise.all({along(kept, 0.5)}.map((at) => peterka.beside(...at)))")
    one = 0
    for curve, sides in enumerate(all_sides):
        one += sum(side["keeps"] for side in sides) == 1
        for side in sides:
            label = (0, 1) if side["regime"] == 0 else (side["impacts"], side["period"])
            assert not side["keeps"] or label == (kept["curve_impacts"][curve], kept["curve_period"][curve])
    assert one >= 0.9 * len(all_sides)


OVER = {
    "Hz and m": axis("frequency_hz", 30.0, 60.0, 24) + axis("gap_m", 0.0, 0.6e-3, 24),
    "the stop": axis("contact.damping_ns_per_m", 100.0, 1500.0, 24) + axis("contact.stiffness_n_per_m", 1e5, 9e6, 24)
                + "[operating_point]\nfrequency_hz = 52.0\ngap_m = 0.1e-3\n",
    "amplitude and gap in m": axis("cart.amplitude_m", 0.2e-3, 0.8e-3, 24) + axis("gap_m", 0.0, 0.6e-3, 24) + "[operating_point]\nfrequency_hz = 48.0\n",
}


@pytest.mark.parametrize("over", OVER)
def test_over_any_axes(browser, tmp_path, over):
    (tmp_path / "job.toml").write_text(RIG.replace('kind = "map"', 'kind = "curves"') + OVER[over] + "[curves]\nmax_period = 2\n")
    file = pages.compute(tmp_path, tmp_path / "job.toml")
    kept = stored(file)
    browser.open(pages.written(file))
    browser.until(lambda: browser.data("edge", "state") == "solved", "the sides are not solved")
    browser.solved()
    words = browser.text("edge").replace("−", "-")
    assert all(word not in words for word in ("NaN", "undefined", "null"))
    assert "mm" in browser.text("edge-step") or over == "the stop"
    all_sides = browser.promise(f"Promise.all({along(kept, 0.2, 0.4, 0.5, 0.6, 0.8)}.map((at) => peterka.beside(...at)))")
    assert len(all_sides) >= 5 and np.mean([sum(side["keeps"] for side in sides) == 1 for sides in all_sides]) > 0.8
    assert browser.complaints() == []


def test_a_cell_beside_the_curves_is_one_of_a_map(browser, curves_page):
    browser.open(curves_page)
    browser.until(lambda: browser.data("edge", "state") == "solved", "the sides are not solved")
    across, down = browser.place(8, 4, 40, 40)
    size = browser.find("map-top").size
    ActionChains(browser.driver).move_to_element_with_offset(
        browser.find("map-top"), round(across - size["width"] / 2), round(down - size["height"] / 2)).click().perform()
    browser.until(lambda: not browser.find("edge").is_displayed(), "the edge is still shown")
    browser.solved()
    assert browser.data("agreement", "same") == "true" and "at=" in browser.ask("location.hash")


def test_curves_of_another_rig_are_not_shown(browser, curves_page):
    browser.open(curves_page, "at=4,4.5")
    browser.solved()
    assert "fold" in browser.text("legend") and "fold with grazing" in browser.text("legend")
    browser.slide("slider-contact_second", 100)
    browser.until(lambda: "fold" not in browser.text("legend"), "the curves are still shown over a live map")
    browser.until(lambda: browser.data("live-state", "finished") == "true", "no live map")  # whose legend may still grow a line
    browser.find("as-file").click()
    browser.until(lambda: "fold" in browser.text("legend"), "the curves don't come back")


def test_the_sliders_stay_where_they_are_while_a_live_map_is_computed(browser, curves_page):
    browser.open(curves_page)
    browser.driver.execute_script(
        "const top = (id) => document.getElementById(id).getBoundingClientRect().top;"
        "const distance = () => top('sliders') - top('legend');"
        "window.distances = [distance()];"
        "new MutationObserver(() => window.distances.push(distance())).observe(document.getElementById('legend'), {childList: true});")
    browser.slide("slider-contact_second", 100)
    browser.until(lambda: browser.data("live-state", "finished") == "true", "no live map")
    distances = browser.ask("window.distances")
    assert len(distances) > 3 and distances == sorted(distances)  # there may be more classes than in the file
    browser.find("as-file").click()
    browser.until(lambda: browser.ask("window.distances.at(-1)") == distances[0], "the legend keeps the height of the live map's")


def test_an_address_keeps_the_edge(browser, curves_page):
    browser.open(curves_page, "curve=0,3")
    browser.until(lambda: browser.data("edge", "state") == "solved", "the sides are not solved")
    assert "curve=0,3" in browser.ask("location.hash")
    browser.open(curves_page, "curve=9999,0")
    browser.solved()
    assert browser.complaints() == []
