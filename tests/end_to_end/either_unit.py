"""One small job of each kind and feature, with its coordinates as ratios or in SI units.

A coordinate is "frequency", "gap", "displacement" or "velocity"; a job is made by a function of a Unit, which writes its keys and
numbers. The rig is that of jobs.RIG.
"""

import math
from dataclasses import dataclass

import jobs

HERTZ, METRES = 4.5, 0.89e-3
# of each coordinate: its two keys, and what a ratio of 1 is in SI units
COORDINATES = {
    "frequency": ("frequency_ratio", "frequency_hz", HERTZ),
    "gap": ("gap_ratio", "gap_m", METRES),
    "displacement": ("displacement_ratio", "displacement_m", METRES),
    "velocity": ("velocity_ratio", "velocity_m_per_s", METRES * 2 * math.pi * HERTZ),
}


@dataclass(frozen=True)
class Unit:
    """In which the coordinates of a job are given: those named are in SI units."""

    in_si: tuple = ()

    def key(self, name):
        return COORDINATES[name][name in self.in_si]

    def number(self, name, ratio):
        return ratio * COORDINATES[name][2] if name in self.in_si else ratio

    def line(self, name, ratio):
        value = [self.number(name, each) for each in ratio] if isinstance(ratio, list) else self.number(name, ratio)
        return f"{self.key(name)} = {value!r}\n"

    def axis(self, name, first, last, points, table=""):
        return jobs.axis(table + self.key(name), repr(float(self.number(name, first))), repr(float(self.number(name, last))), points)


RATIOS = Unit()
SI = Unit(tuple(COORDINATES))
MIXED = Unit(("frequency", "velocity"))


def rig(kind):
    return jobs.RIG.format(kind=kind, title=kind)


def plane(unit, points=9, frequency=(1.0, 3.0), gap=(0.0, 2.0)):
    return unit.axis("frequency", *frequency, points) + unit.axis("gap", *gap, points)


def start(unit):
    return "[start]\n" + unit.line("displacement", -0.25) + unit.line("velocity", 0.5)


def starts(unit):
    return "[starts]\ncount = 6\n" + unit.line("displacement", [-3.0, 0.5]) + unit.line("velocity", [-2.0, 3.0])


def swept(unit, more=""):
    return (rig("sweep") + unit.axis("frequency", 1.5, 2.6, 12) + "[sweep]\nsamples = 8\n" + unit.line("gap", [0.5, 1.5]) + more)


# of each feature: the text of its job in a unit
FEATURES = {
    "map": lambda unit: rig("map") + plane(unit) + start(unit),
    "map, rows and columns swapped": lambda unit: rig("map") + unit.axis("gap", 0, 2, 6) + unit.axis("frequency", 1, 3, 7),
    "map, logarithmic": lambda unit: rig("map") + unit.axis("frequency", 0.5, 4, 6) + 'scale = "log"\n' + unit.axis("gap", 0, 2, 6),
    "map, refined": lambda unit: rig("map") + plane(unit, 17) + "[refine]\nlevels = 2\n",
    "map with starts": lambda unit: rig("map") + plane(unit, 6) + start(unit) + starts(unit),
    "map with an audit": lambda unit: rig("map") + plane(unit, 5) + "[audit]\ncells = 5\n",
    "map with kicks": lambda unit: rig("map") + plane(unit, 2, (1.9, 2.1), (0.2, 0.4)) + '[output]\nfields = ["critical_kick"]\n',
    "map with borders": lambda unit: rig("map") + plane(unit, 12) + "[curves]\nmax_period = 1\n" + unit.line("gap", [1.5]),
    "map over a damper": lambda unit: (rig("map") + jobs.axis("contact.damping_ns_per_m", 500.0, 1500.0, 5) + unit.axis("gap", 0, 2, 6)
                                       + "[operating_point]\n" + unit.line("frequency", 1.8)),
    "map over starts": lambda unit: (rig("map") + unit.axis("displacement", -2, 0.5, 6, "start.") + unit.axis("velocity", -2, 2, 6, "start.")
                                     + "[operating_point]\n" + unit.line("frequency", 1.8) + unit.line("gap", 1.0)),
    "map over the amplitude": lambda unit: (rig("map") + unit.axis("frequency", 1, 3, 6) + jobs.axis("cart.amplitude_m", METRES, METRES, 1)
                                            + "[operating_point]\n" + unit.line("gap", 1.0)),
    "basin": lambda unit: (rig("basin") + "[operating_point]\n" + unit.line("frequency", 1.8) + unit.line("gap", 1.6)
                           + unit.axis("displacement", -3, 1.5, 10) + unit.axis("velocity", -4, 4, 10)),
    "sweep": swept,
    "sweep with starts": lambda unit: swept(unit, start(unit) + starts(unit)),
    "sweep along the gap": lambda unit: (rig("sweep") + unit.axis("gap", 0.5, 2, 8) + '[sweep]\ndirection = "up"\nsamples = 4\n'
                                         + "[operating_point]\n" + unit.line("frequency", 2.0)),
    "sweep along the damper": lambda unit: (rig("sweep") + jobs.axis("contact.damping_ns_per_m", 500.0, 1500.0, 8)
                                            + "[sweep]\nsamples = 4\n" + unit.line("gap", [0.5, 1.0])
                                            + "[operating_point]\n" + unit.line("frequency", 2.0)),
    "curves": lambda unit: rig("curves") + plane(unit, 14) + "[curves]\nmax_period = 1\nedge_distance = true\n" + unit.line("gap", [1.5]),
    "curves, rows and columns swapped": lambda unit: (rig("curves") + unit.axis("gap", 0, 2, 14) + unit.axis("frequency", 1, 3, 14)
                                                      + "[curves]\nmax_period = 1\n" + unit.line("gap", [1.5])),
    "curves over a damper": lambda unit: (rig("curves") + jobs.axis("contact.damping_ns_per_m", 500.0, 1500.0, 10)
                                          + unit.axis("gap", 0.5, 2, 10) + "[curves]\nmax_period = 1\n" + unit.line("gap", [1.5])
                                          + "[operating_point]\n" + unit.line("frequency", 1.8)),
    "trace": lambda unit: (rig("trace") + "[operating_point]\n" + unit.line("frequency", 2.0) + unit.line("gap", 0.5) + start(unit)
                           + "[trace]\nsamples_per_cycle = 50\nspectrum_to_hz = 100\n"),
    "study of precision": lambda unit: (rig("study") + '[study]\ntopic = "work_precision"\n' + unit.line("frequency", [2.0, 3.5])
                                        + unit.line("gap", [0.0, 0.3]) + "cycles = 5\nrepeats = 1\ntolerances = [1e-6]\n"
                                        "steps_per_cycle = [1000]\n"),
    "study of labels": lambda unit: rig("study") + '[study]\ntopic = "labels"\ntolerances = [1e-5]\n' + plane(unit, 3),
}

