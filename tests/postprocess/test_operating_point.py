"""operating_point.py on synthetic maps: the worst case over box and starts against plain loops, and refusals."""

import math
import re
import sys

import h5py
import matplotlib.pyplot as plt
import matplotlib.text
import numpy as np
import pytest
from matplotlib.patches import Rectangle
from peterka.cli import operating_point
from peterka.files import job_numbers
from peterka.maps.map_file import PeterkaFile
from peterka.operating import picture, told, verify
from peterka.operating.admitted import Quantity, admitted, read_code
from peterka.operating.drift import reach, worst_of_boxes
from peterka.operating.places import Place, best_places
from peterka.plotting.notes import write_beside, write_near_box
from peterka.plotting.seen import SEEN
from picture_samples import CHAOTIC, NO_IMPACT, SUSTAINED, orbit, write_basin, write_map
from picture_texts import has_scales
from sealing import SealedFile, seal_file
from starts_samples import EMPTY, add_starts
from sweep_samples import write_sweep

pytestmark = pytest.mark.thorough

WEIGHT = 0.298 * 9.80665
ONE, TWICE = orbit(1, 1), orbit(2, 2)
JOB = """
schema = 1
kind = "map"
hammer = { mass_kg = 0.298, natural_frequency_hz = 4.5, damping_ns_per_m = 0.06 }
cart = { amplitude_m = 0.89e-3 }
contact = { law = "kelvin_voigt", stiffness_n_per_m = 5.5e6, damping_ns_per_m = 1.2e3 }
axes = { frequency_ratio = { from = 1.5, to = 2.5, points = 6 }, gap_ratio = { from = 0.2, to = 1.0, points = 5 } }
"""
STARTS = "starts = { count = 20, displacement_ratio = [-4.0, 1.0], velocity_ratio = [-4.0, 4.0] }\n"
ZETA = 0.06 / (4 * np.pi * 0.298 * 4.5)


def random_map(path, rows=9, columns=11, seed=1, log=False):
    """Cells of 1/1, 2/2, no impact or chaos in patches, each with one attractor or two and forces that vary."""
    chance = np.random.default_rng(seed)
    kinds = np.array([ONE, ONE, ONE, TWICE, NO_IMPACT, CHAOTIC])
    patches = chance.integers(0, 6, (3, 4)) * (chance.random((3, 4)) < 0.5)
    first = kinds[np.kron(patches, np.ones((3, 3), dtype=int))[:rows, :columns]]
    second = kinds[chance.integers(0, 6, (rows, columns))]
    share = np.where(chance.random((rows, columns)) < 0.9, 1.0, np.round(chance.uniform(0.5, 1, (rows, columns)), 2))
    second[share == 1] = EMPTY
    forces = chance.uniform(1, 9, (2, rows, columns))
    start = np.where((chance.random((rows, columns)) < 0.95) | (share == 1), 0, 1)
    cells = np.where(start[..., None] == 0, first, second)
    own = np.where(start == 0, *forces)
    frequency = np.geomspace(1, 4, columns) if log else np.linspace(1, 4, columns)
    write_map(path, cells, frequency_ratio=frequency, gap_ratio=np.linspace(0, 3, rows), forces=own, job=JOB + STARTS)
    return add_starts(path, [first, second], [share, 1 - share], forces, start), (first, second, share, forces, cells, own)


def plain(file, made, starts, hz, mm):
    """The same by loops over cells, boxes, and attractors."""
    first, second, share, forces, cells, own_forces = made
    gaps, frequencies = file.rows.values * 0.89, file.columns.values * 4.5
    result = np.full(file.shape, np.nan)
    for i, j in np.ndindex(file.shape):
        if (min(gaps[i] - mm - gaps[0], gaps[-1] - gaps[i] - mm) < -1e-9
                or min(frequencies[j] - hz - frequencies[0], frequencies[-1] - frequencies[j] - hz) < -1e-9):
            continue
        # if the drift does not end on a cell, the nearest cell beyond it belongs to the box
        rows = range(np.flatnonzero(gaps <= gaps[i] - mm + 1e-9)[-1], np.flatnonzero(gaps >= gaps[i] + mm - 1e-9)[0] + 1)
        columns = range(np.flatnonzero(frequencies <= frequencies[j] - hz + 1e-9)[-1],
                        np.flatnonzero(frequencies >= frequencies[j] + hz - 1e-9)[0] + 1)
        labels, values = set(), []
        for r in rows:
            for c in columns:
                here = [(tuple(label[r, c]), s, f) for label, s, f in
                        ((first, share[r, c], forces[0, r, c]), (second, 1 - share[r, c], forces[1, r, c])) if s > 1e-12]
                if starts == "job":
                    chosen = [(tuple(cells[r, c]), 1, own_forces[r, c])]
                elif starts == "any":
                    chosen = here
                else:
                    most = [label for label in {one[0] for one in here}
                            if sum(one[1] for one in here if one[0] == label) >= starts - 1e-9]
                    chosen = [one for one in here if most and one[0] == most[0]] or [(CHAOTIC, 1, 0)]
                labels |= {one[0] for one in chosen}
                values += [one[2] for one in chosen]
        if starts == "any" and swings_free(frequencies[j] / 4.5, hz / 4.5, (gaps[i] + mm) / 0.89):
            continue
        if len(labels) == 1 and next(iter(labels)) in (ONE, TWICE):
            result[i, j] = min(values)
    return result


def swings_free(ratio, width, gap):
    """Anywhere between both frequencies, by dense sampling."""
    eta = np.linspace(ratio - width, ratio + width, 2001)
    return np.min(eta**2 / np.abs(1 - eta**2 + 2j * ZETA * eta)) < gap


