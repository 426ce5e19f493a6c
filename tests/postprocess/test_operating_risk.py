"""operating_point.py --risk on synthetic maps of drawn rigs: against plain loops, what is refused, and what fresh draws are asked for."""

import math
import re
import stat
import sys

import numpy as np
import pytest
from peterka.cli import operating_point
from peterka.maps.map_file import PeterkaFile
from peterka.operating import fresh_draws, risk
from peterka.operating.drift import reach, worst_of_boxes
from peterka.sampling import draws_needed, least_share, least_share_above
from picture_samples import write_map
from picture_texts import faults_of_layout
from sealing import SealedFile
from starts_samples import EMPTY
from uncertain_samples import KINDS, by_probability, forces, probabilities, write_uncertain

WEIGHT = 0.298 * 9.80665
ROWS, COLUMNS = 24, 32
LOW = forces(ROWS, COLUMNS)[0]


@pytest.fixture
def operate(tmp_path, run_program):
    return lambda *arguments: run_program("operating_point", *arguments, "--formats", "png")


def plain(low, sure, hz, mm):
    """The least of each cell's box by loops; the sample's cells are 4.5 * 3 / 31 Hz and 0.89 * 3 / 23 mm apart."""
    across, up = (math.ceil(width / step - 1e-9) for width, step in ((hz, 4.5 * 3 / (COLUMNS - 1)), (mm, 0.89 * 3 / (ROWS - 1))))
    result = np.full(low.shape, np.nan)
    for i, j in np.ndindex(low.shape):
        box = slice(i - up, i + up + 1), slice(j - across, j + across + 1)
        if i < up or j < across or i + up >= ROWS or j + across >= COLUMNS or not sure[box].all():
            continue
        result[i, j] = low[box].min()
    return result


@pytest.mark.parametrize("hz, mm", [(0.0, 0.0), (0.5, 0.1), (1.0, 0.3)])
@pytest.mark.parametrize("regimes", [None, ["1/1"], ["1/1", "2/2"]])
def test_the_value_is_the_least_of_the_box(tmp_path, hz, mm, regimes):
    shares = probabilities(ROWS, COLUMNS)
    shares[0] += 1 - shares.sum(axis=0)
    shares[:, :12] = np.array([0.75, 0, 0.25, 0])[:, None, None]
    shares[:, :11, 8:] = np.array([1, 0, 0, 0])[:, None, None]
    likely = {None: np.ones_like(shares[0]), "1/1": shares[0], "1/1,2/2": shares[0] + shares[2]}[",".join(regimes) if regimes else None]
    with PeterkaFile(write_uncertain(tmp_path / "a.h5", shares=shares)) as file:
        found = {each: risk.admitted_at(file, each, regimes) for each in risk.KEPT}
        worst = {each: worst_of_boxes(found[each], *(reach(file, axis, hz, mm) for axis in (file.rows, file.columns))) for each in found}
    always = likely >= 1 - 1e-9
    expected = {0.95: plain(LOW, always, hz, mm), 0.5: plain(np.where(always, forces(ROWS, COLUMNS)[1], LOW), likely >= 0.55, hz, mm)}
    for each in found:
        assert np.isfinite(expected[each]).sum() > 10
        np.testing.assert_allclose(worst[each], expected[each])


