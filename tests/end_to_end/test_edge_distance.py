"""Distance of a cell from the boundary of its own motion: continued in many small steps by the search of a sweep, the motion
keeps its label until just before the edge and loses it just after."""

import itertools
import re

import edges_of_motions
import h5py
import jobs
import launch
import map_contents
import numpy as np
import pytest
import xarray

pytestmark = pytest.mark.thorough

POINTS = 40
STEPS = 200  # of a sweep; the edge lies between its last two points
HAIR = 1 / (2 * (STEPS - 1) - 1)  # of the distance
WINDOW = jobs.axis("frequency_ratio", 0.5, 4.5, POINTS) + jobs.axis("gap_ratio", 0.0, 5.0, POINTS)
FOLD, DOUBLING, GRAZING, NONE, UNKNOWN = range(5)
UNRESOLVED = 4  # regime


def run(folder, text, *arguments, **options):
    folder.mkdir(exist_ok=True)
    jobs.write(folder, text)
    finished = launch.run("run", "job.toml", *arguments, cwd=folder, **options)
    assert finished.returncode == 0, finished.stderr
    return folder / "job.h5"


def distances_job(points=POINTS):
    return jobs.small_curves(points=points) + "\n[curves]\nedge_distance = true\n"


@pytest.fixture(scope="module")
def distances(tmp_path_factory):
    return run(tmp_path_factory.mktemp("distances"), distances_job())


@pytest.fixture(scope="module")
def orbits(tmp_path_factory):
    """(x - y, x' - y') of each cell's orbit at forcing phase 0, from a map."""
    text = jobs.RIG.format(kind="map", title="orbits") + WINDOW
    path = run(tmp_path_factory.mktemp("orbits"), text + '\n[output]\nfields = ["orbit"]\n')
    with h5py.File(path) as file:
        return file["orbit_displacement"][()], file["orbit_velocity"][()]


def sweep_to(side, place, change, state):
    """A sweep that continues a motion from a point across its edge."""
    other = "gap_ratio" if side == "frequency_ratio" else "frequency_ratio"
    low, high = sorted([place[side], place[side] + change * (1 + HAIR)])
    direction = "up" if change > 0 else "down"
    rest = (f"[sweep]\ngap_ratio = [{float(place[other])!r}]\ndirection = \"{direction}\"\n" if other == "gap_ratio" else
            f"[operating_point]\nfrequency_ratio = {float(place[other])!r}\n[sweep]\ndirection = \"{direction}\"\n")
    return (jobs.RIG.format(kind="sweep", title="dragged") + jobs.axis(side, repr(float(low)), repr(float(high)), STEPS) + rest
            + f"[start]\ndisplacement_ratio = {float(state[0])!r}\nvelocity_ratio = {float(state[1] + place['frequency_ratio'])!r}\n"
            + "[steady_state]\nmax_cycles = 20000\n")


def labels_along(path, change):
    with h5py.File(path) as file:
        labels = list(zip(*(file[name][0] for name in ("regime", "impacts", "period"))))
    return labels if change > 0 else labels[::-1]


def taking_turns(groups):
    """One of each group in turn, until all are empty."""
    queues = [list(group) for group in groups]
    while queues:
        for queue in queues:
            yield queue.pop()
        queues = [queue for queue in queues if queue]


def dragged_cells(path, orbits, side, count, seed=5):
    """Random cells of this number from all regimes with an edge."""
    with h5py.File(path) as file:
        axes = {name: file[name][()] for name in ("frequency_ratio", "gap_ratio")}
        known = np.argwhere((file["regime"][()] == 1) & (file[f"edge_kind_{side}"][()] < NONE)
                            & (file[f"edge_kind_{side}"][()] >= FOLD))
        label_of = {tuple(cell): tuple(int(file[name][tuple(cell)]) for name in ("period", "impacts")) for cell in known}
        mixed = [tuple(cell) for cell in np.random.default_rng(seed).permutation(known)]
        groups = ([cell for cell in mixed if label_of[cell] == label] for label in sorted(set(label_of.values())))
        for row, column in itertools.islice(taking_turns(groups), count):
            place = {"frequency_ratio": float(axes["frequency_ratio"][column]), "gap_ratio": float(axes["gap_ratio"][row])}
            label = tuple(file[name][row, column] for name in ("regime", "impacts", "period"))
            yield (place, float(file[f"edge_distance_{side}"][row, column]), label,
                   tuple(float(field[row, column]) for field in orbits))


@pytest.mark.parametrize("side", ["frequency_ratio", "gap_ratio"])
def test_a_motion_keeps_its_label_up_to_its_edge_and_no_further(tmp_path, distances, orbits, side):
    labels, up_to_the_last = set(), []
    for place, change, label, state in dragged_cells(distances, orbits, side, 32):
        labels.add(label)
        along = labels_along(run(tmp_path, sweep_to(side, place, change, state), "--quiet", "--fresh"), change)
        # just before a period doubling no cell settles within its cycles
        settled = [met for met in along[:-2] if met[0] != UNRESOLVED]
        assert settled == [label] * len(settled) and len(settled) > STEPS - 12, (place, change)
        up_to_the_last.append(along[-2] == label)
        assert along[-1] != label, (place, change)
    # just before the edge the motion's basin is tiny, and a step may leave it
    assert len(labels) >= 12 and sum(up_to_the_last) >= 28


