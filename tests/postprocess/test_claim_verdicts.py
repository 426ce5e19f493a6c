"""Each verdict on both sides of its limit, on simple planes; a missing band causes no failure."""

import numpy as np
import pytest
from claim_samples import CHAOS, HALF, JOB, ONE, QUIET, TWICE, Held, basin, plane, verdicts
from peterka.claims import force_map, gap_zero, jumps, robust, starts, stiffness
from peterka.errors import PeterkaFileError
from peterka.claims.folder import Folder
from peterka.claims.record import AGREES, DIFFERS
from peterka.claims.sensitivity import contact_damping_with_both, rows
from picture_samples import PLAIN, write_map
from sweep_samples import FREQUENCY, write_sweep
from sealing import SealedFile, unfinish

MILLIMETRE = 1 / 0.89  # A0
RIGS = [f"peterka_{rig}" for rig in force_map.RIGS]


def judged(agrees):
    return AGREES if agrees else DIFFERS


def bands_at_gap_0(first=(4.0, 11.5), peak=204.0, peak_hz=9.0, second=230.0, half=(12.5, 16.5)):
    """z = 1/1, then 2/2, then 1/2, in steps of 0.25 Hz."""
    hertz = np.arange(2, 20, 0.25)
    cells = [ONE if first[0] <= f <= first[1] else TWICE if 11.5 < f < half[0] else HALF if half[0] <= f <= half[1] else CHAOS
             for f in hertz]
    force = np.where(hertz > 12.25, second, peak - 5 * np.abs(hertz - peak_hz))
    return verdicts(gap_zero.claims(Held(gaps_170mm=plane([cells], [force], columns=hertz))))


def test_bands_and_forces_at_gap_0():
    as_printed = bands_at_gap_0()
    assert as_printed.pop("gap_0_second_band") == DIFFERS  # it begins 0.375 Hz late
    assert set(as_printed.values()) == {AGREES}
    assert bands_at_gap_0(first=(4.5, 11.5))["gap_0_first_band"] == DIFFERS
    assert bands_at_gap_0(peak=223)["gap_0_peak_force"] == AGREES
    assert bands_at_gap_0(peak=226, second=225)["gap_0_peak_force"] == DIFFERS
    assert bands_at_gap_0(peak_hz=9.5)["gap_0_peak_frequency"] == DIFFERS
    assert bands_at_gap_0(second=203)["gap_0_half_is_stronger"] == DIFFERS
    earlier = bands_at_gap_0(half=(12.0, 16.0))
    assert (earlier["gap_0_second_band"], earlier["gap_0_alternating"]) == (AGREES, DIFFERS)
    assert bands_at_gap_0(half=(15.5, 16.5))["gap_0_half"] == DIFFERS


@pytest.mark.parametrize("beyond, words", [
    (300, "exceed those of z = 1/1 only at higher frequencies: 300 N at 18.00 Hz"),
    (150, "nowhere exceed those of z = 1/1: at most 150 N, at 15.00 Hz")])
def test_where_the_second_band_is_stronger_is_told_as_it_is(beyond, words):
    gaps = plane([[ONE, HALF, HALF]], [[200, 150, beyond]], columns=[7, 15, 18])
    found = {claim.key: claim for claim in gap_zero.claims(Held(gaps_170mm=gaps))}["gap_0_half_is_stronger"]
    assert found.verdict == DIFFERS and words in found.why


def three_maps(labels, force, gaps):
    return Held(**{rig: plane(labels, force, rows=gaps) for rig in RIGS})


@pytest.mark.parametrize("times, agrees", [(2.8, True), (3.2, True), (3.4, False), (2.6, False)])
def test_three_times_less_is_judged_like_any_ratio(times, agrees):
    found = verdicts(force_map.claims(three_maps([[ONE, ONE, ONE]], [[1, times, 1]], [0])))
    assert found["map_natural"] == found["gap_0_natural"] == judged(agrees)


