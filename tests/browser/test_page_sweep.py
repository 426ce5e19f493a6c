"""Pages of sweeps: every point's motion is recovered from the state stored in the file, whatever the swept coordinate; a
click selects the nearest branch."""

import re

import h5py
import numpy as np
import pages
import pytest
from conftest import JOBS
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from test_page_any_axes import RIG, axis

NAMES = ("regime", "impacts", "period", "peak_force_ratio", "status")
LINEAR = "hammer.cubic_stiffness_n_per_m3=0"  # each search decides for itself whether the cubic term may be omitted
PLACE = "[operating_point]\nfrequency_hz = 40.0\ngap_m = 0.2e-3\n"
RIGID = re.sub(r"(?s)\[contact\].*", '[contact]\nlaw = "restitution"\ncoefficient = 0.6\n', RIG)
OVER = {
    "Hz, gaps in m": RIG + axis("frequency_hz", 24.0, 60.0, 37) + "[sweep]\ngap_m = [0.0, 0.2e-3]\n",
    "the gap in m": RIG + axis("gap_m", 0.0, 0.5e-3, 26) + "[operating_point]\nfrequency_hz = 40.0\n",
    "the stop's damping": RIG + axis("contact.damping_ns_per_m", 300.0, 1500.0, 13) + PLACE,
    "the cart's amplitude": RIG + axis("cart.amplitude_m", 0.2e-3, 0.8e-3, 13) + "[sweep]\ngap_m = [0.0, 0.2e-3]\n[operating_point]\nfrequency_hz = 40.0\n",
    "springs, logarithmically": RIG + axis("hammer.natural_frequency_hz", 11.0, 44.0, 13) + 'scale = "log"\n' + PLACE,
    "starts": RIG + axis("start.velocity_m_per_s", -0.2, 0.2, 13) + '[sweep]\ndirection = "independent"\n' + PLACE,
    "Hz, a rigid stop": RIGID + axis("frequency_hz", 24.0, 60.0, 37) + "[sweep]\ngap_ratio = [0.0, 0.5]\n",
}


def sweep_of(folder, text):
    folder.joinpath("job.toml").write_text(text.replace('kind = "map"', 'kind = "sweep"'))
    return pages.compute(folder, folder / "job.toml")


@pytest.fixture(scope="module")
def sweep_file(tmp_path_factory):
    return pages.compute(tmp_path_factory.mktemp("sweep"), JOBS / "sweep_170mm.toml", "axes.frequency_ratio.points=71", LINEAR)


@pytest.fixture(scope="module")
def sweep_page(sweep_file):
    return pages.written(sweep_file)


@pytest.fixture(scope="module")
def starts_file(tmp_path_factory):
    return pages.compute(tmp_path_factory.mktemp("starts"), JOBS / "sweep_attractors_170mm.toml", "axes.frequency_ratio.points=71", LINEAR)


@pytest.fixture(scope="module")
def starts_page(starts_file):
    return pages.written(starts_file)


@pytest.mark.parametrize("of", ["sweep", "starts"])
def test_shares_are_those_of_the_branches_of_the_gap_shown(browser, request, of):
    """Empty slots of attractors counted, too: 62 % of a finished sweep weren't computed yet."""
    browser.open(request.getfixturevalue(f"{of}_page"))
    kept = stored(request.getfixturevalue(f"{of}_file"))
    told = []
    for number, gap in enumerate(np.unique(kept["gap_ratio"])):
        browser.driver.execute_script("const s = document.getElementById('gap'); s.value = arguments[0]; s.dispatchEvent(new Event('change'))", number)
        here = kept["gap_ratio"] == gap
        quiet = 100 * np.mean(kept["regime"][here] == 0)
        told.append(re.findall(r"no impact ([\d.]+) %", browser.text("legend")))
        assert told[-1] == ([f"{quiet:.1f}"] if quiet > 0 else []), (gap, browser.text("legend"))
        assert "not computed yet" not in browser.text("legend")
        shares = re.findall(r"([\d.]+) %", browser.text("legend"))
        assert sum(map(float, shares)) == pytest.approx(100, abs=0.1 * len(shares))
    assert len(set(map(tuple, told))) > 1


def stored(file):
    with h5py.File(file) as data:
        return {name: data[name][()] for name in data if isinstance(data[name], h5py.Dataset)}


