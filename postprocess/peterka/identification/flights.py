"""Springs and gap from the times and speeds of impacts, by scanning: without time stepping or an initial guess.

A flight from u0 with velocity -w reaches u0 A(s) - w B(s) after time s, where, with theta = omega sqrt(1 - zeta^2) s,
A = exp(-zeta omega s) (cos theta + zeta/sqrt(1 - zeta^2) sin theta),
B = exp(-zeta omega s) sin theta/(omega sqrt(1 - zeta^2)).
It begins where the stop's force falls to 0, at u0 = gap + ci w/ki, and ends at the gap: the first flight's duration gives the gap for
any springs; the durations and speeds of further flights, each from the end of the previous one, determine the springs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from ..arrays import Reals
from .contact_pulse import identified
from .starts import Begin

ANGLES = np.pi * np.linspace(0.6, 1.99, 1200)  # omega T of the first flight: below pi the springs are preloaded against the stop
RATIOS = np.concatenate([[0.0], np.geomspace(5e-4, 0.3, 60)])  # damping ratios of the springs
STARTS = 12  # initial values for least squares
FAR = 3.0  # bound on their steps: this many times APART, and standard deviations
APART = 0.02  # relative difference of distinct omegas
LEAST_TIME, LEAST_SPEED = 0.02, 0.02  # lower bounds on errors of events: in contacts, and relative
MOST_BACK = 0.4  # relative error of a restitution that few samples tell, at most: it is within a factor of about 3 of any
BACKS = (0.0, -1.0, 1.0, -2.0, 2.0)  # standard deviations: restitutions tried where it is told less well than LEAST_SPEED
TIMES, UNLIKELY = 10.0, 1e-3  # of likely starts: cost over the best one's, or likelihood over its, whichever keeps more
LOST = 30.0  # standard deviations, beyond which larger deviations cost no more


@dataclass(frozen=True)
class Start:
    """`value` {parameter: initial value}, for springs of this `omega` [rad/s] and a `swing` [m] that scales the gap; `cost`
    of the events, infinite if they do not determine it."""

    omega: float
    swing: float
    value: Mapping[str, float]
    cost: float


def from_events(begun: Begin, mass: float, given: Mapping[str, float]) -> list[Start]:
    """The Starts that fit the impacts' times and speeds, the best first; none for fewer than two impacts."""
    if len(begun.impacts) < 2 or begun.alone is None:
        return []
    first, second = begun.impacts[:2]
    flight = second.touch - first.touch - begun.contact
    if not flight > 0:
        return []
    omegas = np.array([given["omega"]]) if "omega" in given else ANGLES / flight
    ratios = np.array([given["damping_ratio"]]) if "damping_ratio" in given else RATIOS
    lag = 2 * begun.stop_ratio * np.sqrt(mass / begun.stiffness)
    off = _Off(begun, lag, given.get("gap"))
    omega, ratio = (grid.ravel() for grid in np.meshgrid(omegas, ratios, indexing="ij"))
    with np.errstate(all="ignore"):  # for springs that do not bring the hammer back
        omega, ratio, back = (grid.ravel() for grid in np.broadcast_arrays(omega, ratio, off.backs()[:, None]))
        cost = np.sum(np.square(np.nan_to_num(off(omega, ratio, back)[0], nan=LOST).clip(-LOST, LOST)), axis=0)
        found: list[Start] = []
        tried: list[float] = []
        for at in np.argsort(cost):
            if all(abs(np.log(omega[at] / one)) > APART for one in tried):
                tried.append(omega[at])
                found.append(_nearest(off, first.speed, (omega[at], ratio[at], back[at]), given))
            if len(tried) == STARTS:
                break
    kept: list[Start] = []
    for one in sorted(found, key=lambda one: one.cost):
        if all(abs(np.log(one.omega / other.omega)) > 0.5 * APART for other in kept):
            kept.append(one)
    return kept


