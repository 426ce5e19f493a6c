"""Two units, one coordinate, over any two axes: the table of either_unit.py, row by row. Every kind and feature works over
every pair of axes with its coordinates as ratios and in SI units, and gives the same numbers; or it is in the list of
refusals, with its reason. At each commit the files' contents are compared over every other pair, other output over some of
them; over every pair if PETERKA_EVERY_PAIR is set (tests/endurance.sh axes_and_units).

Numbers agree within ROUNDING of the largest in their dataset. Rounding errors of a verified motion grow by less than e^20
(status 0), so a last bit of an input, eps / 2, may appear as eps / 2 e^20 = 5e-8 in either file; cells decided by chaos or
rounding (another status) are excluded. Printed numbers agree up to one unit in the last digit. If an axis changes the value
of ratio 1 in SI units, two jobs agree only along its middle point."""

import os
import re
from concurrent.futures import ThreadPoolExecutor

import h5py
import numpy as np
import pytest

import either_unit
import jobs
import launch
import told
from either_unit import (
    AXES, COORDINATES, CURVES_REFUSED, FEATURES, MIXED, RATIOS, REFUSALS, SI, WITHOUT_PERIOD, changes_units, curves_over,
    free_swing, over, starts,
)

pytestmark = pytest.mark.thorough

EVERY_PAIR = "PETERKA_EVERY_PAIR" in os.environ
PAIRS = either_unit.PAIRS if EVERY_PAIR else either_unit.PAIRS[1::2]

ROUNDING = 2 * np.finfo(float).eps / 2 * np.exp(20)
UNITS = {"ratios": RATIOS, "si": SI, "mixed": MIXED}
BOTH = ("ratios", "si")
KINDS = {
    "map": lambda axes, unit: over("map", axes, unit, more=starts(unit)),
    "curves": curves_over,
    "sweep": lambda axes, unit: over("sweep", axes, unit),
}


def with_either(pairs, *names):
    return [pair for pair in pairs if any(name in pair for name in names)]


def shared(name, axes):
    """Whether a ratio of this coordinate has the same SI value in all cells of such a map."""
    changing = changes_units(axes)
    lengths, rates = "amplitude" in changing, any(one != "amplitude" for one in changing)
    return not {"frequency": rates, "velocity": rates or lengths}.get(AXES[name].key, lengths)


def some(pairs):
    return pairs if EVERY_PAIR else pairs[2::3]


OVER_CURVES = [pair for pair in PAIRS if not with_either([pair], *CURVES_REFUSED)]
LIVE = [pair for pair in PAIRS if "dissipation of the stop" not in pair]  # the page has no integrators, and reports it
COMPARED = [pair for pair in PAIRS if not (changes_units(pair) and with_either([pair], *told.COORDINATES))]
ALONG = [(name,) for name in AXES if not changes_units((name,))]  # each point of the others inherits from another rig's
HAVE_HERTZ = [pair for pair in with_either(PAIRS, "frequency") if shared("frequency", pair)]  # a drift is given in Hz
# Kind, feature, the function that reports it, the axes, and the units besides ratios.
TABLE = [
    ("map", "stored", told.stored, PAIRS),
    ("map", "drawn", told.drawn("map", units="both"), some(PAIRS)),
    ("map", "drawn in SI", told.drawn("force_all", units="si"), some(with_either(PAIRS, "frequency", "gap"))),
    ("map", "exported", told.exported, some(PAIRS)),
    ("map", "explored", told.explored, some(LIVE)),
    ("map", "zoomed", told.parts, some(PAIRS)),
    ("map", "operated", told.best_place, some(HAVE_HERTZ)),
    ("map", "a trace of a cell", told.trace_of_cell, some(with_either(PAIRS, "frequency"))),
    ("map", "a basin of a cell", told.basin_of_cell, some([pair for pair in with_either(PAIRS, "gap") if not with_either([pair], *told.STARTS)])),
    ("curves", "stored", told.stored, some(OVER_CURVES)),
    ("curves", "drawn", told.drawn("curves_over_map", units="both"), some(OVER_CURVES)),
    ("curves", "drawn in SI", told.drawn("edge_distance_columns", "edge_distance_gap", units="si"), some(with_either(OVER_CURVES, "gap"))),
    ("sweep", "stored", told.stored, ALONG),
    ("sweep", "drawn", told.drawn("response", units="both"), ALONG),
    ("sweep", "drawn in SI", told.drawn("bifurcation", units="si"), ALONG),
    *((name, "stored", told.stored, [()]) for name in FEATURES),
    ("basin", "drawn", told.drawn("basin", units="si"), [()]),
    ("basin", "explored", told.explored, [()]),
    ("trace", "drawn", told.drawn("motion", "relative_plane", units="si"), [()]),
    ("map, rows and columns swapped", "drawn", told.drawn("map", units="both"), [()]),
    ("map, logarithmic", "drawn", told.drawn("map", units="si"), [()]),
]
ROWS = {": ".join(filter(None, (kind, feature, " and ".join(axes)))): (kind, tell, axes)
        for kind, feature, tell, rows in TABLE for axes in rows}


