"""Jobs of maps and sweeps over axes other than frequency and gap."""

import jobs

PLACE = "[operating_point]\nfrequency_hz = {hertz}\ngap_m = {gap}\n"
LABEL = ("regime", "impacts", "period")


def axis(key, first, last, points, scale="linear"):
    return f'\n[axes.{key}]\nfrom = {first}\nto = {last}\npoints = {points}\nscale = "{scale}"\n'


def map_over(*axes, more=""):
    return jobs.RIG.format(kind="map", title="any axes") + more + "".join(axes)


SWEEPS = {
    "amplitudes": (axis("cart.amplitude_m", 0.7e-3, 1.3e-3, 7), PLACE.format(hertz=8.1, gap=1.4e-3)),
    "masses": (axis("hammer.mass_kg", 0.25, 0.35, 6), PLACE.format(hertz=8.1, gap=1.3e-3)),
    "gaps": (axis("gap_ratio", 1.2, 2.0, 9), "[operating_point]\nfrequency_ratio = 1.8\n"),
}
