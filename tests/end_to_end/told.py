"""What a file, and each program applied to it, reports: as numbers and words for comparing two files.

Each function takes the path of a file and a working folder, and returns {name: array, words or list of words}. Coordinates
are ratios wherever the file's rig permits, whichever unit its job uses."""

import contextlib
import io
import json
import os
import re
import runpy
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

import either_unit
import jobs
import launch

POSTPROCESS = Path(__file__).resolve().parents[2] / "postprocess"
sys.path.insert(0, str(POSTPROCESS))
from peterka.plotting.style import using  # noqa: E402
from peterka.maps import comparison  # noqa: E402
from peterka.maps.map_file import PeterkaFile  # noqa: E402
from peterka.page import page  # noqa: E402
from peterka.pictures import open_file, pictures_of  # noqa: E402
from peterka.cli.picture_options import zoomed  # noqa: E402

LIVE_CELLS = os.environ["LIVE_CELLS"]
NAMES = {si: (ratio, unit) for ratio, si, unit in either_unit.COORDINATES.values()}
UNTOLD = ("run", "tiles", "summary", "audit")  # whose last bits differ, or which follow from such numbers
ANSWER = ("regime", "status", "engine", "impacts", "period", "cycles", "peak_force_ratio")  # of live_cells, the first numbers
STARTS = ("displacement of the start", "velocity of the start")
COORDINATES = ("frequency", "gap", *STARTS)
LABEL = ("regime", "impacts", "period")


def stored(path, _=None):
    """Every dataset by its name in ratios; coordinates and values on curves as ratios."""
    numbers = {}
    with h5py.File(path, "r") as file:
        def take(name, dataset):
            if not isinstance(dataset, h5py.Dataset) or name.split("/")[0] in UNTOLD or dataset.dtype.kind not in "fiu":
                return
            si = next((si for si in NAMES if name.endswith(si)), None)
            if si is None or name.endswith("hammer_natural_frequency_hz"):
                numbers[name] = dataset[()]
                return
            ratio, unit = NAMES[si]
            numbers.setdefault(name[:-len(si)] + ratio, dataset[()] if name.startswith("edge_kind_") else dataset[()] / unit)
        file.visititems(take)
    return numbers


def program(name, folder, *arguments, code=0):
    """The output of postprocess/NAME.py, run in this process; stderr if another exit code is expected."""
    out, err, before = io.StringIO(), io.StringIO(), (sys.argv, os.getcwd())
    sys.argv = [str(POSTPROCESS / f"{name}.py"), *map(str, arguments)]
    os.chdir(folder)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            runpy.run_path(sys.argv[0], run_name="__main__")
    except SystemExit as end:
        assert (end.code or 0) == code, (end.code, err.getvalue())
    finally:
        sys.argv = before[0]
        os.chdir(before[1])
    return err.getvalue() if code else out.getvalue()


def drawn(*names, units):
    """What pictures show: their words, lines and images, in pixels of the figure except for images."""
    def draw(path, _):
        shown = {}
        with open_file(path) as file, using(units=units):
            pictures = pictures_of(file)
            for name in names:
                axes = pictures[name](file) if name in pictures else None
                if axes is None:
                    continue
                figure = (axes[0] if isinstance(axes, (list, tuple)) else axes).figure  # laid out including title and labels
                shown |= {f"{name}: {what}": value for what, value in look(figure).items()}
        return shown
    return draw


def look(figure):
    from matplotlib.collections import PathCollection
    from matplotlib.image import AxesImage
    from matplotlib.text import Text

    shown = {"words": [text.get_text() for text in figure.findobj(Text) if text.get_visible() and text.get_text()]}
    lines = [line for axes in figure.axes for line in axes.lines]  # ticks contain lines, which are not data
    for name, artists, numbers in (("line", lines, lambda line: line.get_transform().transform(line.get_xydata())),
                                   ("points", figure.findobj(PathCollection),
                                    lambda points: points.get_offset_transform().transform(points.get_offsets()))):
        for n, artist in enumerate(artist for artist in artists if artist.get_visible()):
            shown[f"{name} {n}"] = np.asarray(numbers(artist), dtype=float)
    for n, image in enumerate(figure.findobj(AxesImage)):
        shown[f"image {n}"] = np.ma.filled(np.ma.asarray(image.get_array(), dtype=float), np.nan)
    return shown


