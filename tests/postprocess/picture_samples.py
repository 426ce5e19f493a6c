"""Small map and basin files in layout version 3, written without peterka, and the colours visible in a drawn picture."""

import matplotlib.image
import numpy as np
from matplotlib.figure import Figure
from peterka.plotting import axes
from peterka.plotting.classes import CLASSES
from peterka.plotting.figures import figure_of
from sealing import SealedFile

NO_IMPACT, CHAOTIC = (0, 0, 1), (2, 0, 0)
SUSTAINED, UNRESOLVED, FAILED, MISSING = (3, 0, 1), (4, 0, 0), (5, 0, 0), (-128, 0, 0)


def orbit(impacts, period):
    return (1, impacts, period)


# Every class of the first table once, row by row from the lowest gap; 4 rows of 6 columns. 7/13 has no colour of its own.
ALL_CLASSES = [
    [orbit(1, 1), orbit(2, 2), orbit(4, 4), orbit(3, 3), orbit(1, 2), orbit(2, 4)],
    [orbit(1, 3), orbit(2, 1), orbit(4, 2), orbit(3, 1), orbit(6, 2), orbit(4, 1)],
    [orbit(5, 1), orbit(3, 2), orbit(7, 13), CHAOTIC, SUSTAINED, UNRESOLVED],
    [FAILED, MISSING, NO_IMPACT, NO_IMPACT, NO_IMPACT, NO_IMPACT],
]
PLAIN = [
    [orbit(1, 1), orbit(1, 1), orbit(2, 2), orbit(1, 2)],
    [orbit(1, 1), orbit(1, 1), CHAOTIC, orbit(1, 2)],
    [orbit(1, 1), NO_IMPACT, NO_IMPACT, NO_IMPACT],
    [NO_IMPACT, NO_IMPACT, NO_IMPACT, NO_IMPACT],
]


UNITS = {"impact_speed": "m/s", "impulse": "N s", "contact_time": "s", "contact_power_w": "W", "max_displacement": "m"}
INTEGER_FIELDS = {"chatter": "i1", "computed": "i1", "certified": "i1", "last_impact": "i4", "observed_cycles": "i4"}


def write_map(path, cells=PLAIN, frequency_ratio=None, gap_ratio=None, forces=None, fields=None, **attributes):
    """`cells[row][column]` is (regime, impacts, period); forces default to 10 + row + column/10. `fields`: optional
    datasets, those of UNITS, chatter, computed, certified, last_impact and observed_cycles."""
    rows, columns = np.shape(cells)[:2]
    coordinates = {
        "gap_ratio": np.linspace(0, 3, rows) if gap_ratio is None else gap_ratio,
        "frequency_ratio": np.linspace(1, 4, columns) if frequency_ratio is None else frequency_ratio,
    }
    attributes = {"natural_frequency_hz": 4.5, "cart_amplitude_m": 0.89e-3, "hammer_mass_kg": 0.298} | attributes
    with SealedFile(path, "w") as file:
        _write_common(file, "map", coordinates, cells, forces, attributes)
        _write_fields(file, fields or {}, coordinates)
    return path


def write_audit(path, places, labels, force_error, agrees):
    """Adds an audit: `places` (row, column) and `labels` (regime, impacts, period) of each sample."""
    with SealedFile(path, "r+") as file:
        columns = file["regime"].shape[1]
        sample = {"sample": np.arange(len(places), dtype="i4")}
        group = file.create_group("audit")
        group.create_dataset("sample", data=sample["sample"]).make_scale("sample")
        places, labels = np.array(places).reshape(-1, 2), np.array(labels).reshape(-1, 3)
        _write_data(group, "cell", (places[:, 0] * columns + places[:, 1]).astype("i8"), sample)
        for name, kind, values in (
            ("row", "i4", places[:, 0]), ("column", "i4", places[:, 1]), ("regime", "i1", labels[:, 0]),
            ("impacts", "i4", labels[:, 1]), ("period", "i4", labels[:, 2]), ("force_error", "f8", force_error),
            ("agrees", "i1", agrees),
        ):
            _write_data(group, name, np.array(values).astype(kind), sample)
    return path


