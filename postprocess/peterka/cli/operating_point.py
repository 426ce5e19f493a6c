"""Finds where to operate a rig: the place of a map whose worst value over a drift and over the starts is the best.

    operating_point.py MAP.h5 [--hz 0.5] [--mm 0.1] [--starts any | share 0.9 | job]
                       [--quantity peak_force | contact_power | impact_speed] [--regime 1/1,1/2] [--risk 0.95] [--verify]
                       [--units both | si | ratio] [--palette colour | grey] [--width MM]

A place is one where the motion is the same p/q in all cells within --hz and --mm to either side, its box, from all starts
that are admitted: any (each of the map's [starts] and its own, where no other motion is known to exist, the one without impact
anywhere within the drift; the default), at least a share of them above one half, or the job's own alone. A drift that ends
between two cells takes the farther one, too; how far boxes reach is told then. A drift wider than the map, or along what it doesn't
vary, is refused. It is told what of that is
proved and what sampled: n starts, all of which end in one motion, exclude others with shares above 1 - 0.05^(1/n) (16 starts:
17 %; 299: 1 %); a share that the map's starts can't tell is refused. Prints the best place in Hz, mm, W and N, by each cell's own
mass, and the ten best separate ones; draws STEM_operating_point, the worst value of each box over the map. --verify computes the
drift around the best place once more on a finer grid, with the same starts, by build/peterka (or --peterka PROGRAM), into the
folder of the pictures, and says whether its worst value is as good there, or by how much it falls short.
--risk 0.95 asks a map with [uncertainty], whose cells have many drawn rigs, each from a start of its own where it has [starts], for the
largest value that is reached with this probability, drift, starts and rig taken together, whatever the motion, or, with --regime, in
that one. A probability that the number of draws can't tell is refused (59 can tell 0.95). --verify computes 17 places from end to end of
the drift (17 x 17 where both drift), draws many more rigs at the worst one, and tells its value beside the map's: the best of many places
flatters itself, and between cells nothing was known.
Exit codes: 0 done, whatever came out; 2 a file cannot be read or has no such place, or bad arguments; 3 a picture or the box
cannot be written.
"""

import argparse
import re
from pathlib import Path

import numpy as np

from ..arrays import Mask
from ..errors import PeterkaFileError
from ..files.regimes import CHAOTIC, NAMES, PERIODIC
from ..maps.comparison import label_codes
from ..maps.map_file import COORDINATES, PeterkaFile
from ..maps.outcomes import draws_of
from ..operating import fresh_draws, picture, risk, told, verify, words
from ..operating.admitted import ANY, JOB, NO_REGIME, OVER_WEIGHT, QUANTITIES, Admitted, Quantity, admitted, has_starts, quantity_of
from ..operating.drift import USUAL, Reach, reach, read_drift, worst_of_boxes
from ..operating.places import Place, best_places
from ..plotting.style import using
from .command_line import (
    BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, complain_of_folder, exit_code, save_all, tell,
    tell_if_unfinished,
)
from .picture_options import add_look_arguments, check_style, style_of


MORE_THAN_HALF = 0.5 + 1e-6  # a share of the starts


class MapFile(PeterkaFile):
    """A map, and no basin."""

    coordinates = {"map": COORDINATES["map"]}


def main() -> int:
    """peterka-operating-point; the exit code."""
    return exit_code(_operating_point())


def _operating_point() -> int:
    arguments = read_arguments()
    try:
        with MapFile(arguments.map) as file, using(**style_of(arguments)):
            return operate(file, arguments)
    except (PeterkaFileError, verify.NotVerified) as refusal:
        complain(refusal)
        return BAD_INPUT
    except OSError as error:
        complain_of_folder(arguments.output_dir, error)
        return BAD_OUTPUT


