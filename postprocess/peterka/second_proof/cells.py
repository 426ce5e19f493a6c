"""What a map claims of its periodic cells, and what becomes of each claim: confirmed, not decided, or contradicted."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from .balls import Ball, Undecided, one, pi, zero
from .guessing import guess_of
from .motion import Rig
from .shooting import BOUNCE, TOUCH, Guess, Orbit, growth_of, prove

CONFIRMED, NOT_DECIDED, CONTRADICTED = "confirmed", "not decided", "contradicted"
MOST_GROWTH = {False: 400, True: 130}  # bits that balls may lose on the way, without and with the cubic spring, which costs more
SAME_PLACE = 0.02  # of 1 + its size: how far an orbit may lie from a state in which an engine left the cubic spring out


@dataclass(frozen=True)
class Claim:
    """p, q, the state at phase 0 as (x - y)/A0 and (x' - y')/(A0 omega), bounds of the largest F/(m g0) or, of a rigid stop, impact speed
    [m/s], and the margin of stability."""

    impacts: int
    period: int
    displacement: float
    velocity: float
    lower: float
    upper: float
    stability_margin: float


@dataclass(frozen=True)
class Verdict:
    """What became of a claim: CONFIRMED, NOT_DECIDED or CONTRADICTED, and why it isn't the first."""
    word: str
    why: str = ""


def rig_of(numbers: Mapping[str, Any]) -> Rig:
    """The equation's numbers, from doubles that are taken as exact; of two keys for the same one is given."""
    def ball(name: str, absent: float | None = None) -> Ball:
        return Ball.of(float(numbers[name] if absent is None else numbers.get(name, absent)))

    mass, amplitude, natural = ball("hammer.mass_kg"), ball("cart.amplitude_m"), "hammer.natural_frequency_hz"
    omega = pi().times(2) * ball(natural) if natural in numbers else (ball("hammer.stiffness_n_per_m") / mass).sqrt()
    stiffness, impedance, rigid = mass * omega * omega, mass * omega, numbers.get("contact.law") == "restitution"
    place, cubic = "operating_point.", "hammer.cubic_stiffness_n_per_m3"
    return Rig(
        frequency=ball(place + "frequency_ratio", 0) + pi().times(2) * ball(place + "frequency_hz", 0) / omega,
        damping_ratio=ball("hammer.damping_ratio", 0) + ball("hammer.damping_ns_per_m", 0) / impedance.times(2),
        stiffness=zero() if rigid else ball("contact.stiffness_n_per_m") / stiffness,
        damping=zero() if rigid else ball("contact.damping_ns_per_m") / impedance,
        gap=ball(place + "gap_ratio", 0) + ball(place + "gap_m", 0) / amplitude,
        cubic=ball(cubic) * amplitude * amplitude / stiffness if numbers.get(cubic) else zero(),
        absolute=numbers.get("hammer.cubic") == "absolute",
        unit=omega * amplitude if rigid else omega * omega * amplitude / (Ball.of(980665) / Ball.of(100000)),
        restitution=ball("contact.coefficient") if rigid else None)


def verdict_of(numbers: Mapping[str, Any], claim: Claim) -> Verdict:
    """Proves the cell's orbit anew, and compares."""
    Ball.bits = 160
    try:
        rig = rig_of(numbers)
        guess = guess_of(rig, claim.displacement, claim.velocity, claim.period)
        growth = growth_of(rig, guess)
        if growth > MOST_GROWTH[rig.cubic.size > 0]:
            raise Undecided("contacts too long for this program")
        Ball.bits = 120 + 2 * growth
        rig = rig_of(numbers)
        return _compared(claim, rig, guess, prove(rig, guess))
    except (Undecided, ArithmeticError, ValueError) as reason:
        return Verdict(NOT_DECIDED, str(reason))


def _compared(claim: Claim, rig: Rig, guess: Guess, orbit: Orbit) -> Verdict:
    u, w = orbit.stops[float(claim.period)]
    near = SAME_PLACE if rig.cubic.size else 1e-6
    if any(abs(float(found) - told) > near * (1 + abs(told)) for found, told in ((u, claim.displacement), (w / rig.turn(), claim.velocity))):
        return Verdict(NOT_DECIDED, "the orbit found isn't the cell's")
    for part in (part for part in range(1, claim.period) if claim.period % part == 0):
        if not any(x.apart(y) for x, y in zip(orbit.stops[guess.time + part], orbit.start, strict=True)):
            _show_shorter(rig, guess, orbit, part)
            return Verdict(CONTRADICTED, f"it repeats itself after {part} cycles")
    impacts = sum(event in (TOUCH, BOUNCE) for _, event in guess.events)
    if impacts != claim.impacts:
        return Verdict(CONTRADICTED, f"it touches the stop {impacts} times, not {claim.impacts}")
    trace, determinant = orbit.trace, orbit.determinant
    margins = one() - determinant, one() + determinant - trace, one() + determinant + trace
    if any(margin.high < 0 for margin in margins):
        return Verdict(CONTRADICTED, "it is unstable")
    if any(margin.low <= 0 for margin in margins):
        raise Undecided("a multiplier that can't be told from the unit circle")
    if min(margin.high for margin in margins) < Ball.of(claim.stability_margin).low:
        return Verdict(CONTRADICTED, "it is less stable")
    largest = orbit.force * rig.unit
    if largest.apart(Ball.between(Ball.of(claim.lower).low, Ball.of(claim.upper).high)):
        name, unit = ("force", "weights") if rig.restitution is None else ("impact speed", "m/s")
        return Verdict(CONTRADICTED, f"its largest {name} is {float(largest):.15g} {unit}")
    return Verdict(CONFIRMED)


def _show_shorter(rig: Rig, guess: Guess, orbit: Orbit, period: int) -> None:
    """That the only orbit of period q is one of this smaller period; raises Undecided."""
    events = [event for event in guess.events if event[0] < guess.time + period]
    shorter = prove(rig, replace(guess, period=period, events=events))
    if not all(whole.holds(part) for whole, part in zip(orbit.box, shorter.start, strict=True)):
        raise Undecided("it may have a shorter period")