@pytest.mark.parametrize("starts", ["any", 0.8, "job"])
@pytest.mark.parametrize("hz, mm", [(0.0, 0.0), (1.35, 0.4), (1.0, 0.1)])
@pytest.mark.parametrize("log", [False, True])
def test_the_worst_is_that_of_plain_loops(tmp_path, starts, hz, mm, log):
    path, made = random_map(tmp_path / "a.h5", log=log)
    with PeterkaFile(path) as file:
        found = admitted(file, starts, "peak_force")
        reaches = [reach(file, axis, hz, mm) for axis in (file.rows, file.columns)]
        worst = worst_of_boxes(found, *reaches)
        if starts == "any":
            worst = np.where(told.may_stay_free(file, *reaches), np.nan, worst)
        expected = plain(file, made, starts, hz, mm)
        if starts != "any" or hz < 1.3:  # few places remain, given all known motions
            assert np.isfinite(expected).sum() > (0 if hz > 1.3 else 2 if starts == "any" else 5)
        np.testing.assert_allclose(worst, expected)


def test_only_cells_of_the_regime_asked_for_have_a_worst_value(tmp_path):
    random_map(tmp_path / "a.h5")
    with PeterkaFile(tmp_path / "a.h5") as file:
        reaches = [reach(file, axis, 0, 0) for axis in (file.rows, file.columns)]
        found = admitted(file, 0.6, "peak_force")
        everywhere = worst_of_boxes(found, *reaches)
        codes = np.unique(found.code[np.isfinite(everywhere)])
        assert len(codes) > 1
        for code in codes:
            np.testing.assert_array_equal(worst_of_boxes(found, *reaches, [code]), np.where(found.code == code, everywhere, np.nan))


def test_the_own_start_on_another_motion_spoils_any_but_no_share(tmp_path):
    cells = [[ONE] * 5] * 4
    own = [list(row) for row in cells]
    own[1][2] = TWICE
    path = write_map(tmp_path / "a.h5", own, forces=np.full((4, 5), 7.0))
    add_starts(path, [cells], np.ones((1, 4, 5)), np.full((1, 4, 5), 7.0), np.where(np.all(np.array(own) == ONE, axis=-1), 0, -1))
    with PeterkaFile(path) as file:
        reaches = [reach(file, axis, 0, 0) for axis in (file.rows, file.columns)]
        assert np.isnan(worst_of_boxes(admitted(file, "any", "peak_force"), *reaches)[1, 2])
        assert np.isfinite(worst_of_boxes(admitted(file, 1.0, "peak_force"), *reaches)).all()


def one_label(path, frequency_ratio, gap_ratio, known=None):
    """A map of 1/1 only, from each of 20 starts; `known` (row, column, label): further known motions."""
    shape = len(gap_ratio), len(frequency_ratio)
    cells = np.broadcast_to(ONE, (*shape, 3))
    second = np.broadcast_to(EMPTY, (*shape, 3)).copy()
    if known:
        second[known[:2]] = known[2]
    write_map(path, cells, frequency_ratio=frequency_ratio, gap_ratio=gap_ratio, forces=np.full(shape, 7.0), job=JOB + STARTS)
    return add_starts(path, [cells, second], [np.ones(shape), np.zeros(shape)], np.full((2, *shape), 7.0), np.zeros(shape))


@pytest.mark.parametrize("label, forbids", [(NO_IMPACT, True), (TWICE, True), (CHAOTIC, True), (ONE, False)])
def test_what_is_known_without_a_start_forbids_any_but_no_share(tmp_path, label, forbids):
    path = one_label(tmp_path / "a.h5", np.linspace(1.5, 2.5, 6), np.linspace(0, 1, 5), known=(2, 3, label))
    with PeterkaFile(path) as file:
        reaches = [reach(file, axis, 0.5, 0) for axis in (file.rows, file.columns)]
        with_any, with_share = (np.isfinite(worst_of_boxes(admitted(file, starts, "peak_force"), *reaches)) for starts in ("any", 0.8))
    assert with_any[2, 2:5].tolist() == [not forbids] * 3 and with_any[[1, 3], 1:5].all()
    assert with_share[:, 1:5].all()


def test_a_motion_without_impact_counts_between_the_cells(tmp_path, run_program):
    """Its amplitude at Omega/omega 2.5 is 1.19: no cell at a gap of 1.1 has it, a box extending to 1.2 does."""
    path = one_label(tmp_path / "a.h5", np.linspace(2.4, 2.6, 5), np.linspace(0.7, 1.5, 5))
    with PeterkaFile(path) as file:
        for mm, free in ((0.05 * 0.89, [0, 0, 0, 1, 1]), (0.11 * 0.89, [0, 0, 1, 1, 1])):
            reaches = [reach(file, axis, 0.01, mm) for axis in (file.rows, file.columns)]
            assert told.may_stay_free(file, *reaches)[:, 2].tolist() == [bool(one) for one in free]
    code, out, err = run_program("operating_point", path, "--hz", 0.01, "--mm", 0.05, "--formats", "png")
    assert (code, err) == (0, "")
    assert "by proof: nowhere within the drift, nor between the cells there, can the hammer swing without impact" in out
    assert re.search(r"by sampling: all 20 starts .* less than 14 % of the starts isn't excluded \(59 exclude more than 5 %, 299", out)


