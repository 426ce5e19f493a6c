"""identify.py recovers the rig from recordings made by the program itself, with noise, offset and sample rate of a
laboratory, within its standard errors; and jobs accept its rig file."""

import os
import re
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

import jobs
import launch

pytestmark = pytest.mark.thorough

PROGRAM = Path(__file__).resolve().parents[2] / "postprocess" / "identify.py"
TRUE = {"stop's stiffness ki": 5.5e6, "stop's damping ci": 1200.0, "natural frequency": 4.5, "damping ratio ζ": 0.0035605}
WEIGHT, AMPLITUDE_MM = 0.298 * 9.80665, 0.89
SIGNALS = {"force_n": ("force_ratio", WEIGHT), "acceleration_g": ("hammer_acceleration", 1 / 9.80665),
           "displacement_mm": ("relative_displacement_ratio", AMPLITUDE_MM)}
RATE = 51200.0
MANY_ERRORS = 4  # standard errors


def compute(folder, frequency_ratio, gap_ratio, settings, oversampled=1):
    """A trace whose samples, decimated by `oversampled`, have the logger's rate."""
    per_cycle = round(oversampled * RATE / (4.5 * (frequency_ratio or 1)))
    text = jobs.trace(frequency_ratio, gap_ratio, settings).replace("samples_per_cycle = 200", f"samples_per_cycle = {per_cycle}")
    jobs.write(folder, text.replace("spectrum_to_hz = 1000", "spectrum_to_hz = 20"))
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5"


@pytest.fixture(scope="module")
def release(tmp_path_factory):
    """Released 5 mm from a stop at 3 mm, for two seconds: two impacts, then a decaying oscillation."""
    folder = tmp_path_factory.mktemp("release")
    return compute(folder, 0.0, 3.370786516853933, 'from = "start"\nduration_s = 2.0\n[start]\ndisplacement_ratio = -5.618')


def record(trace, path, names, noise=0.01, separator=",", flipped=False, offset=0.05):
    """Writes a CSV file like a data logger: with shifted time, at the rate, each signal with an offset and noise, both
    relative to its largest value."""
    with h5py.File(trace) as file:
        time = file["time"][:]
        places = np.searchsorted(time, np.arange(int(time[-1] * RATE)) / RATE)
        columns = [time[places] + 100.0]
        chance = np.random.default_rng(20)
        for name in names:
            dataset, factor = SIGNALS[name]
            values = factor * file[dataset][:][places]
            largest = np.abs(values).max()
            values = values + offset * largest + noise * largest * chance.standard_normal(len(values))
            columns.append(-values if flipped else values)
    lines = [separator.join(["time_s", *names])]
    lines += [separator.join(f"{value:.9g}" for value in row) for row in zip(*columns)]
    text = "\n".join(lines) + "\n"
    path.write_text(text.replace(".", ",") if separator == ";" else text)
    return path


def identify(folder, *arguments):
    return subprocess.run([sys.executable, PROGRAM, *map(str, arguments), "--mass-kg", "0.298", "--formats", "png"], cwd=folder,
                          capture_output=True, text=True, timeout=300, check=False, env=os.environ | {"COLUMNS": "200"})


def numbers(printed):
    """{name: (value, standard error)} of the results."""
    return {name.strip(): (float(value), float(error)) for name, value, error in re.findall(
        r"(?m)^  (\S.{19}) ([-+.\de]+) ± ([-+.\de]+)", printed)}


def assert_found(printed, names, within):
    found = numbers(printed)
    for name in names:
        value, error = found[name]
        assert abs(value - TRUE[name]) < MANY_ERRORS * error, (name, found)
        assert abs(value / TRUE[name] - 1) < within, (name, found)


def test_a_release_gives_stop_and_springs_within_two_percent(tmp_path, release):
    path = record(release, tmp_path / "release.csv", ["force_n", "displacement_mm"])
    done = identify(tmp_path, path, "--gap-mm", "3", "--amplitude-mm", "0.89")
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    assert "of force and displacement at 51.2 kHz, 2 impacts" in done.stdout
    share, error = re.search(r"other modes have (\S+) ± (\S+) of the hammer's mobility at the stop\n", done.stdout).groups()
    assert abs(float(share)) < 3 * float(error) < 0.06
    assert_found(done.stdout, TRUE, 0.02)
    assert (tmp_path / "pictures" / "release_identified.png").stat().st_size > 10000


def test_the_rig_file_is_one_that_jobs_take(tmp_path, release):
    path = record(release, tmp_path / "release.csv", ["force_n", "displacement_mm"])
    assert identify(tmp_path, path, "--gap-mm", "3", "--amplitude-mm", "0.89", "--rig", "mine.toml").returncode == 0
    jobs.write(tmp_path, 'schema = 1\nkind = "map"\ntitle = "mine"\nrig = "mine.toml"\n'
               + jobs.axis("frequency_ratio", 0.5, 4.5, 8) + jobs.axis("gap_ratio", 0.0, 5.0, 8))
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(tmp_path / "job.h5") as file:
        assert file.attrs["natural_frequency_hz"] == pytest.approx(4.5, rel=1e-4)
        stiffness = float(re.search(r"stiffness_n_per_m = (\S+)", file.attrs["job"])[1])
    assert stiffness == pytest.approx(5.5e6, rel=0.02)


def test_a_release_seen_by_its_acceleration_alone_the_other_way_round(tmp_path, release):
    path = record(release, tmp_path / "release.csv", ["acceleration_g"], noise=0.001, separator=";", flipped=True)
    done = identify(tmp_path, path, "--gap-mm", "3")
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    assert_found(done.stdout, TRUE, 0.02)


def test_impacts_of_a_driven_rig_tell_the_stop_alone(tmp_path):
    trace = compute(tmp_path, 2.0, 0.0, "cycles = 18", oversampled=16)
    path = record(trace, tmp_path / "driven.csv", ["force_n"])
    done = identify(tmp_path, "--driven", path)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    assert_found(done.stdout, ("stop's stiffness ki", "stop's damping ci"), 0.02)
    assert "natural frequency    not told" in done.stdout and "# natural_frequency_hz =" in (tmp_path / "driven_rig.toml").read_text()
    as_release = identify(tmp_path, path)
    assert as_release.returncode == 2 and "--driven" in as_release.stderr and as_release.stderr.count("\n") == 1
