"""Jumps and hysteresis, and how gap and stiffness move the impact resonance (sections 3.1-3.3, 5; Figs. 9-11, 14-16)."""

from itertools import product

from peterka_pictures.classes import PERIODIC
from peterka_pictures.sweep import SweepFile

from .folder import STANDARD_GRAVITY
from .force_map import RIGS
from .record import SHARE, claim, not_computed
from .spans import widest

PLACE = "section 3.1, Figs. 9, 14"
SAYS = {
    "jump_3mm": "At a gap of 3 mm the force jumps beyond the impact resonance, with hysteresis.",
    "jump_1mm": "At a gap of 1 mm, too, the force jumps beyond the impact resonance.",
    "no_jump_0mm": "At gap 0 the force of z = 1/1 does not jump.",
    "gap_moves_resonance": "A gap changes the impact resonance much, and it differs from the hammer's natural frequency.",
    "stiffness_raises_resonance": "Stiffer springs give higher impact resonance frequencies at each gap.",
}
FILES = {rig: f"sweep_{rig}" for rig in RIGS}


def claims(folder):
    for rig, name in FILES.items():
        if not (folder.path / f"{name}.h5").exists():
            return [not_computed(key, PLACE, says, f"{name}.h5") for key, says in SAYS.items()]
    sweeps = {rig: Sweep(folder.path / f"{name}.h5") for rig, name in FILES.items()}
    pictures = [f"{name}_{picture}" for name, picture in product(FILES.values(), ("response", "bifurcation"))]
    own = sweeps[RIGS[0]]
    return [_jump(own, "jump_3mm", 3, pictures[:2]), _jump(own, "jump_1mm", 1, pictures[:2]), _no_jump(own),
            _resonance_by_gap(own), _resonance_by_rig(sweeps, pictures)]


class Sweep:
    """Branches of a sweep, by gap and direction."""

    def __init__(self, path):
        with SweepFile(path) as file:
            self.hertz = file.frequency_ratio * file.positive("natural_frequency_hz")
            self.natural_frequency_hz = file.positive("natural_frequency_hz")
            self.millimetres = [gap * 1e3 * file.positive("cart_amplitude_m") for gap in file.gaps]
            self.weight_n = file.positive("hammer_mass_kg") * STANDARD_GRAVITY
            self._branches = {gap: {branch.direction: branch for branch in file.at_gap(gap)} for gap in file.gaps}

    def branches(self, millimetres):
        """{direction: Branch} of the gap nearest to this."""
        gaps = list(self._branches)
        near = min(range(len(gaps)), key=lambda n: abs(self.millimetres[n] - millimetres))
        return self._branches[gaps[near]]

    def resonance(self, millimetres, direction="up"):
        """(frequency [Hz], force [N])"""
        branch = self.branches(millimetres)[direction]
        at = branch.resonance()
        return float(self.hertz[at]), float(branch.force[at] * self.weight_n)

    def doubling(self, millimetres):
        """(frequency [Hz], force [N]) at the end of the widest stretch of z = 1/1 with rising frequency; None without."""
        branch = self.branches(millimetres)["up"]
        span = widest((branch.regime == PERIODIC) & (branch.impacts == 1) & (branch.period == 1))
        return None if span is None else (float(self.hertz[span[1]]), float(branch.force[span[1]] * self.weight_n))

    def end_of_band(self, millimetres, direction):
        """(frequency [Hz], force below, force above [N]) of the jump that ends the band z = 1/1 towards high frequencies,
        doubled periods counted in: the first beyond the impact resonance that loses force; None without one."""
        branch, (resonance, _) = self.branches(millimetres)[direction], self.resonance(millimetres, direction)
        of_band = (branch.regime == PERIODIC) & (branch.impacts == branch.period)
        for low, high in sorted(tuple(sorted(jump)) for jump in branch.jumps()):
            frequency = float(self.hertz[low] + self.hertz[high]) / 2
            if frequency >= resonance and of_band[low] and branch.force[high] < branch.force[low]:
                return frequency, *(float(branch.force[n] * self.weight_n) for n in (low, high))
        return None


def _jump(sweep, key, gap, pictures):
    found = {direction: sweep.end_of_band(gap, direction) for direction in ("up", "down")}
    resonance, force = sweep.resonance(gap)
    peak = f"the impact resonance at {resonance:.2f} Hz ({force:.4g} N)"
    if None in found.values():
        end = sweep.doubling(gap)
        return claim(key, PLACE, SAYS[key], f"no jump of the band z = 1/1 beyond {peak}" + (
            f"; from there its force falls smoothly to {end[1]:.4g} N at {end[0]:.2f} Hz, where the period doubles"
            if end else ""), False, "", "a steep fall in few measured points looks like a jump; at other stiffnesses the "
            "paper saw none at this gap either (135 mm)", pictures)
    (up, high, low), (down, *_) = found["up"], found["down"]
    return claim(key, PLACE, SAYS[key],
                 f"with rising frequency the force falls from {high:.4g} to {low:.4g} N at {up:.2f} Hz, beyond {peak}; with "
                 f"falling frequency impacts begin at {down:.2f} Hz", up > down, f"hysteresis of {up - down:.2f} Hz",
                 "both jumps fall on one frequency", pictures)


def _no_jump(sweep):
    found = [jump for jump in (sweep.end_of_band(0, direction) for direction in ("up", "down")) if jump]
    words = "; ".join(f"from {below:.4g} to {above:.4g} N at {hertz:.2f} Hz" for hertz, below, above in found)
    return claim("no_jump_0mm", "section 5; Figs. 9a, 14a", SAYS["no_jump_0mm"],
                 f"jumps at the end of the band: {words or 'none, up and down'}", not found)


def _resonance_by_gap(sweep):
    found = {gap: sweep.resonance(gap) for gap in (0, 1, 3)}
    frequencies = [frequency for frequency, _ in found.values()]
    natural = sweep.natural_frequency_hz
    return claim("gap_moves_resonance", "section 3.1, Figs. 9, 14; section 5", SAYS["gap_moves_resonance"],
                 "; ".join(f"gap {gap} mm: {force:.4g} N at {frequency:.2f} Hz" for gap, (frequency, force) in found.items())
                 + f"; the natural frequency is {natural:.2f} Hz",
                 max(frequencies) > (1 + SHARE) * min(frequencies) and min(frequencies) > (1 + SHARE) * natural)


def _resonance_by_rig(sweeps, pictures):
    found = {gap: [sweeps[rig].resonance(gap)[0] for rig in RIGS] for gap in (0, 1, 3)}
    return claim("stiffness_raises_resonance", "sections 3.2, 3.3, Figs. 9-11", SAYS["stiffness_raises_resonance"],
                 "; ".join(f"gap {gap} mm: " + ", ".join(f"{hertz:.2f} Hz ({rig})" for hertz, rig in zip(values, RIGS))
                           for gap, values in found.items()),
                 all(values == sorted(values) and values[0] < values[-1] for values in found.values()), "", "", pictures)
