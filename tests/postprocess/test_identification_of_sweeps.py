"""identify.py --sweep: rigs come back from peak forces of an independent integrator; points on no branch, models that don't fit and numbers
that aren't told are said; words for bad input."""

import tomllib
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import peterka
import pytest
from measured_sweep import Rig, sweep
from peterka.identification import branches, sweep_adequacy, sweep_fit
from peterka.identification.sweep_rig import USUAL, read_rig

pytestmark = pytest.mark.thorough

RIG = Rig(mass=1.7, hertz=9.0, ratio=0.02, amplitude=1.1e-3, stiffness=6.0e6, damping=1100.0, gap=0.7e-3)
BEGUN = Rig(RIG.mass, RIG.hertz, 0.02, RIG.amplitude, 1.25 * RIG.stiffness, 0.8 * RIG.damping, 0.55e-3)
NOISE = 0.02
SWEPT = ("--sweep", "points.csv", "--rig-from", "start.toml")
HERTZ = np.linspace(12.0, 24.0, 20)


@pytest.fixture(scope="module")
def forces():
    """[(frequency [Hz], force [N])] going up, then down again."""
    both = [*HERTZ, *HERTZ[::-1]]
    return [(hertz, force) for hertz, force in zip(both, sweep(RIG, both)) if force]


def write(folder, rows, rig=BEGUN, names="frequency_hz,force_n"):
    (folder / "points.csv").write_text("\n".join([names, *(",".join(f"{one:.9g}" for one in row) for row in rows)]) + "\n")
    (folder / "start.toml").write_text(rig.toml())


def noisy(forces, seed=5, noise=NOISE):
    chance = np.random.default_rng(seed)
    return [(hertz, force * (1 + noise * chance.standard_normal())) for hertz, force in forces]


def numbers(folder):
    """{key: (value, standard error)} of the written covariance."""
    told = tomllib.loads((folder / "points_identified.toml").read_text())["covariance"]
    return dict(zip(told["of"], zip(told["mean"], np.sqrt(np.diag(told["matrix"])))))


def test_forces_of_branches_are_those_of_the_integrator(forces, tmp_path):
    write(tmp_path, forces, RIG)
    rig = read_rig(tmp_path / "start.toml", {})
    landscape = branches.compute(rig, [RIG.gap], (HERTZ[0], HERTZ[-1]), 241, list(USUAL))[0]
    found = 0
    for hertz, force in forces:
        near = [np.exp(strand.at(hertz)) for strand in landscape.strands if strand.beyond(hertz) == 0]
        if near:
            found += 1
            assert min(abs(one / force - 1) for one in near) < 5e-4, hertz
    assert found > 0.8 * len(forces)


def test_slopes_are_differences_of_runs(tmp_path):
    write(tmp_path, [], RIG)
    rig = read_rig(tmp_path / "start.toml", {})
    span, keys, hertz = (HERTZ[0], HERTZ[-1]), list(USUAL), 16.321

    def strand(rig):
        return next(one for one in branches.compute(rig, [rig.gap], span, 241, keys)[0].strands if one.beyond(hertz) == 0)

    slopes = strand(rig).slopes_at(hertz, keys)
    for key, slope in zip(keys, slopes):
        value = rig.value(key)
        ends = [strand(rig.with_values({key: value * (1 + step)})).at(hertz) for step in (-1e-3, 1e-3)]
        assert slope * value == pytest.approx(np.diff(ends)[0] / 2e-3, rel=2e-3, abs=2e-5), key


def test_a_rig_comes_back_and_a_point_on_no_branch_is_named(forces, tmp_path, run_program):
    write(tmp_path, [*noisy(forces), (16.05, 0.4 * forces[6][1])])
    code, told, wrong = run_program("identify", "--sweep", "points.csv", "--rig-from", "start.toml", "--damping-ratio", RIG.ratio,
                                    "--formats", "png")
    assert code == 0, wrong
    assert "left out: 16.05 Hz" in told and "off the nearest branch" in told and "differ from the best fit" not in told
    found = numbers(tmp_path)
    for key, true in {"contact.stiffness_n_per_m": RIG.stiffness, "contact.damping_ns_per_m": RIG.damping,
                      "operating_point.gap_m": RIG.gap}.items():
        value, error = found[key]
        assert abs(value - true) < 4 * error and error < 0.1 * true, key
    rig = (tmp_path / "points_rig.toml").read_text()
    job = "schema = 1\nkind = \"sweep\"\n[axes.frequency_hz]\nfrom = 12.0\nto = 20.0\npoints = 5\n[operating_point]\ngap_m = 7e-4\n" + rig
    assert "kelvin_voigt" in peterka.check(job)
    assert (tmp_path / "pictures" / "points_identified.png").stat().st_size > 20_000


