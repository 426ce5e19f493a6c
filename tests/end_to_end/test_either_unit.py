"""Two units, one coordinate: every kind and feature runs with its coordinates as ratios, in SI units and mixed, gives the same
numbers, and its file has both units of each axis; what means nothing is refused with its reason, in either unit."""

import re

import h5py
import numpy as np
import pytest

import either_unit
import jobs
import launch
from either_unit import COORDINATES, FEATURES, MIXED, RATIOS, REFUSALS, SI

WITHOUT_PERIOD = (2, 4)  # chaotic, unresolved
NAMES = {si: (ratio, unit) for ratio, si, unit in COORDINATES.values()}
UNTOLD = ("run", "tiles", "summary", "audit")  # what differs in its last bits, or follows from those
ERRORS = ("point_residual", "branch_residual", "sensitivity", "cycles", "observed_cycles", "multiplier", "lyapunov")


@pytest.fixture(scope="module")
def computed(tmp_path_factory):
    """The file of a feature in a unit, computed when it is first asked for."""
    folder, files = tmp_path_factory.mktemp("either"), {}

    def file(feature, unit):
        if (feature, unit) not in files:
            files[feature, unit] = compute(folder, feature, unit)
        return files[feature, unit]
    return file


def compute(folder, feature, unit):
    name = re.sub(r"\W+", "_", f"{feature} {' '.join(unit.in_si)}")
    job = jobs.write(folder, FEATURES[feature](unit), f"{name}.toml")
    finished = launch.run("run", job, "--quiet", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / f"{name}.h5"


def content(path):
    """{name in ratios: numbers in ratios}; the coordinates of the file under their own names, too."""
    numbers, own = {}, {}
    with h5py.File(path, "r") as file:
        def take(name, dataset):
            if not isinstance(dataset, h5py.Dataset) or name.split("/")[0] in UNTOLD or dataset.dtype.kind not in "fiu":
                return
            values = dataset[()]
            si = next((si for si in NAMES if name.endswith(si)), None)
            if si is None:
                numbers[name] = values
                return
            own[name] = values
            ratio, unit = NAMES[si]
            numbers.setdefault(name[:-len(si)] + ratio, values if name.startswith("edge_kind_") else values / unit)
        file.visititems(take)
    return numbers, own


def same(name, a, b, apart):
    """Whether numbers are the same but for rounding, where no motion is chaotic or hangs on rounding."""
    if a.shape != b.shape:
        return False
    if a.dtype.kind != "f":
        return bool(np.all((a == b) | apart))
    scale = np.nanmax(np.abs(a), initial=1e-300)
    with np.errstate(invalid="ignore"):
        return bool(np.all((np.abs(a - b) <= 2e-7 * scale) | (np.isnan(a) & np.isnan(b)) | apart))


def without_period(numbers, values):
    """Which of some values belong to cells whose motion may come out otherwise: as a mask that fits their shape."""
    regime = numbers.get("regime")
    if regime is None:
        return False
    apart = np.isin(regime, WITHOUT_PERIOD) | (numbers.get("status", 0 * regime) != 0)
    if "attractor_regime" in numbers:  # one start that rounding sends elsewhere
        apart = apart | np.isin(numbers["attractor_regime"], WITHOUT_PERIOD).any(axis=0)
    if values.shape == regime.shape or values.shape[1:] == regime.shape:
        return apart
    return apart[..., None] if values.shape[:-1] == regime.shape else False


def on_polyline(points, line):
    """How far each point is from the nearest stretch of a line, (n,); both (points, 2)."""
    first, way = line[:-1], np.diff(line, axis=0)
    share = np.sum((points[:, None] - first) * way, axis=2) / np.maximum(np.sum(way**2, axis=1), 1e-300)
    return np.min(np.linalg.norm(points[:, None] - first - np.clip(share, 0, 1)[..., None] * way, axis=2), axis=1)


def lines_of(numbers):
    """Of each curve its points (n, 2)."""
    points = np.column_stack([numbers["point_frequency_ratio"], numbers["point_gap_ratio"]] if "point_frequency_ratio" in numbers else
                             [numbers["point_contact_damping_ns_per_m"] / 1000, numbers["point_gap_ratio"]])
    return [points[first:first + count] for first, count in zip(numbers["curve_first"], numbers["curve_points"])]


@pytest.mark.parametrize("unit", [SI, MIXED], ids=["SI", "mixed"])
@pytest.mark.parametrize("feature", FEATURES)
def test_gives_the_same_numbers(computed, feature, unit):
    (first, _), (second, _) = content(computed(feature, RATIOS)), content(computed(feature, unit))
    assert first.keys() == second.keys()
    for name, values in first.items():
        if name in ERRORS or name.startswith(("point", "curve_first", "curve_points", "work_precision")):
            continue
        assert same(name, values, second[name], without_period(first, values)), name
    if "curve_first" in first:  # rounding may shorten a step
        assert all(on_polyline(a, b).max() < 1e-3 for a, b in zip(lines_of(first), lines_of(second)))


ONE_OF_THEM = ("map over a damper", "map over the amplitude", "sweep along the gap", "sweep along the damper", "curves over a damper")


@pytest.mark.parametrize("feature", [name for name in FEATURES if "trace" not in name and "study" not in name])
@pytest.mark.parametrize("unit", [RATIOS, SI], ids=["ratios", "SI"])
def test_the_file_has_both_units_of_each_axis(computed, feature, unit):
    with h5py.File(computed(feature, unit), "r") as file:
        found = 0
        for si, (ratio, factor) in NAMES.items():
            for before in ("", "start_"):
                if before + si not in file and before + ratio not in file:
                    continue
                found += 1
                assert np.allclose(file[before + si][()], file[before + ratio][()] * factor, rtol=1e-15, atol=0)
                scales = [file[name].attrs["CLASS"] == b"DIMENSION_SCALE" if "CLASS" in file[name].attrs else False
                          for name in (before + ratio, before + si)]
                assert sum(scales) == (0 if feature.startswith("sweep") and si == "gap_m" and "along the gap" not in feature else 1)
                assert file[before + si].attrs["units"] == {"frequency_hz": "Hz", "velocity_m_per_s": "m/s"}.get(si, "m")
        assert found == (1 if feature in ONE_OF_THEM else 2)


def test_a_unit_that_changes_from_cell_to_cell_has_no_twin(tmp_path):
    text = (either_unit.rig("map") + jobs.axis("frequency_hz", 5, 9, 3) + jobs.axis("hammer.natural_frequency_hz", 4, 5, 3)
            + "[operating_point]\ngap_m = 1e-3\n")
    jobs.write(tmp_path, text)
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    with h5py.File(tmp_path / "job.h5", "r") as file:
        assert "frequency_hz" in file and "frequency_ratio" not in file


@pytest.mark.parametrize("unit", [RATIOS, SI], ids=["ratios", "SI"])
@pytest.mark.parametrize("name", REFUSALS)
def test_what_means_nothing_is_refused_with_its_reason(tmp_path, name, unit):
    text, reason = REFUSALS[name]
    jobs.write(tmp_path, text(unit))
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 2 and reason in checked.stderr


@pytest.mark.parametrize("more, key", [
    ("[start]\nvelocity_ratio = 1\nvelocity_m_per_s = 1\n", "start.velocity_ratio and velocity_m_per_s"),
    ("[starts]\ncount = 2\ndisplacement_m = [-1e-3, 0.0]\ndisplacement_ratio = [-1, 0]\n",
     "starts.displacement_ratio and displacement_m"),
    ("[curves]\ngap_ratio = [1.0]\ngap_m = [1e-3]\n", "curves.gap_ratio and gap_m"),
])
def test_never_both_units_at_once(tmp_path, more, key):
    jobs.write(tmp_path, jobs.small_map() + more)
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 2 and f"{key} are both given" in checked.stderr


@pytest.mark.parametrize("text, words", [
    (FEATURES["basin"](SI) + jobs.axis("velocity_ratio", -1, 1, 3), "[axes.velocity_m_per_s] says the same as [axes.velocity_ratio]"),
    (FEATURES["map"](SI).replace("-0.0002225", "2e9"), "start.displacement_m"),
    (jobs.with_rigid_stop(FEATURES["map"](SI)).replace("displacement_m = -0.0002225", "displacement_m = 0.001"),
     "start.displacement_m = 0.001 lies beyond a rigid stop at the lowest axes.gap_m = 0"),
])
def test_faults_speak_in_the_units_of_the_job(tmp_path, text, words):
    jobs.write(tmp_path, text)
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 2 and words in checked.stderr, checked.stderr


def test_a_cell_is_named_in_the_other_unit_of_its_map(tmp_path, computed):
    named = jobs.trace_of(computed("map", RATIOS), "[operating_point]\nfrequency_hz = 9.0\ngap_m = 0.89e-3\n")
    jobs.write(tmp_path, named)
    told = launch.run("run", "job.toml", cwd=tmp_path)
    assert told.returncode == 0, told.stderr
    assert "row 4 (gap_ratio = 1), column 4 (frequency_ratio = 2)" in told.stdout