def exported(path, folder):
    """The rows of its cells as CSV, by column."""
    program("export", folder, path, "--as", "csv", "--output-dir", folder)
    head, *lines = (folder / f"{path.stem}.csv").read_text().splitlines()
    cells = [line.split(",") for line in lines]
    with h5py.File(path) as file:
        shape = file["regime"].shape
    columns = {name: [line[n] for line in cells] for n, name in enumerate(head.split(","))}
    return {name: words if any(word[:1].isalpha() for word in words) else np.array([float(word or "nan") for word in words]).reshape(shape)
            for name, words in columns.items()}


def best_place(path, folder):
    """The output of operating_point.py for the map, without drift and for the job's own start."""
    try:
        return {"words": program("operating_point", folder, path, "--hz", 0, "--mm", 0, "--starts", "job", "--formats", "png").split("\n")}
    except AssertionError as refusal:
        assert "has no place with" in str(refusal)
        return {"words": ["no place"]}


def compared(first, second):
    """The output of compare.py, without its picture."""
    with PeterkaFile(first) as one, PeterkaFile(second) as other:
        return comparison.text(one, other, comparison.compare(one, other))


def dashed(path):
    """(names and values of the axes from border to border, lines (n, 2) in their coordinates) of the dashed line in a map."""
    with open_file(path) as file:
        lines = [line.get_xydata() for line in pictures_of(file)["map"](file).lines if line.is_dashed()]
        return {side.name: np.linspace(*side.edges[[0, -1]], 300) for side in (file.columns, file.rows)}, lines


def settled_cells(file):
    """For an open file: mask of the cells that neither chaos nor rounding decides."""
    return (file["status"][()] == 0) & ~np.isin(file["regime"][()], either_unit.WITHOUT_PERIOD)


def named_in_the_other_unit(path):
    """(tables of a job that name a cell of a map by values, in the other unit wherever the file has both; the cell's label
    and force), for a settled cell in the middle of the map or after it."""
    with h5py.File(path) as file:
        cells = np.argwhere(settled_cells(file))
        cell = tuple(cells[np.argmin(np.abs(cells - 1).sum(axis=1))])
        tables = {}
        for name, at in zip(file["regime"].dims, cell):
            name = name[0].name.strip("/")
            table = next((table for table in ("start", "hammer", "cart", "contact") if name.startswith(f"{table}_")), "")
            key = name.removeprefix(f"{table}_")
            other = next((pair[1 - pair.index(key)] for *pair, _ in either_unit.COORDINATES.values() if key in pair), key)
            key = other if f"{table}_{other}".strip("_") in file else key
            tables.setdefault(table or "operating_point", []).append(f"{key} = {float(file[f'{table}_{key}'.strip('_')][at])!r}\n")
        known = [file[name][cell] for name in (*LABEL, "peak_force_ratio")]
    return "".join(f"[{table}]\n" + "".join(lines) for table, lines in tables.items()), known


def trace_of_cell(path, folder):
    """A trace of a settled cell ends as in the map."""
    named, known = named_in_the_other_unit(path)
    jobs.write(folder, jobs.trace_of(path, named))
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    assert "agrees in regime and z" in finished.stdout
    with h5py.File(folder / "job.h5") as file:
        assert np.allclose([file[f"cell/{name}"][()] for name in (*LABEL, "peak_force_ratio")], known, rtol=1e-9, equal_nan=True)
    return {}