def test_some_pairs_have_every_axis():
    assert {name for pair in some(PAIRS) for name in pair} == set(AXES)
    assert all(rows for _, _, _, rows in TABLE)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """{unit: file} of a kind over some axes, computed on first use: with the same name, in one folder per unit."""
    folders = {unit: tmp_path_factory.mktemp(unit) for unit in UNITS}

    def in_units(kind, axes, units=BOTH):
        stem = re.sub(r"\W+", "_", " ".join((kind, *axes)))
        missing = [unit for unit in units if not (folders[unit] / f"{stem}.h5").exists()]
        with ThreadPoolExecutor(2) as cores:
            for finished in cores.map(lambda unit: compute(folders[unit], job(kind, axes, UNITS[unit]), stem), missing):
                assert finished.returncode == 0, finished.stderr
        return {unit: folders[unit] / f"{stem}.h5" for unit in units}
    return in_units


def job(kind, axes, unit):
    return KINDS[kind](axes, unit) if axes else FEATURES[kind](unit)


def compute(folder, text, stem):
    jobs.write(folder, text, f"{stem}.toml")
    return launch.run("run", f"{stem}.toml", "--quiet", cwd=folder)


@pytest.mark.parametrize("row", ROWS)
def test_either_unit_gives_the_same(files, tmp_path, row):
    kind, tell, axes = ROWS[row]
    found = files(kind, axes, BOTH if axes else UNITS)
    in_ratios, *others = (tell(path, folder_for(tmp_path, unit)) for unit, path in found.items())
    regular = Regular(found["ratios"], axes)
    for other in others:
        assert changes_units(axes) or regular.apart.any() or in_ratios.keys() == other.keys()
        for name in in_ratios.keys() & other.keys():
            assert regular.agree(name, in_ratios[name], other[name]), (name, in_ratios[name], other[name])
        if "curve_first" in in_ratios and not changes_units(axes):
            assert far_from(lines_of(in_ratios), lines_of(other)) < 1e-3  # of the axes' lengths: rounding may shorten a step


def folder_for(folder, unit):
    here = folder / unit
    here.mkdir()
    return here


def names_of(pair):
    """For a coordinate: its key as a ratio and in SI units, and its unit in a file."""
    ratio, si, _ = pair
    return ratio, si, {"frequency_hz": "Hz", "velocity_m_per_s": "m/s"}.get(si, "m")


@pytest.mark.parametrize("axes", PAIRS, ids=" and ".join)
def test_a_file_has_both_units_of_each_axis_where_all_cells_share_them(files, axes):
    for path in files("map", axes).values():
        with h5py.File(path) as file:
            for name in axes:
                if name not in told.COORDINATES:
                    continue
                ratio, si, unit = names_of(COORDINATES[AXES[name].key])
                ratio, si = (f"start_{key}" if name in told.STARTS else key for key in (ratio, si))
                metres, hertz = COORDINATES["gap"][2], COORDINATES["frequency"][2]
                if shared(name, axes):
                    one = {"frequency": hertz, "velocity": 2 * np.pi * hertz * metres}.get(AXES[name].key, metres)
                    assert np.allclose(file[si][()], file[ratio][()] * one, rtol=1e-15, atol=0)
                    assert file[si].attrs["units"] == unit
                    scales = [file[key].attrs.get("CLASS") == b"DIMENSION_SCALE" for key in (ratio, si)]
                    assert sum(scales) == 1
                else:
                    assert (ratio in file) != (si in file)


