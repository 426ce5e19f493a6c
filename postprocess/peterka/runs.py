"""Runs jobs from Python with the program itself, under mpirun, and returns its file as a dataset."""

import os
import re
import shutil
import tempfile
import tomllib
import warnings
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray

from .errors import JobError, PeterkaError
from .files.checked_hdf5 import CheckedFile
from .files.dataset import dataset_of
from .launching import Progress, launch
from .pictures import open_file
from .toml import text_of

BAD_JOB = 2
DONE = (0, 4)  # 4: some cells failed, and say so
CHECKOUT = Path(__file__).resolve().parents[2]
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
MORE_RANKS_THAN_CORES = {
    "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe", "PRTE_MCA_hwloc_default_binding_policy": "none",
    "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "OMPI_MCA_reachable": "weighted",
}
RIG = re.compile(r"""^[ \t]*(?:rig|"rig"|'rig')[ \t]*=.*$""", re.MULTILINE)
PLACE = re.compile(r"^(?:peterka: )?\S*?job\.toml:", re.MULTILINE)


def open(path: str | os.PathLike[str]) -> xarray.Dataset:  # noqa: A001: peterka.open
    """Opens, checks and verifies the file at this path and returns it as a dataset; values are read lazily.

    Dimensions are (gap_ratio, frequency_ratio) for a map, (velocity_ratio, displacement_ratio) for a basin, (branch,
    frequency_ratio) for a sweep and (time,) for a trace, unless the job names other axes. Units are in the variables'
    attributes; the resolved job is the attribute `job`. A dataset in a group of the file has the group's name as prefix, as
    in data["attractors/cells"]. Of a file that a run has not finished, the cells without a result have regime -128 (UserWarning).
    Raises PeterkaFileError if the file is truncated, damaged or not a file of peterka."""
    with open_file(path) as file:
        reader = type(file)
        if not file.is_complete:
            warnings.warn(f"{os.fspath(path)}: the run isn't finished: what has no result yet holds fill values, such as regime -128, and attractors may still be found", stacklevel=2)
    data = reader(path).data
    assert isinstance(data, CheckedFile)
    return dataset_of(data)


def run(job: str | os.PathLike[str] | Mapping[str, Any], ranks: int = 2, *, output: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        progress: Progress = False, **changes: Any) -> xarray.Dataset:
    """Computes a job and returns its file as open() does; a file that already holds the result is only opened.

    `job`: the path of a job file, its text in TOML, or its tables as dicts. `ranks`: number of MPI ranks; with 1, mpirun is not used.
    `output`: where to keep the file, which by default isn't; a dict is the job's table of that name, as in `changes`. `progress`: True shows a progress bar on stderr; a function is called
    with the finished share, 0 to 1. An interrupted run leaves `output` behind, and the same call resumes it.
    `changes`: overrides of the job's keys: `table__key=value` for --set table.key=value, or a whole table as table={key:
    value}. Raises JobError with all faults of the job, PeterkaFileError as open() does, other PeterkaErrors if the program
    fails or is missing, and ValueError for ranks < 1. The program is PETERKA_BINARY, else that of the build beside this
    package, else the one on the PATH."""
    with tempfile.TemporaryDirectory(prefix="peterka-") as folder:
        path = _written(job, Path(folder))
        if isinstance(output, Mapping):
            output, changes = None, changes | {"output": output}
        result = Path(output) if output is not None else Path(folder) / "result.h5"
        settings = [word for key, value in _flat(changes) for word in ("--set", f"{key}={_override(value)}")]
        quiet = ["--quiet"] if progress is False else []
        _call(["run", _argument(path), "--output", _argument(result), *quiet, *settings], ranks, progress)
        data = open(result)
        return data if output is not None else data.load()


def compute(job: Mapping[str, Any], output: Path) -> None:
    """Computes a job, given by its tables, into a file that isn't opened. Raises as run() does."""
    with tempfile.TemporaryDirectory(prefix="peterka-") as folder:
        _call(["run", _argument(_written(job, Path(folder))), "--output", _argument(output), "--quiet"], 1)


def check(job: str | os.PathLike[str] | Mapping[str, Any], **changes: Any) -> str:
    """The meaning and cost of a job, as printed by the program's `check`. Raises JobError with all faults of the
    job, other PeterkaErrors if the program fails or is missing."""
    with tempfile.TemporaryDirectory(prefix="peterka-") as folder:
        settings = [word for key, value in _flat(changes) for word in ("--set", f"{key}={_override(value)}")]
        return _call(["check", _argument(_written(job, Path(folder))), *settings], 1)


def _written(job: str | os.PathLike[str] | Mapping[str, Any], folder: Path) -> Path:
    """The path of a job; text or tables are first written to a file in `folder`. Rig files are resolved from the current directory."""
    if isinstance(job, Mapping):
        job = text_of(job)
    elif isinstance(job, os.PathLike) or "\n" not in job:
        return Path(job)
    path = folder / "job.toml"
    path.write_text(_with_rig_from_here(job), encoding="utf-8")
    return path


def _with_rig_from_here(job: str) -> str:
    """The job's text with an absolute path to its rig file; invalid TOML is returned unchanged, for the program to report."""
    try:
        rig = tomllib.loads(job).get("rig")
    except tomllib.TOMLDecodeError:
        return job
    if not isinstance(rig, str) or "\0" in rig:
        return job
    line = text_of({"rig": str(Path(rig).absolute())}).rstrip("\n")
    return RIG.sub(lambda _: line, job, count=1)


def _argument(path: str | os.PathLike[str]) -> str:
    """The path in a form that the program cannot take for an option."""
    return os.path.join(".", path) if str(path).startswith("-") else str(path)


def _flat(changes: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """(table.key, value) of each change."""
    for name, value in changes.items():
        key = name.replace("__", ".")
        if isinstance(value, Mapping):
            yield from ((f"{key}.{inner}", one) for inner, one in _flat(value))
        else:
            yield key, value


def _override(value: object) -> str:
    return value if isinstance(value, str) else text_of({"value": value}).removeprefix("value = ").strip()


def _call(arguments: Sequence[str], ranks: int, progress: Progress = False) -> str:
    if ranks < 1:
        raise ValueError(f"{ranks} ranks can't compute anything")
    if any("\0" in argument for argument in arguments):
        raise PeterkaError("a path or a setting has a byte of zero in it")
    under = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    environment = (MORE_RANKS_THAN_CORES | (AS_ROOT if os.geteuid() == 0 else {})) if ranks > 1 else {}
    try:
        done = launch([*under, _binary(), *arguments], os.environ | environment, progress)
    except FileNotFoundError as error:
        raise PeterkaError(f"{error.filename} is not here; an MPI has to be installed for {ranks} ranks") from error
    if done.code == BAD_JOB:
        raise JobError(_faults(done.stderr))
    if done.code not in DONE:
        raise PeterkaError(done.stderr.strip() or f"the program ended with code {done.code}")
    return done.stdout


def _faults(text: str) -> list[str]:
    """One fault per line of the program's output, without what mpirun appends."""
    lines = text.split("\n-----")[0].splitlines()
    faults = [PLACE.sub("job:", line).removeprefix("peterka: ") for line in lines if line.strip()]
    return faults or ["the job is refused without a word"]


def _binary() -> str:
    for found in (os.environ.get("PETERKA_BINARY"), CHECKOUT / "build" / "peterka", shutil.which("peterka")):
        if found and Path(found).is_file():
            return str(found)
    raise PeterkaError("the program peterka isn't here: build it (jobs/prepare.sh), put it on the PATH, or name it in "
                       "PETERKA_BINARY")
