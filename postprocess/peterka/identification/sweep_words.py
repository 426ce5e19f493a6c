"""A fit to measured peak forces in words: points that were used, those left out and why, and how far they lie from their branches."""

import numpy as np

from .sweep_fit import SweepFit

MOST_NAMED = 12  # points that are left out


def point_lines(fit: SweepFit) -> list[str]:
    """Describes the points of a SweepFit."""
    points = fit.model.points
    labels = [place.strand.label for place, used in zip(fit.places, fit.used) if place and used]
    counted = ", ".join(f"{labels.count(label)} on {label}" for label in sorted(set(labels), key=lambda label: -labels.count(label)))
    off = "their standard errors" if points.has_errors else "the force"
    scatter = f"{fit.scatter:.3g} times {off}" if points.has_errors else f"{100 * fit.scatter:.2g} % of {off}"
    left = [f"left out: {reason}" for reason in _left_out(fit)]
    more = [f"and {len(left) - MOST_NAMED} more points are left out"] if len(left) > MOST_NAMED else []
    return [f"{points.path}: {int(fit.used.sum())} of {len(fit.used)} points are fitted, {counted}; they lie off their branches by "
            f"{scatter}", *(f"  {line}" for line in [*left[:MOST_NAMED], *more])]


def _left_out(fit: SweepFit) -> list[str]:
    points = fit.model.points
    return [f"{points.names[number]}: {_reason(fit, number)}" for number in np.flatnonzero(~fit.used)]


def _reason(fit: SweepFit, number: int) -> str:
    points, place = fit.model.points, fit.places[number]
    hertz, landscape = float(points.hertz[number]), fit.model.landscapes(fit.x)[fit.model.which[number]]
    other = landscape.other_at(hertz)
    narrow = [strand for strand in landscape.strands if strand.is_narrow and strand.beyond(hertz) == 0]
    if narrow and (place is None or place.beyond > 0):
        return f"its branch of {narrow[0].label} is {np.ptp(narrow[0].hertz):.2g} Hz wide, and errors of the rig may move it by more"
    if place is None:
        return {"chaos": "its motion is chaos, whose largest force is no smooth function of the rig",
                "no impact": "no force is computed there, the hammer swings without an impact"}.get(other, "no branch is near")
    label, force = place.strand.label, float(np.exp(place.log_force))
    if place.beyond > 0:
        end = place.strand.hertz[0] if hertz < place.strand.hertz[0] else place.strand.hertz[-1]
        chaos = ", and there is chaos" if other == "chaos" else ""
        return f"its branch of {label} ends or jumps at {end:.5g} Hz{chaos}"
    share = 100 * (points.force[number] / force - 1)
    chaos = "; there is chaos, too" if other == "chaos" else ""
    return f"{share:+.3g} % off the nearest branch, {label} with {force:.4g} N, and so on none{chaos}"
