"""Draws the pictures of peterka's files.

    draw.py FILE.h5 [FILE.h5 ...] [--output-dir DIR] [--formats png,pdf,svg] [--only NAME,NAME] [--after CYCLES]
            [--measured POINTS.csv] [--curves CURVES.h5]
            [--probability impacts|P/Q|...] [--width MM] [--dpi N] [--font NAME] [--no-title] [--zoom X0,X1[,Y0,Y1]]
            [--limits LOW,HIGH] [--log] [--palette colour|grey] [--units both|si|ratio]

A map gives STEM_map (classes of z = p/q), STEM_force_1_1 and STEM_force_all (peak force), STEM_audit where cells were
audited, STEM_computed where it is refined, and STEM_proved (of which cells the motion is proved, and why that of others
is not) where it has certificates, and STEM_proved_attractors where its attractors have some; a basin gives STEM_basin (by attractor) and STEM_basin_impact (impact
or not). Both give a picture of each of impact_speed, impulse, contact_time, contact_power_w, max_displacement, multiplier,
lyapunov, sensitivity, force_per_cycle (mean and 95 % quantile) that they hold, and a map of orbit (displacement and
velocity). With --curves, a file of curves of the same rig over the same axes, in either unit, a map gives STEM_curves_over_map. Where
last_impact is stored there is STEM_last_impact, and of a basin STEM_impact_after_300: what a run of only 300 cycles, or
--after, would see. A map with [starts] gives STEM_attractors (how many of a cell are known), STEM_attractors_largest (on which most
starts end), STEM_attractors_impact (share of starts that impact), STEM_share_... (share of each of the commonest z) and,
where kicks are stored, STEM_kick; a map with [noise] gives STEM_life, the mean life of settled motions.
A map with force_elasticity or speed_elasticity gives STEM_elasticity_... (% per %) for each number by which it has one, where it tells
the rig STEM_force_per_... or STEM_speed_per_... (N per Hz, N per mm, N per kN/m, ...), and STEM_depends_most: the number that matters
most, with [uncertainty] as far as it is uncertain.
A map with [uncertainty] gives STEM_outcome (where most of the drawn rigs end, and how likely that is), STEM_force_q05 (the
force that all but 5 % of them reach), and STEM_probability_... of each of the commonest motions and of the one that
--probability names (refused where no rigs were drawn), with lines at those of 0.5, 0.9 and 0.95 that the number of draws can tell (5, 29 and 59 draws).
A sweep gives STEM_response (peak force), STEM_bifurcation and
STEM_bifurcation_impact (hammer displacement at forcing phase 0 and at first touch), with the borders that a file of
curves, --curves, tells at its gaps, which are listed, too, and the unstable orbits between them; with [uncertainty] STEM_response_of_rigs,
the band in which nine of ten drawn rigs lie; and over its axis each of impact_speed, impulse, contact_time, contact_power_w,
max_displacement, multiplier, lyapunov, sensitivity, last_impact, force_per_cycle, life ([noise]) and elasticities that it holds. A file of curves gives
STEM_curves, STEM_curves_over_map and, with curves.edge_distance, STEM_edge_distance_frequency and STEM_edge_distance_gap (of
other axes _columns and _rows). The points of --measured lie over these three, and over
STEM_map and STEM_force_... of a map. A trace gives STEM_motion, STEM_phase_plane, STEM_relative_plane (x - y, with the stop),
STEM_poincare (points at forcing phase 0), STEM_impact and STEM_spectrum. A study gives STEM_work_precision,
STEM_labels or STEM_stability. An unfinished file is drawn as far as it is computed, and says so.
A p/q has the same colour in every picture; what is rarer than all that a legend names is "other p/q". But for the fourteen
commonest, several p/q share one of eight colours: no legend names two of them, but those of two pictures may. Every two colours of
the palette stay apart for protanopes, deuteranopes and tritanopes, too, as simulated (smallest CIEDE2000 difference 8.1; 12.7
for normal sight).
Exit codes: 0 done; 2 a file cannot be drawn, or bad arguments; 3 a picture cannot be written.
"""

import argparse
import gc
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from ..export.formats import export, left_out_in_words, read_formats
from ..errors import PeterkaFileError
from ..files.nearest import instead_of
from ..files.opened import OpenedFile
from ..plotting.figures import figure_of
from ..plotting.limits import NothingToSee
from ..plotting.style import listening, using
from ..maps.curves_over import read_lines
from ..maps.map_file import PeterkaFile
from ..maps.outcomes import read_wanted
from ..measurements import map_residuals
from ..measurements.points import Measurements, Point, read_measurements
from ..pictures import open_file, picture_name, pictures_of
from .command_line import (
    BAD_INPUT, BAD_OUTPUT, DONE, OneLineParser, complain, complain_of_folder, exit_code, save_all,
    tell, tell_if_unfinished,
)
from .picture_options import (
    add_style_arguments, check_style, style_of, zoomed,
)
from ..sweeps import residuals, uncertain_response
from ..sweeps import borders as of_sweeps
from ..sweeps.borders import NO_BORDERS, Border
from ..sweeps.sweep_file import SweepFile
from ..sweeps.unstable import NO_UNSTABLE, read_unstable


def main() -> int:
    """peterka-draw; the exit code."""
    return exit_code(_draw())


def _draw() -> int:
    arguments = read_arguments()
    warnings.filterwarnings("ignore", message="Glyph .* missing")  # a title may use letters the font lacks
    outcome = DONE
    for path in arguments.files:
        try:
            outcome = draw_file(path, arguments) or outcome
        except PeterkaFileError as refusal:
            complain(refusal)
            outcome = outcome or BAD_INPUT
        except OSError as error:
            complain_of_folder(arguments.output_dir, error)
            return BAD_OUTPUT
    return outcome


