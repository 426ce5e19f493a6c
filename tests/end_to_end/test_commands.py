"""The commands and their output: help, version, check, summary, progress, quiet."""

import fcntl
import os
import pty
import re
import struct
import subprocess
import termios

import pytest

import jobs
import launch

RANKS = [None, 3]


@pytest.mark.parametrize("ranks", RANKS)
def test_help_and_version_are_printed_once(tmp_path, ranks):
    shown = launch.run("--help", cwd=tmp_path, ranks=ranks)
    assert shown.returncode == 0
    assert shown.stdout.count("Exit codes:") == 1
    version = launch.run("--version", cwd=tmp_path, ranks=ranks)
    assert version.returncode == 0
    begun_by = [line.split()[0] for line in version.stdout.splitlines()]
    assert begun_by == ["peterka", "HDF5", "MPI", "SUNDIALS", "Eigen", "fmt", "arithmetic"]
    assert "commit " in version.stdout


def test_the_installed_program_runs(tmp_path):
    build = launch.BINARY.parent
    subprocess.run(["cmake", "--install", build, "--prefix", tmp_path], check=True, capture_output=True)
    shown = launch.run("--version", cwd=tmp_path, binary=tmp_path / "bin" / "peterka")
    assert shown.returncode == 0 and shown.stdout.startswith("peterka "), shown.stderr


@pytest.mark.parametrize("ranks", RANKS)
def test_check_prints_the_job_and_its_cost_and_computes_nothing(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_map())
    checked = launch.run("check", "job.toml", cwd=tmp_path, ranks=ranks)
    assert checked.returncode == 0, checked.stderr
    for word in ["1,400", "9 of 16 by 16", "memory", "job.h5", "mass_kg = 0.298", "max_cycles"]:
        assert checked.stdout.count(word) == 1, word
    assert [path.name for path in tmp_path.iterdir()] == ["job.toml"]


def test_check_tells_defaults_in_the_units_of_the_job(tmp_path):
    text = jobs.small_map().replace("frequency_ratio", "frequency_hz").replace("gap_ratio", "gap_m")
    jobs.write(tmp_path, text.replace("to = 5.0", "to = 4e-3") + "[starts]\ncount = 8\n")
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 0, checked.stderr
    for told in ["displacement_m = 0\n", "velocity_m_per_s = 0\n",
                 "displacement_m = [-0.00356, 0.00089]\n", "velocity_m_per_s = [-0.100657, 0.100657]\n"]:  # A0 = 0.89 mm
        assert checked.stdout.count(f" (default), or {told}") == 1, told
    assert launch.run("check", jobs.write(tmp_path, checked.stdout, "again.toml"), cwd=tmp_path).returncode == 0
    jobs.write(tmp_path, jobs.small_map())
    assert "displacement_m" not in launch.run("check", "job.toml", cwd=tmp_path).stdout
    along_amplitude = text[:text.index("[axes.gap_m]")] + jobs.axis("cart.amplitude_m", 0.5e-3, 1e-3, 4)
    jobs.write(tmp_path, along_amplitude + "[operating_point]\ngap_m = 1e-3\n")
    checked = launch.run("check", "job.toml", cwd=tmp_path)  # another number in each cell
    assert checked.returncode == 0 and "displacement_m" not in checked.stdout, checked.stderr


SCENES = {
    "map": jobs.small_map(500, 300),
    "refined map": jobs.small_map(500, 300) + "\n[refine]\nlevels = 3\n",
    "rigid stop": jobs.with_rigid_stop(jobs.small_map(60, 60)),
    "basin": jobs.small_basin(),
}


@pytest.mark.thorough
@pytest.mark.parametrize("scene", SCENES)
def test_a_run_takes_the_memory_that_check_tells(tmp_path, scene):
    jobs.write(tmp_path, SCENES[scene])
    told = launch.told_megabytes(launch.run("check", "job.toml", cwd=tmp_path))
    with launch.start("run", "job.toml", cwd=tmp_path) as process:
        taken = launch.largest_resident_megabytes(process)
    assert process.returncode == 0
    assert 0.5 < taken / told < 1.2, (taken, told)  # small refined maps do not fill their regions