def operate(file: PeterkaFile, arguments: argparse.Namespace) -> int:
    """The whole of it, of an open map; the exit code."""
    tell_if_unfinished(file)
    if arguments.risk is not None:
        return operate_at_risk(file, arguments)
    starts = arguments.starts
    if starts is None:
        starts = ANY if has_starts(file) else JOB
        if starts == JOB:
            tell(f"{file.path} was computed from one start alone: what other starts lead to isn't known")
    if starts not in (ANY, JOB):
        told.refuse_few_starts(file, starts)
    quantity = quantity_of(file, arguments.quantity or "peak_force")
    drift = read_drift(file, {"Hz": arguments.hz, "mm": arguments.mm})
    rows, columns = (reach(file, axis, *drift) for axis in (file.rows, file.columns))
    found = quantity.of(admitted(file, starts, quantity.name))
    worst = worst_of_boxes(found, rows, columns, codes_of(arguments.regime))
    asks = starts != JOB or told.has_job(file)  # a map made by hand may have none
    stays_free = told.may_stay_free(file, rows, columns) if asks else np.zeros(file.shape, dtype=bool)
    if starts == ANY:
        worst = np.where(stays_free, np.nan, worst)
    places = best_places(worst, found, rows, columns)
    what = words.starts_in_words(starts), words.drift_in_words(file, rows, columns)
    apart, boxes = words.boxes_in_words(file, rows, columns)
    if not places:
        raise refusal_of(file, arguments, starts, quantity, found, (rows, columns), stays_free)
    tell(f"{file.title}\n{quantity.title} {what[0]}, {what[1]}: one motion in the boxes of "
         f"{100 * float(np.mean(np.isfinite(worst))):.3g} % of the cells")
    if boxes:
        tell(f"  {apart}: {boxes}")
    tell_of_weights(quantity)
    for line in what_is_told(file, starts, places[0], (rows, columns), bool(stays_free[places[0].row, places[0].column])):
        tell(f"  {line}")
    for line in words.table(file, places, quantity, None if starts in (ANY, JOB) else "smallest share"):
        tell(line)
    for line in words.best_lines(file, places[0], quantity, fields_at(file, places[0])):
        tell(line)
    if file.outcome_slots > 0:
        tell(f"  of the job's own rig alone: what its {draws_of(file).count} drawn rigs reach is told by --risk 0.95")
    if file.is_refined:
        tell(f"  {OF_REFINED}; --verify computes all of the box")
    said = quantity, what[0], "\n".join(filter(None, [what[1], boxes]))
    save_all(picture.draw(file, worst, places, rows, columns, said), arguments.output_dir, f"{file.path.stem}_operating_point",
             arguments.formats)
    if arguments.verify:
        checked = verify.verify(file, places[0], (rows, columns), starts, quantity, arguments.output_dir, arguments.ranks, arguments.peterka)
        tell(verify.text_of(file, places[0], checked, quantity))
    return DONE


OF_REFINED = "the map is refined: cells that were filled count as if they were computed"


def operate_at_risk(file: PeterkaFile, arguments: argparse.Namespace) -> int:
    """The same for a value that is reached with a probability; the exit code."""
    draws, quantity = risk.refuse_untold(file, arguments.risk), risk.quantity_at(file, arguments.risk, arguments.regime)
    if arguments.quantity not in (None, quantity.name):
        raise file.refusal(f"keeps of its drawn rigs the {quantity.name} alone; --risk doesn't go with --quantity {arguments.quantity}")
    widths = read_drift(file, {"Hz": arguments.hz, "mm": arguments.mm})
    rows, columns = (reach(file, axis, *widths) for axis in (file.rows, file.columns))
    found = quantity.of(risk.admitted_at(file, arguments.risk, arguments.regime))
    worst = worst_of_boxes(found, rows, columns)
    places = risk.with_motions(file, best_places(worst, found, rows, columns), rows, columns)
    drift = words.drift_in_words(file, rows, columns)
    apart, boxes = words.boxes_in_words(file, rows, columns)
    if not places:
        raise refusal_at_risk(file, arguments, found, (rows, columns))
    tell(f"{file.title}\n{quantity.title}, {drift}: above 0 in the boxes of {100 * float(np.mean(worst > 0)):.3g} % of the cells")
    if boxes:
        tell(f"  {apart}: {boxes}")
    tell_of_weights(quantity)
    tell(f"  {risk.text_of_sampling(file, arguments.risk, draws, arguments.regime)}")
    if file.is_refined:
        tell(f"  {OF_REFINED}: their probabilities and values are interpolated, no rig was drawn there; --verify draws afresh in the best box")
    for line in risk.strange_offsets(file):
        tell(f"  {line}")
    for line in words.table(file, places, quantity, "least probability of z"):
        tell(line)
    tell(words.best_lines(file, places[0], quantity, {})[0])
    if places[0].motion == NAMES[CHAOTIC]:
        what = "force" if quantity.name == "peak_force" else "speed"
        tell(f"  there chaos is the commonest motion, whose {what} is the largest one observed while it was followed, and which may end later")
    said = quantity, draws.in_words, "\n".join(filter(None, [drift, boxes]))
    save_all(picture.draw(file, np.where(worst > 0, worst, np.nan), places, rows, columns, said), arguments.output_dir,
             f"{file.path.stem}_operating_point_risk", arguments.formats)
    if arguments.verify:
        fresh = fresh_draws.draw_afresh(file, places[0], widths, arguments.risk, arguments.output_dir,
                                        arguments.ranks, arguments.peterka, arguments.regime)
        tell(fresh_draws.text_of(fresh, places[0], arguments.risk, quantity, arguments.regime))
    return DONE


