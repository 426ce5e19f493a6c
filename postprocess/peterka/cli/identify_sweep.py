"""identify.py --sweep: the stop, the gap and the springs' damping from measured peak forces over the excitation frequency."""

import argparse
from collections.abc import Mapping
from pathlib import Path

from ..errors import PeterkaError, PeterkaFileError
from ..identification import sweep_picture
from ..identification.numbers_found import DAMPING_RATIO, FREQUENCY, GAP, KEYS, Identified
from ..identification.rig_file import identified_text, rig_text
from ..identification.sweep_adequacy import fitted, hardly_told, identified_from_sweep, judged
from ..identification.sweep_fit import SPARE, Model
from ..identification.sweep_points import read_forces
from ..identification.sweep_rig import SHORT, USUAL, SweptRig, bounds_of, keys_of, read_rig
from ..identification.sweep_words import point_lines
from ..identification.words import result_lines
from ..files.nearest import instead_of
from ..files.whole_file import write_text
from .command_line import BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, complain_of_folder, save_all, tell, working

OTHERS = ("files", "driven", "restitution", "speeds_m_s", "contact_time_ms", "columns", "scale", "sensitivity", "rate_hz", "begin", "end")
OPTIONS = {"begin": "--from", "end": "--to", "files": "a recording"}


def add_sweep_arguments(parser: OneLineParser) -> None:
    """Adds --sweep and what belongs to it."""
    parser.add_argument("--sweep", metavar="POINTS.csv", type=Path, help="measured peak forces over the excitation frequency")
    parser.add_argument("--rig-from", metavar="FILE.toml", type=Path, help="of --sweep: a rig file or a job, where the fit begins")
    parser.add_argument("--fit", metavar="KEY,...", type=lambda text: [name.strip() for name in text.split(",")],
                        help=f"of --sweep: some of {', '.join(SHORT)}, or of the keys of jobs; default: ki,ci,damping_ratio,gap_mm")
    parser.add_argument("--bounds", metavar="KEY=FROM:TO", nargs="+", type=read_bounds, default=[], help="of --sweep: of a fitted number")


def read_bounds(text: str) -> tuple[str, tuple[float, float]]:
    """(key of KEYS, (lowest, highest) in SI units) of an argument KEY=FROM:TO."""
    name, equals, rest = text.partition("=")
    known = [*SHORT, *KEYS]
    if name.strip() not in known or not equals:
        raise argparse.ArgumentTypeError(f"'{text}' names {instead_of([name.strip()], known, 'what can be bounded is')}; it is "
                                         "KEY=FROM:TO")
    try:
        low, high = (float(part) * (1e-3 if name.strip() == "gap_mm" else 1.0) for part in rest.split(":"))
    except ValueError:
        low = high = float("nan")
    if not abs(low) < 1e100 or not abs(high) < 1e100:
        raise argparse.ArgumentTypeError(f"'{text}' has no two numbers FROM:TO")
    return SHORT.get(name.strip(), name.strip()), (low, high)


def check_sweep_arguments(parser: OneLineParser, arguments: argparse.Namespace) -> None:
    """Ends the program where --sweep goes with what it doesn't know, or its options without it."""
    own = {"rig_from": "--rig-from", "fit": "--fit", "bounds": "--bounds"}
    if arguments.sweep is None:
        given = [option for name, option in own.items() if getattr(arguments, name)]
        if given:
            parser.error(f"{given[0]} belongs to --sweep POINTS.csv")
        if arguments.mass_kg is None:
            parser.error("the following arguments are required: --mass-kg")
        return
    strange = [OPTIONS.get(name, f"--{name.replace('_', '-')}") for name in OTHERS if getattr(arguments, name)]
    if strange:
        parser.error(f"--sweep doesn't go with {strange[0]}: fit one after the other")
    if arguments.rig_from is None:
        parser.error("--sweep needs --rig-from FILE.toml, a rig file or a job with the numbers where the fit begins")
    keys = [key for key, _ in arguments.bounds]
    twice = [key for key in keys if keys.count(key) > 1]
    if twice:
        parser.error(f"--bounds names {twice[0]} twice")


