"""Maps over any two numbers that may vary per cell: each cell equals that of a job with these numbers in its tables, at any
number of ranks; resuming, refining, auditing, tracing, comparing and drawing support the axes."""

import random
import re
import subprocess
import sys
from pathlib import Path

import h5py
import jobs
import launch
import numpy as np
import pytest
from any_axes import LABEL, PLACE, SWEEPS, axis, map_over
from map_contents import assert_same_map

pytestmark = pytest.mark.thorough

ROOT = Path(__file__).resolve().parents[2]
STOPS = map_over(axis("contact.stiffness_n_per_m", 1e5, 1e8, 20, "log"), axis("contact.damping_ns_per_m", 10, 1e4, 18, "log"),
                 more=PLACE.format(hertz=9.0, gap=0.0))
LENGTHS = map_over(axis("gap_m", 0.0, 2e-3, 9), axis("cart.amplitude_m", 0.5e-3, 1.5e-3, 8),
                   more="[operating_point]\nfrequency_hz = 8.1\n")
HAMMERS = map_over(axis("hammer.mass_kg", 0.2, 0.5, 9), axis("hammer.stiffness_n_per_m", 150.0, 400.0, 8),
                   more=PLACE.format(hertz=9.0, gap=0.5e-3))
STARTS = map_over(axis("start.velocity_ratio", -3.0, 3.0, 9), axis("frequency_ratio", 1.5, 2.5, 8),
                  more="[operating_point]\ngap_ratio = 1.6\n")
LINES = map_over(axis("frequency_ratio", 1.8, 3.2, 40), axis("contact.damping_ns_per_m", 100, 4000, 24, "log"),
                 more="[operating_point]\ngap_ratio = 0.0\n")  # a rig for each row
MAPS = {"lines": LINES, "stops": STOPS, "lengths": LENGTHS, "hammers": HAMMERS, "starts": STARTS}


@pytest.fixture(scope="module")
def computed(tmp_path_factory):
    """Name -> file, computed on 2 ranks."""
    folder = tmp_path_factory.mktemp("axes")
    for name, text in MAPS.items():
        jobs.write(folder, text, f"{name}.toml")
        finished = launch.run("run", f"{name}.toml", cwd=folder, ranks=2)
        assert finished.returncode == 0, finished.stderr
    return folder


def axes_of(text):
    """(coordinate, table, key) of columns and rows."""
    for path in re.findall(r"\[axes\.(.*)\]", text):
        table, _, key = path.rpartition(".")
        yield path.replace(".", "_"), table or "operating_point", key


SAME = {"frequency_ratio": "frequency_hz", "stiffness_n_per_m": "natural_frequency_hz"}


def job_of_cell(text, values):
    """A plain one-cell job over frequency and gap, as ratios, with the values of its cell in its tables."""
    plain = text[:text.index("\n[axes.")]
    numbers = {"frequency": None, "gap": None, "amplitude": 0.89e-3, "mass": 0.298, "stiffness": None, "natural": 4.5}
    for key, value in re.findall(r"(frequency_hz|gap_m|gap_ratio) = (\S+)", plain):
        numbers[key] = float(value)
    plain = plain.split("[operating_point]")[0]
    for (_, table, key), value in zip(axes_of(text), values):
        if table in ("operating_point", "start"):
            numbers[key] = value
            continue
        numbers[{"amplitude_m": "amplitude", "mass_kg": "mass"}.get(key, key)] = value
        if (table, key) == ("hammer", "stiffness_n_per_m"):
            plain = re.sub(r"natural_frequency_hz = .*", f"stiffness_n_per_m = {float(value)!r}", plain)
            numbers["stiffness"] = value
        else:
            head, tail = plain.split(f"[{table}]")
            plain = f"{head}[{table}]" + re.sub(rf"\b{key} = .*", f"{key} = {float(value)!r}", tail, count=1)
    natural = (numbers["stiffness"] / numbers["mass"])**0.5 / (2 * np.pi) if numbers["stiffness"] else numbers["natural"]
    frequency = numbers.get("frequency_ratio") or numbers["frequency_hz"] / natural
    gap = numbers["gap_ratio"] if "gap_ratio" in numbers else numbers["gap_m"] / numbers["amplitude"]
    start = f"[start]\nvelocity_ratio = {float(numbers.get('velocity_ratio', 0.0))!r}\n"
    return (plain + start + axis("frequency_ratio", repr(float(frequency)), repr(float(frequency)), 1)
            + axis("gap_ratio", repr(float(gap)), repr(float(gap)), 1))


