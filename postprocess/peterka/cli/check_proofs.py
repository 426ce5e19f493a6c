"""Proves periodic cells of a map a second time: by another method and arithmetic, from the numbers in its file alone.

    check_proofs.py MAP.h5 [--cells 100] [--max-period 8] [--all-words]

Takes certified periodic cells, spread evenly over the file, and prints a line for each that is not decided or contradicted
(with --all-words for each), then counts. Confirmed: exactly one orbit lies in a box near the cell's; its q is the smallest period,
its p, its stability and its largest force, or impact speed on a rigid stop, are as the file tells. The job needs [certificate], and fields = ["orbit"] in [output].
Where its attractors are certified, too (certificate.attractors), it takes these instead, whatever the fields, as many as --cells says.
A cell takes some tenths of a second with linear springs; with a cubic one seconds.
Exit codes: 0 no cell is contradicted; 1 one is; 2 a file cannot be read.
"""

import argparse
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import PeterkaFileError
from ..files.job_axes import axes_of_job
from ..files.job_numbers import UnreadableJob, numbers_of_cell, tables_of
from ..files.regimes import PERIODIC
from ..maps.map_file import PeterkaFile
from ..second_proof.cells import CONFIRMED, CONTRADICTED, NOT_DECIDED, Claim, verdict_of
from .command_line import BAD_INPUT, DONE, OneLineParser, complain, exit_code, tell, tell_if_unfinished, working

CONTRADICTION = 1
BOUNDS = {"kelvin_voigt": ("peak_force_lower_ratio", "peak_force_upper_ratio"), "restitution": ("impact_speed_lower", "impact_speed_upper")}


def main() -> int:
    """peterka-check-proofs; the exit code."""
    arguments = read_arguments()
    try:
        with PeterkaFile(arguments.file) as file:
            return exit_code(check(file, arguments.cells, arguments.max_period, arguments.all_words))
    except (PeterkaFileError, UnreadableJob) as refusal:
        complain(refusal)
        return BAD_INPUT


def check(file: PeterkaFile, cells: int, max_period: int, all_words: bool) -> int:
    """Prints what becomes of the claims; the exit code."""
    tell_if_unfinished(file)
    words: Counter[str] = Counter()
    seconds = []
    for place, numbers, claim in claims_of(file, cells, max_period):
        begin = time.monotonic()
        with working(place):
            verdict = verdict_of(numbers, claim)
        seconds.append(time.monotonic() - begin)
        words[verdict.word] += 1
        if all_words or verdict.word != CONFIRMED:
            why = f": {verdict.why}" if verdict.why else ""
            tell(f"{place}, {claim.impacts}/{claim.period}: {verdict.word}{why} ({seconds[-1]:.1f} s)")
    tried = sum(words.values())
    if not tried:
        tell(f"{file.path}: no periodic cell with q up to {max_period} has a proof, so none was proved again")
        return DONE
    tell(f"{tried} cells: " + ", ".join(f"{words[word]} {word}" for word in (CONFIRMED, NOT_DECIDED, CONTRADICTED))
         + f"; {np.mean(seconds):.1f} s each, {max(seconds):.1f} at most")
    return CONTRADICTION if words[CONTRADICTED] else DONE


def claims_of(file: PeterkaFile, cells: int, max_period: int) -> Iterator[tuple[str, Mapping[str, Any], Claim]]:
    """(place in words, numbers by table and key, claim) of certified periodic cells with q up to `max_period`, `cells` of them; or
    of attractors of cells, if those are certified, too."""
    if file.kind != "map":
        raise file.refusal(f"is a {file.kind}; this program proves cells of maps")
    job = file.data.attribute("job")
    tables = tables_of(job)
    bounds = BOUNDS.get(tables["contact"]["law"])
    if bounds is None:
        raise file.refusal("has another stop than a spring and dashpot or a rigid one; this program proves cells of those alone")
    of = "attractor_" if file.data.has("attractor_certified") else ""
    claimed = [of + name for name in ("impacts", "period", "orbit_displacement", "orbit_velocity", *bounds, "stability_margin")]
    if not all(file.data.has(name) for name in (f"{of}certified", *claimed)):
        raise file.refusal('has no proofs with orbits; its job needs [certificate], and "orbit" among the fields of [output]')
    values = {name: file.data.values(name, slice(None)) for name in (f"{of}regime", f"{of}certified", *claimed)}
    columns, rows = ((name, file.data.values(name, slice(None))) for name in axes_of_job(job))
    wanted = np.argwhere((values[f"{of}regime"] == PERIODIC) & (values[f"{of}certified"] > 0) & (values[f"{of}period"] <= max_period))
    for index in wanted[np.unique(np.linspace(0, len(wanted) - 1, min(cells, len(wanted))).astype(int))]:
        *slot, row, column = index.tolist()
        axes = {columns[0]: float(columns[1][column]), rows[0]: float(rows[1][row])}
        claim = Claim(*(values[name][(*slot, row, column)].item() for name in claimed))
        place = ", ".join(f"{name} {value:.6g}" for name, value in axes.items()) + "".join(f", attractor {n}" for n in slot)
        yield place, numbers_of_cell(tables, axes), claim


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("file", metavar="MAP.h5", type=Path)
    parser.add_argument("--cells", metavar="N", type=int, default=100, help="how many cells; default: 100")
    parser.add_argument("--max-period", metavar="Q", type=int, default=8, help="with q up to this; default: 8")
    parser.add_argument("--all-words", action="store_true", help="a line for each cell, also for those confirmed")
    arguments = parser.parse_args()
    if arguments.cells < 1 or arguments.max_period < 1:
        parser.error("--cells and --max-period are 1 or more")
    return arguments
