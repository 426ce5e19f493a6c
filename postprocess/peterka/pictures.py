"""Which pictures a file gives: the one place that knows them all. A new picture is a row of PICTURES.

Each is drawn by a function draw(data, ax=None, ...) of plotting.picture: data an open file or a dataset, ax where to.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from .files.opened import OpenedFile, Source
from .maps import (
    attractor_maps, audit_map, basin_map, computed_map, curves_map, edge_distance_map, elasticity_map, force_map, last_impact, life_map,
    number_map, peterka_map, proved_map, quantity_map, rate_map, uncertain_map,
)
from .maps.curves_file import CurvesFile, Lines, UnstableBranch
from .maps.map_file import PeterkaFile
from .maps.rates import NAMES as NAMES_OF_RATES
from .measurements.points import NOTHING_MEASURED, Measurements
from .studies import labels, stability, work_precision
from .studies.study_file import StudyFile
from .sweeps import bifurcation, field_response, response, uncertain_response
from .sweeps.borders import NO_BORDERS, Border
from .sweeps.sweep_file import SweepFile
from .sweeps.unstable import NO_UNSTABLE
from .traces import impact, motion, phase_plane, relative_plane, spectrum
from .traces.trace_file import TraceFile

READERS = {"map": PeterkaFile, "basin": PeterkaFile, "sweep": SweepFile, "trace": TraceFile, "study": StudyFile,
           "curves": CurvesFile}


@dataclass(frozen=True)
class Row:
    """A picture: its name after the file's stem, the kinds of files that provide it, its drawing function, a test for the
    data it needs, and the caller's options that it accepts."""

    name: str
    kinds: tuple[str, ...]
    draw: Callable[..., Any]
    has: Callable[[Any], object] = lambda file: True  # a file of these kinds
    takes: tuple[str, ...] = ()


def _holds(kind: str, name: str) -> Callable[[Any], bool]:
    return lambda file: name in getattr(file, kind)


def _has_share(name: str) -> Callable[[Any], bool]:
    return lambda file: file.slots > 0 and name in attractor_maps.commonest(file)