@pytest.mark.parametrize("axes", PAIRS, ids=" and ".join)
def test_the_line_of_the_free_swing_is_where_its_formula_says(files, axes):
    """Dashed between cells with and without a motion without impact, over any axes, in either unit."""
    for unit, path in files("map", axes).items():
        window, lines = told.dashed(path)
        (columns, x), (rows, y) = window.items()
        room = free_swing(UNITS[unit], {columns: x[None, :], rows: y[:, None]})
        assert bool(lines) == bool(np.min(room) < 0 < np.max(room))
        for line in lines:
            across, up = line[np.isfinite(line).all(axis=1)].T
            assert np.abs(free_swing(UNITS[unit], {columns: across, rows: up})).max() < 1e-3


@pytest.mark.parametrize("axes", some(COMPARED), ids=" and ".join)
def test_maps_in_either_unit_are_compared(files, tmp_path, axes):
    first, second = files("map", axes).values()
    text = told.compared(first, second)
    with h5py.File(first) as one, h5py.File(second) as other:
        same = np.all([one[name][()] == other[name][()] for name in told.LABEL], axis=0)
    assert f"{same.size} cells that both files hold" in text
    assert re.search(rf"same regime and z +{same.sum()} ", text), text


class Regular:
    """The numbers of a file on which two units must agree: `apart` masks cells that rounding may change, or whose rigs differ."""

    EACH_TO_ITSELF = ("point_residual", "branch_residual", "sensitivity", "cycles", "observed_cycles", "multiplier", "lyapunov",
                      "point_", "curve_first", "curve_points", "curve_begin", "curve_end", "work_precision")

    def __init__(self, path, axes):
        with h5py.File(path) as file:
            regime = file["regime"][()] if "regime" in file else np.zeros(0)
            self.apart = np.isin(regime, WITHOUT_PERIOD) | (file["status"][()] != 0 if "status" in file else False)
            if "attractor_regime" in file:  # a start that rounding moves to another attractor
                self.apart = self.apart | np.isin(file["attractor_regime"][()], WITHOUT_PERIOD).any(axis=0)
        self.differs = bool(changes_units(axes))
        self.across = [f"{of}_{AXES[name].key.replace('.', '_')}" for name in changes_units(axes) for of in ("edge_distance", "edge_kind")]
        for name in changes_units(axes):
            side = self.apart.ndim - 1 - axes.index(name)
            middle = self.apart.shape[side] // 2
            self.apart |= np.expand_dims(np.arange(self.apart.shape[side]) != middle, [n for n in range(self.apart.ndim) if n != side])

    def agree(self, name, one, other):
        if isinstance(one, list):
            return self.differs or bool(self.apart.any()) or words_agree(one, other)
        if name.startswith((*self.EACH_TO_ITSELF, *self.across)):
            return True
        fits = self.apart.size > 0 and one.shape[one.ndim - self.apart.ndim:] == self.apart.shape
        on_samples = self.apart.size > 0 and one.ndim == self.apart.ndim + 1 and one.shape[:-1] == self.apart.shape
        apart = self.apart if fits else self.apart[..., None] if on_samples else False
        if not fits and not on_samples and (self.differs or self.apart.any()):
            return True
        if one.shape != other.shape:
            return False
        if one.dtype.kind != "f":
            return bool(np.all((one == other) | apart))
        scale = np.nanmax(np.abs(one), initial=1e-300)
        with np.errstate(invalid="ignore"):
            return bool(np.all((np.abs(one - other) <= ROUNDING * scale) | (np.isnan(one) & np.isnan(other)) | apart))


