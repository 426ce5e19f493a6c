"""Traces: identical at any number of ranks, readable by xarray, and consistent with the map whose cell they follow."""

import importlib
import re
import shutil
import signal
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray

import jobs
import launch
import map_contents

pytestmark = pytest.mark.thorough

TESTS = Path(__file__).parents[1]
DATA = TESTS / "data"
sys.path[:0] = [str(TESTS / "postprocess"), str(TESTS.parent / "postprocess")]
sealing = importlib.import_module("sealing")


def compute(folder, text, *arguments, ranks=None):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", *arguments, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished.stdout


def refused(folder, text, code=2):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == code, finished.stderr
    assert not (folder / "job.h5").exists()
    return " ".join(launch.messages(finished))


@pytest.fixture(scope="module")
def trace(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("trace"), jobs.trace(2.0))


def test_a_trace_is_the_same_at_three_ranks(tmp_path, trace):
    path, _ = compute(tmp_path, jobs.trace(2.0), "--quiet", ranks=3)
    map_contents.assert_same_map(path, trace[0])


def test_a_trace_opens_in_xarray(trace):
    data = xarray.open_dataset(trace[0])
    assert data.attrs["peterka_kind"] == "trace"
    assert data.sizes == {"time": 4 * 200 + 1}
    assert data.hammer_acceleration.dims == ("time",) and data.hammer_acceleration.attrs["units"] == "m/s^2"
    assert data.time.values[-1] == pytest.approx(4 / 9.0)  # cycles at 9 Hz
    np.testing.assert_allclose(data.hammer_displacement_ratio - data.cart_displacement_ratio,
                               data.relative_displacement_ratio, atol=1e-12)
    impacts = xarray.open_dataset(trace[0], group="impacts")
    assert impacts.sizes == {"impact": 4}
    close = xarray.open_dataset(trace[0], group="impact")
    assert close.force_ratio.dims == ("time",)
    for group, line in (("spectrum", "force_amplitude"), ("impact_spectrum", "force_spectrum")):
        assert xarray.open_dataset(trace[0], group=group)[line].dims == ("frequency",)


@pytest.mark.parametrize("milliseconds", [0.5, 8, 100])
def test_the_hardest_impact_is_seen_for_as_long_as_asked(tmp_path, milliseconds):
    """Also for less than 35 ms, the unit of the program's own time."""
    path, _ = compute(tmp_path, jobs.trace(2.0, settings=f"impact_window_s = {1e-3 * milliseconds}"))
    times = xarray.open_dataset(path, group="impact").time_from_touch.values
    assert times[-1] - times[0] == pytest.approx(1e-3 * milliseconds, rel=1e-9)


def test_the_impacts_of_a_trace_hold_together(trace):
    impacts = xarray.open_dataset(trace[0], group="impacts")
    close = xarray.open_dataset(trace[0], group="impact")
    cell = xarray.open_dataset(trace[0], group="cell")
    # the model with the paper's parameters gives 235 N at 9 Hz, gap 0
    assert float(cell.peak_force_ratio) * 0.298 * 9.80665 == pytest.approx(235, abs=0.5)
    np.testing.assert_allclose(impacts.peak_force_ratio, float(cell.peak_force_ratio), rtol=1e-9)
    assert float(close.peak_force_ratio) == pytest.approx(float(cell.peak_force_ratio), rel=1e-9)
    np.testing.assert_allclose(impacts.touch_force_ratio, 1.2e3 * impacts.impact_speed / (0.298 * 9.80665), rtol=1e-12)
    jump = int(np.flatnonzero(np.abs(close.time_from_touch) < 1e-12)[0])
    assert close.force_ratio[jump - 1] == 0
    assert close.force_ratio[jump] == pytest.approx(float(impacts.touch_force_ratio[int(close.impact)]), rel=1e-9)
    force, times = close.force_ratio.values[jump:], close.time_from_touch.values[jump:]
    area = np.sum((force[1:] + force[:-1]) / 2 * np.diff(times)) * 0.298 * 9.80665
    assert area == pytest.approx(float(impacts.impulse[int(close.impact)]), rel=1e-4)