def test_with_a_cubic_spring_no_motion_without_impact_is_excluded_by_proof(tmp_path, run_program, monkeypatch):
    """A softening one swings less far above its resonance than a linear one, whose closed form it is."""
    monkeypatch.setattr(sys.modules[__name__], "JOB", JOB.replace("natural_frequency_hz", "cubic_stiffness_n_per_m3 = -1e6, natural_frequency_hz"))
    path = one_label(tmp_path / "a.h5", np.linspace(2.4, 2.6, 5), np.linspace(0.7, 1.5, 5))
    out = run_program("operating_point", path, "--hz", 0.01, "--mm", 0.05, "--formats", "png")[1]
    assert "by proof" not in out and "not proved: nowhere within the drift" in out and "if its springs were linear (closed form)" in out
    out = run_program("operating_point", path, "--hz", 0.01, "--mm", 0.2, "--starts", "share", "0.8", "--formats", "png")[1]
    assert "a motion without impact (between cells of the box, in closed form of linear springs, which these are not quite)" in out
    monkeypatch.undo()
    out = run_program("operating_point", one_label(tmp_path / "b.h5", np.linspace(2.4, 2.6, 5), np.linspace(0.7, 1.5, 5)), "--hz", 0.01, "--mm", 0.2,
                      "--starts", "share", "0.8", "--formats", "png")[1]
    assert "a motion without impact (between cells of the box, in closed form)" in out


@pytest.mark.parametrize("name, coordinates", [
    ("hammer.stiffness_n_per_m", {"hammer_stiffness_n_per_m": 0.298 * (2 * np.pi * 4.5) ** 2}),
    ("hammer.mass_kg", {"hammer_mass_kg": 0.298}), ("frequency_hz", {"frequency_hz": 9.0}), ("gap_m", {"gap_m": 0.89e-3}),
    ("cart.amplitude_m", {"cart_amplitude_m": 0.89e-3}), ("hammer.damping_ratio", {"hammer_damping_ratio": ZETA})])
def test_a_free_swing_is_the_same_by_any_numbers(name, coordinates):
    """2 x the natural frequency and a gap of A0, given by the job or by an axis."""
    tables = job_numbers.tables_of(JOB + "operating_point = { frequency_ratio = 2.0, gap_ratio = 1.0 }\n")
    swing = job_numbers.swing_of(tables, coordinates)
    assert (swing.frequency_ratio, swing.damping_ratio, swing.gap_ratio) == pytest.approx((2, ZETA, 1)), name


def test_a_share_that_the_starts_cannot_tell_is_refused(tmp_path, run_program):
    path = one_label(tmp_path / "a.h5", np.linspace(1.5, 2.5, 6), np.linspace(0, 1, 5))
    for share, needed in (("0.9", 29), ("0.99", 299), ("0.95", 59)):
        code, _, err = run_program("operating_point", path, "--hz", 0, "--mm", 0, "--starts", "share", share)
        assert code == 2 and "others may have 14 %" in err and f"{needed} could tell it: --set starts.count={needed}" in err, err
    code, _, err = run_program("operating_point", path, "--hz", 0, "--mm", 0, "--starts", "share", 1)
    assert code == 2 and "can't tell a share of 1" in err
    assert run_program("operating_point", path, "--hz", 0, "--mm", 0, "--starts", "share", 0.86, "--formats", "png")[0] == 0


def test_an_answer_for_a_share_names_what_it_leaves_out(tmp_path, run_program):
    path = one_label(tmp_path / "a.h5", np.linspace(1.5, 2.5, 6), np.linspace(0, 1, 5), known=(2, 3, orbit(1, 2)))
    code, out, err = run_program("operating_point", path, "--hz", 0.95, "--mm", 0.4, "--starts", "share", 0.8, "--formats", "png")
    assert (code, err) == (0, "")
    assert "left out: 1/2 (in 1 cells of the box, found by no start)" in out
    assert "of all starts at least 86.09 % end in it" in out  # 0.05^(1/20)


def test_an_answer_for_a_share_says_where_nothing_is_left_out(tmp_path, run_program):
    path = one_label(tmp_path / "a.h5", np.linspace(1.5, 1.7, 6), np.linspace(0, 1, 5))
    code, out, err = run_program("operating_point", path, "--hz", 0, "--mm", 0, "--starts", "share", 0.8, "--formats", "png")
    assert (code, err) == (0, "") and "\n  nothing is left out: no other motion is known in the best box\n" in out


@pytest.mark.parametrize("ended, of", [(20, 20), (19, 20), (290, 299)])
def test_the_least_share_is_that_of_the_binomial_distribution(ended, of):
    share = told.least_share(ended / of, of)
    at_least = sum(math.comb(of, n) * share**n * (1 - share) ** (of - n) for n in range(ended, of + 1))
    assert at_least == pytest.approx(0.05)


def test_a_quantity_without_numbers_of_attractors_is_known_where_there_is_one(tmp_path):
    cells = [[ONE] * 4] * 3
    second = [[EMPTY] * 4, [ONE] * 4, [EMPTY] * 4]
    share = np.ones((3, 4))
    share[1] = 0.5
    path = write_map(tmp_path / "a.h5", cells, fields={"contact_power_w": np.full((3, 4), 0.2)})
    add_starts(path, [cells, second], [share, 1 - share], np.ones((2, 3, 4)), np.zeros((3, 4)))
    with PeterkaFile(path) as file:
        value = admitted(file, "any", "contact_power").value
    assert np.isfinite(value).tolist() == [[True] * 4, [False] * 4, [True] * 4]


def test_best_places_are_separate_and_in_order(tmp_path):
    path, _ = random_map(tmp_path / "a.h5", seed=4)
    with PeterkaFile(path) as file:
        reaches = [reach(file, axis, 1.35, 0.4) for axis in (file.rows, file.columns)]
        found = admitted(file, "job", "peak_force")
        worst = worst_of_boxes(found, *reaches)
        places = best_places(worst, found, *reaches)
    assert places[0].worst == np.nanmax(worst)
    assert all(a.worst >= b.worst for a, b in zip(places, places[1:]))
    for n, a in enumerate(places):
        for b in places[:n]:
            assert (abs(a.row - b.row) > 2 * reaches[0].after[a.row]
                    or abs(a.column - b.column) > 2 * reaches[1].after[a.column])
    assert {read_code(found.code[place.row, place.column]) for place in places} <= {(1, 1), (2, 2)}


