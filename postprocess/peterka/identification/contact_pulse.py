"""One impact of a free mass on a spring and dashpot, in closed form, and the inverse problem.

With w = sqrt(ki/m) and z = ci/(2 sqrt(ki m)): the mass leaves when the force has fallen to 0, after

    T = 2 acos(z) / (w sqrt(1 - z^2)),   at   e = exp(-2 z acos(z) / sqrt(1 - z^2))

of its speed; for z > 1 with acosh(z) and sqrt(z^2 - 1). e falls from 1 (z = 0) by exp(-2) (z = 1) to 0.
"""

import numpy as np
from scipy.optimize import brentq

MOST_DAMPED = 1e4  # z; restitutions below 1e-17 count as zero


def angle_over_sine(ratio: float) -> float:
    """acos(z)/sqrt(1 - z^2), continued analytically to z >= 1."""
    if abs(ratio - 1) < 1e-6:
        return 1 - (ratio - 1) / 3
    found: float = np.arccos(ratio) / np.sqrt(1 - ratio**2) if ratio < 1 else np.arccosh(ratio) / np.sqrt(ratio**2 - 1)
    return found


def pulse(mass_kg: float, stiffness: float, damping: float) -> tuple[float, float]:
    """(restitution, contact time [s]) of ki [N/m] and ci [Ns/m]."""
    omega = np.sqrt(stiffness / mass_kg)
    ratio = damping / (2 * np.sqrt(stiffness * mass_kg))
    return float(np.exp(-2 * ratio * angle_over_sine(ratio))), float(2 * angle_over_sine(ratio) / omega)


def identified(mass_kg: float, restitution: float, contact_s: float) -> tuple[float, float]:
    """(ki [N/m], ci [Ns/m]) of the stop with this restitution, 0 < e <= 1, and contact time for a free mass."""
    ratio = 0.0
    if restitution < 1:
        ratio = brentq(lambda z: 2 * z * angle_over_sine(z) + np.log(restitution), 0, MOST_DAMPED, xtol=1e-14)
    omega = 2 * angle_over_sine(ratio) / contact_s
    return float(mass_kg * omega**2), float(2 * ratio * mass_kg * omega)
