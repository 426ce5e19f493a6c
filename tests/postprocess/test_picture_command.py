"""draw.py from a shell: pictures for each file, their size, its output and exit codes."""

import fcntl
import os
import subprocess
import sys

import matplotlib.image
import pytest
from conftest import POSTPROCESS
from picture_samples import MISSING, PLAIN, write_basin, write_map
from sealing import unfinish

pytestmark = pytest.mark.thorough

MAP_PICTURES = ["force_1_1", "force_all", "map"]
BASIN_PICTURES = ["basin", "basin_impact"]


def run_draw(folder, *arguments):
    command = [sys.executable, POSTPROCESS / "draw.py", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120, check=False)


def test_pictures_go_into_the_folder_pictures(tmp_path):
    write_map(tmp_path / "rig.h5")
    write_basin(tmp_path / "starts.h5")
    done = run_draw(tmp_path, "rig.h5", "starts.h5")
    expected = [f"{stem}_{name}.{suffix}" for stem, names in (("rig", MAP_PICTURES), ("starts", BASIN_PICTURES))
                for name in names for suffix in ("pdf", "png")]
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(path.name for path in (tmp_path / "pictures").iterdir()) == expected
    assert sorted(done.stdout.split()) == [f"pictures/{name}" for name in expected]


def test_a_file_that_a_run_has_open_can_be_drawn(tmp_path):
    with open(write_map(tmp_path / "rig.h5"), "rb+") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        done = run_draw(tmp_path, "rig.h5", "--formats", "png")
    assert (done.returncode, done.stderr) == (0, "")


def test_pictures_are_a_column_wide_at_300_dots_per_inch(tmp_path, draw):
    draw(write_map(tmp_path / "rig.h5"), write_basin(tmp_path / "starts.h5"), "--formats", "png")
    for picture in (tmp_path / "out").iterdir():
        height, width = matplotlib.image.imread(picture).shape[:2]
        assert width == 1110, picture.name  # 3.7 in
        assert 900 < height < 1600, picture.name


def test_pdf_holds_the_cells_as_one_image(tmp_path, draw):
    draw(write_map(tmp_path / "rig.h5"), "--formats", "pdf")
    content = (tmp_path / "out" / "rig_map.pdf").read_bytes()
    assert content.startswith(b"%PDF-") and content.count(b"/Subtype /Image") >= 1


def test_the_same_file_gives_the_same_bytes(tmp_path, draw):
    path = write_map(tmp_path / "rig.h5")
    draw(path)
    first = {picture.name: picture.read_bytes() for picture in (tmp_path / "out").iterdir()}
    draw(path)
    assert first == {picture.name: picture.read_bytes() for picture in (tmp_path / "out").iterdir()}


def test_a_file_of_which_only_what_follows_the_cells_is_missing_says_so(tmp_path, draw):
    path = write_map(tmp_path / "a.h5")
    unfinish(path)
    outcome = draw(path)
    assert outcome.code == 0
    assert outcome.stdout.splitlines()[0] == f"{path}: incomplete: last steps missing"


def test_an_incomplete_file_is_drawn_with_a_notice(tmp_path, draw):
    path = write_map(tmp_path / "rig.h5", [*PLAIN[:3], [MISSING] * 4])
    outcome = draw(path, "--formats", "png")
    assert outcome.code == 0
    assert outcome.stdout.splitlines()[0] == f"{path}: incomplete: 75.0 % computed"
    assert len(outcome.pictures) == 3


def test_a_map_without_any_cell_yet(tmp_path, draw):
    outcome = draw(write_map(tmp_path / "rig.h5", [[MISSING] * 4] * 4), "--formats", "png")
    assert (outcome.code, outcome.pictures) == (0, ["rig_map.png"])
    assert "incomplete: 0.0 % computed" in outcome.stdout and "force_1_1 is left out" in outcome.stdout


def test_a_reader_that_leaves_early_is_no_fault(tmp_path):
    write_map(tmp_path / "rig.h5")
    script = '"$1" "$2" rig.h5 --formats png | true; echo "${PIPESTATUS[0]}"'
    done = subprocess.run(["bash", "-c", script, "bash", sys.executable, POSTPROCESS / "draw.py"], cwd=tmp_path,
                          capture_output=True, text=True, timeout=120, check=False)
    assert (done.stdout, done.stderr) == ("0\n", "")
    assert len(list((tmp_path / "pictures").iterdir())) == 3


@pytest.mark.parametrize("arguments, reason", [
    ([], "required"),
    (["a.h5", "--formats", "png,exe"], "'png,exe' is not a list of png and pdf"),
    (["a.h5", "--colour", "red"], "unrecognized arguments"),
    (["a/x.h5", "b/x.h5"], "overwrite"),
])
def test_bad_arguments(draw, arguments, reason):
    outcome = draw(*arguments)
    assert outcome.code == 2 and reason in outcome.stderr and outcome.stderr.count("\n") == 1


def test_a_folder_that_cannot_be_made(tmp_path, draw):
    (tmp_path / "out").write_text("in the way")
    outcome = draw(write_map(tmp_path / "rig.h5"))
    assert outcome.code == 3 and "cannot write" in outcome.stderr and outcome.stderr.count("\n") == 1


def test_nothing_half_written_is_left(tmp_path, draw, monkeypatch):
    from matplotlib.figure import Figure

    def full_disk(figure, path, **_):
        path.write(b"half")
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr(Figure, "savefig", full_disk)
    outcome = draw(write_map(tmp_path / "rig.h5"))
    assert (outcome.code, outcome.pictures) == (3, [])
    assert "No space left" in outcome.stderr


def test_a_part_of_a_file_that_is_not_finished_says_so(tmp_path, draw):
    path = write_map(tmp_path / "a.h5")
    unfinish(path)
    outcome = draw(path, "--zoom", "1,3,0,3", "--units", "ratio")
    assert outcome.code == 0
    assert outcome.stdout.splitlines()[0] == f"{path}: incomplete: last steps missing"