@pytest.mark.parametrize("turn, agrees", [(1.35, False), (1.55, True), (2.5, True), (9, False)])
def test_the_largest_force_may_lie_at_the_boundary_from_high_gaps_on(turn, agrees):
    gaps = np.arange(0, 3, 0.1)
    force = [[1, 3, 2] if gap < turn else [1, 2, 3] for gap in gaps]
    assert verdicts(force_map.claims(three_maps([[ONE] * 3] * len(gaps), force, gaps)))["map_inside"] == judged(agrees)


@pytest.mark.parametrize("at_0, agrees", [(2.75, True), (2.65, False)])
def test_force_at_gap_0_against_the_others(at_0, agrees):
    found = verdicts(force_map.claims(three_maps([[ONE] * 3] * 2, [[1, at_0, 1], [1, 3, 1]], [0, 1])))
    assert found["map_zero_gap"] == judged(agrees)


def robustness(after=(0.95, 0.3, 0.2), at_0=3.0, starts=(20, 0), others=(18, 2)):
    """`after`: force beyond the band by gap of 0, 1 and 2 mm; starts of z = 1/1 and of no impact at gap 0 and at 3 mm."""
    maps = plane([[ONE] * 3 + [CHAOS]] * 3, [[1, largest, 1, beyond] for largest, beyond in zip((at_0, 3, 3), after)])
    return verdicts(robust.claims(Held(gaps_170mm=maps, basin_170mm_gap_0=basin(*starts),
                                       basin_170mm_gap_3=basin(*others))))


def test_gap_0_is_robust_and_higher_gaps_jump():
    assert robustness() == {"gap_0_robust": AGREES, "higher_gaps_jump": AGREES}
    assert robustness(after=(0.95, 0.95, 0.2)) == {"gap_0_robust": AGREES, "higher_gaps_jump": DIFFERS}
    for weaker in ({"after": (0.85, 0.3, 0.2)}, {"at_0": 2.6}, {"starts": (18, 2)}, {"starts": (39, 1), "others": (20, 0)}):
        assert robustness(**weaker) == {"gap_0_robust": DIFFERS, "higher_gaps_jump": AGREES}, weaker


def test_a_band_that_is_missing_differs():
    empty = plane([[QUIET] * 4] * 3, np.zeros((3, 4)), columns=[1, 6, 11, 16])
    folder = Held(gaps_170mm=empty, basin_170mm_gap_0=basin(1, 1), basin_170mm_gap_3=basin(1, 1),
                  **dict.fromkeys(RIGS, empty))
    for group in (gap_zero, force_map, robust):
        assert set(verdicts(group.claims(folder)).values()) == {DIFFERS}, group


def region(depend, gaps=(1.3, 1.5, 1.7)):
    """Two starts; at each gap, this many of ten cells between the bands depend on them, and all beyond."""
    rest = [[ONE] * 10 + [QUIET] * 10 + [HALF] * 10] * len(gaps)
    other = [[ONE] * 10 + [HALF] * count + [QUIET] * (10 - count) + [QUIET] * 10 for count in depend]
    folder = Held(**{"starts/start_1": plane(rest, rows=gaps), "starts/start_2": plane(other, rows=gaps)})
    return starts._region(folder)


def test_where_the_start_decides_is_judged_between_the_bands():
    assert region([0, 1, 1]).verdict == AGREES
    assert region([0, 0, 1]).verdict == DIFFERS  # from 1.7 only
    assert region([1, 1, 1]).verdict == DIFFERS  # from 1.3 on
    assert region([1, 1, 0]).verdict == DIFFERS
    told = region([0, 1, 3]).computed
    assert "from gap/A0 = 1.5 up 10 % to 30 % of the cells between the bands" in told
    assert "83.33 % of all cells that depend on the start lie elsewhere" in told


@pytest.mark.parametrize("striking, quiet, agrees", [
    (1, 9, True), (9, 1, True), (1, 19, False), (19, 1, False), (0, 9, False)])
