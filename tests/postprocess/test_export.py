"""export.py: what other programs read equals the file's contents, in N, Hz and mm."""

import csv

import h5py
import numpy as np
import pytest
from peterka.files.whole_file import written_whole
from picture_samples import ALL_CLASSES, write_basin, write_map
from scipy.io import loadmat
from sealing import SealedFile
from starts_samples import add_starts
from trace_samples import write_trace
from sweep_samples import FREQUENCY, GAPS, POINTS, WEIGHT, force_of, write_sweep

NEWTONS, HERTZ, MILLIMETRES = 0.298 * 9.80665, 4.5, 0.89
WORDS = {0: "no_impact", 1: "periodic", 2: "chaotic", 3: "sustained_contact", 4: "unresolved", 5: "failed", -128: "not_computed"}


@pytest.fixture
def sample(tmp_path):
    return write_map(tmp_path / "a.h5", ALL_CLASSES, fields={"impact_speed": np.full((4, 6), 0.25),
                                                              "last_impact": np.arange(24).reshape(4, 6)})


def read_vtk(path):
    """Parses a legacy file by its specification: {name: array}, coordinates X, Y, Z among them."""
    data, at, found = path.read_bytes(), 0, {}

    def line():
        nonlocal at
        end = data.index(b"\n", at)
        text, at = data[at:end].decode(), end + 1
        return text

    def numbers(count, kind):
        nonlocal at
        dtype = {"double": ">f8", "int": ">i4"}[kind]
        values = np.frombuffer(data, dtype, count, at)
        at += values.nbytes
        assert data[at:at + 1] == b"\n"
        at += 1
        return values

    assert line() == "# vtk DataFile Version 3.0" and line() == "Sample" and line() == "BINARY"
    assert line() == "DATASET RECTILINEAR_GRID"
    columns, rows, depth = map(int, line().removeprefix("DIMENSIONS ").split())
    assert depth == 1
    for letter, count in zip("XYZ", (columns, rows, 1)):
        name, size, kind = line().split()
        assert name == f"{letter}_COORDINATES" and int(size) == count
        found[letter] = numbers(count, kind)
    assert line() == f"POINT_DATA {rows * columns}"
    while at < len(data):
        word, name, kind, components = line().split()
        assert (word, components, line()) == ("SCALARS", "1", "LOOKUP_TABLE default")
        found[name] = numbers(rows * columns, kind).reshape(rows, columns)
    return found


def test_csv_has_a_line_for_each_cell(sample, tmp_path, run_program):
    assert run_program("export", sample) == (0, f"{sample}: incomplete: 95.8 % computed\na.csv\n", "")
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as text, h5py.File(sample) as file:
        lines = list(csv.DictReader(text))
        assert len(lines) == 24
        for number, line in enumerate(lines):
            row, column = divmod(number, 6)
            ratios = file["frequency_ratio"][column], file["gap_ratio"][row]
            assert (float(line["frequency_ratio"]), float(line["gap_ratio"])) == ratios
            assert float(line["frequency_hz"]) == pytest.approx(HERTZ * ratios[0])
            assert float(line["gap_mm"]) == pytest.approx(MILLIMETRES * ratios[1])
            assert line["regime"] == WORDS[int(file["regime"][row, column])]
            counts = [str(count) for count in ALL_CLASSES[row][column][1:]]
            assert [line["impacts"], line["period"]] == (["", ""] if line["regime"] == "not_computed" else counts)
            force = NEWTONS * file["peak_force_ratio"][row, column]
            assert (line["peak_force_n"] == "") == bool(np.isnan(force))
            assert np.isnan(force) or float(line["peak_force_n"]) == pytest.approx(force, rel=1e-15)
            assert float(line["impact_speed_m_s"]) == 0.25 and line["last_impact"] == (str(number) if line["regime"] != "not_computed" else "")


def test_bounds_of_a_speed_have_its_unit(tmp_path, run_program):
    write_map(tmp_path / "a.h5", ALL_CLASSES, fields={f"impact_speed{end}": np.full((4, 6), 0.25) for end in ("", "_lower", "_upper")})
    assert run_program("export", tmp_path / "a.h5")[0] == 0
    header = (tmp_path / "a.csv").read_text().splitlines()[0].split(",")
    assert {f"impact_speed{end}_m_s" for end in ("", "_lower", "_upper")} <= set(header)


