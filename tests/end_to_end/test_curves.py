"""Curves: identical at any number of ranks, readable by xarray, on the edges of the map's labels, with messages if there are none."""

import contextlib
import re
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray

import jobs
import launch
import map_contents

ROOT = Path(__file__).resolve().parents[2]
FOLD, DOUBLING, GRAZING = range(3)


def compute(folder, text, *arguments, ranks=None):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", *arguments, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished


@pytest.fixture(scope="module")
def curves(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("curves"), jobs.small_curves(points=32))


def lines(path, kind, impacts, period):
    with h5py.File(path) as file:
        chosen = ((file["curve_kind"][()] == kind) & (file["curve_impacts"][()] == impacts)
                  & (file["curve_period"][()] == period))
        points = np.column_stack([file["point_frequency_ratio"][()], file["point_gap_ratio"][()]])
        return [points[first:first + count] for first, count in zip(
            file["curve_first"][()][chosen], file["curve_points"][()][chosen])]


@pytest.mark.parametrize("ranks", [2, 3, 7])
def test_curves_are_the_same_at_any_number_of_ranks(tmp_path, curves, ranks):
    path, quiet = compute(tmp_path, jobs.small_curves(points=32), "--quiet", ranks=ranks)
    assert "to compute" not in quiet.stderr
    map_contents.assert_same_map(path, curves[0])


def test_progress_is_shown_stage_by_stage(tmp_path):
    _, finished = compute(tmp_path, jobs.small_curves(points=12), "--set", "curves.edge_distance=true", ranks=2)
    said = [line for line in finished.stderr.splitlines() if line.startswith("peterka: ")]
    assert said[0] == "peterka: 144 cells to compute" and said[2] == "peterka: 24 lines to measure" and len(said) == 3
    assert re.fullmatch(r"peterka: [\d,]+ edges to follow", said[1])


def test_the_coarse_map_has_the_labels_and_the_status_of_a_map(tmp_path, curves):
    jobs.write(tmp_path, jobs.small_curves(points=32).replace('kind = "curves"', 'kind = "map"').split("[curves]")[0], "map.toml")
    assert launch.run("run", "map.toml", cwd=tmp_path).returncode == 0
    with xarray.open_dataset(curves[0]) as data, xarray.open_dataset(tmp_path / "map.h5") as cells:
        assert data.status.dims == cells.status.dims and data.status.attrs["flag_meanings"] == cells.status.attrs["flag_meanings"]
        for name in ("regime", "status", "impacts", "period"):
            assert np.array_equal(data[name].values, cells[name].values), name
        assert (data.status.values != 0).any()


def test_the_file_opens_in_xarray_and_each_point_obeys_its_equations(curves):
    with xarray.open_dataset(curves[0]) as data:
        assert float(data.point_residual.max()) <= 1e-11
        assert int(data.curve_points.sum()) == data.sizes["point"]
        assert (np.diff(data.curve_first) == data.curve_points[:-1]).all()
        assert data.regime.dims == ("gap_ratio", "frequency_ratio")
        assert data.curve_kind.attrs["flag_meanings"] == "fold period_doubling grazing"
        of_fold = np.repeat(data.curve_kind.values == FOLD, data.curve_points.values)
        assert np.isclose(np.abs(data.point_multiplier.values[of_fold]), 1, atol=1e-6).all()


# Reference values from an independent program, at given gaps.
@pytest.mark.parametrize("kind, gap, frequency", [
    (DOUBLING, 1.0, 2.264326891), (DOUBLING, 1.0, 0.718391067), (FOLD, 1.5, 1.862464993)])
def test_limits_of_1_1_lie_on_curves(curves, kind, gap, frequency):
    place = np.array([frequency, gap])
    distances = []
    for points in lines(curves[0], kind, 1, 1):
        start, way = points[:-1], np.diff(points, axis=0)
        share = np.clip(np.sum((place - start) * way, axis=1) / np.maximum(np.sum(way**2, axis=1), 1e-300), 0, 1)
        distances.append(np.hypot(*(start + share[:, None] * way - place).T).min())
    assert min(distances) < 1e-3  # from a straight line between two points of the curve


def test_the_summary_explains_the_edges(curves):
    with h5py.File(curves[0]) as file:
        count, explained = (int(file[f"edges/{name}"][()]) for name in ("count", "on_curve"))
        basins = int(file["edges/basin"][()])
        assert count > 50 and explained + basins >= 0.98 * count
    assert re.search(r"Traced from the motions of \d+ by \d+ cells: curves of motions that none of these cells shows may be missing", curves[1].stdout)
    assert "within one cell of a curve" in curves[1].stdout
    assert re.search(r"Tracing: [\d,]+ points a second and rank, median residual [\d.]+e-1[3-6]", curves[1].stdout)


