"""Cells solved by the engine inside the page: they equal the program's own results, motions, live maps and basins."""

import json
import re
import subprocess

import h5py
import numpy as np
import pages
import pytest
from conftest import SIZE
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

ANSWER = ("regime", "status", "engine", "impacts", "period", "cycles", "peak_force_ratio", "impact_rate", "chatter",
          "lyapunov", "sensitivity")
HANGS_ON_ROUNDING = 20.0  # ln of the growth of a perturbation beyond which rounding decides


def native(page, cells):
    """The result of the page's engine on this machine, cell by cell, in the order of src/page/interface.hpp."""
    text = page.read_text()
    content = json.loads(re.search(r'id="content">(.*?)</script>', text, re.DOTALL).group(1))
    names, (columns, rows) = list(content["cell"]), (content["columns"], content["rows"])
    lines = []
    for row, column in cells:
        numbers = content["cell"] | {columns["name"]: columns["values"][column], rows["name"]: rows["values"][row]}
        lines.append(" ".join("nan" if numbers[name] is None else repr(numbers[name]) for name in names))
    run = subprocess.run([pages.LIVE_CELLS], input="\n".join(lines), capture_output=True, text=True, timeout=pages.HANGING)
    assert run.returncode == 0, run.stderr
    return [dict(zip(ANSWER, map(float, line.split()))) for line in run.stdout.splitlines()]


def compare_200_cells(browser, page, size):
    cells = np.random.default_rng(21).integers(0, size, (200, 2)).tolist()
    browser.open(page)
    live = browser.promise(f"Promise.all({cells}.map(([row, column]) => peterka.solve(row, column)))")
    sure = forces = 0
    for (row, column), shown, kept in zip(cells, live, native(page, cells)):
        if kept["sensitivity"] > HANGS_ON_ROUNDING or kept["regime"] in (2, 4):
            continue
        sure += 1
        assert [shown[name] for name in ("regime", "impacts", "period")] == \
            [kept[name] for name in ("regime", "impacts", "period")], (row, column)
        if kept["regime"] == 1 and np.isfinite(kept["peak_force_ratio"]):
            forces += 1
            assert shown["peak_force_ratio"] == pytest.approx(kept["peak_force_ratio"], rel=1e-12), (row, column)
    return sure, forces


def test_200_random_cells_have_the_native_force(browser, map_page):
    sure, forces = compare_200_cells(browser, map_page, SIZE)
    assert sure > 170 and forces > 40


def test_a_rigid_stop_runs_too(browser, page_of):
    page = page_of("rigid_170mm.toml", "axes.frequency_ratio.points=24", "axes.gap_ratio.points=24")
    sure, _ = compare_200_cells(browser, page, 24)
    assert sure > 120
    browser.open(page, "at=1.5,0.5")
    browser.solved()
    assert browser.complaints() == []