def test_vtk_and_matlab_hold_the_same(sample, tmp_path, run_program):
    told = f"{sample}: incomplete: 95.8 % computed\nx/a.vtk\nx/a.mat\n"
    assert run_program("export", sample, "--as", "vtk,mat", "--output-dir", "x") == (0, told, "")
    grid, matlab = read_vtk(tmp_path / "x" / "a.vtk"), loadmat(tmp_path / "x" / "a.mat")
    with h5py.File(sample) as file:
        expected = {"regime": file["regime"][:], "impacts": file["impacts"][:], "period": file["period"][:],
                    "peak_force_n": NEWTONS * file["peak_force_ratio"][:], "impact_speed_m_s": np.full((4, 6), 0.25),
                    "last_impact": np.arange(24).reshape(4, 6)}
        np.testing.assert_allclose(grid["X"], HERTZ * file["frequency_ratio"][:])
        np.testing.assert_allclose(grid["Y"], MILLIMETRES * file["gap_ratio"][:])
        np.testing.assert_allclose(matlab["frequency_hz"].ravel(), HERTZ * file["frequency_ratio"][:])
        np.testing.assert_allclose(matlab["gap_mm"].ravel(), MILLIMETRES * file["gap_ratio"][:])
    assert set(grid) == {"X", "Y", "Z", *expected}
    for name, values in expected.items():
        np.testing.assert_allclose(grid[name], values, rtol=1e-15)
        np.testing.assert_allclose(matlab[name], values, rtol=1e-15)
    assert matlab["title"] == ["Sample"]


def test_a_basin_has_its_own_axes(tmp_path, run_program):
    attractor = dict(regime=1, impacts=1, period=1, cells=16, peak_force_ratio=9.0, orbit_displacement=0.0, orbit_velocity=0.0)
    path = write_basin(tmp_path / "b.h5", attractors=[attractor], attractor=np.zeros((4, 4)), natural_frequency_hz=4.5,
                       cart_amplitude_m=0.89e-3)
    assert run_program("export", path)[0] == 0
    with open(tmp_path / "b.csv", newline="", encoding="utf-8") as text:
        first = next(csv.DictReader(text))
    assert float(first["displacement_mm"]) == pytest.approx(-3 * MILLIMETRES) and first["attractor"] == "0"
    assert float(first["velocity_m_s"]) == pytest.approx(-6 * 2 * np.pi * 4.5 * 0.89e-3)
    assert "peak_force_ratio" in first  # of a hammer of unknown mass


@pytest.mark.parametrize("stored, unit, column, ratio, told", [
    ("start_displacement_ratio", 1, "start_displacement_mm", "start_displacement_ratio", MILLIMETRES),
    ("start_velocity_m_per_s", 2 * np.pi * 4.5 * 0.89e-3, "start_velocity_m_s", "start_velocity_ratio", 2 * np.pi * 4.5 * 0.89e-3)])
def test_starts_as_an_axis_are_told_in_both_units(tmp_path, run_program, stored, unit, column, ratio, told):
    axis = stored.removeprefix("start_")
    path = write_map(tmp_path / "a.h5", job=f"[axes]\nfrequency_ratio.from = 1\nstart.{axis}.from = 0\n")
    with SealedFile(path, "r+") as file:
        file.move("gap_ratio", stored)
        file[stored][:] *= unit
    assert run_program("export", path)[0] == 0
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as text:
        last = list(csv.DictReader(text))[-1]
    assert float(last[ratio]) == pytest.approx(3) and float(last[column]) == pytest.approx(3 * told)


def test_what_the_file_doesnt_tell_stays_a_ratio(tmp_path, run_program):
    path = write_map(tmp_path / "a.h5", natural_frequency_hz="unknown", hammer_mass_kg=-1.0)
    assert run_program("export", path)[0] == 0
    heads = (tmp_path / "a.csv").read_text().splitlines()[0].split(",")
    assert heads[:4] == ["frequency_ratio", "gap_mm", "gap_ratio", "regime"] and "peak_force_ratio" in heads


@pytest.mark.parametrize("attributes, names, factors", [
    ({}, ["orbit_displacement_mm", "orbit_velocity_m_s"], [MILLIMETRES, 2 * np.pi * HERTZ * MILLIMETRES / 1000]),
    ({"natural_frequency_hz": "unknown"}, ["orbit_displacement_mm", "orbit_velocity_ratio"], [MILLIMETRES, 1]),
    ({"cart_amplitude_m": "unknown"}, ["orbit_displacement_ratio", "orbit_velocity_ratio"], [1, 1])])
