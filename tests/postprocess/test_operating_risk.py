"""operating_point.py --risk on synthetic maps of drawn rigs: against plain loops, what is refused, and what fresh draws are asked for."""

import math
import re
import stat
import sys

import numpy as np
import pytest
from peterka.cli import operating_point
from peterka.files.regimes import CHAOTIC, NOT_COMPUTED
from peterka.maps.map_file import PeterkaFile
from peterka.operating import fresh_draws, risk
from peterka.operating.admitted import Quantity
from peterka.operating.drift import reach, worst_of_boxes
from peterka.operating.places import Place
from peterka.sampling import draws_needed, least_share, least_share_above
from picture_samples import write_map
from picture_texts import faults_of_layout
from sealing import SealedFile
from starts_samples import EMPTY
from uncertain_samples import KINDS, by_probability, forces, probabilities, write_uncertain

pytestmark = pytest.mark.thorough

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
    program, changes = program_that_computes(tmp_path, 30.0)
    path = write_uncertain(tmp_path / "a.h5", rows=1)
    code, told, complaint = operate(path, "--risk", "0.95", "--verify", "--peterka", program)
    assert (code, complaint) == (0, "") and "probability of 0.95, drift ±0.5 Hz: above 0" in told
    assert "at the worst of 17 places within the drift, frequency_ratio " in told
    assert [keys["axes.gap_ratio.points"] for keys in changes()] == ["1", "1"]
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
with Path({noted!r}).open("a") as noted:
    noted.write("\\n".join(words) + "\\n\\n")
