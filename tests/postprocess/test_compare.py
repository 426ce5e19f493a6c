"""Cell-by-cell comparison of two files: numbers that can be counted by hand, the picture's colours, and refusals."""

import h5py
import matplotlib.image
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from peterka.cli import compare
from peterka.maps import comparison, comparison_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import CHAOTIC, MISSING, NO_IMPACT, PLAIN, Drawn, orbit, write_basin, write_map
from picture_texts import has_scales
from sealing import SealedFile

pytestmark = pytest.mark.thorough

FORCES = [[10.0, 10, 10, 10], [10, 10, 10, 10], [10, 0, 0, 0], [0, 0, 0, 0]]


@pytest.fixture
def run_compare(run_program):
    """Calls compare.py in tmp_path: (code, stdout, stderr)."""
    return lambda *arguments: run_program("compare", *arguments, "--formats", "png")


def changed(cells, **changes):
    """`changes`: r0c1=label and so on."""
    copy = [list(row) for row in cells]
    for place, label in changes.items():
        copy[int(place[1])][int(place[3])] = label
    return copy


@pytest.fixture
def pair(tmp_path):
    """A map, and one with a different regime, a different z, a missing cell, and forces off by 5 % and 50 %."""
    forces = np.array(FORCES)
    forces[0, 0], forces[0, 1] = 10.5, 20
    other = changed(PLAIN, r3c3=CHAOTIC, r0c2=orbit(1, 1), r3c0=MISSING)
    return (write_map(tmp_path / "a.h5", PLAIN, forces=FORCES), write_map(tmp_path / "b.h5", other, forces=forces))


def test_counts_moves_and_forces(pair):
    with PeterkaFile(pair[0]) as a, PeterkaFile(pair[1]) as b:
        found = comparison.compare(a, b)
    assert (found.cells, found.same_regime, found.same_label) == (15, 14, 13)
    assert found.moves == {("no impact", "chaotic"): 1, ("2/2", "1/1"): 1}
    assert sorted(found.differences()) == pytest.approx([0, 0, 0, 0, 0, 1 - 10 / 10.5, 0.5])
    assert found.place[np.argmax(found.differences())].tolist() == [0, 1]
    assert found.scale == 1


def test_forces_have_a_sign_and_no_median_is_taken_out(tmp_path):
    """A force 29 % lower is neither the same nor merely different."""
    first = write_map(tmp_path / "a.h5", PLAIN, forces=FORCES)
    second = write_map(tmp_path / "b.h5", PLAIN, forces=0.71 * np.array(FORCES))
    with PeterkaFile(first) as a, PeterkaFile(second) as b:
        found = comparison.compare(a, b)
        told = comparison.text(a, b, found)
        drawn = Drawn(comparison_map.draw(a, b, found), tmp_path / "picture.png")
        back = Drawn(comparison_map.draw(b, a, comparison.compare(b, a)), tmp_path / "back.png")
        weaker, stronger = drawn.colour_of(a, 0, 0), back.colour_of(a, 0, 0)
    assert found.scale == pytest.approx(0.71)
    assert "ratio               0.71 (1 %), 0.71 (50 %), 0.71 (99 %)" in told and "0.71 (-29 %), at" in told
    red, blue = (to_rgb(colour) for colour in (stronger, weaker))
    assert blue[2] > blue[0] + 0.2 and red[0] > red[2] + 0.2
    assert "median 0.71" in drawn.figure.axes[1].get_xlabel()


def test_the_picture_tells_each_kind_of_difference(pair, tmp_path):
    with PeterkaFile(pair[0]) as a, PeterkaFile(pair[1]) as b:
        drawn = Drawn(comparison_map.draw(a, b, comparison.compare(a, b)), tmp_path / "picture.png")
        colours = {place: drawn.colour_of(a, *place) for place in [(0, 2), (3, 3), (3, 1)]}
        forces = [drawn.colour_of(a, *place) for place in [(1, 0), (0, 0), (0, 1)]]
    kinds = comparison_map
    assert colours == {(0, 2): kinds.COLOURS[kinds.ORBIT], (3, 3): kinds.COLOURS[kinds.REGIME],
                       (3, 1): kinds.COLOURS[kinds.SAME]}
    redness = [to_rgb(colour)[0] - to_rgb(colour)[2] for colour in forces]  # the same, 5 % more, twice as much
    assert abs(redness[0]) < 0.02 and redness[0] < redness[1] < redness[2]
    assert drawn.legend_texts() == ["same label, no number compared (37.5 %)", "same regime, other z (6.2 %)", "other regime (6.2 %)",
                                    "not in both files (6.2 %)"]