BORDERS = [(GRAZING, 0.0, 1.15008754), (DOUBLING, 0.0, 2.659361979), (DOUBLING, 1.0, 0.718391067),
           (DOUBLING, 1.0, 2.264326891), (FOLD, 1.5, 1.862464993)]  # of 1/1, from the same independent program


def test_borders_at_given_gaps_are_told_to_nine_digits(tmp_path):
    job = jobs.small_curves(points=32) + "\n[curves]\ngap_ratio = [0.0, 1.0, 1.5]\n"
    path, finished = compute(tmp_path, job)
    with h5py.File(path) as file:
        of = {name: file[f"curve_{name}"][()][file["crossing_curve"][()]] for name in ("kind", "period")}
        frequencies, gaps = file["crossing_frequency_ratio"][()], file["crossing_gap_ratio"][()]
    assert set(np.round(gaps, 9)) == {0.0, 1.0, 1.5}
    told = {number for line in finished.stdout.splitlines() if line.startswith("  1/1  ")
            for number in line.replace(",", " ").split() if "." in number}
    for kind, gap, frequency in BORDERS:
        there = (of["kind"] == kind) & (of["period"] == 1) & (np.abs(gaps - gap) < 1e-9)
        assert np.abs(frequencies[there] - frequency).min() < 1e-8
        assert any(abs(float(number) - 4.5 * frequency) < 6e-8 for number in told)
    assert "Borders at gap/A0 1.5 (1.335 mm)" in finished.stdout


# Proved in interval arithmetic by [certificate]. Their motions live beside curves of others with an impact or a cycle more.
@pytest.mark.parametrize("gap, kind, impacts, period, frequency", [
    (0.0, FOLD, 6, 1, 0.878963298178), (0.0, FOLD, 3, 2, 2.956129917428), (0.0, DOUBLING, 3, 2, 2.957465795191),
    (3.3707865168539326, FOLD, 3, 3, 3.541627681857), (3.3707865168539326, FOLD, 2, 4, 0.883978588944)])
def test_borders_beside_another_curve_are_found(fine, gap, kind, impacts, period, frequency):
    curve, frequencies, gaps = fine
    assert np.any((curve == (kind, impacts, period)).all(axis=1) & (gaps == gap) & (np.abs(frequencies - frequency) < 1e-9))


@pytest.fixture(scope="module")
def fine(tmp_path_factory):
    job = jobs.small_curves(points=128) + "\n[curves]\ngap_ratio = [0.0, 3.3707865168539326]\n"
    path, _ = compute(tmp_path_factory.mktemp("fine"), job)
    with h5py.File(path) as file:
        of = file["crossing_curve"][()]
        curve = np.column_stack([file[f"curve_{name}"][()][of] for name in ("kind", "impacts", "period")])
        return curve, file["crossing_frequency_ratio"][()], file["crossing_gap_ratio"][()]


@pytest.mark.parametrize("columns, rows", [(12, 2), (33, 3), (5, 3)])
def test_few_cells_find_the_curve_that_ends_the_motion_between_them(tmp_path, columns, rows):
    job = (jobs.RIG.format(kind="curves", title="few") + jobs.axis("frequency_ratio", 1.5, 4, columns)
           + jobs.axis("gap_ratio", 0, 3, rows) + "\n[curves]\nmax_period = 1\ngap_ratio = [0.0]\n")
    path, finished = compute(tmp_path, job)
    with h5py.File(path) as file:
        assert np.any(np.abs(file["crossing_frequency_ratio"][()] - BORDERS[1][2]) < 1e-8)
    assert "  1/1        11.9671289 period doubling" in finished.stdout


# With springs of 150 mm a curve passes points at which an additional brief contact appears or disappears.
@pytest.mark.thorough
@pytest.mark.parametrize("springs", [(), ("--set", "hammer.natural_frequency_hz=5.25", "--set", "hammer.damping_ns_per_m=0.08")])
def test_each_end_of_a_curve_has_a_reason(tmp_path, springs):
    path, _ = compute(tmp_path, jobs.small_curves(points=128), *springs)
    with h5py.File(path) as file:
        lost = [f"{p}/{q}, kind {kind}" for kind, p, q, *ends in zip(*(file[f"curve_{name}"][()] for name in (
            "kind", "impacts", "period", "begin", "end"))) if 3 in ends]
        assert len(file["curve"]) > 60 and not lost


def test_a_complete_file_is_left_as_it_is(curves):
    again = launch.run("run", "job.toml", cwd=curves[0].parent)
    assert again.returncode == 0 and "nothing is computed" in again.stdout