def assert_found_again(browser, track, kept):
    """Checks the settled points of {name: (points,)} and returns their number."""
    count = len(kept["regime"])
    live = browser.promise(f"Promise.all(Array.from({{length: {count}}}, (_, point) => peterka.solve({track}, point).catch(() => null)))")
    all_shown = browser.ask(f"Array.from({{length: {count}}}, (_, point) => peterka.value({track}, point))")
    settled = 0
    for point, (one, shown) in enumerate(zip(live, all_shown)):
        assert shown["regime"] == kept["regime"][point]
        if kept["regime"][point] in (2, 4, 5, -128) or kept["status"][point] != 0:
            continue
        settled += 1
        assert [one[name] for name in NAMES[:3]] == [kept[name][point] for name in NAMES[:3]], (track, point)
        force = pytest.approx(kept["peak_force_ratio"][point], rel=1e-9, nan_ok=True)  # none if the stop is rigid
        assert all((np.nan if each["peak_force_ratio"] is None else each["peak_force_ratio"]) == force for each in (one, shown)), (track, point)
    return settled


def test_each_point_of_a_sweep_in_ratios_is_found_again(browser, sweep_file, sweep_page):
    kept = stored(sweep_file)
    browser.open(sweep_page)
    settled = sum(assert_found_again(browser, branch, {name: kept[name][branch] for name in NAMES}) for branch in range(6))
    assert settled > 0.85 * kept["regime"].size


@pytest.mark.parametrize("over", OVER)
def test_and_of_one_over_anything_else(browser, tmp_path, over):
    file = sweep_of(tmp_path, OVER[over])
    kept = stored(file)
    browser.open(pages.written(file))
    settled = sum(assert_found_again(browser, branch, {name: kept[name][branch] for name in NAMES}) for branch in range(len(kept["regime"])))
    assert settled > 0.6 * kept["regime"].size
    browser.solved()
    assert browser.data("agreement", "same") == "true"
    assert all(word not in browser.text("place") for word in ("NaN", "undefined", "null"))
    assert browser.complaints() == []


def test_and_each_attractor_of_one_with_starts(browser, starts_file, starts_page):
    kept = stored(starts_file)
    browser.open(starts_page)
    settled = 0
    for gap in range(3):
        for slot in range(len(kept["attractor"])):
            own = {name: kept[f"attractor_{name}"][slot, 2 * gap] for name in NAMES}
            settled += assert_found_again(browser, 6 + gap * len(kept["attractor"]) + slot, own)
    assert settled > 0.8 * np.sum(kept["attractor_regime"][:, ::2] >= 0)


def point_at(browser, x, y, window, off=(0, 0)):
    """Places the pointer over a point of a view whose window, ((x0, x1), (y0, y1)), is in the address."""
    across, up = ((value - low) / (high - low) for value, (low, high) in zip((x, y), window))
    canvas = browser.find("map-top")
    width, height = canvas.size["width"], canvas.size["height"]
    left = pages.MARGINS["left"] + across * (width - pages.MARGINS["left"] - pages.MARGINS["right"])
    top = pages.MARGINS["top"] + (1 - up) * (height - pages.MARGINS["top"] - pages.MARGINS["bottom"])
    return ActionChains(browser.driver, duration=0).move_to_element_with_offset(
        canvas, round(left - width / 2 + off[0]), round(top - height / 2 + off[1]))


def opened(browser, page, at, window):
    browser.open(page, f"at={at[0]},{at[1]}&x={window[0][0]},{window[0][1]}&y={window[1][0]},{window[1][1]}")
    browser.solved()


def hysteresis(kept):
    """(gap, point) at which both branches of a gap are settled and their forces differ most."""
    settled = np.isin(kept["regime"], [0, 1])
    apart = np.where(settled[::2] & settled[1::2], np.abs(kept["peak_force_ratio"][::2] - kept["peak_force_ratio"][1::2]), -1)
    return map(int, np.unravel_index(np.argmax(apart), apart.shape))