@pytest.mark.parametrize("regimes", [["1/1"], ["2/2"], ["1/1", "2/2"]])
def test_a_value_in_a_motion_is_reached_in_it(tmp_path, regimes):
    """By draws of which motion and force are known: quantiles of all forces are no forces in the motion."""
    chance = np.random.default_rng(3)
    kind = np.array([[chance.choice(4, 64, p=chance.dirichlet([0.3, 0.05, 0.1, 0.02])) for _ in range(COLUMNS)] for _ in range(ROWS)])
    force = np.where(kind == 1, 0, chance.random(4)[kind] * 50 + 5 * chance.random(kind.shape))
    in_order = np.sort(force, axis=-1)
    path = write_uncertain(tmp_path / "a.h5", shares=np.stack([np.mean(kind == n, axis=-1) for n in range(4)]),
                           quantiles=np.stack([in_order[..., math.ceil(64 * share) - 1] for share in (0.05, 0.5, 0.95)]))
    of_regimes = np.isin(kind, [{"1/1": 0, "2/2": 2}[each] for each in regimes])
    with PeterkaFile(path) as file:
        for asked in risk.KEPT:
            value = np.where(np.isfinite(risk.admitted_at(file, asked, regimes).value), risk.admitted_at(file, asked, regimes).value, np.inf)
            both = np.mean(of_regimes & (force >= value[..., None]), axis=-1)
            assert np.isfinite(value).sum() > 20 and np.all(both[np.isfinite(value)] >= asked)


def test_a_motion_named_twice_counts_once(tmp_path, operate):
    path = write_uncertain(tmp_path / "a.h5")
    asked = ("--risk", "0.5", "--hz", "0", "--mm", "0", "--regime")
    assert operate(path, *asked, "1/1,1/1")[1] == operate(path, *asked, "1/1")[1] != ""


def test_a_value_in_a_motion_is_told_as_one(tmp_path, operate):
    shares = np.zeros((4, ROWS, COLUMNS))
    shares[0], shares[2] = 0.9, 0.1
    path = write_uncertain(tmp_path / "a.h5", shares=shares, quantiles=np.full((3, ROWS, COLUMNS), 20.0))
    code, told, _ = operate(path, "--risk", "0.5", "--regime", "1/1")
    assert code == 0 and "peak force in 1/1 with a probability of 0.5, drift" in told
    assert "at least 50 % of them end in 1/1 and reach its worst value there" in told and "of all rigs" not in told
    code, _, complaint = operate(path, "--risk", "0.95", "--regime", "1/1")
    assert code == 2 and ("in 1/1 with a probability of 0.95 at a drift ±0.5 Hz, ±0.1 mm, where boxes are ±0.871 Hz and ±0.116 mm; it keeps the values of "
                          "all motions together, so that these motions need a probability of 1 to tell one in them; allow a smaller probability\n") in complaint


def test_without_a_risk_the_drawn_rigs_are_named(tmp_path, operate):
    told = operate(write_uncertain(tmp_path / "a.h5"), "--hz", "0", "--mm", "0")[1]
    assert "of the job's own rig alone: what its 64 drawn rigs reach is told by --risk 0.95" in told


def test_the_picture_fits_a_column(tmp_path, operate, monkeypatch):
    """Its scale lost its unit there."""
    drawn = []
    monkeypatch.setattr(operating_point, "save_all", lambda figure, *_: drawn.append(figure))
    path = write_uncertain(tmp_path / "a.h5")
    code, _, complaint = operate(path, "--risk", "0.95", "--hz", "0.5", "--mm", "0.1", "--units", "si", "--width", "84")
    faults = faults_of_layout(drawn[0], monkeypatch)
    assert (code, complaint) == (0, "") and not faults, "\n".join(faults)


def test_the_best_place_is_told_in_words_and_drawn(tmp_path, operate):
    code, told, complaint = operate(write_uncertain(tmp_path / "a.h5"), "--risk", "0.95", "--hz", "0.5", "--mm", "0.1")
    assert (code, complaint) == (0, "")
    expected = plain(LOW, LOW >= 0, 0.5, 0.1)
    best = WEIGHT * np.nanmax(expected)
    lines = told.splitlines()
    assert lines[1] == (f"peak force with a probability of 0.95, drift ±0.5 Hz, ±0.1 mm: above 0 in the boxes of "
                        f"{100 * np.mean(expected > 0):.3g} % of the cells")
    assert "64 rigs drawn: stop stiffness ±3 %" in told and "each from [start]" in told
    # the fourth smallest of 64 draws: 5 % and no less
    assert f"of all rigs at least {100 * least_share_above(4, 64):.3g} %, in 19 cases of 20" in told
    place = next(line for line in lines if line.startswith("best: "))
    assert "commonest motion = 1/1" in place and f"at least {best:.4g} N in all cells of its box" in place
    head, first = next((line, lines[n + 1]) for n, line in enumerate(lines) if "least probability of z" in line)
    assert first.split()[1] == "1/1" and first.split()[-1] == "%" and float(first.split()[-2]) > 90 and "worst of its box [N]" in head
    assert (tmp_path / "pictures" / "a_operating_point_risk.png").exists()


