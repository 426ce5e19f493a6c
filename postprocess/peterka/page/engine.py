"""The program's engine in WebAssembly, built from src by src/page/build_wasm.sh when it is first needed, or installed with the
program; and the numbers of a cell in the order in which it takes them (CellNumber in src/page/interface.hpp)."""

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ..files.coordinates import TWINS, unit_of
from ..files.job_axes import axes_of_job
from ..files.opened import OpenedFile

Compiled = Callable[[int, int], None]  # told how many of how many files are compiled

ROOT = Path(__file__).resolve().parents[3]
SOURCE = ROOT / "src"
SCRIPT = SOURCE / "page" / "build_wasm.sh"
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
LAWS = {
    "kelvin_voigt": ("stiffness_n_per_m", "damping_ns_per_m"),
    "restitution": ("coefficient",),
    "hunt_crossley": ("stiffness_n_per_m_pow_n", "exponent", "dissipation_s_per_m"),
}
ENGINES = ("auto", "exact", "split", "cvode", "arkode")
CUBIC_FORMS = ("relative", "absolute")
NEEDED = ("mass_kg", "cubic_stiffness_n_per_m3", "amplitude_m", "contact_first", "contact_second", "contact_third")
PLACE = {"operating_point": ("frequency_ratio", "gap_ratio"), "start": ("displacement_ratio", "velocity_ratio")}


class NoEngine(Exception):
    """The page has no engine; the message gives the reason and the remedy."""


def module(cache: Path | None = None, compiled: Compiled = lambda done, files: None) -> bytes:
    """The bytes of the module, built into the cache (default: build/page beside src) if it is not there. Raises NoEngine."""
    return path(cache, compiled).read_bytes()


def path(cache: Path | None = None, compiled: Compiled = lambda done, files: None) -> Path:
    """The file of the module: in the cache, or, without sources, where it was installed. Raises NoEngine."""
    if not SCRIPT.is_file():
        if installed := _installed():
            return installed
        raise NoEngine(f"the program's sources are not here ({SCRIPT} is missing), nor an engine that was installed with the program")
    built = _cached(cache)
    if not built.is_file():
        _build(built, compiled)
    return built


def is_to_be_built(cache: Path | None = None) -> bool:
    """Whether module() will build it first, which takes a minute."""
    return SCRIPT.is_file() and not _cached(cache).is_file()


def version() -> str:
    """Of the engine and the numbers that a page gives it; "none" where there is no engine."""
    if SCRIPT.is_file():
        return _fingerprint()[:8]
    installed = _installed()
    return installed.stem.removeprefix("engine-")[:8] if installed else "none"


def _cached(cache: Path | None) -> Path:
    return (cache or Path(os.environ.get("PETERKA_PAGE_CACHE", ROOT / "build" / "page"))) / f"engine-{_fingerprint()}.wasm"


def _installed() -> Path | None:
    """The path of an engine that was installed with this package or with the program on the PATH; None without one."""
    program = shutil.which("peterka")
    beside = Path(program).resolve().parents[1:2] if program else []
    for prefix in (*Path(__file__).resolve().parents, *beside):
        for engine in sorted((prefix / "share/peterka/page").glob("engine-*.wasm")):
            return engine
    return None


def _build(built: Path, compiled: Compiled) -> None:
    try:
        built.parent.mkdir(parents=True, exist_ok=True)
        with (tempfile.TemporaryFile("w+") as complaints,
              subprocess.Popen([SCRIPT, built], stdout=subprocess.PIPE, stderr=complaints, text=True) as script):
            _tell_each_file(script, compiled)
            code = script.wait()
            complaints.seek(0)
            said = complaints.read()
    except OSError as error:
        raise NoEngine(f"the engine cannot be built: {error}") from error
    if code != 0:
        lines = said.strip().splitlines() or ["it says nothing"]
        packages = subprocess.run([SCRIPT.with_name("packages.sh")], capture_output=True, text=True, check=False).stdout
        raise NoEngine(f"the engine cannot be built: {lines[0][:200]}; on Debian: apt-get install {packages.strip()}")
    for old in built.parent.glob("engine-*.wasm"):
        if old != built:
            old.unlink(missing_ok=True)


def _tell_each_file(script: "subprocess.Popen[str]", compiled: Compiled) -> None:
    """Of the lines that the build script prints: the number of files, then each file that is compiled."""
    lines = iter(script.stdout or ())
    files = next(lines, "").strip()
    for done, _ in enumerate(lines, 1):
        if files.isdigit():
            compiled(done, int(files))


