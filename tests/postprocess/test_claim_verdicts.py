"""Each verdict at both sides of its limit, on planes that can be overlooked; nothing falls over where a band is missing."""

import h5py
import numpy as np
import pytest
from claim_samples import CHAOS, HALF, JOB, ONE, QUIET, TWICE, Held, basin, plane, verdicts
from peterka_claims import force_map, gap_zero, jumps, robust, starts, stiffness
from peterka_claims.folder import Folder, NotDrawable
from peterka_claims.record import AGREES, DIFFERS
from peterka_claims.sensitivity import contact_damping_with_both, rows
from picture_samples import PLAIN, write_map
from sweep_samples import write_sweep

MILLIMETRE = 1 / 0.89  # A0
RIGS = [f"peterka_{rig}" for rig in force_map.RIGS]


def judged(agrees):
    return AGREES if agrees else DIFFERS


def bands_at_gap_0(first=(4.0, 11.5), peak=204.0, peak_hz=9.0, second=230.0):
    """z = 1/1, then 2/2 up to 12.25 Hz, then 1/2 up to 16.5 Hz, in steps of 0.25 Hz."""
    hertz = np.arange(2, 20, 0.25)
    cells = [ONE if first[0] <= f <= first[1] else TWICE if 11.5 < f <= 12.25 else HALF if 12.25 < f <= 16.5 else CHAOS
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
    empty = plane([[QUIET] * 4] * 3, np.zeros((3, 4)))
    folder = Held(gaps_170mm=empty, basin_170mm_gap_0=basin(1, 1), basin_170mm_gap_3=basin(1, 1),
                  **dict.fromkeys(RIGS, empty))
    for group in (gap_zero, force_map, robust):
        assert set(verdicts(group.claims(folder)).values()) == {DIFFERS}, group


def region(depend, gaps=(1.3, 1.5, 1.7)):
    """Two starts; so many of ten cells between the bands depend on them at each gap, and all beyond."""
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
    told = f"{100 * quiet / (striking + quiet):.4g} % of the starts end in no impact"
    assert all(told in claim.computed for claim in found)


def test_the_nearest_basin_with_both_outcomes_is_told():
    def told(**nearby):
        return starts._first_basin(Held(basin_150mm=basin(0, 9, 1.7), **nearby))

    found = told(**{"nearby_150mm/gap_1": basin(5, 5, 1.5), "nearby_150mm/gap_2": basin(0, 9, 1.6),
                    "nearby_150mm/gap_3": basin(5, 5, 2.5)})
    assert "the nearest gap with both is gap/A0 = 1.5, where 50 % of the starts end in impacts" in found.computed
    assert found.difference.startswith("-0.2 A0")
    found = told(**{"nearby_150mm/gap_1": basin(19, 1, 1.6)})
    assert "no gap that was tried, gap/A0 = 1.6 to 1.6, has both" in found.computed
    assert "gap/A0 = 1.6, and there 95 % of them do" in found.why


def damped(striking, quiet, damping):
    found = basin(striking, quiet)
    found.job["hammer"]["damping_ns_per_m"] = 0.08
    found.job["contact"] = {"damping_ns_per_m": damping, "stiffness_n_per_m": 5.5e6}
    return found


def test_the_sensitivity_asks_for_both_outcomes_too():
    folder = Held(**{"basin_150mm": damped(0, 20, 1200.0), "sensitivity/150mm_1_ci": damped(20, 0, 1080.0),
                     "sensitivity/150mm_2_ci": damped(16, 4, 900.0), "sensitivity/150mm_3_ci": damped(10, 10, 600.0)})
    (row,) = rows(folder)
    assert row.needed == 0.75 and row.values.tolist() == [50, 80, 100, 0]
    assert "with ci = 900 Ns/m instead of 1200 both are there" in contact_damping_with_both(folder, "sensitivity/150mm_")


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


def sweeps(folder, **changes):
    """Claims on three sweeps that are alike, at 0, 1 and 3 mm."""
    for name in jumps.FILES.values():
        write_sweep(folder / f"{name}.h5", gaps=(0.0, MILLIMETRE, 3 * MILLIMETRE), **changes)
    return folder


def change(path, name, branches, value):
    with h5py.File(path, "r+") as file:
        for branch in branches:
            file[name][branch] = value


def test_jumps_and_hysteresis(tmp_path):
    found = verdicts(jumps.claims(Folder(sweeps(tmp_path))))
    assert (found["jump_3mm"], found["jump_1mm"], found["no_jump_0mm"]) == (AGREES, AGREES, AGREES)
    assert found["stiffness_raises_resonance"] == DIFFERS  # all rigs are alike
    path = tmp_path / "sweep_170mm.h5"
    change(path, "jump", [2, 3, 4], 0)  # both of 1 mm, and one of 3 mm
    change(path, "jump", [0], [0] * 12 + [1])
    change(path, "peak_force_ratio", [0], [40.0] * 12 + [20.0])
    found = verdicts(jumps.claims(Folder(tmp_path)))
    assert (found["jump_3mm"], found["jump_1mm"], found["no_jump_0mm"]) == (DIFFERS, DIFFERS, DIFFERS)


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
    with pytest.raises(NotDrawable, match="sweep_150mm.h5 is not complete"):
        jumps.claims(Folder(tmp_path))
    sweeps(tmp_path, directions=(0,))
    with pytest.raises(NotDrawable, match="no branches with rising and with falling frequency"):
        jumps.claims(Folder(tmp_path))
    write_map(tmp_path / "gaps_170mm.h5", [[(-128, 0, 0)] * 4] * 4, job=JOB)
    with pytest.raises(NotDrawable, match="gaps_170mm.h5 is not complete"):
        gap_zero.claims(Folder(tmp_path))