def identify_sweep(arguments: argparse.Namespace) -> int:
    """All of --sweep; the exit code."""
    try:
        model = model_of(arguments)
        with working(arguments.sweep):
            fit, told = judged(fitted(model))
    except PeterkaError as refusal:
        complain(refusal)
        return BAD_INPUT
    result = identified_from_sweep(fit)
    weak = hardly_told(fit, result, bool(told))
    for line in [*model.points.left_out, *point_lines(fit), *result_lines(result), *(f"  {line}" for line in gap_lines(model, result))]:
        tell(line)
    for line in [*told, *weak]:
        tell(f"  {line}")
    sources = [arguments.sweep.name]
    rig = arguments.rig or Path(f"{arguments.sweep.stem}_rig.toml")
    numbers = rig.with_name(f"{rig.stem.removesuffix('_rig')}_identified.toml")
    notes = "".join(f"# {line}\n" for line in [*told, *weak])
    kept = model.rig.tables
    for path, text in ((rig, rig_text(result, sources, model.rig.amplitude, kept)), (numbers, identified_text(result, sources))):
        try:
            write_text(path, text + notes)
            tell(path)
        except OSError as error:
            complain(f"cannot write {path}: {error.strerror or error}")
            return BAD_OUTPUT
    try:
        title = f"{arguments.sweep.stem}: {int(fit.used.sum())} of {len(fit.used)} measured peak forces are fitted"
        picture = sweep_picture.draw(fit, model.x_of(lambda one: one.start), title)
        save_all(picture, arguments.output_dir, f"{arguments.sweep.stem}_identified", arguments.formats)
    except OSError as error:
        complain_of_folder(arguments.output_dir, error)
        return BAD_OUTPUT
    return DONE


def model_of(arguments: argparse.Namespace) -> Model:
    """The Model of the arguments' points, rig and bounds. Raises PeterkaFileError."""
    known = known_numbers(arguments)
    rig = read_rig(arguments.rig_from, known)
    points = read_forces(arguments.sweep, rig)
    gaps = points.gaps()
    if gaps:
        rig = rig.with_values({GAP: gaps[0]})
    keys = keys_of(arguments.fit) if arguments.fit else [key for key in USUAL if key not in known]
    if rig.gap is None and GAP not in keys:
        raise PeterkaFileError(f"{rig.path} tells no gap; give it by --gap-mm, or points a column gap_mm")
    bounds = bounds_of(rig, keys, dict(arguments.bounds))
    if len(points.hertz) < len(keys) + SPARE:
        raise PeterkaFileError(f"{arguments.sweep} has {len(points.hertz)} points with a force, and {len(keys)} numbers are fitted to "
                               f"them; {len(keys) + SPARE} are needed, or fewer numbers by --fit")
    return Model(rig, points, bounds)


def known_numbers(arguments: argparse.Namespace) -> dict[str, float]:
    """{table.key: SI value} of the options."""
    told: Mapping[str, float | None] = {
        "hammer.mass_kg": arguments.mass_kg, FREQUENCY: arguments.natural_frequency_hz, DAMPING_RATIO: arguments.damping_ratio,
        "cart.amplitude_m": arguments.amplitude_mm and 1e-3 * arguments.amplitude_mm,
        GAP: None if arguments.gap_mm is None else 1e-3 * arguments.gap_mm}
    return {key: value for key, value in told.items() if value is not None}


def gap_lines(model: Model, result: Identified) -> list[str]:
    """On what the gap is where points have several."""
    gaps = model.points.gaps()
    if GAP not in result.values or not gaps:
        return []
    number = result.number(GAP)
    assert number is not None and number.error is not None
    off = f"{1e3 * (number.value - gaps[0]):+.3g} ± {1e3 * number.error:.2g} mm"
    return [f"this gap is the smallest of {len(gaps)}: less the measured one, as for all of them, it is {off}" if len(gaps) > 1 else
            f"less the measured gap it is {off}"]
