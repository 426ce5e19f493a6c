"""Maps parameters to a rig's motion, leg by leg, and computes the residuals of recorded signals.

A leg is a stretch of a recording that begins with an impact, whose time and speed are its own parameters. A release is one
leg; a driven motion has several, so that small differences do not grow over a long leg; a single impact is also a leg, with
its own push by springs and cart. All legs share the rig.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..arrays import Integers, Reals
from .motion import MOST_IMPACTS, Cart, Motion, Rig, motion, next_touch
from .samples import Samples

SHARP = ("force", "acceleration")  # signals that are discontinuous at first touch
LEAST_NOISE = 1e-6  # of a signal's range
NO_RIG = 1e6  # in standard deviations: residual assigned to parameters without a valid rig
SLOW = 0.1  # a push during one impact: its phase angle over the contact
LATEST = 0.6  # a displacement's delay: of the springs' phase, some tenth of a period
# bounds on ln ki, zeta of the stop, ln omega and zeta of the springs, gap in swings, each relative to its first guess
LOWEST = {"stop_ratio": 0.0, "damping_ratio": -0.3, "gap": -3.0, "stiffness": -12.0, "omega": -6.0}
HIGHEST = {"stop_ratio": 50.0, "damping_ratio": 0.9, "gap": 30.0, "stiffness": 12.0, "omega": 6.0}


@dataclass(frozen=True)
class Leg:
    """`touch` [s] and `speed` [m/s] are first guesses for the impact with which the leg begins; `impacts`: number of its impacts.
    Undetected weak impacts are excluded: the motion continues without them, and samples after the first of them have no weight."""

    samples: Samples
    touch: float
    speed: float
    impacts: int = MOST_IMPACTS


@dataclass
class Problem:
    """mass [kg]; `scale` {parameter: SI value of which it is the logarithm over, or a multiple}, with "contact" [s]; `free`: which are fitted; `fixed`: the others as parameters, 0 where absent. `signs` and `noise` {signal: ...}; offsets are fitted as multiples of `ranges`. `pushed`: legs have a push each, beside one, mean_cos and mean_sin, that all have.
    `prior` {parameter: (mean, standard deviation)}."""

    mass: float
    legs: Sequence[Leg]
    scale: Mapping[str, float]
    free: Sequence[str]
    fixed: Mapping[str, float]
    signs: Mapping[str, int]
    offsets: Mapping[str, float]
    ranges: Mapping[str, float]
    noise: dict[str, float]
    step: float
    pushed: bool = False
    blind: float = 0.0  # s: samples this close to a touch have no weight
    unseen: Sequence[tuple[float, float]] = ()  # (begin, end) [s]: samples between them have no weight in any signal
    prior: dict[str, tuple[float, float]] = field(default_factory=dict)
    extra_noise: dict[str, float] = field(default_factory=dict)  # {signal: factor of its noise in contact}
    channels: Sequence[str] = ()  # parameters of errors of channels, see channels.py
    mains: float = 50.0  # Hz

    @property
    def names(self) -> list[str]:
        """Names of the signals."""
        return list(self.ranges)

    @property
    def parameters(self) -> list[str]:
        """Names of all parameters in their order."""
        offsets = [f"offset_{name}" for name in self.names]
        own = ["touch", "speed", *(["push_cos", "push_sin", *offsets] if self.pushed else [])]
        return [*self.free, *([] if self.pushed else offsets), *self.channels, *(f"{name} {leg}" for leg in range(len(self.legs)) for name in own)]

    def values(self, chosen: Reals) -> dict[str, float]:
        """{parameter: value}, including the fixed ones."""
        return {**self.fixed, **dict(zip(self.parameters, chosen))}

    def bounds(self) -> tuple[Reals, Reals]:
        """Lowest and highest values of the parameters."""
        names = [name.split()[0] for name in self.parameters]
        far = {"touch": 6.0, "speed": 3.0, "delay_displacement": LATEST / self.scale["omega"] / self.step,
               **{f"delay_{name}": self.scale["contact"] / self.step for name in SHARP}}
        return (np.array([LOWEST.get(name, -far.get(name, np.inf)) for name in names]),
                np.array([HIGHEST.get(name, far.get(name, np.inf)) for name in names]))

    def rig(self, value: Mapping[str, float]) -> Rig:
        """The rig of these values."""
        stiffness = self.scale["stiffness"] * np.exp(value["stiffness"])
        return Rig(self.mass, stiffness, 2 * value["stop_ratio"] * np.sqrt(stiffness * self.mass),
                   self.scale["omega"] * np.exp(value["omega"]), value["damping_ratio"], self.scale["gap"] * value["gap"])

    def motion(self, value: Mapping[str, float], number: int) -> Motion:
        """The motion of a leg."""
        leg, contact = self.legs[number], self.scale["contact"]
        cart = Cart()
        if self.pushed:
            omega = SLOW / contact
            push = self.scale["push"] * complex(value["mean_cos"] + value[f"push_cos {number}"],
                                                value["mean_sin"] + value[f"push_sin {number}"])
            cart = Cart(omega, push * np.exp(-1j * omega * leg.touch))
        return motion(self.rig(value), cart, leg.touch + contact * value[f"touch {number}"],
                      leg.speed * np.exp(value[f"speed {number}"]), leg.samples.until, leg.impacts)

    def known_until(self, moved: Motion, number: int) -> float:
        """The time [s] up to which a motion is valid: the first impact that its leg excludes."""
        if len(moved.touches) < self.legs[number].impacts or moved.pieces[-1].contact:
            return np.inf
        touch = next_touch(moved.rig, moved.cart, moved.pieces[-1], self.legs[number].samples.until)
        return np.inf if touch is None else touch

    def delay(self, value: Mapping[str, float], name: str) -> float:
        """The time [s] by which a signal is recorded late."""
        return self.step * value.get(f"delay_{name}", 0.0)

    def by_delay(self, value: Mapping[str, float]) -> dict[float, list[str]]:
        """{delay [s]: names of the signals that have it}."""
        found: dict[float, list[str]] = {}
        for name in self.names:
            found.setdefault(self.delay(value, name), []).append(name)
        return found

    def base(self, value: Mapping[str, float], number: int, name: str, begins: Reals, ends: Reals | None = None) -> Reals:
        """What a signal shows of a hammer at rest, at these times [s], or in the mean from them to `ends`: offset, drift and hum."""
        ends = begins if ends is None else ends
        own = f"offset_{name}{f' {number}' * self.pushed}"
        drift, cosine, sine = (value.get(f"{part}_{name}", 0.0) for part in ("drift", "hum_cos", "hum_sin"))
        level = value[own] + drift * (begins + ends) / (2 * self.legs[number].samples.until)
        if cosine or sine:
            omega = 2 * np.pi * (self.mains + value.get("hum_hertz", 0.0))
            phase, half = omega * 0.5 * (begins + ends), omega * 0.5 * (ends - begins)
            level = level + (cosine * np.cos(phase) + sine * np.sin(phase)) * np.sinc(half / np.pi)
        found: Reals = self.offsets[name] + self.ranges[name] * level
        return found

    def recorded(self, value: Mapping[str, float], number: int, moved: Motion, time: Reals, places: Mapping[str, Integers] | None = None
                 ) -> dict[str, Reals]:
        """{signal: values as recorded} of a motion at these ascending times [s]; `places` {signal: ...} as in Motion.signals()."""
        found = {}
        for late, names in self.by_delay(value).items():
            for name, values in moved.signals(time - late, names, None if places is None else places[names[0]]).items():
                found[name] = self.signs[name] * values + self.base(value, number, name, time)
        return found

    def recorded_means(self, value: Mapping[str, float], number: int, moved: Motion, begins: Reals, ends: Reals) -> dict[str, Reals]:
        """{signal: means of the values as recorded} of a motion from begins to ends [s], both ascending."""
        found = {}
        for late, names in self.by_delay(value).items():
            for name, means in moved.means(begins - late, ends - late, names).items():
                found[name] = self.signs[name] * means + self.base(value, number, name, begins, ends)
        return found

    def left(self, value: Mapping[str, float], number: int, places: Mapping[str, Integers] | None = None, moved: Motion | None = None
             ) -> tuple[dict[str, Reals], dict[str, Reals]]:
        """({signal: recorded minus model} for single samples, the same for means) of a leg."""
        samples, moved = self.legs[number].samples, moved or self.motion(value, number)
        singles = self.recorded(value, number, moved, samples.time, places)
        means = self.recorded_means(value, number, moved, samples.begins, samples.ends)
        return ({name: samples.values[name] - singles[name] for name in self.names},
                {name: samples.means[name] - means[name] for name in self.names})