def test_a_model_that_does_not_fit_says_so(forces, tmp_path, run_program):
    rows = [(hertz, force * (1 + 0.15 * np.sin(0.8 * (hertz - 12))), 0.005 * force) for hertz, force in noisy(forces, noise=0.005)]
    write(tmp_path, rows, names="frequency_hz,force_n,force_error_n")
    code, told, wrong = run_program("identify", "--sweep", "points.csv", "--rig-from", "start.toml", "--fit", "ki", "--gap-mm",
                                    1e3 * RIG.gap, "--formats", "png")
    assert code == 0, wrong
    assert "differ from the best fit by more than their standard errors" in told and "scatter from neighbour to neighbour" in told
    assert "differ from the best fit" in (tmp_path / "points_identified.toml").read_text()


def even_in_the_gap(rig, gaps, span, points, keys):
    """One branch whose forces are the same for gaps of either sign, in place of the program."""
    hertz, bow = np.linspace(0.8 * span[0], 1.2 * span[1], points), rig.gap / rig.amplitude
    tilt = (hertz - 15.0) / 15.0
    log_force = np.log(rig.value("contact.stiffness_n_per_m") / 1e4) + bow**2 * tilt
    slopes = {"contact.stiffness_n_per_m": np.full(points, 1 / rig.value("contact.stiffness_n_per_m")),
              "operating_point.gap_m": 2 * bow * tilt / rig.amplitude}
    strand = branches.Strand("1/1", "up", hertz, log_force, np.full(points, bow**2 / 15.0), slopes)
    return [branches.Landscape([strand], hertz, [""] * points, np.full((1, points), np.nan))]


def test_two_rigs_that_explain_the_points_are_named(tmp_path, run_program, monkeypatch):
    chance, tilt = np.random.default_rng(8), (HERTZ - 15.0) / 15.0
    write(tmp_path, [(hertz, 600 * np.exp(0.25 * one) * (1 + 0.01 * chance.standard_normal())) for hertz, one in zip(HERTZ, tilt)])
    monkeypatch.setattr(sweep_fit, "compute", even_in_the_gap)
    code, _, wrong = run_program("identify", *SWEPT, "--fit", "ki,gap_mm", "--bounds", "gap_mm=-2:2")
    assert code == 2 and "doesn't tell two rigs apart" in wrong and "gap 0.5" in wrong and "gap -0.5" in wrong
    code, told, wrong = run_program("identify", *SWEPT, "--fit", "ki,gap_mm", "--bounds", "gap_mm=0.05:3", "--formats", "png")
    assert code == 0, wrong
    assert abs(numbers(tmp_path)["operating_point.gap_m"][0] - 0.55e-3) < 4 * numbers(tmp_path)["operating_point.gap_m"][1]


def test_a_number_that_is_hardly_told_has_a_bound(tmp_path, run_program, monkeypatch):
    chance = np.random.default_rng(9)
    write(tmp_path, [(hertz, 600 * (1 + 0.2 * chance.standard_normal())) for hertz in HERTZ[:8]])

    def hardly(rig, *others):
        landscape = even_in_the_gap(rig, *others)[0]
        strand = landscape.strands[0]
        slopes = {**strand.slopes, "hammer.damping_ratio": 1e-3 * (strand.hertz - 12)}
        log_force = strand.log_force + slopes["hammer.damping_ratio"] * rig.value("hammer.damping_ratio")
        slope = strand.slope + 1e-3 * rig.value("hammer.damping_ratio")
        return [replace(landscape, strands=[replace(strand, log_force=log_force, slope=slope, slopes=slopes)])]

    monkeypatch.setattr(sweep_fit, "compute", hardly)
    code, told, wrong = run_program("identify", *SWEPT, "--fit", "ki,damping_ratio", "--formats", "png")
    assert code == 0, wrong
    assert "damping_ratio is hardly told: below" in told and "hammer.damping_ratio" not in numbers(tmp_path)
    assert "# damping_ratio =" in (tmp_path / "points_rig.toml").read_text()