def test_what_check_prints_is_the_same_job(tmp_path, small_map_file):
    jobs.write(tmp_path, jobs.small_map())
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    jobs.write(tmp_path, checked.stdout, name="resolved.toml")
    finished = launch.run("run", "resolved.toml", "--output", small_map_file, cwd=tmp_path)
    assert "is complete" in finished.stdout, finished.stderr


def test_check_foretells_the_file_size(tmp_path, small_map_file):
    jobs.write(tmp_path, jobs.small_map())
    size = small_map_file.stat().st_size
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    line = next(line for line in checked.stdout.splitlines() if line.startswith("#   file"))
    foretold = float(line.split("job.h5, ")[1].split(" kB")[0]) * 1000
    assert size <= foretold + 100 and foretold < size + 20_000


@pytest.mark.parametrize("arguments", [["--version"], ["check", "job.toml"]])
def test_what_cannot_be_printed_is_a_failure(tmp_path, arguments):
    jobs.write(tmp_path, jobs.small_map())
    with open("/dev/full", "w") as full:
        finished = subprocess.run(launch.command(*arguments), cwd=tmp_path, env=launch.ENVIRONMENT, stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=launch.HANGING)
    assert finished.returncode == 3
    assert "standard output cannot be written" in finished.stderr


def test_the_line_that_draws_can_be_pasted_into_a_shell(tmp_path):
    jobs.write(tmp_path, jobs.small_map(columns=4, rows=4))
    finished = launch.run("run", "job.toml", "--output", "a map.h5", cwd=tmp_path)
    assert "postprocess/draw.py 'a map.h5'\n" in finished.stdout


def test_an_output_without_a_name_is_refused(tmp_path):
    jobs.write(tmp_path, jobs.small_map(columns=4, rows=4))
    finished = launch.run("run", "job.toml", "--output", "", cwd=tmp_path)
    assert finished.returncode == 2
    assert "--output" in finished.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["job.toml"]


STARTS_INSIDE = [  # job, its starts inside the stop of 5.5e6 N/m, how deep in A0
    (jobs.small_map().replace("from = 0.0", "from = -1.5"), "320 of 1,400 starts lie", 1.5),
    (jobs.small_sweep(points=9, gaps="[-0.5, 1.0]"), "2 of 4 starts lie", 0.5),
    (jobs.trace(2.0, gap_ratio=-0.25), "the hammer starts", 0.25),
]


@pytest.mark.parametrize("job, which, depth", STARTS_INSIDE)
def test_starts_inside_a_stop_that_yields_are_told(tmp_path, job, which, depth):
    """The same words from check and run; the stop presses with ki times the depth, minus the dashpot's part."""
    jobs.write(tmp_path, job)
    for command in (["check", "job.toml"], ["run", "job.toml"]):
        shown = launch.run(*command, cwd=tmp_path)
        assert shown.returncode == 0, shown.stderr
        told = re.findall(r"(the hammer starts|[\d,]+ of [\d,]+ starts lie) inside the stop, by up to ([\d.]+) A0 .* with "
                          r"up to ([\d.]+) kN at once", shown.stdout)
        assert len(told) == 1 and told[0][0] == which, shown.stdout
        assert float(told[0][1]) == depth
        assert 0.9 < float(told[0][2]) / (5500 * depth * 0.89e-3) < 1


def test_the_depth_of_starts_leads_with_the_unit_of_the_job(tmp_path):
    in_millimetres = jobs.small_map().replace("[axes.gap_ratio]\nfrom = 0.0", "[axes.gap_m]\nfrom = -0.00178")
    jobs.write(tmp_path, re.sub(r"(axes.gap_m\]\nfrom = \S+\n)to = \S+", r"\1to = 0.00178", in_millimetres))
    shown = launch.run("check", "job.toml", cwd=tmp_path)
    assert "starts lie inside the stop, by up to 1.78 mm (2 A0): it presses" in shown.stdout, shown.stdout + shown.stderr


