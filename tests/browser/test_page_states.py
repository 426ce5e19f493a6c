"""What the page tells belongs to what it shows: while a cell is solved and after it is given up, beyond its engine, over a live map, after
an address is entered in the open page."""

import re

import h5py
import numpy as np
import pages
import pytest
from conftest import JOBS
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

FEW = ("axes.frequency_ratio.points=4", "axes.gap_ratio.points=4", "audit.cells=0")
SHARE = re.compile(r"([\d.]+) %")


def shares(browser):
    """Of the legend's entries [%]."""
    words = browser.ask("[...document.querySelectorAll('#legend small')].map((one) => one.textContent)")
    return [float(SHARE.search(one)[1]) for one in words]


def enter(browser, address):
    """In the address bar of the open page."""
    browser.driver.execute_script("location.hash = arguments[0]", address)


def choose(browser, layer):
    browser.driver.execute_script("const one = document.getElementById('layer'); one.value = arguments[0]; one.dispatchEvent(new Event('change'))", layer)


def finished(browser, words):
    """Waits for a whole live map, with these words in its legend."""
    browser.until(lambda: browser.data("live-state", "finished") == "true" and words in browser.text("legend"), f"no live map with {words}")


def choose_gap(browser, number):
    browser.driver.execute_script("const one = document.getElementById('gap'); one.value = arguments[0]; one.dispatchEvent(new Event('change'))", number)


def label(regime, impacts, period):
    return f"z = {impacts}/{period}" if regime == 1 else {0: "no impact", 2: "chaotic", 3: "sustained contact", 4: "unresolved"}[regime]


@pytest.fixture(scope="module")
def strong_file(tmp_path_factory):
    """Springs whose cubic term the page's engine can't carry."""
    return pages.compute(tmp_path_factory.mktemp("strong"), JOBS / "smoke.toml", *FEW, "hammer.cubic_stiffness_n_per_m3=3e8")


@pytest.fixture(scope="module")
def slow_page(page_of):
    """Cells without impact; beyond them are places of chaos that is followed for long."""
    return page_of("smoke.toml", *FEW, "steady_state.chaos_cycles=100000000", "steady_state.max_cycles=300000000",
                   "axes.frequency_ratio.from=0.9", "axes.frequency_ratio.to=0.93", "axes.gap_ratio.from=10.0", "axes.gap_ratio.to=20.0")


@pytest.fixture(scope="module")
def rigid_file(tmp_path_factory):
    return pages.compute(tmp_path_factory.mktemp("rigid"), JOBS / "rigid_170mm.toml", "axes.frequency_ratio.points=12", "axes.gap_ratio.points=12",
                         "audit.cells=0", 'output.fields=["impact_speed", "impulse", "contact_power_w", "max_displacement"]')


def test_a_cell_beyond_the_engine_has_the_files_label(browser, strong_file):
    page = pages.written(strong_file)
    with h5py.File(strong_file) as data:
        kept = {name: data[name][()] for name in ("regime", "impacts", "period", "engine", "frequency_ratio", "gap_ratio")}
    beyond = np.argwhere(kept["engine"] >= 2).tolist()
    assert len(beyond) > 3
    for row, column in beyond[:4]:
        browser.open(page, f"at={float(kept['frequency_ratio'][column])!r},{float(kept['gap_ratio'][row])!r}")
        browser.solved()
        assert browser.text("z") == label(*(kept[name][row, column] for name in ("regime", "impacts", "period")))
        assert "too strong" in browser.text("proof") and not browser.find("agreement").is_displayed()


def test_a_live_map_beyond_the_engine_says_so(browser, strong_file):
    browser.open(pages.written(strong_file))
    browser.find("live").click()
    for layer in ("z", "peak_force_ratio"):
        choose(browser, layer)
        finished(browser, "beyond the page’s engine")
        assert "failed" not in browser.text("legend") and sum(shares(browser)) == pytest.approx(100, abs=0.2)


def test_nothing_of_another_cell_is_told_until_one_is_solved(browser, slow_page):
    browser.open(slow_page, "at=0.92,10")
    browser.solved()
    assert browser.text("z") == "no impact" and browser.text("numbers")
    enter(browser, "at=3.05,0.5")  # chaos, without a cell of the file
    browser.until(lambda: "so far" in browser.text("spent"), "it isn't being solved")
    def told():
        return [browser.text(name) for name in ("z", "newtons", "meaning", "agreement", "proof", "numbers")]
    assert told() == [""] * 6
    ActionChains(browser.driver).send_keys(Keys.ESCAPE).perform()
    assert browser.data("cell", "state") == "given-up" and told() == [""] * 6 and not browser.find("stage").is_displayed()
    enter(browser, "at=0.92,12")
    browser.solved()
    assert browser.find("stage").is_displayed()


