"""Colour difference CIEDE2000 (Sharma, Wu & Dalal 2005), and simulation of colour vision deficiencies.

Protanopia, deuteranopia and tritanopia after Machado, Oliveira and Fernandes (2009), severity 1, on linear RGB. Colours are '#RRGGBB', sRGB, D65.
"""

from math import atan2, cos, degrees, exp, hypot, pi, radians, sin, sqrt

import numpy as np

DEUTERANOPIA = np.array([
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.011820, 0.042940, 0.968881],
])
PROTANOPIA = np.array([
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
])
TRITANOPIA = np.array([
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.303900],
])
TO_XYZ = np.array([
    [0.4124564, 0.3575761, 0.1804375],
    [0.2126729, 0.7151522, 0.0721750],
    [0.0193339, 0.1191920, 0.9503041],
])


def normal_sight(colour):
    return _lab(_linear(colour))


def protanope_sight(colour):
    return _lab(np.clip(PROTANOPIA @ _linear(colour), 0, 1))


def deuteranope_sight(colour):
    return _lab(np.clip(DEUTERANOPIA @ _linear(colour), 0, 1))


def tritanope_sight(colour):
    return _lab(np.clip(TRITANOPIA @ _linear(colour), 0, 1))


def lightness(colour):
    """CIE L*, 0 (black) to 100 (white)."""
    return normal_sight(colour)[0]


def _linear(colour):
    value = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def _lab(linear):
    ratio = TO_XYZ @ linear / TO_XYZ.sum(axis=1)
    delta = 6 / 29
    x, y, z = np.where(ratio > delta**3, np.cbrt(ratio), ratio / (3 * delta**2) + 4 / 29)
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def difference(first, second):
    """CIEDE2000 of two (L*, a*, b*)."""
    (l1, a1, b1), (l2, a2, b2) = first, second
    c7 = ((hypot(a1, b1) + hypot(a2, b2)) / 2) ** 7
    stretch = 1 + 0.5 * (1 - sqrt(c7 / (c7 + 25**7)))
    a1, a2 = a1 * stretch, a2 * stretch
    c1, c2 = hypot(a1, b1), hypot(a2, b2)
    h1, h2 = atan2(b1, a1) % (2 * pi), atan2(b2, a2) % (2 * pi)
    turn = 0 if c1 * c2 == 0 else (h2 - h1 + pi) % (2 * pi) - pi
    delta_hue = 2 * sqrt(c1 * c2) * sin(turn / 2)
    l, c = (l1 + l2) / 2, (c1 + c2) / 2
    hue = h1 + h2 if c1 * c2 == 0 else (h1 + turn / 2) % (2 * pi)
    t = (1 - 0.17 * cos(hue - radians(30)) + 0.24 * cos(2 * hue) + 0.32 * cos(3 * hue + radians(6))
         - 0.20 * cos(4 * hue - radians(63)))
    weight_l = 1 + 0.015 * (l - 50) ** 2 / sqrt(20 + (l - 50) ** 2)
    weight_c, weight_h = 1 + 0.045 * c, 1 + 0.015 * c * t
    rotation = -2 * sqrt(c**7 / (c**7 + 25**7)) * sin(radians(60) * exp(-(((degrees(hue) - 275) / 25) ** 2)))
    parts = (l2 - l1) / weight_l, (c2 - c1) / weight_c, delta_hue / weight_h
    return sqrt(sum(part**2 for part in parts) + rotation * parts[1] * parts[2])