PLANES = ("map", "basin")
CURVES = "curves"  # of another file
OVER_SWEEPS = ("measured", "borders", "unstable")
PICTURES = [
    Row("map", ("map",), peterka_map.draw, takes=("measured",)),
    Row("force_1_1", ("map",), force_map.draw_single_impact, takes=("measured",)),
    Row("force_all", ("map",), force_map.draw_all_impacts, takes=("measured",)),
    Row("basin", ("basin",), basin_map.draw_attractors),
    Row("basin_impact", ("basin",), basin_map.draw_impact),
    *(Row(name, PLANES, partial(quantity_map.draw, name=name), _holds("quantities", name))
      for name in quantity_map.TITLES),
    *(Row(name, ("map",) if name.startswith("orbit") else PLANES, partial(number_map.draw, name=name),
          _holds("numbers", name)) for name in number_map.NUMBERS),
    *(Row(f"elasticity_{number}", ("map",), partial(elasticity_map.draw, number=number), partial(elasticity_map.has, number=number))
      for number in elasticity_map.NUMBERS),
    *(Row(name, ("map",), partial(rate_map.draw, name=name), partial(rate_map.has, name=name)) for name in NAMES_OF_RATES),
    Row("depends_most", ("map",), elasticity_map.draw_most, elasticity_map.has_two),
    Row("last_impact", PLANES, last_impact.draw, lambda file: file.has_last_impact),
    Row("impact_after_{cycles}", ("basin",), basin_map.draw_impact_after, lambda file: file.has_last_impact, ("cycles",)),
    Row("attractors", ("map",), attractor_maps.draw_number, lambda file: file.slots > 0),
    Row("attractors_largest", ("map",), attractor_maps.draw_largest, lambda file: file.slots > 0),
    Row("attractors_impact", ("map",), attractor_maps.draw_impacting, lambda file: file.slots > 0),
    *(Row(name, ("map",), partial(attractor_maps.draw_share, name=name),
          _has_share(name))
      for name in attractor_maps.SHARES),
    Row("kick", ("map",), attractor_maps.draw_kick, lambda file: file.has_kicks),
    Row("life", ("map",), life_map.draw, lambda file: file.has_lives),
    Row("outcome", ("map",), uncertain_map.draw_commonest, lambda file: file.outcome_slots > 0),
    Row("force_q05", ("map",), uncertain_map.draw_force, uncertain_map.has_quantiles),
    *(Row(name, ("map",), partial(uncertain_map.draw_probability, probability=wanted), partial(uncertain_map.has, name=name))
      for name, wanted in uncertain_map.PROBABILITIES.items()),
    Row("probability_{asked}", ("map",), uncertain_map.draw_probability, lambda file: file.outcome_slots > 0, ("probability",)),
    Row("computed", PLANES, computed_map.draw, lambda file: file.is_refined),
    Row("proved", PLANES, proved_map.draw, lambda file: file.has_proofs),
    Row("proved_attractors", ("map",), proved_map.draw_attractors, lambda file: file.has_slot_proofs),
    Row("audit", ("map",), audit_map.draw, lambda file: file.audit is not None),
    Row("curves", ("curves",), curves_map.draw, lambda file: bool(file.curves)),
    Row("curves_over_map", ("curves",), curves_map.draw_over_map),
    Row("curves_over_map", ("map",), curves_map.draw_over_map_of, takes=(CURVES,)),
    *(Row(name, ("curves",), partial(edge_distance_map.draw, side=side), partial(edge_distance_map.has, side=side))
      for name, side in edge_distance_map.PICTURES.items()),
    Row("response", ("sweep",), response.draw, takes=OVER_SWEEPS),
    Row("response_of_rigs", ("sweep",), uncertain_response.draw, uncertain_response.has_bands, ("measured",)),
    Row("bifurcation", ("sweep",), partial(bifurcation.draw, name="stroboscopic_displacement"), takes=OVER_SWEEPS),
    Row("bifurcation_impact", ("sweep",), partial(bifurcation.draw, name="impact_displacement"), takes=OVER_SWEEPS),
    *(Row(name, ("sweep",), partial(field_response.draw, name=name), partial(field_response.has, name=name)) for name in field_response.PICTURES),
    Row("motion", ("trace",), motion.draw),
    Row("phase_plane", ("trace",), phase_plane.draw),
    Row("relative_plane", ("trace",), relative_plane.draw_motion),
    Row("poincare", ("trace",), relative_plane.draw_points, lambda file: bool(file.excitation_hz)),
    Row("impact", ("trace",), impact.draw),
    Row("spectrum", ("trace",), spectrum.draw),
    Row("work_precision", ("study",), work_precision.draw, lambda file: file.topic == "work_precision"),
    Row("labels", ("study",), labels.draw, lambda file: file.topic == "labels"),
    Row("stability", ("study",), stability.draw, lambda file: file.topic == "stability"),
]


def open_file(source: Source) -> OpenedFile:
    """Opens a path, or an xarray.Dataset of a file, with the checked reader of its kind. Raises PeterkaFileError."""
    with OpenedFile(source) as header:
        reader = READERS[header.kind]
    return reader(source)


def picture_name(file: OpenedFile, name: str) -> str:
    """Stem of the picture's file name; a study's file often has its topic in its name already."""
    stem = file.path.stem
    return stem if file.kind == "study" and stem.endswith(name) else f"{stem}_{name}"


def pictures_of(file: OpenedFile, cycles: int = 300, measured: Measurements = NOTHING_MEASURED,
                borders: Sequence[Border] = NO_BORDERS,
                unstable: Sequence[UnstableBranch] = NO_UNSTABLE, curves: Lines | None = None,
                probability: str | None = None) -> dict[str, Callable[..., Any]]:
    """{name: draw(file, ax=None)} of all pictures of an open file; each may still find nothing to draw. `cycles`: length of
    the short run whose view of a basin is drawn; `measured`: points over the pictures of a sweep or map; `borders` and
    `unstable` orbits: over those of a sweep; `curves`: over a map, which has one picture more with them;
    `probability`: of which motion of drawn rigs, as in maps/outcomes.py; of impacts of any kind by default. Raises PeterkaFileError
    where one is asked of a file without drawn rigs."""
    if probability is None:
        probability = uncertain_map.IMPACTS
    else:
        uncertain_map.refuse_without_draws(file)
    options = {"cycles": cycles, "measured": measured, "borders": borders, "unstable": unstable, CURVES: curves,
               "probability": probability}
    return {row.name.format(**options, asked=re.sub("[/ ]", "_", probability)): partial(row.draw, **{name: options[name] for name in row.takes})
            for row in PICTURES if file.kind in row.kinds and row.has(file) and (CURVES not in row.takes or curves)}