@pytest.mark.thorough
@pytest.mark.parametrize("ranks", [None, 2])
def test_a_run_that_is_stopped_leaves_nothing_and_starts_again(tmp_path, curves, ranks):
    jobs.write(tmp_path, jobs.small_curves(points=32))
    stopped = launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path, ranks=ranks)
    assert stopped.returncode == 5 and "starts over" in stopped.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["job.toml"]
    map_contents.assert_same_map(compute(tmp_path, jobs.small_curves(points=32), ranks=ranks)[0], curves[0])


@pytest.mark.thorough
def test_a_killed_run_leaves_a_whole_file_or_none(tmp_path, curves):
    jobs.write(tmp_path, jobs.small_curves(points=32))
    for moment in (0.05, 0.2, 0.4, 0.8):
        with contextlib.suppress(subprocess.TimeoutExpired):
            subprocess.run([launch.BINARY, "run", "job.toml", "--quiet"], cwd=tmp_path, timeout=moment, check=False,
                           stdin=subprocess.DEVNULL, capture_output=True, env=launch.ENVIRONMENT)  # which kills it then
        if (tmp_path / "job.h5").exists():
            map_contents.assert_same_map(tmp_path / "job.h5", curves[0])
    map_contents.assert_same_map(compute(tmp_path, jobs.small_curves(points=32))[0], curves[0])


def test_a_window_without_impacts_has_words(tmp_path):
    job = (jobs.RIG.format(kind="curves", title="far stop") + jobs.axis("frequency_ratio", 2.0, 4.0, 4)
           + jobs.axis("gap_ratio", 20.0, 30.0, 4))
    path, finished = compute(tmp_path, job)
    assert "No curve: 0 of the 16 cells" in finished.stdout
    with h5py.File(path) as file:
        assert "curve_kind" not in file and file["regime"].shape == (4, 4)


@pytest.mark.parametrize("change, words", [
    (("law = \"kelvin_voigt\"\nstiffness_n_per_m = 5.5e6\ndamping_ns_per_m = 1.2e3",
      "law = \"hunt_crossley\"\nstiffness_n_per_m_pow_n = 1e9\ndissipation_s_per_m = 0.1"), "closed form"),
    (("[curves]\nmax_period = 4", "[curves]\nmax_period = 0"), "curves.max_period"),
    (("[curves]\nmax_period = 4", "[curves]\ngap_ratio = [1.0, 6.0]"), "widen the window"),
    (("to = 5.0\npoints = 8", "to = 5.0\npoints = 1"), "no curve lies in it"),
    (("[curves]\nmax_period = 4", "[refine]\nlevels = 2"), "curves are exact")])
def test_what_curves_cannot_do_is_refused(tmp_path, change, words):
    text = jobs.small_curves(points=8) + "\n[curves]\nmax_period = 4\n"
    assert change[0] in text
    jobs.write(tmp_path, text.replace(*change))
    refused = launch.run("run", "job.toml", cwd=tmp_path)
    assert refused.returncode == 2 and words in refused.stderr


# A rigid stop at gap 0 chatters, and without any damping nothing settles: no orbit, but the run ends.
def test_rigs_that_have_few_orbits_come_to_an_end(tmp_path):
    rigid = jobs.with_rigid_stop(jobs.small_curves(points=12)).replace("to = 5.0", "to = 0.5")
    path, _ = compute(tmp_path, rigid)
    with h5py.File(path) as file:
        assert float(file["point_residual"][()].max()) <= 1e-11
    undamped = tmp_path / "undamped"
    undamped.mkdir()
    _, finished = compute(undamped, jobs.small_curves(points=6), "--set", "hammer.damping_ns_per_m=0", "--set",
                          "steady_state.max_cycles=200", "--set", "contact.damping_ns_per_m=0")
    assert "No curve: 0 of the 36 cells" in finished.stdout
    assert "no stable motion without impacts ends within the window" in finished.stdout


def test_springs_without_damping_that_are_driven_at_resonance_have_curves(tmp_path):
    """The free oscillation is unbounded at Omega = omega, where a column of cells lies; a dissipative stop limits it."""
    window = "".join(jobs.axis(name, low, high, 9) for name, low, high in (("frequency_ratio", 0.8, 1.2), ("gap_ratio", 0.0, 5.0)))
    path, _ = compute(tmp_path, jobs.RIG.format(kind="curves", title="resonance") + window, "--set", "hammer.damping_ns_per_m=0")
    with h5py.File(path) as file:
        assert 1.0 in file["frequency_ratio"][()] and (file["regime"][()][:, 4] == 1).any()
        assert len(file["curve"]) > 5 and float(file["point_residual"][()].max()) <= 1e-11