def test_some_starts_of_each_kind_are_a_tenth_of_each(striking, quiet, agrees):
    folder = Held(basin_150mm=basin(striking, quiet), basin_135mm=basin(striking, quiet))
    found = starts.claims(folder)[1:]
    assert [claim.verdict for claim in found] == 2 * [judged(agrees)]
    strike, none = (100 * count / (striking + quiet) for count in (striking, quiet))
    told = f"{strike:.4g} % of the starts end in impacts, {none:.4g} % in none"
    assert all(told in claim.computed for claim in found)


def test_the_nearest_basin_with_both_outcomes_is_told():
    def told(**nearby):
        return starts._first_basin(Held(basin_150mm=basin(0, 9, 1.7), **nearby))

    found = told(**{"nearby_150mm/gap_1": basin(5, 5, 1.5), "nearby_150mm/gap_2": basin(0, 9, 1.6),
                    "nearby_150mm/gap_3": basin(5, 5, 2.5)})
    assert "the nearest gap with at least 10 % of each is gap/A0 = 1.5, where 50 % of the starts end in impacts, 50 % in none" \
        in found.computed
    assert found.difference.startswith("-0.2 A0")
    found = told(**{"nearby_150mm/gap_1": basin(19, 1, 1.6)})
    assert "no gap that was tried, gap/A0 = 1.6 to 1.6, has 10 % of each" in found.computed
    assert "gap/A0 = 1.6, where 95 % of the starts end in impacts, 5 % in none" in found.why


def test_a_basin_of_the_second_place_without_lives_is_refused():
    without = plane([[ONE, QUIET]], last_impact=None)
    with pytest.raises(PeterkaFileError, match="a.h5 holds no last_impact"):
        starts._second_basin(Held(basin_135mm=without))


def damped(striking, quiet, damping):
    found = basin(striking, quiet)
    found.job["hammer"]["damping_ns_per_m"] = 0.08
    found.job["contact"] = {"damping_ns_per_m": damping, "stiffness_n_per_m": 5.5e6}
    return found


def test_the_sensitivity_asks_for_both_outcomes_too():
    folder = Held(**{"basin_150mm": damped(0, 20, 1200.0), "sensitivity/150mm_1_ci": damped(20, 0, 1080.0),
                     "sensitivity/150mm_2_ci": damped(16, 4, 900.0), "sensitivity/150mm_3_ci": damped(10, 10, 600.0)})
    (row,) = rows(folder)
    assert row.needed == 0.75 and row.values.tolist() == [50, 80, 100, 0] and row.quiet.tolist() == [50, 20, 0, 100]
    assert "with ci = 900 Ns/m instead of 1200 both are there: 80 % of the starts end in impacts, 20 % in none" in (
        contact_damping_with_both(folder, "sensitivity/150mm_"))


@pytest.mark.parametrize("factors, agrees", [((1, 1.04, 1.08), True), ((1, 1.05, 1.2), False), ((1, 1, 0.8), False)])
def test_forces_of_the_springs_are_compared_in_newtons(tmp_path, factors, agrees):
    for rig, factor in zip(RIGS, factors):
        write_map(tmp_path / f"{rig}.h5", PLAIN, forces=factor * np.ones((4, 4)), job=JOB)
    assert verdicts(stiffness.claims(Folder(tmp_path)))["stiffness_force"] == judged(agrees)


def test_maps_of_springs_that_differ_between_the_bands_or_elsewhere(tmp_path):
    row = [ONE] * 30 + [CHAOS] * 4 + [HALF] * 30

    def compared(*columns):
        other = [TWICE if n in columns else label for n, label in enumerate(row)]
        for rig, cells in zip(RIGS, (row, other, other)):
            write_map(tmp_path / f"{rig}.h5", [cells] * 2, job=JOB)
        found = verdicts(stiffness.claims(Folder(tmp_path)))
        return found["stiffness_same"], found["stiffness_where"]

    assert compared(31) == (AGREES, AGREES)
    assert compared(2) == compared(60) == (AGREES, DIFFERS)
    assert compared(30, 31, 32, 33) == (DIFFERS, AGREES)