def measured(noise, scatter, errors=False, chaotic=0):
    """A SweepFit, as far as _over_scatter() looks at one, of 36 forces over two gaps, some of them of chaos."""
    chance, hertz = np.random.default_rng(4), np.tile(np.linspace(12, 20, 18), 2)
    force = 100 * np.exp(0.1 * hertz) * (1 + noise * chance.standard_normal(36))
    force[:chaotic] *= chance.uniform(0.5, 1, chaotic)
    order = chance.permutation(36)
    points = SimpleNamespace(hertz=hertz[order], force=force[order], has_errors=errors)
    return SimpleNamespace(model=SimpleNamespace(points=points, which=np.repeat([0, 1], 18)[order]), scatter=scatter, freedom=30)


def test_a_scatter_above_that_of_neighbours_is_seen():
    """A wrong rig without chaos explained two thirds of the points of a right one to 7.4 %, whose noise was 2 %, without a word."""
    assert sweep_adequacy._over_scatter(measured(0.02, 0.08)) == pytest.approx(4, rel=0.4)
    assert sweep_adequacy._over_scatter(measured(0.02, 0.08, chaotic=6)) > 2
    for fit in (measured(0.02, 0.02), measured(0.02, 0.025), measured(0.02, 0.08, errors=True), measured(0.02, 0.02, chaotic=12)):
        assert sweep_adequacy._over_scatter(fit) == 1


def test_forces_that_are_rounded_have_that_scatter():
    coarse = measured(0.01, 0.02)
    coarse.model.points.force = 40.0 * np.rint(coarse.model.points.force / 40.0)
    assert sweep_adequacy._over_scatter(coarse) == 1
    coarse.model.points.force[:] = 40.0
    assert sweep_adequacy._over_scatter(coarse) == 1


def test_points_at_chaos_hardly_speak_against_a_rig():
    """Else rigs without chaos would always win; nor for one, or one with chaos everywhere would."""
    hertz, wide, narrow = np.array([12.0, 13.0, 14.0, 15.0]), (11.0, 12.5), (13.95, 14.05)
    strands = [branches.Strand("1/1", "up", np.array(span), *(np.zeros(2),) * 2, {}) for span in (wide, narrow)]
    landscape = branches.Landscape(strands, hertz, ["", "chaos", "", "no impact"], np.full((1, 4), 50.0))
    points = SimpleNamespace(hertz=hertz, force=np.full(4, 50.0), error=np.full(4, 1.0), has_errors=False)
    model = SimpleNamespace(points=points, which=np.zeros(4, int), landscapes=lambda x: [landscape])
    fit = SimpleNamespace(model=model, x=np.zeros(1), left=np.array([0.02, 0.3, np.nan, np.nan]), used=np.array([True, False, False, False]))
    chaos = -2 * np.log(0.02 * np.sqrt(2 * np.pi) / np.log(2))  # of a density even over ln 2, over that in the middle of a normal one
    assert 5 < chaos < 6 and sweep_adequacy._cost(fit, 0.02) == pytest.approx(1 + 2 * chaos + sweep_fit.OUTLYING**2)
    points.has_errors, fit.left = True, np.array([3.0, 15.0, np.nan, np.nan])
    assert sweep_adequacy._cost(fit, 1.0) == pytest.approx(9 + 2 * chaos + sweep_fit.OUTLYING**2)


@pytest.mark.parametrize("freedom, width", [(1, 1.84), (2, 1.32), (5, 1.11), (100, 1.005)])
def test_errors_that_few_points_tell_are_students(freedom, width):
    """His table of 68.27 % intervals."""
    assert sweep_fit.widened(freedom) == pytest.approx(width, abs=0.005)


GOOD = [(12.0 + n, 100.0) for n in range(8)]


@pytest.mark.parametrize("options, words", [
    (("--sweep", "points.csv"), "--sweep needs --rig-from"),
    ((*SWEPT, "--fit", "ki,mass"), "--fit names 'mass'"),
    ((*SWEPT, "--fit", "ki,contact.stiffness_n_per_m"), "names contact.stiffness_n_per_m twice"),
    ((*SWEPT, "--bounds", "kk=1:2"), "'kk=1:2' names 'kk'"),
    ((*SWEPT, "--bounds", "ki=1e6"), "no two numbers FROM:TO"),
    ((*SWEPT, "--bounds", "ki=9e6:1e6"), "the smaller one comes first"),
    ((*SWEPT, "--bounds", "ki=1e6:2e6"), "leave out the 7.5e+06 from which the fit begins"),
    ((*SWEPT, "--bounds", "ci=0:2e6"), "it is above 0"),
    ((*SWEPT, "--bounds", "frequency_hz=1:20"), "isn't fitted"),
    ((*SWEPT, "--bounds", "ki=1e6:9e6", "ki=1e6:8e6"), "names contact.stiffness_n_per_m twice"),
    ((*SWEPT, "--driven", "other.csv"), "--sweep doesn't go with --driven"),
    (("--fit", "ki", "--mass-kg", "1", "recording.csv"), "--fit belongs to --sweep"),
    (("recording.csv",), "required: --mass-kg"),
    (("--sweep", "none.csv", "--rig-from", "start.toml"), "none.csv cannot be read"),
    (("--sweep", "points.csv", "--rig-from", "none.toml"), "none.toml cannot be read"),
    (("--sweep", "points.csv", "--rig-from", "points.csv"), "is no rig or job in TOML"),
])
def test_words_for_bad_options(options, words, tmp_path, run_program):
    write(tmp_path, GOOD)
    code, told, wrong = run_program("identify", *options)
    assert (code, told) == (2, "") and words in wrong


