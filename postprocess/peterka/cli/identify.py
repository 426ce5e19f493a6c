"""Finds the stop and the springs of a rig from measurements.

    identify.py RELEASE.csv ... --mass-kg KG [--gap-mm MM]      the hammer let go over a cart at rest
    identify.py --driven IMPACTS.csv ... --mass-kg KG           impacts by themselves: the cart moves, or a hand does
    identify.py TABLE.csv --mass-kg KG                          measured restitutions and contact times
    identify.py --restitution E [ERROR] --contact-time-ms T [ERROR] --mass-kg KG
    identify.py --speeds-m-s BEFORE AFTER --contact-time-ms T [ERROR] --mass-kg KG
    identify.py --sweep POINTS.csv --rig-from RIG.toml          measured peak forces over the excitation frequency

Recordings are tables as loggers write them, .mat (up to version 7.2) or WAV files. They have a time and one or more of force,
acceleration and displacement. Columns are named time_s, time_ms, force_n, force_kn, acceleration_m_s2, acceleration_g,
displacement_m or displacement_mm, or by a quantity and its unit, "Force [kN]", "Time (ms)"; lines before are skipped. --columns
time[s],force[mV],- names those of a file without such names (SI where no unit is given, - for a column that is left out),
--sensitivity force=22.4mV/N tells a sensor's, --scale force=FACTOR how many N a number stands for, or full scale of a WAV
file (with --sensitivity, how many of the column's V or mV); --rate-hz stands for a time. Commas, semicolons, tabs or spaces part columns; cells may be empty or NaN, and rows missing.
--from and --to [s] cut out what is before the release, say.
Tables have restitution, or speed_before_m_s and speed_after_m_s, and contact_time_s or contact_time_ms. Several files are
one rig's: their results are averaged, each with its weight. Prints ki, ci, natural frequency, damping ratio and gap with
standard errors and correlations, draws each recording with what was fitted (STEM_identified), and writes a rig file for jobs
(STEM_rig.toml) and the numbers with their covariance (STEM_identified.toml). What is known already, --gap-mm,
--natural-frequency-hz and --damping-ratio, is taken as given and refused where the recording says otherwise; --amplitude-mm, of
the cart, goes into the rig file.
--sweep fits to peak forces, in the columns of draw.py --measured: frequency_hz, force_n, gap_mm, force_error_n and others. --rig-from, a
rig file or a job, has mass, springs, cart and stop (kelvin_voigt), and the gap unless points have gap_mm or --gap-mm tells it: where the
fit begins. --fit ki,ci,damping_ratio,gap_mm, the default but for what an option above tells, names what is fitted; with --fit these
options say where it begins, too. frequency_hz is the hammer's natural frequency. --bounds ki=1e6:9e6 gap_mm=0:1 keep the fit inside.
Forces are those of branches that the program computes, up and down; points on none of them, and of chaos, are told and left out. A gap that
is fitted to points of several gaps is a common error of all of them, told for the smallest. Without force_error_n errors are in proportion
to the force, and estimated.
Exit codes: 0 done; 2 a file cannot be read or doesn't tell, or bad arguments; 3 a picture or the rig cannot be written.
"""

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..files.csv_table import column_names
from ..errors import PeterkaFileError
from ..files.whole_file import write_text
from ..identification import picture
from ..identification.columns import UNITS, Layout, parted, quantity_of, sensitivity_of
from ..identification.driven import fit_driven
from ..identification.fit import Fit, fit
from ..identification.impact_table import COLUMNS, fault_of, from_impact, read_impacts
from ..identification.numbers_found import DAMPING_RATIO, FREQUENCY, Identified, Number, combined
from ..identification.recorded_file import read_recording
from ..identification.rig_file import identified_text, rig_text
from ..identification.words import recording_lines, result_lines
from .command_line import (
    BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, complain_of_folder, exit_code, save_all, tell, working,
)
from .identify_sweep import add_sweep_arguments, check_sweep_arguments, identify_sweep


def main() -> int:
    """peterka-identify; the exit code."""
    return exit_code(_identify())


