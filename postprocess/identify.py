#!/usr/bin/env python3
"""Finds the stop and the springs of a rig from measurements.

    identify.py RELEASE.csv ... --mass-kg KG [--gap-mm MM]      the hammer let go over a cart at rest
    identify.py --driven IMPACTS.csv ... --mass-kg KG           impacts by themselves: the cart moves, or a hand does
    identify.py TABLE.csv --mass-kg KG                          measured restitutions and contact times
    identify.py --restitution E [ERROR] --contact-time-ms T [ERROR] --mass-kg KG
    identify.py --speeds-m-s BEFORE AFTER --contact-time-ms T [ERROR] --mass-kg KG

Recordings have columns time_s or time_ms and one or more of force_n, acceleration_m_s2 or acceleration_g, displacement_m
or displacement_mm, parted by commas, semicolons or tabs; --from and --to [s] cut out what is before the release, say.
Tables have restitution, or speed_before_m_s and speed_after_m_s, and contact_time_s or contact_time_ms. Several files are
one rig's: their results are averaged, each with its weight. Prints ki, ci, natural frequency and damping ratio with
standard errors, draws each recording with what was fitted (STEM_identified), and writes a rig file for jobs. What is known
already, --natural-frequency-hz and --damping-ratio, is taken as given; --amplitude-mm, of the cart, goes into the rig file.
Exit codes: 0 done; 2 a file cannot be read or doesn't tell, or bad arguments; 3 a picture or the rig cannot be written.
"""

import argparse
import sys
from pathlib import Path

import peterka.program.interpreter  # noqa: F401, I001: before all that needs packages

import numpy as np
from peterka.files.csv_table import column_names
from peterka.files.opened import NotDrawable
from peterka.files.whole_file import write_text
from peterka.identification import picture
from peterka.identification.fit import Fit, fit, fit_each
from peterka.identification.impact_table import COLUMNS, fault_of, from_impact, read_impacts
from peterka.identification.numbers_found import Identified, Number, combined, combined_impacts
from peterka.identification.recording import Recording, read_recording
from peterka.identification.rig_file import rig_text
from peterka.identification.words import recording_lines, result_lines
from peterka.program.command_line import (
    BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, complain_of_folder, exit_code, save_all, tell,
)


def main() -> int:
    """The exit code."""
    arguments = read_arguments()
    try:
        found, drawn = identify(arguments)
    except NotDrawable as refusal:
        complain(refusal)
        return BAD_INPUT
    result = with_given(combined(found), arguments)
    for line in result_lines(result):
        tell(line)
    sources = [path.name for path in (*arguments.files, *arguments.driven)] or ["restitution and contact time"]
    rig = arguments.rig or Path(f"{Path(sources[0]).stem if arguments.files or arguments.driven else 'identified'}_rig.toml")
    try:
        write_text(rig, rig_text(result, sources, arguments.amplitude_mm and 1e-3 * arguments.amplitude_mm))
        tell(rig)
    except OSError as error:
        complain(f"cannot write {rig}: {error.strerror or error}")
        return BAD_OUTPUT
    try:
        for recording, fits in drawn:
            title = f"{recording.path.stem}: {np.size(recording.time)} samples at {1e-3 / recording.step:.4g} kHz"
            save_all(picture.draw(recording, fits, title), arguments.output_dir, f"{recording.path.stem}_identified",
                     arguments.formats)
    except OSError as error:
        complain_of_folder(arguments.output_dir, error)
        return BAD_OUTPUT
    return DONE


def identify(arguments: argparse.Namespace) -> tuple[list[Identified], list[tuple[Recording, list[Fit]]]]:
    """([Identified], [(Recording, its Fits)]) of all that was measured."""
    found, drawn = [], []
    if arguments.contact_time_ms:
        found.append(from_impact(arguments.mass_kg, *single_impact(arguments)))
    for path in (*arguments.files, *arguments.driven):
        if set(COLUMNS) & set(column_names(path)) and path in arguments.files:
            found.append(from_impact(arguments.mass_kg, *read_impacts(path)))
            continue
        recording = read_recording(path, arguments.begin, arguments.end)
        if path in arguments.driven:
            fits = fit_each(recording, arguments.mass_kg)
            found.append(combined_impacts([one.found for one in fits], in_step(recording, fits)))
        else:
            fits = [fit(recording, arguments.mass_kg, 1e-3 * arguments.gap_mm, springs(arguments))]
            found.append(fits[0].found)
        drawn.append((recording, fits))
        for line in recording_lines(recording, fits):
            tell(line)
    return found, drawn


