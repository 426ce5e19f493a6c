"""Maps and sweeps with force_elasticity or speed_elasticity: that these are the differences of runs with numbers a little larger and smaller,
what is told of them, and that nothing depends on how they were computed."""

import shutil

import h5py
import numpy as np
import pytest

import jobs
import launch
import many_starts
import map_contents

pytestmark = pytest.mark.thorough

RIGID, CUBIC = "rigid", "cubic"
STEP = 1e-4
OF_CUBIC = ("hammer.cubic_stiffness_n_per_m3", "cart.amplitude_m", "gap_m")
VALUES = {"hammer.mass_kg": 0.298, "hammer.natural_frequency_hz": 4.5, "hammer.damping_ns_per_m": 0.06, "cart.amplitude_m": 0.89e-3,
          "contact.stiffness_n_per_m": 5.5e6, "contact.damping_ns_per_m": 1.2e3}
AXES = {"frequency_hz": (5.0, 11.0), "gap_m": (0.1e-3, 1.3e-3)}
SPREAD = {"contact_stiffness_n_per_m": 0.004, "contact_damping_ns_per_m": 0.005, "hammer_damping_ns_per_m": 0.01}
OFFSET = 2e-6  # m, standard deviation of the gap
UNCERTAIN = f"""
[uncertainty]
rigs = 256
[uncertainty.contact]
stiffness_n_per_m = {{ relative = {SPREAD["contact_stiffness_n_per_m"]} }}
damping_ns_per_m = {{ relative = {SPREAD["contact_damping_ns_per_m"]} }}
[uncertainty.hammer]
damping_ns_per_m = {{ relative = {SPREAD["hammer_damping_ns_per_m"]} }}
[uncertainty.operating_point]
gap_m = {{ standard_deviation = {OFFSET} }}
"""


def job(what="force", factors=None, more="", points=9, tolerance=1e-12):
    """A map in Hz and m; `factors` of the ends of its axes."""
    text = jobs.RIG.format(kind="map", title="elasticities")
    for axis, ends in AXES.items():
        text += jobs.axis(axis, *(end * (factors or {}).get(axis, 1.0) for end in ends), points)
    return text + f'[solver]\ntolerance = {tolerance}\nomit_tolerance = 0.0\n[output]\nfields = ["{what}_elasticity", "impact_speed"]\n' + more


def compute(folder, text, *arguments, ranks=None):
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", "--fresh", *arguments, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        return {name: file[name][()] for name in file if isinstance(file[name], h5py.Dataset)}, finished.stdout


@pytest.mark.parametrize("stop", ["spring and dashpot", RIGID, CUBIC])
def test_they_are_the_differences_of_two_runs(tmp_path, stop):
    what, result, values, sets = "force", "peak_force_ratio", dict(VALUES), []
    change = jobs.with_rigid_stop if stop == RIGID else str
    if stop == RIGID:
        what, result = "speed", "impact_speed"
        del values["contact.stiffness_n_per_m"], values["contact.damping_ns_per_m"]
        values["contact.coefficient"] = float(change(job()).split("coefficient = ")[1].split()[0])
    if stop == CUBIC:
        values["hammer.cubic_stiffness_n_per_m3"] = 2e6
        values["contact.stiffness_n_per_m"], values["contact.damping_ns_per_m"] = 2.5e5, 1.5e2
        sets = [f"--set={key}={value}" for key, value in values.items()]
    points = 3 if stop == CUBIC else 9
    told = [key for key in [*values, *AXES] if stop != CUBIC or key in OF_CUBIC]
    own, _ = compute(tmp_path, change(job(what, points=points)), *sets)
    periodic = own["regime"] == 1
    assert periodic.sum() > 0.3 * periodic.size
    for key in told:
        elasticity = own[f"{what}_elasticity_{key.replace('.', '_')}"]
        assert np.isfinite(elasticity[periodic]).mean() > 0.97 and np.isnan(elasticity[~periodic]).all()

        def changed(factor):
            text = change(job(what, {key: factor}, points=points))
            cells, _ = compute(tmp_path, text, *sets, *([] if key in AXES else [f"--set={key}={values[key] * factor!r}"]))
            return cells, cells[result] * (factor if key == "hammer.mass_kg" and what == "force" else 1.0)

        def difference(step):
            (up, larger), (down, smaller) = changed(1 + step), changed(1 - step)
            same = np.logical_and.reduce([side[name] == own[name] for side in (up, down) for name in ("regime", "impacts", "period")])
            with np.errstate(divide="ignore", invalid="ignore"):
                return np.where(same & periodic, (larger - smaller) / (2 * step * own[result]), np.nan)

        fine, coarse = difference(STEP), difference(2 * STEP)
        smooth = np.abs(fine - coarse) < 1e-3 * (np.abs(fine) + 0.01)  # else the peak changes from one impact to another
        assert smooth[periodic].mean() > 0.8, key
        error = np.abs((4 * fine - coarse) / 3 - elasticity)[smooth] / (1 + np.abs(elasticity[smooth]))
        assert error.max() < 2e-5 and np.median(error) < 1e-8, key


