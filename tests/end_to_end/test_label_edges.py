"""Whether the coarse map's labels show a curve, or why not: stated for each point, compared with the labels themselves and,
where [start] hides a motion, with the results of a map's other starts."""

import re

import h5py
import numpy as np
import pytest

import jobs
import launch

pytestmark = pytest.mark.thorough

FOLD, DOUBLING, GRAZING = range(3)
EDGE, SAME_LABEL, OTHER_START, NARROW, UNKNOWN = range(5)
CELLS = 32
# From rest hardly any start leads to impacts there; 1/2 coexists.
HIDDEN = jobs.axis("frequency_ratio", 3.0, 4.4, 12) + jobs.axis("gap_ratio", 1.5, 3.0, 12)


def run(folder, text):
    folder.mkdir(exist_ok=True)
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", cwd=folder)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5", finished.stdout


@pytest.fixture(scope="module")
def curves(tmp_path_factory):
    path, summary = run(tmp_path_factory.mktemp("curves"), jobs.small_curves(points=CELLS))
    with h5py.File(path) as file:
        return {name: file[name][()] for name in file if isinstance(file[name], h5py.Dataset)}, summary


def of_points(data, name):
    return np.repeat(data[f"curve_{name}"], data["curve_points"])


def neighbours(data):
    """(midpoint of two neighbours in cells, their labels) wherever these differ."""
    labels = np.stack([data["regime"], data["impacts"], data["period"]], axis=-1)
    columns, rows = np.meshgrid(np.arange(labels.shape[1]), np.arange(labels.shape[0]))
    for one, other in (((slice(None), slice(None, -1)), (slice(None), slice(1, None))),
                       ((slice(None, -1), slice(None)), (slice(1, None), slice(None)))):
        differ = (labels[one] != labels[other]).any(axis=-1)
        middle = np.stack([columns[one] + columns[other], rows[one] + rows[other]], axis=-1)[differ] / 2
        yield from zip(middle, labels[one][differ], labels[other][differ])


def may_end_there(label, kind, p, q):
    """Whether a cell's motion may be one that the curve bounds; p of a grazing equals that of its orbit or one more."""
    regime, impacts, period = (int(number) for number in label)
    if regime == 0:
        return kind == GRAZING and p <= 1
    if regime != 1:
        return False
    allowed = {FOLD: {(p, q)}, DOUBLING: {(p, q), (2 * p, 2 * q)}, GRAZING: {(p - 1, q), (p, q), (p + 1, q)}}[kind]
    return (impacts, period) in allowed


def test_edges_are_where_labels_change_and_nowhere_else(curves):
    data, _ = curves
    steps = {name: np.diff(data[name])[0] for name in ("frequency_ratio", "gap_ratio")}
    where = np.column_stack([(data[f"point_{name}"] - data[name][0]) / steps[name] for name in steps])
    changes = list(neighbours(data))
    middles = np.array([middle for middle, *_ in changes])
    kinds, ps, qs = (of_points(data, name) for name in ("kind", "impacts", "period"))
    expected = np.array([any(may_end_there(label, kind, p, q) for i in np.flatnonzero(np.hypot(*(middles - place).T) <= 1)
                             for label in changes[i][1:]) for place, kind, p, q in zip(where, kinds, ps, qs)])
    told = data["point_edge"] == EDGE
    sure = kinds != GRAZING  # for which the file does not tell whether p includes the new impact
    assert sure.sum() > 500 and (told == expected)[sure].all()
    assert (expected | ~told).all() and told[~sure].sum() > 500
    assert (told == expected).mean() > 0.97


def test_most_curves_have_an_edge_and_each_other_one_a_reason(curves):
    data, summary = curves
    assert set(data["curve_edge"]) <= {EDGE, SAME_LABEL, OTHER_START, NARROW}
    with_edge = int((data["curve_edge"] == EDGE).sum())
    assert with_edge > 0.8 * len(data["curve"])
    assert f"end on {with_edge} of the {len(data['curve'])} curves" in summary
    told = {kind: sum(int(number) for number in re.findall(words + r".*?why (\d+) curves? ha[sv]e? no", summary)) for kind, words in (
        (SAME_LABEL, "but on both sides"), (OTHER_START, "ends elsewhere"), (NARROW, "narrower than a cell"))}
    assert told == {kind: int((data["curve_edge"] == kind).sum()) for kind in told}
    assert (data["point_edge"] == UNKNOWN).mean() < 0.01


def test_a_motion_that_the_start_hides_lives_in_cells_beside_the_curve(tmp_path):
    starts = "\n[starts]\ncount = 16\n"
    path, _ = run(tmp_path / "curves", jobs.RIG.format(kind="curves", title="hidden") + HIDDEN + starts)
    attractors, _ = run(tmp_path / "map", jobs.RIG.format(kind="map", title="hidden") + HIDDEN + starts)
    with h5py.File(attractors) as file:
        lives = ((file["attractor_impacts"][()] == 1) & (file["attractor_period"][()] == 2)).any(axis=0)
        axes = [file["frequency_ratio"][()], file["gap_ratio"][()]]
    with h5py.File(path) as file:
        data = {name: file[name][()] for name in file if isinstance(file[name], h5py.Dataset)}
    assert not ((data["impacts"] == 1) & (data["period"] == 2)).any()
    of_1_2 = (of_points(data, "kind") == FOLD) & (of_points(data, "impacts") == 1) & (of_points(data, "period") == 2)
    assert of_1_2.sum() > 20 and (data["point_edge"][of_1_2] == OTHER_START).mean() > 0.8
    near = []
    for point in np.flatnonzero(of_1_2 & (data["point_edge"] == OTHER_START)):
        across, up = ((data[f"point_{name}"][point] - axis[0]) / (axis[1] - axis[0])
                      for name, axis in zip(("frequency_ratio", "gap_ratio"), axes))
        rows, columns = (slice(max(int(at) - 1, 0), int(at) + 3) for at in (up, across))
        near.append(lives[rows, columns].any())
    assert np.mean(near) > 0.95
    assert (data["curve_edge"][(data["curve_impacts"] == 1) & (data["curve_period"] == 2)] != EDGE).all()