def in_step(recording: Recording, fits: list[Fit]) -> bool:
    """Whether all impacts come the same number of samples apart: then each is sampled at the same places."""
    steps = np.rint(np.diff([one.motion.touches[0] for one in fits]) / recording.step)
    return len(steps) > 2 and np.ptp(steps) == 0


def springs(arguments: argparse.Namespace) -> tuple[float, float] | None:
    """(omega [rad/s], damping ratio) where they are given."""
    if arguments.natural_frequency_hz is None:
        return None
    return 2 * np.pi * arguments.natural_frequency_hz, arguments.damping_ratio or 0.0


def with_given(found: Identified, arguments: argparse.Namespace) -> Identified:
    """The Identified with what the user knows already."""
    given = {name: Number(value) for name in ("natural_frequency_hz", "damping_ratio")
             if (value := getattr(arguments, name)) is not None}
    return found.replaced(**given)


def single_impact(arguments: argparse.Namespace) -> tuple[Number, Number]:
    """(restitution, contact time [s]) of the command line."""
    numbers = arguments.restitution
    if arguments.speeds_m_s:
        before, after = (abs(speed) for speed in arguments.speeds_m_s)
        numbers = [after / before if before else np.inf]
    restitution, contact_s = Number(*numbers), Number(*(1e-3 * number for number in arguments.contact_time_ms))
    fault = fault_of(restitution.value, contact_s.value)
    if fault:
        raise NotDrawable(f"what was measured {fault}")
    return restitution, contact_s


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("files", metavar="FILE.csv", nargs="*", type=Path)
    parser.add_argument("--driven", metavar="FILE.csv", nargs="+", type=Path, default=[])
    parser.add_argument("--mass-kg", type=positive, required=True)
    parser.add_argument("--gap-mm", type=not_negative, default=0.0, help="between hammer at rest and stop; default: 0")
    parser.add_argument("--from", dest="begin", metavar="S", type=finite)
    parser.add_argument("--to", dest="end", metavar="S", type=finite)
    parser.add_argument("--restitution", metavar="E", nargs="+", type=positive)
    parser.add_argument("--contact-time-ms", metavar="T", nargs="+", type=positive)
    parser.add_argument("--speeds-m-s", metavar=("BEFORE", "AFTER"), nargs=2, type=finite)
    parser.add_argument("--natural-frequency-hz", metavar="HZ", type=positive)
    parser.add_argument("--damping-ratio", metavar="ZETA", type=not_negative)
    parser.add_argument("--amplitude-mm", metavar="MM", type=positive)
    parser.add_argument("--rig", metavar="RIG.toml", type=Path, help="default: STEM_rig.toml of the first file")
    parser.add_picture_arguments()
    arguments = parser.parse_args()
    stems = [path.stem for path in (*arguments.files, *arguments.driven)]
    if len(set(stems)) < len(stems):
        parser.error("two of the files have the same name, so their pictures would overwrite each other")
    for name in ("restitution", "contact_time_ms"):
        if len(getattr(arguments, name) or []) > 2:
            parser.error(f"--{name.replace('_', '-')} takes a number and its standard error")
    single = (arguments.restitution is not None) + (arguments.speeds_m_s is not None)
    if single > 1 or bool(single) != bool(arguments.contact_time_ms):
        parser.error("one impact is --contact-time-ms with either --restitution or --speeds-m-s")
    if not stems and not single:
        parser.error("nothing was measured: give a recording, a table, or --restitution and --contact-time-ms")
    return arguments


def finite(text: str) -> float:
    """The number that an argument says."""
    return _number(text, lambda number: True, "a number")


def positive(text: str) -> float:
    """The number above 0 that an argument says."""
    return _number(text, lambda number: number > 0, "a number above 0")


def not_negative(text: str) -> float:
    """The number from 0 up that an argument says."""
    return _number(text, lambda number: number >= 0, "0 or a number above")


def _number(text, fits, what):
    try:
        number = float(text)
    except ValueError:
        number = np.nan
    if not (np.isfinite(number) and abs(number) < 1e100 and fits(number)):
        raise argparse.ArgumentTypeError(f"'{text}' is not {what}")
    return number


if __name__ == "__main__":
    sys.exit(exit_code(main()))