@pytest.mark.parametrize("name", MAPS)
def test_a_cell_is_that_of_a_job_with_its_numbers(computed, tmp_path, name):
    text = MAPS[name]
    (x_name, *_), (y_name, *_) = axes_of(text)
    with h5py.File(computed / f"{name}.h5") as file:
        shape = file["regime"].shape
        assert shape == (len(file[y_name]), len(file[x_name]))
        cells = random.Random(name).sample([(row, column) for row in range(shape[0]) for column in range(shape[1])], 6)
        found = {(row, column): [*(file[field][row, column] for field in LABEL), file["peak_force_ratio"][row, column]]
                 for row, column in cells}
        values = {(row, column): (float(file[x_name][column]), float(file[y_name][row])) for row, column in cells}
    for cell, expected in found.items():
        jobs.write(tmp_path, job_of_cell(text, values[cell]), "cell.toml")
        assert launch.run("run", "cell.toml", "--fresh", "--quiet", cwd=tmp_path).returncode == 0
        with h5py.File(tmp_path / "cell.h5") as file:
            alone = [*(file[field][0, 0] for field in LABEL), file["peak_force_ratio"][0, 0]]
        assert alone[:3] == expected[:3], (cell, values[cell])
        assert alone[3] == pytest.approx(expected[3], rel=1e-8, nan_ok=True), (cell, values[cell])


@pytest.mark.parametrize("name, ranks", [("stops", None), ("stops", 3), ("stops", 7), ("lines", None), ("lines", 3)])
def test_any_number_of_ranks_gives_the_same_bytes(computed, tmp_path, name, ranks):
    jobs.write(tmp_path, MAPS[name])
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=ranks).returncode == 0
    assert_same_map(tmp_path / "job.h5", computed / f"{name}.h5")


def test_a_stopped_run_goes_on_to_the_same_bytes(tmp_path):
    jobs.write(tmp_path, STOPS.replace("points = 20", "points = 128").replace("points = 18", "points = 96"))
    stopped = launch.run("run", "job.toml", "--quiet", "--max-wall", 0.1, cwd=tmp_path)
    assert stopped.returncode == 5, stopped.stderr
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=2).returncode == 0
    assert launch.run("run", "job.toml", "--quiet", "--output", "whole.h5", cwd=tmp_path, ranks=2).returncode == 0
    assert_same_map(tmp_path / "job.h5", tmp_path / "whole.h5")


def test_the_file_opens_in_xarray_with_names_and_units(computed):
    xarray = pytest.importorskip("xarray")
    with xarray.open_dataset(computed / "stops.h5") as cells:
        assert cells.regime.dims == ("contact_damping_ns_per_m", "contact_stiffness_n_per_m")
        assert cells.contact_damping_ns_per_m.attrs["units"] == "N s/m"
        assert cells.attrs["frequency_hz"] == 9.0 and cells.attrs["frequency_ratio"] == 2.0 and cells.attrs["gap_ratio"] == 0
    with xarray.open_dataset(computed / "lengths.h5") as cells:
        assert "cart_amplitude_m" not in cells.attrs and cells.attrs["hammer_mass_kg"] == 0.298


def test_the_summary_tells_where_in_words_of_the_axes(computed):
    shown = launch.run("run", "stops.toml", cwd=computed).stdout
    assert "20 by 18 values of contact.stiffness_n_per_m and contact.damping_ns_per_m" in shown
    assert re.search(r"at frequency 9 Hz \(Omega/omega 2\), gap 0 mm \(gap/A0 0\), contact.stiffness_n_per_m \S+ N/m, "
                     r"contact.damping_ns_per_m \S+ N s/m", shown), shown


def test_check_tells_the_axes_and_that_rigs_cost_more(computed):
    told = launch.run("check", "stops.toml", cwd=computed).stdout
    assert "20 of contact_stiffness_n_per_m by 18 of contact_damping_ns_per_m" in told
    assert "#   rigs     cells have their own" in told
    assert "#   rigs     cells have their own" in launch.run("check", "lines.toml", cwd=computed).stdout
    assert "#   rigs" not in launch.run("check", "starts.toml", cwd=computed).stdout