def refusal_of(file: PeterkaFile, arguments: argparse.Namespace, starts: str | float, quantity: Quantity, found: Admitted,
               reaches: tuple[Reach, Reach], stays_free: Mask) -> PeterkaFileError:
    """That no place has what is asked for, and what of that may be allowed instead, if anything."""
    strikes = found.code != NO_REGIME
    if quantity.name == "peak_force" and strikes.any() and np.isnan(found.value[strikes]).all():
        return file.refusal("has no peak forces, as where the stop is rigid: --quantity impact_speed finds the hardest blow")
    asked = f"in one motion with impacts{' of ' + ','.join(arguments.regime) if arguments.regime else ''}"
    has_any, with_fewer = (has_motion(each, arguments.regime) for each in (
        found, found if starts == JOB else admitted(file, MORE_THAN_HALF, quantity.name)))
    if not with_fewer:
        of = words.starts_in_words(starts)[5:] if starts == JOB else "more than half of its starts"
        return file.refusal(f"has no {computed_cell(file)} with {of} {asked}, whatever the drift")
    inside = reaches[0].inside[:, None] & reaches[1].inside[None, :]
    free = f", and the hammer can swing without impact in {100 * np.mean(stays_free[inside]):.3g} % of the boxes" if inside.any() and (
        starts == ANY) else ""
    fewer = "a share of the starts (--starts share 0.9)" if starts == ANY else "fewer starts"
    return file.refusal(f"has no place with {words.starts_in_words(starts)[5:]} {asked} {words.at_drift(file, *reaches)}{free}" + instead(
        "less drift" if has_any and words.drifts(*reaches) else "", fewer if starts != JOB else ""))


def refusal_at_risk(file: PeterkaFile, arguments: argparse.Namespace, found: Admitted, reaches: tuple[Reach, Reach]) -> PeterkaFileError:
    """The same for a value that is reached with a probability."""
    asked = f"at which the hammer impacts{' in ' + ','.join(arguments.regime) if arguments.regime else ''} with a probability of "
    has_any, with_less = (bool(np.any((each.code != NO_REGIME) & (each.value > 0))) for each in (
        found, risk.admitted_at(file, min(risk.KEPT), arguments.regime)))
    told_from = "" if not arguments.regime else (f"; it keeps the values of all motions together, so that these motions need a probability of "
                                                 f"{risk.needed_share(arguments.risk):g} to tell one in them")
    if not has_any and not with_less:
        return file.refusal(f"has no {computed_cell(file)} {asked}{min(risk.KEPT):g}, whatever the drift")
    return file.refusal(f"has no place {asked}{arguments.risk:g} {words.at_drift(file, *reaches)}{told_from}" + instead(
        "less drift" if has_any and words.drifts(*reaches) else "", "a smaller probability" if arguments.risk > min(risk.KEPT) and with_less else ""))


def computed_cell(file: PeterkaFile) -> str:
    """What a refusal calls a cell: of an unfinished map, the others aren't known."""
    return "cell" if file.is_complete else "cell among those that are computed"


def has_motion(found: Admitted, regimes: list[str] | None) -> bool:
    """Whether a cell has a motion with impacts, one of ["p/q"] or any, whatever its neighbours have."""
    codes = codes_of(regimes)
    return bool(np.any(found.code != NO_REGIME if codes is None else np.isin(found.code, list(codes))))


def instead(*allowed: str) -> str:
    """What may be allowed instead, as the end of a refusal; those that are empty are left out."""
    told = ", or ".join(filter(None, allowed))
    return f"; allow {told}" if told else ""


def tell_of_weights(quantity: Quantity) -> None:
    """Says so where places are ranked by forces over the weight."""
    if quantity.unit == OVER_WEIGHT:
        tell("  the file doesn't tell the hammer's mass: the order is that of forces over its weight, not of those in N")