@pytest.mark.thorough
def test_a_map_tells_borders_where_it_names_a_gap(tmp_path):
    """As for curves, for a file that equals the one without, and again when it is complete."""
    plain = compute(tmp_path, jobs.small_map())[0].rename(tmp_path / "plain.h5")
    path, first = compute(tmp_path, jobs.small_map() + "\n[curves]\ngap_ratio = [0.0, 1.0, 1.5]\n", ranks=2)
    again = launch.run("run", "job.toml", cwd=tmp_path)
    for finished in (first, again):
        told = {number for line in finished.stdout.splitlines() if line.startswith("  1/1  ")
                for number in line.replace(",", " ").split() if "." in number}
        for _, _, frequency in BORDERS:
            assert any(abs(float(number) - 4.5 * frequency) < 6e-8 for number in told)
    assert "is complete: nothing is computed" in again.stdout
    assert all(finished.stdout.endswith("Draw it    postprocess/draw.py job.h5\n") for finished in (first, again))
    one, other = map_contents.datasets(path), map_contents.datasets(plain)
    # the stored text of the job, and hence the seals, reflect the request
    assert one.keys() == other.keys()
    assert {name for name in one if one[name] != other[name]} <= {"summary/bytes", "summary/checksum", "summary/frame"}
    assert "Borders" not in launch.run("run", "job.toml", "--quiet", cwd=tmp_path).stdout


def test_check_tells_of_curves_only_where_a_map_asks_for_them(tmp_path):
    for asked in ("", "\n[curves]\ngap_ratio = [0.5]\n"):
        jobs.write(tmp_path, jobs.small_map() + asked)
        told = launch.run("check", "job.toml", cwd=tmp_path).stdout
        assert ("[curves]" in told) == bool(asked) and ("gap_ratio = [0.5]" in told) == bool(asked)


@pytest.mark.parametrize("change, words", [
    ({"[axes.gap_ratio]": "[axes.contact.damping_ns_per_m]"}, "no axis runs over the gap"),
    ({"[curves]": "[curves]\nedge_distance = true"}, "remove this key"),
    ({"1.0, 1.5]": "1.0, 9.5]"}, "widen the window")])
def test_borders_that_a_map_cannot_tell_are_refused(tmp_path, change, words):
    text = jobs.small_map() + "\n[curves]\ngap_ratio = [0.0, 1.0, 1.5]\n"
    for old, new in change.items():
        assert old in text
        text = text.replace(old, new)
    jobs.write(tmp_path, text)
    refused = launch.run("run", "job.toml", cwd=tmp_path)
    assert refused.returncode == 2 and words in refused.stderr


# From rest hardly any start leads to impacts there; 1/2 coexists.
HIDDEN = jobs.RIG.format(kind="curves", title="hidden") + jobs.axis("frequency_ratio", 3.0, 4.4, 12) + jobs.axis("gap_ratio", 1.5, 3.0, 12)


@pytest.mark.thorough
def test_motions_that_only_other_starts_reach_have_curves_too(tmp_path):
    of_1_2 = {}
    for count in (0, 24):
        path, _ = compute(tmp_path, HIDDEN + f"\n[starts]\ncount = {count}\n", "--fresh", ranks=2 if count else None)
        of_1_2[count] = [line for kind in range(3) for line in lines(path, kind, 1, 2)] if "curve" in h5py.File(path) else []
    assert len(of_1_2[24]) > len(of_1_2[0])


def test_springs_that_keep_their_cubic_part_are_refused(tmp_path):
    jobs.write(tmp_path, jobs.small_curves(points=8))
    refused = launch.run("run", "job.toml", "--set", "hammer.cubic_stiffness_n_per_m3=1e5", "--set", "solver.omit_tolerance=0",
                         cwd=tmp_path)
    assert refused.returncode == 2 and "curves leave the cubic part of the springs out" in refused.stderr


