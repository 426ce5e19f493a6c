"""Small jobs of each kind over any two axes, with their coordinates as ratios or in SI units.

A coordinate is "frequency", "gap", "displacement" or "velocity"; a job is made by a function of a Unit, which writes its
keys and numbers. The rig is that of jobs.RIG, with the stop required by an axis of the stop.
"""

import itertools
import math
from dataclasses import dataclass

import jobs

HERTZ, METRES = 4.5, 0.89e-3
# for each coordinate: its two keys, and the value of ratio 1 in SI units
COORDINATES = {
    "frequency": ("frequency_ratio", "frequency_hz", HERTZ),
    "gap": ("gap_ratio", "gap_m", METRES),
    "displacement": ("displacement_ratio", "displacement_m", METRES),
    "velocity": ("velocity_ratio", "velocity_m_per_s", METRES * 2 * math.pi * HERTZ),
}


@dataclass(frozen=True)
class Unit:
    """The units of a job's coordinates: the named ones are in SI units."""

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


WITHOUT_PERIOD = (2, 4)  # regimes that rounding may change: chaotic, unresolved
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


def uncertain(unit):
    return ("[uncertainty]\nrigs = 20\n[uncertainty.hammer]\nnatural_frequency_hz = { relative = 0.01 }\n[uncertainty.cart]\n"
            "amplitude_m = { relative = 0.05 }\n[uncertainty.operating_point]\n"
            f"{unit.key('gap')} = {{ standard_deviation = {unit.number('gap', 0.03)!r} }}\n"
            f"{unit.key('frequency')} = {{ from = {unit.number('frequency', -0.02)!r}, to = {unit.number('frequency', 0.02)!r} }}\n")


def swept(unit, more=""):
    return (rig("sweep") + unit.axis("frequency", 1.5, 2.6, 12) + "[sweep]\nsamples = 8\n" + unit.line("gap", [0.5, 1.5]) + more)


# for each feature: its job text as a function of the unit
FEATURES = {
    "map": lambda unit: rig("map") + plane(unit) + start(unit),
    "map, rows and columns swapped": lambda unit: rig("map") + unit.axis("gap", 0, 2, 6) + unit.axis("frequency", 1, 3, 7),
    "map, logarithmic": lambda unit: rig("map") + unit.axis("frequency", 0.5, 4, 6) + 'scale = "log"\n' + unit.axis("gap", 0, 2, 6),
    "map, refined": lambda unit: rig("map") + plane(unit, 17) + "[refine]\nlevels = 2\n",
    "map with starts": lambda unit: rig("map") + plane(unit, 6) + start(unit) + starts(unit),
    "map with uncertain rigs": lambda unit: rig("map") + plane(unit, 5, (1.8, 2.4), (0.2, 1.0)) + start(unit) + uncertain(unit),
    "map with an audit": lambda unit: rig("map") + plane(unit, 5) + "[audit]\ncells = 5\n",
    "map with kicks": lambda unit: rig("map") + plane(unit, 2, (1.9, 2.1), (0.2, 0.4)) + '[output]\nfields = ["critical_kick"]\n',
    "map with borders": lambda unit: rig("map") + plane(unit, 12) + "[curves]\nmax_period = 1\n" + unit.line("gap", [1.5]),
    "basin": lambda unit: (rig("basin") + "[operating_point]\n" + unit.line("frequency", 1.8) + unit.line("gap", 1.6)
                           + unit.axis("displacement", -3, 1.5, 10) + unit.axis("velocity", -4, 4, 10)),
    "sweep": swept,
    "sweep with starts": lambda unit: swept(unit, start(unit) + starts(unit)),
    "curves": lambda unit: rig("curves") + plane(unit, 14) + "[curves]\nmax_period = 1\nedge_distance = true\n" + unit.line("gap", [1.5]),
    "curves, rows and columns swapped": lambda unit: (rig("curves") + unit.axis("gap", 0, 2, 14) + unit.axis("frequency", 1, 3, 14)
                                                      + "[curves]\nmax_period = 1\n" + unit.line("gap", [1.5])),
    "trace": lambda unit: (rig("trace") + "[operating_point]\n" + unit.line("frequency", 2.0) + unit.line("gap", 0.5) + start(unit)
                           + "[trace]\nsamples_per_cycle = 50\nspectrum_to_hz = 100\n"),
    "study of precision": lambda unit: (rig("study") + '[study]\ntopic = "work_precision"\n' + unit.line("frequency", [2.0, 3.5])
                                        + unit.line("gap", [0.0, 0.3]) + "cycles = 5\nrepeats = 1\ntolerances = [1e-6]\n"
                                        "steps_per_cycle = [1000]\n"),
    "study of labels": lambda unit: rig("study") + '[study]\ntopic = "labels"\ntolerances = [1e-5]\n' + plane(unit, 3),
}

# For each axis: its key (a coordinate if it has two units); its ends; number of points; the law of its stop. The value of
# ratio 1 in SI units varies along some of them: their middle point is the rig's own.
@dataclass(frozen=True)
class Along:
    key: str
    first: float
    last: float
    points: int
    law: str = ""