def test_starts_outside_of_the_stop_are_not_worth_a_word(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    assert "starts lie" not in launch.run("check", "job.toml", cwd=tmp_path).stdout


def test_check_refuses_a_bad_job(tmp_path):
    jobs.write(tmp_path, jobs.small_map().replace("0.298", "-1"))
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 2
    assert "mass_kg" in checked.stderr and checked.stdout == ""


def test_check_takes_overrides(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    checked = launch.run("check", "job.toml", "--set", "axes.gap_ratio.points=100", cwd=tmp_path)
    assert "4,000" in checked.stdout


def test_the_summary_fits_a_screen_and_tells_the_map(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    for word in ["small map", "1,400 cells", "no impact", "periodic", "1/1", "weights", "Hz", "mm", "per cell",
                 "on 2 ranks", "postprocess/draw.py job.h5"]:
        assert word in finished.stdout, word
    assert finished.stdout.count("small map") == 1
    assert len(finished.stdout.splitlines()) < 40


def test_elsewhere_than_on_a_terminal_progress_is_a_plain_line(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.stderr == "peterka: 1,400 cells to compute, 0 already in the file\n"


@pytest.mark.parametrize("ranks", RANKS)
def test_quiet_is_quiet(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_map())
    finished = launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=ranks)
    assert (finished.returncode, finished.stdout, finished.stderr) == (0, "", "")
    again = launch.run("run", "job.toml", "--quiet", cwd=tmp_path, ranks=ranks)
    assert (again.returncode, again.stdout, again.stderr) == (0, "", "")


def on_a_terminal(*arguments, cwd, ranks, columns=80):
    """The stderr output on a terminal of this width."""
    mine, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("4H", 24, columns, 0, 0))
    process = subprocess.Popen(launch.command(*arguments, ranks=ranks), cwd=cwd, env=launch.ENVIRONMENT,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=its)
    os.close(its)
    shown = b""
    while True:
        try:
            part = os.read(mine, 4096)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        shown += part
    os.close(mine)
    process.communicate(timeout=launch.HANGING)
    assert process.returncode == 0, shown
    return shown.decode()


@pytest.mark.parametrize("ranks", RANKS)
def test_on_a_terminal_progress_is_one_bar(tmp_path, ranks):
    if ranks is not None and "mpich" in launch.MPIEXEC:
        pytest.skip("only of Open MPI's mpirun is known whether somebody watches; elsewhere progress is lines")
    jobs.write(tmp_path, jobs.small_map())
    shown = on_a_terminal("run", "job.toml", cwd=tmp_path, ranks=ranks)
    assert "\r[" in shown and "cells/s" in shown
    assert "[##############################] 100.0 %" in shown.split("\r[")[-1].join(["[", ""])
    assert shown.count("\n") == 1


@pytest.mark.parametrize("ranks", RANKS)
@pytest.mark.parametrize("columns", [60, 40, 12])
def test_progress_fits_a_narrow_terminal(tmp_path, ranks, columns):
    if ranks is not None and "mpich" in launch.MPIEXEC:
        columns = 80  # no terminal width is known: progress is printed as lines
    jobs.write(tmp_path, jobs.small_map())
    shown = on_a_terminal("run", "job.toml", cwd=tmp_path, ranks=ranks, columns=columns)
    assert "100.0 %" in shown
    assert all(len(line) < columns for line in re.split(r"[\r\n]+", shown)), shown


def test_default_output_is_the_jobs_stem_in_the_current_folder(tmp_path):
    (tmp_path / "elsewhere").mkdir()
    jobs.write(tmp_path / "elsewhere", jobs.small_map(), name="my.map.toml")
    assert launch.run("run", "elsewhere/my.map.toml", "--quiet", cwd=tmp_path).returncode == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["elsewhere", "my.map.h5"]


@pytest.mark.parametrize("ranks", [None, 3])
def test_lengths_that_look_like_millimetres_get_one_word(tmp_path, ranks):
    jobs.write(tmp_path, jobs.small_map())
    metres = ("--set", "cart.amplitude_m=0.5")
    note = "note: the cart's amplitude is 0.5 m: lengths are in metres"
    assert note.replace("note:", "#   note    ") in launch.run("check", "job.toml", *metres, cwd=tmp_path).stdout
    assert launch.run("run", "job.toml", *metres, "--fresh", cwd=tmp_path, ranks=ranks).stderr.count(note) == 1
    assert note not in launch.run("run", "job.toml", *metres, "--fresh", "--quiet", cwd=tmp_path, ranks=ranks).stderr
    assert "note:" not in launch.run("run", "job.toml", "--fresh", cwd=tmp_path, ranks=ranks).stderr
