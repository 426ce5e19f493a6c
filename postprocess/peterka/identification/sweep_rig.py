"""The rig from which a fit to measured peak forces begins: a rig file or a job, and the numbers of it that are fitted."""

import tomllib
from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import PeterkaFileError
from ..files.job_numbers import number_of
from ..files.nearest import instead_of
from .numbers_found import DAMPING, DAMPING_RATIO, FREQUENCY, GAP, KEYS, STIFFNESS

SHORT = {"ki": STIFFNESS, "ci": DAMPING, "frequency_hz": FREQUENCY, "damping_ratio": DAMPING_RATIO, "gap_m": GAP, "gap_mm": GAP}
USUAL = (STIFFNESS, DAMPING, DAMPING_RATIO, GAP)
FACTOR = {STIFFNESS: 10.0, DAMPING: 10.0, DAMPING_RATIO: 10.0, FREQUENCY: 1.2}  # to either side, without --bounds
LARGEST_RATIO = 0.9  # of the springs
GAP_ROOM, GAP_SHARE = 1.0, 0.5  # of A0, of the gap: how far it is fitted to either side without --bounds, whichever is more
KEPT = ("hammer", "cart", "contact", "start", "solver", "steady_state")  # tables of a job that matter here
LARGEST_FILE = 2**20


@dataclass(frozen=True)
class SweptRig:
    """`tables` of a job: hammer (natural_frequency_hz and damping_ratio, whatever the file gives), cart, contact, and settings;
    `gap` [m], None where the file tells none."""

    path: Path
    tables: Mapping[str, Any]
    gap: float | None

    @property
    def mass(self) -> float:
        """Of the hammer [kg]."""
        return float(self.tables["hammer"]["mass_kg"])

    @property
    def natural_hz(self) -> float:
        """Of the hammer on its springs [Hz]."""
        return float(self.tables["hammer"]["natural_frequency_hz"])

    @property
    def amplitude(self) -> float:
        """A0 of the cart [m]."""
        return float(self.tables["cart"]["amplitude_m"])

    def value(self, key: str) -> float | None:
        """The number of a key of KEYS."""
        return self.gap if key == GAP else number_of(self.tables, key)

    def with_values(self, values: Mapping[str, float]) -> "SweptRig":
        """The same with other numbers, {key of KEYS: value}."""
        tables, gap = deepcopy(dict(self.tables)), self.gap
        for key, value in values.items():
            if key == GAP:
                gap = float(value)
            else:
                table, name = key.split(".")
                tables[table][name] = float(value)
        return replace(self, tables=tables, gap=gap)


@dataclass(frozen=True)
class Bounds:
    """Of a fitted number: where the fit begins, and between which values it stays, in SI units."""

    start: float
    lowest: float
    highest: float


def read_rig(path: Path, known: Mapping[str, float]) -> SweptRig:
    """The rig of a rig file or a job; `known` {table.key: value} replace its numbers. Raises PeterkaFileError where one is missing."""
    tables = _tables(path)
    name = tables.get("rig")
    if isinstance(name, str):
        beneath = _tables(path.parent / name)
        tables = {**tables, **{table: _over(beneath.get(table), tables.get(table)) for table in ("hammer", "cart", "contact")}}
    rig = {table: dict(tables[table]) for table in KEPT if isinstance(tables.get(table), dict)}
    for key, value in known.items():
        if key != GAP:
            table, number = key.split(".")
            rig.setdefault(table, {})[number] = value
    law = rig.get("contact", {}).get("law")
    if law != "kelvin_voigt":
        raise PeterkaFileError(f"{path} has {'no contact.law' if law is None else f'a stop of the law {law!r}'}; a stop with ki and ci, "
                               "law = \"kelvin_voigt\", is fitted")
    _with_ratio(path, rig)
    for key in ("cart.amplitude_m", STIFFNESS, DAMPING):
        _positive(path, rig, key)
    found = SweptRig(path, rig, None)
    return replace(found, gap=known[GAP] if GAP in known else _gap(tables, found.amplitude))