def _identify() -> int:
    arguments = read_arguments()
    if arguments.sweep is not None:
        return identify_sweep(arguments)
    try:
        found, drawn = identify(arguments)
    except PeterkaFileError as refusal:
        complain(refusal)
        return BAD_INPUT
    result = with_given(combined(found), arguments)
    for line in result_lines(result):
        tell(line)
    sources = [path.name for path in (*arguments.files, *arguments.driven)] or ["restitution and contact time"]
    stem = Path(sources[0]).stem if arguments.files or arguments.driven else "identified"
    rig = arguments.rig or Path(f"{stem}_rig.toml")
    numbers = rig.with_name(f"{rig.stem.removesuffix('_rig')}_identified.toml")
    for path, text in ((rig, rig_text(result, sources, arguments.amplitude_mm and 1e-3 * arguments.amplitude_mm)),
                       (numbers, identified_text(result, sources))):
        try:
            write_text(path, text)
            tell(path)
        except OSError as error:
            complain(f"cannot write {path}: {error.strerror or error}")
            return BAD_OUTPUT
    try:
        for one in drawn:
            recording = one.recording
            title = f"{recording.path.stem}: {recording.count} samples at {1e-3 / recording.step:.4g} kHz"
            save_all(picture.draw(one, title), arguments.output_dir, f"{recording.path.stem}_identified", arguments.formats)
    except OSError as error:
        complain_of_folder(arguments.output_dir, error)
        return BAD_OUTPUT
    return DONE


def identify(arguments: argparse.Namespace) -> tuple[list[Identified], list[Fit]]:
    """([Identified], [Fit]) of all that was measured."""
    found: list[Identified] = []
    drawn: list[Fit] = []
    if arguments.contact_time_ms:
        found.append(from_impact(arguments.mass_kg, *single_impact(arguments)))
    for path in (*arguments.files, *arguments.driven):
        if set(COLUMNS) & set(column_names(path)) and path in arguments.files:
            found.append(from_impact(arguments.mass_kg, *read_impacts(path)))
            continue
        with working(path):
            recording = read_recording(path, arguments.begin, arguments.end, arguments.layout)
            one = (fit_driven if path in arguments.driven else fit)(recording, arguments.mass_kg, given(arguments))
        found.append(one.found)
        drawn.append(one)
        for line in recording_lines(one):
            tell(line)
    return found, drawn


def given(arguments: argparse.Namespace) -> dict[str, float]:
    """What isn't to be fitted, as fit() takes it."""
    told = {"omega": arguments.natural_frequency_hz and 2 * np.pi * arguments.natural_frequency_hz,
            "damping_ratio": arguments.damping_ratio, "gap": None if arguments.gap_mm is None else 1e-3 * arguments.gap_mm}
    return {name: value for name, value in told.items() if value is not None}


def with_given(found: Identified, arguments: argparse.Namespace) -> Identified:
    """The Identified with what the user knows already."""
    known = {FREQUENCY: arguments.natural_frequency_hz, DAMPING_RATIO: arguments.damping_ratio}
    return replace(found, given={**found.given, **{key: value for key, value in known.items() if value is not None}})


