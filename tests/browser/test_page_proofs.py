"""What is proved of a cell stands beside it: bounds of its force, or of its impact speed, or why nothing is."""

import re

import h5py
import numpy as np
import pages
import pytest
from conftest import JOBS

SETTINGS = ("axes.frequency_ratio.points=24", "axes.gap_ratio.points=24", 'certificate.cells="all"', "audit.cells=0")
BOUNDS = re.compile(r"proved([\d.]+) … ([\d.]+) (N|mm/s)")


def shown(browser, page, file, wanted):
    """The panel's words on a cell of a map with certificates, and the cell: {dataset: number}."""
    with h5py.File(file) as data:
        plane = {name: item[()] for name, item in data.items() if isinstance(item, h5py.Dataset) and item.shape == data["regime"].shape}
        found = np.argwhere(wanted(plane))
        row, column = found[len(found) // 2].tolist()
        place = f"{float(data['frequency_ratio'][column])!r},{float(data['gap_ratio'][row])!r}"
    browser.open(page, f"at={place}")
    browser.solved()
    browser.until(lambda: "proved" in browser.text("numbers"), "no word on a proof")
    return browser.text("numbers"), {name: values[row, column] for name, values in plane.items()}


@pytest.mark.parametrize("job, unit, side", [("peterka_170mm.toml", 0.298 * 9.80665, "peak_force_{}_ratio"),
                                             ("rigid_170mm.toml", 1000, "impact_speed_{}")])
def test_the_proved_bounds_are_told_rounded_outward(browser, tmp_path, job, unit, side):
    file = pages.compute(tmp_path, JOBS / job, *SETTINGS)
    words, cell = shown(browser, pages.written(file), file, lambda of: (of["regime"] == 1) & (of["certified"] > 0))
    low, high, _ = BOUNDS.search(words).groups()
    lower, upper = (float(cell[side.format(end)]) * unit for end in ("lower", "upper"))
    assert lower - 2 * 10.0 ** -len(low.partition(".")[2]) < float(low) <= lower
    assert upper <= float(high) < upper + 2 * 10.0 ** -len(high.partition(".")[2])
    assert ("with the cubic spring, which the engine left out" in words) == (unit != 1000 and cell["engine"] == 0)  # the rigid job has none


def test_a_motion_without_impact_and_a_cell_without_proof_have_words(browser, tmp_path):
    file = pages.compute(tmp_path, JOBS / "peterka_170mm.toml", *SETTINGS)
    page = pages.written(file)
    assert "provedthe motion, and that the start leads there" in shown(browser, page, file, lambda of: of["certified"] == 2)[0]
    words, cell = shown(browser, page, file, lambda of: of["certified"] < 0)
    with h5py.File(file) as data:
        meanings = dict(zip(data["certified"].attrs["flag_values"].tolist(), data["certified"].attrs["flag_meanings"].split()))
    assert f"not proved{meanings[cell['certified']].replace('_', ' ')}" in words


def test_a_label_that_many_digits_corrected_is_no_error_of_the_pages_engine(browser, map_page):
    """Where rounding decides, its engine may end on another motion than the exact one, which the file tells with a proof. No small job has
    such a cell on every machine, so the page's words are asked for by themselves."""
    browser.open(map_page)
    scripts = JOBS.parent / "postprocess" / "peterka" / "page"
    parts = [re.search(part, (scripts / name).read_text(), re.DOTALL | re.MULTILINE).group() for name, part in (
        ("file.js", r"^const \[NO_IMPACT.*?;"), ("file.js", r"^function labelWords.*?^}"), ("basin.js", r"^const sameLabel.*?;"))]
    ask = "(() => {{ const content = {{kind: 'map'}}; {} return agreement({}, {}); }})()"
    scope = "\n".join((*parts, (scripts / "words.js").read_text()))
    lost, other = (browser.ask(ask.format(scope, f"{{regime: NO_IMPACT, impacts: 0, period: 1, status: {status}}}",
                                          "{regime: PERIODIC, impacts: 2, period: 3}")) for status in (6, 0))
    assert lost["same"] is None and lost["words"].startswith("the file has z = 2/3: on this way errors of rounding grow by e^20")
    assert other == {"same": False, "words": "differs from the file, which has z = 2/3"}
