"""Curves over axes other than frequency and gap pass through the points found in the plane of frequency and gap, labels of
single cells, solved by CVODE, change there, and file and pictures name the axes."""

import subprocess
import sys
from pathlib import Path

import jobs
import launch
import map_contents
import numpy as np
import pytest
import xarray
from any_axes import axis

pytestmark = pytest.mark.thorough

ROOT = Path(__file__).resolve().parents[2]
FOLD, DOUBLING = 0, 1
ONE = "\n[curves]\nmax_period = 1\n"
GAPS = [0.0, 1.0, 1.5]
# Limits of 1/1 of the 170 mm rig at these gaps: kind, and the frequency ratio from an independent program.
LIMITS = {0.0: (DOUBLING, 2.659361979), 1.0: (DOUBLING, 2.264326891), 1.5: (FOLD, 1.862464993)}
# Over other axes: gap ratio, columns and rows, further job text, in which {} is the limit's frequency ratio, and the curve's
# row at the first column (the printed rig), times that ratio if the row is a frequency.
PLANES = {
    "stops": (0.0, axis("contact.stiffness_n_per_m", 5.5e6, 2e7, 20, "log"),
              axis("contact.damping_ns_per_m", 600.0, 2400.0, 21),
              "[operating_point]\nfrequency_ratio = {}\ngap_ratio = 0.0\n", 1.2e3),
    "lengths": (1.5, axis("cart.amplitude_m", 0.89e-3, 1.3e-3, 14), axis("gap_m", 1e-3, 2.2e-3, 25),
                "[operating_point]\nfrequency_ratio = {}\n[start]\ndisplacement_ratio = -1.0\n"
                "velocity_ratio = 2.0\n", 1.5 * 0.89e-3),
    "masses": (1.0, axis("hammer.mass_kg", 0.298, 0.5, 16), axis("frequency_hz", 8.0, 12.5, 25),
               "[operating_point]\ngap_ratio = 1.0\n", 4.5),
}


def place(name, limits):
    gap, _, _, more, _ = PLANES[name]
    return more.format(repr(float(limits[gap])))


def job_over(name, limits):
    _, columns, rows, *_ = PLANES[name]
    return jobs.RIG.format(kind="curves", title=name) + place(name, limits) + columns + rows + ONE


@pytest.fixture(scope="module")
def limits(tmp_path_factory):
    """{gap ratio: frequency ratio} of LIMITS, to all digits, from the plane of frequency and gap."""
    folder = tmp_path_factory.mktemp("usual")
    text = (jobs.RIG.format(kind="curves", title="usual") + axis("frequency_ratio", 1.5, 3.0, 48) + axis("gap_ratio", 0.0, 2.0, 32)
            + ONE + f"gap_ratio = {GAPS}\n" + "[start]\ndisplacement_ratio = -1.0\nvelocity_ratio = 2.0\n")
    jobs.write(folder, text, "usual.toml")
    assert launch.run("run", "usual.toml", cwd=folder, ranks=2).returncode == 0
    with xarray.open_dataset(folder / "usual.h5") as data:
        kinds = data.curve_kind.values[data.crossing_curve.values]
        crossings = list(zip(kinds, data.crossing_gap_ratio.values, data.crossing_frequency_ratio.values))
    found = {gap: float(frequency) for gap, (kind, known) in LIMITS.items() for its_kind, its_gap, frequency in crossings
             if its_kind == kind and abs(its_gap - gap) < 1e-9 and abs(frequency - known) < 2e-9}
    assert found.keys() == LIMITS.keys()
    return found


@pytest.fixture(scope="module")
def computed(limits, tmp_path_factory):
    """Folder with the files of PLANES, computed on 2 ranks, and {name: output of the run}."""
    folder, said = tmp_path_factory.mktemp("curves"), {}
    for name in PLANES:
        jobs.write(folder, job_over(name, limits), f"{name}.toml")
        finished = launch.run("run", f"{name}.toml", cwd=folder, ranks=2)
        assert finished.returncode == 0, finished.stderr
        said[name] = finished.stdout
    return folder, said


def curves_of(data, kind):
    """(columns, rows), each (points,), of every curve of this kind of 1/1."""
    columns, rows = (data[f"point_{name}"].values for name in reversed(data.regime.dims))
    for number in np.flatnonzero((data.curve_kind == kind) & (data.curve_impacts == 1) & (data.curve_period == 1)):
        part = slice(int(data.curve_first[number]), int(data.curve_first[number] + data.curve_points[number]))
        yield columns[part], rows[part]


@pytest.mark.parametrize("name", PLANES)
def test_a_curve_meets_the_printed_rig_where_the_usual_plane_has_it(computed, limits, name):
    gap, *_, known = PLANES[name]
    kind, known = LIMITS[gap][0], known * (limits[gap] if name == "masses" else 1)
    with xarray.open_dataset(computed[0] / f"{name}.h5") as data:
        border = float(data[data.regime.dims[1]][0])
        ends = [rows[i] for columns, rows in curves_of(data, kind) for i in (0, -1) if abs(columns[i] / border - 1) < 1e-12]
        assert min(abs(end / known - 1) for end in ends) < 1e-10
        assert float(data.point_residual.max()) <= 1e-11


