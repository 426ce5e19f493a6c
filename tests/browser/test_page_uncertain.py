"""Maps and sweeps with [uncertainty]: a cell shows the motion of the job's own rig, and what the drawn ones end in."""

import sys

import h5py
import numpy as np
import pages
import pytest
from conftest import JOBS
from selenium.webdriver.common.action_chains import ActionChains

sys.path.insert(0, str(pages.ROOT / "postprocess"))
from peterka.plotting.classes import CLASSES  # noqa: E402

SIZE = 12
SMALL = (f"axes.frequency_ratio.points={SIZE}", f"axes.gap_ratio.points={SIZE}", "uncertainty.rigs=20")
LOWEST = "#440154"  # of viridis
COLOURS = {entry.label: entry.colour for entry in CLASSES}
PARTS = ("regime", "impacts", "period", "probability")


@pytest.fixture(scope="module")
def uncertain(tmp_path_factory):
    file = pages.compute(tmp_path_factory.mktemp("uncertain"), JOBS / "uncertain_170mm.toml", *SMALL)
    with h5py.File(file) as data:
        return pages.written(file), {name: item[()] for name, item in data.items() if isinstance(item, h5py.Dataset)}


def point_at(browser, row, column):
    across, down = browser.place(column, row, SIZE, SIZE)
    canvas = browser.find("map-top")
    moves = ActionChains(browser.driver, duration=0)
    moves.move_to_element_with_offset(canvas, round(across - canvas.size["width"] / 2), round(down - canvas.size["height"] / 2)).perform()
    return moves


def label(regime, impacts, period):
    return f"{impacts}/{period}" if regime == 1 else {0: "no impact", 2: "chaotic", 3: "sustained contact", 4: "unresolved"}[regime]


def told(cells, row, column):
    """What the page is to say of a cell's outcomes."""
    slots = [[cells[f"outcome_{part}"][slot, row, column] for part in PARTS] for slot in range(8)]
    words = [f"{100 * share:.1f} % {label(*kind)}" for *kind, share in slots if share > 0]
    rest = 1 - sum(share for *_, share in slots)
    return ", ".join([*words, f"{100 * rest:.1f} % others"] if rest > 1e-9 else words)


def test_the_outcomes_of_each_cell_are_told_beside_the_motion_of_the_jobs_own_rig(browser, uncertain):
    page, cells = uncertain
    browser.open(page)
    mixed = [(row, column) for row in range(SIZE) for column in range(SIZE) if cells["outcomes"][row, column] > 1]
    assert len(mixed) > 20 and (cells["outcome_others"] > 0).sum() < len(mixed)
    for row, column in [*mixed[::4], (SIZE - 1, SIZE - 1)]:
        point_at(browser, row, column)
        assert browser.text("readout").endswith(f"drawn rigs: {told(cells, row, column)}"), (row, column)
    row, column = next(place for place in mixed if cells["regime"][place] == 1 and cells["status"][place] == 0)
    point_at(browser, row, column).click().perform()
    browser.until(lambda: browser.text("place").startswith(f"Ω/ω {cells['frequency_ratio'][column]:.4f}"[:9]), "it is not picked")
    browser.solved()
    assert browser.text("agreement").startswith("equals the file’s cell")
    assert f"That is the job’s own rig. Of those drawn around it: {told(cells, row, column)}." in browser.text("proof")
    browser.slide("slider-damping_ratio", 300)  # of another rig the file knows nothing
    browser.solved()
    assert "drawn around" not in browser.text("proof")
    assert browser.complaints() == []


def test_the_commonest_outcome_is_a_layer_in_the_colours_of_the_map(browser, uncertain):
    page, cells = uncertain
    browser.open(page, "layer=commonest")
    browser.settle()
    others = (cells["outcome_regime"][0] != cells["regime"]) | (cells["outcome_impacts"][0] != cells["impacts"])
    assert others.any()  # where it is not the job's own motion
    checked = 0
    for row in range(SIZE):
        for column in range(SIZE):
            own = COLOURS.get(label(*(cells[f"outcome_{part}"][0, row, column] for part in PARTS[:3])))
            if own is None:
                continue
            assert browser.pixel("map", *browser.place(column, row, SIZE, SIZE)) == own, (row, column)
            checked += others[row, column]
    assert checked > 0
    assert "no impact" in browser.text("legend") and "1/1" in browser.text("legend")


def test_layers_of_outcomes_have_titles_and_forces_both_units(browser, uncertain):
    page, _ = uncertain
    browser.open(page, "layer=force_q05_ratio")
    titles = browser.ask("Object.fromEntries([...document.getElementById('layer').options].map((one) => [one.value, one.textContent]))")
    assert titles["force_q05_ratio"] == "force that 95 % of drawn rigs reach"
    assert titles["outcome_probability[0]"] == "probability of the commonest outcome"
    assert titles["outcome_probability[1]"] == "probability of outcome 2"
    assert not any(name.startswith(("outcome_regime", "outcome_impacts", "outcome_period")) for name in titles)
    ticks = browser.ask("[...document.querySelectorAll('#legend .scale span')].map((one) => one.textContent)")
    assert all(tick.endswith(" N") for tick in ticks) and len(ticks) > 2
    about = browser.ask("document.querySelector('#legend .about').textContent")
    assert about == "force that 95 % of drawn rigs reach (weights of the hammer, N)"  # the job is in ratios


def test_the_own_rig_hides_no_force_of_drawn_rigs(browser, uncertain):
    page, cells = uncertain
    hidden = [(row, column) for row, column in zip(*np.nonzero((cells["regime"] == 0) & (cells["force_q95_ratio"] > 0)))]
    without = [(row, column) for row, column in zip(*np.nonzero((cells["regime"] == 0) & (cells["force_q95_ratio"] == 0)))]
    assert hidden and without
    browser.open(page, "layer=force_q95_ratio")
    browser.settle()
    assert "no impact" not in browser.text("legend")
    for row, column in without:
        assert browser.pixel("map", *browser.place(column, row, SIZE, SIZE)).lower() == LOWEST
    for row, column in hidden:
        assert browser.pixel("map", *browser.place(column, row, SIZE, SIZE)) != COLOURS["no impact"]


def test_a_sweep_of_uncertain_rigs_opens_and_solves_its_points(browser, tmp_path):
    job = tmp_path / "job.toml"
    job.write_text(f'schema = 1\nkind = "sweep"\nrig = "{JOBS}/rigs/170mm.toml"\n[axes.frequency_ratio]\nfrom = 1.5\nto = 2.5\npoints = 11\n'
                   "[sweep]\ngap_ratio = [0.5]\n[starts]\ncount = 4\n[uncertainty]\nrigs = 20\n[uncertainty.hammer]\n"
                   "natural_frequency_hz = { relative = 0.01 }\n")
    browser.open(pages.written(pages.compute(tmp_path, job)), "layer=force_q95_ratio")
    browser.solved()
    assert browser.text("agreement").startswith("equals the file’s point")
    assert {"F/(m g)", "force that 5 % of drawn rigs exceed (N)"} < {words for words, _, _ in browser.written_on_map()}
    assert browser.complaints() == []