def test_the_least_probability_is_that_of_the_box(tmp_path):
    with PeterkaFile(write_uncertain(tmp_path / "a.h5")) as file:
        rows, columns = (reach(file, axis, *drift) for axis, drift in ((file.rows, (0.5, 0.1)), (file.columns, (0.5, 0.1))))
        place = risk.Place(3, 20, 1.0, 1.0, (0, 0), 0.0)
        (found,) = risk.with_motions(file, [place], rows, columns)
    assert found.z == "1/1" and found.share == pytest.approx(probabilities(ROWS, COLUMNS)[0][2:5, 18:23].min())


def test_an_order_statistic_bounds_the_share_above_it():
    """By drawing: in at least 19 of 20 sets, the share that reaches the k-th smallest is at least the bound, and in not many more."""
    chance = np.random.default_rng(1)
    for rank, draws in ((1, 59), (3, 59), (4, 64), (15, 300)):
        above = 1 - np.sort(chance.random((20000, draws)), axis=1)[:, rank - 1]
        assert np.mean(above >= least_share_above(rank, draws)) == pytest.approx(0.95, abs=0.006)
    assert least_share_above(1, draws_needed(0.95)) >= 0.95 > least_share_above(1, draws_needed(0.95) - 1)
    assert least_share(1.0, 59) == pytest.approx(least_share_above(1, 59))


@pytest.mark.parametrize("rigs, asked, reason", [
    (58, "0.95", "has 58 rigs of each cell, which can't tell a probability of 0.95"), (58, "0.95", "59 could tell it: --set uncertainty.rigs=59"),
    (64, "0.99", "299 could tell it"), (300, "0.99", "doesn't keep what is reached with a probability of 0.99; it does for 0.95 and 0.5"),
    (4, "0.5", "5 could tell it")])
def test_what_the_draws_cannot_tell_is_refused(tmp_path, operate, rigs, asked, reason):
    code, told, complaint = operate(write_uncertain(tmp_path / "a.h5", rigs=rigs), "--risk", asked)
    assert (code, told) == (2, "") and reason in complaint and complaint.count("\n") == 1
    assert not (tmp_path / "pictures").exists()


@pytest.mark.parametrize("arguments, reason", [
    (["--risk", "1"], "'1' is not a probability between 0 and 1"), (["--risk", "x"], "'x' is not a probability"),
    (["--risk", "0.95", "--starts", "any"], "it doesn't go with --starts"),
    (["--risk", "0.95", "--quantity", "contact_power"], "--risk doesn't go with --quantity contact_power"),
    (["--risk", "0.95", "--regime", "7/1"], "has no cell at which the hammer impacts in 7/1 with a probability of 0.5, whatever the drift\n")])
def test_bad_questions_are_refused(tmp_path, operate, arguments, reason):
    code, _, complaint = operate(write_uncertain(tmp_path / "a.h5"), *arguments)
    assert code == 2 and reason in complaint and complaint.count("\n") == 1


def test_a_force_with_a_probability_is_that_of_the_own_mass(tmp_path, operate):
    """The largest one over the weight is that of the lightest hammer."""
    path = write_uncertain(tmp_path / "a.h5", quantiles=np.ones((3, ROWS, COLUMNS)) * np.linspace(100, 60, ROWS)[:, None])
    with SealedFile(path, "r+") as file:
        file.attrs["job"] = file.attrs["job"].replace("mass_kg = 0.298, ", "").replace("gap_ratio = {", "hammer.mass_kg = {")
        file["hammer_mass_kg"] = np.linspace(0.1, 1, ROWS)
        del file.attrs["hammer_mass_kg"]
    code, told, complaint = operate(path, "--risk", "0.95")
    assert (code, complaint) == (0, "") and "worst of its box [N]" in told and "weight" not in told
    assert f"hammer mass 1 kg, commonest motion = no impact: at least {60 * 9.80665:.4g} N in all cells of its box" in told


