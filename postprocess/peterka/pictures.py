"""Which pictures a file gives: the one place that knows them all."""

from functools import partial

from .files.opened import OpenedFile
from .maps import audit_map, basin_map, computed_map, force_map, last_impact, peterka_map, quantity_map
from .maps.map_file import PeterkaFile
from .studies import labels, stability, work_precision
from .studies.study_file import StudyFile
from .sweeps import bifurcation, response
from .sweeps.measured import Measurements
from .sweeps.sweep_file import SweepFile
from .traces import impact, motion, phase_plane, spectrum
from .traces.trace_file import TraceFile

READERS = {"map": PeterkaFile, "basin": PeterkaFile, "sweep": SweepFile, "trace": TraceFile, "study": StudyFile}
STUDIES = {"work_precision": work_precision.draw, "labels": labels.draw, "stability": stability.draw}
TRACE = {"motion": motion.draw, "phase_plane": phase_plane.draw, "impact": impact.draw, "spectrum": spectrum.draw}
PLANES = {
    "map": {
        "map": peterka_map.draw,
        "force_1_1": force_map.draw_single_impact,
        "force_all": force_map.draw_all_impacts,
    },
    "basin": {"basin": basin_map.draw_attractors, "basin_impact": basin_map.draw_impact},
}


def open_file(path):
    """The file, opened and checked by the reader of its kind."""
    with OpenedFile(path) as header:
        reader = READERS[header.kind]
    return reader(path)


def picture_name(file, name):
    """Of a picture's file without its suffix; a study's file often has its topic in its name already."""
    stem = file.path.stem
    return stem if file.kind == "study" and stem.endswith(name) else f"{stem}_{name}"


def pictures_of(file, after=300, measured=Measurements([], [])):
    """{name: function that takes the file and returns a Figure, or None without anything to draw}. `after`: the forcing
    cycles of a short run, whose view of a basin is drawn. Measured points are drawn over the pictures of a sweep."""
    if file.kind == "study":
        return {file.topic: STUDIES[file.topic]}
    if file.kind == "trace":
        return TRACE
    if file.kind == "sweep":
        return {
            "response": partial(response.draw, measured=measured),
            "bifurcation": partial(bifurcation.draw, measured=measured, name="stroboscopic_displacement"),
            "bifurcation_impact": partial(bifurcation.draw, measured=measured, name="impact_displacement"),
        }
    pictures = PLANES[file.kind] | {name: partial(quantity_map.draw, name=name) for name in file.quantities}
    if file.has_last_impact:
        pictures["last_impact"] = last_impact.draw
        if file.kind == "basin":
            pictures[f"impact_after_{after}"] = partial(basin_map.draw_impact_after, cycles=after)
    if file.is_refined:
        pictures["computed"] = computed_map.draw
    if file.audit is not None:
        pictures["audit"] = audit_map.draw
    return pictures