def single_impact(arguments: argparse.Namespace) -> tuple[Number, Number]:
    """(restitution, contact time [s]) of the command line."""
    numbers = arguments.restitution
    if arguments.speeds_m_s:
        before, after = (abs(speed) for speed in arguments.speeds_m_s)
        numbers = [after / before if before else np.inf]
    restitution, contact_s = Number(*numbers), Number(*(1e-3 * number for number in arguments.contact_time_ms))
    fault = fault_of(restitution.value, contact_s.value)
    if fault:
        raise PeterkaFileError(f"what was measured {fault}")
    return restitution, contact_s


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("files", metavar="FILE.csv", nargs="*", type=Path)
    parser.add_argument("--driven", metavar="FILE.csv", nargs="+", type=Path, default=[])
    parser.add_argument("--mass-kg", type=positive)
    parser.add_argument("--gap-mm", type=not_negative, help="between hammer at rest and stop; fitted where it isn't given")
    parser.add_argument("--from", dest="begin", metavar="S", type=finite)
    parser.add_argument("--to", dest="end", metavar="S", type=finite)
    parser.add_argument("--columns", metavar="NAME[UNIT],...", type=lambda text: [name.strip() for name in text.split(",")])
    parser.add_argument("--scale", metavar="NAME=FACTOR", nargs="+", type=scale, default=[])
    parser.add_argument("--sensitivity", metavar="NAME=NUMBERmV/UNIT", nargs="+", type=sensitivity, default=[])
    parser.add_argument("--rate-hz", metavar="HZ", type=positive)
    parser.add_argument("--restitution", metavar="E", nargs="+", type=positive)
    parser.add_argument("--contact-time-ms", metavar="T", nargs="+", type=positive)
    parser.add_argument("--speeds-m-s", metavar=("BEFORE", "AFTER"), nargs=2, type=finite)
    parser.add_argument("--natural-frequency-hz", metavar="HZ", type=positive)
    parser.add_argument("--damping-ratio", metavar="ZETA", type=not_negative)
    parser.add_argument("--amplitude-mm", metavar="MM", type=positive)
    parser.add_argument("--rig", metavar="RIG.toml", type=Path, help="default: STEM_rig.toml of the first file")
    add_sweep_arguments(parser)
    parser.add_picture_arguments()
    arguments = parser.parse_args()
    check_sweep_arguments(parser, arguments)
    arguments.layout = Layout(arguments.columns, quantities(parser, arguments.scale), quantities(parser, arguments.sensitivity),
                              arguments.rate_hz)
    stems = [path.stem for path in (*arguments.files, *arguments.driven)]
    if len(set(stems)) < len(stems):
        parser.error("two of the files have the same name, so their pictures would overwrite each other")
    for name in ("restitution", "contact_time_ms"):
        if len(getattr(arguments, name) or []) > 2:
            parser.error(f"--{name.replace('_', '-')} takes a number and its standard error")
    single = (arguments.restitution is not None) + (arguments.speeds_m_s is not None)
    if single > 1 or bool(single) != bool(arguments.contact_time_ms):
        parser.error("one impact is --contact-time-ms with either --restitution or --speeds-m-s")
    if not stems and not single and arguments.sweep is None:
        parser.error("nothing was measured: give a recording, a table, or --restitution and --contact-time-ms")
    return arguments


def quantities(parser: OneLineParser, pairs: list[tuple[str, float]]) -> dict[str, float]:
    """{quantity: number} of such arguments; ends the program where one is said twice."""
    names = [name for name, _ in pairs]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        parser.error(f"{twice[0]} is given twice")
    return dict(pairs)


def scale(text: str) -> tuple[str, float]:
    """(quantity, SI per recorded number) of an argument NAME=FACTOR; negative where a sensor is mounted the other way."""
    quantity, number = _named(text)
    factor = _number(number, lambda number: number != 0, "a factor other than 0")
    return quantity, factor


def sensitivity(text: str) -> tuple[str, float]:
    """(quantity, V per SI unit) of an argument NAME=NUMBERmV/UNIT."""
    quantity, number = _named(text)
    try:
        found = sensitivity_of(quantity, number)
    except ValueError:
        found = 0.0
    if not (np.isfinite(found) and found > 0):
        raise argparse.ArgumentTypeError(f"'{number}' is no sensitivity of a sensor of {quantity}, as 10mV/{next(iter(UNITS[quantity]))}")
    return quantity, found


def _named(text: str) -> tuple[str, str]:
    name, equals, rest = text.partition("=")
    quantity = quantity_of(parted(name.strip())[0])
    if quantity is None or not equals:
        raise argparse.ArgumentTypeError(f"'{text}' doesn't begin with one of {'=, '.join(UNITS)}=")
    return quantity, rest


def finite(text: str) -> float:
    """The number that an argument says."""
    return _number(text, lambda number: True, "a number")


def positive(text: str) -> float:
    """The number above 0 that an argument says."""
    return _number(text, lambda number: number > 0, "a number above 0")


def not_negative(text: str) -> float:
    """The number from 0 up that an argument says."""
    return _number(text, lambda number: number >= 0, "0 or a number above")


def _number(text: str, fits: Callable[[float], bool], what: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = np.nan
    if not (np.isfinite(number) and abs(number) < 1e100 and fits(number)):
        raise argparse.ArgumentTypeError(f"'{text}' is not {what}")
    return number