def test_the_command_prints_and_draws(tmp_path, run_program):
    path, _ = random_map(tmp_path / "a.h5", seed=4)
    code, out, err = run_program("operating_point", path, "--hz", 0.5, "--mm", 0.1, "--starts", "share", 0.8, "--formats", "png")
    assert (code, err) == (0, "")
    assert "peak force from 80 % of the starts, drift ±0.5 Hz, ±0.1 mm" in out and "smallest share" in out
    best = next(line for line in out.splitlines() if line.startswith("best: frequency_ratio"))
    assert " Hz), gap_ratio " in best and " mm), z = " in best and best.endswith(" N in all cells of its box")
    assert (tmp_path / "pictures" / "a_operating_point.png").stat().st_size > 5000


@pytest.mark.parametrize("hz, mm, told_of_boxes, log", [
    (0.5, 0.05, "the map's cells are 0.9 Hz and 0.178 mm apart: boxes are ±0.9 Hz and ±0.178 mm", False),
    (0.9, 0.2, "the map's cells are 0.9 Hz and 0.178 mm apart: boxes are ±0.9 Hz and ±0.356 mm", False),
    (0.9, 0.178, None, False), (0, 0.356, None, False), (0, 0, None, False),
    (0.5, 0, "the map's cells are 0.726 to 1.09 Hz apart: boxes are ±0.804 to 1.09 Hz", True),
])
def test_a_box_is_told_and_drawn_as_large_as_it_is_counted(tmp_path, run_program, monkeypatch, hz, mm, told_of_boxes, log):
    """0.9 Hz and 0.178 mm from cell to cell."""
    frequencies = np.geomspace(1.5, 2.5, 6) if log else np.linspace(1.5, 2.5, 6)
    path = write_map(tmp_path / "a.h5", [[ONE] * 6] * 5, frequency_ratio=frequencies, gap_ratio=np.linspace(0.2, 1.0, 5), job=JOB)
    drawn = []
    monkeypatch.setattr(operating_point, "save_all", lambda figure, *_: drawn.append(figure))
    code, out, err = run_program("operating_point", path, "--hz", hz, "--mm", mm)
    assert (code, err) == (0, "") and ("boxes are" in out) == (told_of_boxes is not None)
    assert told_of_boxes is None or f"\n  {told_of_boxes}\n" in out
    title = " ".join(drawn[0]._suptitle.get_text().split())
    assert told_of_boxes is None or title.endswith(told_of_boxes.partition(": ")[2])
    box = next(patch for patch in drawn[0].axes[0].patches if isinstance(patch, Rectangle) and patch.get_zorder() == 5)
    with PeterkaFile(path) as file:
        for axis, first, size in ((file.columns, box.get_x(), box.get_width()), (file.rows, box.get_y(), box.get_height())):
            assert np.isclose(axis.values, first).any() and np.isclose(axis.values, first + size).any()


@pytest.mark.parametrize("units, heads, best, below, above", [
    ("both", "frequency [Hz]  gap [mm]", "frequency_ratio 2.2 (9.9 Hz), gap_ratio 0.6 (0.534 mm)", True, True),
    ("si", "frequency [Hz]  gap [mm]", "frequency 9.9 Hz, gap 0.534 mm", False, True),
    ("ratio", "frequency_ratio  gap_ratio", "frequency_ratio 2.2, gap_ratio 0.6", True, False)])
def test_units_are_those_asked_for(tmp_path, run_program, monkeypatch, units, heads, best, below, above):
    forces = np.ones((5, 6))
    forces[2, 3] = 10
    path = write_map(tmp_path / "a.h5", [[ONE] * 6] * 5, frequency_ratio=np.linspace(1.6, 2.6, 6), gap_ratio=np.linspace(0.2, 1.0, 5),
                     forces=forces, job=JOB)
    drawn = []
    monkeypatch.setattr(operating_point, "save_all", lambda figure, *_: drawn.append(figure))
    code, out, err = run_program("operating_point", path, "--hz", 0, "--mm", 0, "--units", units)
    assert (code, err) == (0, "") and f"z  {heads}  worst" in out and f"best: {best}, z = 1/1" in out
    assert has_scales(drawn[0].axes[0]) == (below, above)


def test_an_old_map_is_judged_from_its_own_start(tmp_path, run_program):
    code, out, err = run_program("operating_point", write_map(tmp_path / "a.h5", [[ONE] * 6] * 5), "--hz", 0.1, "--mm", 0)
    assert (code, err) == (0, "") and "computed from one start alone" in out and "from the job's own start" in out


@pytest.mark.parametrize("label, force, words", [
    (orbit(1, 2), 50.0, r"doesn't hold: 289 of 289 cells of the finer box have another regime"),
    (ONE, 1e4, r"falls short by 9[\d.]+ %: of 289 cells of the finer box, all of the same regime, the worst has [12]\d\d(\.\d)? N, at "
               r"frequency_ratio [\d.]+ \([\d.]+ Hz\), gap_ratio [\d.]+ \([\d.]+ mm\)"),
    (ONE, 1.0, r"holds in all 289 cells of the finer box: the worst has [12]\d\d(\.\d)? N"),
])
def test_a_place_is_compared_with_what_the_program_finds(tmp_path, run_program, label, force, words):
    """Maps with false and true claims about the paper's rig, between 6.75 and 11.25 Hz."""
    path = write_map(tmp_path / "a.h5", [[label] * 6] * 5, frequency_ratio=np.linspace(1.5, 2.5, 6),
                     gap_ratio=np.linspace(0.2, 1.0, 5), forces=np.full((5, 6), force), job=JOB)
    code, out, err = run_program("operating_point", path, "--hz", 0.9, "--mm", 0.178, "--verify", "--formats", "png")
    assert (code, err) == (0, "") and re.search(words, out), out