def test_an_axis_of_one_value_does_not_drift(tmp_path, operate):
    noted, program = tmp_path / "noted", tmp_path / "program"
    program.write_text(PROGRAM.format(python=sys.executable, path=sys.path, noted=str(noted), value=30.0, share=0))
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    path = write_uncertain(tmp_path / "a.h5", rows=1)
    code, told, complaint = operate(path, "--risk", "0.95", "--verify", "--peterka", program)
    assert (code, complaint) == (0, "") and "probability of 0.95, drift ±0.5 Hz: above 0" in told
    assert "at places of their own (frequency within ±0.5 Hz), 95 % reach" in told and "operating_point.gap_m" not in noted.read_text()
    code, _, complaint = operate(path, "--risk", "0.95", "--mm", "0.1")
    assert code == 2 and "has one and the same gap in all cells" in complaint


@pytest.mark.parametrize("low, middle, arguments, end", [
    (0, 0, (), "has no cell at which the hammer impacts with a probability of 0.5, whatever the drift"),
    (0, 1, (), "with a probability of 0.95 at a drift ±0.5 Hz, ±0.1 mm, where boxes are ±0.871 Hz and ±0.116 mm; allow a smaller probability"),
    (0, 1, ("--hz", "0", "--mm", "0"), "with a probability of 0.95 even without drift; allow a smaller probability"),
    (1, 1, (), "where boxes are ±0.871 Hz and ±0.116 mm; allow less drift, or a smaller probability")])
def test_only_what_may_help_is_advised(tmp_path, operate, low, middle, arguments, end):
    """The hammer impacts in single cells."""
    alone = np.zeros((ROWS, COLUMNS))
    alone[::2, ::2] = 30.0
    path = write_uncertain(tmp_path / "a.h5", quantiles=np.stack([low * alone, middle * alone, alone]))
    code, _, complaint = operate(path, "--risk", "0.95", *arguments)
    assert code == 2 and complaint.endswith(f"{end}\n"), complaint


def test_a_map_of_one_rig_is_refused(tmp_path, operate):
    code, _, complaint = operate(write_map(tmp_path / "a.h5"), "--risk", "0.95")
    assert code == 2 and "was computed for one rig alone" in complaint and "rigs = 59 or more" in complaint


def test_a_rigid_stop_has_a_speed_with_a_probability(tmp_path, operate):
    path = write_uncertain(tmp_path / "a.h5", names=("speed_q05", "speed_q50", "speed_q95"), quantiles=forces(ROWS, COLUMNS) / 100)
    code, told, _ = operate(path, "--risk", "0.95", "--hz", "0", "--mm", "0")
    assert code == 0 and "impact speed with a probability of 0.95" in told
    assert f"at least {1000 * LOW.max() / 100:.4g} mm/s" in told


def test_empty_slots_are_no_motion():
    kinds, shares = by_probability(np.array([[[0.0]], [[1.0]], [[0.0]], [[0.0]]]))
    assert kinds[0, 0, 0].tolist() == list(KINDS[1]) and kinds[1, 0, 0].tolist() == list(EMPTY) and shares[0, 0, 0] == 1


PROGRAM = """#!{python}
import sys
sys.path[:0] = {path}
from uncertain_samples import write_uncertain
from pathlib import Path
import numpy as np
words = sys.argv[1:]
Path({noted!r}).write_text("\\n".join(words))
rigs = int(dict(word.split("=") for word in words if "=" in word)["uncertainty.rigs"])
quantiles = np.full((3, 2, 2), {value})
quantiles[0, 1, 1] += 1  # the least of the cells counts
shares = None
if {share}:
    shares = np.zeros((4, 2, 2))
    shares[0], shares[2] = {share}, 1 - {share}
write_uncertain(Path(words[words.index("--output") + 1]), 2, 2, rigs=rigs, quantiles=quantiles, shares=shares)
"""


