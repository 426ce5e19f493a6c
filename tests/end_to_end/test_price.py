"""What check foretells of a job's time: cycles of a sample of cells against those that the run counts in all of them."""

import re

import h5py
import jobs
import launch
import many_starts
import numpy as np
import pytest
import uncertain_rigs

pytestmark = pytest.mark.thorough

STIFFNESS = jobs.axis("frequency_ratio", 0.5, 4.5, 130) + jobs.axis("contact.stiffness_n_per_m", 2e6, 2e7, 130)


def with_cubic(points):
    return (jobs.small_map(points, points).replace("damping_ns_per_m = 0.06", "damping_ns_per_m = 0.06\ncubic_stiffness_n_per_m3 = 240.0")
            + "[solver]\nomit_tolerance = 0.0\n")


CASES = {
    "spring and dashpot": jobs.small_map(160, 160),
    "rigid": jobs.with_rigid_stop(jobs.small_map(160, 160)),
    "cubic springs kept": with_cubic(120),
    "one by one": jobs.with_rigid_stop(with_cubic(120)),  # a cell takes longer
    "rigs of their own": jobs.RIG.format(kind="map", title="stiffness") + STIFFNESS + "[operating_point]\ngap_ratio = 0.5\n",
    "starts": many_starts.small_map(count=32, columns=40, rows=40),
    "basin": jobs.small_basin(points=160),
    "sweep": jobs.small_sweep(points=401),
}
WORDS = re.compile(r"#   time     (?P<cycles>[\d.,]+) cycles a (?:cell|point): (?:some|at least) (?P<time>.+?) of one core"
                   r".*?(?:, (?P<least>.+?) to (?P<most>.+?), by|; all were tried)")


def seconds(words):
    """Of a duration as it is printed."""
    units = {"us": 1e-6, "ms": 1e-3, "s": 1, "min": 60, "h": 3600, "days": 86400}
    parts = words.split()
    return sum(float(number) * units[unit] for number, unit in zip(parts[::2], parts[1::2], strict=True))


def cycles(foretold):
    return float(foretold["cycles"].replace(",", ""))


def told(folder, *sets):
    """The match of the line that tells the time."""
    checked = launch.run("check", "job.toml", *(word for one in sets for word in ("--set", one)), cwd=folder)
    assert checked.returncode == 0, checked.stderr
    found = WORDS.search(checked.stdout)
    assert found, checked.stdout
    return found


def counted(folder):
    """Mean number of cycles of a cell."""
    finished = launch.run("run", "job.toml", "--quiet", "--fresh", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(folder / "job.h5") as file:
        return np.mean(file["cycles"][()])


@pytest.mark.parametrize("case", CASES)
def test_cycles_of_a_sample_are_those_of_the_job(tmp_path, case):
    jobs.write(tmp_path, CASES[case])
    foretold = told(tmp_path)
    assert foretold["least"], "a part of the cells was to be solved"
    assert 0.7 < cycles(foretold) / counted(tmp_path) < 1.5
    assert seconds(foretold["least"]) < seconds(foretold["time"]) < seconds(foretold["most"])


def test_rigs_that_are_drawn_are_priced(tmp_path):
    uncertain_rigs.write(tmp_path, uncertain_rigs.small_map(columns=48, rows=48))
    assert 0.7 < cycles(told(tmp_path)) / counted(tmp_path) < 1.5


def test_all_cells_of_a_small_map_are_counted(tmp_path):
    jobs.write(tmp_path, jobs.small_map(12, 10))
    foretold = told(tmp_path)
    assert "all were tried" in foretold[0]
    assert cycles(foretold) == pytest.approx(counted(tmp_path), rel=5e-3)


def test_a_job_twice_as_large_takes_twice_as_long_and_an_integrator_a_hundred_times(tmp_path):
    jobs.write(tmp_path, jobs.small_map(200, 100))
    once, twice, integrated = (
        seconds(told(tmp_path, *sets)["time"]) for sets in
        ([], ["axes.gap_ratio.points=800"], ['solver.engine="cvode"']))
    assert 3 < twice / once < 20  # eight times
    assert integrated > 100 * once


def test_what_was_given_up_early_is_told(tmp_path):
    """The law that has no closed form, in chaos that the sample follows for chaos_cycles at most."""
    jobs.write(tmp_path, jobs.small_map(12, 12).replace(jobs.KELVIN_VOIGT, 'law = "hunt_crossley"\nstiffness_n_per_m_pow_n = 3e8\n'
                                                        'exponent = 1.5\ndissipation_s_per_m = 5.0\n'))
    foretold = told(tmp_path, "steady_state.chaos_cycles=20", "steady_state.max_cycles=100000")
    assert "at least" in foretold[0]
    assert seconds(foretold["most"]) > 10 * seconds(foretold["time"])


def test_the_audit_comes_on_top(tmp_path):
    jobs.write(tmp_path, jobs.small_map(60, 60))
    def of_audit(cells):
        checked = launch.run("check", "job.toml", "--set", f"audit.cells={cells}", cwd=tmp_path)
        found = re.search(r"the audit's integrator takes some (.+) more", checked.stdout)
        return seconds(found[1]) if found else 0
    assert of_audit(0) == 0
    assert of_audit(800) > 20 * of_audit(10) > 0


ON_ANOTHER_MOTION = """
schema = 1
kind = "sweep"
title = "away from the chaos that [start] leads to"
hammer = { mass_kg = 0.16713276026144674, natural_frequency_hz = 43.728322747798465, damping_ratio = 0.01 }
cart = { amplitude_m = 0.0004952750978304401 }
contact = { law = "restitution", coefficient = 0.5972870821931787 }
operating_point = { gap_ratio = 1.4497983412103812 }
axes = { frequency_ratio = { from = 0.5, to = 4.0, points = 800 } }
sweep = { direction = "both" }
"""


@pytest.mark.parametrize("points", [20, 800, 40000])
def test_a_sweep_is_priced_by_the_motions_that_its_branches_are_on(tmp_path, points):
    """Where the branches don't impact, starts lead to chaos, of ten times as many cycles. The larger one is followed in stretches."""
    jobs.write(tmp_path, ON_ANOTHER_MOTION.replace("points = 800", f"points = {points}"))
    assert cycles(told(tmp_path)) == pytest.approx(counted(tmp_path), rel=0.3)


def test_a_sweep_by_an_integrator_is_priced_as_one(tmp_path):
    jobs.write(tmp_path, jobs.small_sweep(points=41))
    exact, integrated = (seconds(told(tmp_path, f'solver.engine="{engine}"')["time"]) for engine in ("exact", "cvode"))
    assert integrated > 30 * exact


def test_a_sweep_tells_what_was_given_up(tmp_path):
    jobs.write(tmp_path, jobs.small_sweep(points=401))
    assert "at least" in told(tmp_path, "steady_state.max_cycles=1000000", "steady_state.chaos_cycles=1000000")[0]


def test_many_starts_are_priced_by_a_part_of_them(tmp_path):
    """Of 12,800 starts 128 are solved; nothing is called tried that wasn't."""
    jobs.write(tmp_path, many_starts.small_map(columns=3, rows=3))
    few, many = (told(tmp_path, f"starts.count={count}") for count in (128, 12800))
    assert cycles(many) == pytest.approx(cycles(few) * 12801 / 129, rel=0.02)
    assert few["least"] is None and many["least"]