def _tables(path: Path) -> dict[str, Any]:
    try:
        with open(path, "rb") as file:
            return tomllib.loads(file.read(LARGEST_FILE).decode("utf-8"))
    except OSError as error:
        raise PeterkaFileError(f"{path} cannot be read: {error.strerror or error}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise PeterkaFileError(f"{path} is no rig or job in TOML: {error}") from error


def _over(beneath: Any, above: Any) -> Any:
    """A job's table over that of its rig file; another law replaces the whole of it."""
    if not isinstance(beneath, dict) or not isinstance(above, dict):
        return beneath if above is None else above
    return above if above.get("law", beneath.get("law")) != beneath.get("law") else {**beneath, **above}


def _with_ratio(path: Path, rig: dict[str, Any]) -> None:
    """Puts natural_frequency_hz and damping_ratio in the place of stiffness_n_per_m and damping_ns_per_m."""
    mass, hammer = _positive(path, rig, "hammer.mass_kg"), rig["hammer"]
    if "natural_frequency_hz" not in hammer and "stiffness_n_per_m" in hammer:
        hammer["natural_frequency_hz"] = np.sqrt(_positive(path, rig, "hammer.stiffness_n_per_m") / mass) / (2 * np.pi)
    hertz = _positive(path, rig, FREQUENCY)
    if "damping_ratio" not in hammer and "damping_ns_per_m" in hammer:
        hammer["damping_ratio"] = _positive(path, rig, "hammer.damping_ns_per_m") / (4 * np.pi * mass * hertz)
    _positive(path, rig, DAMPING_RATIO)
    rig["hammer"] = {key: float(value) for key, value in hammer.items() if key not in ("stiffness_n_per_m", "damping_ns_per_m")}


def _positive(path: Path, tables: Mapping[str, Any], key: str) -> float:
    value = number_of(tables, key)
    if value is None or not 0 < value < 1e100:
        told = "no" if value is None else f"{value:g} as"
        raise PeterkaFileError(f"{path} has {told} {key}; a fit to measured forces begins from a number above 0")
    return value


def _gap(tables: Mapping[str, Any], amplitude: float) -> float | None:
    """The only gap of a job [m], None where it has none or several."""
    for table in ("operating_point", "sweep"):
        for name, unit in (("gap_m", 1.0), ("gap_ratio", amplitude)):
            value = tables.get(table, {}).get(name) if isinstance(tables.get(table), dict) else None
            gaps = value if isinstance(value, list) else [value]
            if len(gaps) == 1 and isinstance(gaps[0], (int, float)):
                return unit * float(gaps[0])
    return None


def keys_of(words: Sequence[str]) -> list[str]:
    """Keys of KEYS, in their order, of what --fit names. Raises PeterkaFileError."""
    known = [*SHORT, *KEYS]
    unknown = [word for word in words if word not in known]
    if unknown:
        raise PeterkaFileError(f"--fit names {instead_of(unknown, known, 'what can be fitted is')}")
    keys = [SHORT.get(word, word) for word in words]
    twice = [key for key in keys if keys.count(key) > 1]
    if twice:
        raise PeterkaFileError(f"--fit names {twice[0]} twice")
    return [key for key in KEYS if key in keys]


def bounds_of(rig: SweptRig, keys: Sequence[str], asked: Mapping[str, tuple[float, float]]) -> dict[str, Bounds]:
    """{key: Bounds}; `asked` {key: (lowest, highest)} of --bounds. Raises PeterkaFileError where they hold no start."""
    for key in asked:
        if key not in keys:
            raise PeterkaFileError(f"--bounds names {key}, which isn't fitted; --fit names what is")
    found = {}
    for key in keys:
        start = rig.value(key)
        if start is None:
            raise PeterkaFileError(f"{rig.path} tells no gap; give it by --gap-mm, or points a column gap_mm")
        lowest, highest = asked.get(key) or _usual_bounds(rig, key, start)
        if not lowest < highest:
            raise PeterkaFileError(f"--bounds of {key} go from {lowest:g} down to {highest:g}; the smaller one comes first")
        if key != GAP and not lowest > 0:
            raise PeterkaFileError(f"--bounds of {key} begin at {lowest:g}; it is above 0")
        if not lowest <= start <= highest:
            raise PeterkaFileError(f"--bounds of {key}, {lowest:g} to {highest:g}, leave out the {start:g} from which the fit begins")
        found[key] = Bounds(start, lowest, highest)
    return found


def _usual_bounds(rig: SweptRig, key: str, start: float) -> tuple[float, float]:
    if key == GAP:
        room = max(GAP_ROOM * rig.amplitude, GAP_SHARE * abs(start))
        return start - room, start + room
    highest = start * FACTOR[key]
    if key == DAMPING_RATIO:
        return start / FACTOR[key] ** 2, max(min(highest, LARGEST_RATIO), 1.01 * start)
    return start / FACTOR[key], highest