changes = dict(word.split("=") for word in words if "=" in word)
shape = tuple(int(changes[f"axes.{{axis}}.points"]) for axis in ("gap_ratio", "frequency_ratio"))
quantiles = np.full((3, *shape), {value})
if shape != (1, 1):
    quantiles += 10
    quantiles[0, shape[0] // 4, shape[1] // 3] -= 1
shares = None
if {share}:
    shares = np.zeros((4, *shape))
    shares[0] = {share}
    if shape != (1, 1):  # the worst place, or two of which the motion is too rare to tell a value in it, the second one more so
        shares[0, :2, 3], shares[0, shape[0] // 4, shape[1] // 3] = 0.54, 0.53 if {rare} else {share}
    shares[2] = 1 - shares[0]
write_uncertain(Path(words[words.index("--output") + 1]), *shape, rigs=int(changes.get("uncertainty.rigs", 64)), quantiles=quantiles,
                shares=shares)
"""


def program_that_computes(folder, value, share=0, rare=False):
    """(an executable that writes a box with its worst value at a fourth of the rows and a third of the columns, and `value` at a place
    alone; reads {changed key: value} of each time that it was started)"""
    noted, program = folder / "noted", folder / "program"
    program.write_text(PROGRAM.format(python=sys.executable, path=sys.path, noted=str(noted), value=value, share=share, rare=rare))
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return program, lambda: [dict(word.split("=") for word in words.splitlines() if "=" in word) for words in noted.read_text().split("\n\n") if words]


@pytest.mark.parametrize("share, value, words", [
    (1.0, 50.0, "it holds in fresh draws"), (0.6, 5.0, "it falls short in fresh draws"), (0.54, 50.0, "it isn't told by fresh draws")])
def test_fresh_draws_are_asked_for_the_motion_too(tmp_path, operate, share, value, words):
    program, _ = program_that_computes(tmp_path, value, share)
    shares = np.zeros((4, ROWS, COLUMNS))
    shares[0], shares[2] = 0.9, 0.1
    path = write_uncertain(tmp_path / "a.h5", shares=shares, quantiles=np.full((3, ROWS, COLUMNS), 20.0))
    code, told, complaint = operate(path, "--risk", "0.5", "--regime", "1/1", "--verify", "--peterka", program)
    line = told.splitlines()[-1]
    assert (code, complaint) == (0, "") and line.startswith(words) and f"{100 * share:.4g} % end in 1/1" in line


def test_the_worst_place_is_where_a_motion_is_rarest(tmp_path, operate):
    program, changes = program_that_computes(tmp_path, 50.0, 0.9, rare=True)
    shares = np.zeros((4, ROWS, COLUMNS))
    shares[0], shares[2] = 0.9, 0.1
    path = write_uncertain(tmp_path / "a.h5", shares=shares, quantiles=np.full((3, ROWS, COLUMNS), 20.0))
    code, _, complaint = operate(path, "--risk", "0.5", "--regime", "1/1", "--verify", "--peterka", program)
    assert (code, complaint) == (0, "")
    within, alone = changes()
    for axis, at in (("frequency_ratio", 17 // 3), ("gap_ratio", 17 // 4)):
        ends = [float(within[f"axes.{axis}.{key}"]) for key in ("from", "to")]
        assert float(alone[f"axes.{axis}.from"]) == pytest.approx(np.linspace(*ends, 17)[at])


@pytest.mark.parametrize("value, words", [(50.0, "it holds in fresh draws"), (30.0, "it falls short in fresh draws")])
def test_fresh_draws_are_many_more_at_the_worst_place_of_the_drift(tmp_path, operate, value, words):
    program, changes = program_that_computes(tmp_path, value)
    path = write_uncertain(tmp_path / "a.h5")
    code, told, complaint = operate(path, "--risk", "0.95", "--hz", "0.5", "--mm", "0.1", "--verify", "--peterka", program)
    assert (code, complaint) == (0, "")
    worst = np.nanmax(plain(LOW, LOW >= 0, 0.5, 0.1))
    line, change = told.splitlines()[-1], 100 * (value / worst - 1)
    beside = f"{change:+.2g}" if abs(change) < 10 else f"{change:+.0f}"
    assert line.startswith(f"{words} ({beside} % beside the map's): of 1,024 rigs, 960 of them new, at the worst of 289 places within the drift, frequency_ratio ")
    assert f"95 % reach {WEIGHT * value:.4g} N; of all at least {100 * least_share_above(52, 1024):.3g} % there, in 19 cases of 20" in line
    ratio, gap = (float(re.search(rf"best: .*{name} ([\d.]+)", told)[1]) for name in ("frequency_ratio", "gap_ratio"))
    within, alone = changes()
    for axis, middle, width, at in (("frequency_ratio", ratio, 0.5 / 4.5, 17 // 3), ("gap_ratio", gap, 0.1 / 0.89, 17 // 4)):
        ends = [float(within[f"axes.{axis}.{key}"]) for key in ("from", "to")]
        assert ends == pytest.approx([middle - width, middle + width], rel=1e-4) and within[f"axes.{axis}.points"] == "17"
        assert [float(alone[f"axes.{axis}.{key}"]) for key in ("from", "to", "points")] == pytest.approx([np.linspace(*ends, 17)[at]] * 2 + [1])
    assert "uncertainty.rigs" not in within and alone["uncertainty.rigs"] == "1024"
    hertz, millimetres = (float(number) for number in re.search(r"within the drift, .*?([\d.]+) Hz.*?([\d.]+) mm", line).groups())
    assert hertz == pytest.approx(4.5 * float(alone["axes.frequency_ratio.from"]), rel=1e-4)
    assert millimetres == pytest.approx(0.89 * float(alone["axes.gap_ratio.from"]), rel=1e-4)


def test_without_a_drift_the_place_alone_is_drawn(tmp_path, operate):
    program, changes = program_that_computes(tmp_path, 30.0)
    told = operate(write_uncertain(tmp_path / "a.h5"), "--risk", "0.95", "--hz", "0", "--mm", "0", "--verify", "--peterka", program)[1]
    assert len(changes()) == 1 and "960 of them new, at this place, 95 % reach" in told.splitlines()[-1]


@pytest.mark.parametrize("change, told", [(1.5, "+50 %"), (1.012, "+1.2 %"), (0.0, "-100 %"), (0.962, "-3.8 %")])
def test_changes_are_told_without_powers_of_ten(change, told):
    place, quantity = Place(0, 0, 20.0, 20.0, (1, 1), 1.0), Quantity("peak_force", "", 1.0, "N")
    assert f"({told} beside the map's)" in fresh_draws.text_of(fresh_draws.Fresh(1024, 960, "here", 20 * change), place, 0.95, quantity)


def test_chaos_at_the_best_place_is_told(tmp_path, operate):
    chaos = np.zeros((4, ROWS, COLUMNS))
    chaos[[kind[0] == CHAOTIC for kind in KINDS].index(True)] = 1
    periodic = np.zeros((4, ROWS, COLUMNS))
    periodic[0] = 1
    for shares, is_told in ((chaos, True), (periodic, False)):
        told = operate(write_uncertain(tmp_path / "a.h5", shares=shares), "--risk", "0.95", "--hz", "0", "--mm", "0")[1]
        assert ("there chaos is the commonest motion, whose force is the largest one" in told) == is_told


def test_what_is_not_computed_is_not_known(tmp_path, operate):
    path = write_uncertain(tmp_path / "a.h5", quantiles=np.zeros((3, ROWS, COLUMNS)))
    assert "has no cell at which" in operate(path, "--risk", "0.95")[2]
    with SealedFile(path, "r+") as file:
        file["regime"][-1] = NOT_COMPUTED
    assert "has no cell among those that are computed at which" in operate(path, "--risk", "0.95")[2]


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