def test_a_map_over_a_rig_is_refined_and_audited(tmp_path):
    text = map_over(axis("contact.damping_ns_per_m", 100, 4000, 33, "log"), axis("frequency_ratio", 1.8, 2.4, 33),
                    more="[operating_point]\ngap_ratio = 0.0\n") + "[refine]\nlevels = 2\n[audit]\ncells = 8\n"
    jobs.write(tmp_path, text)
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    assert re.search(r"same regime and z +8 of 8", finished.stdout), finished.stdout
    jobs.write(tmp_path, text.replace("levels = 2", "levels = 0"), "whole.toml")
    assert launch.run("run", "whole.toml", "--quiet", cwd=tmp_path, ranks=2).returncode == 0
    with h5py.File(tmp_path / "job.h5") as refined, h5py.File(tmp_path / "whole.h5") as whole:
        filled = refined["computed"][()] == 0
        assert filled.any()
        same = np.all([refined[field][()] == whole[field][()] for field in LABEL], axis=0)
        assert same[filled].mean() > 0.98
        force = refined["peak_force_ratio"][()] / whole["peak_force_ratio"][()]
        assert np.nanmax(np.abs(force[same & filled] - 1)) < 0.01


def test_a_trace_follows_a_cell_of_such_a_map(computed, tmp_path):
    jobs.write(tmp_path, jobs.trace_of(computed / "lengths.h5", "row = 6\ncolumn = 3\n"))
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    assert "agrees in regime and z" in finished.stdout
    jobs.write(tmp_path, jobs.trace_of(computed / "lengths.h5", "[operating_point]\nfrequency_ratio = 2\n"))
    refused = launch.run("run", "job.toml", cwd=tmp_path)
    assert refused.returncode == 2 and "is that of the map's own job" in refused.stderr


NAMED = {  # map: (table and key of columns and rows)
    "stops": (("contact", "stiffness_n_per_m"), ("contact", "damping_ns_per_m")),
    "lengths": (("operating_point", "gap_m"), ("cart", "amplitude_m")),
    "hammers": (("hammer", "mass_kg"), ("hammer", "stiffness_n_per_m")),
    "starts": (("start", "velocity_ratio"), ("operating_point", "frequency_ratio")),
}


def tables(*named):
    """[table] key = value for each, each table once."""
    found = {}
    for (table, key), value in named:
        found.setdefault(table, []).append(f"{key} = {float(value)!r}\n")
    return "".join(f"[{table}]\n" + "".join(lines) for table, lines in found.items())


@pytest.mark.parametrize("name", NAMED)
def test_a_trace_names_its_cell_by_values_on_these_axes(computed, tmp_path, name):
    columns, rows = NAMED[name]
    with h5py.File(computed / f"{name}.h5") as file:
        (x, _), (y, _) = [(file[key][()], key) for key, *_ in axes_of(MAPS[name])]
    row, column = 2, len(x) - 2
    between = np.sqrt(x[column] * x[column - 1]) if name == "stops" else (x[column] + x[column - 1]) / 2
    near = between + (x[column] - between) * 0.1  # a cell extends half a step, in the logarithm for a logarithmic axis
    jobs.write(tmp_path, jobs.trace_of(computed / f"{name}.h5", tables((columns, near), (rows, y[row]))))
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    assert f"row {row} (" in finished.stdout and f"column {column} (" in finished.stdout, finished.stdout
    assert "the nearest cell" in finished.stdout
    jobs.write(tmp_path, jobs.trace_of(computed / f"{name}.h5", tables((columns, x[column]), (rows, y[row]))))
    assert "agrees in regime and z" in launch.run("run", "job.toml", "--fresh", cwd=tmp_path).stdout


