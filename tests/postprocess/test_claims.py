"""The claims report: presentation of claims, in Markdown and HTML, and the underlying arithmetic."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from claim_samples import CHAOS, HALF, ONE, QUIET, plane
from peterka.claims import jumps, page, spans
from peterka.claims.force_map import _best_turn
from peterka.claims.gap_zero import at_edge, in_words, label, limits_hz, resonance
from peterka.claims.html import html
from peterka.claims.markdown import markdown
from peterka.claims.record import AGREES, DIFFERS, LIMITS, OPEN, claim, not_computed, off_by
from peterka.claims.sensitivity import Row
from peterka.claims.starts import depends_on_start, first_of_the_rest
from picture_samples import write_map
from sweep_samples import write_sweep

CLAIMS = [("Group", [
    claim("a", "section 1", "Forces are <large> | or not.", "5 N", True, "+1 %", "unused", ["seen", "missing"]),
    claim("b", "section 2", "Forces are small.", "5 N", False, "+2 %", "a cause", ["seen"]),
    not_computed("c", "section 3", "Forces are zero.", "c.h5"),
])]


def test_the_reason_is_told_where_a_claim_differs_and_only_there():
    agreeing, differing, missing = CLAIMS[0][1]
    assert (agreeing.verdict, agreeing.why) == (AGREES, "")
    assert (differing.verdict, differing.why) == (DIFFERS, "a cause")
    assert missing.verdict == OPEN and "c.h5 is not in the folder" in missing.computed
    assert off_by(235, 204, "N") == "+31 N (+15.2 %)"


def test_markdown_has_table_fields_and_pictures_once():
    text = markdown(page.blocks(CLAIMS, [], lambda name: name == "seen", {}), "pictures")
    assert "3 claims of Aguiar and Weber, in our words; 1 agree, 1 differ, 1 not computed." in text
    assert "| Forces are &lt;large&gt; \\| or not. | section 1 | agrees |" in text
    assert "- Verdict: **differs**\n- By how much: +2 %\n- Likely why: a cause" in text
    assert text.count("](pictures/seen.png)") == 1 and "missing" not in text
    assert all(f"- {name}: {limit}" in text for name, limit in LIMITS)


def test_a_picture_of_several_groups_is_in_the_first_one():
    groups = [(title, [claim(title, "section 1", "Forces are large.", "5 N", True, pictures=names)])
              for title, names in (("one", ["a", "b"]), ("two", ["b", "c"]), ("three", ["c", "a"]))]
    shown = [block.names for block in page.blocks(groups, [], lambda name: True, {}) if isinstance(block, page.Pictures)]
    assert shown == [("a", "b"), ("c",)]


def test_html_is_one_file_with_its_pictures(tmp_path):
    (tmp_path / "seen.png").write_bytes(b"\x89PNG")
    text = html(page.blocks(CLAIMS, [], lambda name: name == "seen", {}), tmp_path)
    assert text.count('src="data:image/png;base64,iVBORw=="') == 1
    assert "Forces are &lt;large&gt;" in text and "<strong>differs</strong>" in text and "<code>jobs/paper.sh</code>" in text


def test_spans():
    assert spans.spans([True, False, True, True]) == [(0, 0), (2, 3)]
    assert spans.span_around([True, False, True, True], 3) == (2, 3)
    assert spans.span_around([True, False], 1) is None
    assert spans.widest([False]) is None


def test_bands_lie_half_way_to_the_next_point_and_the_widest_counts():
    one = plane([[ONE, QUIET, ONE, ONE, ONE, HALF]], [[9, 1, 2, 4, 3, 5]])
    assert limits_hz(one, 1, 1) == (2.5, 5.5)
    assert limits_hz(one, 1, 1, inside_hz=1.2) == (1.0, 1.5)
    assert limits_hz(one, 2, 2) is None
    assert resonance(one, 1, 1) == pytest.approx((4.0, 4.0))
    assert [label(one, hertz) for hertz in (1, 2, 6)] == ["1/1", "no impact", "1/2"]
    assert label(plane([[CHAOS, ONE]]), 1) == "chaotic"


def test_a_limit_at_the_edge_of_the_map_is_no_number_to_compare():
    one = plane([[ONE, ONE, HALF, QUIET, HALF, HALF]])
    assert at_edge(one, limits_hz(one, 1, 1)) == (True, False)
    assert at_edge(one, limits_hz(one, 1, 2)) == (False, True)
    assert in_words(one, limits_hz(one, 1, 2)) == "from 4.50 to beyond 6.00 Hz, where the map ends"
    assert in_words(one, limits_hz(one, 1, 2, inside_hz=3)) == "from 2.50 to 3.50 Hz"


def test_where_the_maximum_turns_to_the_boundary():
    assert _best_turn(np.array([True, False, True, True, False, False])) == 4
    assert _best_turn(np.array([False, False])) == 0
    assert _best_turn(np.array([True, True])) == 2


def test_only_proved_labels_depend_on_the_start():
    found = depends_on_start([plane([[ONE, ONE, ONE, CHAOS]]), plane([[ONE, QUIET, CHAOS, CHAOS]]),
                              plane([[ONE, ONE, CHAOS, CHAOS]])])
    assert found.tolist() == [[False, True, False, False]]


def test_the_row_from_which_all_reach_a_limit():
    assert first_of_the_rest([0.2, 0.05, 0.1, 0.3], 0.1) == 2
    assert first_of_the_rest([0.1, 0.3], 0.1) == 0
    assert first_of_the_rest([0.3, 0.05], 0.1) is None


def test_what_lies_between_the_bands():
    rows = [[ONE] * 3 + [CHAOS] * 2 + [HALF] * 3, [ONE] * 2 + [QUIET] * 6, [QUIET] * 8]
    lower, between, beyond = spans.around_bands(plane(rows))
    assert lower.sum(axis=1).tolist() == [3, 2, 2]  # the last row takes the limits of the previous one
    assert between.sum(axis=1).tolist() == [2, 3, 3] and beyond.sum(axis=1).tolist() == [3, 3, 3]
    assert (lower.astype(int) + between + beyond == 1).all()


def row(printed, factors, values, has_both=None):
    values = np.array(values, dtype=float)
    return Row("force", "N", printed, "ci", np.array(factors), values, 100 - values,
               np.array(has_both or [False] * len(values)))


def test_jumps_of_a_sweep(tmp_path):
    sweep = jumps.Sweep(write_sweep(tmp_path / "sweep.h5"))
    weight = 0.298 * 9.80665
    assert sweep.resonance(0) == pytest.approx((9.0, 40 * weight))
    assert sweep.end_of_band(0, "up") is None and sweep.end_of_band(0, "down") is None
    assert sweep.end_of_band(1.3, "up") == pytest.approx((1.8125 * 4.5, 60 * weight, 0))  # chaos above does not count
    assert sweep.end_of_band(1.3, "down") == pytest.approx((1.5625 * 4.5, 50 * weight, 0))
    assert [sweep.has_maximum(gap, way) for gap in (0, 1.3) for way in ("up", "down")] == [True, True, False, False]  # cut off by a jump
    assert sweep.resonance(1.3, "up")[0] == pytest.approx(1.75 * 4.5)
    assert sweep.resonance(1.3, "down")[0] == pytest.approx(1.5 * 4.5)
    assert sweep.doubling(1.3) == pytest.approx((1.75 * 4.5, 60 * weight))


def test_the_factor_that_removes_a_difference():
    assert row(204, [0.5, 1, 2], [104, 304, 604]).needed == pytest.approx(0.75)
    assert row(204, [0.5, 1, 2], [304, 304, np.nan]).answer == "no factor from 0.5 to 2"
    assert row(10, [0.25, 0.5, 1, 2], [20, 8, 12, 9]).needed == pytest.approx(0.75)  # the nearest of three
    assert row(None, [0.5, 0.75, 1, 2], [50, 99, 0, 30], [True, False, False, True]).needed == 0.5
    assert row(None, [0.5, 1], [99, 0]).answer == "none tried from 0.5 to 1 has 10 % of each"


def test_the_sensitivity_table_gives_both_shares_of_a_basin_and_says_what_some_are():
    text = markdown(page.blocks([], [row(204, [0.5, 1], [104, np.nan]), row(None, [0.5, 1], [98, 0])], bool, {}), "pictures")
    assert "(some = at least 10 % of the starts of each kind)" in text
    assert "| no factor from 0.5 to 1 | 104 N | no band |" in text
    assert "| some of each | stop's damping ci | none tried from 0.5 to 1 has 10 % of each | 98 / 2 N | 0 / 100 N |" in text


def test_a_folder_without_files_gives_a_page_that_says_so(tmp_path, run_program):
    code, told, _ = run_program("claims", tmp_path, "--page", tmp_path / "page")
    assert code == 0 and "not computed  gap_0_robust" in told and "agrees" not in told and "differs" not in told
    assert "peterka_170mm.h5 is not in the folder" in (tmp_path / "page" / "claims.md").read_text(encoding="utf-8")


def test_verdicts_that_nobody_reads_to_the_end_leave_the_page_and_no_traceback(tmp_path):
    program = Path(__file__).resolve().parents[2] / "postprocess" / "claims.py"
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run([sys.executable, program, tmp_path], stdout=writing, stderr=subprocess.PIPE, text=True, timeout=60,
                          check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "claims.md").exists()


@pytest.mark.parametrize("folder, words", [(".", "gaps_170mm.h5 holds no job that can be read"), ("no", "is no folder")])
def test_bad_files_and_folders_are_told_in_one_line(tmp_path, run_program, folder, words):
    write_map(tmp_path / "gaps_170mm.h5")  # without its job
    code, _, complaint = run_program("claims", folder)
    assert code == 2 and words in complaint and complaint.startswith("claims.py: ") and complaint.count("\n") == 1