@pytest.mark.parametrize("share, value, words", [
    (1.0, 50.0, "it holds in fresh draws"), (0.6, 5.0, "it falls short by "), (0.54, 50.0, "it isn't told by fresh draws")])
def test_fresh_draws_are_asked_for_the_motion_too(tmp_path, operate, share, value, words):
    program = tmp_path / "program"
    program.write_text(PROGRAM.format(python=sys.executable, path=sys.path, noted=str(tmp_path / "noted"), value=value, share=share))
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    shares = np.zeros((4, ROWS, COLUMNS))
    shares[0], shares[2] = 0.9, 0.1
    path = write_uncertain(tmp_path / "a.h5", shares=shares, quantiles=np.full((3, ROWS, COLUMNS), 20.0))
    code, told, complaint = operate(path, "--risk", "0.5", "--regime", "1/1", "--verify", "--peterka", program)
    line = told.splitlines()[-1]
    assert (code, complaint) == (0, "") and line.startswith(words) and f"{100 * share:.4g} % end in 1/1" in line


@pytest.mark.parametrize("value, words", [(50.0, "it holds in fresh draws"), (30.0, "it falls short by ")])
def test_fresh_draws_are_many_more_over_the_drift(tmp_path, operate, value, words):
    program, noted = tmp_path / "program", tmp_path / "noted"
    program.write_text(PROGRAM.format(python=sys.executable, path=sys.path, noted=str(noted), value=value, share=0))
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    path = write_uncertain(tmp_path / "a.h5")
    code, told, complaint = operate(path, "--risk", "0.95", "--hz", "0.5", "--mm", "0.1", "--verify", "--peterka", program)
    assert (code, complaint) == (0, "")
    worst = np.nanmax(plain(LOW, LOW >= 0, 0.5, 0.1))
    line = told.splitlines()[-1]
    assert line.startswith(words) and f"95 % reach {WEIGHT * value:.4g} N ({100 * (value / worst - 1):+.2g} %" in line
    assert "of 1,024 rigs, 960 of them new, at places of their own (frequency within ±0.5 Hz, gap within ±0.1 mm)" in line
    assert f"of all at least {100 * least_share_above(52, 1024):.3g} %, in 19 cases of 20" in line
    keys = dict(word.split("=") for word in noted.read_text().splitlines() if "=" in word)
    assert [float(keys[f"uncertainty.operating_point.{key}"]) for key in ("frequency_hz.from", "frequency_hz.to", "gap_m.from", "gap_m.to")] == [
        -0.5, 0.5, pytest.approx(-1e-4), pytest.approx(1e-4)]
    assert keys["axes.frequency_ratio.points"] == keys["axes.gap_ratio.points"] == "1"


@pytest.mark.parametrize("table", ["[uncertainty.operating_point.gap_ratio]\nstandard_deviation = 0.01\n",
                                   '[uncertainty.covariance]\nof = ["operating_point.gap_m"]\nmean = [0.0]\nmatrix = [[1e-9]]\n'])
