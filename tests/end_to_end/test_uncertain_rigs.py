"""Maps and sweeps with [uncertainty]: what they hold, that nothing depends on how they were computed, and that probabilities and
quantiles are those of plain random draws, solved one by one."""

import random
import shutil

import h5py
import numpy as np
import pytest

import jobs
import kills
import launch
import many_starts
import map_contents
import uncertain_rigs

SMALL, EMPTY = uncertain_rigs.small_map(), -128
OWN = ("regime", "status", "impacts", "period", "peak_force_ratio", "impact_rate", "engine")
MOST_ERRORS = 4.5  # standard errors, in some 300 comparisons


def sweep(more=""):
    return (jobs.RIG.format(kind="sweep", title="uncertain sweep") + jobs.axis("frequency_ratio", 1.0, 3.4, 25)
            + '[sweep]\ngap_ratio = [0.0, 2.5]\ndirection = "both"\nsamples = 12\n' + more + uncertain_rigs.table(24, "stop_identified.toml"))


def refined():
    return uncertain_rigs.small_map(more="[refine]\nlevels = 2\n", columns=48, rows=40)


KINDS = {"map": lambda: SMALL, "map with starts": lambda: uncertain_rigs.small_map(columns=24, rows=20, more=many_starts.table(12)),
         "rigid": lambda: jobs.with_rigid_stop(jobs.small_map(24, 20)) + "\n[uncertainty]\nrigs = 24\n[uncertainty.contact]\ncoefficient = { relative = 0.05 }\n",
         "sweep": sweep, "sweep with starts": lambda: sweep(many_starts.table(12)), "refined": refined,
         "audited": lambda: uncertain_rigs.small_map(columns=20, rows=17, more="[audit]\ncells = 6\n")}


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    return {kind: uncertain_rigs.compute(tmp_path_factory.mktemp("uncertain"), text()) for kind, text in KINDS.items()}


@pytest.mark.thorough
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("ranks", [2, 7])
def test_it_is_the_same_at_any_number_of_ranks(tmp_path, files, kind, ranks):
    path, _ = uncertain_rigs.compute(tmp_path, KINDS[kind](), ranks=ranks)
    map_contents.assert_same_map(path, files[kind][0])


@pytest.mark.thorough
@pytest.mark.parametrize("kind", ["map", "map with starts", "sweep"])
def test_it_is_the_same_after_kills(tmp_path, files, kind):
    uncertain_rigs.write(tmp_path, KINDS[kind]())
    toll, chance = kills.Toll(), random.Random(7)
    for ranks in (1, 3, 2):
        kills.run_and_kill(tmp_path, ranks, chance.choice(kills.VICTIMS), chance)
        kills.look(tmp_path / "job.h5", files[kind][0], toll)
    kills.finish(tmp_path, files[kind][0], toll)
    assert toll.harm == 0, toll


@pytest.mark.parametrize("kind", ["map", "sweep", "sweep with starts"])
def test_a_half_done_one_is_completed(tmp_path, files, kind):
    uncertain_rigs.write(tmp_path, KINDS[kind]())
    path = shutil.copy(files[kind][0], tmp_path / "job.h5")
    map_contents.take_out(path, [1])
    finished = launch.run("run", "job.toml", cwd=tmp_path, ranks=2)
    assert finished.returncode == 0, finished.stderr
    map_contents.assert_same_map(path, files[kind][0])


def test_a_damaged_probability_is_noticed(tmp_path, files):
    uncertain_rigs.write(tmp_path, SMALL)
    path = shutil.copy(files["map"][0], tmp_path / "job.h5")
    with h5py.File(path, "r+") as file:
        file["outcome_probability"][0, 20, 20] -= 0.25
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3
    assert "damaged" in finished.stderr


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "rigid"])
def test_slots_and_quantiles_are_sound(files, kind):
    cells = uncertain_rigs.told(files[kind][0])
    probability, regime = cells["outcome_probability"], cells["outcome_regime"]
    assert probability.shape[0] == 8
    np.testing.assert_allclose(probability.sum(axis=0) + cells["outcome_others"], 1, rtol=0, atol=0.05 if kind == "refined" else 1e-12)
    used = regime != EMPTY
    assert np.array_equal(used, probability > 0)
    assert np.array_equal(used.sum(axis=0), np.minimum(cells["outcomes"], 8))
    assert np.all(np.diff(probability, axis=0) <= 0)
    assert np.all(cells["outcome_others"][cells["outcomes"] <= 8] == 0)
    low, middle, high = (cells[f"force_q{percent}_ratio"] for percent in ("05", "50", "95"))
    assert np.all((low <= middle * (1 + 1e-3)) & (middle <= high * (1 + 1e-3)))
    sure = (probability[0] == 1) & (regime[0] == 0)
    assert sure.any() and np.all(high[sure] == 0)


