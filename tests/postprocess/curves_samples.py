"""A small file of curves in layout version 3, written without peterka."""

import numpy as np
from picture_samples import PLAIN, write_map
from sealing import SealedFile

LINES = [  # kind, p, q, points (frequency_ratio, gap_ratio)
    (0, 1, 1, [(1.5, 0.5), (2.0, 1.5), (2.5, 2.5)]),
    (1, 1, 2, [(3.0, 0.2), (3.2, 1.0), (3.6, 2.0)]),
    (2, 3, 2, [(1.2, 2.9), (2.0, 2.2), (3.8, 0.4)]),
]
SPECIALS = [(0, 2.5, 2.5), (3, 1.5, 0.5)]
CROSSINGS = [(0, 1.75, 1.0), (1, 3.2, 1.0)]  # number of the line, frequency_ratio, gap_ratio


def write_curves(path, lines=None, specials=None, crossings=(), branches=(), **attributes):
    """`branches`: gap, p, q, points (frequency_ratio, force, x at phase 0 ...), all points of a branch having equal length."""
    lines, specials = LINES if lines is None else lines, SPECIALS if specials is None else specials
    write_map(path, PLAIN, **attributes)
    with SealedFile(path, "r+") as file:
        file.attrs["peterka_kind"] = "curves"
        counts = [len(points) for *_, points in lines]
        points = np.array([point for *_, points in lines for point in points], dtype="f8").reshape(-1, 2)
        _table(file, "curve", len(lines), {
            "curve_kind": np.array([line[0] for line in lines], dtype="i1"),
            "curve_impacts": np.array([line[1] for line in lines], dtype="i4"),
            "curve_period": np.array([line[2] for line in lines], dtype="i4"),
            "curve_first": np.cumsum([0, *counts[:-1]]).astype("i8"), "curve_points": np.array(counts, dtype="i8")})
        _table(file, "point", len(points), {"point_frequency_ratio": points[:, 0], "point_gap_ratio": points[:, 1]})
        _table(file, "special", len(specials), {
            "special_kind": np.array([special[0] for special in specials], dtype="i1"),
            "special_frequency_ratio": np.array([special[1] for special in specials], dtype="f8"),
            "special_gap_ratio": np.array([special[2] for special in specials], dtype="f8")})
        _table(file, "crossing", len(crossings), {
            "crossing_curve": np.array([crossing[0] for crossing in crossings], dtype="i4"),
            "crossing_frequency_ratio": np.array([crossing[1] for crossing in crossings], dtype="f8"),
            "crossing_gap_ratio": np.array([crossing[2] for crossing in crossings], dtype="f8")})
        rows = [row for *_, points in branches for row in points]
        samples = max((len(row) - 2 for row in rows), default=0)
        _table(file, "branch_sample", samples, {})
        _table(file, "branch", len(branches), {
            "branch_gap_ratio": np.array([gap for gap, *_ in branches], dtype="f8"),
            "branch_impacts": np.array([p for _, p, *_ in branches], dtype="i4"),
            "branch_period": np.array([q for _, _, q, _ in branches], dtype="i4"),
            "branch_first": np.cumsum([0, *(len(points) for *_, points in branches)])[:-1].astype("i8"),
            "branch_points": np.array([len(points) for *_, points in branches], dtype="i8")})
        displacements = np.array([[*row[2:], *[np.nan] * (samples - len(row) + 2)] for row in rows], dtype="f8")
        _table(file, "branch_point", len(rows), {
            "branch_frequency_ratio": np.array([row[0] for row in rows], dtype="f8"),
            "branch_peak_force_ratio": np.array([row[1] for row in rows], dtype="f8"),
            "branch_stroboscopic_displacement": displacements, "branch_impact_displacement": displacements})
        for name in ("stroboscopic", "impact") if rows else ():
            file[f"branch_{name}_displacement"].dims[1].attach_scale(file["branch_sample"])
    return path


def write_distances(path):
    """Cells at 0.1 from an edge, but two that have none in the window and one that could not be followed."""
    write_curves(path, cart_amplitude_m=1e-3, natural_frequency_hz=4.0)
    with SealedFile(path, "r+") as file:
        shape = file["regime"].shape
        kinds = np.zeros(shape, dtype="i1")
        kinds[0, :2], kinds[1, 0], kinds[-1] = 3, 4, -128
        distances = np.where(kinds == 0, -0.1, np.nan)
        for side in ("frequency_ratio", "gap_ratio"):
            for name, values in ((f"edge_distance_{side}", distances), (f"edge_kind_{side}", kinds)):
                data = file.create_dataset(name, data=values)
                for scale, dimension in zip(("gap_ratio", "frequency_ratio"), data.dims):
                    dimension.attach_scale(file[scale])
    return path, kinds


def _table(file, dimension, size, columns):
    if size == 0:
        return
    file.create_dataset(dimension, data=np.arange(size, dtype="i8")).make_scale(dimension)
    for name, values in columns.items():
        file.create_dataset(name, data=values).dims[0].attach_scale(file[dimension])
