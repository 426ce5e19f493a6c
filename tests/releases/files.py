#!/usr/bin/python3
"""Files of every kind of job, made on one release of Debian, and what another one makes of them.

    files.py make FOLDER              computes them with build/peterka (or PETERKA_BINARY): of each job a whole file, and
                                      of those that go on one of a run that was stopped
    files.py compare FOLDER OTHER     FOLDER's, made here, with OTHER's, made elsewhere

Each file of OTHER is opened, and is complete to the program here. Where SUNDIALS carried nothing and the attribute `arithmetic`
is the same, it has the same bytes as the file made here; elsewhere the same labels, but where rounding decides, and forces to
1e-9. A stopped one is gone on with to the bytes of the whole file, or refused with the release or arithmetic that is another.
Exit codes: 0 all is so; 1 something isn't.
"""

import os
import shutil
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

TESTS = Path(__file__).resolve().parents[1]
os.environ.setdefault("PETERKA_BINARY", str(TESTS.parent / "build" / "peterka"))
sys.path[:0] = [str(TESTS / "end_to_end"), str(TESTS.parent / "postprocess")]

import jobs  # noqa: E402
import launch  # noqa: E402
import many_starts  # noqa: E402
import map_contents  # noqa: E402

ROUNDING_DECIDES = 20  # above this sensitivity
AGREE = 1e-9  # relative
OF_THE_MACHINE = {"summary/checksum", "summary/bytes", "summary/frame"}  # they cover the libraries' names, too
REFUSED = "so the rest would not fit to the last bit"
SENSITIVITY = '\n[output]\nfields = ["sensitivity"]\n'
CUBIC = "damping_ns_per_m = 0.06", "damping_ns_per_m = 0.06\ncubic_stiffness_n_per_m3 = 238"
HUNT_CROSSLEY = 'law = "hunt_crossley"\nstiffness_n_per_m_pow_n = 3e8\nexponent = 1.5\ndissipation_s_per_m = 5.0\n'


def with_engine(engine, text):
    return f'{text}\n[solver]\nengine = "{engine}"\n' + SENSITIVITY


JOBS = {
    "map": jobs.medium_map() + SENSITIVITY,
    "cubic": with_engine("split", jobs.small_map().replace(*CUBIC)),
    "audited": jobs.small_map() + "\n[audit]\ncells = 100\n" + SENSITIVITY,
    "refined": jobs.small_map(129, 129) + "\n[refine]\nlevels = 2\n" + SENSITIVITY,
    "rigid": jobs.with_rigid_stop(jobs.small_map()) + SENSITIVITY,
    "basin": jobs.small_basin(64) + SENSITIVITY,
    "starts": many_starts.small_map(fields=["sensitivity"]),
    "sweep": jobs.small_sweep(points=201) + SENSITIVITY,
    "cvode": with_engine("cvode", jobs.small_map(20, 18)),
    "arkode": with_engine("arkode", jobs.small_map(32, 3).replace(jobs.KELVIN_VOIGT, HUNT_CROSSLEY)),
    "curves": jobs.small_curves(64),
    "trace": jobs.trace(2.0),
}
BY_SUNDIALS = {"cvode", "arkode", "audited"}  # entirely or in part
WRITTEN_WHOLE = {"curves", "trace"}  # their runs are never stopped midway


def make(folder):
    folder.mkdir()
    for name, text in JOBS.items():
        jobs.write(folder, text, f"{name}.toml")
        finished = launch.run("run", f"{name}.toml", "--quiet", cwd=folder, ranks=2)
        assert finished.returncode == 0, finished.stderr
        if name not in WRITTEN_WHOLE:
            make_stopped(folder, name)


def make_stopped(folder, name):
    """A run that ends with some of its tiles done, whatever the speed of this machine."""
    seconds, growth, path = 0.01, 1.3, folder / f"{name}-stopped.h5"
    for _ in range(100):
        finished = launch.run("run", f"{name}.toml", "--output", path, "--max-wall", seconds, cwd=folder)
        assert finished.returncode in (0, 5), finished.stderr
        if finished.returncode == 5 and map_contents.done_tiles(path) > 0:
            return
        if finished.returncode == 5:
            seconds *= growth
        else:  # between this and the previous duration
            path.unlink()
            growth = growth**0.5
            seconds /= growth
    raise AssertionError(f"{name}: no run ends with some of its tiles done")


def content(path):
    return {name: value for name, value in map_contents.datasets(path).items() if name not in OF_THE_MACHINE}


def one_arithmetic(*paths):
    found = set()
    for path in paths:
        with h5py.File(path) as file:
            found.add(file.attrs["arithmetic"])
    return len(found) == 1