def test_the_native_twin_is_the_program_itself(map_file, map_page, tmp_path):
    """A trace solves its cell with the same engine: identical to the last bit, not just to rounding."""
    with h5py.File(map_file) as data:
        periodic = np.argwhere(data["regime"][()] == 1)
    for row, column in periodic[:: len(periodic) // 4].tolist():
        job = tmp_path / "trace.toml"
        job.write_text(f'schema = 1\nkind = "trace"\n[trace]\nmap = "{map_file}"\nrow = {row}\ncolumn = {column}\n'
                       "cycles = 1\nsamples_per_cycle = 100\n")
        run = subprocess.run([pages.BINARY, "run", job, "--output", tmp_path / "trace.h5", "--quiet", "--fresh"], cwd=tmp_path,
                             capture_output=True, text=True, timeout=pages.HANGING, stdin=subprocess.DEVNULL)
        assert run.returncode == 0, run.stderr
        [twin] = native(map_page, [(row, column)])
        with h5py.File(tmp_path / "trace.h5") as trace:
            for name in ("regime", "impacts", "period", "peak_force_ratio"):
                assert trace["cell"][name][()] == twin[name], (row, column, name)


def test_the_engine_needs_no_library_of_the_program():
    libraries = subprocess.run(["ldd", pages.LIVE_CELLS], capture_output=True, text=True, check=True).stdout
    assert "libc.so" in libraries
    assert not re.search(r"mpi|hdf5|sundials|fmt", libraries)


def periodic_cell(file, impacts, period):
    with h5py.File(file) as data:
        found = np.argwhere((data["impacts"][()] == impacts) & (data["period"][()] == period))
        row, column = found[len(found) // 2].tolist()
        return row, column, data["frequency_ratio"][column], data["gap_ratio"][row], data["peak_force_ratio"][row, column]


def test_a_click_tells_z_its_proof_and_that_the_file_has_the_same(browser, map_file, map_page):
    row, column, frequency, gap, force = periodic_cell(map_file, 1, 1)
    browser.open(map_page)
    browser.solved()
    before = browser.text("place")
    across, down = browser.place(column, row, SIZE, SIZE)
    size = browser.find("map-top").size
    ActionChains(browser.driver).move_to_element_with_offset(
        browser.find("map-top"), round(across - size["width"] / 2), round(down - size["height"] / 2)).click().perform()
    browser.until(lambda: browser.text("place") != before, "the click solves nothing")
    browser.solved()
    assert browser.text("z") == "z = 1/1"
    assert float(browser.text("newtons").split()[0]) == pytest.approx(force * 0.298 * 9.80665, rel=1e-3)
    assert "multipliers" in browser.text("proof") and "unit circle" in browser.text("proof")
    assert browser.data("agreement", "same") == "true"
    assert f"Ω/ω {frequency:.5g}"[:8] in browser.text("place")
    for name in ("stage", "chart-displacement", "chart-force", "chart-pulse", "chart-phase", "chart-multipliers"):
        colours = browser.ask(f"new Set(new Uint32Array((c => c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer)"
                              f"(document.getElementById('{name}')))).size")
        assert colours > 3, f"{name} is empty"
    assert browser.complaints() == []


def test_the_hammer_moves_and_space_stops_it(browser, map_page):
    browser.open(map_page, "at=1.5,0.5")
    browser.solved()
    picture = lambda: browser.ask("document.getElementById('stage').toDataURL()")  # noqa: E731
    first = picture()
    browser.until(lambda: picture() != first, "nothing moves")
    ActionChains(browser.driver).send_keys(Keys.SPACE).perform()
    browser.settle()
    assert browser.text("play") == "Play"
    still = picture()
    browser.settle()
    assert picture() == still


def test_starts_and_knocks_lead_to_the_motions_of_the_basin(browser, basin_page):
    """At this point of the 150 mm rig no impact and z = 1/1 coexist."""
    browser.open(basin_page, "at=0,-0.8")
    browser.solved()
    assert browser.text("z") == "no impact"
    browser.driver.execute_script("const k = document.getElementById('knock'); k.value = k.max; k.dispatchEvent(new Event('input'))")
    browser.until(lambda: "knocked by" in browser.text("agreement"), "the knock has no outcome")
    assert "another motion" in browser.text("agreement")
    assert browser.text("z") == "z = 1/1"
    browser.find("basin").click()
    browser.until(lambda: browser.data("basin-state", "finished") == "true", "the basin is never finished")
    legend = browser.text("basin-legend")
    assert "no impact" in legend and "z = 1/1" in legend
    canvas = browser.find("chart-phase")
    ActionChains(browser.driver).move_to_element_with_offset(canvas, -40, -60).click().perform()
    browser.until(lambda: "from the start clicked" in browser.text("agreement"), "a click starts nothing")
    assert browser.complaints() == []


def shown_basin(browser, page, address):
    browser.open(page, address)
    browser.solved()
    browser.find("basin").click()
    browser.until(lambda: browser.data("basin-state", "finished") == "true", "the basin is never finished")
    return browser.text("basin-legend")


def test_one_motion_has_one_entry_whichever_engine_found_it(browser, map_page):
    """Some starts are followed with the cubic spring, which changes the force by 5e-5, the others without."""
    legend = shown_basin(browser, map_page, "at=3.3,1.35")
    assert legend.count("z = 1/2") == 1 and "N" in legend, legend
    browser.slide("knock", 1)
    browser.until(lambda: "knocked by" in browser.text("agreement"), "the knock has no outcome")
    assert browser.text("z") == "z = 1/2" and "ends in the same motion" in browser.text("agreement")


def test_motions_of_a_rigid_stop_are_told_apart_by_their_orbits(browser, map_page):
    """It has no force. Of 150 random rigs none had two motions with one label, so the legend is asked for by itself."""
    browser.open(map_page)
    file, plot, basin = ((pages.ROOT / "postprocess" / "peterka" / "page" / name).read_text() for name in ("file.js", "plot.js", "basin.js"))
    parts = [re.search(rf"^{part}", text, re.DOTALL | re.MULTILINE).group() for text, part in (
        (file, r"const \[NO_IMPACT.*?;"), (file, r"function labelWords.*?^}"), (plot, r"function digits.*?^}"), (basin, r"const sameLabel.*?;"),
        (basin, r"function sameMotion.*?^}"), (basin, r"class Motions.*?^}"))]
    stubs = "const [content, classOf, shade, abgr, signed, BASIN_ALPHA] = [{classes: [{colour: ''}]}, () => 0, (colour) => colour, () => 0, (text) => text, 1];"
    answers = ", ".join(f"{{regime: PERIODIC, impacts: 1, period: {period}, peak_force_ratio: NaN, engine: {engine}, orbit_displacement: {u}, orbit_velocity: 2}}"
                        for period, u, engine in ((2, -1.5, 0), (2, -1.5003, 0), (2, -1.50000001, 0), (2, -1.503, 1), (1, -1.5, 0)))
    legend = browser.ask(f"(() => {{ {stubs} {' '.join(parts)} const motions = new Motions();"
                         f"for (const answer of [{answers}]) motions.colourOf(answer);"
                         "return motions.entries({weight_n: 1, length_m: 1e-3}).map(({label, share}) => [label, share]); })()")
    assert legend[0] == ["z = 1/2, u = -1.5000 mm", 0.6] and ["z = 1/2, u = -1.5003 mm", 0.2] in legend and ["z = 1/1", 0.2] in legend
    assert len(legend) == 3, legend


@pytest.mark.parametrize("slider", ["contact_first", "contact_second", "damping_ratio"])
def test_a_slider_computes_the_map_again(browser, map_page, slider):
    browser.open(map_page, "at=1.5,0.5")
    browser.solved()
    browser.settle()
    of_the_file = browser.ask("document.getElementById('map').toDataURL()")
    browser.slide(f"slider-{slider}", 320 if slider == "damping_ratio" else 60)
    browser.until(lambda: browser.data("live-state", "finished") == "true", "the live map is never finished")
    browser.settle()
    assert browser.ask("document.getElementById('map').toDataURL()") != of_the_file
    assert f"{slider}=" in browser.ask("location.hash")
    browser.find("as-file").click()
    browser.settle()
    assert browser.ask("document.getElementById('map').toDataURL()") == of_the_file
    assert browser.complaints() == []


def test_an_unchanged_live_map_has_the_colours_of_the_file(browser, map_page):
    """Each cell of the file contains whole cells of the live map of its window of 32 x 32."""
    step = (4 / 47, 5 / 47)
    window = [(low + (8 - 0.5) * d, low + (40 - 0.5) * d) for low, d in zip((0.5, 0.0), step)]
    browser.open(map_page, "x={:.9g},{:.9g}&y={:.9g},{:.9g}".format(*window[0], *window[1]))
    browser.settle()
    place = lambda n: browser.place(n[0], n[1], 32, 32)  # noqa: E731
    places = [(column, row) for column in range(32) for row in range(32)]
    before = [browser.pixel("map", *place(n)) for n in places[::7]]
    browser.find("live").click()
    browser.until(lambda: browser.data("live-state", "finished") == "true", "the live map is never finished")
    browser.settle()
    after = [browser.pixel("map", *place(n)) for n in places[::7]]
    assert np.mean([a == b for a, b in zip(before, after)]) > 0.9  # near edges, offset from the centre by a quarter of a cell


def test_frequency_and_gap_sliders_move_the_cell(browser, map_page):
    browser.open(map_page, "at=1.5,0.5")
    browser.solved()
    browser.slide("slider-frequency_ratio", 100)
    browser.until(lambda: "Ω/ω 1.5000" in browser.text("place"), "frequency 1.5 is not solved")
    browser.slide("slider-frequency_ratio", 300)
    browser.until(lambda: "Ω/ω 3.5000" in browser.text("place"), "the frequency does not follow")
    browser.slide("slider-gap_ratio", 40)
    browser.until(lambda: "gap/A₀ 0.5000" in browser.text("place"), "the gap does not follow")


COUNTS_MESSAGES = """
window.stillSolving = 0;
window.Worker = class extends Worker {
  constructor(...how) {
    super(...how);
    this.addEventListener("message", ({ data }) => (window.stillSolving += data.spent > 0 ? 1 : 0));
  }
};
"""


def test_a_long_search_is_given_up(browser, page_of):
    page = page_of("smoke.toml", "axes.frequency_ratio.points=4", "axes.gap_ratio.points=4",
                   "steady_state.chaos_cycles=100000000", "steady_state.max_cycles=300000000", "axes.frequency_ratio.from=0.9",
                   "axes.frequency_ratio.to=0.93", "axes.gap_ratio.from=10.0", "axes.gap_ratio.to=20.0")
    listen = browser.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": COUNTS_MESSAGES})
    browser.open(page)
    browser.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", listen)
    browser.driver.execute_script("location.hash = 'at=3.05,0.5'")  # chaos
    browser.until(lambda: "so far" in browser.text("spent"), "nothing tells how long the search lasts")
    ActionChains(browser.driver).send_keys(Keys.ESCAPE).perform()
    assert browser.data("cell", "state") == "given-up"
    told = browser.ask("window.stillSolving")
    browser.promise("Promise.all(Array.from({length: 400}, (_, i) => peterka.solve(i % 4, i % 3)))")  # waits until other orders have run
    assert browser.ask("window.stillSolving") <= told + 1
    browser.driver.execute_script("location.hash = 'at=0.92,10'")
    browser.solved()


def test_a_law_that_the_page_cannot_run_says_so(browser, page_of):
    small = ("axes.frequency_ratio.points=4", "axes.gap_ratio.points=4")
    browser.open(page_of("hunt_crossley_170mm.toml", *small), "at=1.5,0.5")
    assert "Hunt and Crossley" in browser.text("proof")
    row, column = 0, 1  # 4 x 4 cells of 0.5 to 4.5 and 0 to 5
    shown = browser.ask(f"peterka.value({row}, {column})")
    assert shown["regime"] == 1 and browser.text("z") == f"z = {shown['impacts']}/{shown['period']}"
    assert not browser.find("live").is_displayed()
    assert "Hunt and Crossley" in browser.promise("peterka.solve(0, 0)")
    browser.open(page_of("smoke.toml", *small, "hammer.cubic_stiffness_n_per_m3=3e8"), "at=1.5,0.5")
    browser.solved()
    assert "too strong" in browser.text("proof")
    browser.open(page_of("smoke.toml", *small, "solver.engine=arkode"), "at=1.5,0.5")
    assert "arkode" in browser.text("proof")


def test_the_knock_goes_back_to_nothing_with_its_label(browser, basin_page):
    """When another cell is selected."""
    browser.open(basin_page, "at=0,-0.8")
    browser.solved()
    browser.driver.execute_script("const k = document.getElementById('knock'); k.value = k.max; k.dispatchEvent(new Event('input'))")
    assert browser.text("knock-value").startswith("+")
    browser.driver.execute_script("const s = document.getElementById('slider-gap_ratio'); s.value = 210; s.dispatchEvent(new Event('input'))")
    assert float(browser.ask("document.getElementById('knock').value")) == 0 and browser.text("knock-value") == "0 mm/s"


def test_shares_under_a_live_map_are_its_own(browser, map_page):
    shares = "[...document.querySelectorAll('#legend small')].map((one) => one.textContent)"
    browser.open(map_page)
    of_file = browser.ask(shares)
    browser.driver.execute_script("const s = document.getElementById('slider-damping_ratio'); s.value = 390; s.dispatchEvent(new Event('input'))")
    browser.until(lambda: browser.data("live-state", "finished") == "true", "no live map")
    live = browser.ask(shares)
    assert live != of_file and sum(float(share.split()[-2]) for share in live) == pytest.approx(100, abs=0.1 * len(live))
    browser.driver.execute_script("document.getElementById('as-file').click(); const l = document.getElementById('live'); "
                                  "if (l.checked) l.click()")
    browser.until(lambda: browser.ask(shares) == of_file, "the file's shares don't come back")


def test_a_basin_as_in_the_file_is_not_computed_again(browser, basin_page):
    browser.open(basin_page)
    browser.solved()
    browser.slide("slider-damping_ratio", 100)
    browser.until(lambda: browser.data("live-state", "finished") == "true", "no live map")
    browser.find("as-file").click()
    browser.promise("peterka.solve(3, 3)")  # by a worker that would have begun with a live map
    browser.settle()
    assert browser.text("live-state") == "" and not browser.find("live").is_selected()


def test_an_address_of_another_version_says_so(browser, map_page):
    browser.open(map_page, "at=1.5,0.5&damping_ratio=0.01&version=00000000&stop_colour=3&contact_first=-5")
    browser.solved()
    said = browser.text("address-state")
    assert "made by version 00000000" in said and "stop_colour = 3 isn't of this page's rig" in said
    assert "contact_first = -5 isn't" in said and "damping_ratio" not in said
    own = browser.ask("location.hash.slice(1)")
    browser.open(map_page, own)
    browser.solved()
    assert "version=" in own and browser.text("address-state") == ""
