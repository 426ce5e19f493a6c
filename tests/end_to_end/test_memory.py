"""The memory of a job: reported by `check`, and refused if unavailable, before anything is created."""

import re
import resource
import subprocess

import pytest

import jobs
import launch
import many_starts

pytestmark = pytest.mark.thorough

MEGABYTE = 10**6


def sweep(samples, attractors=64):
    return (jobs.RIG.format(kind="sweep", title="large") + jobs.axis("frequency_ratio", 1.0, 3.0, 4001)
            + f"[sweep]\ngap_ratio = [1.5]\nsamples = {samples}\n" + many_starts.table(8, attractors=attractors))


def run_with(megabytes, *arguments, cwd):
    """With an address-space limit that leaves about this much beyond the program's own size."""
    peak = subprocess.run(["bash", "-c", '"$@" > /dev/null & while kill -0 $! 2> /dev/null; do '
                           "sed -n 's/VmPeak: *//p' /proc/$!/status 2> /dev/null; done", "bash", *launch.command("--version")],
                          env=launch.ENVIRONMENT, capture_output=True, text=True, check=False).stdout
    own = max(int(size) for size in re.findall(r"(\d+) kB", peak)) * 1024
    limit = own + megabytes * MEGABYTE
    return subprocess.run(launch.command(*arguments), cwd=cwd, env=launch.ENVIRONMENT, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=launch.HANGING, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))


def test_check_and_run_refuse_what_memory_cannot_hold(tmp_path):
    jobs.write(tmp_path, sweep(samples=32))
    told = launch.told_megabytes(launch.run("check", "job.toml", cwd=tmp_path))
    assert told > 400
    for command in ("check", "run"):
        finished = run_with(300, command, "job.toml", cwd=tmp_path)
        assert finished.returncode == 2, finished.stderr
        assert re.search(r"job\.toml: a rank needs [\d.]+ [MG]B of memory, and a limit of this process "
                         r"\(ulimit -v\) leaves [\d.]+ MB; nothing was created\. Give fewer points, a smaller starts\.count "
                         r"or starts\.attractors, a smaller sweep\.samples, or compute it where there is more\.",
                         finished.stderr), finished.stderr
        assert sorted(path.name for path in tmp_path.iterdir()) == ["job.toml"]


def test_the_coarse_map_of_curves_is_priced_and_refused(tmp_path):
    """Each rank keeps all of it."""
    jobs.write(tmp_path, jobs.small_curves(points=32))
    points = ("--set", "axes.frequency_ratio.points=2000", "--set", "axes.gap_ratio.points=2000")
    few, many = (launch.told_megabytes(launch.run("check", "job.toml", *more, cwd=tmp_path)) for more in ((), points))
    assert many - few > 1000
    for command in ("check", "run"):
        finished = run_with(600, command, "job.toml", *points, cwd=tmp_path)
        assert finished.returncode == 2, finished.stderr
        assert re.search(r"job\.toml: a rank needs 1\.\d GB of memory, and a limit of this process", finished.stderr), finished.stderr
        assert sorted(path.name for path in tmp_path.iterdir()) == ["job.toml"]


def test_check_tells_what_is_left(tmp_path):
    jobs.write(tmp_path, sweep(samples=2))
    with open("/proc/meminfo", encoding="ascii") as info:
        available = int(re.search(r"MemAvailable: +(\d+) kB", info.read()).group(1)) * 1024 / MEGABYTE
    told = launch.run("check", "job.toml", cwd=tmp_path).stdout
    left, unit = re.search(r"per rank, on any number of ranks; ([\d.]+) (MB|GB) is left here", told).groups()
    assert 0 < float(left) * (1000 if unit == "GB" else 1) < 1.5 * available  # less if a control group limits it


def test_what_fits_is_computed(tmp_path):
    """The same limit."""
    jobs.write(tmp_path, sweep(samples=2, attractors=2).replace("points = 4001", "points = 41"))
    for command in ("check", "run"):
        finished = run_with(300, command, "job.toml", cwd=tmp_path)
        assert finished.returncode == 0, finished.stderr


def test_starts_of_an_audited_map_are_priced_by_their_count(tmp_path):
    """An audited cell reports the end of each of its starts."""
    jobs.write(tmp_path, many_starts.small_map() + "[audit]\ncells = 5\n")
    few, many = (launch.told_megabytes(launch.run("check", "job.toml", "--set", f"starts.count={count}", cwd=tmp_path))
                 for count in (10_000, 1_000_000))
    assert many - few > 300


@pytest.mark.parametrize("job", [many_starts.small_map(count=256), sweep(samples=64, attractors=8).replace("points = 4001", "points = 601")],
                         ids=["map", "sweep"])
def test_no_more_is_taken_than_was_told(tmp_path, job):
    jobs.write(tmp_path, job)
    told = launch.told_megabytes(launch.run("check", "job.toml", cwd=tmp_path))
    process = launch.start("run", "job.toml", "--quiet", cwd=tmp_path)
    most = launch.largest_resident_megabytes(process)
    process.communicate(timeout=launch.HANGING)
    assert process.returncode == 0
    assert 20 < most < told, (most, told)