def test_states_of_orbits_have_their_units_in_their_names(tmp_path, run_program, attributes, names, factors):
    fields = {"orbit_displacement": np.full((4, 6), -2.0), "orbit_velocity": np.full((4, 6), 3.0)}
    assert run_program("export", write_map(tmp_path / "a.h5", ALL_CLASSES, fields=fields, **attributes))[0] == 0
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as text:
        first = next(csv.DictReader(text))
    assert [float(first[name]) for name in names] == pytest.approx([-2 * factors[0], 3 * factors[1]])
    assert not {"orbit_displacement", "orbit_velocity"} & set(first)


def test_coordinates_that_the_file_has_in_si_units_are_these(tmp_path, run_program):
    """22 * (15/22) is 14.999999999999998."""
    path = write_map(tmp_path / "a.h5", ALL_CLASSES, natural_frequency_hz=22.0)
    with SealedFile(path, "r+") as file:
        file.attrs["job"] = "[axes]\nfrequency_hz = { from = 15 }\ngap_m = { from = 1e-4 }\n"
        file["frequency_hz"], file["gap_m"] = np.arange(15.0, 21), np.arange(1.0, 5) / 1e4
    assert run_program("export", path)[::2] == (0, "")
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as text:
        lines = list(csv.DictReader(text))
    assert [float(line["frequency_hz"]) for line in lines[:6]] == list(range(15, 21))
    assert [float(line["gap_mm"]) for line in lines[::6]] == [1e3 * each for each in np.arange(1.0, 5) / 1e4]
    assert float(lines[0]["frequency_ratio"]) == 15 / 22


def test_what_is_no_number_of_each_cell_is_told(tmp_path, run_program, draw):
    cells = np.broadcast_to((1, 1, 1), (3, 4, 3))
    path = add_starts(write_map(tmp_path / "a.h5", cells), [cells], np.ones((1, 3, 4)), np.ones((1, 3, 4)), np.zeros((3, 4)))
    code, out, err = run_program("export", path)
    assert (code, err) == (0, "") and out.startswith("a.csv\n") and out.count("\n") == 2
    assert "not one number of each cell, and so left out: attractor" in out and "basin_share" in out and "start_attractor" not in out
    assert "and so left out: attractor" in draw(path, "--export", "csv", "--only", "map", "--formats", "png").stdout


def columns_of(path):
    """{name: numbers} of a CSV."""
    with open(path, newline="", encoding="utf-8") as text:
        lines = list(csv.reader(text))
    return dict(zip(lines[0], np.array([[float(cell) if cell else np.nan for cell in line] for line in lines[1:]]).T))


def test_a_trace_is_exported_as_its_tables_in_units(tmp_path, run_program, draw):
    path = write_trace(tmp_path / "t.h5")
    code, out, err = run_program("export", path)
    assert (code, err) == (0, "") and out.split() == ["t.csv", "t_impacts.csv", "t_impact.csv", "t_spectrum.csv", "t_impact_spectrum.csv"]
    with h5py.File(path) as file:
        expected = {"": ("time", "time_s", 1), "_impacts": ("impacts/peak_force_ratio", "peak_force_n", NEWTONS),
                    "_impact": ("impact/hammer_displacement_ratio", "hammer_displacement_mm", MILLIMETRES),
                    "_spectrum": ("spectrum/force_amplitude", "force_amplitude_n", 1),
                    "_impact_spectrum": ("impact_spectrum/force_spectrum", "force_spectrum_n_s", 1)}
        for part, (stored, column, factor) in expected.items():
            numbers = columns_of(tmp_path / f"t{part}.csv")
            assert np.allclose(numbers[column], file[stored][()] * factor, rtol=1e-14, atol=0, equal_nan=True)
            assert all(len(each) == len(numbers[column]) for each in numbers.values())
        motion = columns_of(tmp_path / "t.csv")
        assert np.array_equal(motion["force_n"], file["force_ratio"][()] * NEWTONS) and motion["force_n"].max() > 0
        assert list(motion)[:3] == ["time_s", "cycle", "hammer_displacement_mm"] and "relative_velocity_m_s" in motion
    assert run_program("export", path, "--as", "mat")[0] == 2
    assert "t.csv" in draw(path, "--export", "csv", "--only", "motion", "--formats", "png").pictures