def test_a_rigid_stop_has_speeds_instead_of_forces(files):
    cells = uncertain_rigs.told(files["rigid"][0])
    assert "force_q50_ratio" not in cells
    hits = (cells["outcome_regime"][0] == 1) & (cells["outcome_probability"][0] == 1)
    assert hits.any() and np.all(cells["speed_q50"][hits] > 0) and np.all(cells["speed_q95"][hits] >= cells["speed_q05"][hits])
    with h5py.File(files["rigid"][0]) as file:
        assert file["speed_q50"].attrs["units"] == "m/s"


def test_the_own_rig_is_as_without_uncertainty(tmp_path, files):
    plain, _ = uncertain_rigs.compute(tmp_path, SMALL, "--set", "uncertainty.rigs=0")
    with h5py.File(plain) as without, h5py.File(files["map"][0]) as file:
        assert "outcomes" not in without
        for name in OWN:
            assert file[name][()].tobytes() == without[name][()].tobytes(), name


def test_the_branches_of_a_gap_share_what_is_drawn(files):
    cells = uncertain_rigs.told(files["sweep"][0])
    for name in ("outcome_regime", "outcome_probability", "outcomes", "force_q95_ratio"):
        values = np.moveaxis(cells[name], -2, 0)
        assert np.array_equal(values[0], values[1]) and np.array_equal(values[2], values[3]), name
        assert not np.array_equal(values[0], values[2]), name


def test_a_sweep_tells_what_a_map_tells_there(tmp_path, files):
    gap = ("from = 0.0\nto = 2.5\npoints = 2\n")
    text = (jobs.RIG.format(kind="map", title="the same places") + jobs.axis("frequency_ratio", 1.0, 3.4, 25) + f"[axes.gap_ratio]\n{gap}"
            + uncertain_rigs.table(24, "stop_identified.toml"))
    of_map, of_sweep = uncertain_rigs.told(uncertain_rigs.compute(tmp_path, text)[0]), uncertain_rigs.told(files["sweep"][0])
    for name in ("outcome_regime", "outcome_impacts", "outcome_probability", "force_q50_ratio"):
        assert np.array_equal(of_map[name], of_sweep[name][..., ::2, :], equal_nan=True), name


def test_a_refined_map_is_near_the_whole_one(tmp_path, files):
    whole = uncertain_rigs.told(uncertain_rigs.compute(tmp_path, refined(), "--set", "refine.levels=0")[0])
    cells = uncertain_rigs.told(files["refined"][0])
    filled = cells["computed"] == 0
    assert 0.2 < filled.mean() < 0.95
    assert np.mean(cells["outcome_regime"][0][filled] == whole["outcome_regime"][0][filled]) > 0.99
    assert np.percentile(abs(cells["outcome_probability"] - whole["outcome_probability"])[:, filled], 99) < 0.1
    computed = ~filled
    assert np.array_equal(cells["outcome_probability"][:, computed], whole["outcome_probability"][:, computed])


def test_rigs_are_audited(files):
    path, summary = files["audited"]
    with h5py.File(path) as file:
        audit = {name: item[()] for name, item in file["audit"].items()}
    assert audit["rigs"].tolist() == [8] * 6
    assert np.array_equal(audit["rigs_elsewhere"], audit["rigs_decided_by_rounding"])
    assert audit["agreeing_rigs"] == 1 - audit["rigs_elsewhere"].sum() / 48 > 0.9
    assert "have the outcome that the map says" in summary


def test_the_summary_tells_what_is_likely(files):
    path, summary = files["map"]
    cells = uncertain_rigs.told(path)
    likely = (cells["outcome_probability"][0] >= 0.95) & (cells["outcome_regime"][0] == 0)
    assert "What 32 uncertain rigs do in each cell" in summary
    assert f"with at least 95 % probability: no impact in {100 * likely.mean():.1f} % of the plane" in summary


def test_check_prices_the_draws_and_tells_other_numbers(tmp_path):
    uncertain_rigs.write(tmp_path, SMALL)
    told = launch.run("check", "job.toml", "--set", "contact.damping_ns_per_m=1300", cwd=tmp_path)
    assert "32 rigs in each cell, 44,800 in all" in told.stdout
    assert "contact.damping_ns_per_m is 1300 in the job, and 1200 where its uncertainty was identified" in told.stdout
    assert "contact.stiffness_n_per_m is" not in told.stdout
    many = launch.run("check", "job.toml", "--set", "uncertainty.hammer.damping_ratio={relative=1.0}", cwd=tmp_path)
    assert "rigs were drawn again, most of them since hammer.damping_ratio was out of its range" in many.stdout


