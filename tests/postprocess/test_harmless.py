"""Untrusted text on terminals, pictures and pages, and output that cannot be printed."""

import subprocess
import sys
from html import unescape
from html.parser import HTMLParser

import numpy as np
import pytest
from conftest import POSTPROCESS
from peterka.files.harmless import harmless
from peterka.measurements.points import MOST_LABELS
from picture_samples import write_map
from sealing import SealedFile
from study_samples import write_labels
from sweep_samples import write_sweep

pytestmark = pytest.mark.thorough

COMMAND = "a\x1b]0;owned\x07\x1b[2J\u009b31m\u202e\nb\r"
LIVE = "<script>alert(1)</script> ![x](http://a.example/?b) [y](javascript:z) `c` **d** | www.evil.example me@b.example"


def test_controls_are_shown_and_length_is_bounded():
    assert harmless(COMMAND) == r"a\x1b]0;owned\x07\x1b[2J\x9b31m\u202e\nb\r"
    assert harmless(harmless(COMMAND)) == harmless(COMMAND)
    assert harmless("Ω/ω = 2.0, 170 mm (§ 3)") == "Ω/ω = 2.0, 170 mm (§ 3)"
    assert harmless("x" * 10**8) == "x" * 159 + "…" and len(harmless("\x1b" * 1000, 40)) == 40
    assert harmless("\udc80") == r"\udc80"


def test_on_a_page_it_is_text_and_nothing_else():
    shown = harmless(LIVE, page=True)
    assert not set("<>[]`*|@!") & set(shown) and "http:" not in shown and "www.evil" not in shown
    assert unescape(shown) == LIVE
    for text in ("- item", "1. item", "1) item", "# head", "=====", "> quote", "+ item"):
        assert harmless(text, page=True) != text and unescape(harmless(text, page=True)) == text
    assert harmless("Peterka map, beam springs 170 mm: 0.5 of 4.5 (a)", page=True) == "Peterka map, beam springs 170 mm: 0.5 of 4.5 (a)"


class Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.seen = []

    def handle_starttag(self, tag, attrs):
        self.seen.append(tag)


def test_titles_are_text_on_the_results_page(tmp_path, run_program):
    study, pictures = write_labels(tmp_path / "s.h5", title=LIVE), tmp_path / "pictures"
    pictures.mkdir()
    (pictures / "s_labels.png").write_bytes(b"x")
    path = write_map(tmp_path / "m.h5", title=LIVE)
    with SealedFile(path, "r+") as file:
        file["summary/omitted"] = np.bytes_(f"{LIVE}\n\x1b[2J{LIVE}")
    assert run_program("results", study, path, "--page", tmp_path / "p.md", "--pictures", pictures)[0] == 0
    page = (tmp_path / "p.md").read_text(encoding="utf-8")
    tags = Tags()
    tags.feed(page)
    assert set(tags.seen) <= {"sup"} and "http:" not in page and "](javascript" not in page and "\x1b" not in page
    assert page.count("alert(1)") == 4


def test_terminals_get_no_commands(tmp_path, run_program):
    first, second = (write_map(tmp_path / f"{name}.h5", title=COMMAND) for name in ("a", "b\x1b[2J"))
    for arguments in ((first, second, "--formats", "png"), (first, tmp_path / "no\x1b[2Jmap.h5"), ("\x1b[2J",)):
        _, out, errors = run_program("compare", *arguments)
        assert all(letter.isprintable() or letter == "\n" for letter in out + errors), (out, errors)


@pytest.mark.parametrize("program, arguments", [("compare", ["a.h5", "a.h5", "--formats", "png"]), ("draw", ["a.h5"]),
                                                ("claims", ["."]), ("scaling", ["--help"])])
@pytest.mark.parametrize("stdout", [">/dev/full", ">&-"])
def test_what_cannot_be_printed_is_told_in_a_line_and_the_files_are_written(tmp_path, program, arguments, stdout):
    write_map(tmp_path / "a.h5")
    finished = subprocess.run(["sh", "-c", f'exec "$0" "$@" {stdout}', sys.executable, POSTPROCESS / f"{program}.py", *arguments],
                              cwd=tmp_path, capture_output=True, text=True)
    assert finished.returncode == 3, finished.stderr
    assert finished.stderr.startswith(f"{program}.py: standard output cannot be written: ")
    assert finished.stderr.count("\n") == 1
    if program == "compare":
        assert (tmp_path / "pictures" / "a_against_a.png").exists()


def measured(tmp_path, lines):
    path = tmp_path / "points.csv"
    path.write_text("frequency_ratio,force_ratio,gap_ratio,label\n" + lines)
    return path


def test_a_field_beyond_the_readers_limit(tmp_path, draw):
    points = measured(tmp_path, f'1.5,20,0,"{"x" * 200_000}"\n')
    outcome = draw(write_sweep(tmp_path / "s.h5"), "--measured", points)
    assert outcome.code == 2 and outcome.stderr.count("\n") == 1 and "no list of points" in outcome.stderr


def test_of_many_labels_some_are_written(tmp_path, draw):
    frequencies = np.linspace(1, 2.5, 20_000)
    points = measured(tmp_path, "".join(f"{f:.6f},20,0,label {n}\n" for n, f in enumerate(frequencies)))
    outcome = draw(write_sweep(tmp_path / "s.h5"), "--measured", points, "--formats", "png")
    assert outcome.code == 0, outcome.stderr
    assert f"{20_000 - MOST_LABELS} of 20000 labels are left out" in outcome.stdout