def test_where_a_hammer_begins_to_stick_no_impact_is_gained(tmp_path):
    """A stop that takes all speed leaves the hammer at rest, as a grazing does: no curve goes along where such a rest begins to last. On each
    grazing curve another label begins, as maps of cells on either side of it show."""
    rig = jobs.with_rigid_stop(jobs.RIG.format(kind="{kind}", title="r = 0")).replace("coefficient = 0.5", "coefficient = 0.0")
    start = "[start]\ndisplacement_ratio = -1.0\n"
    path, said = compute(tmp_path, rig.replace("{kind}", "curves") + jobs.axis("frequency_ratio", 0.6, 4.0, 48) + jobs.axis("gap_ratio", -0.3, 3.0, 48)
                         + "[curves]\nmax_period = 2\ngap_ratio = [0.0, 1.0]\n" + start)
    assert "without acceleration" not in said.stdout  # a special point of such a curve
    with h5py.File(path) as file:
        data = {name: item[()] for name, item in file.items() if name.startswith(("curve_", "crossing_", "point_"))}
    crossings = data["crossing_frequency_ratio"][data["curve_kind"][data["crossing_curve"]] == 2]
    assert len(crossings) > 0 and np.min(np.abs(crossings - 1.0)) > 1e-3  # that of no rest
    places = []
    for curve in np.flatnonzero((data["curve_kind"] == 2) & (data["curve_impacts"] > 0) & (data["curve_period"] == 1)):  # [start] leads to these
        inner = slice(data["curve_first"][curve] + 3, data["curve_first"][curve] + data["curve_points"][curve] - 3)
        frequency, gap = data["point_frequency_ratio"][inner], data["point_gap_ratio"][inner]
        places += [(frequency[n], gap[n]) for n in np.linspace(0, len(gap) - 1, 8).astype(int)]
    assert len(places) >= 8
    same = []
    for number, (frequency, gap) in enumerate(places):
        job = rig.replace("{kind}", "map") + jobs.axis("frequency_ratio", frequency, frequency, 1) + jobs.axis("gap_ratio", gap - 0.004, gap + 0.004, 2)
        (tmp_path / f"{number}.toml").write_text(job + start)
        assert launch.run("run", f"{number}.toml", "--quiet", cwd=tmp_path).returncode == 0
        with h5py.File(tmp_path / f"{number}.h5") as cells:
            labels = {tuple(int(cells[name][row, 0]) for name in ("regime", "impacts", "period")) for row in (0, 1)}
        if len(labels) != 2:
            same.append((frequency, gap, labels))
    assert not same


# Two rigs and windows in which curves of folds end or turn. Amplitudes [m] are 8.138204229643042e-3 and 6.307289641278982e-3.
TURNING = """schema = 1
kind = "curves"
[hammer]
mass_kg = 0.05848861591378907
natural_frequency_hz = 14.646539431763399
damping_ratio = 0.051624853049025046
[cart]
amplitude_m = 0.008138204229643042
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 53322.713646712924
damping_ns_per_m = 27.135808343317326
[axes.contact.stiffness_n_per_m]
from = 1486.0122377938105
to = 1486012.2377938107
points = 30
scale = "log"
[axes.gap_m]
from = -0.004069102114821521
to = 0.024414612688929124
points = 30
[operating_point]
frequency_hz = 38.08100252258484
[curves]
max_period = 4
gap_m = [0.007430180461664097, 0.007431808102510026]  # 0.9130 and 0.9132 A0
[certificate]
cells = "all"
"""
MERGING = """schema = 1
kind = "curves"
[hammer]
mass_kg = 0.45448378645716
natural_frequency_hz = 8.719614765110757
damping_ratio = 0.00986177699371123
[cart]
amplitude_m = 0.006307289641278982
[contact]
law = "restitution"
coefficient = 0.3484887883098006
[axes.frequency_hz]
from = 4.3598073825553785
to = 39.23826644299841
points = 30
[axes.gap_m]
from = 0.0
to = 0.03153644820639491
points = 30
[curves]
max_period = 4
gap_m = [0.011587222068488015, 0.013806171194475839]
"""


def test_folds_turn_back_where_the_stop_begins_to_release_in_between(tmp_path):
    """Along a fold of 2/4 the stop's force falls to 0 within a contact, at 0.91311 A0 by an independent solver for folds of such a contact. There
    the curve turns back: before, there are two folds, both proved, and beyond none, where one with the stop pulling was told."""
    path, _ = compute(tmp_path, TURNING)
    with h5py.File(path) as file:
        data = {name: item[()] for name, item in file.items() if name.startswith(("curve_", "crossing_"))}
        proved = file["crossing_certified"][()]
    kinds, periods = data["curve_kind"][data["crossing_curve"]], data["curve_period"][data["crossing_curve"]]
    folds = (kinds == FOLD) & (periods == 4)
    stiffness, gap = data["crossing_contact_stiffness_n_per_m"], data["crossing_gap_m"]
    before = np.sort(stiffness[folds & (np.abs(gap - 0.007430180461664097) < 1e-12)])
    assert before[-2:] == pytest.approx([88018.6328, 88018.9776], abs=1e-3)
    assert not np.any(folds & (gap > 0.0074318) & (stiffness > 88079.5))
    assert np.all(proved[folds] > 0)


