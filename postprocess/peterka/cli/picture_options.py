"""Picture options required by journals, as program arguments, and the part of a file selected by --zoom."""

import argparse
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..arrays import Reals
from ..files.checked_hdf5 import CheckedFile
from ..files.coordinates import Coordinate, measured
from ..files.opened import OpenedFile
from ..plotting.coordinates import IN_MILLIMETRES
from ..plotting.style import PALETTES, UNITS
from ..maps.curves_file import CurvesFile
from ..maps.map_file import Axis, PeterkaFile
from ..pictures import open_file
from ..sweeps.sweep_file import SweepFile

WIDTHS = (40, 500)  # mm
DPIS = (50, 2400)
ROUNDING = 1e-6  # of a step of an axis: 1.9 as a ratio and 8.55 Hz differ in their last bits


def add_style_arguments(parser: argparse.ArgumentParser) -> None:
    """Those of add_look_arguments, --limits, --log and --zoom."""
    add_look_arguments(parser)
    parser.add_argument("--limits", metavar="LOW,HIGH", type=numbers_of(2), help="ends of the scale of values or forces; with --units si in N, m/s, s, ... whatever the scale's prefix, otherwise in the "
                             "ratio that it shows (forces over the hammer's weight), or in SI where there is none")
    parser.add_argument("--log", action="store_true", help="makes that scale logarithmic")
    parser.add_argument("--zoom", metavar="X0,X1[,Y0,Y1]", type=numbers_of(2, 4),
                        help="part of the axes, exactly from end to end, whichever unit the job has: in ratios, or in Hz and mm with --units si")


def add_look_arguments(parser: argparse.ArgumentParser) -> None:
    """--width, --dpi, --font, --no-title, --palette and --units."""
    parser.add_argument("--width", metavar="MM", type=number_within(*WIDTHS), help="width of a picture; 84 fits a column of most journals")
    parser.add_argument("--dpi", type=number_within(*DPIS), help="dots per inch; default: as many as the cells need")
    parser.add_argument("--font", metavar="NAME", help="a font family of this machine")
    parser.add_argument("--no-title", dest="title", action="store_false", help="leave the title out, for the caption has it")
    parser.add_argument("--palette", choices=PALETTES, default=PALETTES[0], help="colour was checked for the three kinds of colour blindness; grey tells classes apart by lightness and hatching")
    parser.add_argument("--units", choices=UNITS, default=UNITS[0],
                        help="ratios and Hz, mm and m/s, or one of both alone, in pictures and in what is printed; default: both")


def style_of(arguments: argparse.Namespace) -> dict[str, object]:
    """The fields of a Style that are set by the arguments."""
    names = ("width", "dpi", "font", "title", "limits", "log", "palette", "units")
    return {name: getattr(arguments, name) for name in names if hasattr(arguments, name)}


def check_style(parser: argparse.ArgumentParser, arguments: argparse.Namespace) -> None:
    """Checks constraints that involve more than one argument."""
    if arguments.font:
        from matplotlib.font_manager import get_font_names
        if arguments.font not in get_font_names():
            parser.error(f"there is no font '{arguments.font}' on this machine; fc-list tells which there are")
    for name in ("limits", "zoom"):
        ends = getattr(arguments, name, None) or ()
        if any(not low < high for low, high in zip(ends[::2], ends[1::2])):
            parser.error(f"--{name} wants the smaller number first")