def write_basin(path, cells=PLAIN, attractors=(), attractor=None, fields=None, **attributes):
    """`attractors`: dicts of columns of the table; `attractor[row][column]`: its row, -1 (the default) for none."""
    rows, columns = np.shape(cells)[:2]
    coordinates = {"velocity_ratio": np.linspace(-6, 6, rows), "displacement_ratio": np.linspace(-3, 3, columns)}
    attributes = {"frequency_ratio": 1.8, "gap_ratio": 1.6} | attributes
    with SealedFile(path, "w") as file:
        _write_common(file, "basin", coordinates, cells, None, attributes)
        _write_fields(file, fields or {}, coordinates)
        numbers = np.full((rows, columns), -1) if attractor is None else np.array(attractor)
        _write_data(file, "attractor", numbers.astype("i4"), coordinates)
        group = file.create_group("attractors")
        capacity = {"attractor": np.arange(256, dtype="i4")}
        group.create_dataset("attractor", data=capacity["attractor"]).make_scale("attractor")
        group["count"] = np.int32(len(attractors))
        types = dict(regime="i1", impacts="i4", period="i4", cells="i8", peak_force_ratio="f8",
                     orbit_displacement="f8", orbit_velocity="f8")
        for name, kind in types.items():
            column = np.zeros(256, dtype=kind)
            column[: len(attractors)] = [row[name] for row in attractors]
            _write_data(group, name, column, capacity)
    return path


def _write_common(file, kind, coordinates, cells, forces, attributes):
    cells = np.array(cells)
    rows, columns = cells.shape[:2]
    file.attrs["Conventions"] = "CF-1.8"
    file.attrs["title"] = attributes.pop("title", "Sample")
    file.attrs["peterka_layout"] = np.int32(3)
    file.attrs["peterka_kind"] = kind
    file.attrs.update(attributes)
    for name, values in coordinates.items():
        file.create_dataset(name, data=values).make_scale(name)
    regime = cells[..., 0]
    if forces is None:
        forces = 10 + np.arange(rows)[:, None] + np.arange(columns)[None, :] / 10
        forces = np.where((regime == 5) | (regime == -128), np.nan, np.where(regime == 0, 0, forces))
    _write_data(file, "regime", regime.astype("i1"), coordinates)
    _write_data(file, "impacts", cells[..., 1].astype("i4"), coordinates)
    _write_data(file, "period", cells[..., 2].astype("i4"), coordinates)
    _write_data(file, "peak_force_ratio", np.array(forces, dtype="f8"), coordinates)


def _write_fields(file, fields, coordinates):
    for name, values in fields.items():
        kind = INTEGER_FIELDS.get(name, "f8")
        _write_data(file, name, np.array(values).astype(kind), coordinates)
        if name in UNITS:
            file[name].attrs["units"] = UNITS[name]


def _write_data(group, name, values, coordinates):
    dataset = group.create_dataset(name, data=values)
    for index, dimension in enumerate(coordinates):
        dataset.dims[index].attach_scale(group[dimension])


class Drawn:
    """A figure written to a PNG file and read back: the colours at points of the map."""

    def __init__(self, drawn, path):
        figure = drawn if isinstance(drawn, Figure) else figure_of(drawn)
        axes.save(figure, path)
        self.figure = figure
        self.map_axes = figure.axes[0]
        self.pixels = np.rint(matplotlib.image.imread(path)[..., :3] * 255).astype(int)

    def colour_at(self, x, y):
        """'#RRGGBB' at these data coordinates of the map."""
        place = self.map_axes.transData.transform((x, y))
        across, up = self.figure.transFigure.inverted().transform(place)
        height, width = self.pixels.shape[:2]
        return "#%02X%02X%02X" % tuple(self.pixels[int((1 - up) * height), int(across * width)])

    def colour_of(self, file, row, column):
        """Colour of a cell, near its lower left corner, because names and marks are drawn in the middle."""
        return self.colour_at(_inside(file.columns.edges, column), _inside(file.rows.edges, row))

    def legend_texts(self):
        return [text.get_text() for ax in self.figure.axes if ax.get_legend() for text in ax.get_legend().get_texts()]

    def map_texts(self):
        return [text.get_text() for text in self.map_axes.texts]


def _inside(edges, index):
    return edges[index] + 0.15 * (edges[index + 1] - edges[index])


def colour_named(label):
    return next(entry.colour for entry in CLASSES if entry.label == label)
