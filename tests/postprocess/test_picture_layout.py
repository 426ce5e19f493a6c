"""No text leaves the canvas or overlaps anything: every kind of picture, with long titles, wide axis numbers, tiny and huge values."""

import h5py
import numpy as np
import pytest
from peterka.plotting.figures import figure_of
from peterka.maps import comparison, comparison_map
from peterka.maps.map_file import PeterkaFile
from peterka.pictures import open_file, pictures_of
from peterka.plotting.frames import text_width
from peterka.plotting.titles import SIZE, wrapped
from peterka.scaling import efficiency
from peterka.scaling.dealing import Machine
from peterka.scaling.run_record import read_record
from peterka.measurements.points import Measurements, Point
from picture_samples import (
    ALL_CLASSES, CHAOTIC, FAILED, MISSING, NO_IMPACT, PLAIN, SUSTAINED, UNRESOLVED, orbit, write_audit, write_basin, write_map,
)
from picture_texts import drawn_texts, faults_of_layout
from sealing import SealedFile
from study_samples import write_labels, write_stability, write_work_precision
from sweep_samples import FREQUENCY, write_sweep
from trace_samples import write_trace

pytestmark = pytest.mark.thorough

# Not every title with every size: each fault appears in one of these.
CASES = [("short", "usual"), ("long", "tiny"), ("one word", "huge")]
TITLES = {"short": "Sample", "long": "A title with many words that says all there is to say of a rig and more " * 2,
          "one word": "M" * 150}
SIZES = {"usual": 1.0, "tiny": 1e-9, "huge": 1e9}
BLOCKS = np.repeat(np.repeat(np.array(ALL_CLASSES), 8, axis=0), 8, axis=1)  # large enough for names


def sound(figure, monkeypatch):
    assert figure is not None
    faults = faults_of_layout(figure, monkeypatch)
    assert not faults, "\n".join(faults)


def all_sound(path, monkeypatch, **options):
    with open_file(path) as file:
        pictures = pictures_of(file, **options)
        assert pictures
        for name, draw in pictures.items():
            drawn = draw(file)
            if drawn is None:  # nothing to show
                continue
            faults = faults_of_layout(figure_of(drawn), monkeypatch)
            assert not faults, f"{name}:\n" + "\n".join(faults)


def test_a_text_outside_or_over_another_is_found(monkeypatch):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(2, 2))
    figure.text(0.5, 0.5, "first")
    assert faults_of_layout(figure, monkeypatch) == []
    figure.text(0.95, 0.1, "outside")
    figure.text(0.52, 0.5, "second")
    assert [fault.split(" by ")[0] for fault in faults_of_layout(figure, monkeypatch)] == [
        "'outside' leaves the canvas", "'first' and 'second' overlap"]
    assert len(drawn_texts(figure, monkeypatch)) == 3


def plane_fields(shape, size):
    values = size * (1 + np.arange(np.prod(shape), dtype=float).reshape(shape))
    return {name: values for name in ("impact_speed", "impulse", "contact_time", "contact_power_w", "max_displacement")} | {
        "chatter": np.indices(shape).sum(axis=0) % 7 == 0, "computed": np.indices(shape).sum(axis=0) % 3 == 0,
        "last_impact": np.arange(np.prod(shape)).reshape(shape) * 7}


def forces_of(cells, size):
    regime = cells[..., 0]
    values = size * (1 + np.arange(regime.size, dtype=float).reshape(regime.shape))
    return np.where((regime == 5) | (regime == -128), np.nan, np.where(regime == 0, 0, values))