def test_a_start_that_ends_nowhere_is_not_told_to_end_in_the_same_motion(browser, map_page):
    browser.open(map_page)
    scripts = pages.ROOT / "postprocess" / "peterka" / "page"
    parts = [re.search(part, (scripts / name).read_text(), re.DOTALL | re.MULTILINE).group() for name, part in (
        ("file.js", r"^const \[NO_IMPACT.*?;"), ("basin.js", r"^const sameLabel.*?;"), ("basin.js", r"^function sameMotion.*?^}"),
        ("words.js", r"^function endWords.*?^}"))]
    told = {regime: browser.ask(f"(() => {{ {' '.join(parts)} return endWords({{regime: {regime}}}, {{regime: {regime}}}); }})()")
            for regime in ("UNRESOLVED", "FAILED", "CHAOTIC", "NO_IMPACT")}
    assert told == {"UNRESOLVED": "no motion was verified", "FAILED": "no motion was verified", "CHAOTIC": "ends in chaos as well",
                    "NO_IMPACT": "ends in the same motion"}


def test_a_live_map_has_z_instead_of_other_layers(browser, map_page):
    browser.open(map_page)
    browser.find("live").click()
    choose(browser, "multiplier")
    finished(browser, "A live map has z instead of")
    assert "no impact" in browser.text("legend") and "1/1" in browser.text("legend")
    assert sum(shares(browser)) == pytest.approx(100, abs=1)  # "< 0.05 %" counts as 0.05


def test_forces_of_a_live_map_on_a_rigid_stop_are_none(browser, rigid_file):
    browser.open(pages.written(rigid_file), "layer=peak_force_ratio")
    browser.slide("slider-contact_first", 380)
    finished(browser, "no value")
    assert sum(shares(browser)) == pytest.approx(100, abs=0.3)
    assert browser.ask("document.querySelectorAll('#legend .scale').length") == 0  # of no number


def test_numbers_of_a_rigid_stop_are_the_files(browser, rigid_file):
    with h5py.File(rigid_file) as data:
        plane = {name: item[()] for name, item in data.items() if isinstance(item, h5py.Dataset)}
    row, column = np.argwhere((plane["regime"] == 1) & (plane["status"] == 0))[3].tolist()
    browser.open(pages.written(rigid_file), f"at={float(plane['frequency_ratio'][column])!r},{float(plane['gap_ratio'][row])!r}")
    browser.solved()
    told = dict(browser.ask("[...document.querySelectorAll('#numbers dt')].map((one) => [one.textContent, one.nextSibling.textContent])"))
    assert float(told["largest |u|"].removesuffix(" mm")) == pytest.approx(1000 * plane["max_displacement"][row, column], rel=1e-3)
    assert float(told["impact speed"].removesuffix(" mm/s")) == pytest.approx(1000 * plane["impact_speed"][row, column], rel=1e-3)
    assert all(told[name] != "–" for name in ("impulse", "power into the stop"))


def test_the_legend_of_words_tells_all_cells(browser, tmp_path):
    done = 0
    while done == 0:  # each run goes on where the last one stopped
        file = pages.compute(tmp_path, JOBS / "peterka_170mm.toml", "axes.frequency_ratio.points=512", "axes.gap_ratio.points=512",
                             "audit.cells=0", code=5, wall="0.1")
        with h5py.File(file) as data:
            computed = data["regime"][()] != -128
        done, empty = np.count_nonzero(computed), np.argwhere(~computed)[-1]
    browser.open(pages.written(file))
    for layer in ("status", "engine"):
        choose(browser, layer)
        browser.until(lambda: {"status": "verified", "engine": "exact"}[layer] in browser.text("legend"), "it isn't shown")
        assert "not computed yet" in browser.text("legend") and sum(shares(browser)) == pytest.approx(100, abs=0.3)
    row, column = empty.tolist()
    across, down = browser.place(column, row, 512, 512)
    canvas = browser.find("map-top")
    ActionChains(browser.driver).move_to_element_with_offset(canvas, round(across - canvas.size["width"] / 2),
                                                             round(down - canvas.size["height"] / 2)).perform()
    browser.until(lambda: "not computed yet" in browser.text("readout"), "nothing is read out")
    assert "128" not in browser.text("readout")