def what_is_told(file: PeterkaFile, starts: str | float, best: Place, reaches: tuple[Reach, Reach], stays_free: bool) -> list[str]:
    """Lines: what is proved, what sampled, and which motions are left out."""
    if starts == ANY:
        older = [] if file.data.has("attractor_orbit_displacement") else [
            "the file doesn't tell what is known beside its starts: compute it again with this program"]
        return [told.text_of_proof(file), told.text_of_sampling(told.starts_of(file), None), *older]
    if starts == JOB:
        also = f"; a motion without impact exists in the best box ({told.closed_form_of(file)})" if stays_free else ""
        return [f"by computation: at the cells of a box, from this one start; others may end elsewhere{also}"]
    return [told.text_of_sampling(told.starts_of(file), best.share),
            told.text_of_left_out(file, told.left_out(file, best, *reaches), stays_free)]


def fields_at(file: PeterkaFile, place: Place) -> dict[str, float]:
    """{dataset: value} of a cell."""
    names = ["regime", *(name for name in QUANTITIES.values() if name == "peak_force_ratio" or name in file.quantities)]
    band = file.band(names, place.row, place.row + 1)
    return {name: float(band[name][0, place.column]) for name in names[1:]}


def codes_of(regimes: list[str] | None) -> set[int] | None:
    """Codes of ["p/q"]; None for any."""
    if regimes is None:
        return None
    p, q = np.array([list(map(int, regime.split("/"))) for regime in regimes]).T
    return set(label_codes(np.full(len(p), PERIODIC), p, q).tolist())


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("map", metavar="MAP.h5", type=Path)
    parser.add_argument("--hz", type=read_width, help=f"drift of the frequency to either side; default: {USUAL['Hz']}")
    parser.add_argument("--mm", type=read_width, help=f"drift of the gap to either side; default: {USUAL['mm']}")
    parser.add_argument("--starts", metavar="WHICH", nargs="+", help="any, share S, or job")
    parser.add_argument("--quantity", choices=list(QUANTITIES), help="default: peak_force")
    parser.add_argument("--regime", metavar="P/Q,...", type=read_regimes)
    parser.add_argument("--risk", metavar="PROBABILITY", type=read_probability, help="of a map with [uncertainty]: 0.95 or 0.5")
    parser.add_argument("--verify", action="store_true")
    parser.add_argument("--peterka", metavar="PROGRAM", type=Path)
    parser.add_argument("--ranks", metavar="N", type=read_count, default=1, help="of --verify, started by mpirun; default: 1")
    parser.add_picture_arguments()
    add_look_arguments(parser)
    arguments = parser.parse_args()
    check_style(parser, arguments)
    if arguments.risk is not None and arguments.starts is not None:
        parser.error("--risk takes the starts of the drawn rigs; it doesn't go with --starts")
    arguments.starts = read_starts(arguments.starts, parser)
    return arguments


def read_starts(which: list[str] | None, parser: argparse.ArgumentParser) -> str | float | None:
    """ANY, JOB, or a share; None where nothing is asked for."""
    if which is None or which in (["any"], ["job"]):
        return which[0] if which else None
    if which[0] == "share" and len(which) == 2:
        try:
            share = float(which[1])
        except ValueError:
            share = np.nan
        if 0.5 < share <= 1:
            return share
    return parser.error(f"--starts {' '.join(which)}: any, job, or share and a number above 0.5 up to 1")


def read_probability(text: str) -> float:
    """The probability, between 0 and 1, that an argument says."""
    try:
        probability = float(text)
    except ValueError:
        probability = np.nan
    if not 0 < probability < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a probability between 0 and 1")
    return probability


def read_width(text: str) -> float:
    """The half-width of a drift, 0 or above, that an argument says."""
    try:
        width = float(text)
    except ValueError:
        width = np.nan
    if not 0 <= width < 1e100:
        raise argparse.ArgumentTypeError(f"'{text}' is not 0 or a number above")
    return width


def read_regimes(text: str) -> list[str]:
    """The list of p/q that an argument says."""
    regimes = text.split(",")
    if not all(re.fullmatch(r"[1-9]\d{0,8}/[1-9]\d{0,8}", regime) for regime in regimes):
        raise argparse.ArgumentTypeError(f"'{text}' is not a list of p/q such as 1/1,1/2")
    return list(dict.fromkeys(regimes))


def read_count(text: str) -> int:
    """The number of ranks that an argument says."""
    if not (text.isascii() and text.isdigit() and 0 < int(text) < 10**6):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number of ranks")
    return int(text)