def test_bad_files_of_numbers_get_words(tmp_path):
    uncertain_rigs.write(tmp_path, SMALL)
    def says(content, *words):
        if content is not None:
            (tmp_path / "stop_identified.toml").write_text(content)
        told = launch.run("check", "job.toml", cwd=tmp_path)
        assert told.returncode == 2
        for word in words:
            assert word in told.stderr, told.stderr
    says("[covarianc]\nof = []\n", "names no file of uncertain numbers", "[covariance]")
    says("[covariance\n", "can't be read as uncertain numbers")
    says(uncertain_rigs.COVARIANCE.replace("9.0e10", "1.0"), "not positive definite")
    says(uncertain_rigs.COVARIANCE.replace("contact.damping_ns_per_m", "contact.damping_ns"), "did you mean contact.damping_ns_per_m?")
    (tmp_path / "stop_identified.toml").unlink()
    (tmp_path / "stop_identifed.toml").write_text("")
    says(None, "names a file that isn't there", 'did you mean "stop_identifed.toml"?')


@pytest.mark.thorough
@pytest.mark.parametrize("start", ["", "[start]\ndisplacement_ratio = -1.5\nvelocity_ratio = 2.0\n", many_starts.table(4)],
                         ids=["at rest", "from a start", "each from a start of its own"])
def test_probabilities_are_those_of_plain_draws(tmp_path, start):
    rigs, plain, chance = 256, 400, np.random.default_rng(11)
    text = (jobs.RIG.format(kind="map", title="against plain draws") + jobs.axis("frequency_ratio", 1.1, 3.9, 3) + jobs.axis("gap_ratio", 0.3, 2.7, 3)
            + start + uncertain_rigs.table(rigs, "stop_identified.toml"))
    cells = uncertain_rigs.told(uncertain_rigs.compute(tmp_path, text)[0])
    place = (-1.5, 2.0) if "[start]" in start else (0.0, 0.0)
    worst = 0
    for row, gap in enumerate(cells["gap_ratio"]):
        for column, frequency in enumerate(cells["frequency_ratio"]):
            own = uncertain_rigs.paper_rig()
            drawn = uncertain_rigs.numpy_draws(own, chance, plain, (frequency, gap), place)
            if "[starts]" in start:
                drawn = uncertain_rigs.from_random_starts(own, drawn, chance)
            labels, strengths = uncertain_rigs.solve(drawn)
            worst = max(worst, *uncertain_rigs.deviations(cells, row, column, rigs, labels, strengths))
    assert worst < MOST_ERRORS
    assert np.any((cells["outcome_probability"][0] < 0.98) & (cells["outcome_probability"][0] > 0.3))


SOFT = """
schema = 1
kind = "map"
title = "softening springs"
hammer = { mass_kg = 0.35, natural_frequency_hz = 6.0, damping_ratio = 0.02, cubic_stiffness_n_per_m3 = -2.2e7 }
cart = { amplitude_m = 0.8e-3 }
contact = { law = "kelvin_voigt", stiffness_n_per_m = 1.2e6, damping_ns_per_m = 500.0 }
axes = { frequency_hz = { from = 9.0, to = 10.0, points = 3 }, gap_m = { from = 0.0, to = 4e-4, points = 2 } }
[uncertainty]
rigs = 40
hammer = { cubic_stiffness_n_per_m3 = { relative = 0.1 } }
"""


@pytest.mark.thorough
def test_a_rig_that_is_thrown_out_of_its_springs_reaches_no_force(tmp_path):
    """Of some cells' rigs the softening spring throws out a tenth and more: no force is reached by 95 % of them."""
    cells = uncertain_rigs.told(uncertain_rigs.compute(tmp_path, SOFT)[0])
    thrown = np.where(cells["outcome_regime"] == uncertain_rigs.FAILED, cells["outcome_probability"], 0).sum(axis=0)
    low, median, high = (cells[f"force_q{percent}_ratio"] for percent in ("05", "50", "95"))
    few, some = (thrown < 0.05) & (cells["outcome_others"] == 0), (thrown > 0.05) & (thrown < 0.95)
    assert few.any() and some.any(), thrown
    assert (low[few] > 0).all() and (low[some] == 0).all() and (high[some] > 0).all() and (median[thrown < 0.5] > 0).all()