def test_a_click_takes_the_nearest_branch(browser, sweep_file, sweep_page):
    kept = stored(sweep_file)
    gap, point = hysteresis(kept)
    x = kept["frequency_ratio"][point]
    forces = kept["peak_force_ratio"][2 * gap:2 * gap + 2, point]
    assert abs(forces[0] - forces[1]) > 5
    window = ((x - 0.3, x + 0.3), (min(forces) - 2, max(forces) + 15))  # within what the page shows
    # the last one has impacts
    for branch in sorted((2 * gap, 2 * gap + 1), key=lambda branch: kept["peak_force_ratio"][branch, point]):
        words = ("frequency rising", "frequency falling")[branch - 2 * gap]
        regime, p, q, force = (kept[name][branch, point] for name in NAMES[:4])
        label = f"z = {p}/{q}" if regime == 1 else "no impact"
        opened(browser, sweep_page, (4 * gap + 1 - branch, point), window)
        assert words not in browser.text("place")
        moves = point_at(browser, x, force, window, off=(3, 4))
        moves.perform()
        told = browser.text("readout").replace("−", "-")
        assert words in told and label in told
        assert float(re.search(r"([\d.]+) Hz", told)[1]) == pytest.approx(4.5 * x, rel=1e-3)
        assert float(re.search(r"([\d.]+) mm", told)[1]) == pytest.approx(0.89 * kept["gap_ratio"][branch], rel=1e-3)
        moves.click().perform()
        browser.until(lambda: words in browser.text("place"), "the click solves nothing")
        browser.solved()
        assert browser.text("z") == label
        if regime == 1:
            assert float(re.search(r"([\d.]+) N", told)[1]) == pytest.approx(force * 0.298 * 9.80665, rel=1e-3)
            assert float(browser.text("newtons").split()[0]) == pytest.approx(force * 0.298 * 9.80665, rel=1e-3)
        assert browser.data("agreement", "same") == "true" and "point" in browser.text("agreement")
        assert f"at={branch},{point}" in browser.ask("location.hash")
    for name in ("stage", "chart-displacement", "chart-force", "chart-pulse", "chart-phase", "chart-multipliers"):
        colours = browser.ask(f"new Set(new Uint32Array((c => c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer)"
                              f"(document.getElementById('{name}')))).size")
        assert colours > 3, f"{name} is empty"
    assert browser.complaints() == []