def test_scales_in_hertz_and_millimetres_where_both_rigs_have_them(pair, tmp_path):
    other = write_map(tmp_path / "c.h5", PLAIN, forces=FORCES, natural_frequency_hz=5.25)
    with PeterkaFile(pair[0]) as a, PeterkaFile(pair[1]) as b, PeterkaFile(other) as c:
        same = comparison_map.draw(a, b, comparison.compare(a, b)).axes[0]
        differs = comparison_map.draw(a, c, comparison.compare(a, c)).axes[0]
    assert [child.get_xlabel() or child.get_ylabel() for child in same.child_axes] == ["excitation frequency (Hz)", "gap (mm)"]
    assert [child.get_xlabel() or child.get_ylabel() for child in differs.child_axes] == ["gap (mm)"]


@pytest.mark.parametrize("units, place, forces, scales", [
    ("both", "frequency_ratio 2 (9 Hz), gap_ratio 0 (0 mm)", "10 weights = 29.22 N in A, 20 weights = 58.45 N in B", (True, True)),
    ("si", "frequency 9 Hz, gap 0 mm", "29.22 N in A, 58.45 N in B", (False, True)),
    ("ratio", "frequency_ratio 2, gap_ratio 0", "10 weights in A, 20 weights in B", (True, False))])
def test_units_are_those_asked_for(pair, run_compare, monkeypatch, units, place, forces, scales):
    drawn = []
    monkeypatch.setattr(compare, "save_all", lambda figure, *_: drawn.append(figure))
    code, told, complaint = run_compare(*pair, "--units", units)
    assert (code, complaint) == (0, "") and f"2 (+100 %), at {place}: {forces}\n" in told
    assert has_scales(drawn[0].axes[0]) == scales


@pytest.mark.parametrize("masses, ratio, forces", [
    ((3.0, 6.0), "2 (50 %)", "10 weights = 294.2 N in A, 10 weights = 588.4 N in B"),
    (("unknown", 6.0), "1 (50 %)", "10 weights in A, 10 weights in B")])
def test_forces_in_newtons_are_compared_where_both_files_tell_them(tmp_path, run_compare, monkeypatch, masses, ratio, forces):
    """Twice the mass at the same F/(m g) strikes twice as hard."""
    cells, same = [[orbit(1, 1)] * 4] * 4, np.full((4, 4), 10.0)
    for name, mass in zip(("a.h5", "b.h5"), masses):
        write_map(tmp_path / name, cells, forces=same, hammer_mass_kg=mass)
    drawn = []
    monkeypatch.setattr(compare, "save_all", lambda figure, *_: drawn.append(figure))
    told = run_compare("a.h5", "b.h5")[1]
    assert ratio in told and f"median force        {forces}\n" in told
    assert ("B's hammer weighs 2 times A's: over their weights these ratios are 0.5 times" in told) == (masses[0] == 3.0)
    assert ("each over its own hammer's weight" in told) == (masses[0] != 3.0)
    assert f"(median {ratio[0]})" in drawn[0].axes[1].get_xlabel()


def test_a_job_in_newtons_and_hertz_has_these_first(pair, tmp_path, run_compare):
    for name in ("a.h5", "b.h5"):
        with SealedFile(tmp_path / name, "r+") as file:
            file.attrs["job"] = "[axes]\nfrequency_hz = { from = 4.5 }\ngap_m = { from = 0 }\n"
            for own, new, one in (("frequency_ratio", "frequency_hz", 4.5), ("gap_ratio", "gap_m", 0.89e-3)):
                file[new] = file[own][()] * one
    told = run_compare("a.h5", "b.h5")[1]
    assert "at frequency 9 Hz (frequency_ratio 2), gap 0 mm (gap_ratio 0): 29.22 N = 10 weights in A, 58.45 N = 20 weights in B\n" in told


def test_keys_that_differ_are_told_and_drawn(pair, tmp_path, run_compare):
    for name, damping, audited in (("a.h5", 1200.0, 0), ("b.h5", 900.25, 8)):
        with SealedFile(tmp_path / name, "r+") as file:
            file.attrs["job"] = (f'title = "{name}"\n[hammer]\nmass_kg = 0.298\n[contact]\ndamping_ns_per_m = {damping}\n'
                                 f'[audit]\ncells = {audited}\n')
    lines = ["stop damping (N s/m), contact.damping_ns_per_m: 1,200 in A, 900.25 in B", "audit.cells: 0 in A, 8 in B"]
    assert "\n{}\n{}\n".format(*lines) in run_compare("a.h5", "b.h5")[1]
    with PeterkaFile(pair[0]) as a, PeterkaFile(pair[1]) as b:
        assert comparison.differing_keys(a, b) == lines and comparison.differing_keys(a, a) == []
        title = comparison_map.draw(a, b, comparison.compare(a, b))._suptitle.get_text()
    assert title == "Sample\nA: a, B: b\nstop damping (N s/m): 1,200 in A, 900.25 in B"


