"""Cases without a row in test_axes_and_units.py: parts of a plane, borders over sweeps, verified places and measured points,
over axes in Hz, m and m/s as over ratios."""

import re
import sys

import numpy as np
import pytest

import jobs
import launch
from either_unit import RATIOS, SI, rig
from postprocessing import POSTPROCESS, program

pytestmark = pytest.mark.thorough

REGULAR = {
    "plane": lambda unit: rig("map") + unit.axis("frequency", 1.6, 2.1, 11) + unit.axis("gap", 0.3, 0.9, 9),
    "sweep": lambda unit: (rig("sweep") + unit.axis("frequency", 1.7, 2.0, 16) + '[sweep]\nsamples = 2\ndirection = "both"\n'
                           + unit.line("gap", [1.5])),
    "borders": lambda unit: (rig("curves") + unit.axis("frequency", 1.5, 2.2, 14) + unit.axis("gap", 1, 2, 14)
                             + "[curves]\nmax_period = 1\n" + unit.line("gap", [1.5])),
}


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """The file of a job in a unit, with the same name in both, computed on first use."""
    folders = {unit: tmp_path_factory.mktemp("ratios" if unit is RATIOS else "si") for unit in (RATIOS, SI)}

    def file(name, unit):
        stem = re.sub(r"\W+", "_", name)
        path = folders[unit] / f"{stem}.h5"
        if not path.exists():
            jobs.write(folders[unit], REGULAR[name](unit), f"{stem}.toml")
            finished = launch.run("run", f"{stem}.toml", "--quiet", cwd=folders[unit])
            assert finished.returncode == 0, finished.stderr
        return path
    return file


def both(files, name, folder, program_name, *arguments):
    """A program's output for the file in ratios and for that in SI units, in separate folders, without paths."""
    told = []
    for unit in (RATIOS, SI):
        here = folder / ("ratios" if unit is RATIOS else "si")
        here.mkdir(exist_ok=True)
        path = files(name, unit)
        told.append(program(program_name, here, path, *arguments).replace(str(path), path.name))
    return told


def test_a_part_is_named_in_ratios_or_in_si_units(files, tmp_path):
    """For the same place, whatever the file's own axes."""
    shown = []
    for unit in (RATIOS, SI):
        for place, units in (("1.7,1.9,0.4,0.7", "both"), ("7.65,8.55,0.356,0.623", "si")):
            folder = tmp_path / f"{len(shown)}"
            folder.mkdir()
            program("draw", folder, files("plane", unit), "--only", "map", "--formats", "png", "--units", units, "--zoom", place)
            shown.append((folder / "pictures" / "plane_map.png").read_bytes())
    assert shown[0] == shown[2] and shown[1] == shown[3] and shown[0] != shown[1]


@pytest.mark.parametrize("zoom, in_si", [((1.7, 1.9, 0.45, 0.675), False), ((7.65, 8.55, 0.4005, 0.60075), True)])
@pytest.mark.parametrize("unit", [RATIOS, SI], ids=["ratios", "si"])
def test_a_part_has_the_cells_at_its_ends(files, monkeypatch, unit, zoom, in_si):
    """The limits differ from user-given numbers in the last bit, in one unit
    or the other. Boundary cells are cut there, and the axes end at the limits."""
    monkeypatch.setattr(sys, "path", [str(POSTPROCESS), *sys.path])
    from peterka.pictures import open_file
    from peterka.cli.picture_options import zoomed

    beyond = np.array(zoom) * (1 + 0.025 * np.array([1, -1, 1, -1]))  # nearly a cell inside
    with open_file(files("plane", unit)) as file:
        with zoomed(file, zoom, in_si) as part:
            assert np.allclose(part.columns.values, [1.7, 1.75, 1.8, 1.85, 1.9])
            assert np.allclose(part.rows.values, [0.45, 0.525, 0.6, 0.675])
            assert np.allclose([*part.columns.edges[[0, -1]], *part.rows.edges[[0, -1]]], [1.7, 1.9, 0.45, 0.675])
        with zoomed(file, tuple(beyond), in_si) as part:
            assert np.allclose(part.columns.values, [1.75, 1.8, 1.85]) and np.allclose(part.rows.values, [0.45, 0.525, 0.6, 0.675])
            assert np.allclose(part.columns.edges[[0, -1]], [1.7 * 1.025, 1.9 * 0.975])
        with zoomed(file, (0.0, 100.0), in_si) as part:
            assert np.array_equal(part.columns.edges, file.columns.edges)


def test_borders_are_drawn_over_a_sweep_in_any_mixture(files, tmp_path):
    told = []
    for sweep in (RATIOS, SI):
        for curves in (RATIOS, SI):
            text = program("draw", tmp_path, files("sweep", sweep), "--curves", files("borders", curves), "--only", "response",
                           "--formats", "png")
            told.append([line for line in text.splitlines() if "fold" in line or "grazing" in line])
    assert told[0] and all(lines == told[0] for lines in told)


def test_maps_over_hz_of_different_rigs_are_compared_at_the_same_hz(files, tmp_path):
    jobs.write(tmp_path, REGULAR["plane"](SI).replace("natural_frequency_hz = 4.5", "natural_frequency_hz = 4.6"))
    assert launch.run("run", "job.toml", "--quiet", cwd=tmp_path).returncode == 0
    text = program("compare", tmp_path, files("plane", SI), tmp_path / "job.h5")
    assert "99 cells that both files hold" in text and re.search(r", at frequency [\d.]+ Hz, gap [\d.]+ mm \(gap_ratio", text)


def told_apart(text, beginning):
    """The line with this beginning, and all others."""
    line = next(line for line in text.splitlines() if line.startswith(beginning))
    return line, text.replace(line, "")


def test_where_to_operate_is_the_same_place(files, tmp_path):
    one, other = both(files, "plane", tmp_path, "operating_point", "--hz", 0.2, "--mm", 0.05, "--formats", "png")
    (best, rest), (other_best, other_rest) = (told_apart(text, "best: ") for text in (one, other))
    assert rest == other_rest and sorted(re.findall(r"[\d.]+", best)) == sorted(re.findall(r"[\d.]+", other_best))
    ways = [re.search(r"best: (\w+) [\d.]+ (Hz )?\((frequency_ratio )?", text).groups() for text in (best, other_best)]
    assert sorted(ways) == [("frequency", "Hz ", "frequency_ratio "), ("frequency_ratio", None, None)]  # the job's unit first
    verified = both(files, "plane", tmp_path, "operating_point", "--hz", 0.2, "--mm", 0.05, "--formats", "png", "--verify",
                    "--peterka", launch.BINARY)
    said = re.compile(r"^it holds in all (\d+) cells of the finer box: the worst has ([\d.]+) N \(", re.MULTILINE)
    found = [said.search(text) for text in verified]
    assert all(found), verified
    (cells, worst), (others, other_worst) = (match.groups() for match in found)
    assert cells == others == "289" and float(worst) == pytest.approx(float(other_worst), rel=1e-3)


@pytest.mark.parametrize("name, picture", [("plane", "map"), ("sweep", "response")])
def test_measured_points_are_held_against_the_same_numbers(files, tmp_path, name, picture):
    points = tmp_path / "points.csv"
    points.write_text("frequency_hz,gap_mm,force_n\n8.1,0.534,200\n8.5,1.335,210\n")
    one, other = both(files, name, tmp_path, "draw", "--only", picture, "--formats", "png", "--measured", points)
    assert one == other and "measured [N]" in one
