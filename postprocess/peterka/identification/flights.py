"""Springs and gap from when impacts come and how fast they are: least squares of events alone, which find the way from far off.

A free flight that leaves the gap at speed w and comes back after T has omega T = 2 pi - 2 atan2(w, omega gap).
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from .motion import Cart, Rig, motion
from .starts import Begin

ANGLES = np.pi * np.linspace(0.6, 1.98, 24)  # omega T of flights that are tried: below pi the springs press against the stop
LEAST_TIME, LEAST_SPEED = 1e-3, 1e-3  # errors of events, in contacts and relative, that aren't believed
NOT_THERE = 30.0  # standard deviations by which an impact is off that doesn't come at all
FIRST = {"omega": (0.0, 1.5), "damping_ratio": (0.01, 0.05), "gap": (0.0, 3.0)}  # mean and standard deviation of what isn't given
NAMES = ("stiffness", "stop_ratio", "touch", "speed", "omega", "damping_ratio", "gap")


@dataclass(frozen=True)
class Start:
    """`value` {parameter as in NAMES: ki over the first guess's logarithm, touch in contacts, ...}, for springs of this `omega` [rad/s] and a
    `swing` [m] in which the gap is told; `cost` of the events."""

    omega: float
    swing: float
    value: Mapping[str, float]
    cost: float


def from_events(begun: Begin, mass: float, given: Mapping[str, float]) -> list[Start]:
    """The Starts that fit the impacts' times and speeds, the best first; none where there are fewer than two impacts."""
    if len(begun.impacts) < 2 or begun.alone is None:
        return []
    found = []
    flight = begun.impacts[1].touch - begun.impacts[0].touch - begun.contact
    speed = begun.impacts[1].speed  # as fast as it left
    for omega in [given["omega"]] if "omega" in given else ANGLES / flight:
        swing = begun.impacts[0].speed / omega
        gap = given.get("gap", speed / (omega * np.tan(np.pi - omega * flight / 2)))
        found.append(_solved(begun, mass, given, omega, swing, gap / swing))
    return sorted(found, key=lambda one: one.cost)


def _solved(begun, mass, given, omega, swing, gap):
    first, impacts = begun.impacts[0], begun.impacts[:len(begun.alone.problem.legs)]
    until = impacts[-1].touch + 0.3 * (impacts[-1].touch - first.touch)
    errors = [(max(begun.alone.error(f"touch {at}"), LEAST_TIME), max(begun.alone.error(f"speed {at}"), LEAST_SPEED))
              for at in range(len(impacts))]
    free = [name for name in NAMES if name not in given]
    fixed = {"gap": given.get("gap", 0.0) / swing, "omega": 0.0, "damping_ratio": given.get("damping_ratio", 0.0)}
    before = {**FIRST, "stiffness": (0.0, max(begun.alone.error("stiffness"), 0.01)),
              "stop_ratio": (begun.stop_ratio, max(begun.alone.error("stop_ratio"), 0.01)), "omega": (0.0, 1.5)}

    def off(chosen):
        value = {**fixed, **dict(zip(free, chosen))}
        stiffness = begun.stiffness * np.exp(value["stiffness"])
        rig = Rig(mass, stiffness, 2 * abs(value["stop_ratio"]) * np.sqrt(stiffness * mass), omega * np.exp(value["omega"]),
                  value["damping_ratio"], swing * value["gap"])
        touch = first.touch + begun.contact * value["touch"]
        moved = motion(rig, Cart(), touch, first.speed * np.exp(value["speed"]), until, len(impacts))
        touches = [piece for piece in moved.pieces if piece.contact]
        rows = [(value[name] - mean) / deviation for name, (mean, deviation) in before.items() if name in free]
        for impact, (time, speed), piece in zip(impacts, errors, touches):
            rows += [(piece.begin - impact.touch) / (begun.contact * time),
                     np.log(max(piece.at(piece.begin)[1], 1e-9) / impact.speed) / speed]
        return np.clip([*rows, *[NOT_THERE] * (2 * (len(impacts) - len(touches)))], -1e6, 1e6)

    begin = {"stop_ratio": begun.stop_ratio, "damping_ratio": 0.01, "gap": gap}
    lower = [{"stop_ratio": 0.0, "damping_ratio": -0.2, "gap": -3.0}.get(name, -3.0) for name in free]
    upper = [{"stop_ratio": 50.0, "damping_ratio": 0.5, "gap": 30.0}.get(name, 3.0) for name in free]
    answer = least_squares(off, np.clip([begin.get(name, 0.0) for name in free], lower, upper), bounds=(lower, upper), diff_step=1e-6,
                           x_scale="jac", loss="soft_l1", max_nfev=60)
    return Start(omega, swing, {**fixed, **dict(zip(free, answer.x))}, float(answer.cost))
