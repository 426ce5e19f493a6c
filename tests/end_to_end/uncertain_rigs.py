"""Jobs with [uncertainty], and an independent draw of their rigs: plain random numbers, and one cell at a time."""

import os
import subprocess

import h5py
import numpy as np
from scipy.stats import fisher_exact, norm

import jobs
import launch

# The order of the page's engine (src/page/interface.hpp); NaN for what is not given.
NUMBERS = ("mass_kg", "natural_frequency_hz", "stiffness_n_per_m", "damping_ns_per_m", "damping_ratio", "cubic_stiffness_n_per_m3",
           "cubic_form", "amplitude_m", "law", "first", "second", "third", "max_cycles", "max_period", "chaos_cycles", "engine", "tolerance",
           "omit_tolerance", "frequency_ratio", "gap_ratio", "displacement_ratio", "velocity_ratio")
REGIME, IMPACTS, PERIOD, FORCE, SPEED = 0, 3, 4, 6, 11
FAILED = 5  # a regime
G0 = 9.80665
KEYS = {"contact.stiffness_n_per_m": "first", "contact.damping_ns_per_m": "second", "contact.coefficient": "first"}
COVARIANCE = """# numbers that were identified together
[covariance]
of = ["contact.stiffness_n_per_m", "contact.damping_ns_per_m", "operating_point.gap_m"]
mean = [5.5e6, 1.2e3, 0.0]
matrix = [[9.0e10, 2.7e7, -6.0], [2.7e7, 1.0e4, -1.5e-3], [-6.0, -1.5e-3, 1.6e-9]]
"""
OF, MEAN = ("contact.stiffness_n_per_m", "contact.damping_ns_per_m", "operating_point.gap_m"), (5.5e6, 1.2e3, 0.0)
MATRIX = [[9.0e10, 2.7e7, -6.0], [2.7e7, 1.0e4, -1.5e-3], [-6.0, -1.5e-3, 1.6e-9]]
BY_KEY = """[uncertainty.hammer]
natural_frequency_hz = { relative = 0.01 }
damping_ratio = { from = 0.002, to = 0.006 }
"""


def table(rigs, file=None):
    named = f'file = "{file}"\n' if file else ""
    return f"\n[uncertainty]\nrigs = {rigs}\n{named}{BY_KEY}"


def write(folder, text):
    """A job beside the file of its covariance."""
    (folder / "stop_identified.toml").write_text(COVARIANCE)
    jobs.write(folder, text)


def compute(folder, text, *arguments, ranks=None):
    write(folder, text)
    finished = launch.run("run", "job.toml", *arguments, cwd=folder, ranks=ranks)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished.stdout


def small_map(rigs=32, columns=40, rows=35, more=""):
    return jobs.small_map(columns, rows, title="small map of uncertain rigs") + more + table(rigs, "stop_identified.toml")


def paper_rig():
    return {"mass_kg": 0.298, "natural_frequency_hz": 4.5, "damping_ns_per_m": 0.06, "cubic_stiffness_n_per_m3": 0.0, "cubic_form": 0,
            "amplitude_m": 0.89e-3, "law": 0, "first": 5.5e6, "second": 1.2e3, "max_cycles": 3000, "max_period": 64,
            "chaos_cycles": 1000, "engine": 0, "tolerance": 1e-9, "omit_tolerance": 1e-3}


def ratios(rig):
    """omega [rad/s] and the amplitude [m], the units of a rig's place."""
    hertz = rig.get("natural_frequency_hz") or np.sqrt(rig["stiffness_n_per_m"] / rig["mass_kg"]) / (2 * np.pi)
    return 2 * np.pi * hertz, rig["amplitude_m"]


def placed(own, drawn, frequency_ratio, gap_ratio, offset_m=0.0, start=(0.0, 0.0)):
    """A drawn rig at the place of the job's own rig: the same Hz, m and m/s."""
    (omega, amplitude), (new_omega, new_amplitude) = ratios(own), ratios(drawn)
    gap = gap_ratio * amplitude + offset_m
    displacement = min(start[0] * amplitude, max(gap, gap + (start[0] - gap_ratio) * amplitude))
    return drawn | {"frequency_ratio": frequency_ratio * omega / new_omega, "gap_ratio": gap / new_amplitude,
                    "displacement_ratio": displacement / new_amplitude, "velocity_ratio": start[1] * amplitude * omega / (new_amplitude * new_omega)}