def sweeps(folder, natural=(4.5, 4.5, 4.5), **changes):
    """Sweeps of the three rigs at 0, 1 and 3 mm, identical except for their natural frequencies."""
    for name, hertz in zip(jumps.FILES.values(), natural):
        write_sweep(folder / f"{name}.h5", gaps=(0.0, MILLIMETRE, 3 * MILLIMETRE), natural_frequency_hz=hertz, **changes)
    return folder


def change(path, name, branches, value):
    with SealedFile(path, "r+") as file:
        for branch in branches:
            file[name][branch] = value


def test_jumps_and_hysteresis(tmp_path):
    found = verdicts(jumps.claims(Folder(sweeps(tmp_path))))
    assert (found["jump_3mm"], found["jump_1mm"], found["no_jump_0mm"]) == (AGREES, AGREES, AGREES)
    assert found["stiffness_raises_resonance"] == DIFFERS  # all rigs are identical
    path = tmp_path / "sweep_170mm.h5"
    change(path, "jump", [2, 3, 4], 0)  # both of 1 mm, and one of 3 mm
    change(path, "jump", [0], [0] * 12 + [1])
    change(path, "peak_force_ratio", [0], [40.0] * 12 + [20.0])
    found = verdicts(jumps.claims(Folder(tmp_path)))
    assert (found["jump_3mm"], found["jump_1mm"], found["no_jump_0mm"]) == (DIFFERS, DIFFERS, DIFFERS)


def test_each_direction_tells_the_resonance_that_its_jump_lies_beyond(tmp_path):
    found = {claim.key: claim for claim in jumps.claims(Folder(sweeps(tmp_path)))}["jump_3mm"]
    assert found.computed == (
        "with rising frequency a jump between 175.3 and 0 N at 8.16 Hz, beyond the largest force of z = 1/1 at 7.88 Hz (175.3 N); "
        "with falling frequency a jump between 146.1 and 0 N at 7.03 Hz, beyond the largest force of z = 1/1 at 6.75 Hz (146.1 N)")
    resonance = (5.372, 163.1)
    assert jumps._jump_words((5.374, 163.1, 0.0), resonance, True).endswith("next to the impact resonance at 5.37 Hz (163.1 N)")
    assert jumps._jump_words((5.374, 163.1, 0.0), resonance, False).endswith(
        "next to the largest force of z = 1/1 at 5.37 Hz (163.1 N)")
    assert jumps._jump_words(None, resonance, True) == "no jump beyond the impact resonance at 5.37 Hz (163.1 N)"
    assert jumps._jump_words(None, None, False) == "no z = 1/1"


@pytest.mark.parametrize("natural, agrees", [(1.1, True), (0.9, False)])  # a quarter of it is the hysteresis
def test_a_hysteresis_is_wider_than_the_steps_of_the_paper(tmp_path, natural, agrees):
    assert verdicts(jumps.claims(Folder(sweeps(tmp_path, (natural, 5, 6)))))["jump_3mm"] == judged(agrees)


@pytest.mark.parametrize("peaks, agrees", [
    ((2.0, 1.75, 1.75), True), ((2.0, 2.0, 2.0), False), ((1.875, 1.75, 1.75), False),  # moved a lot
    ((2.0, 1.75, 1.125), True), ((2.0, 1.75, 1.0), False), ((1.125, 0.875, 0.75), True), ((1.25, 1.0, 0.75), False)])
