"""Jumps and hysteresis, and the effect of gap and stiffness on the impact resonance (sections 3.1-3.3, 5; Figs. 9-11, 14-16)."""

from collections.abc import Mapping, Sequence
from itertools import pairwise, product
from pathlib import Path

from ..errors import PeterkaFileError
from ..files.regimes import PERIODIC
from ..sweeps.sweep_file import Branch, SweepFile
from .folder import Folder

from .force_map import RIGS
from .record import FREQUENCY, Claim, claim, near, not_computed
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
DIRECTIONS = {"up": "rising", "down": "falling"}
GAPS = (0, 1, 3)  # mm
OTHER_GAP = 0.25  # mm; rigs drawn at random have theirs off by less


def claims(folder: Folder) -> list[Claim]:
    """The claims of this group."""
    for rig, name in FILES.items():
        if not (folder.path / f"{name}.h5").exists():
            return [not_computed(key, PLACE, says, f"{name}.h5") for key, says in SAYS.items()]
    sweeps = {rig: Sweep(folder.path / f"{name}.h5") for rig, name in FILES.items()}
    pictures = [f"{name}_{picture}" for name, picture in product(FILES.values(), ("response", "bifurcation"))]
    own = sweeps[RIGS[0]]
    return [_hysteresis(own, pictures[:2]), _jump(own, pictures[:2]), _no_jump(own),
            _resonance_by_gap(own), _resonance_by_rig(sweeps, pictures)]


class Sweep:
    """Branches of a sweep, by gap and direction."""

    def __init__(self, path: Path) -> None:
        self.path = path
        with SweepFile(path) as file:
            hertz, newtons, metres = file.positive("natural_frequency_hz"), file.newtons, file.positive("cart_amplitude_m")
            if hertz is None or newtons is None or metres is None:
                raise file.refusal("doesn't tell frequency, mass and amplitude of its rig")
            self.natural_frequency_hz, self.newtons = hertz, newtons
            self.millimetres = [gap * 1e3 * metres for gap in file.gaps if gap is not None]
            self.hertz = file.frequency_ratio * self.natural_frequency_hz
            self._branches = {gap: {branch.direction: branch for branch in file.at_gap(gap)} for gap in file.gaps}
            if not file.is_complete:
                raise file.refusal("is not complete; finish it with the command that began it")
            if any(set(branches) != set(DIRECTIONS) for branches in self._branches.values()):
                raise file.refusal("has no branches with rising and with falling frequency at each gap")

    def branches(self, millimetres: float) -> dict[str, Branch]:
        """{direction: Branch} of the gap nearest to this value."""
        gaps = list(self._branches)
        near = min(range(len(gaps)), key=lambda n: abs(self.millimetres[n] - millimetres))
        if abs(self.millimetres[near] - millimetres) > OTHER_GAP:
            raise PeterkaFileError(f"{self.path} has no gap of {millimetres:g} mm, the nearest is {self.millimetres[near]:.3g} mm")
        return self._branches[gaps[near]]

    def resonance(self, millimetres: float, direction: str = "up") -> tuple[float, float] | None:
        """(frequency [Hz], force [N]) of the largest force of z = 1/1; None without that orbit."""
        branch = self.branches(millimetres)[direction]
        at = branch.strongest_single()
        return None if at is None else (float(self.hertz[at]), float(branch.force[at] * self.newtons))

    def has_maximum(self, millimetres: float, direction: str) -> bool:
        """Whether that force is a maximum inside its band, rather than cut off by a jump or by the end of the sweep."""
        branch = self.branches(millimetres)[direction]
        at = branch.strongest_single()
        return at is not None and branch.is_resonance(at)

    def doubling(self, millimetres: float) -> tuple[float, float] | None:
        """(frequency [Hz], force [N]) at the end of the widest stretch of z = 1/1 for rising frequency; None without one."""
        branch = self.branches(millimetres)["up"]
        span = widest((branch.regime == PERIODIC) & (branch.impacts == 1) & (branch.period == 1))
        return None if span is None else (float(self.hertz[span[1]]), float(branch.force[span[1]] * self.newtons))

    def end_of_band(self, millimetres: float, direction: str) -> tuple[float, float, float] | None:
        """(frequency [Hz], force below, force above [N]) of the jump that ends the band z = 1/1 towards high frequencies,
        doubled periods included: the first jump beyond the impact resonance at which the force drops; None without one."""
        branch, resonance = self.branches(millimetres)[direction], self.resonance(millimetres, direction)
        if resonance is None:
            return None
        of_band = (branch.regime == PERIODIC) & (branch.impacts == branch.period)
        for low, high in sorted(tuple(sorted(jump)) for jump in branch.jumps()):
            frequency = float(self.hertz[low] + self.hertz[high]) / 2
            if frequency >= resonance[0] and of_band[low] and branch.force[high] < branch.force[low]:
                return frequency, float(branch.force[low] * self.newtons), float(branch.force[high] * self.newtons)
        return None