# The last: the hammer sticks at its first impact.
@pytest.mark.parametrize("restitution, frequency, gap", [(0.3, 0.9, -0.3), (0.5, 0.7, -0.1), (0.0, 0.978, -0.5)])
def test_a_chatter_on_a_rigid_stop_is_one_impact_with_the_rest_that_ends_it(tmp_path, restitution, frequency, gap):
    """As in the map: its bounces' impulses and that of the rest together, pressed for as long as it rests."""
    job = jobs.RIG.format(kind="map", title="chatter") + jobs.axis("frequency_ratio", frequency, frequency, 1) + jobs.axis("gap_ratio", gap, gap, 1)
    job = jobs.with_rigid_stop(job).replace("coefficient = 0.5", f"coefficient = {restitution}")
    (tmp_path / "map.toml").write_text(job + '[output]\nfields = ["impact_speed", "impulse", "contact_time", "contact_power_w"]\n[start]\ndisplacement_ratio = -1.0\n')
    assert launch.run("run", "map.toml", "--quiet", cwd=tmp_path).returncode == 0
    path, said = compute(tmp_path, jobs.trace_of("map.h5", "row = 0\ncolumn = 0\ncycles = 12"))
    with h5py.File(tmp_path / "map.h5") as file:
        cell = {name: file[name][0, 0] for name in ("regime", "impacts", "period", "chatter", "impact_speed", "impulse", "contact_time", "contact_power_w")}
    assert cell["regime"] == 1 and cell["contact_time"] > 0 and cell["chatter"] == (restitution > 0)
    impacts = xarray.open_dataset(path, group="impacts")
    assert impacts.sizes["impact"] == 12 // cell["period"] * cell["impacts"]
    assert f"{impacts.sizes['impact']} in the time shown" in said
    whole = impacts.isel(impact=slice(0, -1))  # the last one may outlast the trace
    for name, stored in (("impact_speed", cell["impact_speed"]), ("impulse", cell["impulse"]), ("contact_time", cell["contact_time"])):
        assert float(whole[name].max()) == pytest.approx(stored, rel=1e-9), name
    assert np.isnan(whole.peak_force_ratio).all() and np.isnan(whole.touch_force_ratio).all()
    period = cell["impacts"]
    taken = float(whole.work[:period].sum()) * 4.5 * frequency / cell["period"]
    assert taken == pytest.approx(cell["contact_power_w"], rel=1e-8)


def test_a_complete_trace_is_left_alone(tmp_path, trace):
    shutil.copy(trace[0], tmp_path / "job.h5")
    _, said = compute(tmp_path, jobs.trace(2.0))
    assert said == "job.h5 is complete: nothing is computed\n"


@pytest.mark.parametrize("regime, agrees", [(0, "no_impact"), (1, "periodic")])
def test_a_trace_tells_why_a_cell_has_its_colour(tmp_path, small_map_file, regime, agrees):
    with h5py.File(small_map_file) as file:
        row, column = np.argwhere((file["regime"][()] == regime) & (file["gap_ratio"][()][:, None] > 0.5))[0]
        stored = {name: file[name][row, column] for name in ("regime", "impacts", "period", "peak_force_ratio")}
        place = file["frequency_ratio"][column], file["gap_ratio"][row]
    path, said = compute(tmp_path, jobs.trace_of(small_map_file, f"row = {row}\ncolumn = {column}"))
    told = re.search(rf"row {row} \(gap/A0 (\S+) \((\S+) mm\)\), column {column} \(Omega/omega (\S+) \((\S+) Hz\)\)", said)
    numbers = [place[1], 0.89 * place[1], place[0], 4.5 * place[0]]
    assert told and [float(text) for text in told.groups()] == pytest.approx(numbers, rel=1e-5), said
    assert "agrees in regime and z" in said and agrees in said
    with h5py.File(path) as file:
        assert (file.attrs["frequency_ratio"], file.attrs["gap_ratio"]) == place
        assert (file["map_cell/row"][()], file["map_cell/column"][()]) == (row, column)
        for name, value in stored.items():
            assert file[f"map_cell/{name}"][()] == value
            assert file[f"cell/{name}"][()] == pytest.approx(value, rel=1e-9)