def test_gaps_move_the_resonance_away_from_the_natural_frequency(tmp_path, peaks, agrees):
    """`peaks`: location of the largest force at 0, 1 and 3 mm, in natural frequencies."""
    path, frequency = sweeps(tmp_path) / "sweep_170mm.h5", FREQUENCY - 0.5
    change(path, "frequency_ratio", [...], frequency)
    for branch, peak in zip((0, 2, 4), peaks):
        change(path, "peak_force_ratio", [branch], 40 - 10 * np.abs(frequency - peak))
        for name in ("regime", "impacts", "period"):
            change(path, name, [branch], 1)
    assert verdicts(jumps.claims(Folder(tmp_path)))["gap_moves_resonance"] == judged(agrees)


@pytest.mark.parametrize("natural, agrees", [
    ((4.5, 5.25, 6.5), True), ((4.5, 4.65, 4.80), True), ((4.5, 4.63, 4.8), False), ((4.5, 4.65, 4.78), False),
    ((6.5, 5.25, 4.5), False)])
def test_stiffer_springs_raise_the_resonance_at_each_gap(tmp_path, natural, agrees):
    """Resonances lie at 2 natural frequencies at gap 0, and at 1.75 at the others."""
    assert verdicts(jumps.claims(Folder(sweeps(tmp_path, natural))))["stiffness_raises_resonance"] == judged(agrees)


def test_a_sweep_without_single_impacts_differs(tmp_path):
    sweeps(tmp_path)
    for name in jumps.FILES.values():
        change(tmp_path / f"{name}.h5", "period", range(6), 2)
        change(tmp_path / f"{name}.h5", "impacts", range(6), 3)
        change(tmp_path / f"{name}.h5", "regime", range(6), 1)
    assert set(verdicts(jumps.claims(Folder(tmp_path))).values()) == {DIFFERS}


def test_unfinished_files_are_refused(tmp_path):
    path = sweeps(tmp_path) / "sweep_150mm.h5"
    change(path, "regime", [5], -128)
    for name in ("impacts", "period"):
        change(path, name, [5], 0)
    with pytest.raises(PeterkaFileError, match="sweep_150mm.h5 is not complete"):
        jumps.claims(Folder(tmp_path))
    sweeps(tmp_path, directions=(0,))
    with pytest.raises(PeterkaFileError, match="no branches with rising and with falling frequency"):
        jumps.claims(Folder(tmp_path))
    write_map(tmp_path / "gaps_170mm.h5", [[(-128, 0, 0)] * 4] * 4, job=JOB)
    with pytest.raises(PeterkaFileError, match="gaps_170mm.h5 is not complete"):
        gap_zero.claims(Folder(tmp_path))
    for path, of in ((sweeps(tmp_path) / "sweep_150mm.h5", jumps), (write_map(tmp_path / "gaps_170mm.h5", [[(0, 0, 1)] * 4] * 4, job=JOB), gap_zero)):
        unfinish(path)
        with pytest.raises(PeterkaFileError, match=f"{path.name} is not complete"):
            of.claims(Folder(tmp_path))


def test_maps_and_sweeps_that_do_not_reach_a_place_are_refused(tmp_path):
    """Not judged by the row, column or branch that is nearest."""
    write_map(tmp_path / "gaps_170mm.h5", [[(0, 0, 1)] * 4] * 4, np.linspace(1, 4, 4), np.linspace(1.5, 4.5, 4), job=JOB)
    with pytest.raises(PeterkaFileError, match="gaps_170mm.h5 reaches from 1.5 to 4.5 gap/A0; a map of this name is to reach 0"):
        gap_zero.claims(Folder(tmp_path))
    write_map(tmp_path / "gaps_170mm.h5", [[(0, 0, 1)] * 4] * 4, np.linspace(1, 2.5, 4), np.linspace(0, 3, 4), job=JOB)
    with pytest.raises(PeterkaFileError, match="gaps_170mm.h5 reaches from 4.5 to 11.25 Hz; a map of this name is to reach 15.25"):
        gap_zero.claims(Folder(tmp_path))
    sweep = jumps.Sweep(sweeps(tmp_path) / "sweep_150mm.h5")
    with pytest.raises(PeterkaFileError, match="sweep_150mm.h5 has no gap of 5 mm"):
        sweep.branches(5)
