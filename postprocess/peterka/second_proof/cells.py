"""What a map claims of its periodic cells, and what becomes of each claim: confirmed, not decided, or contradicted."""

from __future__ import annotations

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
ALTERNATIVES = {"frequency_hz": "frequency_ratio", "gap_m": "gap_ratio", "natural_frequency_hz": "stiffness_n_per_m",
                "damping_ratio": "damping_ns_per_m"}


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


def numbers_of_cell(tables: Mapping[str, Any], axes: Mapping[str, float]) -> dict[str, Any]:
    """The numbers of a cell as the job and its axes, {"contact.damping_ns_per_m" or "gap_ratio": value}, give them: by table and key."""
    numbers = {f"{table}.{key}": value for table in ("hammer", "cart", "contact", "operating_point")
               for key, value in tables.get(table, {}).items()}
    for name, value in axes.items():
        table, key = name.split(".") if "." in name else ("operating_point", name)
        for pair in ALTERNATIVES.items():
            if key in pair and table != "contact":
                numbers.pop(f"{table}.{pair[0]}", None)
                numbers.pop(f"{table}.{pair[1]}", None)
        numbers[f"{table}.{key}"] = value
    return numbers


def axes_of(tables: Mapping[str, Any], before: str = "") -> list[tuple[str, str]]:
    """[(path as in numbers_of_cell, name in the file)] of the axes of a job, columns first."""
    if not before:
        tables = tables["axes"]
    found = []
    for key, table in tables.items():
        if "from" in table:
            found.append((f"{before}.{key}" if before else key, f"{before}_{key}" if before else key))
        elif not before:
            found += axes_of(table, key)
    return found


def rig_of(numbers: Mapping[str, Any]) -> Rig:
    """The equation's numbers, from doubles that are taken as exact."""
    def ball(name: str) -> Ball:
        return Ball.of(float(numbers[name]))

    mass, amplitude = ball("hammer.mass_kg"), ball("cart.amplitude_m")
    if "hammer.natural_frequency_hz" in numbers:
        omega = pi().times(2) * ball("hammer.natural_frequency_hz")
        stiffness = mass * omega * omega
    else:
        stiffness = ball("hammer.stiffness_n_per_m")
        omega = (stiffness / mass).sqrt()
    impedance, rigid = mass * omega, numbers.get("contact.law") == "restitution"
    by_frequency, by_gap = "operating_point.frequency_hz" in numbers, "operating_point.gap_m" in numbers
    return Rig(
        frequency=pi().times(2) * ball("operating_point.frequency_hz") / omega if by_frequency else ball("operating_point.frequency_ratio"),
        damping_ratio=ball("hammer.damping_ratio") if "hammer.damping_ratio" in numbers
        else ball("hammer.damping_ns_per_m") / impedance.times(2),
        stiffness=zero() if rigid else ball("contact.stiffness_n_per_m") / stiffness,
        damping=zero() if rigid else ball("contact.damping_ns_per_m") / impedance,
        gap=ball("operating_point.gap_m") / amplitude if by_gap else ball("operating_point.gap_ratio"),
        cubic=Ball.of(float(numbers.get("hammer.cubic_stiffness_n_per_m3", 0))) * amplitude * amplitude / stiffness
        if numbers.get("hammer.cubic_stiffness_n_per_m3") else zero(),
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
    except (Undecided, ArithmeticError, ValueError) as reason:
        return Verdict(NOT_DECIDED, str(reason))
    why = ""
    for fine in (50, 60 + growth)[growth > 70:]:  # the box's radius is 2**-fine
        Ball.bits = fine + growth + 100
        try:
            rig = rig_of(numbers)
            radius = 1 << Ball.bits - fine
            return _compared(claim, rig, guess, prove(rig, guess, radius, _stops(guess)), radius)
        except Undecided as reason:
            why = str(reason)
    return Verdict(NOT_DECIDED, why)


def _parts(period: int) -> list[int]:
    return [n for n in range(2, period + 1) if period % n == 0 and all(n % d for d in range(2, n))]


def _stops(guess: Guess) -> set[float]:
    """Times at which the orbit would have returned, if a part of its period were one; and the end of the file's own q cycles."""
    return {guess.time + guess.period // n for n in _parts(guess.period)} | {float(guess.period)}


def _compared(claim: Claim, rig: Rig, guess: Guess, orbit: Orbit, radius: int) -> Verdict:
    u, w = orbit.stops[float(claim.period)]
    speed = w / rig.turn()
    near = SAME_PLACE if rig.cubic.size else 1e-6
    if any(abs(float(found) - told) > near * (1 + abs(told)) for found, told in ((u, claim.displacement), (speed, claim.velocity))):
        return Verdict(NOT_DECIDED, "the orbit found isn't the cell's")
    for part in _parts(claim.period):
        state = orbit.stops[guess.time + claim.period // part]
        if not any(x.apart(y) for x, y in zip(state, orbit.start, strict=True)):
            _show_shorter(rig, guess, orbit, radius, claim.period // part)
            return Verdict(CONTRADICTED, f"it repeats itself after {claim.period // part} cycles")
    impacts = sum(event in (TOUCH, BOUNCE) for _, event in guess.events)
    if impacts != claim.impacts:
        return Verdict(CONTRADICTED, f"it touches the stop {impacts} times, not {claim.impacts}")
    margins = (one() - orbit.determinant, one() + orbit.determinant, one() + orbit.determinant - orbit.trace,
               one() + orbit.determinant + orbit.trace)
    if any(margin.high < 0 for margin in margins):
        return Verdict(CONTRADICTED, "it is unstable")
    if any(margin.low <= 0 for margin in margins):
        raise Undecided("a multiplier that can't be told from the unit circle")
    if min(margin.high for margin in margins) < Ball.of(claim.stability_margin).low:
        return Verdict(CONTRADICTED, "it is less stable")
    largest = orbit.force * rig.unit
    if largest.apart(Ball.between(Ball.of(claim.lower).low, Ball.of(claim.upper).high)):
        told = f"force is {float(largest):.15g} weights" if rig.restitution is None else f"impact speed is {float(largest):.15g} m/s"
        return Verdict(CONTRADICTED, f"its largest {told}")
    return Verdict(CONFIRMED)


def _show_shorter(rig: Rig, guess: Guess, orbit: Orbit, radius: int, period: int) -> None:
    """That the only orbit of period q is one of this smaller period; raises Undecided."""
    events = [event for event in guess.events if event[0] < guess.time + period]
    shorter = prove(rig, replace(guess, period=period, events=events), radius >> 2, ())
    if not all(whole.holds(part) for whole, part in zip(orbit.start, shorter.start, strict=True)):
        raise Undecided("it may have a shorter period")
