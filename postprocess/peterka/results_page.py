"""The results page in Markdown: findings of studies and map files, with the pictures beside it."""

from collections.abc import Iterable, Sequence

import numpy as np

from .files.harmless import harmless
from .files.opened import OpenedFile
from .maps.audit_map import compared_errors
from .maps.map_file import PeterkaFile
from .maps.tables import Audit
from .pictures import picture_name
from .studies.study_file import StudyFile
from .studies.study_words import (
    labels_table, rigid_limit_sentence, stability_table, where_engines_break, work_precision_table,
)

INTRODUCTION = """# Results

Written by `jobs/results.sh` from the files that the program computes. Times are multiples of the exact engine's on the
same machine, so that they hold elsewhere, too."""


def page(files: Sequence[OpenedFile]) -> str:
    """The page's text for these open files: studies, one per topic, and any number of maps."""
    sections = [INTRODUCTION]
    for topic, write in (("work_precision", _work_precision), ("labels", _labels), ("stability", _stability)):
        sections += [write(file) for file in files if isinstance(file, StudyFile) and file.topic == topic]
    maps = [file for file in files if isinstance(file, PeterkaFile) and file.kind == "map"]
    if maps:
        sections.append(_omitted(maps))
    return "\n\n".join(sections) + "\n"


def pictures(files: Sequence[OpenedFile]) -> list[str]:
    """Names of the pictures that the page shows, as draw.py gives them."""
    return [f"{picture_name(file, file.topic)}.png" for file in files if isinstance(file, StudyFile)]


def _picture(file: StudyFile) -> str:
    name, = pictures([file])
    return f"![{file.topic.replace('_', ' ')}]({name})"


def _work_precision(file: StudyFile) -> str:
    cells = file.table.outcome.shape[1]
    return "\n\n".join([
        f"## Error and time: {harmless(file.title, page=True)}",
        f"Peak force on the stable orbits of {cells} cells against a reference in extended precision; transients are "
        "left out, and every method does the same work, but that the batched engine always measures forces, too.",
        work_precision_table(file.table),
        "Errors are those of cells with a result; `time for` is the fastest run whose median error is that small or smaller.",
        _picture(file),
    ])


def _labels(file: StudyFile) -> str:
    return "\n\n".join([
        "## What errors do to a map",
        f"{harmless(file.title, page=True)}: a map of {file.table.cells} cells, solved with each method: cells whose regime or z = p/q is not that of the "
        "reference run, and unverified cells.",
        labels_table(file.table),
        _picture(file),
    ])


def _stability(file: StudyFile) -> str:
    return "\n\n".join(filter(None, [
        "## Where engines break",
        f"{len(file.table.scene)} stiff and extreme scenes. An engine agrees with the reference, says why it has no "
        "result, is wrong (it claims what the reference contradicts), or is not meant for the scene.",
        stability_table(file.table),
        where_engines_break(file.table),
        rigid_limit_sentence(file.table),
        _picture(file),
    ]))


def _omitted(maps: Iterable[PeterkaFile]) -> str:
    parts = ["## What `auto` left out"]
    for file in maps:
        sentences = [harmless(line, None, page=True) for line in file.data.text("summary/omitted")]
        parts.append(f"**{harmless(file.title, page=True)}**\n\n" + ("\n".join(f"- {line}" for line in sentences) or "- nothing"))
        parts.append(_audit_sentence(file.audit))
    return "\n\n".join(parts)


def _audit_sentence(audit: Audit | None) -> str:
    """Evidence that skipping cells was safe: what an engine that skips nothing found in a sample of the cells."""
    if audit is None or audit.count == 0:
        return "No cell of this map was audited."
    errors = compared_errors(audit.force_error)
    text = (f"Audit: an independent engine, which leaves nothing out, solved {audit.count} cells again, half of "
            f"them at random and half where claims are weakest. {int(np.sum(audit.agrees))} have the same regime and z = p/q")
    if not len(errors):
        return text + "; none has a force to compare."
    return (text + f"; the peak forces of the {len(errors)} comparable ones differ by {np.quantile(errors, 0.5, method='inverted_cdf'):.1e} in the "
            f"median, {np.quantile(errors, 0.99, method='inverted_cdf'):.1e} in 99 %, {errors[-1]:.1e} at most.")