def test_nearly_all_cells_know_their_edge(distances):
    with xarray.open_dataset(distances) as data:
        periodic = (data.regime == 1) & (data.period <= 4)
        for side in ("frequency_ratio", "gap_ratio"):
            kinds, changes = data[f"edge_kind_{side}"], data[f"edge_distance_{side}"]
            assert kinds.dims == ("gap_ratio", "frequency_ratio")
            assert int((kinds == UNKNOWN).sum()) <= 0.01 * int(periodic.sum())
            assert (kinds.where(periodic) >= FOLD).sum() == periodic.sum()
            assert (kinds.where(data.regime == 2, -128) == -128).all()  # chaos has no edge of its own
            assert (np.isfinite(changes) == ((kinds >= FOLD) & (kinds < NONE))).all()


def test_without_impacts_the_edge_is_where_the_free_motion_reaches_the_stop(distances):
    damping = 0.06 / (2 * 0.298 * 2 * np.pi * 4.5)
    def reach(eta):
        return eta**2 / np.hypot(1 - eta**2, 2 * damping * eta)
    with xarray.open_dataset(distances) as data:
        free = (data.regime == 0).values
        eta, gap = np.meshgrid(data.frequency_ratio, data.gap_ratio)
        up, along = data.edge_distance_gap_ratio.values, data.edge_distance_frequency_ratio.values
    inside = free & (reach(eta) >= 0)
    assert np.allclose(up[inside], reach(eta[inside]) - gap[inside], atol=1e-9)
    known = free & np.isfinite(along)
    assert known.sum() > 100
    assert np.allclose(reach(eta[known] + along[known]), gap[known], rtol=1e-9)
    nearer = eta[known][:, None] + 0.999 * along[known][:, None] * np.linspace(-1, 1, 101)
    assert (reach(np.clip(nearer, 0.5, 4.5)) < gap[known][:, None]).all()


@pytest.mark.parametrize("ranks", [2, 3])
def test_distances_are_the_same_at_any_number_of_ranks(tmp_path, distances, ranks):
    map_contents.assert_same_map(run(tmp_path, distances_job(), "--quiet", ranks=ranks), distances)


def test_the_summary_tells_how_many_are_known(tmp_path):
    jobs.write(tmp_path, distances_job(points=12))
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 0 and "Edge of a cell's own motion within the window" in finished.stdout
    with h5py.File(tmp_path / "job.h5") as file:
        kinds = [file[f"edge_kind_{side}"][()] for side in ("frequency_ratio", "gap_ratio")]
    lost = [100 * (kind == UNKNOWN).sum() / (kind >= FOLD).sum() for kind in kinds]
    told = re.search(r"([\d.]+) % could not be followed along the frequency, ([\d.]+) % along the gap", finished.stdout)
    assert [float(share) for share in told.groups()] == pytest.approx(lost, abs=0.06)


def test_a_doubled_motion_ends_where_it_merges_back(tmp_path):
    """2/2 of the paper's rig without a gap, born from 1/1 at 2.659361979: it ends there, at its lower end."""
    window = jobs.axis("frequency_ratio", 2.60, 2.80, 24) + jobs.axis("gap_ratio", 0.0, 0.4, 3)
    path = run(tmp_path, jobs.RIG.format(kind="curves", title="doubled") + window + "[curves]\nedge_distance = true\n")
    with h5py.File(path) as file:
        frequency, doubled = file["frequency_ratio"][()], file["period"][0] == 2
        distance, kind = file["edge_distance_frequency_ratio"][0], file["edge_kind_frequency_ratio"][0]
    assert doubled.sum() > 12 and (kind[doubled] == DOUBLING).all()
    near = doubled & (frequency < 2.74)  # its other period doubling is at 2.83
    assert np.allclose(frequency[near] + distance[near], 2.659361979, atol=1e-8)


@pytest.mark.parametrize("seed, rigs", [(11, edges_of_motions.random_rigs), (12, edges_of_motions.random_rigs), (11, edges_of_motions.rigid_rigs)])
def test_random_motions_end_where_dragging_them_ends(tmp_path, seed, rigs):
    """Cells of a random rig, along both axes; tests/endurance.sh edges tests 1,000 of ten rigs."""
    rig = rigs(seed, 3)[-1]
    cells = edges_of_motions.cells_of(tmp_path, rig)
    found = {(cell, side): edges_of_motions.disagreement(tmp_path, rig, cells, cell, side)
             for cell, side in edges_of_motions.random_cells(cells, 16, seed)}
    assert not {place: words for place, words in found.items() if words not in (None, "unknown")}
    assert list(found.values()).count("unknown") <= 1


def test_a_border_is_one_of_its_label(tmp_path):
    """At each border listed in the summary, motions of that label, found from many starts, are fewer on one side. The end of
    the motion without impact at a gap of 1 mm, 13.57 Hz, is not a border of 1/1."""
    rig = {"zeta": 0.06 / (2 * 0.298 * 2 * np.pi * 4.5), "stop": edges_of_motions.kept_claims.spring(5.5e6, 1.2e3), "eta": 0.6,
           "gap": 0.0}
    gap = 1.1235955056179776
    told = list(edges_of_motions.borders_told(tmp_path, rig, gap))
    assert (0, 1) in {(impacts, period) for impacts, period, *_ in told} and len(told) > 8
    assert not [frequency for impacts, period, frequency, _ in told if (impacts, period) == (1, 1) and abs(4.5 * frequency - 13.5678172) < 1e-3]
    # where the motion without impact ends, its basin vanishes: known in closed form
    assert [place for place in told if place[0] > 0 and not edges_of_motions.is_border(tmp_path, rig, gap, *place)] == []
