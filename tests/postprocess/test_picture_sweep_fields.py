"""Other fields of a sweep over its axis: their values, units, gaps in lines, and what is left out."""

import numpy as np
import pytest
from peterka.pictures import pictures_of
from peterka.plotting.figures import figure_of
from peterka.sweeps.sweep_file import SweepFile
from peterka.sweeps.sweep_panels import LOOKS
from sealing import SealedFile
from sweep_samples import FREQUENCY, WEIGHT, write_sweep
from test_picture_sweep import legend_texts, lines_of, panels_of

pytestmark = pytest.mark.thorough

SHAPE = (4, len(FREQUENCY))
RISING = np.arange(52.0).reshape(SHAPE)


def write_fields(path, **fields):
    write_sweep(path)
    with SealedFile(path, "r+") as file:
        for name, values in fields.items():
            file[name] = values
    return path


def drawn(path, name, **options):
    with SweepFile(path) as file:
        return panels_of(figure_of(pictures_of(file)[name](file, **options)))


@pytest.mark.parametrize("name, label, factor, unit", [
    ("contact_power_w", "mean power into the contact (mW)", 1e-3, 1e3), ("impact_speed", "largest impact speed (m/s)", 1, 1),
    ("multiplier", r"largest Floquet multiplier $|\mu|$", 1, 1), ("peak_force_q95_ratio", r"95 % quantile of each cycle's largest force, $F/(m\,g)$", 1, 1)])
def test_a_field_is_drawn_in_its_unit_a_panel_for_each_gap(tmp_path, name, label, factor, unit):
    first, second = drawn(write_fields(tmp_path / "a.h5", **{name: factor * RISING}), name)
    for panel, rows in ((first, (0, 1)), (second, (2, 3))):
        assert panel.get_ylabel().replace("\n", " ") == label
        for look, row in zip(("up", "down"), rows):
            line = lines_of(panel, LOOKS[look].colour)[0]
            has = np.isfinite(line.get_xdata()) & np.isfinite(line.get_ydata())
            expected = dict(zip(FREQUENCY, factor * unit * RISING[row]))
            assert line.get_ydata()[has] == pytest.approx([expected[x] for x in line.get_xdata()[has]])
            assert has.sum() == (13 if row < 2 else 11)
        assert panel.get_ylim()[0] == 0 and 1 < panel.get_ylim()[1] / (factor * unit * RISING[rows[1]].max()) < 1.1


def test_forces_of_each_cycle_have_a_scale_in_newtons(tmp_path):
    path = write_fields(tmp_path / "a.h5", peak_force_mean_ratio=RISING)
    first, _ = drawn(path, "peak_force_mean_ratio")
    newtons, = (scale for scale in first.child_axes if scale.get_ylabel() == "force (N)")
    newtons.figure.canvas.draw()
    assert newtons.get_ylim()[1] == pytest.approx(WEIGHT * first.get_ylim()[1])
    assert drawn(path, "peak_force_mean_ratio", units="si")[0].get_ylabel().replace("\n", " ") == "mean of each cycle's largest force (N)"


def test_lines_end_at_jumps_and_chaos_is_marks(tmp_path):
    path = write_fields(tmp_path / "a.h5", lyapunov=RISING - 40)
    _, second = drawn(path, "lyapunov")
    x, y = lines_of(second, LOOKS["up"].colour)[0].get_data()
    assert np.flatnonzero(np.isnan(x)).tolist() == [7] and np.isnan(y[-2:]).all()
    marks = [line for line in second.lines if line.get_linestyle() == "None" and len(line.get_xdata()) == 2]
    assert marks[0].get_ydata().tolist() == (RISING[2, -2:] - 40).tolist()
    assert second.get_ylim()[0] < RISING[2, 0] - 40  # not from 0
    with SweepFile(path) as file:
        assert "no period, frequency rising" in legend_texts(figure_of(pictures_of(file)["lyapunov"](file)))


def test_a_rigid_stop_has_lines_of_impact_speed(tmp_path):
    path = write_fields(tmp_path / "a.h5", impact_speed=RISING)
    with SealedFile(path, "r+") as file:
        file["peak_force_ratio"][...] = np.nan
    first, _ = drawn(path, "impact_speed")
    assert lines_of(first, LOOKS["up"].colour)[0].get_ydata().tolist() == RISING[0].tolist()


