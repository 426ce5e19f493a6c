"""The page as a view of the file: it opens from disk without console messages, shows the file's own cells, and can be
navigated by mouse and keyboard."""

import re
import sys

import h5py
import numpy as np
import pages
import pytest
from conftest import JOBS, SIZE
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.keys import Keys

sys.path.insert(0, str(pages.ROOT / "postprocess"))
from peterka.plotting.classes import CLASSES, classify  # noqa: E402
from peterka.page import page as page_module  # noqa: E402
from peterka.pictures import open_file  # noqa: E402

NAMES = ("regime", "impacts", "period", "peak_force_ratio")


def stored(file):
    with h5py.File(file) as data:
        return {name: data[name][()] for name in (*NAMES, "frequency_ratio", "gap_ratio", "impact_speed", "sensitivity")}


def point_at(browser, column, row):
    across, down = browser.place(column, row, SIZE, SIZE)
    canvas = browser.find("map-top")
    size = canvas.size
    moves = ActionChains(browser.driver, duration=0)
    moves.move_to_element_with_offset(canvas, round(across - size["width"] / 2), round(down - size["height"] / 2))
    return moves


def view(browser):
    """{x: [from, to], y: ...} from the address; empty for the whole map."""
    address = browser.ask("location.hash")
    return {name: [float(one) for one in text.split(",")] for name, text in re.findall(r"[#&]([xy])=([^&]*)", address)}


def test_values_are_those_of_the_file_to_the_last_bit(browser, map_file, map_page):
    browser.open(map_page)
    cells = browser.ask(f"Array.from({{length: {SIZE**2}}}, (_, i) => {{"
                        f"const v = peterka.value(Math.floor(i / {SIZE}), i % {SIZE});"
                        "return [v.regime, v.impacts, v.period, Number.isNaN(v.peak_force_ratio) ? null : v.peak_force_ratio];})")
    kept = stored(map_file)
    for n, name in enumerate(NAMES):
        shown = np.array([np.nan if cell[n] is None else cell[n] for cell in cells]).reshape(SIZE, SIZE)
        np.testing.assert_array_equal(shown, kept[name])
    assert "no cell in row 48" in browser.ask("(() => { try { peterka.value(48, 0) } catch (e) { return e.message } })()")


def test_the_dashed_line_is_in_the_legend_of_each_layer(browser, map_page):
    browser.open(map_page)
    for layer in ("z", "peak_force_ratio"):
        browser.ask(f"(() => {{ const one = document.getElementById('layer'); one.value = '{layer}'; one.dispatchEvent(new Event('change')); }})()")
        browser.until(lambda: "free swing grazes the stop" in browser.text("legend"), f"the line isn't told beside {layer}")
    style = "getComputedStyle([...document.querySelectorAll('#legend i.line')].at(-1)).borderTopStyle"
    assert browser.ask(style) == "dashed"


def test_the_canvas_has_the_colours_of_the_pictures(browser, map_file, map_page):
    browser.open(map_page)
    browser.settle()
    kept = stored(map_file)
    classes = classify(kept["regime"], kept["impacts"], kept["period"])
    random = np.random.default_rng(1)
    for row, column in random.integers(0, SIZE, (60, 2)):
        shown = browser.pixel("map", *browser.place(column, row, SIZE, SIZE))
        assert shown == CLASSES[classes[row, column]].colour, (row, column)


@pytest.mark.parametrize("row, column", [(5, 18), (40, 40), (10, 30), (0, 0), (47, 47)])
def test_the_read_out_tells_the_cell_under_the_pointer(browser, map_file, map_page, row, column):
    browser.open(map_page)
    point_at(browser, column, row).perform()
    kept = stored(map_file)
    told = browser.text("readout").replace("−", "-")
    frequency, hertz, gap, millimetres = map(float, re.search(
        r"Ω/ω ([\d.]+) · ([\d.]+) Hz   gap/A₀ ([\d.]+) · ([\d.]+) mm", told).groups())
    assert frequency == pytest.approx(kept["frequency_ratio"][column], rel=1e-4)
    assert hertz == pytest.approx(4.5 * kept["frequency_ratio"][column], rel=1e-3)
    assert gap == pytest.approx(kept["gap_ratio"][row], rel=1e-4)
    assert millimetres == pytest.approx(0.89 * kept["gap_ratio"][row], rel=1e-3)
    force = kept["peak_force_ratio"][row, column]
    if kept["regime"][row, column] == 1:
        assert f"z = {kept['impacts'][row, column]}/{kept['period'][row, column]}" in told
        ratio, newtons = map(float, re.search(r"([\d.]+) m g · ([\d.]+) N", told).groups())  # the job's axes are ratios
        assert newtons == pytest.approx(force * 0.298 * 9.80665, rel=1e-3)
        assert ratio == pytest.approx(force, rel=1e-3)
    else:
        assert ("no impact" if kept["regime"][row, column] == 0 else "chaotic") in told