def number_within(low: float, high: float) -> Callable[[str], float]:
    """Reads an argument that is a number from low to high."""
    def read(text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            number = float("nan")
        if not low <= number <= high:
            raise argparse.ArgumentTypeError(f"'{text}' is not a number from {low} to {high}")
        return number
    return read


def numbers_of(*counts: int) -> Callable[[str], tuple[float, ...]]:
    """Reads an argument of this many numbers separated by commas."""
    def read(text: str) -> tuple[float, ...]:
        try:
            found = tuple(float(part) for part in text.split(","))
        except ValueError:
            found = ()
        if len(found) not in counts or not all(abs(number) < 1e100 for number in found):
            raise argparse.ArgumentTypeError(f"'{text}' is not {' or '.join(map(str, counts))} numbers with commas between them")
        return found
    return read


def zoomed(file: OpenedFile, zoom: tuple[float, ...] | None, in_si: bool) -> OpenedFile:
    """The part of a map, basin, sweep or file of curves within (x0, x1, y0, y1), or between x0 and x1; the whole file without a zoom.
    Boundary cells of a plane are cut so that the picture ends exactly at the requested limits."""
    if not zoom:
        return file
    axes = _axes(file)
    if len(zoom) > 2 * len(axes):
        raise file.refusal(f"is of kind {file.kind}; --zoom takes {2 * len(axes)} numbers there")
    from ..files.dataset import dataset_of  # xarray takes long to load

    assert isinstance(file.data, CheckedFile)
    data = dataset_of(file.data)
    ends: dict[str, tuple[float, float]] = {}
    shown: dict[str, slice] = {}
    for axis, low, high in zip(axes, zoom[::2], zoom[1::2]):
        unit = measured(file, axis.name) if in_si or axis.name in IN_MILLIMETRES else None
        factor = unit.factor if unit else 1.0
        ends[axis.name] = low / factor, high / factor
        shown[axis.name] = _shown(file, axis, *ends[axis.name])
        data = data.isel({axis.stored: shown[axis.name]})
        left = data.sizes[axis.stored]
        if left < 2:
            raise file.refusal(f"has {left} point{'s' * (left != 1)} of {unit.what if unit else axis.name} from {low:g} to {high:g}"
                               f"{f' {unit.unit}' if unit else ''}; --zoom has to leave 2{_other_unit(file, axis, low, high, in_si)}")
    part = open_file(data)
    if isinstance(part, PeterkaFile) and isinstance(file, PeterkaFile):
        if file.audit is not None:  # whose cells are told by row and column of the whole
            part.audit = file.audit.within(*(shown.get(axis.name, slice(0, len(axis.values))) for axis in (file.rows, file.columns)))
        part.rows, part.columns = (_cut(axis, ends.get(axis.name)) for axis in (part.rows, part.columns))
    if isinstance(part, CurvesFile):
        part.cut_to_window()
    return part


def _other_unit(file: OpenedFile, axis: Axis | Coordinate, low: float, high: float, in_si: bool) -> str:
    """What says that these numbers fit the other unit of an axis; empty if they don't."""
    unit = measured(file, axis.name)
    if unit is None or axis.name in IN_MILLIMETRES:
        return ""
    part = _shown(file, axis, low, high) if in_si else _shown(file, axis, low / unit.factor, high / unit.factor)
    if part.stop - part.start < 2:
        return ""
    return "; as ratios these numbers fit: leave --units si out for them" if in_si else f"; it takes {unit.unit} with --units si"


def _shown(file: OpenedFile, axis: Axis | Coordinate, low: float, high: float) -> slice:
    """The slice of an axis' points whose cells (in a sweep: the points themselves) lie between `low` and `high`."""
    if isinstance(axis, Coordinate):
        assert isinstance(file, SweepFile)
        return _inside(file.values, low, high)
    rounding = ROUNDING * np.diff(axis.edges)
    first = np.count_nonzero(axis.edges[1:] <= low + rounding)
    return slice(first, max(first, np.count_nonzero(axis.edges[:-1] < high - rounding)))


def _cut(axis: Axis, ends: tuple[float, float] | None) -> Axis:
    """The axis with its outer cells cut at these ends."""
    if ends is None:
        return axis
    edges = axis.edges.copy()
    edges[0], edges[-1] = max(edges[0], ends[0]), min(edges[-1], ends[1])
    return replace(axis, edges=edges)


def _inside(values: Reals, low: float, high: float) -> slice:
    """The slice of ascending numbers from `low` to `high`, endpoints included up to rounding."""
    rounding = ROUNDING * (np.gradient(values) if len(values) > 1 else 0.0)
    first = np.count_nonzero(values < low - rounding)
    return slice(first, max(first, np.count_nonzero(values <= high + rounding)))


def _axes(file: OpenedFile) -> tuple[Axis | Coordinate, ...]:
    """The horizontal and the vertical axis, each with its name, and its name and unit in the file."""
    if isinstance(file, PeterkaFile):
        return file.columns, file.rows
    if isinstance(file, SweepFile):
        return (file.axis,)
    raise file.refusal(f"is of kind {file.kind}; --zoom shows parts of maps, basins, sweeps and curves")