def test_contact_times_alike_in_most_points_have_a_scale_of_their_own(tmp_path):
    first, _ = drawn(write_fields(tmp_path / "a.h5", contact_time=1e-3 + 1e-6 * RISING), "contact_time")
    assert first.get_ylabel().replace("\n", " ") == "longest contact of an impact (ms)" and 0.99 < first.get_ylim()[0] < 1


def test_power_below_0_is_seen(tmp_path):
    assert drawn(write_fields(tmp_path / "a.h5", contact_power_w=RISING - 10), "contact_power_w")[0].get_ylim()[0] < -10


def test_elasticities_have_names_and_either_sign(tmp_path):
    first, second = drawn(write_fields(tmp_path / "a.h5", force_elasticity_gap_m=RISING - 20), "elasticity_gap_m")
    assert second.get_ylabel() == "peak force by gap (% per %)"
    assert first.get_ylim()[0] < -20 and first.get_ylim()[1] > 5


def test_whole_numbers_below_0_are_none_and_a_field_without_values_is_left_out(tmp_path, draw):
    counts = np.full(SHAPE, -1, dtype="i4")
    counts[2, 7:11] = [5, 0, 7, 9]
    path = write_fields(tmp_path / "a.h5", last_impact=counts, impulse=np.full(SHAPE, np.nan))
    _, second = drawn(path, "last_impact")
    y = lines_of(second, LOOKS["up"].colour)[0].get_ydata()
    assert y[np.isfinite(y)].tolist() == [5, 0, 7, 9]
    outcome = draw(path, "--formats", "png", "--only", "impulse,last_impact")
    assert (outcome.code, outcome.pictures) == (0, ["a_last_impact.png"])
    assert "no value to draw, impulse is left out" in outcome.stdout


def test_lives_have_a_logarithmic_scale_and_a_mark_where_one_stands_alone(tmp_path):
    lives = np.full(SHAPE, np.nan)
    lives[0, :3], lives[0, 6] = [1.0, 10.0, 100.0], 1000.0
    panel = drawn(write_fields(tmp_path / "a.h5", mean_life_s=lives), "life")[0]
    assert panel.get_yscale() == "log" and panel.get_ylabel() == "mean life under [noise] (s)"
    alone, = [line for line in panel.lines if line.get_marker() == "_" and len(line.get_xdata())]
    assert alone.get_xydata().tolist() == [[FREQUENCY[6], 1000.0]]
    assert not any(line.get_marker() == LOOKS["up"].marker and len(line.get_xdata()) for line in panel.lines)  # "no period"


def test_lives_have_errors_and_a_mark_where_only_a_bound_is_known(tmp_path):
    lives, errors, least = (np.full(SHAPE, np.nan) for _ in range(3))
    lives[0, :3], errors[0, :3] = [1.0, 10.0, 100.0], [0.1, 2.0, 30.0]
    least[0, 4:6], least[2, 7] = [5e3, 6e3], 7e3
    first, second = drawn(write_fields(tmp_path / "a.h5", mean_life_s=lives, mean_life_error_s=errors, mean_life_least_s=least), "life")
    for panel, x, y in ((first, FREQUENCY[4:6], [5e3, 6e3]), (second, FREQUENCY[7:8], [7e3])):
        bounds = [point for line in panel.lines if line.get_marker() == "^" for point in line.get_xydata().tolist() if np.isfinite(point[1])]
        assert bounds == np.column_stack([x, y]).tolist()
        assert panel.get_ylim()[1] > max(y)
    bars = [segment for bar in first.collections for segment in bar.get_segments() if len(segment)]
    assert np.concatenate([bar[:, 1] for bar in bars]) == pytest.approx([0.9, 1.1, 8.0, 12.0, 70.0, 130.0])
    assert "lasts at least, roughly" in legend_texts(first.figure)


def test_a_dataset_of_another_shape_is_no_field(tmp_path):
    with SweepFile(write_fields(tmp_path / "a.h5", impulse=RISING[:, :-1], orbit_velocity=RISING)) as file:
        assert pictures_of(file).keys() == {"response", "bifurcation", "bifurcation_impact"}


def test_limits_and_a_logarithmic_scale(tmp_path):
    path = write_fields(tmp_path / "a.h5", contact_power_w=1e-3 * (1 + RISING))
    assert drawn(path, "contact_power_w", limits=(0.002, 0.05))[0].get_ylim() == pytest.approx((2, 50))
    panel = drawn(path, "contact_power_w", log=True)[0]
    assert panel.get_yscale() == "log" and panel.get_ylim()[0] > 0
