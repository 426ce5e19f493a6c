"""Files of the program, pages made of them by explore.py, and a browser that opens them from disk."""

import json
import os
import subprocess
import sys
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

ROOT = Path(__file__).resolve().parents[2]
BINARY = Path(os.environ["PETERKA_BINARY"]).resolve()
LIVE_CELLS = Path(os.environ["LIVE_CELLS"]).resolve()
HANGING = 120  # seconds after which something is considered to hang
MARGINS = {"left": 62, "right": 62, "top": 42, "bottom": 40}  # of the map's canvas, in CSS pixels: view.js


def compute(folder, job, *settings, code=0, wall="3600"):
    """The file of a job with these settings (table.key=value), for a run limited to `wall` seconds."""
    file = folder / "map.h5"
    chosen = [part for setting in settings for part in ("--set", setting)]
    run = subprocess.run([BINARY, "run", job, "--output", file, "--quiet", "--max-wall", wall, *chosen], cwd=folder, capture_output=True,
                         text=True, timeout=HANGING, stdin=subprocess.DEVNULL)
    assert run.returncode == code, run.stderr
    return file


def explore(*arguments, **environment):
    return subprocess.run([sys.executable, ROOT / "postprocess" / "explore.py", *map(str, arguments)], capture_output=True,
                          text=True, timeout=600, env=os.environ | environment)


def written(file, *arguments):
    """The page of a file."""
    page = file.with_suffix(".html")
    run = explore(file, "--output", page, *arguments)
    assert run.returncode == 0, run.stderr
    return page


class Browser:
    """Headless Chromium; `driver` is selenium's."""

    def __init__(self):
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-extensions"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.set_script_timeout(HANGING)

    def open(self, page, address="", width=1400, height=1200, dark=False):
        """Opens a page, waits until it is ready, and requires an empty console."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})
        self.driver.get("about:blank")  # a change of the address alone would not reload the page
        self.complaints()  # left by the previous page and the tests on it
        self.driver.get(page.as_uri() + (f"#{address}" if address else ""))
        assert self.promise("peterka.ready.then(() => 'ready', (error) => String(error.stack))") == "ready"
        complaints = self.complaints()
        assert not complaints, complaints

    def complaints(self):
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def ask(self, expression):
        return self.driver.execute_script(f"return {expression}")

    def promise(self, expression):
        return self.driver.execute_async_script(f"const tell = arguments[0]; {expression}.then(tell, (e) => tell(String(e)))")

    def find(self, name):
        return self.driver.find_element("id", name)

    def text(self, name):
        return self.ask(f"document.getElementById({json.dumps(name)}).textContent")

    def data(self, name, key):
        return self.ask(f"document.getElementById({json.dumps(name)}).dataset[{json.dumps(key)}]")

    def until(self, condition, what):
        WebDriverWait(self.driver, HANGING, poll_frequency=0.05).until(lambda _: condition(), what)

    def solved(self):
        self.until(lambda: self.data("cell", "state") == "solved", "the cell is not solved")

    def settle(self):
        """Waits until everything requested is drawn."""
        self.driver.execute_async_script("const t = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => t()))")

    def slide(self, name, step):
        """Moves a slider to one of its 400 steps."""
        self.driver.execute_script(
            "const s = document.getElementById(arguments[0]); s.value = arguments[1]; s.dispatchEvent(new Event('input'))",
            name, step)

    def pixel(self, canvas, x, y):
        """'#RRGGBB' of a canvas at CSS pixels from its corner."""
        red, green, blue, _ = self.driver.execute_script(
            "const c = document.getElementById(arguments[0]);"
            "return [...c.getContext('2d').getImageData(Math.round(arguments[1]), Math.round(arguments[2]), 1, 1).data]",
            canvas, x, y)
        return f"#{red:02X}{green:02X}{blue:02X}"

    def written_on_map(self):
        """[[words, x, y], ...] of what is written on the map's canvas, x and y in CSS pixels from its corner."""
        self.driver.execute_script(
            "window.words = []; const own = CanvasRenderingContext2D.prototype.fillText; window.stop = () => (CanvasRenderingContext2D.prototype.fillText = own);"
            "CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {"
            "  const at = this.getTransform().transformPoint(new DOMPoint(x, y));"
            "  if (this.canvas.id === 'map') window.words.push([text, at.x, at.y]);"
            "  return own.call(this, text, x, y); };"
            "document.getElementById('whole').click()")
        self.settle()
        return self.ask("(window.stop(), window.words)")

    def place(self, column, row, columns, rows):
        """CSS pixels from the map's corner to the centre of a cell, if the whole map is shown."""
        box = self.ask("(({width, height}) => [width, height])(document.getElementById('map').getBoundingClientRect())")
        width = box[0] - MARGINS["left"] - MARGINS["right"]
        height = box[1] - MARGINS["top"] - MARGINS["bottom"]
        return (MARGINS["left"] + (column + 0.5) / columns * width,
                MARGINS["top"] + (1 - (row + 0.5) / rows) * height)
