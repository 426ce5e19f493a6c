"""Small jobs on the paper's 170 mm rig."""

from pathlib import Path

RIG = """
schema = 1
kind = "{kind}"
title = "{title}"
""" + (Path(__file__).parents[1] / "data" / "rig.toml").read_text()

AXIS = """
[axes.{name}]
from = {first}
to = {last}
points = {points}
"""


def axis(name, first, last, points):
    return AXIS.format(name=name, first=first, last=last, points=points)


def small_map(columns=40, rows=35, title="small map"):
    """Nine tiles, those at two edges cropped; all regimes except sustained contact occur."""
    return (RIG.format(kind="map", title=title)
            + axis("frequency_ratio", 0.5, 4.5, columns) + axis("gap_ratio", 0.0, 5.0, rows))


def small_curves(points=24):
    """Where regimes end, from few cells."""
    return (RIG.format(kind="curves", title="small curves")
            + axis("frequency_ratio", 0.5, 4.5, points) + axis("gap_ratio", 0.0, 5.0, points))


def map_of_steps(columns, rows):
    """Steps of 1/8 with 41 columns and 21 rows, of 1/4 with 21 and 11: exact in binary, so the maps share cells."""
    return (RIG.format(kind="map", title="steps")
            + axis("frequency_ratio", 0.5, 5.5, columns) + axis("gap_ratio", 0.0, 2.5, rows))


def larger_map():
    """400 tiles: long enough to be interrupted by a signal."""
    return small_map(columns=320, rows=320, title="larger map")


def medium_map():
    """64 tiles, 549 kB: to be damaged and repaired many times."""
    return small_map(columns=128, rows=128, title="medium map")


KELVIN_VOIGT = """law = "kelvin_voigt"
stiffness_n_per_m = 5.5e6
damping_ns_per_m = 1.2e3
"""


def with_rigid_stop(job):
    assert KELVIN_VOIGT in job
    return job.replace(KELVIN_VOIGT, 'law = "restitution"\ncoefficient = 0.5\n')


def small_basin(points=24):
    """Gap/A0 1.60 at 1.8 times the natural frequency, where impacts and no impact coexist."""
    return (RIG.format(kind="basin", title="small basin")
            + "[operating_point]\nfrequency_ratio = 1.8\ngap_ratio = 1.60\n"
            + axis("displacement_ratio", -3.0, 1.5, points) + axis("velocity_ratio", -4.0, 4.0, points))


def small_sweep(points=41, direction="both", gaps="[0.0, 1.5, 2.5]"):
    """Up and down at three gaps; a jump and hysteresis at the two larger ones."""
    return (RIG.format(kind="sweep", title="small sweep") + axis("frequency_ratio", 0.6, 2.6, points)
            + f'[sweep]\ngap_ratio = {gaps}\ndirection = "{direction}"\nsamples = 8\n')


def study(topic, settings="", axes=""):
    """A study on the same rig; settings are lines of [study], axes further tables."""
    return (RIG.format(kind="study", title="small study")
            + f'[study]\ntopic = "{topic}"\n{settings}\n{axes}')


def small_precision_study():
    return study("work_precision", "frequency_ratio = [2.0, 3.5]\ngap_ratio = [0.0, 0.3]\ncycles = 20\nrepeats = 1\n"
                 "tolerances = [1e-4, 1e-8]\nsteps_per_cycle = [2000, 8000]\n")


def small_label_study(points=9):
    return study("labels", "tolerances = [1e-3, 1e-7]\n",
                 axis("frequency_ratio", 0.5, 4.5, points) + axis("gap_ratio", 0.0, 5.0, points))


def stability_study():
    return study("stability", axes="[solver]\ntolerance = 1e-6\n")


def trace(frequency_ratio, gap_ratio=0.0, settings=""):
    """A trace on the same rig; settings are lines of [trace] and further tables."""
    return (RIG.format(kind="trace", title="small trace")
            + f"[operating_point]\nfrequency_ratio = {frequency_ratio}\ngap_ratio = {gap_ratio}\n"
            + f"[trace]\nsamples_per_cycle = 200\nspectrum_to_hz = 1000\n{settings}\n")


def trace_of(map_file, settings):
    """A trace of a cell of a map or basin file."""
    return f'schema = 1\nkind = "trace"\n[trace]\nmap = "{map_file}"\nsamples_per_cycle = 200\n{settings}\n'


def write(folder, text, name="job.toml"):
    path = folder / name
    path.write_text(text)
    return path
