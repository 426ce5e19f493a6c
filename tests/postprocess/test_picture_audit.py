"""The audit of a map: rings at differing labels, the distribution of force errors, refusal of invalid data."""

import numpy as np
import pytest
from peterka.cli.picture_options import zoomed
from peterka.plotting.figures import figure_of
from peterka.maps import audit_map
from peterka.maps.map_file import PeterkaFile
from picture_samples import CHAOTIC, NO_IMPACT, Drawn, orbit, write_audit, write_map
from sealing import SealedFile

pytestmark = pytest.mark.thorough

PLACES = [(0, 0), (0, 2), (1, 2), (3, 3), (2, 0)]
LABELS = [orbit(1, 1), orbit(1, 1), CHAOTIC, NO_IMPACT, orbit(1, 1)]
ERRORS = [1e-9, np.nan, np.nan, np.nan, 1e-7]
AGREES = [1, 0, 1, 1, 1]


@pytest.fixture
def path(tmp_path):
    return write_audit(write_map(tmp_path / "rig.h5"), PLACES, LABELS, ERRORS, AGREES)


def test_other_labels_are_ringed_where_they_are(path, tmp_path):
    with PeterkaFile(path) as file:
        drawn = Drawn(audit_map.draw(file), tmp_path / "a.png")
    same, other = (np.column_stack(line.get_data()) for line in drawn.map_axes.lines)
    assert same.tolist() == [[1, 0], [3, 1], [4, 3], [1, 2]]  # Omega/omega, gap/A0
    assert other.tolist() == [[3, 0]]
    assert drawn.legend_texts()[:2] == ["same label (4 cells)", "other label (1)"]


def test_shares_of_errors(path, tmp_path):
    with PeterkaFile(path) as file:
        drawn = Drawn(audit_map.draw(file), tmp_path / "a.png")
    errors = drawn.figure.axes[-1]
    x, y = errors.lines[0].get_data()
    assert x[1:-1].tolist() == [1e-9, 1e-7] and y.tolist() == [0, 50, 100, 100]
    assert errors.get_xscale() == "log"
    assert errors.texts[0].get_text() == "2 cells\nmedian 1.0e-09\nlargest 1.0e-07"


def test_equal_forces_have_a_place_on_the_logarithmic_axis(tmp_path):
    path = write_audit(write_map(tmp_path / "rig.h5"), PLACES, LABELS, [0.0] * 5, AGREES)
    with PeterkaFile(path) as file:
        errors = Drawn(audit_map.draw(file), tmp_path / "a.png").figure.axes[-1]
    assert errors.get_xlim()[0] < errors.lines[0].get_xdata()[1] < errors.get_xlim()[1]


@pytest.mark.parametrize("agrees", [0, 1])  # all of them
@pytest.mark.parametrize("smallest", [-9, -7, -5])
def test_nothing_is_squeezed_and_the_numbers_hide_no_error(tmp_path, smallest, agrees):
    errors = np.geomspace(2 * 10.0**smallest, 5e-4, 70)
    path = write_audit(write_map(tmp_path / "rig.h5"), [(0, 0)] * 70, [orbit(1, 1)] * 70, errors, [agrees] * 70)
    with PeterkaFile(path) as file:
        figure = Drawn(audit_map.draw(file), tmp_path / "a.png").figure
    panel = figure.axes[-1]
    assert panel.get_position().height * figure.get_figheight() > 0.8  # in
    box = panel.texts[0].get_window_extent()
    x, y = panel.lines[0].get_data()
    curve = panel.transData.transform(np.column_stack([x[1:-1], y[1:-1]]))
    assert not any(box.contains(x, y) for x, y in curve)


def test_no_forces_to_compare(tmp_path):
    path = write_audit(write_map(tmp_path / "rig.h5"), PLACES, LABELS, [np.nan] * 5, AGREES)
    with PeterkaFile(path) as file:
        errors = figure_of(audit_map.draw(file)).axes[-1]
    assert errors.texts[0].get_text() == "no cell with forces to compare"


def test_draw_gives_the_picture(path, draw):
    assert "rig_audit.png" in draw(path, "--formats", "png").pictures


@pytest.mark.parametrize("zoom, told, rings", [
    ("1.6,4.5", [[3, 1], [4, 3]], [[3, 0]]), ("0.5,2.4,0.6,3.5", [[1, 2]], []), ("1.6,4.4,0.6,2.4", [[3, 1]], [])])
def test_a_part_shows_the_audited_cells_within_it(path, zoom, told, rings):
    with PeterkaFile(path) as whole:
        part = zoomed(whole, tuple(map(float, zoom.split(","))), in_si=False)
        same, *other = [np.column_stack(line.get_data()).tolist() for line in audit_map.draw(part).lines]
        assert (same, sum(other, [])) == (told, rings)
        assert part.audit.count == len(told) + len(rings)


def test_a_part_without_an_audited_cell_says_that_it_has_no_such_picture(path, draw):
    outcome = draw(path, "--zoom", "1.6,3.4,1.6,3.4", "--formats", "png")
    assert outcome.code == 0 and "no value to draw, audit is left out" in outcome.stdout


def test_samples_not_solved_yet_are_left_out(tmp_path, draw):
    path = write_audit(write_map(tmp_path / "rig.h5"), PLACES, [(-128, -1, -1)] * 5, [np.nan] * 5, [-128] * 5)
    outcome = draw(path, "--formats", "png")
    assert outcome.code == 0 and "rig_audit.png" not in outcome.pictures and "audit is left out" in outcome.stdout


@pytest.mark.parametrize("name, values, reason", [
    ("row", [0, 0, 1, 3, 4], "don't belong together"),
    ("column", [0, 1, 2, 3, 0], "don't belong together"),
    ("cell", [0, 2, 6, 15, -8], "don't belong together"),
    ("regime", [1, 1, 2, 0, 9], "unknown regime 9"),
    ("period", [0, 1, 0, 1, 1], "period is below 1"),
    ("force_error", [1.0, 1.0, 1.0, 1.0, -1.0], "negative error"),
    ("force_error", [1.0], "force_error of shape (1,)"),
])
def test_nonsense_is_refused(path, draw, name, values, reason):
    with SealedFile(path, "r+") as file:
        kind = file["audit"][name].dtype
        del file["audit"][name]
        file["audit"][name] = np.array(values, dtype=kind)
    outcome = draw(path)
    assert outcome.code == 2 and reason in outcome.stderr and outcome.stderr.count("\n") == 1


def test_an_audit_that_is_no_group_is_refused(tmp_path, draw):
    path = write_map(tmp_path / "rig.h5")
    with SealedFile(path, "r+") as file:
        file["audit"] = np.zeros(3)
    assert draw(path).code == 2


def test_the_legend_tells_the_pale_classes_behind(path, tmp_path):
    with PeterkaFile(path) as file:
        figure = figure_of(audit_map.draw(file))
    legends = [ax.get_legend() for ax in figure.axes if ax.get_legend()]
    words = {text.get_text() for legend in legends for text in legend.get_texts()}
    assert {"1/1", "2/2", "1/2", "no impact", "chaotic"} <= words
    assert "$z = p/q$ of the map" in {legend.get_title().get_text() for legend in legends}