def test_a_fold_ends_where_it_merges_with_a_period_doubling(tmp_path):
    """It was traced on, along the same orbits half a period later, to where it began; all of it was stored twice."""
    path, said = compute(tmp_path, MERGING)
    assert "1 generalized period doubling" in said.stdout
    other, _ = compute(tmp_path, MERGING, *(f"--set=axes.{axis}.points=50" for axis in ("frequency_hz", "gap_m")), "--output=other.h5")
    with h5py.File(other.with_name("other.h5")) as file:
        assert file["special_frequency_hz"][file["special_kind"][()] == 5] == pytest.approx([8.4880293], abs=4e-6)
    with h5py.File(path) as file:
        data = {name: item[()] for name, item in file.items() if name.startswith(("curve_", "crossing_", "special_", "point_"))}
    at = np.flatnonzero(data["special_kind"] == 5)
    assert data["special_frequency_hz"][at] == pytest.approx([8.4880293], abs=4e-6)
    curve = data["special_curve"][at[0]]
    points = slice(data["curve_first"][curve], data["curve_first"][curve] + data["curve_points"][curve])
    assert data["curve_kind"][curve] == FOLD and 1 in (data["curve_begin"][curve], data["curve_end"][curve])
    places = np.column_stack([data["point_frequency_hz"][points], data["point_gap_m"][points]])
    assert len(np.unique(np.round(places, 9), axis=0)) == len(places)
    own = data["crossing_curve"] == curve
    assert own.sum() == 2 and len(np.unique(data["crossing_frequency_hz"][own])) == 2
    doublings = [line for line in np.flatnonzero((data["curve_kind"] == DOUBLING) & (data["curve_period"] == 1))]
    nearest = min(np.min(np.abs(data["point_gap_m"][(s := slice(data["curve_first"][one], data["curve_first"][one] + data["curve_points"][one]))]
                                - data["special_gap_m"][at[0]]) / 0.0315
                         + np.abs(data["point_frequency_hz"][s] - data["special_frequency_hz"][at[0]]) / 35) for one in doublings)
    assert nearest < 0.02


SEEDED = """schema = 1
kind = "curves"
[hammer]
mass_kg = 0.4
natural_frequency_hz = 8.0
damping_ratio = 0.11406990212868583
[cart]
amplitude_m = 0.002
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 109162.27529670879
damping_ns_per_m = 208.18356758739608
[axes.contact.stiffness_n_per_m]
from = 10916.22752967088
to = 3274868.2589012636
points = 30
scale = "log"
[operating_point]
frequency_ratio = 2.7824849801688627

[axes.gap_ratio]
from = -0.4766372016374162
to = 4.0
points = 30
[curves]
max_period = 4
"""


def test_a_curve_begins_at_a_motion_with_all_its_events(tmp_path):
    """From the period doubling of a branch with one release less than the motion had there, a curve once began: such a point at 1796 times the
    springs' stiffness, after the motion of which the hammer is 6e-4 A0 elsewhere four cycles later."""
    path, _ = compute(tmp_path, SEEDED)
    with h5py.File(path) as file:
        curve = np.repeat(np.arange(len(file["curve_first"])), file["curve_points"][()])
        doubled = (file["curve_kind"][()] == DOUBLING) & (file["curve_period"][()] == 4)
        gap, stiffness, displacement = (file[f"point_{name}"][()][doubled[curve]] for name in (
            "gap_ratio", "contact_stiffness_n_per_m", "orbit_displacement"))
    near = (np.abs(stiffness / (0.4 * (16 * np.pi)**2) - 1796.14) < 20) & (gap > 0.2)
    assert near.sum() > 3 and np.all(displacement[near] < -2.5) and np.all(np.abs(gap[near] - 0.29575) < 1e-4)


CROSSED = """schema = 1
kind = "curves"
[hammer]
mass_kg = 0.4
natural_frequency_hz = 8.0
damping_ratio = 0.05484167275935482
[cart]
amplitude_m = 0.002
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 314676.5705367602
damping_ns_per_m = 554.8485271146909
[axes.frequency_ratio]
from = 0.5
to = 4.5
points = 30

[axes.gap_ratio]
from = -0.3962648029194704
to = 4.0
points = 30
[curves]
max_period = 4
gap_ratio = [1.3106542022942018]
"""


def test_a_border_is_told_with_the_events_of_its_motion(tmp_path):
    """Between two points of a grazing curve with other events, its place at a gap was told with those of one of them: 2.31047, where the
    multiplier is -5.9. The one at 2.30860 is proved in interval arithmetic."""
    path, _ = compute(tmp_path, CROSSED + '[certificate]\ncells = "all"\n')
    with h5py.File(path) as file:
        grazes = (file["curve_kind"][()] == GRAZING)[file["crossing_curve"][()]]
        frequency, multiplier, proved = (file[f"crossing_{name}"][()][grazes] for name in ("frequency_ratio", "multiplier", "certified"))
    at = np.argmin(np.abs(frequency - 2.3085998933))
    assert abs(frequency[at] - 2.3085998933) < 1e-9 and proved[at] > 0
    assert np.all(np.abs(frequency - 2.310466) > 1e-4) and np.all(np.abs(multiplier) < 1)