def numpy_draws(own, random, count, place, start=(0.0, 0.0)):
    """`count` rigs of COVARIANCE and BY_KEY around `own`, at a place (frequency ratio, gap ratio), from a start in the own rig's ratios."""
    together = random.multivariate_normal(np.zeros(len(OF)), MATRIX, count)
    hertz = own["natural_frequency_hz"] * (1 + 0.01 * random.standard_normal(count))
    damping = random.uniform(0.002, 0.006, count)
    cells = []
    for (stiffness, dashpot, gap), natural, ratio in zip(together, hertz, damping):
        rig = own | {"first": own["first"] + stiffness, "second": own["second"] + dashpot, "natural_frequency_hz": natural, "damping_ratio": ratio,
                     "damping_ns_per_m": np.nan}
        cells.append(placed(own, rig, *place, gap, start))
    return cells


def from_random_starts(own, cells, random, displacement=(-4.0, 1.0), velocity=(-4.0, 4.0)):
    """The same rigs, each from a start in the rectangle of many_starts.table, in the units of the job's own rig."""
    omega, amplitude = ratios(own)
    started = []
    for cell in cells:
        new_omega, new_amplitude = ratios(cell)
        right = min(displacement[1] * amplitude, cell["gap_ratio"] * new_amplitude)
        place, speed = random.uniform(displacement[0] * amplitude, right), random.uniform(*velocity) * amplitude * omega
        started.append(cell | {"displacement_ratio": place / new_amplitude, "velocity_ratio": speed / (new_amplitude * new_omega)})
    return started


def solve(cells):
    """(labels, forces over the weight of the drawn hammer or impact speeds) of cells, solved one by one by another engine than a map's;
    without impact, or failed, 0."""
    lines = [" ".join(repr(float(cell.get(name, np.nan))) for name in NUMBERS) for cell in cells]
    done = subprocess.run([os.environ["LIVE_CELLS"]], input="\n".join(lines), capture_output=True, text=True, timeout=launch.HANGING, check=True)
    answers = np.array([[float(word) for word in line.split()] for line in done.stdout.splitlines()])
    regime = answers[:, REGIME].astype(int)
    labels = [(int(r), int(p) if r == 1 else 0, int(q) if r in (0, 1, 3) else 0) for r, p, q in zip(regime, answers[:, IMPACTS], answers[:, PERIOD])]
    strength = answers[:, FORCE] if cells[0]["law"] != 1 else answers[:, SPEED]
    return labels, np.where((regime == 0) | (regime == FAILED), 0.0, strength)


def told(path):
    with h5py.File(path) as file:
        return {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}


def outcomes(cells, row, column):
    """Probability of each label in a cell of a file."""
    slots = [cells[f"outcome_{name}"][:, row, column] for name in ("regime", "impacts", "period", "probability")]
    return {(int(regime), int(impacts), int(period)): probability for regime, impacts, period, probability in zip(*slots) if probability > 0}


def deviations(cells, row, column, rigs, labels, strengths, names=("force_q05_ratio", "force_q50_ratio", "force_q95_ratio")):
    """How far each probability, and the share of draws below each quantile, is from that of plain draws, after what a single draw may
    change, in standard errors of both; of probabilities, as many as are as unlikely as Fisher's exact test says, for outcomes may be rare."""
    count, found = len(labels), []
    told_ones = outcomes(cells, row, column)
    for label in {*told_ones, *labels}:
        plain = labels.count(label) / count
        if label not in told_ones and cells["outcomes"][row, column] > len(told_ones):
            continue  # may be among the others
        mine = told_ones.get(label, 0.0)
        drawn, ones = round(mine * rigs), round(plain * count)
        off = drawn - plain * rigs
        drawn -= int(np.sign(off))
        exact = fisher_exact([[drawn, rigs - drawn], [ones, count - ones]])[1] if abs(off) > 1 else 1.0
        found.append(float(norm.isf(exact / 2)))
    known = np.sort(strengths[~np.isnan(strengths)])
    for name, share in zip(names, (0.05, 0.5, 0.95)):
        value = cells[name][row, column] * (1 + 1e-9)
        # equal strengths, such as none, reach over a range of shares
        low, high = np.searchsorted(known, value * (1 - 2e-9), "left") / len(known), np.searchsorted(known, value, "right") / len(known)
        away = max(low - share, share - high, 0) - 1 / rigs
        found.append(max(away, 0) / np.sqrt(share * (1 - share) * (1 / count + 1 / rigs)))
    return found