def test_a_gap_in_mm_is_the_same_ratio_at_any_amplitude(computed):
    with xarray.open_dataset(computed[0] / "lengths.h5") as data:
        (amplitudes, gaps), = curves_of(data, FOLD)
        assert len(gaps) > 20 and np.allclose(gaps / amplitudes, 1.5, rtol=1e-8, atol=0)


def test_labels_of_single_cells_differ_on_both_sides(computed, limits, tmp_path):
    """The interior points of the curve, each with a two-cell map, one cell on either side."""
    with xarray.open_dataset(computed[0] / "stops.h5") as data:
        stiffnesses, dampings = max(curves_of(data, DOUBLING), key=lambda curve: len(curve[0]))
    for i in np.linspace(1, len(dampings) - 2, 3).astype(int):
        column = axis("contact.stiffness_n_per_m", repr(float(stiffnesses[i])), repr(float(stiffnesses[i])), 1)
        row = axis("contact.damping_ns_per_m", repr(float(dampings[i] * 0.97)), repr(float(dampings[i] * 1.03)), 2)
        text = jobs.RIG.format(kind="map", title="sides") + place("stops", limits) + column + row
        path = jobs.write(tmp_path, text, f"side_{i}.toml")
        assert launch.run("run", path.name, "--set", "solver.engine=cvode", cwd=tmp_path).returncode == 0
        with xarray.open_dataset(tmp_path / f"side_{i}.h5") as sides:
            assert sorted(zip(sides.impacts.values.ravel(), sides.period.values.ravel())) == [(1, 1), (2, 2)]


def test_file_and_pictures_name_the_axes(computed, tmp_path):
    folder, said = computed
    with xarray.open_dataset(folder / "stops.h5") as data:
        assert data.regime.dims == ("contact_damping_ns_per_m", "contact_stiffness_n_per_m")
        assert data.point_contact_stiffness_n_per_m.attrs["units"] == "N/m"
        assert "frequency_ratio" not in data and data.attrs["gap_ratio"] == 0
    assert "1/1" in said["stops"]
    drawn = subprocess.run([sys.executable, ROOT / "postprocess/draw.py", folder / "stops.h5", "--output", tmp_path],
                           capture_output=True, text=True, check=False)
    assert drawn.returncode == 0, drawn.stderr
    assert {path.stem for path in tmp_path.iterdir()} == {"stops_curves", "stops_curves_over_map"}


def test_any_number_of_ranks_gives_the_same_bytes(computed, limits, tmp_path):
    path = jobs.write(tmp_path, job_over("stops", limits), "stops.toml")
    assert launch.run("run", path.name, cwd=tmp_path, ranks=3).returncode == 0
    map_contents.assert_same_map(tmp_path / "stops.h5", computed[0] / "stops.h5")


def test_edges_of_a_cell_are_told_along_such_axes(limits, tmp_path):
    """Along the stop's damping the motion of a cell ends at the curve."""
    jobs.write(tmp_path, job_over("stops", limits) + "edge_distance = true\n", "edges.toml")
    assert launch.run("run", "edges.toml", cwd=tmp_path).returncode == 0
    with xarray.open_dataset(tmp_path / "edges.h5") as data:
        change = data.edge_distance_contact_damping_ns_per_m[:, 0]
        doubling = data.edge_kind_contact_damping_ns_per_m[:, 0] == DOUBLING
        assert int(doubling.sum()) > 5
        edges = (data.contact_damping_ns_per_m + change).values[doubling.values]
        assert np.allclose(edges, 1.2e3, rtol=1e-10)


@pytest.mark.parametrize("columns, reason", [
    ("start.velocity_ratio", "a curve is where motions end, wherever the hammer starts"),
    ("hammer.cubic_stiffness_n_per_m3", "curves leave the cubic part of the springs out")])
def test_what_no_curve_runs_over_is_refused_in_words(tmp_path, columns, reason):
    text = jobs.RIG.format(kind="curves", title="refused") + axis(columns, 1.0, 2.0, 9) + axis("frequency_ratio", 1.0, 2.0, 9)
    path = jobs.write(tmp_path, text)
    finished = launch.run("check", path.name, cwd=tmp_path)
    assert finished.returncode == 2 and reason in finished.stderr and finished.stderr.count("[axes.") == 1


def test_borders_at_gaps_need_an_axis_of_the_gap(limits, tmp_path):
    path = jobs.write(tmp_path, job_over("stops", limits) + "gap_ratio = [0.0]\n")
    finished = launch.run("check", path.name, cwd=tmp_path)
    assert finished.returncode == 2 and "no axis runs over the gap" in finished.stderr
