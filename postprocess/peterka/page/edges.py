"""Page content of a file of curves besides its coarse map: the curves, their kinds, and for each of their points the orbit
at forcing phase 0, from which the page's engine follows it to either side."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..arrays import Reals
from ..maps.curves_file import CurvesFile
from ..maps.curves_map import COLOURS, LETTERS, LOOKS, WORDS

from . import planes

ORBIT = ("point_orbit_displacement", "point_orbit_velocity")
OF_POINTS = ("point_multiplier", "point_peak_force_ratio", *ORBIT)


def edges(file: CurvesFile, keep: Callable[[bytes], int]) -> dict[str, Any]:
    """{"list": [kind, p, q and range of points of each curve], "points": {name: packed}, ...}."""
    ends = np.cumsum([0, *(len(curve.rows) for curve in file.curves)]).tolist()
    points = {"column": [curve.columns for curve in file.curves], "row": [curve.rows for curve in file.curves]}
    held = [name for name in OF_POINTS if file.curves and file.data.has(name)]
    for name in held:
        points[name.removeprefix("point_")] = file.along_curves(name)
    return {
        "list": [{"kind": curve.kind, "impacts": curve.impacts, "period": curve.period, "from": first, "to": last}
                 for curve, first, last in zip(file.curves, ends, ends[1:])],
        "points": {name: _packed(np.concatenate([np.zeros(0), *values]), keep) for name, values in points.items()},
        "has_orbits": all(name in held for name in ORBIT),
        "specials": [{"words": LETTERS[special.kind][1], "place": [special.column, special.row]} for special in file.specials],
        "kinds": {kind: {"words": words, "colour": COLOURS[kind], "dash": _dash(kind)} for kind, words in WORDS.items()},
    }


def _dash(kind: str) -> list[float]:
    """Lengths of dashes and gaps in line widths; empty for a solid line."""
    style: Any = LOOKS[kind]["linestyle"]
    return [] if style == "-" else list(style[1])


def _packed(values: Reals, keep: Callable[[bytes], int]) -> dict[str, Any]:
    description, packed = planes.reals(values)
    return {"plane": description, "blob": keep(packed)}