def test_an_address_entered_in_the_open_page_is_as_one_that_is_opened(browser, map_page):
    browser.open(map_page, "layer=peak_force_ratio&x=1,2&y=0,1&at=1.5,0.5&contact_first=1000000")
    browser.until(lambda: browser.data("live-state", "finished") == "true", "no live map")
    enter(browser, "at=2,0.5")
    browser.until(lambda: browser.ask("document.getElementById('layer').value") == "z" and "2.0000" in browser.text("place"), "it isn't followed")
    browser.find("layer").send_keys(Keys.ESCAPE)  # anything that comes after
    assert not browser.find("live").is_selected() and browser.text("live-state") == ""
    browser.slide("slider-gap_ratio", 40)
    assert browser.ask("location.hash") == "#at=2,0.5"  # the whole window isn't named


def test_a_place_that_no_map_has_is_left_out_and_told(browser, map_page):
    """A frequency below 0 kept the engine busy for ever."""
    browser.open(map_page, "at=-1,0.5")
    browser.solved()
    assert "at = -1,0.5 is no place" in browser.text("address-state")
    enter(browser, "at=2,0.5&curve=1,2&gap=7")
    browser.until(lambda: "gap = 7 is none" in browser.text("address-state"), "the gap isn't told")
    assert "curve = 1,2 is no point" in browser.text("address-state") and "at =" not in browser.text("address-state")
    enter(browser, "at=2,0.5")
    browser.until(lambda: browser.text("address-state") == "", "it isn't followed")
    browser.solved()


def test_a_live_map_that_is_off_stays_off(browser, map_page):
    browser.open(map_page, "at=2,0.5")
    browser.slide("slider-damping_ratio", 100)
    finished(browser, "")  # the legend of a longer one may still grow, and move what is clicked
    browser.find("live").click()
    address = browser.ask("location.hash.slice(1)")
    assert "live=0" in address
    browser.open(map_page, address)
    browser.solved()
    assert not browser.find("live").is_selected() and browser.ask("location.hash.slice(1)") == address


def test_layers_that_are_chosen_over_a_live_map_are_drawn_when_they_are_there(browser, map_page):
    browser.open(map_page)
    browser.find("live").click()
    browser.driver.execute_script("const one = document.getElementById('layer'); for (const { value } of [...one.options, ...one.options]) {"
                                  "one.value = value; one.dispatchEvent(new Event('change')); }")
    finished(browser, "A live map has z instead of " + browser.ask("document.getElementById('layer').selectedOptions[0].textContent").split(" (")[0])
    assert browser.complaints() == []


@pytest.fixture(scope="module")
def sweep_page(tmp_path_factory):
    return pages.written(pages.compute(tmp_path_factory.mktemp("sweep"), JOBS / "sweep_170mm.toml", "axes.frequency_ratio.points=71"))


def test_the_gap_shown_is_kept_by_the_address(browser, sweep_page):
    browser.open(sweep_page, "at=0,30")
    choose_gap(browser, 2)
    address = browser.ask("location.hash.slice(1)")
    assert "gap=2" in address
    browser.open(sweep_page, address)
    assert browser.ask("document.getElementById('gap').value") == "2"
    assert browser.ask("location.hash.slice(1)") == address


def test_a_point_of_one_layer_is_not_read_out_of_another(browser, sweep_page):
    """Its sample was read as one of another point."""
    browser.open(sweep_page, "layer=stroboscopic_displacement&at=0,44")
    browser.driver.execute_script("document.getElementById('map-top').focus()")
    for key in (Keys.ARROW_RIGHT, Keys.ARROW_UP, Keys.ARROW_UP):
        ActionChains(browser.driver).send_keys(key).perform()
    assert "Ω/ω" in browser.text("readout")
    choose(browser, "cycles")
    browser.until(lambda: browser.text("readout").startswith("Point at"), "the point of another layer is still read out")


def test_keys_walk_along_branches_of_the_gap_shown(browser, sweep_page):
    browser.open(sweep_page, "at=0,30")
    choose_gap(browser, 2)
    gap = browser.ask("document.getElementById('gap').selectedOptions[0].textContent")
    browser.driver.execute_script("document.getElementById('map-top').focus()")
    ActionChains(browser.driver).send_keys(Keys.ARROW_LEFT).perform()
    assert gap in browser.text("readout")
