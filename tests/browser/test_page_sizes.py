"""Small and large screens, light and dark: everything is present, nothing overflows."""

import pytest

CANVASES = ("map", "stage", "chart-displacement", "chart-force", "chart-phase", "chart-pulse", "chart-multipliers")


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width, height", [(320, 640), (1024, 768), (3840, 2160)])
def test_it_fits(browser, map_page, width, height, dark):
    browser.open(map_page, "at=1.5,0.5", width, height, dark)
    browser.solved()
    browser.settle()
    assert browser.ask("document.documentElement.scrollWidth") <= width
    for name in CANVASES:
        left, right, size = browser.ask("((box) => [box.left, box.right, box.height])"
                                        f"(document.getElementById('{name}').getBoundingClientRect())")
        assert 0 <= left < right <= width and size >= 100, name
    sticking_out = browser.ask(
        "[...document.querySelectorAll('main *, header *')].filter((one) => one.checkVisibility() && one.tagName !== 'OPTION' && "
        "one.getBoundingClientRect().right > innerWidth + 1).map((one) => one.id || one.className || one.tagName)")
    assert sticking_out == []
    paper = browser.ask("getComputedStyle(document.body).backgroundColor")
    assert paper == ("rgb(20, 23, 26)" if dark else "rgb(255, 255, 255)")
    letters = browser.ask("getComputedStyle(document.body).color")
    assert letters == ("rgb(230, 233, 236)" if dark else "rgb(27, 31, 35)")
    assert browser.complaints() == []


def test_the_button_turns_light_into_dark(browser, map_page):
    browser.open(map_page, "at=1.5,0.5")
    browser.find("theme").click()
    assert browser.ask("getComputedStyle(document.body).backgroundColor") == "rgb(20, 23, 26)"
    browser.find("theme").click()
    assert browser.ask("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"


def test_the_page_of_the_shipped_map_can_be_hosted(page_of):
    """With the engine; postprocess/README.md tells its size."""
    page = page_of("peterka_170mm.toml", "audit.cells=0")
    text = page.read_text()
    assert 1.2e6 < page.stat().st_size < 1.6e6
    assert "http://" not in text and "https://" not in text