@pytest.mark.parametrize("name, settings, message", [
    ("stops", "[contact]\nstiffness_n_per_m = 1e6\n", "give trace.row and trace.column, or contact.stiffness_n_per_m and contact."),
    ("stops", "[hammer]\nmass_kg = 1\n", "hammer.mass_kg is that of the map's own job, the same for all its cells; its axes run"),
    ("stops", "[contact]\nlaw = \"restitution\"\n", "contact.law is that of the job in the map's file; a cell is named by"),
    ("stops", "[contact]\nstifness_n_per_m = 1e6\n", "did you mean stiffness_n_per_m?"),
    ("hammers", "[hammer]\nnatural_frequency_hz = 4\n", "says what the map's axis says as hammer.stiffness_n_per_m; give that"),
    ("lengths", "[operating_point]\ngap_ratio = 1\n", "says what the map's axis says as operating_point.gap_m; give that"),
    ("stops", "[contact]\nstiffness_n_per_m = 1e9\ndamping_ns_per_m = 100\n", "lies outside of the map"),
])
def test_a_cell_that_such_a_map_has_not_is_refused(computed, tmp_path, name, settings, message):
    jobs.write(tmp_path, jobs.trace_of(computed / f"{name}.h5", settings))
    refused = launch.run("run", "job.toml", cwd=tmp_path)
    assert refused.returncode == 2 and message in " ".join(refused.stderr.split()), refused.stderr


def drawn(folder, *arguments):
    return subprocess.run([sys.executable, ROOT / "postprocess" / "draw.py", *map(str, arguments)], cwd=folder,
                          capture_output=True, text=True, check=False)


def test_maps_and_sweeps_over_any_axes_are_drawn_and_compared(computed, tmp_path):
    for name in MAPS:
        shown = drawn(tmp_path, computed / f"{name}.h5")
        assert shown.returncode == 0, shown.stderr
    assert {"stops_map.png", "lengths_map.png"} <= {path.name for path in (tmp_path / "pictures").iterdir()}
    along, place = SWEEPS["gaps"]
    jobs.write(tmp_path, jobs.RIG.format(kind="sweep", title="gaps") + place + along, "gaps.toml")
    assert launch.run("run", "gaps.toml", "--quiet", cwd=tmp_path).returncode == 0
    shown = drawn(tmp_path, "gaps.h5")
    assert shown.returncode == 0, shown.stderr
    compared = subprocess.run([sys.executable, ROOT / "postprocess" / "compare.py", computed / "stops.h5", computed / "stops.h5"],
                              cwd=tmp_path, capture_output=True, text=True, check=False)
    assert compared.returncode == 0, compared.stderr
    other = subprocess.run([sys.executable, ROOT / "postprocess" / "compare.py", computed / "stops.h5", computed / "starts.h5"],
                           cwd=tmp_path, capture_output=True, text=True, check=False)
    assert other.returncode != 0 and "only cells at the same places" in other.stderr


def program(name, folder, *arguments):
    return subprocess.run([sys.executable, ROOT / "postprocess" / f"{name}.py", *map(str, arguments)], cwd=folder,
                          capture_output=True, text=True, check=False)


def test_where_to_operate_is_told_in_words_of_the_axes(computed, tmp_path):
    told = program("operating_point", tmp_path, computed / "lines.h5", "--hz", 0, "--mm", 0)
    assert told.returncode == 0, told.stderr
    with h5py.File(computed / "lines.h5") as file:
        force = np.where(file["regime"][()] == 1, file["peak_force_ratio"][()], 0) * 0.298 * 9.80665
        row, column = np.unravel_index(force.argmax(), force.shape)
        damping, hertz = file["contact_damping_ns_per_m"][row], file["frequency_ratio"][column] * 4.5
    best = next(line for line in told.stdout.splitlines() if line.startswith("best: "))
    assert f"({hertz:.5g} Hz)" in best and f"stop damping {damping:.5g} N s/m" in best
    assert f"at least {force.max() / 1000:.4g} kN" in best


def test_cells_are_exported_with_the_names_of_their_axes(computed, tmp_path):
    done = program("export", tmp_path, computed / "stops.h5", "--as", "csv", "--output-dir", tmp_path)
    assert done.returncode == 0, done.stderr
    lines = (tmp_path / "stops.csv").read_text().splitlines()
    assert lines[0].startswith("contact_stiffness_n_per_m,contact_damping_ns_per_m,regime,") and len(lines) == 1 + 20 * 18


def test_what_is_of_frequency_and_gap_alone_says_so(computed, tmp_path):
    (tmp_path / "points.csv").write_text("frequency_hz,gap_mm\n9,0\n")
    points = drawn(tmp_path, computed / "stops.h5", "--measured", "points.csv")
    assert points.returncode == 2 and "measured points are drawn over frequencies and gaps" in points.stderr