def test_a_column_of_a_journal_in_grey(pair, tmp_path, run_compare, monkeypatch):
    drawn = []
    monkeypatch.setattr(compare, "save_all", lambda figure, *_: drawn.append(Drawn(figure, tmp_path / "picture.png")))
    assert run_compare(*pair, "--palette", "grey", "--width", "84", "--no-title")[0] == 0
    figure = drawn[0].figure
    assert figure.get_figwidth() * 25.4 == pytest.approx(84) and figure._suptitle is None
    assert np.ptp(drawn[0].pixels[..., :3], axis=-1).max() == 0  # no colour anywhere
    edge = figure.bbox.width
    extents = [text.get_window_extent() for ax in figure.axes if ax.get_legend() for text in ax.get_legend().get_texts()]
    assert extents and all(0 <= each.x0 and each.x1 <= edge for each in extents)


def test_a_coarser_grid_is_compared_where_its_points_are_the_others(tmp_path, run_compare):
    fine = np.random.default_rng(1).integers(0, 2, (9, 13))
    coarse = fine[::2, ::3].copy()
    coarse[1, 2] = 1 - coarse[1, 2]

    def cells(ones):
        return [[orbit(1, 1) if one else NO_IMPACT for one in row] for row in ones]

    write_map(tmp_path / "fine.h5", cells(fine), np.linspace(1, 4, 13), np.linspace(0, 3, 9))
    write_map(tmp_path / "coarse.h5", cells(coarse), np.linspace(1, 4, 5), np.linspace(0, 3, 5))
    for pair in (("fine.h5", "coarse.h5"), ("coarse.h5", "fine.h5")):
        code, told, complaint = run_compare(*pair)
        assert (code, complaint) == (0, "")
        assert "compared at the 5 by 5 points that both have: A has " in told
        assert "25 cells that both files hold" in told and "24    96.000 %" in told
    shifted = np.linspace(1, 4, 5)
    shifted[1:4] += 0.01  # two points, the ends, coincide with those of the other
    write_map(tmp_path / "shifted.h5", cells(coarse), shifted, np.linspace(0, 3, 5))
    assert "10 cells that both files hold" in run_compare("fine.h5", "shifted.h5")[1]


def test_counts_of_thousands_have_their_comma(tmp_path, run_compare):
    cells = np.full((128, 128, 3), 1)
    places = np.linspace(1, 4, 128)
    write_map(tmp_path / "a.h5", cells, places, places)
    cells[:64, :32, 1] = 2
    write_map(tmp_path / "b.h5", cells, places, places)
    told = run_compare("a.h5", "b.h5")[1]
    assert "16,384 cells that both files hold" in told and "same regime             16,384   100.000 %" in told
    assert "2,048    12.500 %" in told and "Peak force in 14,336 cells" in told


def test_the_program_tells_and_draws(pair, tmp_path, run_compare):
    code, told, complaint = run_compare("a.h5", "b.h5")
    assert (code, complaint) == (0, "")
    assert "same regime and z           13    86.667 %" in told and "2/2 -> 1/1" in told
    assert "largest             2 (+100 %), at frequency_ratio 2 (9 Hz), gap_ratio 0 (0 mm)" in told
    assert matplotlib.image.imread(tmp_path / "pictures" / "a_against_b.png").shape[1] == 1110


def test_of_rigid_stops_impact_speeds_are_compared_if_both_files_hold_them(tmp_path, run_compare):
    forces, speeds = [np.where(np.array(FORCES) > 0, np.nan, 0.0), 0.1 * np.array(FORCES)]
    job = '[contact]\nlaw = "restitution"\ncoefficient = 0.5\n'
    for name, scale in (("a", 1.0), ("b", 0.5)):
        write_map(tmp_path / f"{name}.h5", PLAIN, forces=forces, fields={"impact_speed": scale * speeds}, job=job)
    write_map(tmp_path / "c.h5", PLAIN, forces=forces, job=job)
    _, told, _ = run_compare("a.h5", "b.h5")
    assert "Impact speed in 8 cells of the same regime and z, B's over A's" in told
    assert "median speed        1 m/s in A, 500 mm/s in B" in told and "0.5 (-50 %)" in told
    assert "No impact speed to compare: both files need it in output.fields." in run_compare("a.h5", "c.h5")[1]
    with PeterkaFile(tmp_path / "a.h5") as a, PeterkaFile(tmp_path / "b.h5") as b:
        drawn = Drawn(comparison_map.draw(a, b, comparison.compare(a, b)), tmp_path / "picture.png")
    assert any("impact speed of B over A" in ax.get_xlabel() for ax in drawn.figure.axes)