def _hysteresis(sweep: Sweep, pictures: Sequence[str]) -> Claim:
    ends, words = _ends(sweep, 3)
    up, down = ends["up"], ends["down"]
    if up is None or down is None:
        return claim("jump_3mm", PLACE, SAYS["jump_3mm"], words, False, pictures=pictures)
    wide = up[0] - down[0]
    return claim("jump_3mm", PLACE, SAYS["jump_3mm"], words, wide > FREQUENCY, f"hysteresis of {wide:.2f} Hz", "", pictures)


def _jump(sweep: Sweep, pictures: Sequence[str]) -> Claim:
    ends, words = _ends(sweep, 1)
    doubling = sweep.doubling(1)
    if doubling and None in ends.values():
        words += f"; z = 1/1 ends at {doubling[0]:.2f} Hz with {doubling[1]:.4g} N"
    return claim("jump_1mm", PLACE, SAYS["jump_1mm"], words, any(ends.values()), "",
                 "a steep fall in few measured points looks like a jump; at other stiffnesses the paper saw none at this gap "
                 "either (135 mm)", pictures)


def _no_jump(sweep: Sweep) -> Claim:
    ends, words = _ends(sweep, 0)
    return claim("no_jump_0mm", "section 5; Figs. 9a, 14a", SAYS["no_jump_0mm"], words,
                 all(sweep.resonance(0, direction) for direction in DIRECTIONS) and not any(ends.values()))


def _ends(sweep: Sweep, gap: int) -> tuple[dict[str, tuple[float, float, float] | None], str]:
    """{direction: end_of_band()}, and a description of them."""
    ends = {direction: sweep.end_of_band(gap, direction) for direction in DIRECTIONS}
    return ends, "; ".join(
        f"with {name} frequency "
        f"{_jump_words(ends[direction], sweep.resonance(gap, direction), sweep.has_maximum(gap, direction))}"
        for direction, name in DIRECTIONS.items())


def _jump_words(end: tuple[float, float, float] | None, resonance: tuple[float, float] | None, has_maximum: bool) -> str:
    """Whether each direction has its own largest force, with its jump beyond or next to it."""
    if resonance is None:
        return "no z = 1/1"
    name = "impact resonance" if has_maximum else "largest force of z = 1/1"
    place = f"the {name} at {resonance[0]:.2f} Hz ({resonance[1]:.4g} N)"
    if end is None:
        return f"no jump beyond {place}"
    beyond = "next to" if f"{end[0]:.2f}" == f"{resonance[0]:.2f}" else "beyond"
    return f"a jump between {end[1]:.4g} and {end[2]:.4g} N at {end[0]:.2f} Hz, {beyond} {place}"


def _resonance_by_gap(sweep: Sweep) -> Claim:
    key, place = "gap_moves_resonance", "section 3.1, Figs. 9, 14; section 5"
    found = {gap: one for gap in GAPS if (one := sweep.resonance(gap)) is not None}
    natural = sweep.natural_frequency_hz
    if len(found) < len(GAPS):
        return claim(key, place, SAYS[key], "not each gap has z = 1/1", False)
    frequencies = [frequency for frequency, _ in found.values()]
    return claim(key, place, SAYS[key],
                 "; ".join(f"gap {gap} mm: {force:.4g} N at {frequency:.2f} Hz" for gap, (frequency, force) in found.items())
                 + f"; the natural frequency is {natural:.2f} Hz",
                 not near(max(frequencies), min(frequencies)) and not any(near(hertz, natural) for hertz in frequencies))


def _resonance_by_rig(sweeps: Mapping[str, Sweep], pictures: Sequence[str]) -> Claim:
    key, place = "stiffness_raises_resonance", "sections 3.2, 3.3, Figs. 9-11"
    found = {gap: [one[0] for rig in RIGS if (one := sweeps[rig].resonance(gap)) is not None] for gap in GAPS}
    if any(len(values) < len(RIGS) for values in found.values()):
        return claim(key, place, SAYS[key], "not each gap of each rig has z = 1/1", False, pictures=pictures)
    return claim(key, place, SAYS[key],
                 "; ".join(f"gap {gap} mm: " + ", ".join(f"{hertz:.2f} Hz ({rig})" for hertz, rig in zip(values, RIGS))
                           for gap, values in found.items())
                 + f". Of {RIGS[2]} at gap 0 the paper has none to compare with: it lay beyond what the rig could measure",
                 all(stiffer - softer > FREQUENCY for values in found.values() for softer, stiffer in pairwise(values)),
                 "", "", pictures)