def test_every_dataset_of_cells_is_a_layer_with_a_legend(browser, map_file, map_page):
    browser.open(map_page)
    with h5py.File(map_file) as data:
        own = {name for name, item in data.items() if isinstance(item, h5py.Dataset) and item.shape == (SIZE, SIZE)}
    offered = browser.ask("[...document.getElementById('layer').options].map((one) => one.value)")
    assert set(offered) == {"z", "regime"} | own - {"impacts", "period"}
    pictures = set()
    for name in offered:
        browser.driver.execute_script("const s = document.getElementById('layer'); s.value = arguments[0];"
                                      "s.dispatchEvent(new Event('change'))", name)
        browser.until(lambda: (f"layer={name}" in browser.ask("location.hash")) == (name != "z"), f"{name} is not shown")
        browser.settle()
        assert browser.text("legend").strip()
        pictures.add(browser.ask("document.getElementById('map').toDataURL()"))
    assert len(pictures) >= len(offered) - 1  # status and chatter may be constant over the map
    assert browser.complaints() == []


def test_impacts_that_go_on_are_no_number_of_cycles(browser, map_file, map_page):
    """Their -1 had the colour of 0, and a class that no cell had stood in the legend."""
    with h5py.File(map_file) as data:
        last, regime = data["last_impact"][()], data["regime"][()]
    browser.open(map_page, "layer=last_impact")
    told = browser.text("legend")
    assert f"impacts go on {100 * np.mean((last == -1) & np.isin(regime, [1, 2])):.1f} %" in told
    quiet = 100 * np.mean((regime == 0) & (last <= 0))
    assert re.findall(r"no impact ([\d.]+) %", told) == ([f"{quiet:.1f}"] if quiet > 0 else [])
    row, column = np.argwhere((last == -1) & (regime == 1))[0]
    other, there = np.argwhere(last > 0)[0]
    assert browser.pixel("map", *browser.place(column, row, SIZE, SIZE)) != browser.pixel("map", *browser.place(there, other, SIZE, SIZE))


def test_elasticities_are_signed_and_cells_without_one_are_told(browser, tmp_path):
    file = pages.compute(tmp_path, JOBS / "peterka_170mm.toml", *(f"axes.{name}_ratio.points={SIZE}" for name in ("frequency", "gap")),
                         'output.fields=["force_elasticity"]')
    with h5py.File(file) as data:
        values, regime = data["force_elasticity_gap_m"][()], data["regime"][()]
    lost = np.isnan(values) & ~np.isin(regime, (0, 3, 4, 5))
    assert lost.any() and (values < 0).any()
    browser.open(pages.written(file), "layer=force_elasticity_gap_m")
    browser.settle()
    assert browser.ask("document.querySelector('#legend .about').textContent") == "peak force by gap (% per %)"
    assert f"no value {100 * lost.mean():.1f} %" in browser.text("legend")
    ticks = browser.ask("[...document.querySelectorAll('#legend .scale span')].map((one) => Number(one.textContent.replace('−', '-')))")
    assert ticks == [-tick for tick in reversed(ticks)] and max(ticks) <= np.nanpercentile(np.abs(values), 95)
    assert browser.complaints() == []


def test_units_stand_beside_names(browser, map_page):
    browser.open(map_page)
    names = browser.ask("Object.fromEntries([...document.getElementById('layer').options].map((one) => [one.value, one.textContent]))")
    assert names["impact_speed"] == "impact speed (m/s)" and names["multiplier"] == "multiplier"


@pytest.mark.parametrize("amplitude", [0.89e-5, 0.89e-3, 0.089])
def test_amounts_have_the_prefix_that_keeps_them_between_1_and_1000(browser, page_of, amplitude):
    """Of springs without their cubic term: the power goes with the amplitude's square."""
    browser.open(page_of("peterka_170mm.toml", "axes.frequency_ratio.points=8", "axes.gap_ratio.points=8", "audit.cells=0",
                         f"cart.amplitude_m={amplitude}", "hammer.cubic_stiffness_n_per_m3=0"), "at=1.5,0.5")
    rows = "Object.fromEntries([...document.querySelectorAll('#numbers dt')].map((one) => [one.textContent, one.nextSibling.textContent]))"
    browser.solved()
    for name, unit in (("power into the stop", "W"), ("impulse", "N s")):
        amount, told = browser.ask(rows)[name].split(" ", 1)
        assert 1 <= float(amount) < 1000 and told.endswith(unit) and told.removesuffix(unit) in ("n", "µ", "m", "", "k")


