"""A map, basin, sweep or file of curves as a single HTML page that needs neither server nor network: its cells, the engine,
and the scripts that display them are embedded. Everything from the file is data there, never HTML."""

import base64
import html
import json
import zlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from ..files.opened import OpenedFile
from ..plotting import classes, signed
from ..plotting.axes import incomplete_text, si_scale
from ..plotting.coordinates import IN_MILLIMETRES, label
from ..maps import basin_map, field_map
from ..maps.curves_file import CurvesFile
from ..maps.map_file import Axis, PeterkaFile, axis_of
from ..sweeps.sweep_file import SweepFile

from . import edges, layers, tracks
from .engine import NoEngine, cell_numbers, module, numbers_of_axis, version

FOLDER = Path(__file__).resolve().parent
# in this order, in one scope; those of WORKER again in a scope of their own
SCRIPTS = ["planes.js", "file.js", "engine.js", "colours.js", "plot.js", "view.js", "map.js", "branches.js", "curves.js",
           "workers.js", "live.js", "basin.js", "sides.js", "stage.js", "charts.js", "words.js", "cell.js", "rig.js", "legend.js",
           "address.js", "page.js", "map_page.js", "sweep_page.js", "curves_page.js", "main.js"]
WORKER = ["engine.js", "worker.js"]
ROOM = 7_200_000  # bytes for all planes of a large map: 10 MB after encoding as text
AXES = {
    "frequency_ratio": ("Ω/ω", "excitation frequency", "Hz"),
    "gap_ratio": ("gap/A₀", "gap", "mm"),
    "displacement_ratio": ("x/A₀", "start: displacement of the hammer", "mm"),
    "velocity_ratio": ("ẋ/(A₀ω)", "start: velocity of the hammer", "mm/s"),
    "start_displacement_ratio": ("x/A₀", "start: displacement of the hammer", "mm"),
    "start_velocity_ratio": ("ẋ/(A₀ω)", "start: velocity of the hammer", "mm/s"),
}


def page(file: PeterkaFile | SweepFile, every: int = 1, asked: Sequence[str] | None = None) -> tuple[str, list[str]]:
    """(text of the page, sentences for the user) of an open file. `every`: stride in rows and columns of its cells; `asked`:
    the layers requested; by default those that fit."""
    blobs: list[str] = []
    notes: list[str] = []
    content = _header(file, every)
    content |= _of_sweep(file, asked, blobs) if isinstance(file, SweepFile) else _of_cells(file, every, asked, blobs)
    if isinstance(file, CurvesFile):
        content["curves"] = edges.edges(file, partial(_keep, blobs))
    content["classes"] = [{"label": entry.label, "colour": entry.colour, "orbit": entry.orbit} for entry in classes.CLASSES]
    content["viridis"], content["diverging"] = layers.scale("viridis"), layers.scale(signed.COLOURS)
    content["shades"] = [[weight, {"white": 255, "black": 0}[towards]] for weight, towards in basin_map.SHADES]
    content["no_value"] = field_map.NO_VALUE_COLOUR
    content["apart"] = [*field_map.WITHOUT_IMPACTS, "not computed yet"]
    parts: list[tuple[str, Callable[[], object]]] = [
        ("cell", lambda: cell_numbers(file)), ("engine", lambda: _keep(blobs, zlib.compress(module(), 9)))]
    for key, find in parts:
        try:
            content[key] = find()
        except NoEngine as reason:
            content[key] = None
            content["missing"] = str(reason)
            notes.append(f"{file.path}: the page has no engine: {reason}")
    return _filled(content, blobs, file.title), notes


def _header(file: OpenedFile, every: int) -> dict[str, Any]:
    attribute = file.data.attribute
    return {
        "title": file.title,
        "name": file.path.name,
        "kind": file.kind,
        "every": every,
        "incomplete": incomplete_text(file),
        "source": str(attribute("source") or ""),
        "commit": str(attribute("git_commit") or ""),
        "page_version": version(),
        "arithmetic": str(attribute("arithmetic") or ""),
        "newtons": file.newtons,
        "damping_ratio": file.number("damping_ratio"),
        "hertz": file.positive("natural_frequency_hz"),
        "amplitude_m": file.positive("cart_amplitude_m"),
        "place": {name: file.number(name) for name in ("frequency_ratio", "gap_ratio")},
        "in_si": sorted(file.given_in_si),
    }