def test_the_label_of_the_best_place_covers_no_other_box(tmp_path):
    """One whose box extends, though its number does not, to where the label is alone."""
    shape = 13, 13
    write_map(tmp_path / "a.h5", np.full((*shape, 3), 1), frequency_ratio=np.linspace(1, 4, 13), gap_ratio=np.linspace(0, 3, 13))

    def label_over(file, others):
        reaches = [reach(file, axis, 1.2, 0.3) for axis in (file.rows, file.columns)]
        places = [Place(row, column, 9.0, 10.0, (1, 1), 1.0) for row, column in ((6, 6), *others)]
        figure = picture.draw(file, np.full(shape, 9.0), places, *reaches,
                              (Quantity("peak_force", "peak force", 1.0, "N"), "from the job's own start", "drift"))
        ax = figure.axes[0]
        label = next(text for text in ax.texts if text.get_text().startswith("1/1"))
        return ax.transData.inverted().transform(matplotlib.text.Text.get_window_extent(label, figure.canvas.get_renderer())), reaches

    with PeterkaFile(tmp_path / "a.h5") as file:
        ((left, low), (right, high)), (rows, columns) = label_over(file, [])
        column = int(np.argmin(np.abs(file.columns.values - (left + right) / 2)))
        row = int(np.argmin(np.abs(file.rows.values + rows.after * np.diff(file.rows.values)[0] - (low + high) / 2)))
        ((left, low), (right, high)), _ = label_over(file, [(row, column)])
        (west, east), (south, north) = columns.ends(file.columns.values, column), rows.ends(file.rows.values, row)
        assert right < west or left > east or high < south or low > north


@pytest.mark.parametrize("size, along", [(0.03, 0.04), (0.02, 0.03), (0.09, 0.1)])
def test_numbers_and_the_label_of_boxes_in_a_row_cover_none_of_them_and_neither_do_their_lines(tmp_path, size, along):
    """Boxes in a row that slants as the best places of a map do: smaller and larger than a number."""
    cells = 201
    write_map(tmp_path / "a.h5", np.full((cells, cells, 3), 1), frequency_ratio=np.linspace(0, 1, cells) + 1, gap_ratio=np.linspace(0, 1, cells))
    with PeterkaFile(tmp_path / "a.h5") as file:
        half = size / 2 * 4.5, size / 2 * 0.89
        reaches = [reach(file, axis, *half) for axis in (file.rows, file.columns)]
        middles = [(round(200 * (size + along * n)), round(200 * (0.8 - 0.4 * along * n))) for n in range(8)]
        places = [Place(row, column, 9.0, 10.0, (1, 1), 1.0) for row, column in middles]
        figure = picture.draw(file, np.full(file.shape, 9.0), places, *reaches,
                              (Quantity("peak_force", "peak force", 1.0, "N"), "from the job's own start", "drift"))
    ax = figure.axes[0]
    boxes = [patch.get_window_extent() for patch in ax.patches]
    texts = {text.get_text(): text.get_window_extent() for text in ax.texts}
    assert len(boxes) == 8 and set(texts) == {"1/1, 9 N", *map(str, range(2, 9))}
    lines = [ax.transData.transform(line.get_xydata()) for line in ax.lines if line.get_marker() != "x"]
    for word, text in texts.items():
        own = boxes[8 - int(word)] if word.isdigit() else boxes[-1]
        inside = own.x0 <= text.x0 and text.x1 <= own.x1 and own.y0 <= text.y0 and text.y1 <= own.y1
        assert inside or not any(text.overlaps(box) for box in boxes), word
        assert not any(text.overlaps(other) for other in texts.values() if other is not text), word
        for line in lines:
            way = np.linspace(*line, 200)[5:-5]
            assert not np.any(np.all((way > text.min + 2) & (way < text.max - 2), axis=1)), f"a line through {word}"
    for way in (np.linspace(*line, 200)[5:-5] for line in lines):
        assert not any(np.any(np.all((way > box.min) & (way < box.max), axis=1)) for box in boxes)


def test_a_label_without_room_at_its_place_stands_near_it():
    figure, ax = plt.subplots()
    ax.set(xlim=(0, 1), ylim=(0, 1))
    for across in (0.62, 0.8, 0.98):
        ax.text(across, 0.75, "taken\n" * 6, ha="center", va="center")
    write_beside(ax, 0.8, 0.75, "best place")
    across, up = ax.texts[-1].get_position()
    plt.close(figure)
    assert ax.texts[-1].get_text() == "best place" and np.hypot(across - 0.8, up - 0.75) < 0.45


@pytest.mark.parametrize("left, low, width, height", [
    (0.4, 0.4, 0.1, 0.1), (0.02, 0.02, 0.1, 0.1), (0.9, 0.9, 0.08, 0.09), (0.05, 0.4, 0.9, 0.2), (0.4, 0.05, 0.2, 0.9)])