STIFF = """schema = 1
kind = "curves"
[hammer]
mass_kg = 0.3
natural_frequency_hz = 4.5
damping_ratio = 0.009782692778740353
[cart]
amplitude_m = 1e-3
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 21645866.252973743
damping_ns_per_m = 1531.3440513059595
[axes.frequency_ratio]
from = 0.8
to = 3.0
points = 64
[axes.gap_ratio]
from = -1.0
to = 2.5
points = 64
[curves]
max_period = 3
gap_ratio = [-0.0038277687121559545]
"""


@pytest.mark.thorough
def test_no_contact_runs_backwards(tmp_path):
    """A fold went on with a weak contact whose release lay before its touch, to 1.08293778. A sweep has 3/2 up to 1.0829507."""
    path, _ = compute(tmp_path, STIFF)
    with h5py.File(path) as file:
        of = file["crossing_curve"][()]
        folds = (file["curve_kind"][()][of] == FOLD) & (file["curve_impacts"][()][of] == 3) & (file["curve_period"][()][of] == 2)
        frequency = file["crossing_frequency_ratio"][()][folds]
    near = frequency[np.abs(frequency - 1.083) < 1e-3]
    assert near.size == 1 and abs(near[0] - 1.0829506638) < 1e-9


RANDOM_RIG = """schema = 1
kind = "curves"
[hammer]
mass_kg = 0.4
natural_frequency_hz = 8.0
damping_ratio = {}
[cart]
amplitude_m = 0.002
[contact]
{}
[axes.frequency_ratio]
from = 0.5
to = 4.5
points = 30
[axes.gap_ratio]
from = {}
to = 4.0
points = 30
[curves]
max_period = 4
gap_ratio = [{}]
[certificate]
cells = "all"
"""
YIELDS = 'law = "kelvin_voigt"\nstiffness_n_per_m = {}\ndamping_ns_per_m = {}'
FAST = (0.05484167275935482, YIELDS.format(314676.5705367602, 554.8485271146909), -0.3962648029194704)


@pytest.mark.thorough
@pytest.mark.parametrize(("rig", "gap", "kind", "period", "places"), [
    # a curve that turns back just above the gap: Newton's method went to the second place twice
    ((0.010597957495323893, 'law = "restitution"\ncoefficient = 0.05694967719568127', 0.0), 2.76, GRAZING, 2,
     [2.088903703, 2.102301259, 2.105495818, 2.128560061, 2.133018532, 2.155636220]),
    # one that turns within a step
    ((0.022378300075827126, YIELDS.format(32314.371731443767, 12.037526380692242), -0.2691893615995848), 0.20042146817636952, DOUBLING, 2,
     [2.711896406, 2.929069867, 2.931665393]),
    # one that closes, and went on to beyond its first point
    ((0.08806410947240538, YIELDS.format(48743.61709329642, 45.8841967530292), -0.1757584857072546), 0.24181736286347089, FOLD, 1,
     [0.759557156, 0.769658098]),
    # one that turns where the stop's force falls to 0 within a contact, and came back on itself
    (FAST, 0.614876, FOLD, 2, [2.633136276, 2.633166913]),
    # one that closes with its orbits told from another cycle on, and went round again and again
    (FAST, 1.0, DOUBLING, 2, [2.612936561, 2.650389029]),
    # in the step that closes it
    (FAST, 1.262, DOUBLING, 2, [2.336309771, 2.381699158, 2.488514694]),
    # one that was traced twice, as its orbits change fast at its middle
    (FAST, -0.22, GRAZING, 2, [3.140272557]),
])
def test_each_border_is_told_once(tmp_path, rig, gap, kind, period, places):
    """At a gap, near to these; all proved in interval arithmetic but one, on an orbit of which errors grow too fast."""
    path, _ = compute(tmp_path, RANDOM_RIG.format(*rig, gap))
    with h5py.File(path) as file:
        curve, frequency, proved = (file[f"crossing_{name}"][()] for name in ("curve", "frequency_ratio", "certified"))
        own = (file["curve_kind"][()][curve] == kind) & (file["curve_period"][()][curve] == period)
    own &= (frequency > places[0] - 0.05) & (frequency < places[-1] + 0.05)
    assert np.sort(frequency[own]) == pytest.approx(places, abs=1e-8)
    assert np.all((proved[own] > 0) | (np.abs(frequency[own] - 2.105495818) < 1e-8))