def test_a_place_is_computed_where_it_was_asked_for_and_the_distance_to_the_nearest_cell_is_told(tmp_path, small_map_file):
    with h5py.File(small_map_file) as file:
        frequency, gap = file["frequency_ratio"][()], file["gap_ratio"][()]
    place = frequency[7] + 0.02, gap[3] - 0.02
    near = f"[operating_point]\nfrequency_ratio = {place[0]}\ngap_ratio = {place[1]}"
    path, said = compute(tmp_path, jobs.trace_of(small_map_file, near))
    assert "row 3 " in said and "column 7 " in said
    away = f"{0.02 * 4.5:.3g} Hz, {0.02 * 0.89:.3g} mm from "
    assert f"the nearest cell, {away}the place of this trace" in said
    assert f"the place asked for, {away}row 3, column 7 of" in launch.run("check", "job.toml", cwd=tmp_path).stdout
    with h5py.File(path) as file:
        assert (file.attrs["frequency_ratio"], file.attrs["gap_ratio"]) == place
        found = {name: file[f"cell/{name}"][()] for name in ("regime", "impacts", "period", "peak_force_ratio")}
    path, _ = compute(tmp_path, jobs.trace(*place), "--fresh")
    with h5py.File(path) as file:
        assert (file.attrs["frequency_ratio"], file.attrs["gap_ratio"]) == place
        for name, value in found.items():
            assert file[f"cell/{name}"][()] == pytest.approx(value, rel=1e-6, nan_ok=True)
    exact = f"[operating_point]\nfrequency_ratio = {frequency[7]}\ngap_ratio = {gap[3]}"
    path, said = compute(tmp_path, jobs.trace_of(small_map_file, exact), "--fresh")
    assert "the place of this trace" not in said and "agrees in" in said
    with h5py.File(path) as file:
        assert (file.attrs["frequency_ratio"], file.attrs["gap_ratio"]) == (frequency[7], gap[3])