@pytest.mark.parametrize("crowd", [0, 3])
def test_the_label_of_a_box_stands_beside_it_and_never_over_it(left, low, width, height, crowd):
    figure = plt.figure(figsize=(3.7, 3.7))
    ax = figure.add_axes((0.1, 0.1, 0.8, 0.8), xlim=(0, 1), ylim=(0, 1))
    for number in range(crowd):  # other boxes, with their numbers, right and left of it
        other = Rectangle((left + (1 - 2 * (number % 2)) * (width + 0.02), low), width, height, gid=SEEN)
        ax.add_patch(other)
        ax.text(*other.get_center(), str(number), ha="center", va="center", fontsize=6.5, clip_on=True)
    box = ax.add_patch(Rectangle((left, low), width, height)).get_window_extent()
    assert write_near_box(ax, box, "2/3, 612.3 N")
    label = ax.texts[-1].get_window_extent()
    assert not label.overlaps(box) and not any(label.overlaps(text.get_window_extent()) for text in ax.texts[:-1])
    assert ax.bbox.x0 <= label.x0 and label.x1 <= ax.bbox.x1 and ax.bbox.y0 <= label.y0 and label.y1 <= ax.bbox.y1
    gap = np.maximum(np.maximum(label.min - box.max, box.min - label.max), 0)
    assert np.hypot(*gap) < 67 / 72 * figure.dpi, "farther than 65 pt"
    plt.close(figure)


MASSES, HERTZ = np.linspace(0.1, 0.5, 5), np.linspace(8.0, 10.0, 6)
OVER_MASSES = JOB.replace("mass_kg = 0.298, ", "").replace("gap_ratio = {", "hammer.mass_kg = {").replace("frequency_ratio", "frequency_hz")
OVER_MASSES += "operating_point = { gap_ratio = 0.4 }\n"


def write_over(path, columns, rows, job, forces=None, shared=("natural_frequency_hz", "cart_amplitude_m", "hammer_mass_kg")):
    """A map of 1/1 over other axes, each (name, values); `shared`: which of the root attributes its cells have in common."""
    write_map(path, np.broadcast_to(ONE, (len(rows[1]), len(columns[1]), 3)), forces=forces, job=job)
    with SealedFile(path, "r+") as file:
        for name, values in (columns, rows):
            file[name] = values
        for name in {"natural_frequency_hz", "cart_amplitude_m", "hammer_mass_kg"} - set(shared):
            del file.attrs[name]
    return path


def over_masses(path, job=OVER_MASSES):
    """Over the weight, the forces of the lightest hammer are the largest; in N, those of the heaviest."""
    ratios = 100 / np.sqrt(MASSES)[:, None] * np.linspace(1, 1.5, 6)
    write_over(path, ("frequency_hz", HERTZ), ("hammer_mass_kg", MASSES), job, ratios, ("natural_frequency_hz", "cart_amplitude_m"))
    return path, ratios * MASSES[:, None] * 9.80665


def test_forces_are_those_of_each_cells_own_mass(tmp_path, run_program, monkeypatch):
    path, newtons = over_masses(tmp_path / "a.h5")
    drawn = []
    monkeypatch.setattr(operating_point, "save_all", lambda figure, *_: drawn.append(figure))
    code, out, err = run_program("operating_point", path, "--hz", 0.4)
    assert (code, err) == (0, "") and "weight" not in out
    assert f"hammer mass 0.5 kg, z = 1/1: at least {newtons[4, 3]:.4g} N in all cells of its box" in out  # of the lowest of three frequencies
    assert f"there, from the job's own start: peak force {newtons[4, 4]:.4g} N" in out
    first, second = (line.split() for line in out.splitlines() if re.match(r" *[12]  1/1", line))
    assert first[3:] == ["0.5", f"{newtons[4, 3]:.4g}", f"{newtons[4, 4]:.4g}"] and second[3:5] == ["0.4", f"{newtons[3, 3]:.4g}"]
    assert drawn[0].axes[0].collections[-1].get_clim()[1] == pytest.approx(newtons[4, 3])


def test_places_of_an_unknown_mass_are_ranked_by_weight(tmp_path, run_program):
    path = write_map(tmp_path / "a.h5", [[ONE] * 6] * 5)
    with SealedFile(path, "r+") as file:
        del file.attrs["hammer_mass_kg"]
    code, out, err = run_program("operating_point", path, "--hz", 0, "--mm", 0, "--formats", "png")
    assert (code, err) == (0, "") and "worst of its box [F/(m g)]" in out
    assert "the file doesn't tell the hammer's mass: the order is that of forces over its weight, not of those in N" in out


def test_a_verified_force_is_that_of_the_own_mass(tmp_path, run_program):
    path, _ = over_masses(tmp_path / "a.h5")
    code, out, err = run_program("operating_point", path, "--hz", 0.4, "--verify", "--formats", "png")
    with h5py.File(tmp_path / "pictures" / "a_box.h5") as box:
        assert box["regime"].shape == (1, 17) and box["hammer_mass_kg"][()] == [0.5]
        worst = box["peak_force_ratio"][()].min() * 0.5 * 9.80665
    assert (code, err) == (0, "") and f"17 cells of the finer box, all of the same regime, the worst has {worst:.4g} N, at frequency " in out


def test_a_place_of_the_finer_box_is_told_in_the_numbers_of_the_map(tmp_path, run_program):
    """The natural frequency is the same in all of the box, whose frequencies could be shown as ratios then."""
    job = OVER_MASSES.replace("natural_frequency_hz = 4.5, ", "mass_kg = 0.298, ").replace("hammer.mass_kg", "hammer.natural_frequency_hz")
    path = write_over(tmp_path / "a.h5", ("frequency_hz", HERTZ), ("hammer_natural_frequency_hz", np.linspace(4.3, 4.7, 5)), job,
                      np.full((5, 6), 1e4), ("cart_amplitude_m", "hammer_mass_kg"))
    code, out, err = run_program("operating_point", path, "--hz", 0.4, "--verify", "--formats", "png")
    place, natural = re.search(r"it falls short by .*, at frequency ([\d.]+) Hz, natural frequency ([\d.]+) Hz\n", out).groups()
    assert (code, err) == (0, "") and 8 <= float(place) <= 10 and float(natural) == pytest.approx(4.5)