NUMBER = re.compile(r"[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def with_ratios_first(words):
    """What leads with Hz, mm and N, as a job in these units does, as one in ratios would say it."""
    words = re.sub(r"([\d.]+ [mk]?N) = ([\d.]+)", r"\2 = \1", words)
    for name, symbol, unit in (("frequency", "Ω/ω", "Hz"), ("gap", "gap/A₀", "mm")):
        one = COORDINATES[name][2] * (1e3 if unit == "mm" else 1)
        words = re.sub(rf"{name} = ([\d.]+ {unit}) \(({symbol} = [\d.]+)\)", r"\2 (\1)", words)
        words = re.sub(rf"(?<!\(){name} = ([\d.]+) {unit}", lambda told: f"{symbol} = {float(told[1]) / one:.6g}", words)
        words = re.sub(rf"{name} ([\d.]+ {unit}) \(({name}_ratio [\d.]+)\)", r"\2 (\1)", words)
    return words


def words_agree(one, other):
    """The same words, and numbers that differ by at most one in their last digit; whichever of both units leads."""
    if len(one) != len(other):
        return False
    for first, second in zip(map(with_ratios_first, one), map(with_ratios_first, other)):
        if NUMBER.sub("#", first) != NUMBER.sub("#", second):
            return False
        for a, b in zip(NUMBER.findall(first), NUMBER.findall(second)):
            digits = max(len(number.partition("e")[0].partition(".")[2]) for number in (a, b))
            power = max(int(number.partition("e")[2] or 0) for number in (a, b))
            a, b = (float(number.replace("−", "-")) for number in (a, b))
            if abs(a - b) > 1.001 * 10.0**(power - digits):
                return False
    return True


def lines_of(numbers):
    """The points (n, 2) of each curve, over the lengths of the axes."""
    sides = [name.removeprefix("point_") for name in numbers if name.startswith("point_") and np.ndim(numbers.get(name.removeprefix("point_"))) == 1]
    points = np.column_stack([numbers[f"point_{side}"] / np.ptp(numbers[side]) for side in sides])
    assert len(sides) == 2
    return [points[first:first + count] for first, count in zip(numbers["curve_first"], numbers["curve_points"])]


def far_from(curves, others):
    """The largest distance of a point of a curve from the other one's segments."""
    most = 0.0
    for points, line in zip(curves, others, strict=True):
        first, way = line[:-1], np.diff(line, axis=0)
        share = np.sum((points[:, None] - first) * way, axis=2) / np.maximum(np.sum(way**2, axis=1), 1e-300)
        away = np.linalg.norm(points[:, None] - first - np.clip(share, 0, 1)[..., None] * way, axis=2)
        most = max(most, away.min(axis=1).max())
    return most


@pytest.mark.parametrize("unit", BOTH)
@pytest.mark.parametrize("name", REFUSALS)
def test_what_means_nothing_is_refused_with_its_reason(tmp_path, name, unit):
    text, reason = REFUSALS[name]
    jobs.write(tmp_path, text(UNITS[unit]))
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 2 and reason in checked.stderr, checked.stderr


def test_gaps_as_ratios_and_in_metres_are_not_compared_where_the_amplitude_changes(files, tmp_path):
    (axes,) = (pair for pair in either_unit.PAIRS if set(pair) == {"gap", "amplitude"})
    ratios, si = files("map", axes).values()
    said = told.program("compare", tmp_path, ratios, si, code=2)
    assert "only cells at the same places can be compared" in said


def test_points_are_measured_over_frequency_and_gap_alone(files, tmp_path):
    (tmp_path / "points.csv").write_text("frequency_hz,gap_mm,force_n\n8.1,1.2,200\n")
    for axes in [pair for pair in either_unit.PAIRS if set(pair) == {"frequency", "gap"}] + with_either(PAIRS, "gap", "mass"):
        for path in files("map", axes).values():
            refused = {"frequency", "gap"} != set(axes)
            said = told.program("draw", tmp_path, path, "--only", "map", "--formats", "png", "--measured", "points.csv", code=2 if refused else 0)
            assert ("measured points are drawn over frequencies and gaps" in said) == refused


def test_the_page_says_why_it_solves_no_cell_of_hunt_and_crossley(files):
    (axes,) = (pair for pair in either_unit.PAIRS if set(pair) == {"dissipation of the stop", "gap"})
    for path in files("map", axes).values():
        content, text = told.content_of_page(path)
        assert content["cell"]["contact_law"] == 2 and "which only the program’s integrators carry" in text