def basin_of_cell(path, folder):
    """A basin of a settled cell has, at the map's own start, the map's result."""
    named, known = named_in_the_other_unit(path)
    around = "".join(jobs.axis(f"{name}_ratio", either_unit.PLACE[name] - 0.5, either_unit.PLACE[name] + 0.5, 3)
                     for name in ("displacement", "velocity"))
    jobs.write(folder, f'schema = 1\nkind = "basin"\n[basin]\nmap = "{path}"\n{named}{around}')
    finished = launch.run("run", "job.toml", "--quiet", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        assert np.allclose([file[name][1, 1] for name in (*LABEL, "peak_force_ratio")], known, rtol=1e-7, equal_nan=True)
    return {}


def parts(path, _):
    """The cells left by --zoom between the centres of the outer ones, requested in ratios and in Hz and mm."""
    left = {}
    with open_file(path) as file:
        from peterka.plotting.axes import si_scale
        from peterka.plotting.coordinates import IN_MILLIMETRES

        for in_si in (False, True):
            ends = []
            for axis in (file.columns, file.rows):
                scale = si_scale(file, axis.name) if in_si or axis.name in IN_MILLIMETRES else None
                ends += [end * (scale[1] if scale else 1.0) for end in axis.values[[0, -1]]]
            with zoomed(file, tuple(ends), in_si) as part:
                assert part.shape == file.shape and np.allclose(part.columns.edges[[0, -1]], file.columns.values[[0, -1]])
                left[f"regime, {in_si}"] = part.band(["regime"], 0, part.shape[0])["regime"]
                left[f"ends, {in_si}"] = np.array(ends)
    return left


def content_of_page(path):
    """(the content that explore.py gives a page, in which `cell` is numbers for live_cells; its text), without the engine,
    which takes a minute to build."""
    with PeterkaFile(path) as file:
        engine, page.module = page.module, lambda: b""
        try:
            text, notes = page.page(file)
        finally:
            page.module = engine
    assert not notes, notes
    return json.loads(re.search(r'id="content">(.*?)</script>', text, re.DOTALL)[1]), text


def settled(cell):
    """The page's conversion before it calls its engine: numbers in Hz, m and m/s become ratios of the cell's own rig."""
    hertz, metres = cell["natural_frequency_hz"], cell["amplitude_m"]
    if hertz is None:
        hertz = (cell["stiffness_n_per_m"] / cell["mass_kg"])**0.5 / (2 * np.pi)
    for (ratio, si, _), unit in zip(either_unit.COORDINATES.values(), (hertz, metres, metres, 2 * np.pi * hertz * metres)):
        if cell.get(si) is not None:
            cell[ratio] = cell.pop(si) / unit
        cell.pop(si, None)
    return cell


def explored(path, _):
    """Every cell solved by the page's engine: the same labels and forces as in the file, except where rounding decides."""
    content, _ = content_of_page(path)
    names, lines = list(content["cell"]), []
    names = [name for name in names if name not in NAMES]
    columns, rows = content["columns"], content["rows"]
    for up in rows["values"]:
        for across in columns["values"]:
            cell = dict(content["cell"])
            for side, value in ((columns, across), (rows, up)):
                cell |= {name: None for name in side["clears"]} | {side["sets"]: value}
            cell = settled(cell)
            lines.append(" ".join("nan" if cell[name] is None else repr(float(cell[name])) for name in names))
    run = subprocess.run([LIVE_CELLS], input="\n".join(lines), capture_output=True, text=True, timeout=launch.HANGING, check=True)
    shape = len(rows["values"]), len(columns["values"])
    answers = np.array([[float(word) for word in line.split()[:len(ANSWER)]] for line in run.stdout.splitlines()])
    live = {name: answers[:, n].reshape(shape) for n, name in enumerate(ANSWER)}
    with h5py.File(path) as file:
        sure = settled_cells(file)
        for name in LABEL:
            assert np.array_equal(live[name][sure], file[name][()][sure]), name
        assert np.allclose(live["peak_force_ratio"][sure], file["peak_force_ratio"][()][sure], rtol=1e-9, atol=0, equal_nan=True)
    header = {f"{side}: {name}": str(content[side][name]) for side in ("columns", "rows") for name in ("symbol", "about", "unit", "factor")}
    return {name: live[name] for name in LABEL} | {"words": list(header.values())}
