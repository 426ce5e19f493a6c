"""The claims report: how claims are told, in Markdown and HTML, and the arithmetic behind them."""

from pathlib import Path

import numpy as np
import pytest
from peterka_claims import jumps, page, spans
from peterka_claims.folder import Plane
from peterka_claims.force_map import _best_turn
from peterka_claims.gap_zero import label, limits_hz, resonance
from peterka_claims.html import html
from peterka_claims.markdown import markdown
from peterka_claims.record import AGREES, DIFFERS, OPEN, claim, not_computed, off_by
from peterka_claims.sensitivity import Row
from peterka_claims.starts import both_nearest, depends_on_start
from picture_samples import write_map
from sweep_samples import write_sweep

CLAIMS = [("Group", [
    claim("a", "section 1", "Forces are <large> | or not.", "5 N", True, "+1 %", "unused", ["seen", "missing"]),
    claim("b", "section 2", "Forces are small.", "5 N", False, "+2 %", "a cause", ["seen"]),
    not_computed("c", "section 3", "Forces are zero.", "c.h5"),
])]


def plane(labels, force=None, gap_ratio=1.0, rows=None):
    """`labels`: (regime, p, q) by row and column; 1 Hz steps of the columns."""
    labels = np.array(labels)
    job = {"hammer": {"natural_frequency_hz": 1.0, "mass_kg": 1 / 9.80665}, "cart": {"amplitude_m": 1e-3},
           "operating_point": {"gap_ratio": gap_ratio, "frequency_ratio": 2.0}}
    count = labels.shape[1]
    force = np.ones(labels.shape[:2]) if force is None else np.array(force, dtype=float)
    return Plane(Path("a.h5"), "map", job, np.arange(labels.shape[0]) if rows is None else rows, 1.0 + np.arange(count),
                 labels[..., 0], labels[..., 1], labels[..., 2], force, None)


ONE, HALF, QUIET, CHAOS = (1, 1, 1), (1, 1, 2), (0, 0, 1), (2, 0, 0)


def test_the_reason_is_told_where_a_claim_differs_and_only_there():
    agreeing, differing, missing = CLAIMS[0][1]
    assert (agreeing.verdict, agreeing.why) == (AGREES, "")
    assert (differing.verdict, differing.why) == (DIFFERS, "a cause")
    assert missing.verdict == OPEN and "c.h5 is not in the folder" in missing.computed
    assert off_by(235, 204, "N") == "+31 N (+15.2 %)"


def test_markdown_has_table_fields_and_pictures_once():
    text = markdown(page.blocks(CLAIMS, [], lambda name: name == "seen"), "pictures")
    assert "3 claims of Aguiar and Weber, in our words; 1 agree, 1 differ, 1 not computed." in text
    assert "| Forces are &lt;large&gt; \\| or not. | section 1 | agrees |" in text
    assert "- Verdict: **differs**\n- By how much: +2 %\n- Likely why: a cause" in text
    assert text.count("](pictures/seen.png)") == 1 and "missing" not in text


def test_html_is_one_file_with_its_pictures(tmp_path):
    (tmp_path / "seen.png").write_bytes(b"\x89PNG")
    text = html(page.blocks(CLAIMS, [], lambda name: name == "seen"), tmp_path)
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


def test_where_the_maximum_turns_to_the_boundary():
    assert _best_turn(np.array([True, False, True, True, False, False])) == 4
    assert _best_turn(np.array([False, False])) == 0
    assert _best_turn(np.array([True, True])) == 2


def test_only_proved_labels_depend_on_the_start():
    found = depends_on_start([plane([[ONE, ONE, ONE, CHAOS]]), plane([[ONE, QUIET, CHAOS, CHAOS]]),
                              plane([[ONE, ONE, CHAOS, CHAOS]])])
    assert found.tolist() == [[False, True, False, False]]


def test_the_nearest_basin_with_both_outcomes(monkeypatch):
    basins = [plane([[ONE, QUIET]], gap_ratio=1.5), plane([[QUIET, QUIET]], gap_ratio=1.6),
              plane([[ONE, QUIET]], gap_ratio=2.5)]

    class Few:
        def planes(self, _):
            return basins

    near, beyond = both_nearest(Few(), "", 1.7)
    assert (near.gap_ratio, beyond.gap_ratio) == (1.5, 1.6)
    basins = basins[1:2]
    assert both_nearest(Few(), "", 1.7) == (None, None)


def row(printed, factors, values):
    return Row("force", "N", printed, "ci", np.array(factors), np.array(values, dtype=float))


def test_jumps_of_a_sweep(tmp_path):
    sweep = jumps.Sweep(write_sweep(tmp_path / "sweep.h5"))
    weight = 0.298 * 9.80665
    assert sweep.resonance(0) == pytest.approx((9.0, 40 * weight))
    assert sweep.end_of_band(0, "up") is None and sweep.end_of_band(0, "down") is None
    assert sweep.end_of_band(1.3, "up") == pytest.approx((1.8125 * 4.5, 60 * weight, 0))  # chaos above doesn't count
    assert sweep.end_of_band(1.3, "down") == pytest.approx((1.5625 * 4.5, 50 * weight, 0))
    assert sweep.doubling(1.3) == pytest.approx((1.75 * 4.5, 60 * weight))


def test_the_factor_that_removes_a_difference():
    assert row(204, [0.5, 1, 2], [104, 304, 604]).needed == pytest.approx(0.75)
    assert row(204, [0.5, 1, 2], [304, 304, np.nan]).answer == "no factor from 0.5 to 2"
    assert row(10, [0.25, 0.5, 1, 2], [20, 8, 12, 9]).needed == pytest.approx(0.75)  # the nearest of three
    assert row(None, [0.5, 0.75, 1, 2], [50, 9, 0, 30]).needed == 0.5
    assert row(None, [0.5, 1], [0, 9]).needed is None


def test_a_folder_without_files_gives_a_page_that_says_so(tmp_path, monkeypatch, capsys):
    import claims as program

    monkeypatch.setattr("sys.argv", ["claims.py", str(tmp_path), "--page", str(tmp_path / "page")])
    assert program.main() == 0
    assert "agrees" not in capsys.readouterr().out
    assert "peterka_170mm.h5 is not in the folder" in (tmp_path / "page" / "claims.md").read_text(encoding="utf-8")


def test_bad_files_and_folders_are_told_in_one_line(tmp_path, monkeypatch, capsys):
    import claims as program

    write_map(tmp_path / "gaps_170mm.h5")  # without its job
    for argument, words in ((tmp_path, "gaps_170mm.h5 holds no job that can be read"), (tmp_path / "no", "is no folder")):
        monkeypatch.setattr("sys.argv", ["claims.py", str(argument)])
        try:
            code = program.main()
        except SystemExit as stop:
            code = stop.code
        complaint = capsys.readouterr().err
        assert code == 2 and words in complaint and complaint.startswith("claims.py: ") and complaint.count("\n") == 1