@pytest.mark.parametrize("rows, names, words", [
    (GOOD[:5], "frequency_hz,force_n", "has 5 points with a force, and 4 numbers are fitted to them; 6 are needed"),
    ([(12.0,)], "frequency_hz", "has no measured peak force"),
    ([(12000.0, 100.0)], "frequency_hz,force_n", "frequency_hz is in hertz"),
    ([(12.0, -100.0)], "frequency_hz,force_n", "peak forces are above 0"),
    ([*((*row, 1.0) for row in GOOD), (20.0, 100.0, 0.0)], "frequency_hz,force_n,force_error_n", "standard error of 8 of 9 forces"),
    ([(hertz, force, 80.0) for hertz, force in GOOD], "frequency_hz,force_n,gap_mm", "the hammer swings without an impact"),
    ([(hertz, force, 8.0) for hertz, force in GOOD], "frequency_hz,force_n,natural_frequency_hz", "of rigs with another natural frequency"),
])
def test_words_for_bad_points(rows, names, words, tmp_path, run_program):
    write(tmp_path, rows, names=names)
    code, _, wrong = run_program("identify", *SWEPT)
    assert code == 2 and words in wrong


@pytest.mark.parametrize("old, new, words", [
    ("kelvin_voigt", "rigid", "law = \"kelvin_voigt\", is fitted"),
    ("mass_kg = 1.7", "", "has no hammer.mass_kg"),
    ("amplitude_m = 0.0011", "amplitude_m = -1.0", "has -1 as cart.amplitude_m"),
    ("gap_m = 0.00055", "", "tells no gap; give it by --gap-mm"),
    ("damping_ratio = 0.02", "damping_ratio = 0.0", "has 0 as hammer.damping_ratio"),
])
def test_words_for_bad_rigs(old, new, words, tmp_path, run_program):
    write(tmp_path, GOOD)
    text = (tmp_path / "start.toml").read_text()
    assert old in text
    (tmp_path / "start.toml").write_text(text.replace(old, new))
    code, _, wrong = run_program("identify", *SWEPT)
    assert code == 2 and words in wrong


def test_a_motion_that_trial_rigs_lack_is_no_wall(tmp_path, run_program, monkeypatch):
    """Two points are near a branch of 1/2 that ends for rigs a little nearer to the true one: the fit goes on."""
    chance = np.random.default_rng(4)
    rows = [(hertz, 600 * (1 + 0.01 * chance.standard_normal())) for hertz in HERTZ]
    write(tmp_path, [*rows[:-2], *((hertz, 0.5 * force) for hertz, force in rows[-2:])], replace(BEGUN, stiffness=6.3e6))

    def ending(rig, gaps, span, points, keys):
        landscape = even_in_the_gap(rig.with_values({"operating_point.gap_m": 0.0}), gaps, span, points, keys)[0]
        whole = landscape.strands[0]
        below = whole.hertz < 23.0
        parts = [replace(whole, label=label, hertz=whole.hertz[mask], log_force=whole.log_force[mask] + np.log(factor),
                         slope=whole.slope[mask], slopes={key: one[mask] for key, one in whole.slopes.items()})
                 for mask, label, factor in ((below, "1/1", 1.0), (~below, "1/2", 0.5))]
        return [replace(landscape, strands=parts if rig.value("contact.stiffness_n_per_m") > 6.15e6 else parts[:1])]

    monkeypatch.setattr(sweep_fit, "compute", ending)
    code, told, wrong = run_program("identify", *SWEPT, "--fit", "ki", "--formats", "png")
    assert code == 0, wrong
    value, error = numbers(tmp_path)["contact.stiffness_n_per_m"]
    assert abs(value - 6e6) < 4 * error and told.count("left out: ") == 2