def _fingerprint() -> str:
    digest = hashlib.sha256()
    for path in sorted(_made_of()):
        digest.update(str(path.relative_to(SOURCE)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


def _made_of() -> set[Path]:
    """The set of all files of src on which the module depends: its sources, their includes, and the build script."""
    patterns = (SOURCE / "engine_sources.txt").read_text(encoding="utf-8").split()
    waiting = {path for pattern in patterns if not pattern.startswith("!") for path in SOURCE.glob(pattern)}
    waiting -= {SOURCE / pattern[1:] for pattern in patterns}
    waiting |= {SOURCE / "engine_sources.txt", *(path for path in SCRIPT.parent.iterdir() if path.is_file())}
    found = set()
    while waiting:
        path = waiting.pop()
        found.add(path)
        included = {SOURCE / name for name in INCLUDE.findall(path.read_text(encoding="utf-8"))}
        waiting |= {other for other in included if other.is_file()} - found
    return found


def cell_numbers(file: OpenedFile) -> dict[str, float | None]:
    """{name: number or None} from the file's job in the order of CellNumber; None also for numbers that vary from cell to
    cell. The law's own names stand for its numbers under `contact`."""
    text = file.data.attribute("job")
    try:
        job = tomllib.loads(text)  # type: ignore[arg-type]  # non-text is refused below
        numbers = _numbers(job)
        lacking = [name for name in NEEDED if numbers[name] is None and name not in _set_by_axes(file)]
        if lacking:
            raise KeyError(lacking[0])
        return numbers | _place(file, job)
    except (TypeError, KeyError, ValueError, AttributeError) as error:
        raise NoEngine(f"the job in the file can't be read ({type(error).__name__}: {str(error)[:100]})") from error


# For an axis by its table and key: the number of CellNumber that it sets, and those that it replaces.
OF_AXES = {
    "hammer_mass_kg": "mass_kg", "hammer_natural_frequency_hz": "natural_frequency_hz", "hammer_stiffness_n_per_m": "stiffness_n_per_m",
    "hammer_damping_ns_per_m": "damping_ns_per_m", "hammer_damping_ratio": "damping_ratio",
    "hammer_cubic_stiffness_n_per_m3": "cubic_stiffness_n_per_m3", "cart_amplitude_m": "amplitude_m",
    "start_displacement_ratio": "displacement_ratio", "start_velocity_ratio": "velocity_ratio",
    "start_displacement_m": "displacement_m", "start_velocity_m_per_s": "velocity_m_per_s",
}
GIVE_WAY = {"natural_frequency_hz": ["stiffness_n_per_m"], "stiffness_n_per_m": ["natural_frequency_hz"],
            "damping_ns_per_m": ["damping_ratio"], "damping_ratio": ["damping_ns_per_m"],
            **{ratio: [si] for ratio, si in TWINS.items()}}


def numbers_of_axis(file: OpenedFile, name: str) -> tuple[str, list[str]]:
    """(the number of a cell that an axis sets, those that it clears). SI numbers whose ratio varies from cell to cell, such
    as gap_m over the cart's amplitude, are converted to ratios by the page (engine.js, settled)."""
    sets = OF_AXES.get(name, name)
    if name.startswith("contact_"):
        try:
            names = LAWS[tomllib.loads(str(file.data.attribute("job")))["contact"]["law"]]
        except (ValueError, KeyError, TypeError):
            names = ()  # cell_numbers reports the job's fault
        key = name.removeprefix("contact_")
        sets = f"contact_{('first', 'second', 'third')[names.index(key)]}" if key in names else name
    return sets, GIVE_WAY.get(sets, [])


def _place(file: OpenedFile, job: Mapping[str, Any]) -> dict[str, float | None]:
    """Frequency, gap and start as ratios, whichever unit the job uses; in SI units if their ratio varies from cell to cell."""
    numbers = {}
    for table, names in PLACE.items():
        for ratio in names:
            given, unit = job.get(table, {}), unit_of(file, ratio)
            value, in_si = given.get(ratio), given.get(TWINS[ratio])
            numbers[ratio] = value if value is not None else float(in_si) / unit if in_si is not None and unit else None
            if in_si is not None and not unit:
                numbers[TWINS[ratio]] = in_si
    return {name: None if value is None else float(value) for name, value in numbers.items()}


def _set_by_axes(file: OpenedFile) -> set[str]:
    return {numbers_of_axis(file, name)[0] for name in axes_of_job(file.data.attribute("job"))}


def _numbers(job: Mapping[str, Any]) -> dict[str, float | None]:
    """The numbers of a cell except its place; None for those not given or set by an axis."""
    hammer, contact, solver = job["hammer"], job["contact"], job["solver"]
    names = LAWS[contact["law"]]
    numbers = {
        "mass_kg": hammer.get("mass_kg"),
        **{name: hammer.get(name) for name in
           ("natural_frequency_hz", "stiffness_n_per_m", "damping_ns_per_m", "damping_ratio")},
        "cubic_stiffness_n_per_m3": hammer.get("cubic_stiffness_n_per_m3"),
        "cubic_form": CUBIC_FORMS.index(hammer["cubic"]),
        "amplitude_m": job.get("cart", {}).get("amplitude_m"),
        "contact_law": list(LAWS).index(contact["law"]),
        **{f"contact_{place}": contact.get(names[n]) if n < len(names) else 0.0
           for n, place in enumerate(("first", "second", "third"))},
        **{name: job["steady_state"][name] for name in ("max_cycles", "max_period", "chaos_cycles")},
        "engine_choice": ENGINES.index(solver["engine"]),
        **{name: solver[name] for name in ("tolerance", "omit_tolerance")},
    }
    return {name: None if value is None else float(value) for name, value in numbers.items()}