def test_files_without_a_common_force_or_cell(tmp_path, run_compare):
    write_map(tmp_path / "quiet.h5", [[NO_IMPACT] * 4] * 4)
    write_map(tmp_path / "empty.h5", [[MISSING] * 4] * 4)
    assert "No peak force to compare." in run_compare("quiet.h5", "quiet.h5")[1]
    code, told, _ = run_compare("quiet.h5", "empty.h5")
    assert code == 0 and "0 cells that both files hold" in told


def test_other_planes_are_refused_in_one_line(pair, tmp_path, run_compare):
    write_map(tmp_path / "shifted.h5", frequency_ratio=[1, 2.1, 3.1, 4.001])
    write_basin(tmp_path / "basin.h5")
    for name, words in (("shifted.h5", "4 points of frequency_ratio 1 to 4.001 ("),
                        ("basin.h5", "is a basin and a.h5 a map"), ("none.h5", "does not exist")):
        code, _, complaint = run_compare("a.h5", name)
        assert code == 2 and words in complaint, complaint
        assert complaint.startswith("compare.py: ") and complaint.count("\n") == 1
    (tmp_path / "file").touch()
    code, _, complaint = run_compare("a.h5", "b.h5", "--output-dir", "file/pictures")
    assert code == 3 and "cannot write into" in complaint


def test_basins_of_two_places_can_be_compared(tmp_path, run_compare):
    write_basin(tmp_path / "a.h5")
    write_basin(tmp_path / "b.h5", changed(PLAIN, r0c0=NO_IMPACT), gap_ratio=1.7)
    with h5py.File(tmp_path / "b.h5") as file:
        assert file.attrs["gap_ratio"] == 1.7
    code, told, _ = run_compare("a.h5", "b.h5")
    assert code == 0 and "1/1 -> no impact" in told


def test_grids_without_a_common_point_are_told_in_hertz_and_millimetres(tmp_path, run_compare):
    for name, shift in (("a.h5", 0.0), ("b.h5", 0.5)):
        write_map(tmp_path / name, frequency_ratio=4.5 * (np.arange(4) + 1 + shift), natural_frequency_hz=4.5)
        with SealedFile(tmp_path / name, "r+") as file:
            file.attrs["job"] = JOB_IN_HZ
            file.move("frequency_ratio", "frequency_hz")
    code, _, complaint = run_compare("a.h5", "b.h5")
    assert code == 2
    assert "b.h5 has 4 points of frequency 6.75 to 20.25 Hz (frequency_ratio 1.5 to 4.5), and a.h5 has 4 points of frequency 4.5 to 18 Hz" in complaint
    assert "of frequency 6.75 to 20.25 Hz, and" in run_compare("a.h5", "b.h5", "--units", "si")[2]


def test_on_a_logarithmic_axis_points_are_the_same_where_their_values_are(tmp_path, run_compare):
    """1e-9 of the axis's length, 1e12, once took 1000 and 1500 for the same."""
    for name, first in (("a.h5", 1e3), ("b.h5", 1.5e3)):
        write_map(tmp_path / name, frequency_ratio=np.geomspace(first, 1e12, 4))
    code, _, complaint = run_compare("a.h5", "b.h5")
    assert code == 2 and "only cells at the same places can be compared" in complaint


JOB_IN_HZ = "schema = 1\n[axes.frequency_hz]\nfrom = 4.5\nto = 18\npoints = 4\n[axes.gap_ratio]\nfrom = 0\nto = 3\npoints = 4\n"


@pytest.mark.parametrize("other, told", [
    (["edge", "orbit", "impact_speed", "contact_time", "sensitivity"], "output.fields: edge in B alone"),
    (["orbit", "impact_speed", "contact_time", "power"], "output.fields: sensitivity in A alone, power in B alone"),
    (["sensitivity", "contact_time", "impact_speed", "orbit"], "output.fields: the same values, in another order or number"),
    (["orbit"], "output.fields: impact_speed, contact_time, sensitivity in A alone")])
def test_of_long_lists_that_is_told_which_one_of_them_lacks(pair, tmp_path, other, told):
    for name, fields in (("a.h5", ["orbit", "impact_speed", "contact_time", "sensitivity"]), ("b.h5", other)):
        with SealedFile(tmp_path / name, "r+") as file:
            file.attrs["job"] = f"[output]\nfields = {fields}\n"
    with PeterkaFile(pair[0]) as a, PeterkaFile(pair[1]) as b:
        assert comparison.differing_keys(a, b) == [told]