def read_arguments() -> argparse.Namespace:
    """Of the command line; ends the program where they make no sense."""
    parser = OneLineParser(__doc__)
    parser.add_argument("files", metavar="FILE.h5", nargs="+", type=Path)
    parser.add_picture_arguments()
    parser.add_argument("--only", metavar="NAME,...", type=lambda text: text.split(","), default=[],
                        help="these pictures alone, named as in the files: map, force_all, response, ...")
    add_style_arguments(parser)
    parser.add_argument("--after", metavar="CYCLES", type=read_cycles, default=300, help="default: 300")
    parser.add_argument("--export", metavar="csv,vtk,mat", type=read_formats, default=[],
                        help="besides, the cells of maps and basins for other programs, as export.py writes them")
    parser.add_argument("--measured", metavar="POINTS.csv", type=Path,
                        help="points to draw over a sweep or map, one a line below the names of the columns: frequency_hz or frequency_ratio, "
                             "force_n or force_ratio, displacement_mm or displacement_ratio, gap_mm or gap_ratio, and optionally standard errors "
                             "(force_error_n, ...), series, label. Two lines of an example: frequency_hz,gap_mm,force_n,label / "
                             "9.0,1.0,152.5,first run")
    parser.add_argument("--probability", metavar="MOTION", type=read_motion,
                        help="of drawn rigs, in a map with [uncertainty]: a p/q, 'no impact', chaotic, or impacts, of any kind; default: impacts")
    parser.add_argument("--curves", metavar="CURVES.h5", type=Path,
                        help="marks and lists where the motions of a sweep end or change, from curves with its gaps; draws them over a map")
    arguments = parser.parse_args()
    check_style(parser, arguments)
    parser.refuse_equal_stems(arguments.files, "pictures")
    return arguments


def read_cycles(text: str) -> int:
    """The number of forcing cycles that an argument says."""
    if not (text.isascii() and text.isdigit() and 0 < int(text) < 10**9):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number of forcing cycles")
    return int(text)


def read_motion(text: str) -> str:
    """The motion that an argument says."""
    try:
        return read_wanted(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def draw_file(path: Path, arguments: argparse.Namespace) -> int:
    """All pictures of a file that are asked for, and what is told of it besides; the exit code."""
    outcome = DONE
    with open_file(path) as whole, using(**style_of(arguments)):
        file = zoomed(whole, arguments.zoom, arguments.units == "si")
        for written in export(whole, arguments.output_dir, arguments.export) if arguments.export else []:
            tell(written)
        for line in left_out_in_words(whole) if arguments.export else []:
            tell(line)
        measured = Measurements([], [])
        if arguments.measured:
            measured = read_measurements(arguments.measured, file)
        for sentence in measured.left_out:
            tell(sentence)
        if measured.points:
            tell_residuals(file, measured.points)
        borders: Sequence[Border] = NO_BORDERS
        unstable, curves = NO_UNSTABLE, None
        if arguments.curves and isinstance(file, SweepFile):
            borders = of_sweeps.read_borders(arguments.curves, file)
            unstable = read_unstable(arguments.curves, file, borders) if borders else NO_UNSTABLE
            for line in of_sweeps.told(arguments.curves, file, borders):
                tell(line)
        elif arguments.curves:
            curves = read_lines(arguments.curves, file)
        tell_if_unfinished(whole)
        pictures = pictures_of(file, arguments.after, measured, borders, unstable, curves, arguments.probability)
        for name, draw in chosen(file, pictures, arguments.only, bool(arguments.zoom)).items():
            try:
                with listening() as asked:
                    drawn = draw(file)
            except NothingToSee as refusal:  # limits are meant for some of the pictures
                complain(f"{name}: {refusal}")
                outcome = BAD_INPUT
                continue
            if drawn is None:
                why = " (impacts have no peak force, as on a rigid stop; the field impact_speed has a picture)" if isinstance(file, SweepFile) and "response" in name and file.lacks_forces else ""
                tell(f"{path}: no value to draw{why}, {name} is left out")
                continue
            unheard = [f"--{option}" for option in ("limits", "log") if getattr(arguments, option) and option not in asked]
            if unheard and arguments.only:
                tell(f"{name}: {' and '.join(unheard)} {'set' if len(unheard) > 1 else 'sets'} nothing in it")
            save_all(figure_of(drawn), arguments.output_dir, picture_name(file, name), arguments.formats)
            # Figures of large maps keep hundreds of megabytes in reference cycles; they must not add up.
            del drawn
            gc.collect()
    return outcome


def chosen(file: OpenedFile, pictures: dict[str, Callable[..., Any]], names: Sequence[str],
           is_part: bool = False) -> dict[str, Callable[..., Any]]:
    """The pictures of these names; all of them where none is named. A part of a file, as of --zoom, may give fewer."""
    unknown = [name for name in names if name not in pictures]
    if unknown:
        raise file.refusal(f"gives no picture{' with --zoom' * is_part} named {instead_of(unknown, pictures, 'it gives')}")
    return {name: draw for name, draw in pictures.items() if name in names or not names}


def tell_residuals(file: OpenedFile, points: Sequence[Point]) -> None:
    """Prints how far measured forces are from the motions of a map or a sweep."""
    lines: list[str] = []
    if isinstance(file, PeterkaFile):
        lines = map_residuals.table(file, map_residuals.residuals(file, points))
    elif isinstance(file, SweepFile):
        lines = residuals.table(file, residuals.residuals(file, points))
        if uncertain_response.has_force_bands(file):
            lines.append(uncertain_response.inside_in_words(file, points))
    for line in lines:
        tell(line)
