"""Nothing that `check` accepts ends in an internal error: both ends of every
key's range, and every choice, with every kind of job, stop and engine.

Keys, ranges and choices are the program's own: `check` prints the keys, and
names the ranges for values outside. New keys are therefore tested, too.
"""

import re
import tomllib
from concurrent.futures import ThreadPoolExecutor
from itertools import count

import pytest

import jobs
import launch

pytestmark = pytest.mark.thorough

CODES = (0, 2, 3, 4, 5)  # all codes that a user may see: no internal error, signal, or mpirun's own
OUTSIDE = {bool: "1", int: "-9000000000000000000", float: "1e308", str: '"?"'}
RANGE = re.compile(r"--set (\d+): .*; give a value (?:from (\S+) to (\S+)|of (\S+) or more)$", re.MULTILINE)
CHOICE = re.compile(r"--set (\d+): .*this version has (.*?); ", re.MULTILINE)
MOST = 2**63 - 1
FIXED = ("schema", "kind", "title", "contact.law", "study.topic", "trace.map")  # texts, and keys on which other keys depend
AT_ONCE = 4  # most of a start is waiting

HUNT_CROSSLEY = 'law = "hunt_crossley"\nstiffness_n_per_m_pow_n = 5.5e8\ndissipation_s_per_m = 0.3\n'
LINEAR = jobs.small_map(columns=2, rows=2)
TINY = LINEAR.replace("[cart]", "cubic_stiffness_n_per_m3 = 238.23\n[cart]")
OTHER_AXES = (jobs.RIG.format(kind="map", title="stops") + "[operating_point]\nfrequency_ratio = 2.0\ngap_ratio = 0.5\n"
              + jobs.axis("contact.stiffness_n_per_m", 1e5, 1e8, 2) + jobs.axis("hammer.mass_kg", 0.2, 0.5, 2))


def with_engine(name, job=TINY):
    return job + f'[solver]\nengine = "{name}"\n'


JOBS = {
    "map, audited, refined": TINY + "[audit]\ncells = 1\n[refine]\nlevels = 1\n",
    "map, every term": TINY + "[solver]\nomit_tolerance = 0.0\n",
    "map, exact": with_engine("exact", LINEAR),
    "map, split": with_engine("split"),
    "map, cvode": with_engine("cvode"),
    "map, arkode": with_engine("arkode"),
    "rigid stop": jobs.with_rigid_stop(TINY) + "[audit]\ncells = 1\n",
    "rigid stop, arkode": with_engine("arkode", jobs.with_rigid_stop(TINY)),
    "nonlinear stop": TINY.replace(jobs.KELVIN_VOIGT, HUNT_CROSSLEY) + "[audit]\ncells = 1\n",
    "map, starts": TINY + "[starts]\ncount = 2\n[output]\nfields = [\"critical_kick\"]\n[audit]\ncells = 1\n",
    "map, other axes": OTHER_AXES,
    "curves": jobs.small_curves(points=3),
    "basin": jobs.small_basin(points=2) + "[audit]\ncells = 1\n",
    "sweep": jobs.small_sweep(points=2),
    "trace": jobs.trace(2.0, settings="cycles = 1"),
    "release": jobs.trace(0.0, settings='from = "start"\nduration_s = 0.2\n[start]\ndisplacement_ratio = -1.0'),
    "study of precision": jobs.study("work_precision", "frequency_ratio = [2.0]\ngap_ratio = [0.0]\ncycles = 2\nrepeats = 1\n"
                                     "tolerances = [1e-4]\nsteps_per_cycle = [500]\n"),
    "study of labels": jobs.small_label_study(points=2),
    "study of stability": jobs.stability_study(),
}
OTHER_ENGINES = [name for name in JOBS if name.startswith("map, ") and "solver" in JOBS[name]] + ["rigid stop, arkode"]
TABLES_OF_ENGINES = ("hammer", "cart", "contact", "axes", "start", "solver", "steady_state")  # the others never reach an engine


def keys_of(table, path=""):
    for name, value in table.items():
        if isinstance(value, dict):
            yield from keys_of(value, f"{path}{name}.")
        else:
            yield path + name, value


def outside(value):
    if not isinstance(value, list):
        return OUTSIDE[type(value)]
    return f"[{OUTSIDE[type(value[0]) if value else str]}]"


def settings_to_try(folder):
    """--set key=value for both ends of each range and for every choice of this job."""
    checked = launch.run("check", "job.toml", cwd=folder)
    assert checked.returncode == 0, checked.stderr
    keys = [(key, value) for key, value in keys_of(tomllib.loads(checked.stdout)) if key not in FIXED]
    overrides = [f"--set={key}={outside(value)}" for key, value in keys]
    refused = launch.run("check", "job.toml", *overrides, cwd=folder).stderr
    values = {}
    for number, low, high, least in RANGE.findall(refused):
        values[int(number) - 1] = [low, high] if low else [least, str(MOST)]
    for number, names in CHOICE.findall(refused):
        values[int(number) - 1] = re.findall(r'"[^"]*"', names)
    tried = []
    for number, (key, value) in enumerate(keys):
        if isinstance(value, bool):
            values[number] = ["true", "false"]
        shape = "{}=[{}]" if isinstance(value, list) else "{}={}"
        tried += [shape.format(key, each) for each in values.get(number, [])]
    assert {key for key, _ in keys} == {setting.split("=")[0] for setting in tried}
    return tried


@pytest.mark.parametrize("name", JOBS)
def test_no_value_that_is_accepted_ends_in_an_internal_error(tmp_path, name):
    jobs.write(tmp_path, JOBS[name])
    tried = settings_to_try(tmp_path)
    if name in OTHER_ENGINES:
        tried = [setting for setting in tried if setting.split(".")[0] in TABLES_OF_ENGINES]
    assert len(tried) > 20
    numbers = count()

    def run(setting):
        output = tmp_path / f"{next(numbers)}.h5"
        for _ in range(3):  # among some thousand concurrent starts, MPI itself occasionally fails
            finished = launch.run("run", "job.toml", "--quiet", "--max-wall", "0.3", "--output", output, "--set", setting,
                                  cwd=tmp_path)
            if finished.returncode != 1 or "before MPI_INIT completed" not in finished.stderr:
                break
        output.unlink(missing_ok=True)
        return setting, finished.returncode, finished.stderr

    with ThreadPoolExecutor(AT_ONCE) as pool:
        failed = [found for found in pool.map(run, tried) if found[1] not in CODES]
    assert not failed