def cells_without_rounding(file):
    """Mask of the cells not decided by rounding; in a sweep, whose points begin where the previous one ended, nor decided earlier."""
    sure = file["sensitivity"][()] <= ROUNDING_DECIDES
    if "direction" in file:
        down = file["direction"][()] < 0
        sure[down] = sure[down, ::-1]
        sure = np.logical_and.accumulate(sure, axis=1)
        sure[down] = sure[down, ::-1]
    return sure


def faults_of_cells(own, other):
    """Number of cells of two maps whose labels or forces differ, rounding excluded; and the number that agree, in words."""
    with h5py.File(own) as one, h5py.File(other) as two:
        sure = cells_without_rounding(one) & cells_without_rounding(two)
        faults = [f"{np.count_nonzero(wrong)} cells have another {label}" for label in ("regime", "impacts", "period")
                  if (wrong := sure & (one[label][()] != two[label][()])).any()]
        ours, theirs = (np.where(sure, file["peak_force_ratio"][()], 0) for file in (one, two))
        wrong = ~np.isclose(ours, theirs, rtol=AGREE, atol=0, equal_nan=True)
        if wrong.any():
            faults.append(f"{np.count_nonzero(wrong)} cells have another force")
        hit = theirs > 0
        worst = np.max(abs(ours[hit] / theirs[hit] - 1), initial=0)
        return faults, f"labels and forces of {np.count_nonzero(sure)} of {sure.size} cells agree, forces to {worst:.1e}"


def faults_of_numbers(own, other):
    """The numbers of two files without cells that differ by more than 1e-9 of the largest of their kind."""
    faults, worst = [], 0.0
    with h5py.File(own) as one, h5py.File(other) as two:
        for name in content(own):
            ours, theirs = one[name][()], two[name][()]
            if ours.shape != theirs.shape:
                faults.append(f"{name} has another length")
            elif ours.dtype.kind == "f" and ours.size > 0:
                scale = np.nanmax(abs(ours)) or 1
                worst = max(worst, np.nanmax(abs(ours - theirs), initial=0) / scale)
                if not np.allclose(ours, theirs, rtol=0, atol=AGREE * scale, equal_nan=True):
                    faults.append(f"{name} differs")
            elif not np.array_equal(ours, theirs):
                faults.append(f"{name} differs")
    return faults, f"numbers agree to {worst:.1e} of the largest of their kind"


def compared(name, own, other):
    """Faults, and the findings, in words."""
    if content(own) == content(other):
        return [], "the same bytes"
    if name not in BY_SUNDIALS and one_arithmetic(own, other):
        ours, theirs = content(own), content(other)
        return [f"{key} differs" for key in ours if ours[key] != theirs.get(key)], "not the same bytes"
    return faults_of_numbers(own, other) if name in WRITTEN_WHOLE else faults_of_cells(own, other)


def known_as_complete(folder, other, name):
    """Faults reported by the program and the readers here for a whole file from elsewhere."""
    import peterka

    peterka.open(other / f"{name}.h5")
    before = (other / f"{name}.h5").read_bytes()
    run = launch.run("run", folder / f"{name}.toml", "--output", other / f"{name}.h5", cwd=folder)
    faults = [] if run.returncode == 0 and "complete" in run.stdout + run.stderr else [f"is not taken as complete: {run.stderr}"]
    return faults + ([] if (other / f"{name}.h5").read_bytes() == before else ["is changed"])


def gone_on_with(folder, other, name):
    """Faults, and the outcome for a stopped run's file from elsewhere, in words."""
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(shutil.copy(other / f"{name}-stopped.h5", scratch))
        run = launch.run("run", folder / f"{name}.toml", "--output", path, cwd=folder, ranks=2)
        if run.returncode == 3 and REFUSED in run.stderr:
            untouched = path.read_bytes() == (other / f"{name}-stopped.h5").read_bytes()
            return [] if untouched else ["the refused file is changed"], "refused: " + run.stderr.split(" was ")[1].split(",")[0]
        if run.returncode != 0:
            return [f"going on ends with {run.returncode}: {run.stderr}"], "not gone on with"
        same = content(path) == content(folder / f"{name}.h5")
        return [] if same else ["goes on to other bytes"], "gone on with, to the same bytes"


def compare(folder, other):
    failed = False
    for name in JOBS:
        faults, words = compared(name, folder / f"{name}.h5", other / f"{name}.h5")
        faults += known_as_complete(folder, other, name)
        if name not in WRITTEN_WHOLE:
            more, end = gone_on_with(folder, other, name)
            faults, words = faults + more, f"{words}; stopped: {end}"
        print(f"{name}: {words}" + "".join(f"\n    FAULT: {fault}" for fault in faults), flush=True)
        failed |= bool(faults)
    return 1 if failed else 0


def main(arguments):
    if len(arguments) == 2 and arguments[0] == "make":
        return make(Path(arguments[1]).resolve())
    if len(arguments) == 3 and arguments[0] == "compare":
        return compare(*(Path(name).resolve() for name in arguments[1:]))
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