RIGID = """schema = 1
kind = "curves"
[hammer]
mass_kg = 0.5
natural_frequency_hz = 10.0
damping_ratio = 0.03
[cart]
amplitude_m = 1e-3
[contact]
law = "restitution"
coefficient = 0.5
[axes.frequency_ratio]
from = 0.7
to = 3.1
points = 64
[axes.gap_ratio]
from = 0.3
to = 2.0
points = 64
[curves]
max_period = 4
gap_ratio = [0.3, 0.7, 1.0, 1.5, 2.0]
"""


GRAZES, LOST = 3, 4  # why branches end


def ends_as_stored(frequency, first, count):
    return np.concatenate([frequency[first], frequency[first + count - 1]])


@pytest.mark.thorough
@pytest.mark.parametrize(("job", "gaps"), [
    ((ROOT / "jobs" / "curves_170mm.toml").read_text().replace('rig = "rigs', f'rig = "{ROOT}/jobs/rigs'), [0, 1e-3 / 0.89e-3, 3e-3 / 0.89e-3]),
    (RIGID, [0.3, 0.7, 1.0, 1.5, 2.0])])
def test_unstable_branches_are_stored_once_at_the_gaps_of_the_job(tmp_path, job, gaps):
    """Those at gap 0 had gaps of 1e-24 and less, and five were stored twice, from both of their ends; so was one between two grazings at 3 mm. On the
    rigid stop one that can't be followed up to a grazing, where its multipliers have no bound, is the same that begins there."""
    path, _ = compute(tmp_path, job)
    with h5py.File(path) as file:
        gap, impacts, period, first, count, begin, end = (
            file[f"branch_{name}"][()] for name in ("gap_ratio", "impacts", "period", "first", "points", "begin", "end"))
        frequency = file["branch_frequency_ratio"][()]
    assert np.unique(gap) == pytest.approx(gaps, rel=1e-15, abs=0)
    ends = np.sort(np.column_stack([frequency[first], frequency[first + count - 1]]), axis=1)
    order = np.lexsort((ends[:, 1], ends[:, 0], period, impacts, gap))
    alike = np.all(np.diff(np.column_stack([gap, impacts, period])[order], axis=0) == 0, axis=1)
    alike &= np.all(np.abs(np.diff(ends[order], axis=0)) < 1e-6, axis=1)
    assert len(gap) > 50 and not alike.any()
    if job == RIGID:
        kinds, places = np.concatenate([begin, end]), ends_as_stored(frequency, first, count)
        for place in (0.70774403772, 0.83044169, 2.89841481, 2.97792796, 2.64866434, 2.72513552):
            assert GRAZES in kinds[np.abs(places - place) < 2e-7] and LOST not in kinds[np.abs(places - place) < 2e-7], place


def test_multipliers_are_unknown_at_the_ends_of_curves_alone(tmp_path):
    """Where an impact has no speed. A curve wandered there by rounding, 36 points within 1e-6 of the end."""
    path, _ = compute(tmp_path, RIGID)
    with h5py.File(path) as file:
        kind, first, count = (file[f"curve_{name}"][()] for name in ("kind", "first", "points"))
        multiplier = file["point_multiplier"][()]
    assert np.isnan(multiplier).any()
    for begin, length in zip(first[kind != GRAZING], count[kind != GRAZING]):
        assert not np.isnan(multiplier[begin + 1:begin + length - 1]).any()


IN_PARTS = """schema = 1
kind = "curves"
[hammer]
mass_kg = 0.4
natural_frequency_hz = 8.0
damping_ratio = 0.030917623710503894
[cart]
amplitude_m = 0.002
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 860062.9284534014
damping_ns_per_m = 698.917593231592
[axes.contact.stiffness_n_per_m]
from = 86006.29284534015
to = 25801887.853602044
points = 30
scale = "log"
[operating_point]
frequency_ratio = 2.902094755936528

[axes.gap_ratio]
from = -0.25472302995735474
to = 4.0
points = 30
[curves]
max_period = 4
gap_ratio = [0.2983909639371014]
[certificate]
cells = "all"
"""


def test_of_a_curve_that_is_found_in_parts_the_longer_is_kept(tmp_path):
    """A grazing of 2 cycles was found again from where it goes on beyond the end of the first: its border there, proved, must not go."""
    path, _ = compute(tmp_path, IN_PARTS)
    with h5py.File(path) as file:
        curve, stiffness, proved = (file[f"crossing_{name}"][()] for name in ("curve", "contact_stiffness_n_per_m", "certified"))
        own = (file["curve_kind"][()][curve] == GRAZING) & (file["curve_period"][()][curve] == 2) & (np.abs(stiffness / 3389749.59 - 1) < 1e-3)
    assert stiffness[own] == pytest.approx([3389749.5902638417], rel=1e-9) and np.all(proved[own] > 0)