def test_a_place_that_is_uncertain_in_the_job_keeps_that(tmp_path, table):
    path = write_uncertain(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file.attrs["job"] += table
    with PeterkaFile(path) as file:
        changes, words, widths = fresh_draws._offsets(file, (0.5, 0.1))
        _, still, _ = fresh_draws._offsets(file, (0.5, 0.0))
    assert set(changes) == {f"uncertainty.operating_point.frequency_hz.{end}" for end in ("from", "to")}
    assert words == ("at places of their own (frequency within ±0.5 Hz, gap as uncertain as the job has it, around the worst of 5 places "
                     "within ±0.1 mm)")
    assert still == "at places of their own (frequency within ±0.5 Hz, gap as uncertain as the job has it)"
    assert widths == {"gap_ratio": pytest.approx(0.1 / 0.89)}


def test_the_drift_of_an_uncertain_gap_is_verified_too(tmp_path, operate):
    """The program is asked for places all over the drift by which the place was chosen."""
    noted, program = tmp_path / "noted", tmp_path / "program"
    program.write_text(PROGRAM.format(python=sys.executable, path=sys.path, noted=str(noted), value=30.0, share=0))
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    path = write_uncertain(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file.attrs["job"] += "[uncertainty.operating_point.gap_m]\nstandard_deviation = 2e-5\n"
    code, told, complaint = operate(path, "--risk", "0.95", "--hz", "0.5", "--mm", "0.1", "--verify", "--peterka", program)
    assert (code, complaint) == (0, ""), complaint
    gap = float(re.search(r"gap_ratio ([\d.]+)", told)[1])
    keys = dict(word.split("=") for word in noted.read_text().splitlines() if "=" in word)
    assert [float(keys[f"axes.gap_ratio.{key}"]) for key in ("from", "to", "points")] == pytest.approx(
        [gap - 0.1 / 0.89, gap + 0.1 / 0.89, 5], rel=1e-4)


def with_offset(path, deviation):
    write_uncertain(path)
    with SealedFile(path, "r+") as file:
        file.attrs["job"] = f"{file.attrs['job']}[uncertainty.operating_point.gap_m]\nstandard_deviation = {deviation}\n"
    return path


@pytest.mark.parametrize("deviation, told", [
    (20e-3, "the offset of the gap in [uncertainty] has a standard deviation of 20 mm, and the largest gap of the map is 2.67 mm"), (20e-6, None)])
def test_an_offset_larger_than_all_gaps_is_told(tmp_path, operate, deviation, told):
    code, out, _ = operate(with_offset(tmp_path / "a.h5", deviation), "--risk", "0.95", "--hz", "0", "--mm", "0")
    assert code == 0 and ((told in out) if told else "the offset of" not in out)


@pytest.mark.parametrize("deviation, is_told", [(20e-3, True), (20e-6, False)])
def test_a_precompression_is_as_large_as_its_size(tmp_path, deviation, is_told):
    path = with_offset(tmp_path / "a.h5", deviation)
    with SealedFile(path, "r+") as file:
        file["gap_ratio"][...] = np.linspace(-3, -1, len(file["gap_ratio"]))
    with PeterkaFile(path) as file:
        assert [("of 20 mm" in line, "is 2.67 mm" in line) for line in risk.strange_offsets(file)] == [(True, True)] * is_told


def test_a_drift_in_hertz_that_no_box_has_room_for_is_named(tmp_path, operate):
    code, _, complaint = operate(write_uncertain(tmp_path / "a.h5"), "--risk", "0.95", "--hz", "30", "--mm", "0.05")
    assert code == 2 and "has its frequency from 4.5 to 18 Hz: a drift of ±30 Hz leaves that from each of its cells" in complaint
    assert "allow at most ±6.532 Hz" in complaint and complaint.count("\n") == 1


def test_a_drift_along_what_the_map_does_not_vary_is_refused(tmp_path, operate):
    path = write_uncertain(tmp_path / "a.h5")
    with SealedFile(path, "r+") as file:
        file.attrs["job"] = file.attrs["job"].replace("gap_ratio = {", "contact.stiffness_n_per_m = {")
        file["contact_stiffness_n_per_m"] = np.linspace(1e6, 5e6, ROWS)
    for extra in ([], ["--risk", "0.95"]):
        code, _, complaint = operate(path, "--mm", "20", "--hz", "0.5", *extra)
        assert code == 2 and "has one and the same gap in all cells, so that it doesn't tell what a drift of ±20 mm does" in complaint
    assert "drift of" not in operate(path, "--hz", "0.5", "--risk", "0.95")[2]