@pytest.mark.parametrize("rows, columns, drift, cells", [
    (1, 6, "drift ±0.5 Hz", " in all 17 cells of the finer box: the worst"),
    (5, 1, "drift ±0.1 mm", " in all 17 cells of the finer box: the worst"), (1, 1, "no drift", ": the place, computed again,")])
def test_an_axis_of_one_value_does_not_drift(tmp_path, run_program, rows, columns, drift, cells):
    gaps, frequencies = np.linspace(0.2, 1.0, 5)[:rows], np.linspace(1.5, 2.3, 6)[-columns:]
    path = write_map(tmp_path / "a.h5", [[ONE] * columns] * rows, frequency_ratio=frequencies, gap_ratio=gaps, forces=np.ones((rows, columns)),
                     job=JOB)
    code, out, err = run_program("operating_point", path, "--verify", "--formats", "png")
    assert (code, err) == (0, "") and f"own start, {drift}: one motion" in out and re.search(f"it holds{cells} has [\\d.]+ N", out), out
    assert (tmp_path / "pictures" / "a_operating_point.png").exists()
    for size, option, what in ((rows, "--mm", "gap"), (columns, "--hz", "frequency")):
        code, _, err = run_program("operating_point", path, option, 0.1, "--formats", "png")
        assert (code == 2 and f"has one and the same {what} in all cells" in err and err.count("\n") == 1) if size == 1 else code == 0, err


@pytest.mark.parametrize("points, most", [(2, "0"), (3, "1.5"), (4, "1"), (7, "1.5"), (12, "1.363")])
def test_the_widest_drift_that_is_told_is_allowed(tmp_path, run_program, points, most):
    """Over 3 Hz: where no cell is in the middle, it is less than 1.5."""
    path = write_map(tmp_path / "a.h5", [[ONE] * points] * 3, frequency_ratio=np.linspace(9, 12, points) / 4.5,
                     gap_ratio=np.linspace(0.2, 0.4, 3), job=JOB)
    code, _, err = run_program("operating_point", path, "--hz", 1.6, "--mm", 0)
    assert code == 2 and f"from 9 to 12 Hz: a drift of ±1.6 Hz leaves that from each of its cells; allow at most ±{most} Hz" in err
    assert run_program("operating_point", path, "--hz", most, "--mm", 0, "--formats", "png")[0] == 0


def test_a_single_place_may_not_hold(tmp_path, run_program):
    path = write_map(tmp_path / "a.h5", [[orbit(1, 2)]], frequency_ratio=[2.0], gap_ratio=[0.5], job=JOB)
    assert "it doesn't hold: the place, computed again, has another regime" in run_program("operating_point", path, "--verify", "--formats", "png")[1]
    write_map(path, [[ONE]], frequency_ratio=[2.0], gap_ratio=[0.5], forces=[[1e4]], job=JOB)
    assert re.search(r"it falls short by [\d.]+ %: the place, computed again, has [\d.]+ N, at", run_program("operating_point", path, "--verify")[1])
    with PeterkaFile(path) as file:
        place, found = Place(0, 0, 200.0, 200.0, (1, 1), 1.0), verify.Verified(1, 0, 200.0 * (1 - 1e-15), (0.5, 2.0))
        force = Quantity("peak_force", "peak force", 1.0, "N")
        assert verify.text_of(file, place, found, force).endswith("has 200 N (+0 %)")
        for starts, words in ((0.9, "another regime, or this one from fewer than 90 % of the starts"), ("any", "another regime, or more than one"),
                              ("job", "another regime")):
            missed = verify.Verified(621, 1, 200.0, (0.5, 2.0), starts)
            assert verify.text_of(file, place, missed, force) == f"it doesn't hold: 1 of 621 cells of the finer box have {words}"


@pytest.mark.parametrize("name, head", [
    ("contact_stiffness_n_per_m", "stop stiffness [N/m]"), ("contact_stiffness_n_per_m_pow_n", "stop stiffness [N/m^n]"),
    ("contact_exponent", "exponent of the stop"), ("cart_amplitude_m", "cart amplitude [mm]")])
def test_axes_have_names_and_units(tmp_path, run_program, monkeypatch, name, head):
    drawn = []
    monkeypatch.setattr(operating_point, "save_all", lambda figure, *_: drawn.append(figure))
    what, _, unit = head.rstrip("]").partition(" [")
    at = f"{what} {'500' if unit == 'mm' else '0.5'} {unit}".rstrip()
    job = OVER_MASSES.replace("frequency_hz = {", f"{name.replace('_', '.', 1)} = {{").replace("{ gap_ratio", "{ frequency_ratio = 2.0, gap_ratio")
    path = write_over(tmp_path / "a.h5", (name, HERTZ / 16), ("hammer_mass_kg", MASSES), job, 100 - np.arange(6.0) - np.zeros((5, 1)), ())
    code, out, err = run_program("operating_point", path)
    assert (code, err) == (0, "") and f"z  {head}  hammer mass [kg]  worst" in out and f"best: {at}, hammer mass 0.5 kg, z = 1/1" in out
    told = f"no drift, {what} and hammer mass as they are set"
    assert f"own start, {told}: one motion" in out and told in " ".join(drawn[0]._suptitle.get_text().split())