def test_a_trace_without_a_rig_is_exported_in_its_ratios(tmp_path, run_program):
    path = write_trace(tmp_path / "t.h5")
    with SealedFile(path, "r+") as file:
        for name in ("hammer_mass_kg", "cart_amplitude_m"):
            del file.attrs[name]
    assert run_program("export", path)[0] == 0
    assert {"force_ratio", "cart_displacement_ratio", "cart_velocity_m_s"} < set(columns_of(tmp_path / "t.csv"))


def test_what_cannot_be_exported_gets_words(tmp_path, sample, run_program):
    code, _, err = run_program("export", write_sweep(tmp_path / "s.h5"), sample, "--as", "csv,vtk")
    assert code == 2 and "is a sweep, whose points are exported as csv alone; vtk takes the cells" in err and err.count("\n") == 1
    assert (tmp_path / "a.csv").exists()  # the other formats are written
    assert run_program("export", sample, "--as", "xls")[0] == 2
    (tmp_path / "file").write_text("")
    assert run_program("export", sample, "--output-dir", "file")[0] == 3


def test_draw_exports_the_same(sample, tmp_path, run_program, draw):
    outcome = draw(sample, "--export", "csv,mat", "--formats", "png")
    assert (outcome.code, outcome.stderr) == (0, "") and {"a.csv", "a.mat", "a_map.png"} <= set(outcome.pictures)
    assert run_program("export", sample)[0] == 0
    assert (tmp_path / "out" / "a.csv").read_bytes() == (tmp_path / "a.csv").read_bytes()
    assert draw(sample, "--export", "xls").code == 2


def test_names_that_the_layout_does_not_have_stay_out(tmp_path, run_program):
    """Neither a formula as a column, nor a separate line in VTK, nor a duplicate of a computed field."""
    strange = ["=cmd|' /C calc'!A1", "a\nSCALARS b", "peak_force_n", "frequency_hz", "title", "\u202elong", "Upper"]
    fields = {name: np.full((4, 6), 17.0) for name in strange}
    path = write_map(tmp_path / "a.h5", ALL_CLASSES, fields=fields | {"other": np.ones((4, 6))})
    assert run_program("export", path, "--as", "csv,vtk,mat")[0] == 0
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as text:
        heads = next(csv.reader(text))
    assert len(set(heads)) == len(heads) and not set(heads) & (set(strange) - {"peak_force_n", "frequency_hz"}) and "other" in heads
    found, arrays = read_vtk(tmp_path / "a.vtk"), loadmat(tmp_path / "a.mat")
    assert "other" in found and not (found["peak_force_n"] == 17).any()
    assert not (arrays["peak_force_n"] == 17).any() and not (arrays["frequency_hz"] == 17).any() and arrays["title"] == ["Sample"]


def test_an_export_follows_no_link_and_shares_no_name(sample, tmp_path, run_program):
    victim = tmp_path / "victim"
    victim.write_text("mine")
    for name in (".a.csv.unfinished", "a.csv"):
        (tmp_path / name).symlink_to(victim)
    assert run_program("export", sample)[0] == 0
    assert victim.read_text() == "mine"
    assert not (tmp_path / "a.csv").is_symlink()
    assert sorted(path.name for path in tmp_path.iterdir()) == [".a.csv.unfinished", "a.csv", "a.h5", "victim"]


def test_two_at_once_write_two_files(tmp_path):
    with written_whole(tmp_path / "a") as first, written_whole(tmp_path / "a") as second:
        first.write("first")
        second.write("second")
        assert len(list(tmp_path.iterdir())) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["a"] and (tmp_path / "a").read_text() == "first"