# of each combination that means nothing: the text of its job, and the reason that is told; axes in either unit
REFUSALS = {
    "curves over starts": (lambda unit: rig("curves") + unit.axis("frequency", 1, 3, 5) + unit.axis("displacement", -2, 1, 5, "start.")
                           + "[operating_point]\n" + unit.line("gap", 1.0), "a curve is where motions end, wherever the hammer starts"),
    "curves over the cubic spring": (lambda unit: (rig("curves") + unit.axis("frequency", 1, 3, 5)
                                                   + jobs.axis("hammer.cubic_stiffness_n_per_m3", 0, 1, 5)
                                                   + "[operating_point]\n" + unit.line("gap", 1.0)),
                                     "curves leave the cubic part of the springs out"),
    "borders of a map over starts": (lambda unit: (rig("map") + unit.axis("gap", 1, 3, 5) + unit.axis("velocity", -2, 1, 5, "start.")
                                                   + "[curves]\n" + unit.line("gap", [1.5])
                                                   + "[operating_point]\n" + unit.line("frequency", 2.0)),
                                     "a curve is where motions end, wherever the hammer starts"),
    "borders without an axis of the gap": (lambda unit: (rig("curves") + unit.axis("frequency", 1, 3, 5)
                                                         + jobs.axis("contact.damping_ns_per_m", 500, 900, 5)
                                                         + "[curves]\n" + unit.line("gap", [1.5]) + "[operating_point]\n"
                                                         + unit.line("gap", 1.5)), "no axis runs over the gap"),
    "a basin over the gap": (lambda unit: (rig("basin") + "[operating_point]\n" + unit.line("frequency", 1.8) + unit.line("gap", 1.6)
                                           + unit.axis("gap", 0, 1, 4) + unit.axis("velocity", -1, 1, 4)),
                             "a basin is drawn at one place"),
    "a map over the starts of a basin": (lambda unit: (rig("map") + unit.axis("displacement", -1, 0, 4) + unit.axis("velocity", -1, 1, 4)),
                                         "is an axis of a basin"),
    "a sweep along the gap with a list of gaps": (lambda unit: (rig("sweep") + unit.axis("gap", 0, 1, 4) + "[sweep]\n"
                                                                + unit.line("gap", [0.5]) + "[operating_point]\n"
                                                                + unit.line("frequency", 2.0)), "is what the axis runs over"),
    "a study over starts": (lambda unit: (rig("study") + '[study]\ntopic = "labels"\ntolerances = [1e-5]\n'
                                          + unit.axis("frequency", 1, 2, 3) + unit.axis("velocity", 1, 2, 3, "start.")),
                            "studies have the plane of frequency_ratio and gap_ratio"),
}