@pytest.mark.parametrize("title, size", CASES)
@pytest.mark.parametrize("spacing", ["linear", "log"])
def test_maps(tmp_path, monkeypatch, title, size, spacing):
    factor = SIZES[size]
    rows, columns = BLOCKS.shape[:2]
    frequency, gap = factor * np.linspace(0.5, 4.5, columns), factor * np.linspace(-12.5, 5, rows)
    if spacing == "log":
        frequency, gap = np.geomspace(1e-3, 4.5 * factor, columns), np.geomspace(1e-12, 1e3 * factor, rows)
        frequency, gap = np.sort(frequency), np.sort(gap)
    path = write_map(tmp_path / "a.h5", BLOCKS, frequency, gap, forces_of(BLOCKS, factor), plane_fields((rows, columns), factor),
                     title=TITLES[title], damping_ratio=0.004)
    write_audit(path, [(0, 0), (9, 9)], [(1, 1, 1), (2, 0, 0)], [3e-12 * factor, np.nan], [1, 0])
    all_sound(path, monkeypatch)


@pytest.mark.parametrize("title, size", CASES)
def test_basins(tmp_path, monkeypatch, title, size):
    factor = SIZES[size]
    cells = np.array([[NO_IMPACT, orbit(1, 1), orbit(12, 17), CHAOTIC], [SUSTAINED, UNRESOLVED, FAILED, MISSING]])
    cells = np.repeat(np.repeat(cells, 10, axis=0), 10, axis=1)
    table = [dict(regime=regime, impacts=p, period=q, peak_force_ratio=1.23456e2 * factor, cells=100 - n,
                  orbit_displacement=50.0 * (n - 1), orbit_velocity=-1.0)
             for n, (regime, p, q) in enumerate([NO_IMPACT, orbit(1, 1), orbit(12, 17), CHAOTIC])]
    attractor = np.where(cells[..., 0] <= 2, np.arange(40)[None, :] // 10, -1)
    path = write_basin(tmp_path / "a.h5", cells, table, attractor, plane_fields(cells.shape[:2], factor),
                       title=TITLES[title], gap_ratio=1.6 * factor, frequency_ratio=1.8, cart_amplitude_m=0.89e-3,
                       natural_frequency_hz=4.5, hammer_mass_kg=0.298)
    all_sound(path, monkeypatch)


def scaled_sweep(path, factor, gaps, **attributes):
    """x/A0 down to -12.5 and forces of this size; between two gaps whose numbers are long."""
    write_sweep(path, gaps, **attributes)
    with SealedFile(path, "r+") as file:
        file["peak_force_ratio"][...] *= factor
        for name, scale in (("stroboscopic_displacement", 12.5 / 6), ("impact_displacement", 1.0)):
            file[name][...] *= scale * factor
    return path


@pytest.mark.parametrize("title, size", CASES)
@pytest.mark.parametrize("gaps", [(0.0,), (0.0, 1.5), (0.0, 1.123456e-7, 123456.7)])
def test_sweeps(tmp_path, monkeypatch, title, size, gaps):
    path = scaled_sweep(tmp_path / "a.h5", SIZES[size], gaps, title=TITLES[title])
    all_sound(path, monkeypatch)


def test_a_sweep_with_measured_points_and_many_jumps(tmp_path, monkeypatch):
    path = scaled_sweep(tmp_path / "a.h5", 1.0, (0.0, 1.5), title="Sample")
    with SealedFile(path, "r+") as file:
        file["jump"][2, [2, 3, 4, 5, 6, 12]] = 1
    points = [Point(FREQUENCY[3], 25.0, -4.0, 0.0, "measured at 9 Hz"), Point(FREQUENCY[-1], 30.0, -2.0, 1.5, "the last one"),
              Point(FREQUENCY[0], 10.0, -3.0, 1.5, "the first one"), Point(1.1, None, None, None, "an edge")]
    all_sound(path, monkeypatch, measured=Measurements(points, []))


@pytest.mark.parametrize("count", [8, 40, 160])
def test_many_points_with_labels_over_maps(tmp_path, monkeypatch, count):
    """No text overlaps another or a mark; text without space is omitted."""
    cells = np.repeat(np.repeat(np.array(PLAIN), 12, axis=0), 12, axis=1)
    path = write_map(tmp_path / "a.h5", cells)
    random = np.random.default_rng(count)
    points = [Point(*random.uniform((1, 10), (4, 60)), None, random.uniform(0, 3), f"point {n}", "mine") for n in range(count)]
    with open_file(path) as file:
        for name in ("map", "force_all"):
            figure = figure_of(pictures_of(file, measured=Measurements(points, []))[name](file))
            sound(figure, monkeypatch)
            (ax,) = [ax for ax in figure.axes if ax.texts]
            places = ax.transData.transform([(point.frequency, point.gap) for point in points])
            texts = [text for text in drawn_texts(figure, monkeypatch) if text[0] in [own.get_text() for own in ax.texts]]
            assert [text for text, box in texts if any(box.contains(*place) for place in places)] == []
            words = [text for text, _ in texts]
            assert sum(word.startswith("point") for word in words) >= min(count, 20)
            assert sum(not word.startswith("point") for word in words) >= 1


@pytest.mark.parametrize("title, size", CASES)
@pytest.mark.parametrize("impacts", [True, False])
def test_traces(tmp_path, monkeypatch, title, size, impacts):
    path = write_trace(tmp_path / "a.h5", impacts=impacts, title=TITLES[title], gap_ratio=0.25)
    factor = SIZES[size]
    with SealedFile(path, "r+") as file:
        groups = [file, file["spectrum"]] + ([file["impact"], file["impacts"], file["impact_spectrum"]] if impacts else [])
        for group in groups:
            for name, data in group.items():
                if isinstance(data, h5py.Dataset) and not any(
                        word in name for word in ("time", "cycle", "frequency")) and name != "impact":
                    data[...] *= factor
    all_sound(path, monkeypatch)


@pytest.mark.parametrize("title", TITLES)
@pytest.mark.parametrize("write", [write_work_precision, write_labels, write_stability])
def test_studies(tmp_path, monkeypatch, title, write):
    all_sound(write(tmp_path / "a.h5", title=TITLES[title]), monkeypatch)


@pytest.mark.parametrize("title, size", CASES)
def test_comparisons(tmp_path, monkeypatch, title, size):
    factor = SIZES[size]
    rows, columns = BLOCKS.shape[:2]
    axes = factor * np.linspace(0.5, 4.5, columns), factor * np.linspace(-12.5, 5, rows)
    forces = forces_of(BLOCKS, factor)
    first = write_map(tmp_path / "a.h5", BLOCKS, *axes, forces, title=TITLES[title])
    spread = forces * np.linspace(0.2, 3, columns)[None, :]
    second = write_map(tmp_path / "b.h5", np.roll(BLOCKS, 3, axis=0), *axes, spread, title=TITLES[title] + "!")
    with PeterkaFile(first) as a, PeterkaFile(second) as b:
        sound(comparison_map.draw(a, b, comparison.compare(a, b)), monkeypatch)


@pytest.mark.parametrize("title", TITLES)
def test_scalings(tmp_path, monkeypatch, title):
    path = write_map(tmp_path / "a.h5", np.zeros((64, 64, 3), int).tolist(), title=TITLES[title])
    with SealedFile(path, "r+") as file:
        file["run/tile_seconds"] = np.full(16, 1e-3)
        file["run/ranks"], file["run/solve_seconds"] = np.int32(1), 1.0
    record, machine = read_record(path), Machine(3e-6, 2e-6, 5e-4)
    curves = [efficiency.curve(record, cells, efficiency.ranks_up_to(1000), machine) for cells in (4096, 10**5)]
    measured, _ = efficiency.measured_efficiency([record])
    sound(efficiency.draw(record, curves, measured, machine), monkeypatch)


def test_a_key_in_a_title_breaks_between_its_words():
    """A line ends inside a key only behind a dot or an underscore, and nothing is lost."""
    text = "uncertainty.operating_point.gap_m.standard_deviation: 5e-05 in A, nothing in B; contact.damping_ns_per_m: 1200.5 in B"
    for width in (1.3, 1.7, 2.4, 5.0):
        lines = wrapped(text, width)
        assert all(text_width(line, SIZE) <= width for line in lines)
        told = lines[0]
        for line in lines[1:]:
            told += line if told[-1] in "._" else " " + line
        assert told == text, lines