def likely(found: Sequence[Start]) -> list[Start]:
    """Those of Starts, the best first, that may be the recording's: two rigs may meet the same impacts, and the best here isn't always
    the best in the samples."""
    return [one for one in found if one.cost <= max(TIMES * found[0].cost, found[0].cost - np.log(UNLIKELY))]


def _nearest(off: "_Off", speed: float, begin: tuple[float, float, float], given: Mapping[str, float]) -> Start:
    """The Start found by least squares from this omega, damping ratio, and restitution in standard deviations from the stop's."""
    omega, ratio, back = begin

    def left(chosen: Reals) -> Reals:
        values: Reals = np.nan_to_num(off(*springs(chosen), chosen[2])[0], nan=LOST).clip(-LOST**2, LOST**2)
        return values

    def springs(chosen: Reals) -> tuple[float, float]:
        return (omega if "omega" in given else omega * np.exp(APART * chosen[0]),
                ratio if "damping_ratio" in given else abs(ratio + APART * chosen[1]))

    answer = least_squares(left, np.array([0.0, 0.0, back]), loss="soft_l1", bounds=(-FAR, FAR))
    omega_there, ratio_there = springs(answer.x)
    swing = speed / omega_there
    gap = given.get("gap", off(omega_there, ratio_there, answer.x[2])[1])
    # The stop goes with the springs: at another restitution these don't meet the later impacts.
    stiffness, damping = identified(1.0, min(off.restitution(answer.x[2]), 1.0), 1.0)
    return Start(float(omega_there), float(swing), {"damping_ratio": float(ratio_there), "gap": float(gap / swing),
                                                    "stop_ratio": 0.5 * damping / np.sqrt(stiffness)}, float(answer.cost))


@dataclass(frozen=True)
class _Off:
    """`lag`: ci/ki [s]."""

    begun: Begin
    lag: float
    told_gap: float | None

    @property
    def spread(self) -> float:
        """Relative standard deviation of the restitution."""
        return min(max(self.begun.restitution_error, LEAST_SPEED), MOST_BACK)

    def backs(self) -> Reals:
        """Restitutions that are tried, in standard deviations from the stop's."""
        return np.array(BACKS if self.spread > LEAST_SPEED else BACKS[:1])

    def restitution(self, back: Any) -> Any:
        """The restitution raised by this many standard deviations."""
        return np.minimum(self.begun.restitution * np.exp(self.spread * back), 1.0)

    def __call__(self, omega: Any, ratio: Any, back: Any) -> tuple[Any, Any]:
        """([deviations, in standard deviations], gap [m]) for these springs and a restitution raised by this many standard deviations."""
        impacts, gap, rows = self.begun.impacts, None, [back + 0 * omega]
        restitution = self.restitution(back)
        speed = impacts[0].speed + 0 * omega
        least = max(LEAST_TIME, self.begun.contact_error) * self.begun.contact
        for before, after in zip(impacts, impacts[1:]):
            leaving = restitution * speed
            a, b, a_rate, b_rate = _flight(omega, ratio, after.touch - before.touch - self.begun.contact)
            if gap is None:
                gap = leaving * (b - self.lag * a) / (a - 1)
                if self.told_gap is not None:
                    rows.append((gap - self.told_gap) * omega / (impacts[0].speed * LEAST_SPEED))
            place = (gap + self.lag * leaving) * a - leaving * b
            speed = (gap + self.lag * leaving) * a_rate - leaving * b_rate
            late = (gap - place) / speed
            rows.append(late / max(after.touch_error, before.touch_error, least))
            rows.append(np.log(speed / after.speed) / max(after.speed_error, LEAST_SPEED))
        return np.array(rows), gap


def _flight(omega: Reals | float, ratio: Reals | float, since: float) -> tuple[Any, Any, Any, Any]:
    """A, B and their derivatives."""
    decay, swinging = np.exp(-ratio * omega * since), omega * np.sqrt(1 - ratio**2)
    cosine, sine = decay * np.cos(swinging * since), decay * np.sin(swinging * since) / swinging
    return cosine + ratio * omega * sine, sine, -omega**2 * sine, cosine - ratio * omega * sine