@pytest.mark.parametrize("in_si", [False, True])
def test_a_sweep_is_a_table_of_its_points(tmp_path, run_program, in_si):
    """Read by names, and compared with what the file was written from; without the rig in ratios."""
    rig = {} if in_si else dict.fromkeys(("natural_frequency_hz", "cart_amplitude_m", "hammer_mass_kg"), np.nan)
    code, out, err = run_program("export", write_sweep(tmp_path / "s.h5", **rig))
    assert (code, err) == (0, "") and "not one number of each point, and so left out: impact_displacement" in out
    with open(tmp_path / "s.csv", newline="", encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    assert len(lines) == 4 * POINTS
    branches = [(gap, direction) for gap in GAPS for direction in (0, 1)]
    for number, line in enumerate(lines):
        gap, direction = branches[number // POINTS]
        at, force = number % POINTS, force_of(gap, direction)[number % POINTS]
        assert (int(line["branch"]), line["direction"]) == (number // POINTS, ("up", "down")[direction])
        assert (float(line["gap_ratio"]), float(line["frequency_ratio"])) == (gap, FREQUENCY[at])
        assert line["regime"] == ("chaotic" if gap and force == 25 else "periodic" if force > 0 else "no_impact")
        if in_si:
            assert float(line["frequency_hz"]) == pytest.approx(4.5 * FREQUENCY[at]) and float(line["gap_mm"]) == pytest.approx(0.89 * gap)
            assert float(line["peak_force_n"]) == pytest.approx(WEIGHT * force)
        else:
            assert float(line["peak_force_ratio"]) == force and not {"frequency_hz", "gap_mm", "peak_force_n"} & set(line)


def test_codes_are_words_in_a_table_and_numbers_in_other_formats(tmp_path, run_program):
    """Those that the file itself explains; counts stay numbers, but of cells that aren't computed, and no code is an empty cell."""
    path = write_map(tmp_path / "a.h5", ALL_CLASSES)
    numbers = np.arange(24).reshape(4, 6) % 2
    with SealedFile(path, "r+") as file:
        for name, meanings in (("status", "verified rounding"), ("edge_kind_gap_m", "fold grazing"), ("engine", "exact cvode")):
            file[name] = np.where(np.arange(24).reshape(4, 6) == 23, -128, numbers).astype("i1")
            file[name].attrs["flag_values"], file[name].attrs["flag_meanings"] = np.array([0, 1], dtype="i1"), meanings
        file["cycles"] = np.full((4, 6), 75, dtype="i4")
        file["computed"] = np.where(np.arange(24).reshape(4, 6) == 2, 0, 1).astype("i1")
        file["computed"].attrs["flag_values"], file["computed"].attrs["flag_meanings"] = np.array([0, 1], dtype="i1"), "filled computed"
    assert run_program("export", path, "--as", "csv,vtk")[0] == 0
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as text:
        lines = list(csv.DictReader(text))
    assert [(line["status"], line["edge_kind_gap_m"], line["engine"]) for line in lines[:2]] == [
        ("verified", "fold", "exact"), ("rounding", "grazing", "cvode")]
    assert lines[23]["status"] == ""
    assert (lines[2]["computed"], lines[2]["status"], lines[2]["engine"]) == ("filled", "", "")  # nothing was followed there
    assert (lines[4]["computed"], lines[4]["status"], lines[4]["engine"]) == ("computed", "verified", "exact")
    assert {(line["regime"] == "not_computed", line["cycles"]) for line in lines} == {(False, "75"), (True, "")}
    status = read_vtk(tmp_path / "a.vtk")["status"].ravel()[:23]
    assert (np.delete(status, 2) == np.delete(numbers.ravel()[:23], 2)).all() and status[2] == -1


def test_no_last_impact_is_an_empty_cell(tmp_path, run_program):
    path = write_map(tmp_path / "a.h5", ALL_CLASSES, fields={"last_impact": np.where(np.arange(24) % 2, -1, 7).reshape(4, 6)})
    assert run_program("export", path, "--as", "csv,mat")[0] == 0
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as text:
        lines = list(csv.DictReader(text))
    assert [line["last_impact"] for line in lines[:4]] == ["7", "", "7", ""]
    assert loadmat(tmp_path / "a.mat")["last_impact"][0, :4].tolist() == [7, -1, 7, -1]


def test_no_export_replaces_another_of_the_same_call(tmp_path, run_program):
    """A trace's table of impacts, and the motion of a trace that is named so."""
    one, other = write_trace(tmp_path / "a.h5"), write_trace(tmp_path / "a_impacts.h5")
    code, out, err = run_program("export", one, other, "--output-dir", tmp_path / "x")
    assert code == 2 and "a_impacts.csv is written already, of another of these files" in err and err.count("\n") == 1
    assert out.split().count(str(tmp_path / "x" / "a_impacts.csv")) == 1
    assert "touch_time_s" in (tmp_path / "x" / "a_impacts.csv").read_text().splitlines()[0]
    assert run_program("export", other, "--output-dir", tmp_path / "x", "--as", "csv,csv")[0] == 0
    assert "touch_time_s" not in (tmp_path / "x" / "a_impacts.csv").read_text().splitlines()[0]