def test_the_force_of_the_nearest_cell_is_that_of_its_own_mass(tmp_path):
    job = jobs.RIG.format(kind="map", title="masses") + jobs.axis("frequency_ratio", 1.6, 2.0, 3)
    (tmp_path / "map.toml").write_text(job + jobs.axis("hammer.mass_kg", 0.2, 0.4, 3) + "[operating_point]\ngap_ratio = 1.0\n")
    done = launch.run("run", "map.toml", "--quiet", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    _, said = compute(tmp_path, jobs.trace_of("map.h5", "[operating_point]\nfrequency_ratio = 1.8\n[hammer]\nmass_kg = 0.33\n"))
    with h5py.File(tmp_path / "map.h5") as file:
        stored = file["peak_force_ratio"][1, 1]
    newton, weights = map(float, re.search(r"  stores .*, ([\d.]+) N, ([\d.]+) weights", said).groups())
    assert "the nearest cell" in said and weights == pytest.approx(stored, rel=1e-5)
    assert newton == pytest.approx(stored * 0.3 * 9.80665, rel=1e-5)


def test_a_contact_that_the_end_cuts_has_no_peak(tmp_path):
    """A hammer that the gap presses onto its stop is in contact at phase 0."""
    text = jobs.trace(1.12037, -1.43105)
    settings = ("--set", "trace.cycles=1", "--set", "contact.stiffness_n_per_m=457", "--set", "contact.damping_ns_per_m=22.2", "--set",
                "hammer.damping_ns_per_m=1.355")
    path, said = compute(tmp_path, text, *settings)
    with h5py.File(path) as file:
        assert np.isnan(file["impacts/peak_force_ratio"][()]).tolist() == [True] and "impact/peak_force_ratio" not in file
    assert "1 in the time shown" in said and "the end of the trace cuts its contact" in said
    path, said = compute(tmp_path, text, *settings, "--set", "trace.cycles=2", "--fresh")
    with h5py.File(path) as file:
        assert np.isnan(file["impacts/peak_force_ratio"][()]).tolist() == [False, True] and "impact/peak_force_ratio" in file
    assert "2 in the time shown" in said and "cuts its contact" not in said


@pytest.mark.parametrize("corner", [(0, 0), (-1, -1)])
def test_a_place_at_a_corner_of_the_map_is_its_cell(tmp_path, small_map_file, corner):
    with h5py.File(small_map_file) as file:
        rows, columns = file["regime"].shape
        place = file["frequency_ratio"][corner[1]], file["gap_ratio"][corner[0]]
    near = f"[operating_point]\nfrequency_ratio = {place[0]}\ngap_ratio = {place[1]}"
    path, said = compute(tmp_path, jobs.trace_of(small_map_file, near))
    assert "the place of this trace" not in said
    with h5py.File(path) as file:
        assert (file["map_cell/row"][()], file["map_cell/column"][()]) == (corner[0] % rows, corner[1] % columns)


def test_a_cell_of_a_basin_keeps_its_own_start(tmp_path, small_basin_file):
    with h5py.File(small_basin_file) as file:
        start = file["displacement_ratio"][5], file["velocity_ratio"][11]
        peak = file["peak_force_ratio"][11, 5]
    path, said = compute(tmp_path, jobs.trace_of(small_basin_file, 'row = 11\ncolumn = 5\nfrom = "start"'))
    assert "Basin " in said and "agrees in regime and z" in said
    data = xarray.open_dataset(path)
    assert float(data.hammer_displacement_ratio[0]) == pytest.approx(start[0], abs=1e-12)
    assert float(data.hammer_velocity[0]) == pytest.approx(start[1] * 0.89e-3 * 2 * np.pi * 4.5, rel=1e-12)
    with h5py.File(path) as file:
        assert file["cell/peak_force_ratio"][()] == pytest.approx(peak, rel=1e-9)


def test_the_release_test_strikes_after_a_quarter_of_its_period(tmp_path):
    settings = 'from = "start"\nduration_s = 0.5\n[start]\ndisplacement_ratio = -5.618'
    path, said = compute(tmp_path, jobs.trace(0.0, settings=settings))
    assert "the cart at rest" in said
    impacts = xarray.open_dataset(path, group="impacts")
    assert float(impacts.touch_time[0]) == pytest.approx(0.25 / 4.5, rel=5e-3)
    assert float(impacts.impact_speed[0]) == pytest.approx(5e-3 * 2 * np.pi * 4.5, rel=1e-2)
    with h5py.File(path) as file:
        assert "cell" not in file
        assert not file["cart_displacement_ratio"][()].any()


def test_a_cart_at_rest_is_one_of_frequency_0_in_hz_too(tmp_path):
    settings = 'from = "start"\nduration_s = 0.1\n[start]\ndisplacement_ratio = -5.618'
    job = jobs.trace(0.0, settings=settings)
    assert "frequency_ratio = 0.0" in job
    path, _ = compute(tmp_path, job)
    with h5py.File(path) as file:
        force = file["impacts/peak_force_ratio"][()]
    path, said = compute(tmp_path, job.replace("frequency_ratio = 0.0", "frequency_hz = 0.0"), "--fresh")
    assert "the cart at rest" in said
    with h5py.File(path) as file:
        assert force.max() > 10 and (file["impacts/peak_force_ratio"][()] == force).all()


def damaged(source, path):
    shutil.copy(source, path)
    with h5py.File(path, "r+") as file:
        file["peak_force_ratio"][0, 0] = 17.0
    return path


def unfinished(source, path):
    shutil.copy(source, path)
    with h5py.File(path, "r+") as file:
        file["tiles/done"][0] = 0
        file["summary/finished"][()] = 0
    return path


def without_a_dataset(source, path):
    shutil.copy(source, path)
    with h5py.File(path, "r+") as file:
        del file["impacts"]
    return path


def of_another_rig(source, path):
    """One bit in the job's text: 0.298 kg becomes 0.398 kg."""
    content = source.read_bytes()
    assert content.count(b"mass_kg = 0.298") >= 1
    path.write_bytes(content.replace(b"mass_kg = 0.298", b"mass_kg = 0.398"))
    return path


def of_another_rig_whose_bytes_are_summed_anew(source, path):
    sealing.renew_record(of_another_rig(source, path))
    return path


def of_another_rig_and_layout_2(_, path):
    return of_another_rig(DATA / "layout_2.h5", path)


def no_hdf5(_, path):
    path.write_text("not HDF5")
    return path


def missing(_, path):
    return path


@pytest.mark.parametrize("make, message", [
    (missing, "does not exist"), (no_hdf5, "is not an HDF5 file"), (damaged, "is damaged (wrong checksum)"),
    (unfinished, "has not computed yet"), (without_a_dataset, "(wrong checksum)"),
    (of_another_rig, "its bytes are not what was written (wrong checksum)"),
    (of_another_rig_whose_bytes_are_summed_anew, "something outside its cells is not what was written (wrong checksum)"),
    (of_another_rig_and_layout_2, "something outside its cells is not what was written (wrong checksum)"),
])
def test_a_bad_map_file_is_refused(tmp_path, small_map_file, make, message):
    path = make(small_map_file, tmp_path / "map.h5")
    said = refused(tmp_path, jobs.trace_of(path, "row = 0\ncolumn = 0"))
    assert message in said and "map.h5" in said


@pytest.mark.parametrize("make", [of_another_rig, of_another_rig_whose_bytes_are_summed_anew, of_another_rig_and_layout_2])
def test_a_basin_takes_no_rig_from_a_damaged_map(tmp_path, small_map_file, make):
    path = make(small_map_file, tmp_path / "map.h5")
    starts = jobs.axis("displacement_ratio", -3.0, 0.5, 3) + jobs.axis("velocity_ratio", -4.0, 4.0, 3)
    said = refused(tmp_path, f'schema = 1\nkind = "basin"\n[basin]\nmap = "{path}"\nrow = 0\ncolumn = 0\n{starts}')
    assert "(wrong checksum)" in said and "basin.map" in said


@pytest.mark.parametrize("settings, message", [
    ("row = 35\ncolumn = 0", "trace.row = 35 is out of range; the map has 35"),
    ("row = 0\ncolumn = 40", "trace.column = 40 is out of range"),
    ("", "no cell of the map is named"),
    ("[operating_point]\nfrequency_ratio = 9\ngap_ratio = 1", "lies outside of the map"),
    ("row = 0\ncolumn = 0\n[operating_point]\nfrequency_ratio = 2\ngap_ratio = 1", "names one, too"),
    ("row = 0\ncolumn = 0\n[start]\nvelocity_ratio = 1", "start.velocity_ratio is that of the map's own job"),
])
def test_a_cell_that_is_not_there_is_refused(tmp_path, small_map_file, settings, message):
    assert message in refused(tmp_path, jobs.trace_of(small_map_file, settings))


def test_a_trace_is_no_map(tmp_path, trace):
    said = refused(tmp_path, jobs.trace_of(trace[0], "row = 0\ncolumn = 0"))
    assert 'is of kind "trace", which has no plane of cells' in said


def test_check_tells_the_cell_and_writes_nothing(tmp_path, small_map_file):
    jobs.write(tmp_path, jobs.trace_of(small_map_file, "row = 3\ncolumn = 7"))
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 0, checked.stderr
    assert "row 3, column 7" in checked.stdout and "[hammer]" in checked.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["job.toml"]


LONG_TRACE = jobs.trace(2.0, settings="cycles = 10_000\n[solver]\nengine = \"cvode\"").replace(
    "samples_per_cycle = 200", "samples_per_cycle = 10")  # minutes


@pytest.mark.parametrize("ranks", [None, 3])
def test_a_trace_whose_time_is_over_keeps_the_file_that_was_there(tmp_path, trace, ranks):
    jobs.write(tmp_path, jobs.trace(2.0, settings="cycles = 5"))
    shutil.copy(trace[0], tmp_path / "job.h5")
    finished = launch.run("run", "job.toml", "--fresh", "--max-wall", "1e-9", cwd=tmp_path, ranks=ranks)
    assert finished.returncode == 5, finished.stderr
    assert "stopped early (--max-wall" in " ".join(launch.messages(finished))
    map_contents.assert_same_map(tmp_path / "job.h5", trace[0])


@pytest.mark.parametrize("ranks", [None, 3])
def test_usr1_ends_a_trace_on_all_ranks(tmp_path, ranks):
    jobs.write(tmp_path, LONG_TRACE)
    process = launch.start("run", "job.toml", cwd=tmp_path, ranks=ranks)
    assert process.stderr.readline() == "10000 forcing cycles to follow\n"
    process.send_signal(signal.SIGUSR1)
    _, errors = process.communicate(timeout=launch.HANGING)
    assert process.returncode == 5, errors
    assert errors.count("stopped early (signal SIGUSR1)") == 1
    assert not (tmp_path / "job.h5").exists()


def test_steps_in_which_events_are_noise_end_a_trace(tmp_path):
    """Of a hammer of 1e-16 kg, whose overdamped contact creeps; searched to the last halving, one cycle would take minutes."""
    jobs.write(tmp_path, jobs.trace(0.5))
    finished = launch.run("run", "job.toml", "--set", "hammer.mass_kg=1e-16", "--set", "hammer.cubic_stiffness_n_per_m3=238.23", cwd=tmp_path)
    assert finished.returncode == 4 and "can't be followed beyond 0 cycles: the integrator gives up" in finished.stderr, finished.stderr