def test_small_spreads_propagate_linearly(tmp_path):
    cells, said = compute(tmp_path, job(more=UNCERTAIN, tolerance=1e-9))
    smooth = (cells["regime"] == 1) & (cells["outcomes"] == 1)
    parts = [cells[f"force_elasticity_{key}"] * deviation for key, deviation in SPREAD.items()]
    parts.append(cells["force_elasticity_gap_m"] * OFFSET / cells["gap_m"][:, None])
    deviation = np.sqrt(sum(np.square(part) for part in parts))
    half = (cells["force_q95_ratio"] - cells["force_q05_ratio"]) / 2
    ratio = half[smooth] / (1.6449 * deviation * cells["peak_force_ratio"])[smooth]
    assert smooth.sum() > 20 and 0.98 < np.median(ratio) < 1.02 and np.mean(np.abs(ratio - 1) < 0.1) > 0.8
    of_1_1 = smooth & (cells["impacts"] == 1) & (cells["period"] == 1)
    share = np.median((np.square(parts[1]) / np.square(deviation))[of_1_1])
    line = next(line for line in said.splitlines() if "of that variance" in line)
    told = float(line.split("contact.damping_ns_per_m ")[1].split(" %")[0])
    assert told == pytest.approx(100 * share, abs=2)


def test_the_summary_tells_on_what_the_force_depends_most(tmp_path):
    cells, said = compute(tmp_path, job())
    of_1_1 = (cells["impacts"] == 1) & (cells["period"] == 1)
    medians = {name.removeprefix("force_elasticity_"): np.nanmedian(values[of_1_1]) for name, values in cells.items() if "_elasticity_" in name}
    most = max(medians, key=lambda number: abs(medians[number]))
    line = next(line for line in said.splitlines() if "the peak force of 1/1 depends most on" in line)
    key, value = line.split(" depends most on ")[1].split(" % per 1 %")[0].split(": ")
    assert key.replace("operating_point.", "").replace(".", "_") == most
    assert float(value) == pytest.approx(medians[most], rel=0.03, abs=0.02)


KINDS = {
    "map": lambda: job(more=UNCERTAIN.replace("rigs = 256", "rigs = 48"), points=12, tolerance=1e-9),
    "with starts": lambda: job(more=many_starts.table(12), points=8, tolerance=1e-9),
    "refined": lambda: job(more="[refine]\nlevels = 2\n", points=25, tolerance=1e-9),
    "rigid": lambda: jobs.with_rigid_stop(job("speed", points=12)),
    "sweep": lambda: jobs.RIG.format(kind="sweep", title="elasticities") + jobs.axis("frequency_ratio", 1.0, 3.4, 25)
    + '[sweep]\ngap_ratio = [0.5, 1.0]\n[output]\nfields = ["force_elasticity_gap_m"]\n',
}


@pytest.mark.parametrize("kind", KINDS)
def test_they_are_the_same_on_more_ranks_and_where_a_half_done_file_is_completed(tmp_path, kind):
    compute(tmp_path, KINDS[kind]())
    own = shutil.copy(tmp_path / "job.h5", tmp_path / "own.h5")
    compute(tmp_path, KINDS[kind](), ranks=3)
    map_contents.assert_same_map(tmp_path / "job.h5", own)
    map_contents.take_out(tmp_path / "job.h5", [0])
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(tmp_path / "job.h5", own)


def test_one_number_alone_may_be_asked_for(tmp_path):
    cells, _ = compute(tmp_path, job().replace('"force_elasticity"', '"force_elasticity_gap_m"'))
    assert [name for name in cells if "_elasticity_" in name] == ["force_elasticity_gap_m"]


def test_orbits_on_a_soft_and_strongly_damped_stop_have_them(tmp_path):
    """Where the force falls right after touch, a touch that rounding puts just above the surface is one."""
    rig = jobs.RIG.format(kind="map", title="soft")
    for number, own in (("mass_kg = 0.298", "mass_kg = 0.0853"), ("natural_frequency_hz = 4.5", "natural_frequency_hz = 37.8"),
                        ("damping_ns_per_m = 0.06", "damping_ratio = 0.0038"), ("amplitude_m = 0.89e-3", "amplitude_m = 1.7e-3"),
                        ("stiffness_n_per_m = 5.5e6", "stiffness_n_per_m = 2943.0"), ("damping_ns_per_m = 1.2e3", "damping_ns_per_m = 40.0")):
        assert number in rig
        rig = rig.replace(number, own)
    cells, _ = compute(tmp_path, rig + jobs.axis("frequency_ratio", 0.4, 4.5, 24) + jobs.axis("gap_ratio", -1.1, 2.8, 24)
                       + '[output]\nfields = ["force_elasticity"]\n')
    simple = (cells["regime"] == 1) & (cells["impacts"] == 1) & (cells["period"] == 1)
    assert simple.sum() > 50 and np.isfinite(cells["force_elasticity_gap_m"][simple]).all()