class WithShares:
    """The data of an open file, plus basin_share[attractor][row][column], as in maps with several starts."""

    def __init__(self, data, shares):
        self.data, self.shares = data, shares

    def __getattr__(self, name):
        return getattr(self.data, name)

    def names(self):
        return [*self.data.names(), "basin_share"]

    def dataset(self, name, shape, kinds):
        return self.shares if name == "basin_share" else self.data.dataset(name, shape, kinds)

    def values(self, name, rows):
        return self.shares[rows] if name == "basin_share" else self.data.values(name, rows)

    def attribute(self, name, of="/"):
        return None if of == "basin_share" else self.data.attribute(name, of)


def test_shares_of_several_attractors_are_a_layer_each(browser, map_file, tmp_path):
    shares = np.random.default_rng(2).random((2, SIZE, SIZE))
    with open_file(map_file) as file:
        file.data = WithShares(file.data, shares)
        text, _ = page_module.page(file)
    page = tmp_path / "shares.html"
    page.write_text(text)
    browser.open(page, "layer=basin_share[1]")
    point_at(browser, 7, 31).perform()
    assert f"basin share 1 {shares[1, 31, 7]:.3g}"[:17] in browser.text("readout")


def test_wheel_drag_and_buttons_move_the_view_and_the_address_keeps_it(browser, map_page):
    browser.open(map_page)
    assert view(browser) == {}
    across, down = browser.place(12, 12, SIZE, SIZE)
    canvas = browser.find("map-top")
    origin = ScrollOrigin.from_element(canvas, round(across - canvas.size["width"] / 2), round(down - canvas.size["height"] / 2))
    ActionChains(browser.driver).scroll_from_origin(origin, 0, -300).perform()
    browser.until(lambda: "x" in view(browser), "the wheel does not zoom")
    zoomed = view(browser)
    at = 0.5 + 12 / 47 * 4
    assert zoomed["x"][0] < at < zoomed["x"][1] and zoomed["x"][1] - zoomed["x"][0] < 3.9
    point_at(browser, 24, 24).click_and_hold().move_by_offset(-60, 0).release().perform()
    browser.until(lambda: view(browser)["x"][0] > zoomed["x"][0], "dragging does not move the view")
    kept, address = view(browser), browser.ask("location.hash.slice(1)")
    browser.open(map_page, address)
    assert view(browser) == kept
    browser.find("whole").click()
    assert view(browser) == {}
    assert browser.complaints() == []


def test_the_keyboard_walks_zooms_and_solves(browser, map_page):
    browser.open(map_page, "at=1,0.1")
    browser.solved()
    browser.driver.execute_script("document.getElementById('map-top').focus()")
    keys = lambda *pressed: ActionChains(browser.driver).send_keys(*pressed).perform()  # noqa: E731
    keys(Keys.ARROW_RIGHT)
    before = browser.text("readout")
    keys(Keys.ARROW_LEFT, Keys.ARROW_DOWN, Keys.ARROW_DOWN)
    after = browser.text("readout")
    assert re.match(r"Ω/ω [\d.]+", after) and after != before
    place = browser.text("place")
    keys(Keys.ENTER)
    browser.until(lambda: browser.text("place") != place, "Enter does not solve the cell")
    keys("+")
    assert "x" in view(browser)
    keys("0")
    assert view(browser) == {}
    keys("l")
    browser.until(lambda: "layer=" in browser.ask("location.hash"), "l does not show another layer")
    assert browser.complaints() == []


def test_a_hostile_title_is_text(browser, page_of, tmp_path):
    title = '</script><script>window.hostile = 1</script><img src=x onerror="window.hostile = 2">'
    job = tmp_path / "job.toml"
    text = (pages.ROOT / "jobs" / "smoke.toml").read_text().replace('rig = "', f'rig = "{pages.ROOT}/jobs/')
    job.write_text(re.sub(r"(?m)^title = .*$", lambda _: f"title = '{title}'", text))
    page = pages.written(pages.compute(tmp_path, job, "axes.gap_ratio.points=8", "axes.frequency_ratio.points=8"))
    browser.open(page)
    assert browser.text("title") == title
    assert browser.driver.title == title
    assert browser.ask("window.hostile") is None
    assert browser.ask("document.images.length") == 0


def test_nothing_comes_from_elsewhere(map_page):
    text = map_page.read_text()
    assert not re.search(r"""(src|href)\s*=\s*["']|@import|url\(|https?://""", text)