def _of_cells(file: PeterkaFile, every: int, asked: Sequence[str] | None, blobs: list[str]) -> dict[str, Any]:
    labels, packed = layers.labels(file, every)
    return {
        "rows": _axis(file, file.rows, every),
        "columns": _axis(file, file.columns, every),
        "labels": labels | {"blob": _keep(blobs, packed)},
        "layers": _layers(file, every, asked, ROOM - len(packed), blobs),
    }


def _of_sweep(file: SweepFile, asked: Sequence[str] | None, blobs: list[str]) -> dict[str, Any]:
    """`gap`: the coordinate with a value per track; None if it is the axis, or varies from point to point."""
    keep = partial(_keep, blobs)
    labels, packed = tracks.labels(file)
    return tracks.described(file) | {
        "columns": _axis(file, axis_of(file.axis_name, file.values)),
        "gap": None if None in file.gaps else _coordinate(file, file.gap_name),
        "labels": labels | {"blob": keep(packed)},
        "layers": [description | {"blob": keep(packed)} for description, packed in tracks.datasets(file, asked)],
        "starts": tracks.starts(file, keep),
        "jumps": tracks.jumps(file, keep),
    }


def _axis(file: OpenedFile, axis: Axis, every: int = 1) -> dict[str, Any]:
    return _coordinate(file, axis.name) | {"log": axis.log, "values": axis.values[::every].tolist()}


def _coordinate(file: OpenedFile, name: str) -> dict[str, Any]:
    """`factor`: from the values to `unit`, None if the file does not give it; `sets`, `clears`: numbers of a cell (engine.py)."""
    symbol, about, unit = AXES.get(name) or _plain_words(name)
    scale = si_scale(file, name)
    factor = scale and (1000 * scale[1] if unit == "mm/s" else scale[1])
    sets, clears = numbers_of_axis(file, name)
    return {"name": name, "symbol": symbol, "about": about, "unit": unit, "factor": factor, "sets": sets, "clears": clears}


def _plain_words(name: str) -> tuple[str, str, str]:
    """(symbol, about, unit) of any other axis, from its label in pictures, without mathematics."""
    words = tracks.plain_words(label(name)).strip() or name
    millimetres = name in IN_MILLIMETRES
    about, _, unit = words.partition(" (")
    return words, about, "mm" if millimetres else unit.rstrip(")")


def _layers(file: PeterkaFile, every: int, asked: Sequence[str] | None, room: int, blobs: list[str]) -> list[dict[str, Any]]:
    kept = []
    for name in layers.datasets(file, asked):
        for description, packed in layers.layers_of(file, name, every, room) or _no_layer(file, name, asked):
            room = max(room - len(packed), 0)
            kept.append(description | {"blob": _keep(blobs, packed)})
    return kept


def _no_layer(file: OpenedFile, name: str, asked: Sequence[str] | None) -> list[tuple[dict[str, Any], bytes]]:
    if asked is not None:
        raise file.refusal(f"has no number of each cell named {name}")
    return []


def _keep(blobs: list[str], packed: bytes) -> int:
    blobs.append(base64.b64encode(packed).decode("ascii"))
    return len(blobs) - 1


def _filled(content: Mapping[str, Any], blobs: Sequence[str], title: str) -> str:
    parts = {
        "title": html.escape(title),
        "style": (FOLDER / "page.css").read_text(),
        "content": _inert(json.dumps(content, allow_nan=False, ensure_ascii=True)),
        "blobs": "\n".join(f'<script type="text/plain" id="blob-{n}">{text}</script>' for n, text in enumerate(blobs)),
        "worker": _scripts(WORKER),
        "script": _scripts(SCRIPTS),
    }
    text = (FOLDER / "page.html").read_text()
    for name, part in parts.items():
        text = text.replace(f"<!--{name}-->", part, 1)
    return text


def _inert(text: str) -> str:
    """JSON in which nothing can terminate the enclosing script element."""
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _scripts(names: Iterable[str]) -> str:
    return "\n".join((FOLDER / name).read_text() for name in names)