MASS, SPRING = 0.298, 0.298 * (2 * math.pi * HERTZ)**2
AXES = {
    "frequency": Along("frequency", 1.6, 1.9, 4),
    "gap": Along("gap", 0.9, 1.6, 3),
    "displacement of the start": Along("displacement", -2.0, 0.25, 4),
    "velocity of the start": Along("velocity", -2.0, 2.0, 3),
    "amplitude": Along("cart.amplitude_m", 0.69e-3, 1.09e-3, 3),
    "natural frequency": Along("hammer.natural_frequency_hz", 4.0, 5.0, 3),
    "spring": Along("hammer.stiffness_n_per_m", 0.8 * SPRING, 1.2 * SPRING, 3),
    "mass": Along("hammer.mass_kg", 0.248, 0.348, 3),
    "damping ratio": Along("hammer.damping_ratio", 0.002, 0.01, 3),
    "cubic spring": Along("hammer.cubic_stiffness_n_per_m3", 0.0, 240.0, 4),
    "stop's stiffness": Along("contact.stiffness_n_per_m", 3e6, 9e6, 3, "kelvin_voigt"),
    "stop's damping": Along("contact.damping_ns_per_m", 500.0, 1500.0, 4, "kelvin_voigt"),
    "restitution": Along("contact.coefficient", 0.2, 0.4, 3, "restitution"),
    "dissipation of the stop": Along("contact.dissipation_s_per_m", 0.2, 0.8, 3, "hunt_crossley"),
}
STOPS = {
    "": jobs.KELVIN_VOIGT, "kelvin_voigt": jobs.KELVIN_VOIGT, "restitution": 'law = "restitution"\ncoefficient = 0.3\n',
    "hunt_crossley": 'law = "hunt_crossley"\nstiffness_n_per_m_pow_n = 1e8\nexponent = 1.5\ndissipation_s_per_m = 0.5\n',
}
CURVES_REFUSED = {
    "displacement of the start": "a curve is where motions end, wherever the hammer starts",
    "velocity of the start": "a curve is where motions end, wherever the hammer starts",
    "cubic spring": "curves leave the cubic part of the springs out",
    "dissipation of the stop": "they rest on the closed form of the motion, which a nonlinear stop has not",
}
ANOTHER_LAW = "the stop of this job has another law"
NEVER_BOTH = [  # axes that no map combines, and why
    ("natural frequency", "spring", "says the same as"), ("restitution", "stop's damping", ANOTHER_LAW),
    ("stop's stiffness", "restitution", ANOTHER_LAW), ("dissipation of the stop", "restitution", ANOTHER_LAW),
    ("dissipation of the stop", "stop's damping", ANOTHER_LAW), ("dissipation of the stop", "stop's stiffness", ANOTHER_LAW),
]
PAIRS = [pair if n % 2 else pair[::-1] for n, pair in enumerate(itertools.combinations(AXES, 2))
         if not any(set(pair) == {one, other} for one, other, _ in NEVER_BOTH)]
# near the fold of 1/1, slightly below it, from a start that leads to 1/1: motions end within these axes
PLACE = {"frequency": 1.86, "gap": 1.5, "displacement": -1.0, "velocity": 2.0}


def changes_units(axes):
    """The axes along which the value of ratio 1 in Hz, m or m/s varies."""
    return [name for name in axes if name in ("amplitude", "natural frequency", "spring") or (name == "mass" and "spring" in axes)]


def over(kind, axes, unit, finer=1, more=""):
    """A job over these axes; all else is at PLACE, in the unit. `finer`: refinement factor along each axis."""
    law = next((AXES[name].law for name in axes if AXES[name].law), "")
    text = rig(kind).replace(jobs.KELVIN_VOIGT, STOPS[law])
    for name in axes:
        along, table = AXES[name], "start." if "start" in name else ""
        points = finer * (along.points - 1) + 1
        text += (unit.axis(along.key, along.first, along.last, points, table) if along.key in COORDINATES
                 else jobs.axis(along.key, repr(along.first), repr(along.last), points))
    taken = {AXES[name].key for name in axes}
    lines = {name: unit.line(name, value) for name, value in PLACE.items() if name not in taken}
    for table, names in (("operating_point", ("frequency", "gap")), ("start", ("displacement", "velocity"))):
        given = "".join(lines.get(name, "") for name in names if not (kind == "sweep" and name == "gap"))
        text += f"[{table}]\n{given}" if given else ""
    if kind == "sweep":
        text += "[sweep]\nsamples = 4\n" + ("" if "gap" in taken else unit.line("gap", [0.5, 1.5]))
    return text + more


def free_swing(unit, along):
    """Distance of the stop from the steady oscillation without it, over A0; `along`: {coordinate of the picture: values}."""
    def of(name, scale):
        ratio, si, own = COORDINATES[name]
        if ratio in along:
            return along[ratio]
        in_si = along[si] if si in along else PLACE[name] * own if name in unit.in_si else None
        return PLACE[name] if in_si is None else in_si / scale

    mass, metres = along.get("hammer_mass_kg", MASS), along.get("cart_amplitude_m", METRES)
    spring = along.get("hammer_stiffness_n_per_m")
    hertz = along.get("hammer_natural_frequency_hz", HERTZ) if spring is None else (spring / mass)**0.5 / (2 * math.pi)
    eta, damping = of("frequency", hertz), along.get("hammer_damping_ratio", 0.06 / (4 * math.pi * mass * hertz))
    return of("gap", metres) - eta**2 / ((1 - eta**2)**2 + (2 * damping * eta)**2)**0.5


def curves_over(axes, unit):
    gaps = unit.line("gap", [1.0, 1.5]) if "gap" in axes else ""
    return over("curves", axes, unit, 2, "[curves]\nmax_period = 1\nedge_distance = true\n" + gaps)


# for each meaningless combination: its job text, and the reported reason; axes in either unit
REFUSALS = {
    **{f"curves over the {name}": (lambda unit, name=name: over("curves", ("frequency", name), unit, 2), reason)
       for name, reason in CURVES_REFUSED.items()},
    **{f"{one} and {other}": (lambda unit, axes=(one, other): over("map", axes, unit), reason)
       for one, other, reason in NEVER_BOTH},
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
                            "studies have the plane of frequency and gap"),
}