def test_a_click_on_an_attractor_that_no_branch_is_on(browser, starts_file, starts_page):
    kept = stored(starts_file)
    slots = kept["attractor_regime"].shape[0]
    periodic = (kept["attractor_regime"] == 1) & (kept["basin_share"] > 0) & (kept["attractor_period"] < 4)
    found = [(gap, slot, point) for gap in range(3) for slot, point in np.argwhere(periodic[:, 2 * gap])
             if slot not in kept["start_attractor"][2 * gap:2 * gap + 2, point]]
    gap, slot, point = found[len(found) // 2]
    x, force = kept["frequency_ratio"][point], kept["attractor_peak_force_ratio"][slot, 2 * gap, point]
    window = ((x - 0.2, x + 0.2), (force - 4, force + 4))
    opened(browser, starts_page, (2 * gap, point), window)
    point_at(browser, x, force, window, off=(1, -2)).click().perform()
    browser.until(lambda: f"attractor {slot + 1}" in browser.text("place"), "the click solves nothing")
    browser.solved()
    assert browser.text("z") == f"z = {kept['attractor_impacts'][slot, 2 * gap, point]}/{kept['attractor_period'][slot, 2 * gap, point]}"
    assert float(browser.text("newtons").split()[0]) == pytest.approx(force * 0.298 * 9.80665, rel=1e-3)
    assert f"{100 * kept['basin_share'][slot, 2 * gap, point]:.1f} % of the starts" in browser.text("place")
    assert browser.data("agreement", "same") == "true"
    assert f"at={6 + gap * slots + slot},{point}" in browser.ask("location.hash")


def test_marks_have_the_colour_of_their_z(browser, sweep_page, sweep_file):
    kept = stored(sweep_file)
    point = int(np.argmax(np.where((kept["impacts"][0] == 1) & (kept["period"][0] == 1), kept["peak_force_ratio"][0], -1)))
    x, force = kept["frequency_ratio"][point], kept["peak_force_ratio"][0, point]
    window = ((x - 0.2, x + 0.2), (force - 10, force + 10))
    opened(browser, sweep_page, (0, 0), window)
    browser.settle()
    size = browser.ask("(({width, height}) => [width, height])(document.getElementById('map').getBoundingClientRect())")
    middle = [pages.MARGINS[low] + (size[n] - pages.MARGINS[low] - pages.MARGINS[high]) / 2 for n, (low, high) in enumerate((("left", "right"), ("top", "bottom")))]
    assert browser.pixel("map", *middle) == "#D55E00"


def test_gaps_and_layers_are_chosen_and_keys_walk_along_a_branch(browser, starts_page):
    browser.open(starts_page, "at=0,30")
    browser.solved()
    pictures = set()
    names = browser.ask("[...document.getElementById('layer').options].map((one) => one.value)")
    assert {"peak_force_ratio", "stroboscopic_displacement", "impact_displacement", "cycles", "basin_share"} <= set(names)
    assert not {"regime", "status", "jump", "start_attractor"} & set(names)
    for name in names:
        browser.driver.execute_script("const s = document.getElementById('layer'); s.value = arguments[0]; s.dispatchEvent(new Event('change'))", name)
        browser.until(lambda: (f"layer={name}" in browser.ask("location.hash")) == (name != "peak_force_ratio"), f"{name} is not shown")
        browser.settle()
        pictures.add(browser.ask("document.getElementById('map').toDataURL()"))
    assert len(pictures) == len(names)
    gaps = browser.ask("[...document.getElementById('gap').options].map((one) => one.textContent)")
    assert gaps == ["gap/A₀ 0 · 0 mm", "gap/A₀ 1.1236 · 1.000 mm", "gap/A₀ 3.3708 · 3.000 mm"]
    browser.driver.execute_script("const s = document.getElementById('gap'); s.value = 2; s.dispatchEvent(new Event('change'))")
    browser.settle()
    assert browser.ask("document.getElementById('map').toDataURL()") not in pictures
    browser.open(starts_page, "at=0,30")
    browser.solved()
    browser.driver.execute_script("document.getElementById('map-top').focus()")
    keys = lambda *pressed: ActionChains(browser.driver).send_keys(*pressed).perform()  # noqa: E731
    keys(Keys.ARROW_RIGHT, Keys.ENTER)
    browser.until(lambda: "at=0,31" in browser.ask("location.hash"), "the keys don't walk")
    browser.solved()
    keys(Keys.ARROW_UP, "+", "0")
    assert browser.complaints() == []


def test_of_a_rigid_stop_which_has_no_force_the_motions_place_comes_first(browser, tmp_path):
    browser.open(pages.written(sweep_of(tmp_path, OVER["Hz, a rigid stop"])))
    assert browser.ask("document.getElementById('layer').value") == "stroboscopic_displacement"
    browser.settle()
    shown = browser.ask("document.getElementById('map').toDataURL()")
    browser.driver.execute_script("const s = document.getElementById('layer'); s.value = 'peak_force_ratio'; s.dispatchEvent(new Event('change'))")
    browser.until(lambda: "layer=peak_force_ratio" in browser.ask("location.hash"), "the force is not shown")
    browser.settle()
    assert browser.ask("document.getElementById('map').toDataURL()") != shown
    assert browser.complaints() == []


def test_an_unfinished_sweep_is_shown_as_far_as_it_is_computed(browser, tmp_path):
    file = pages.compute(tmp_path, JOBS / "sweep_170mm.toml", "axes.frequency_ratio.points=2000", code=5, wall="1e-9")
    browser.open(pages.written(file))
    assert "% computed" in browser.text("facts") and "not computed yet" in browser.text("legend")
    assert browser.find("cell").is_displayed() is False


def test_a_law_that_the_page_cannot_run_says_so(browser, tmp_path):
    text = re.sub(r"(?s)\[contact\].*", '[contact]\nlaw = "hunt_crossley"\nstiffness_n_per_m_pow_n = 1e8\nexponent = 1.5\ndissipation_s_per_m = 0.5\n', RIG)
    file = sweep_of(tmp_path, text + axis("frequency_hz", 40.0, 42.0, 3) + '[sweep]\ngap_m = [0.0]\ndirection = "up"\n')
    kept = stored(file)
    browser.open(pages.written(file), "at=0,1")
    assert "Hunt and Crossley" in browser.text("proof")
    assert kept["regime"][0, 1] != 1 or browser.text("z") == f"z = {kept['impacts'][0, 1]}/{kept['period'][0, 1]}"


@pytest.mark.parametrize("width, height", [(320, 640), (3840, 2160)])
def test_it_fits(browser, starts_page, width, height):
    browser.open(starts_page, "at=0,30", width, height)
    browser.solved()
    browser.settle()
    assert browser.ask("document.documentElement.scrollWidth") <= width
    assert browser.complaints() == []