def test_the_place_that_all_cells_share_is_in_the_title(tmp_path, run_program, monkeypatch):
    path, _ = over_masses(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file.attrs["gap_ratio"] = 0.4
    drawn = []
    monkeypatch.setattr(operating_point, "save_all", lambda figure, *_: drawn.append(figure))
    out = run_program("operating_point", path, "--hz", 0.4)[1]
    assert "own start, drift ±0.4 Hz, hammer mass as it is set: one motion" in out
    assert drawn[0]._suptitle.get_text().splitlines()[:2] == ["Sample", "gap/A₀ = 0.4"]


@pytest.mark.parametrize("cells, shares, arguments, reason", [
    ([[SUSTAINED] * 6] * 5, 1.0, (), "has no cell with more than half of its starts in one motion with impacts, whatever the drift"),
    ([[SUSTAINED] * 6] * 5, 1.0, ("--starts", "job"), "has no cell with the job's own start in one motion with impacts, whatever the drift"),
    ([[ONE] * 6] * 5, 1.0, ("--regime", "2/2"), "more than half of its starts in one motion with impacts of 2/2, whatever the drift"),
    ([[ONE] * 6] * 5, 0.6, ("--hz", 0, "--mm", 0), "with impacts even without drift, and the hammer can swing without impact in 46.7 % of the boxes; "
     "allow a share of the starts (--starts share 0.9)"),
    ([[ONE] * 6] * 5, 0.6, ("--starts", "share", 0.8, "--mm", 0), "with impacts at a drift ±0.5 Hz, where boxes are ±2.7 Hz; allow fewer starts"),
    ([[ONE, TWICE] * 3] * 5, 1.0, ("--mm", 0), "of the boxes; allow less drift, or a share of the starts (--starts share 0.9)"),
    ([[ONE, TWICE] * 3] * 5, 1.0, ("--mm", 0, "--starts", "job"), "at a drift ±0.5 Hz, where boxes are ±2.7 Hz; allow less drift")])
def test_only_what_may_help_is_advised(tmp_path, run_program, cells, shares, arguments, reason):
    shape = np.shape(cells)[:2]
    write_map(tmp_path / "a.h5", cells, job=JOB + STARTS)
    share = np.full(shape, shares)
    path = add_starts(tmp_path / "a.h5", [cells, np.broadcast_to(SUSTAINED if shares < 1 else EMPTY, np.shape(cells))], [share, 1 - share],
                      np.full((2, *shape), 7.0), np.zeros(shape))
    code, _, err = run_program("operating_point", path, *arguments)
    assert code == 2 and err.endswith(f"{reason}\n") and err.count("\n") == 1, err


def test_other_files_are_told_that_a_map_is_needed(tmp_path, run_program):
    for path in (write_sweep(tmp_path / "sweep.h5"), write_basin(tmp_path / "basin.h5")):
        code, _, err = run_program("operating_point", path)
        assert code == 2 and err.endswith(f"{path} is of kind '{path.stem}'; a map file is needed\n"), err


@pytest.mark.parametrize("arguments, reason", [
    (("--starts", "share", "0.5"), "share and a number above 0.5"),
    (("--starts", "some"), "any, job, or share"),
    (("--hz", "-1"), "0 or a number above"),
    (("--regime", "1/1,2"), "is not a list of p/q"),
    (("--hz", "50"), "a drift of ±50 Hz leaves that from each of its cells; allow at most ±5.4 Hz"),
    (("--mm", "20"), "has its gap from 0 to 2.67 mm: a drift of ±20 mm leaves that"),
    (("--regime", "7/3"), "of 7/3"),
    (("--starts", "any"), "from one start alone"),
    (("--quantity", "impact_speed"), 'output.fields=["impact_speed"]'),
])
def test_what_cannot_be_answered_gets_words(tmp_path, run_program, arguments, reason):
    code, _, err = run_program("operating_point", write_map(tmp_path / "a.h5", [[ONE] * 6] * 5), *arguments)
    assert code == 2 and reason in err and err.count("\n") == 1, err


def test_a_rigid_stop_has_places_by_impact_speed_alone(tmp_path, run_program):
    path = write_map(tmp_path / "a.h5", [[ONE] * 6] * 5, forces=np.full((5, 6), np.nan), fields={"impact_speed": np.full((5, 6), 0.5)})
    arguments = "operating_point", path, "--starts", "job", "--hz", 0.1, "--mm", 0
    code, _, err = run_program(*arguments)
    assert code == 2 and "no peak forces" in err and "--quantity impact_speed" in err and err.count("\n") == 1, err
    code, out, err = run_program(*arguments, "--quantity", "impact_speed", "--formats", "png")
    assert (code, err) == (0, "") and out.splitlines()[-2].endswith("own start: impact speed 500 mm/s") and "nan" not in out, out


@pytest.mark.parametrize("name, value, reason", [
    ("basin_share", np.full((1, 5, 6), 1.5), "no share"),
    ("basin_share", np.ones((1, 5, 5)), "of shape"),
    ("attractor_regime", np.full((1, 5, 6), 9), "unknown regime 9"),
    ("start_attractor", np.zeros(3), "start_attractor"),
])
def test_a_strangers_starts_are_judged(tmp_path, run_program, name, value, reason):
    cells = [[ONE] * 6] * 5
    path = add_starts(write_map(tmp_path / "a.h5", cells), [cells], np.ones((1, 5, 6)), np.ones((1, 5, 6)), np.zeros((5, 6)))
    with h5py.File(path, "r+") as file:
        kind = file[name].dtype
        del file[name]
        file[name] = value.astype(kind)
    seal_file(path)
    code, _, err = run_program("operating_point", path, "--hz", 0.1, "--mm", 0)
    assert code == 2 and reason in err and err.count("\n") == 1, err
